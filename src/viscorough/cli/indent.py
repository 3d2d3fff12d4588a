"""`viscorough indent`: a map of heights to a loading curve."""

import click

from viscorough.cli.messages import announce
from viscorough.cli.options import (
    FILE,
    Increasing,
    PositiveNumber,
    output_option,
    printable_name,
    read_indenter,
    spacing_option,
    write_output,
)


@click.command(short_help="Loading curve of an indenter on an elastic half-space.")
@click.argument("heights", type=FILE)
@spacing_option
@output_option("CURVE.nc")
@click.option("--depths", type=Increasing(), help="Levels at exactly these depths  [default: as the tolerance needs]")
@click.option("--tolerance", type=PositiveNumber(0.1), default=1e-3, show_default=True, help="Relative accuracy.")
@click.option("--until-fraction", type=PositiveNumber(1), help="Contact fraction at which to stop  [default: 0.9]")
def indent(heights, spacing, output, *, depths, tolerance, until_fraction):
    """Loading curve of an indenter pressed into an elastic half-space.

    HEIGHTS is a .npy or NetCDF (.nc) file with a two-dimensional map of heights; in a NetCDF file it is the variable
    "heights" or the only two-dimensional one. Larger is higher: the highest point touches first. Points that are
    nan lie outside the indenter. Heights, spacing and depths are in one unit of length of your choice.

    CURVE.nc has the dimension "level" and the variables depth, force = F/G and stiffness = k/G (F the force,
    k its derivative with respect to depth, G the shear modulus of the incompressible half-space),
    contact_count, contact_fraction and residual. Their units are powers of the unit that a NetCDF file states
    for the heights; if none is stated, units are 1, which stands for the unit you chose.

    \b
    Example:
        viscorough indent heights.npy --spacing 2e-6 --depths 1e-6,2e-6,4e-6 -o curve.nc
    """
    if depths is not None and until_fraction is not None:
        raise click.UsageError("--depths and --until-fraction exclude each other; one of them is allowed")
    indenter = read_indenter(heights, spacing, output)

    from viscorough.contact.loading_path import indent
    from viscorough.io.curves import curve_to_content

    stop = {"until_fraction": until_fraction} if until_fraction else {}
    curve = indent(indenter, tolerance=tolerance, depths=depths, **stop)
    write_output(curve_to_content(curve), output, heights=printable_name(heights), spacing=spacing)
    count = f"{curve.contact_count[-1]} of {curve.elements} elements in contact"
    announce(output, f"{curve.depth.size} levels, the last at depth {curve.depth[-1]:.6g} with {count}")
