"""Kill the workflow repeatedly, and compare its final results with an undisturbed run.

    python benchmarks/chaos.py --kills 60 --seed 1 --output results/chaos.json

A run of the small settings, which starts without results, is disturbed after a random time: in half of the cases the
whole run is killed (SIGKILL), in a quarter one of its jobs, and in a quarter the run is interrupted (SIGINT to its
group, as by Ctrl-C). The same command alone is then repeated (config/README.md, Interrupted runs) until it finishes.
Its figures, tables, ensembles and curves must then equal an undisturbed run's to the last byte. Files with measured
times, such as logs and the page, must only have the same names.
"""

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import click
import numpy as np
import psutil
from measured_times import holds_times
from measuring import output_option, save
from project_copy import copy_project, environment

SNAKEMAKE = [sys.executable, "-m", "snakemake", "--cores", "2", "--nocolor", "--configfile", "config/test.yaml"]
# The longest wait for a kill, as a share of the time of an undisturbed run. Most runs are killed several times, and
# near their end as often as near their beginning.
LONGEST_WAIT = 1 / 3
HANGS = 3600  # seconds after which a run counts as hanging, even on a busy machine


def remove_results(folder):
    for name in ("results", ".snakemake"):
        shutil.rmtree(folder / name, ignore_errors=True)


def wait_for(condition, what, seconds=120):
    """Wait until the condition is true, and return its value."""
    end = time.monotonic() + seconds
    while not (value := condition()):
        if time.monotonic() > end:
            raise click.ClickException(f"{what} does not happen within {seconds} s")
        time.sleep(0.2)
    return value


@contextlib.contextmanager
def started(folder, *arguments):
    """Start Snakemake in a new session, with output to a log; afterwards kill all processes of the session."""
    with (folder / "run.log").open("w") as log:
        run = subprocess.Popen(
            [*SNAKEMAKE, *arguments],
            cwd=folder,
            env=environment(folder),
            stdout=log,
            stderr=log,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # background processes ignore SIGINT
        )
    try:
        yield run
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(run.pid, signal.SIGKILL)
        run.wait()


def run_to_end(folder, *arguments, disturb=None):
    """Return the seconds of a run that may be disturbed and must end without an error."""
    start = time.perf_counter()
    with started(folder, *arguments) as run:
        if disturb:
            disturb()
        if code := run.wait(HANGS):
            raise click.ClickException(f"{folder.name} ends with {code}:\n{log_tail(folder)}")
    return time.perf_counter() - start


def log_tail(folder):
    return "\n".join((folder / "run.log").read_text().splitlines()[-20:])


def disturb(run, random):
    """Kill the run, kill one of its jobs (or the run, if it has none), or interrupt it; return the kind."""
    everything = psutil.Process(run.pid).children(recursive=True)
    draw = random.random()
    if draw < 0.25:
        os.killpg(run.pid, signal.SIGINT)
        return "interrupt"
    if draw < 0.5 and everything:
        with contextlib.suppress(psutil.NoSuchProcess):
            everything[-1].kill()  # it has no children, so it is the process of a script, not a shell around it
        return "job"
    os.killpg(run.pid, signal.SIGKILL)
    psutil.wait_procs(everything, timeout=10)
    return "whole run"


def contents(folder):
    """Return {name: bytes} of all files in results/, without the bytes of files that hold times."""
    results = folder / "results"
    names = sorted(path.relative_to(results) for path in results.rglob("*") if path.is_file())
    return {str(name): b"" if holds_times(name) else (results / name).read_bytes() for name in names}


def compare(folder, expected):
    """Return one line for each file in results/ that differs from the expected contents."""
    actual = contents(folder)
    lines = [f"{name}: is missing or left over" for name in sorted(actual.keys() ^ expected.keys())]
    return lines + [f"{name}: differs" for name in expected if actual.get(name, expected[name]) != expected[name]]


def chaos(folder, kills, seed):
    """Return runs with `kills` kills in total, as a dictionary for the file.

    A killed run is repeated with its results so far. A run that ends by itself is followed by one without results.
    """
    run_to_end(folder)  # compiles the solvers unless that was done before
    undisturbed = contents(folder)
    remove_results(folder)
    seconds = run_to_end(folder)
    differences = [f"undisturbed: {line}" for line in compare(folder, undisturbed)]
    click.echo(f"undisturbed: {seconds:.0f} s, {len(undisturbed)} files")
    random, log, runs = np.random.default_rng(seed), [], 0
    remove_results(folder)
    while True:
        with started(folder) as run:
            is_last = len(log) == kills
            try:
                code = run.wait(HANGS if is_last else random.uniform(0, seconds * LONGEST_WAIT))
            except subprocess.TimeoutExpired:
                if is_last:
                    raise
                log.append(disturb(run, random))
                click.echo(f"kill {len(log)} of {kills}: {log[-1]}")
                run.wait(HANGS)  # a run that has lost a job finishes its other job and ends with an error
                continue
        runs += 1
        lines = [f"ends with {code}: {log_tail(folder)}"] if code else compare(folder, undisturbed)
        differences += [f"run {runs}: {line}" for line in lines]
        click.echo("\n".join([f"run {runs} {'differs' if lines else 'has recovered'}", *lines]))
        if is_last:
            return {
                "kills": kills,
                "runs": runs,
                "differences": differences,
                "files_compared": len(undisturbed),
                "log": log,
            }
        remove_results(folder)


@click.command(help=__doc__.splitlines()[0])
@click.option("--kills", type=click.IntRange(1), default=60, show_default=True, help="Total number of disturbances.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of times and of what is killed.")
@output_option
def main(kills, seed, output):
    with tempfile.TemporaryDirectory() as folder:
        copy_project(Path(folder).resolve())
        result = chaos(Path(folder).resolve(), kills, seed)
    save({"seed": seed, **result}, output)
    sys.exit(bool(result["differences"]))


if __name__ == "__main__":
    main()
