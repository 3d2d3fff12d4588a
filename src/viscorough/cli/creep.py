"""`viscorough creep`: find the medium of a half-space from a measured indentation."""

from pathlib import Path

import click

from viscorough.basics import units
from viscorough.basics.summaries import si_unit, span
from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options
from viscorough.io import suffixes


@click.command(short_help="The medium from a measured depth or force over time.")
@click.argument("curve", type=options.FILE, metavar="CURVE.nc")
@click.argument("record", type=options.FILE, metavar="RECORD.csv")
@options.force
@options.force_history
@options.depth_history
@options.columns
@click.option(
    "--fit",
    type=click.Choice(["table", "prony", "springpot"]),
    default="table",
    help="Kind of medium: a table of J(t), a Prony series or a springpot.",
)
@click.option(
    "--scatter",
    type=options.QuantityOption("m", "N"),
    help="Standard deviation of the measured depth or force, such as '2 nm'  [default: found from the record]",
)
@click.option("--fit-offset", is_flag=True, help="Fit an error of the zero of the depth, too.")
@click.option("--fit-drift", is_flag=True, help="Fit a drift of the depth that is linear in time, too.")
@options.output("MEDIUM.yaml", allowed=suffixes.MEDIA)
def creep(
    curve: Path,
    record: Path,
    *,
    force: Quantity | None,
    force_history: Path | None,
    depth_history: Path | None,
    columns: dict[str, str] | None,
    fit: str,
    scatter: Quantity | None,
    fit_offset: bool,
    fit_drift: bool,
    output: Path,
) -> None:
    """Find the medium of a half-space from a measured indentation by the indenter with the loading curve in CURVE.nc.

    RECORD.csv has columns of times, and of measured depths or, with --depth-history, measured forces. A heading decides
    which columns these are, and may state units, such as t [s],u [um]; otherwise numbers are in s, N and the unit of
    length of the curve. Without a heading there are two columns, and times come first. RECORD.csv and a history may be
    the same file. The load may be held or removed: a record is, for example, a creep test, a relaxation test, or a
    force curve. A measured depth determines the creep compliance J(t), a measured force the relaxation modulus.

    MEDIUM.yaml is a medium for viscorough kinetics. A creep table is written to MEDIUM.csv, with the columns time,
    compliance, low and high: J and its interval of 95 %, which follows from the scatter of the record. If the force was
    measured, there is also a column relaxation_modulus, and low and high are the interval of this modulus. A short or
    very precise record does not determine its scatter; low and high are then missing, unless --scatter is given.

    An error of the zero of the depth leads to a wrong medium. The closing line states by how much J may change, unless
    --fit-offset determines the error. A warning is given if a Prony series or a springpot misses the record by more
    than the scatter. A record is refused if its depth exceeds the largest depth of the curve, or if its depth decreases
    by more than the scatter while the force does not decrease.

    \b
    Examples:
        viscorough creep curve.nc record.csv --force "10 mN" -o rubber.yaml
        viscorough creep curve.nc forces.csv --depth-history ramp_and_hold.csv \\
            --fit prony --fit-offset -o rubber.yaml
    """
    given = sum(each is not None for each in (force, force_history, depth_history))
    options.require(given == 1, "one of --force, --force-history and --depth-history is needed")

    import numpy as np

    from viscorough.io.columns import read_columns
    from viscorough.io.medium_files import check_medium_file, save_identified
    from viscorough.viscous.identification import identify_medium

    for path in (output, check_medium_file(output)):
        files.check_output(path, curve=curve, record=record, force_history=force_history, depth_history=depth_history)
    loading = files.read_curve(curve)
    unit = loading.length_unit
    measured, value_unit = ("depth", unit) if depth_history is None else ("force", "N")
    times, values = read_columns(record, "a record", {"time": "s", measured: value_unit}, unit, columns)
    load, about = files.load_from_options(force, force_history, unit, depth_history, columns)
    deviation = None if scatter is None else units.number(scatter, value_unit, unit, "--scatter")
    identified = identify_medium(
        loading, load, times, values, kind=fit, scatter=deviation, fit_offset=fit_offset, fit_drift=fit_drift
    )
    about |= {"curve": files.printable_name(curve), "record": files.printable_name(record)}
    about |= {"scatter": "unknown" if np.isnan(identified.scatter) else identified.scatter, "misfit": identified.misfit}
    about |= {name: value for name in ("offset", "drift") if not np.isnan(value := getattr(identified, name))}
    save_identified(identified, output, **about)
    ends = identified.time[[1, -1]]
    compliance = span(identified.medium.creep_compliance(ends), si_unit("1/Pa", unit))
    text = f"J {compliance} from time {ends[0]:.4g} to {ends[1]:.4g}, {identified.quality}, {identified.zero_of_depth}"
    messages.announce(output, text)
