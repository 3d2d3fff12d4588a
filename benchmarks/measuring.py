"""What the measurements have in common: their command lines, one thread, turns, and processes of their own."""

import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import click
import numpy as np

import viscorough
from viscorough_study.performance import timing
from viscorough_study.run.tables import write_json

# One thread, and an allocator that keeps its pages as in the workflow: both are read when a process starts.
ENVIRONMENT = {
    **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1"),
    "MALLOC_MMAP_THRESHOLD_": str(2**25),
    "MALLOC_TRIM_THRESHOLD_": str(10**9),
}


def command(measured, repeats):
    """The command line of a script.

    measured : function of the number of repeats that gives the content of the file
    repeats : their default number
    """

    @click.command(help=measured.__globals__["__doc__"].splitlines()[0])
    @click.option("--repeats", type=click.IntRange(1), default=repeats, show_default=True)
    @click.option("--output", type=click.Path(path_type=Path), required=True, help="File to write, JSON.")
    def main(repeats, output):
        if any(os.environ.get(name) != value for name, value in ENVIRONMENT.items()):
            os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | ENVIRONMENT)
        about = {"machine": timing.machine(), "viscorough": viscorough.__version__, "repeats": repeats}
        write_json(about | measured(repeats), output)
        click.echo(f"{output.read_text(encoding='utf-8')}\nwritten to {output}")

    return main


def turns(functions, repeats):
    """Wall and processor seconds of functions that take turns, after a first call of each.

    Returns shape (repeats, functions, 2).
    """
    for function in functions:
        function()
    return np.array([[timing.timed(function)[1:] for function in functions] for _ in range(repeats)])


def seconds(function, *arguments, **options):
    """Result of a call, and its wall seconds."""
    start = time.perf_counter()
    return function(*arguments, **options), time.perf_counter() - start


def in_a_process(script, function, *arguments):
    """What a function of a script in this folder returns in a process of its own, through JSON."""
    code = f"import json, {script}; print(json.dumps({script}.{function}(*{arguments!r})))"
    environment = os.environ | ENVIRONMENT | {"PYTHONPATH": f"{Path(__file__).parent}:{os.environ.get('PYTHONPATH')}"}
    done = subprocess.run([sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)


def peak_bytes():
    """Peak memory of this process, the interpreter and libraries included."""
    return 1024 * int(re.search(r"VmHWM:\s*(\d+) kB", Path("/proc/self/status").read_text())[1])
