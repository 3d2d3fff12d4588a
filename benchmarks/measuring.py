"""Common parts of the benchmarks: command line, output file, one thread, and interleaved repeats."""

import os
import sys
from pathlib import Path

import click

import viscorough
from viscorough_study.performance import timing
from viscorough_study.run.tables import write_json

# One thread, and the settings of the allocator of the workflow, both of which a process reads when it starts.
ENVIRONMENT = {
    **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1"),
    "MALLOC_MMAP_THRESHOLD_": str(2**25),
    "MALLOC_TRIM_THRESHOLD_": str(10**9),
}

output_option = click.option("--output", type=click.Path(path_type=Path), required=True, help="File to write, JSON.")


def save(content, output):
    """Write the content of a file of results, with machine and version."""
    write_json({"machine": timing.machine(), "viscorough": viscorough.__version__, **content}, output)
    click.echo(f"written to {output}")


def command(measured, repeats):
    """The command line of a script.

    measured : function of the number of repeats that gives the content of the file
    repeats : their default number
    """

    @click.command(help=measured.__globals__["__doc__"].splitlines()[0])
    @click.option("--repeats", type=click.IntRange(1), default=repeats, show_default=True)
    @output_option
    def main(repeats, output):
        if any(os.environ.get(name) != value for name, value in ENVIRONMENT.items()):
            os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | ENVIRONMENT)
        save({"repeats": repeats, **measured(repeats)}, output)
        click.echo(output.read_text(encoding="utf-8"))

    return main


def medians(functions, repeats):
    """{name: (wall, processor) seconds}, medians over interleaved repeats, after a first call of each function."""
    for function in functions.values():
        function()
    return timing.interleaved(functions, repeats)
