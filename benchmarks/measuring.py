"""Common parts of the benchmarks: environment of timed runs, output option and files."""

import json
import os
import sys
from pathlib import Path

import click

import viscorough
from viscorough.io.atomic import atomic_write
from viscorough_study.performance import timing
from viscorough_study.run.tables import write_table

# One thread, and the allocator settings of the workflow; a process reads both when it starts.
ENVIRONMENT = {
    **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1"),
    "MALLOC_MMAP_THRESHOLD_": str(2**25),
    "MALLOC_TRIM_THRESHOLD_": str(10**9),
}
LARGE_PAGES = {"GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"}  # large pages, if the system has them; as in the workflow

output_option = click.option("--output", type=click.Path(path_type=Path), required=True, help="File to write.")


def run_timed(main, **variables):
    """Run a command with ENVIRONMENT and further variables, in a process that replaces this one if needed."""
    variables_needed = ENVIRONMENT | variables
    if any(os.environ.get(name) != value for name, value in variables_needed.items()):
        os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | variables_needed)
    main()


def save(content, output):
    """Write the content of a file of results as JSON, atomically, with machine and version."""
    output.parent.mkdir(parents=True, exist_ok=True)
    everything = {"machine": timing.machine(), "viscorough": viscorough.__version__, **content}
    with atomic_write(output) as temporary:
        temporary.write_text(json.dumps(everything, indent=1) + "\n", encoding="utf-8")
    click.echo(f"written to {output}")


def save_table(table, output):
    """Write a pandas.DataFrame without its index as a CSV file, atomically."""
    output.parent.mkdir(parents=True, exist_ok=True)
    with atomic_write(output) as temporary:
        table.to_csv(temporary, index=False, lineterminator="\n")
    click.echo(f"written to {output}")


def save_times(table, output, columns, title, settings):
    """Write a table of times with its settings and the machine; columns, title : arguments of write_table"""
    output.parent.mkdir(parents=True, exist_ok=True)
    write_table(table, output, columns=columns, title=title, settings=settings, machine=timing.machine())
    click.echo(f"written to {output}")
