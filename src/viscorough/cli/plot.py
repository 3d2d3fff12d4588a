"""`viscorough plot`: draw a surface, or the output of another command."""

from pathlib import Path

import click

from viscorough.cli import files, messages, options, surface_options
from viscorough.io import suffixes


@click.command(short_help="A figure of a surface, a curve, a motion or a contact.")
@surface_options.heights_input("file")
@options.output("FIGURE", allowed=suffixes.FIGURES)
def plot(heights: surface_options.HeightsFile, output: Path) -> None:
    """Draw FILE: the output of another command (.nc), or a map of heights, which is read as by viscorough indent.

    A surface is drawn as a map of heights, a contact as maps of pressure, gap and contact, and a motion as depth and
    velocity against time. A loading curve is drawn as force against depth, and as stiffness and contact fraction
    against force. Maps have the first row at the top; the colours of pressures end at their 99th percentile. Curves
    have logarithmic axes. This command needs matplotlib: pip install "viscorough[plot]".

    \b
    Example:
        viscorough plot curve.nc -o curve.png
        viscorough plot scan.txt --spacing 0.5 --unit um -o scan.png
    """
    try:
        from viscorough.io import plotting
    except ModuleNotFoundError as error:
        raise click.ClickException('matplotlib is not installed; pip install "viscorough[plot]" installs it') from error

    from viscorough.io.heights import surface_to_content

    file = heights.path
    files.check_output(output, results=file)
    content = fault = None
    if not heights.options and file.suffix.lower() == ".nc":
        try:
            content = files.read_content(file)
            plotting.kind_of(content)
        except ValueError as error:
            content, fault = None, error if str(file) in str(error) else ValueError(f"{file}: {error}")
    if content is None:  # FILE is not the output of another command, so it must be a map of heights
        try:
            content = surface_to_content(surface_options.read_indenter(heights, output))
        except ValueError as error:
            raise (fault or error) from error
    plotting.plot(content, output)
    messages.announce(output, f"figure of {file.name}")
