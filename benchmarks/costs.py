"""Run a command that makes results, and write their cost: time and memory of every rule, size on disk.

    python benchmarks/costs.py --output results/costs.json -- snakemake --cores 2 --configfile config/paper.yaml

Time and memory of jobs are those of Snakemake's benchmark files, which include the jobs of an earlier, interrupted run;
the wall time is that of this run.
"""

import signal
import subprocess
import sys
import time
from pathlib import Path

import click
from measuring import output_option, save

from viscorough_study.run.rule_costs import rule_costs


def sizes(folder):
    """{folder: size in megabytes} of the results."""
    megabytes = {}
    for path in folder.rglob("*"):
        if path.is_file():
            name = path.relative_to(folder).parts[0]
            megabytes[name] = megabytes.get(name, 0) + path.stat().st_size / 1e6
    return {name: round(size, 2) for name, size in sorted(megabytes.items(), key=lambda item: -item[1])}


def run_to_its_end(command):
    """Run a command and return its exit code.

    Ctrl-C reaches the command itself, and `subprocess.run` would kill it a quarter of a second later. Here it has time
    to end its jobs and to unlock its folder. SIGTERM, which reaches only this process, is passed on.
    """
    process = subprocess.Popen(command)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, lambda *_: process.terminate())
    code = process.wait()
    return 128 - code if code < 0 else code


@click.command(help=__doc__.splitlines()[0])
@output_option
@click.option("--results", type=click.Path(path_type=Path), default=Path("results"), show_default=True)
@click.argument("command", nargs=-1, required=True)
def main(output, results, command):
    try:
        rule_costs(results / "benchmarks")  # of earlier runs: a damaged file is reported before the run
    except ValueError as error:
        raise click.ClickException(str(error)) from None
    start = time.perf_counter()
    code = run_to_its_end(command)
    seconds = time.perf_counter() - start
    if code:
        sys.exit(code)
    rules = rule_costs(results / "benchmarks").set_index("rule").to_dict("index")
    megabytes = sizes(results)
    total = {
        "wall_s": round(seconds, 1),
        "jobs_s": round(sum(rule["seconds"] for rule in rules.values()), 1),
        "memory_mb": max((rule["memory_mb"] for rule in rules.values()), default=0),
        "results_mb": round(sum(megabytes.values()), 1),
    }
    click.echo("{wall_s:.0f} s; jobs at most {memory_mb:.0f} MB; results {results_mb:.0f} MB".format(**total))
    save({"command": " ".join(command), **total, "rules": rules, "results": megabytes}, output)


if __name__ == "__main__":
    main()
