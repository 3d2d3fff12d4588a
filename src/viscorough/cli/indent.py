"""`viscorough indent`: compute the loading curve of a map of heights."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

import viscorough
from viscorough.basics.summaries import with_unit
from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options, surface_options


@click.command(cls=options.Command, short_help="Loading curve of an indenter on an elastic half-space.")
@surface_options.heights_input()
@options.output("CURVE.nc")
@click.option("--depths", type=options.Increasing("m"), help="Levels at exactly these depths.")
@click.option("--forces", type=options.Increasing("N"), help="Levels at exactly these F/G, or F if G is given.")
@options.tolerance
@click.option("--grid-error", is_flag=True, help="Estimate the error due to the map's spacing.")
@options.until("0.9, or 1 with --until-force")
@click.option("--until-force", type=options.QuantityOption("N"), help="F/G, or F with a modulus, at which to stop.")
@options.elastic_constants
@options.threads
@options.progress
def indent(
    heights: surface_options.HeightsFile,
    output: Path,
    *,
    depths: Sequence[Quantity] | None,
    forces: Sequence[Quantity] | None,
    tolerance: float,
    grid_error: bool,
    until_fraction: float | None,
    until_force: Quantity | None,
    threads: int,
    progress: bool | None,
    elastic: options.ElasticConstants,
) -> None:
    """Compute the loading curve of an indenter pressed into an elastic half-space.

    HEIGHTS is a map of heights: a matrix (.npy, or text with one delimiter), NetCDF, or a binary file of an instrument,
    which needs pip install "viscorough[formats]". x runs along each row, y from row to row. Spacing and unit are read
    from the file if it states them; a matrix needs --spacing and --unit. A spacing without a unit is in the unit of
    the heights. With --unit 1, heights, spacing and depths are in one unit of length of your choice.

    Larger is higher: the highest point touches first. Points that are nan lie outside the indenter.

    CURVE.nc has the dimension "level" and the variables depth, force = F/G and stiffness = k/G (F the force,
    k its derivative with respect to depth, G the shear modulus of the incompressible half-space),
    contact_count, contact_fraction and residual. The units of depth, force and stiffness are powers of the unit of the
    heights. If no unit is stated, these units are 1, which means the unit you chose.

    Without a modulus, forces are F/G, in the unit of length squared. With --shear-modulus, or --young and --poisson,
    forces are in N and moduli in Pa if the unit of length is known; they may also have a unit, for example "5 mN". If
    the unit of length is not known, all numbers are in consistent units of your choice. Results are F/G and k/G in any
    case, G being the shear modulus of the incompressible half-space with the same E/(1 - nu^2) = 4 G. The curve ends at
    --until-fraction or at --until-force, whichever comes first, or when all elements are in contact.

    With --grid-error a second curve is computed on every second point of the map. The difference of the two curves
    estimates the errors due to the spacing of the map: grid_error is the error of the velocity at the force of each
    level, and force_grid_error the error of the force at the depth of each level. area_change is the relative change of
    the contact area if the spacing is halved.

    \b
    Example:
        viscorough indent heights.npy --spacing 2 --unit um --depths 1,2,4 \\
            -o curve.nc
        viscorough indent scan.txt --spacing 0.37,0.5 --unit um --detrend plane \\
            -o curve.nc
    """
    _check_exclusive(
        {"--depths": depths, "--forces": forces}, {"--until-fraction": until_fraction, "--until-force": until_force}
    )
    indenter, unit = heights.read(output)
    modulus, elastic_attributes = elastic.converted(unit)
    how: dict[str, Any] = {"tolerance": tolerance, "estimate_grid_error": grid_error, "threads": threads}
    how["depths"] = options.lengths(depths, unit, "--depths")
    how["forces"] = options.forces(forces, modulus, unit, "--forces")
    how["until_fraction"] = until_fraction or (0.9 if until_force is None else 1.0)
    stop = options.forces(None if until_force is None else [until_force], modulus, unit, "--until-force")
    how["until_force"] = stop[0] if stop else math.inf

    from viscorough.io.curves import curve_to_content

    with messages.progress_bar("viscorough indent", progress) as report:
        curve = viscorough.indent(indenter, **how, progress=report)
    attributes = heights.attributes(indenter, unit) | elastic_attributes
    files.write_output(curve_to_content(curve, modulus), output, unit, **attributes)
    lines = [_last_level(curve, indenter, modulus), curve.grid_error_text]
    messages.announce(output, "\n".join(filter(None, lines)))


def _check_exclusive(levels: dict[str, Any], ends: dict[str, Any]) -> None:
    """Raise UsageError for options that exclude each other: two that choose the levels, or one and an end of the curve.

    levels, ends : {option: its value, or None if it is not given}
    """
    stated = [name for name, value in (levels | ends).items() if value is not None]
    if len(stated) > 1:
        exclusive = f"{stated[0]} and {stated[-1]} exclude each other; one of them is allowed"
        options.require(stated[0] not in levels, exclusive)


def _last_level(curve: viscorough.LoadingCurve, indenter: viscorough.Indenter, modulus: float | None) -> str:
    """Return a text for the closing line: the number of levels, and the results at the last level."""
    depth = with_unit(curve.depth[-1], curve.length_unit, 6)
    text = f"{curve.depth.size} levels, the last at depth {depth}"
    if modulus is not None:
        from viscorough.io.contact_tables import result_units

        read, area = result_units(curve.length_unit, modulus), indenter.spacing * indenter.row_spacing
        text += f", F {read['force'].text(curve.force[-1], 6)}, k {read['stiffness'].text(curve.stiffness[-1])}"
        text += f", contact area {read['area'].text(curve.contact_count[-1] * area)},"
    return f"{text} with {curve.contact_count[-1]} of {curve.elements} elements in contact"
