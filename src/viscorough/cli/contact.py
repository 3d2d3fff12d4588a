"""`viscorough contact`: compute contacts at given forces or depths, as fields or as a table."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options, surface_options


@click.command(cls=options.Command, short_help="Pressure, gap and contact at given forces or depths.")
@surface_options.heights_input()
@options.output("FILE")
@click.option("--force", type=options.Increasing("N"), help="Force, or several: F/G, or F with a modulus.")
@click.option("--depth", type=options.Increasing("m"), help="Depth from first contact, or several.")
@options.elastic_constants
@options.tolerance
@options.threads
@options.progress
def contact(
    heights: surface_options.HeightsFile,
    output: Path,
    *,
    force: Sequence[Quantity] | None,
    depth: Sequence[Quantity] | None,
    tolerance: float,
    threads: int,
    progress: bool | None,
    elastic: options.ElasticConstants,
) -> None:
    """Compute pressure, gap and contact of an indenter in an elastic half-space, at given forces or depths.

    HEIGHTS, spacing and units are as for viscorough indent; no loading curve is computed. Without a modulus,
    forces are F/G, in the unit of length squared. With --shear-modulus, or --young and --poisson, forces are in N and
    moduli in Pa if the unit of length is known; they may also have a unit, for example "5 mN". If the unit of length
    is not known, all numbers are in consistent units of your choice.

    If FILE ends in .nc, it holds fields. It has the dimensions y and x, and level if
    several forces or depths are given; the maps pressure = p/G (nan outside the indenter), gap, contact (0 or 1) and
    heights; and the numbers depth, force = F/G, stiffness = k/G, contact_fraction, contact_area,
    corrected_contact_area (less the excess that elements at the edge of the contact add), mean_pressure,
    largest_pressure, residual and patches (the number of contact patches), whose areas are in patch_area. With a
    modulus it also has normal_force F, normal_stiffness k, normal_pressure p, mean_normal_pressure and
    largest_normal_pressure. G is the shear modulus of the incompressible half-space with the same
    E/(1 - nu^2) = 4 G.

    If FILE ends in .csv, it is a table of these numbers, with one row for each force or depth: lengths in um, areas in
    um2 and, with a modulus, forces in N, stiffnesses in N/m and pressures in MPa. For many scans, run this command in a
    loop of the shell, or use the workflow (measured: in its settings).

    \b
    Example, a map in micrometres under F/G of 2 and of 3 um2, and under forces in N:
        viscorough contact heights.npy --spacing 0.5 --unit um --force 2,3 \\
            -o fields.nc
        viscorough contact scan.nc --force "1 mN,5 mN" --young "2 MPa" \\
            -o table.csv
    """
    options.require((force is None) != (depth is None), "one of --force and --depth is needed")
    indenter, unit = heights.read(output)
    modulus, elastic_attributes = elastic.converted(unit)

    from viscorough.contact.one_contact import contact_at
    from viscorough.io.contact_files import contacts_to_content
    from viscorough.io.contact_tables import table_of_contacts, table_to_content, text_of_last

    how: dict[str, Any] = {"tolerance": tolerance, "threads": threads}
    how |= {"force": options.forces(force, modulus, unit, "--force"), "depth": options.lengths(depth, unit, "--depth")}
    with messages.progress_bar("viscorough contact", progress) as report:
        contacts: Any = contact_at(indenter, **how, progress=report)
    table, is_table = table_of_contacts(contacts, modulus), output.suffix.lower() == ".csv"
    content = table_to_content(table) if is_table else contacts_to_content(contacts, indenter.heights, modulus)
    attributes = heights.attributes(indenter, unit) | elastic_attributes
    files.write_output(content, output, "m" if is_table else unit, **attributes)
    text = text_of_last(table)
    messages.announce(output, text if len(contacts) == 1 else f"{len(contacts)} levels, the last at {text}")
