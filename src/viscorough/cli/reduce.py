"""`viscorough reduce`: compute the loading curve of a line of independent springs."""

from pathlib import Path
from typing import Any

import click

from viscorough.basics.summaries import with_unit
from viscorough.cli import files, messages, options, surface_options

_LIMITS_OF_LINES = (
    "lines with a map's spectrum give the mean stiffness of many such surfaces, to about 20 %, not the curve of this "
    "surface, by a factor of 1.2 to 2, nor its contact area; viscorough indent computes those"
)


@click.command(cls=options.Command, short_help="Loading curve by the method of dimensionality reduction (MDR).")
@surface_options.heights_input("line_or_map")
@options.until("1")
@click.option("--realizations", type=click.IntRange(1, 100_000), help="Lines to make of a map  [default: 1]")
@click.option("--seed", type=click.IntRange(min=0), help="Seed of the lines that are made of a map  [default: 0]")
@options.output("CURVE.nc")
@options.progress
def reduce(
    heights: surface_options.HeightsFile,
    until_fraction: float,
    realizations: int | None,
    seed: int,
    output: Path,
    progress: bool,
) -> None:
    """Compute the loading curve of a line by the method of dimensionality reduction (MDR).

    LINE_OR_MAP is a file with the heights of a line: NetCDF, as viscorough generate --points makes it, .npy, or a text
    with one column of heights. Independent springs replace the half-space. LINE_OR_MAP can also be a map, as for
    viscorough indent. Lines are then made with the radially averaged power spectrum and the rms height of the map, and
    with random phases.

    Limits: a measured profile is a cut through a surface, for which this method does not hold; it is too stiff by a
    factor of 1.1 to 1.6. A line made from a map represents random surfaces with its spectrum, not the map itself. The
    mean stiffness of many surfaces is right to about 20 %. The stiffness of a single surface is wrong by a factor of
    1.2 to 2, and contact area and contact positions have no meaning.

    CURVE.nc is as for viscorough indent; with several --realizations its dimensions are realization and level.

    \b
    Example:
        viscorough generate --hurst 0.8 --points 100000 --rms 2e-7 --diameter 1e-4 \\
            --seed 1 -o line.nc
        viscorough reduce line.nc -o curve.nc
        viscorough reduce map.nc --realizations 100 -o curves.nc
    """
    from viscorough import mdr
    from viscorough.io.curves import curve_to_content, stack_curves
    from viscorough.io.heights import line_of
    from viscorough.io.scan import in_metres

    line_or_map = heights.path
    files.check_output(output, heights=line_or_map)
    content = heights.content()
    scan = heights.scan(content, dimensions=None)
    if scan.heights.ndim == 1:
        text = "--realizations and --seed are for maps, of which lines are made; this is a line"
        options.require(not realizations and seed is None, text)
        text = "--channel and preparation are for maps; this is a line"
        options.require(heights.options.keys() <= {"spacing", "unit"}, text)
        about = {"heights": files.printable_name(line_or_map)}
        line, unit = line_of(line_or_map, content, scan, **heights.arguments)
        lines: Any = [in_metres(line, unit)]
    else:
        no_table = "--realizations: several curves are no table; a NetCDF file (.nc) is needed"
        options.require((realizations or 1) == 1 or output.suffix.lower() != ".csv", no_table)
        indenter, unit = heights.indenter(scan)
        about = heights.attributes(indenter, unit) | {"realizations": realizations or 1, "seed": seed or 0}
        lines = (mdr.line_of_map(indenter, [seed or 0, index]) for index in range(realizations or 1))
        messages.warn(_LIMITS_OF_LINES)
    curves = []
    with messages.progress_bar("viscorough reduce", progress) as report:
        for line in lines:
            curves.append(mdr.reduce(line, until_fraction=until_fraction or 1.0))
            report(len(curves) / (realizations or 1))
    first = curves[0]
    content = curve_to_content(first) if len(curves) == 1 else stack_curves(curves)
    files.write_output(content, output, unit, **about)
    several = f"{len(curves)} curves, the first with " if len(curves) > 1 else ""
    depth = with_unit(first.depth[-1], first.length_unit, 6)
    count = f"{first.contact_count[-1]} of {first.elements} points in contact"
    messages.announce(output, f"{several}{first.depth.size} levels, the last at depth {depth} with {count}")
