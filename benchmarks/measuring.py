"""Common parts of the benchmarks: option and content of the output file."""

from pathlib import Path

import click

import viscorough
from viscorough_study.performance import timing
from viscorough_study.run.tables import write_json

output_option = click.option("--output", type=click.Path(path_type=Path), required=True, help="File to write, JSON.")


def save(content, output):
    """Write the content of a file of results, with machine and version."""
    write_json({"machine": timing.machine(), "viscorough": viscorough.__version__, **content}, output)
    click.echo(f"written to {output}")
