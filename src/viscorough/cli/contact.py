"""`viscorough contact`: a map of heights to the fields of contact at a given force or depth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from viscorough.cli.elasticity import elastic_constants_options, elasticity, forces_over_modulus, lengths
from viscorough.cli.files import write_output
from viscorough.cli.messages import announce
from viscorough.cli.options import Increasing, PositiveNumber, output_option, threads_option
from viscorough.cli.progress import progress_bar, progress_option
from viscorough.cli.surface_options import Surface, heights_input, read_indenter
from viscorough.summaries import si_unit, unit_power, with_unit
from viscorough.units import Quantity


@click.command()
@heights_input()
@output_option("FIELDS.nc", table=False)
@click.option("--force", type=Increasing("N"), help="Force, or several: F/G, or F with a modulus.")
@click.option("--depth", type=Increasing("m"), help="Depth from first contact, or several.")
@elastic_constants_options
@click.option("--tolerance", type=PositiveNumber(0.1), default=1e-3, help="Relative accuracy.")
@threads_option
@progress_option
def contact(
    surface: Surface,
    output: Path,
    *,
    force: Sequence[Quantity] | None,
    depth: Sequence[Quantity] | None,
    tolerance: float,
    threads: int,
    progress: bool,
    **constants: Any,
) -> None:
    """Pressure, gap and contact of an indenter pressed into an elastic half-space, at a given force or depth.

    HEIGHTS, spacing and units are as for viscorough indent; no loading curve is computed. Without a modulus,
    forces are F/G, in the unit of length squared. With --shear-modulus, or --young and --poisson, forces are in N
    and moduli in Pa if the unit of length is known, else all are in consistent units of your choice; a number may then
    have a unit, as "5 mN".

    FIELDS.nc has the dimensions y and x, and level if several forces or depths are given; the maps pressure = p/G
    (nan outside the indenter), gap, contact (0 or 1) and heights; and the numbers depth, force = F/G,
    stiffness = k/G, contact_fraction, contact_area, corrected_contact_area (less what whole elements at its edge
    add), mean_pressure, largest_pressure, residual and patches, the number of patches of contact, whose areas are in
    patch_area; with a modulus also normal_force F, normal_pressure p, mean_normal_pressure and
    largest_normal_pressure. G is the shear modulus of the incompressible half-space with the same
    E/(1 - nu^2) = 4 G.

    \b
    Example, a map in micrometres under F/G = 2 and under 3 square micrometres:
        viscorough contact heights.npy --spacing 0.5 --force 2,3 -o fields.nc
    """
    if (force is None) == (depth is None):
        raise click.UsageError("one of --force and --depth is needed")
    indenter = read_indenter(surface, output)
    unit = indenter.length_unit
    modulus, elastic_constants = elasticity(length_unit=unit, **constants)
    given: dict[str, Any]
    if depth is not None:
        given = {"depth": lengths(depth, unit, "--depth")}
    elif force is not None:
        given = {"force": forces_over_modulus(force, modulus, unit, "--force")}

    from viscorough.contact.one_contact import contact_at
    from viscorough.io.contacts import contacts_to_content

    with progress_bar("viscorough contact", progress) as report:
        contacts: Any = contact_at(indenter, tolerance=tolerance, progress=report, threads=threads, **given)
    if modulus is not None:
        contacts = [replace(each, shear_modulus=modulus) for each in contacts]
    content = contacts_to_content(contacts, indenter.heights)
    write_output(content, output, **surface.attributes(indenter), **elastic_constants)
    last, patches = contacts[-1], int(content.variables["patches"].values.flat[-1])
    depth, force = with_unit(last.depth, unit, 6), with_unit(last.force, unit_power(unit, 2), 6)
    text = f"depth {depth}, F/G {force}, contact fraction {last.contact_fraction:.4g}, "
    text += f"{patches} patch{'' if patches == 1 else 'es'}"
    if last.shear_modulus is not None:
        largest = with_unit(last.shear_modulus * last.largest_pressure, si_unit("Pa", unit))
        text += f", F {with_unit(last.normal_force, si_unit('N', unit), 6)}, largest p {largest}"
    announce(output, text if len(contacts) == 1 else f"{len(contacts)} levels, the last at {text}")
