"""`viscorough indent`: a map of heights to a loading curve."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

import viscorough
from viscorough.cli import files, messages, options, surface_options
from viscorough.summaries import with_unit
from viscorough.units import Quantity


@click.command(short_help="Loading curve of an indenter on an elastic half-space.")
@surface_options.heights_input()
@options.output("CURVE.nc")
@click.option(
    "--depths", type=options.Increasing("m"), help="Levels at exactly these depths  [default: as the tolerance needs]"
)
@click.option("--forces", type=options.Increasing("N"), help="Levels at exactly these F/G, or F with a modulus.")
@options.tolerance
@options.until(0.9)
@click.option("--until-force", type=options.QuantityOption("N"), help="F/G, or F with a modulus, at which to stop.")
@click.option("--audit", is_flag=True, help="Compare two integrals of the curve with their exact values.")
@options.elastic_constants
@options.threads
@options.progress
def indent(
    surface: surface_options.Surface,
    output: Path,
    *,
    depths: Sequence[Quantity] | None,
    forces: Sequence[Quantity] | None,
    tolerance: float,
    until_fraction: float,
    until_force: Quantity | None,
    audit: bool,
    threads: int,
    progress: bool,
    **constants: Any,
) -> None:
    """Loading curve of an indenter pressed into an elastic half-space.

    HEIGHTS is a map of heights: .npy, NetCDF, text (a matrix, an ESRI grid, columns x, y, z), TIFF, or a format of an
    instrument, for which pip install 'viscorough[formats]' is needed. Rows are along y, columns along x. Spacing and
    unit are those that the file states; where it states no unit, heights, spacing and depths are in one unit of length
    of your choice.

    Larger is higher: the highest point touches first. Points that are nan lie outside the indenter.

    CURVE.nc has the dimension "level" and the variables depth, force = F/G and stiffness = k/G (F the force,
    k its derivative with respect to depth, G the shear modulus of the incompressible half-space),
    contact_count, contact_fraction and residual. Their units are powers of the unit of the heights; if that is not
    stated, units are 1, which stands for the unit you chose.

    Without a modulus, forces are F/G, in the unit of length squared. With --shear-modulus, or --young and --poisson,
    forces are in N and moduli in Pa if the unit of length is known, else all are in consistent units of your choice; a
    number may then have a unit, as "5 mN". Results are F/G and k/G in any case, G being the shear modulus of the
    incompressible half-space with the same E/(1 - nu^2) = 4 G. The curve ends at the contact fraction or at the
    force, whichever comes first, or where all elements are in contact.

    With --audit the curve is followed to complete contact, and two integrals of it are compared with exact values from
    linear problems, in which no contact is solved. Contacts are solved to a hundredth of the tolerance, and levels are
    added until the estimated errors of the integrals are within the tolerance. If the integrals do not agree, a warning
    says so.

    \b
    Example:
        viscorough indent heights.npy --spacing 2e-6 --depths 1e-6,2e-6,4e-6 -o curve.nc
        viscorough indent scan.txt --spacing 0.37,0.5 --unit um --detrend plane -o curve.nc
    """
    levels = {"--depths": depths, "--forces": forces}
    others = {"--until-fraction": until_fraction, "--until-force": until_force, "--audit": audit or None}
    stated = [name for name, value in (levels | others).items() if value is not None]
    if len(stated) > 1:
        exclusive = f"{stated[0]} and {stated[-1]} exclude each other; one of them is allowed"
        options.require(stated[0] not in levels and not audit, exclusive)
    indenter = surface_options.read_indenter(surface, output)
    unit = indenter.length_unit
    modulus, elastic_constants = options.elasticity(length_unit=unit, **constants)
    given: dict[str, Any] = {"depths": depths, "forces": forces, "shear_modulus": modulus}
    if until_force is not None:
        given |= {"until_force": until_force, "until_fraction": 1.0}  # unless stated
    if until_fraction is not None:
        given["until_fraction"] = until_fraction

    from viscorough.io.curves import curve_to_content

    attributes, lines = surface.attributes(indenter) | elastic_constants, []
    with messages.progress_bar("viscorough indent", progress) as report:
        how: dict[str, Any] = {"tolerance": tolerance, "progress": report, "threads": threads}
        if audit:
            result = viscorough.audit(indenter, **how)
            curve, lines, attributes["audit"] = result.curve, str(result).splitlines(), str(result)
            if not result.agrees:
                messages.warn(lines[0])
        else:
            curve = viscorough.indent(indenter, **given, **how)
    content, depth = curve_to_content(curve, modulus), with_unit(curve.depth[-1], unit, 6)
    if modulus is not None:
        force = content.variables["normal_force"]
        depth += f", F {with_unit(force.values[-1], force.attributes['units'], 6)},"
    files.write_output(content, output, **attributes)
    count = f"{curve.contact_count[-1]} of {curve.elements} elements in contact"
    messages.announce(output, "\n".join([f"{curve.depth.size} levels, the last at depth {depth} with {count}", *lines]))
