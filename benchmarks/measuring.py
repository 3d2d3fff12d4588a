"""Common parts of the benchmarks: option and content of the output file."""

from pathlib import Path

import click

import viscorough
from viscorough.io.atomic import atomic_write
from viscorough_study.performance import timing
from viscorough_study.run.tables import write_json

output_option = click.option("--output", type=click.Path(path_type=Path), required=True, help="File to write.")


def save(content, output):
    """Write the content of a file of results, with machine and version."""
    write_json({"machine": timing.machine(), "viscorough": viscorough.__version__, **content}, output)
    click.echo(f"written to {output}")


def save_table(table, output):
    """Write a pandas.DataFrame without its index as a CSV file, atomically."""
    output.parent.mkdir(parents=True, exist_ok=True)
    with atomic_write(output) as temporary:
        table.to_csv(temporary, index=False, lineterminator="\n")
    click.echo(f"written to {output}")
