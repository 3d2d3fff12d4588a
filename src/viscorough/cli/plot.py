"""`viscorough plot`: draw a surface, or the output of another command."""

from pathlib import Path

import click

from viscorough.cli import files, messages, options, surface_options
from viscorough.io import suffixes


@click.command(cls=options.Command, short_help="A figure of a surface, a curve, a motion or a contact.")
@surface_options.heights_input("file")
@options.output("FIGURE", allowed=suffixes.FIGURES)
def plot(heights: surface_options.HeightsFile, output: Path) -> None:
    """Draw FILE: the output of another command (.nc), or a map of heights, which is read as by viscorough indent.

    A surface is drawn as a map of heights, a contact as a map of the pressure (the last one of several), a loading
    curve as force against depth, and a motion as depth against time. Maps have the first row at the top. This command
    needs matplotlib: pip install "viscorough[plot]".

    \b
    Example:
        viscorough plot curve.nc -o curve.png
        viscorough plot heights.npy --spacing 0.5 --unit um -o heights.png
    """
    try:
        from viscorough.io import plotting
    except ModuleNotFoundError as error:
        raise click.ClickException('matplotlib is not installed; pip install "viscorough[plot]" installs it') from error

    from viscorough.io import netcdf
    from viscorough.io.heights import surface_to_content
    from viscorough.io.refusals import path_named

    file = heights.path
    files.check_output(output, results=file)
    content = heights.content()
    if not heights.options and netcdf.is_netcdf(content) and netcdf.is_own(file, content):
        with path_named(file):
            plotting.plot(netcdf.read(file, content), output)
    else:
        indenter, _ = heights.indenter(heights.scan(content, dimensions=2))
        plotting.plot(surface_to_content(indenter), output)
    messages.announce(output, f"figure of {file.name}")
