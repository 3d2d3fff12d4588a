"""`viscorough contact`: compute contacts at given forces or depths, as fields for one map or as a table for many."""

import functools
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options, scans, surface_options


@click.command(short_help="Pressure, gap and contact at given forces or depths, of one or many files.")
@surface_options.heights_input(several=True)
@options.output("FILE")
@click.option("--force", type=options.Increasing("N"), help="Force, or several: F/G, or F with a modulus.")
@click.option("--depth", type=options.Increasing("m"), help="Depth from first contact, or several.")
@options.elastic_constants
@options.tolerance
@options.grid_error
@options.jobs
@options.threads
@options.progress
def contact(
    inputs: Sequence[surface_options.HeightsFile],
    output: Path,
    *,
    force: Sequence[Quantity] | None,
    depth: Sequence[Quantity] | None,
    tolerance: float,
    grid_error: bool,
    jobs: int,
    threads: int,
    progress: bool | None,
    **constants: Any,
) -> None:
    """Compute pressure, gap and contact of indenters in an elastic half-space, at given forces or depths.

    HEIGHTS, spacing and units are as for viscorough indent; no loading curve is computed. Without a modulus,
    forces are F/G, in the unit of length squared. With --shear-modulus, or --young and --poisson, forces are in N and
    moduli in Pa if the unit of length is known; they may also have a unit, for example "5 mN". If the unit of length
    is not known, all numbers are in consistent units of your choice.

    If FILE ends in .nc, it holds the fields of one file of heights. It has the dimensions y and x, and level if
    several forces or depths are given; the maps pressure = p/G (nan outside the indenter), gap, contact (0 or 1) and
    heights; and the numbers depth, force = F/G, stiffness = k/G, contact_fraction, contact_area,
    corrected_contact_area (less the excess that elements at the edge of the contact add), mean_pressure,
    largest_pressure, residual and patches (the number of contact patches), whose areas are in patch_area. With a
    modulus it also has normal_force F, normal_stiffness k, normal_pressure p, mean_normal_pressure and
    largest_normal_pressure. G is the shear modulus of the incompressible half-space with the same
    E/(1 - nu^2) = 4 G.

    If FILE ends in .csv, it is a table of one or more files of heights. The numbers listed above are in one row for
    each file and load: lengths in um, areas in um2 and, with a modulus, forces in N, stiffnesses in N/m and pressures
    in MPa. With --grid-error the table also has the estimated errors due to the spacing of the map, as for viscorough
    indent; this takes several times as long. A file that cannot be evaluated has a row with the reason in the column
    error; the other files are evaluated, and the exit code is 3. If you run the same command again, also after an
    interrupt, unchanged files are not evaluated again. For a thousand scans use the workflow instead (measured: in its
    settings), which runs on clusters, and continues after errors.

    \b
    Example, a map in micrometres under F/G of 2 and of 3 um2, and a folder of scans:
        viscorough contact heights.npy --spacing 0.5 --force 2,3 -o fields.nc
        viscorough contact scans/*.csv --force "1 mN,5 mN" --young "2 MPa" \\
            -o table.csv
    """
    options.require((force is None) != (depth is None), "one of --force and --depth is needed")
    options.elasticity(length_unit="m", **constants)  # raises an error if these constants contradict each other
    how: dict[str, Any] = {"force": force, "depth": depth, "tolerance": tolerance}
    if output.suffix.lower() == ".csv":
        how["grid_error"] = grid_error
        evaluate = functools.partial(scans.rows_for_options, **how, constants=constants, threads=threads)
        settings = how | constants | {"grid_error": grid_error or None}
        scans.tabulate(inputs, output, evaluate, settings=settings, jobs=jobs, progress=progress)
        return
    text = "--grid-error is for tables; -o TABLE.csv, or viscorough indent --forces, is allowed"
    options.require(not grid_error, text)
    file = scans.only_one(inputs, output)
    indenter = surface_options.read_indenter(file, output)
    modulus, elastic_constants = options.elasticity(length_unit=indenter.length_unit, **constants)

    from viscorough.contact.one_contact import contact_at
    from viscorough.io.contact_files import contacts_to_content
    from viscorough.io.contact_tables import rows_of_contacts, text_of_row

    with messages.progress_bar("viscorough contact", progress) as report:
        contacts: Any = contact_at(indenter, **how, shear_modulus=modulus, progress=report, threads=threads)
    content = contacts_to_content(contacts, indenter.heights)
    files.write_output(content, output, **file.attributes(indenter), **elastic_constants)
    rows, units = rows_of_contacts(contacts[-1:])
    text = text_of_row(rows[-1], units)
    messages.announce(output, text if len(contacts) == 1 else f"{len(contacts)} levels, the last at {text}")
