"""`viscorough creep`: the medium of a half-space from the measured depth of an indenter."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from viscorough.cli.files import check_output, printable_name, read_curve
from viscorough.cli.messages import announce
from viscorough.cli.options import FILE, QuantityOption, force_history_option, number_in
from viscorough.summaries import si_unit, with_unit
from viscorough.units import Quantity


@click.command()
@click.argument("curve", type=FILE, metavar="CURVE.nc")
@click.argument("record", type=FILE, metavar="RECORD.csv")
@click.option("--force", type=QuantityOption("N"), help="Constant force F, applied at time 0.")
@force_history_option
@click.option(
    "--fit",
    type=click.Choice(["table", "prony", "springpot"]),
    default="table",
    help="Kind of medium: a table of J(t), a Prony series or a springpot.",
)
@click.option("-o", "--output", type=FILE, required=True, metavar="MEDIUM.yaml", help="File to write or replace.")
def creep(
    curve: Path, record: Path, *, force: Quantity | None, force_history: Path | None, fit: str, output: Path
) -> None:
    """The medium of a half-space from the measured depth of the indenter whose loading curve is in CURVE.nc.

    RECORD.csv has two columns, times and depths, with units in a heading as t [s],u [um] or plain numbers in s and in
    the unit of length of the curve. At a known depth the curve gives F/G, which is the creep, the integral of J(t - s)
    dF(s): at once the compliance J(t) for a constant force, else by inversion. MEDIUM.yaml is a medium for viscorough
    kinetics. A creep table stands in MEDIUM.csv, with the columns time, compliance, low and high: of all J that do not
    decrease and are concave, the one that fits best, and its interval of 95 % from the scatter of the record.

    A depth that recedes by more than the scatter, or that leaves the curve, is refused.

    \b
    Example:
        viscorough creep curve.nc record.csv --force "10 mN" -o rubber.yaml
    """
    if (force is None) == (force_history is None):
        raise click.UsageError("one of --force and --force-history is needed")

    from viscorough.io.columns import read_columns
    from viscorough.io.media import check_medium_file, save_identified
    from viscorough.io.motion import read_force_history
    from viscorough.viscous.identification import identify_medium

    table = check_medium_file(output)
    for path in (output, table):
        check_output(path, curve=curve, record=record, force_history=force_history)
    loading = read_curve(curve)
    unit = loading.length_unit
    times, depth = read_columns(record, "a record", {"time": "s", "depth": unit}, unit)
    history: Any = None
    if force is not None:
        history = stated = number_in("N", force, unit, "--force")
    elif force_history is not None:
        history, stated = read_force_history(force_history, unit), printable_name(force_history)
    identified = identify_medium(loading, history, times, depth, kind=fit)
    about = {"curve": printable_name(curve), "record": printable_name(record), "force": stated}
    save_identified(identified, output, **about, scatter=identified.scatter)
    first, last = identified.compliance[[1, -1]]
    largest = with_unit(last, si_unit("1/Pa", unit))
    text = f"J {first:.4g} to {largest} from time {identified.time[1]:.4g} to {times[-1]:.4g}"
    announce(output, f"{text}, scatter of depth {with_unit(identified.scatter, unit, 3)}")
