"""Measure the time from `git clone` to the page: environment, compilation and the default run, with empty caches.

    python benchmarks/first_minutes.py --repeats 3 --output results/first_minutes.csv

Every repeat clones this repository into a temporary folder and works there. Compiled code is kept in that folder, too,
so that none from elsewhere is used. Packages come from pip's cache or the package index. Commits to be compared are
measured in turn, in the order given. The machine must do nothing else.
"""

import os
import resource
import subprocess
import tempfile
import time
from datetime import UTC, datetime
from pathlib import Path

import click
import pandas as pd
from measuring import output_option, save_table

from viscorough_study.performance import timing

ROOT = Path(__file__).resolve().parents[1]
# Variables that change where packages and compiled code are found, or how make runs.
_NOT_PASSED_ON = ("PYTHONPATH", "PYTHONDONTWRITEBYTECODE", "VIRTUAL_ENV", "MAKEFLAGS", "MAKELEVEL", "MFLAGS")


def parts(commit, cores):
    """{part: command} from the clone to the page, in the folder of the clone."""
    return {
        "clone": f"git clone --quiet --no-hardlinks '{ROOT}' . && git checkout --quiet {commit}",
        "environment": "make environment",
        "compilation": ".venv/bin/python -m viscorough_study.run.kernels",
        "run": f"make reproduce CORES={cores} && test -s results/index.html",
    }


def measured(commands, folder):
    """Wall and processor seconds of each command, all of which run in a folder, as rows of a table.

    Raises ClickException if a command fails.
    """
    passed_on = {name: value for name, value in os.environ.items() if name not in _NOT_PASSED_ON}
    environment = passed_on | {"NUMBA_CACHE_DIR": str(Path(folder).resolve() / "compiled")}
    rows = []
    for part, command in commands.items():
        began, before = time.perf_counter(), _processor_seconds()
        done = subprocess.run(command, shell=True, cwd=folder, env=environment, stdout=subprocess.DEVNULL, check=False)
        wall, processor = time.perf_counter() - began, _processor_seconds() - before
        if done.returncode:
            raise click.ClickException(f"{part}: `{command}` failed with exit code {done.returncode}")
        rows.append({"part": part, "wall_s": round(wall, 1), "processor_s": round(processor, 1)})
    return rows


def _processor_seconds():
    """Processor seconds of all processes that this one has started and that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@click.command(help=__doc__.splitlines()[0])
@click.option("--commit", "commits", multiple=True, default=["HEAD"], show_default=True, help="Commit to measure.")
@click.option("--repeats", type=click.IntRange(1), default=3, show_default=True)
@click.option("--cores", type=click.IntRange(1), default=2, show_default=True)
@output_option
def main(commits, repeats, cores, output):
    machine, rows = timing.machine(), []
    used = f"{cores} of {machine['cores']}" if cores < machine["cores"] else cores
    origin = {"machine": f"{machine['processor']}, {used} cores", "measured": datetime.now(UTC).date().isoformat()}
    for repeat in range(1, repeats + 1):
        for commit in commits:
            with tempfile.TemporaryDirectory() as folder:
                table = measured(parts(commit, cores), folder)
            rows += [origin | {"commit": commit, "repeat": repeat} | row for row in table]
            whole = sum(row["wall_s"] for row in table)
            click.echo(f"{commit}, repeat {repeat} of {repeats}: {whole:.0f} s from the clone to the page")
    save_table(pd.DataFrame(rows), output)


if __name__ == "__main__":
    main()
