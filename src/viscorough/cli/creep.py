"""`viscorough creep`: the medium of a half-space from a measured indentation."""

from pathlib import Path

import click

from viscorough import units
from viscorough.cli import files, messages, options
from viscorough.io import suffixes
from viscorough.summaries import si_unit, span
from viscorough.units import Quantity


@click.command(short_help="The medium from a measured depth or force over time.")
@click.argument("curve", type=options.FILE, metavar="CURVE.nc")
@click.argument("record", type=options.FILE, metavar="RECORD.csv")
@options.force
@options.force_history
@click.option(
    "--fit",
    type=click.Choice(["table", "prony", "springpot"]),
    default="table",
    help="Kind of medium: a table of J(t), a Prony series or a springpot.",
)
@click.option(
    "--scatter",
    type=options.QuantityOption("m"),
    help="Standard deviation of the measured depth, such as '2 nm'  [default: found from the record]",
)
@options.output("MEDIUM.yaml", allowed=suffixes.MEDIA)
def creep(
    curve: Path,
    record: Path,
    *,
    force: Quantity | None,
    force_history: Path | None,
    fit: str,
    scatter: Quantity | None,
    output: Path,
) -> None:
    """The medium of a half-space from the measured depth of the indenter whose loading curve is in CURVE.nc.

    RECORD.csv has two columns, times and depths, with units in a heading as t [s],u [um] or plain numbers in s and in
    the unit of length of the curve. At a known depth the curve gives F/G, which equals the creep response, the integral
    of J(t - s) dF(s): at once the compliance J(t) for a constant force, else by inversion. MEDIUM.yaml is a medium for
    viscorough kinetics. A creep table is written to MEDIUM.csv, with the columns time, compliance, low and high: of all
    J that do not decrease and are concave, the one that fits best, and its interval of 95 % from the scatter of the
    record. Short or very precise records do not determine the scatter: low and high are nan then, unless --scatter
    states it.

    A warning says if a Prony series or a springpot misses the record by more than the scatter. A depth that recedes by
    more than the scatter, or that leaves the curve, is refused.

    \b
    Example:
        viscorough creep curve.nc record.csv --force "10 mN" -o rubber.yaml
    """
    options.require((force is None) != (force_history is None), "one of --force and --force-history is needed")

    import numpy as np

    from viscorough.io.columns import read_columns
    from viscorough.io.media import check_medium_file, save_identified
    from viscorough.viscous.identification import identify_medium

    for path in (output, check_medium_file(output)):
        files.check_output(path, curve=curve, record=record, force_history=force_history)
    loading = files.read_curve(curve)
    unit = loading.length_unit
    times, depth = read_columns(record, "a record", {"time": "s", "depth": unit}, unit)
    load, about = files.read_load(force, force_history, unit)
    deviation = None if scatter is None else units.number(scatter, unit, unit, "--scatter")
    identified = identify_medium(loading, load, times, depth, kind=fit, scatter=deviation)
    about |= {"curve": files.printable_name(curve), "record": files.printable_name(record)}
    about |= {"scatter": "unknown" if np.isnan(identified.scatter) else identified.scatter, "misfit": identified.misfit}
    save_identified(identified, output, **about)
    ends = identified.time[[1, -1]]
    compliance = span(identified.medium.creep_compliance(ends), si_unit("1/Pa", unit))
    messages.announce(output, f"J {compliance} from time {ends[0]:.4g} to {ends[1]:.4g}, {identified.quality}")
