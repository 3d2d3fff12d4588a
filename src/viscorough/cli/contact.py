"""`viscorough contact`: a map of heights to the fields of contact at a given force or depth."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from viscorough.cli import files, messages, options, surface_options
from viscorough.summaries import si_unit, unit_power, with_unit
from viscorough.units import Quantity


@click.command(short_help="Pressure, gap and contact at a given force or depth.")
@surface_options.heights_input()
@options.output("FIELDS.nc", table=False)
@click.option("--force", type=options.Increasing("N"), help="Force, or several: F/G, or F with a modulus.")
@click.option("--depth", type=options.Increasing("m"), help="Depth from first contact, or several.")
@options.elastic_constants
@options.tolerance
@options.threads
@options.progress
def contact(
    surface: surface_options.Surface,
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
    Example, a map in micrometres under F/G of 2 and of 3 square micrometres:
        viscorough contact heights.npy --spacing 0.5 --force 2,3 -o fields.nc
    """
    options.require((force is None) != (depth is None), "one of --force and --depth is needed")
    indenter = surface_options.read_indenter(surface, output)
    unit = indenter.length_unit
    modulus, elastic_constants = options.elasticity(length_unit=unit, **constants)

    from viscorough.contact.one_contact import contact_at
    from viscorough.io.contacts import contacts_to_content

    with messages.progress_bar("viscorough contact", progress) as report:
        where: dict[str, Any] = {"depth": depth, "force": force, "shear_modulus": modulus}
        contacts: Any = contact_at(indenter, **where, tolerance=tolerance, progress=report, threads=threads)
    content = contacts_to_content(contacts, indenter.heights)
    files.write_output(content, output, **surface.attributes(indenter), **elastic_constants)
    last, patches = contacts[-1], int(content.variables["patches"].values.flat[-1])
    text = f"depth {with_unit(last.depth, unit, 6)}, F/G {with_unit(last.force, unit_power(unit, 2), 6)}, "
    text += f"contact fraction {last.contact_fraction:.4g}, {patches} patch{'' if patches == 1 else 'es'}"
    if last.shear_modulus is not None:
        largest = with_unit(last.shear_modulus * last.largest_pressure, si_unit("Pa", unit))
        text += f", F {with_unit(last.normal_force, si_unit('N', unit), 6)}, largest p {largest}"
    messages.announce(output, text if len(contacts) == 1 else f"{len(contacts)} levels, the last at {text}")
