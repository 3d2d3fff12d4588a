"""`viscorough plot`: a figure of what another command wrote."""

from typing import Any

import click

from viscorough.cli.files import check_output, read_content
from viscorough.cli.messages import announce
from viscorough.cli.options import FILE


@click.command(short_help="A figure of a curve, a motion, a contact or a surface.")
@click.argument("file", type=FILE, metavar="FILE.nc")
@click.option("-o", "--output", type=FILE, required=True, metavar="FIGURE", help="A .png, .pdf or .svg file.")
def plot(file: Any, output: Any) -> None:
    """Draw what is in FILE.nc, or in a table (.csv), that another command wrote.

    A surface is a map of heights; fields of a contact are maps of pressure, gap and contact; a loading curve is force
    over depth, stiffness and contact fraction over force; a motion is depth and velocity over time. Curves have
    logarithmic axes. This needs matplotlib: pip install "viscorough[plot]".

    \b
    Example:
        viscorough plot curve.nc -o curve.png
    """
    try:
        from viscorough import plotting
    except ModuleNotFoundError as error:
        raise click.ClickException('matplotlib is not installed; pip install "viscorough[plot]" installs it') from error

    check_output(output, results=file)
    content = read_content(file)
    try:
        plotting.plot(content, output)
    except ValueError as error:
        raise ValueError(f"{file}: {error}" if str(output) not in str(error) else str(error)) from error
    announce(output, f"figure of {file.name}")
