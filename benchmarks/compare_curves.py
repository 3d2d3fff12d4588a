"""Compare the time of loading curves between two trees of the project, in pairs back to back.

    python benchmarks/compare_curves.py OLD NEW --output results/compare_curves.json

OLD and NEW are folders with an environment in .venv (make environment). Both compute the same curves by turns, in a
process each that has compiled everything before, in alternating order; the ratio of their processor times is the
median over the repeats.
"""

import os
import subprocess
from pathlib import Path

import click
import numpy as np

from viscorough_study.performance import timing
from viscorough_study.tables import write_json

CASES = ((0.1, 257, 1e-3), (0.5, 257, 1e-3), (0.9, 257, 1e-3), (0.5, 257, 1e-4), (0.5, 129, 1e-5))
# Runs in either tree, with names that both have: a line from standard input starts a round, whose times are printed.
WORKER = """
import sys, time
import viscorough
cases = [(viscorough.self_affine_disc(h, n, seed=3), tolerance) for h, n, tolerance in {cases!r}]
for disc, tolerance in cases:
    viscorough.indent(disc, tolerance=tolerance)
print("ready", flush=True)
for _ in sys.stdin:
    times = []
    for disc, tolerance in cases:
        began = time.process_time()
        viscorough.indent(disc, tolerance=tolerance)
        times.append(time.process_time() - began)
    print(*times, flush=True)
"""


def start(tree):
    """A process of a tree's environment that times the cases at every line that it reads."""
    threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
    command = [str(Path(tree).resolve() / ".venv/bin/python"), "-c", WORKER.format(cases=CASES)]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    process = subprocess.Popen(command, cwd=tree, env=os.environ | threads, **pipes)
    if process.stdout.readline() != "ready\n":
        raise click.ClickException(f"{tree}: the curves cannot be computed there")
    return process


def timed_round(process):
    """Seconds of every case."""
    process.stdin.write("go\n")
    process.stdin.flush()
    return [float(seconds) for seconds in process.stdout.readline().split()]


@click.command()
@click.argument("old", type=click.Path(exists=True, file_okay=False))
@click.argument("new", type=click.Path(exists=True, file_okay=False))
@click.option("--repeats", type=click.IntRange(1), default=15, show_default=True, help="Rounds of every tree.")
@click.option("--output", required=True, help="File to write, JSON.")
def main(old, new, repeats, output):
    """Compare the time of loading curves between two trees of the project."""
    processes, seconds = [start(old), start(new)], [[], []]
    for repeat in range(repeats):
        for tree in (0, 1) if repeat % 2 else (1, 0):
            seconds[tree].append(timed_round(processes[tree]))
    for process in processes:
        process.communicate()
    ratios = np.array(seconds[1]) / np.array(seconds[0])
    low, median, high = np.percentile(ratios, [25, 50, 75], axis=0)
    rows = [
        {
            "hurst": hurst,
            "elements_across": elements,
            "tolerance": tolerance,
            "seconds_old": float(np.median(np.array(seconds[0])[:, case])),
            "ratio": float(median[case]),
            "ratio_quartiles": [float(low[case]), float(high[case])],
        }
        for case, (hurst, elements, tolerance) in enumerate(CASES)
    ]
    write_json({"machine": timing.machine(), "repeats": repeats, "curves": rows}, output)
    for row in rows:
        click.echo("H = {hurst}, {elements_across} across, {tolerance:g}: new/old {ratio:.3f}".format(**row))


if __name__ == "__main__":
    main()
