"""`viscorough estimate`: estimate depth and velocity from the calibrated law."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from viscorough.basics import units
from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options

if TYPE_CHECKING:
    from viscorough.law.estimate import Estimate


@click.command(
    cls=options.Command,
    short_help="Depth and velocity of a self-affine surface by the calibrated law, without a simulation.",
)
@click.option("--hurst", type=options.PositiveNumber(1), required=True, help="Hurst exponent H, from 0.1 to 1.")
@click.option("--rms", type=options.QuantityOption("m"), required=True, help="Rms height h of the surface.")
@click.option("--diameter", type=options.QuantityOption("m"), required=True, help="Diameter L of the indenter.")
@click.option("--force", type=options.QuantityOption("N"), required=True, help="Constant force F, applied at time 0.")
@options.viscosity
@options.medium
@click.option("--times", type=options.Increasing(), required=True, help="Times of the output.")
@options.output("FILE", required=False)
def estimate(
    *,
    hurst: float,
    rms: Quantity,
    diameter: Quantity,
    force: Quantity,
    viscosity: Quantity | None,
    medium: Path | None,
    times: list[float],
    output: Path | None,
) -> None:
    """Estimate depth and velocity of a self-affine indenter without a simulation, from the calibrated law.

    The law for the velocity v at the time t is vt/h = X + g(X) with X = Ft/(4 viscosity h L). It was calibrated with
    boundary elements on discs of 257 elements across; while few spots touch, it is close to a power law, X^beta/zeta.
    In a medium with the creep compliance J(t), X is F J(t)/(4 h L). Depth and velocity are arithmetic means of many
    surfaces; the last line states the interval of the mean. Single surfaces deviate more.

    The law is used in a limited range of X: from the first few contact spots until the whole disc sinks almost like a
    flat punch. The range was chosen so that g is within 5 % of its mean over discs that were not used for the
    calibration. Outside this range no number is given, and the last column states on which side X lies. The
    documentation states how far means over further discs differ from the law (Verification, The calibrated law).

    Plain numbers are in consistent units: m, N and Pa s, for example. Depth is then in the unit of --rms, velocity in
    the unit of --rms per unit of --times. If --rms and --diameter have units, for example --rms "2 um", force and
    viscosity may have units, too. Results are then in m and s, and plain numbers are in N, Pa s and s.

    \b
    Example:
        viscorough estimate --hurst 0.8 --rms 1e-6 --diameter 0.01 --force 10 \\
            --viscosity 1e9 --times 0.01,0.1
    """
    import numpy as np

    from viscorough.io.motion_files import estimate_to_content
    from viscorough.viscous.estimate import estimate

    options.require((viscosity is None) != (medium is None), "one of --viscosity and --medium is needed")
    if output:
        files.check_output(output, medium=medium)
    same_kind = f"--rms {rms}, --diameter {diameter}: one has a unit; both or none is allowed"
    options.require(bool(rms.unit) == bool(diameter.unit), same_kind)
    unit = "m" if rms.unit else units.UNKNOWN
    half_space, about = files.read_half_space(viscosity, medium, unit)
    stated = {"rms": (rms, "m"), "diameter": (diameter, "m"), "force": (force, "N")}
    numbers = {name: units.in_si(given, needed, unit, f"--{name}") for name, (given, needed) in stated.items()}
    result = estimate(hurst, medium=half_space, times=times, **numbers)
    law, outside = result.law, np.count_nonzero(result.where != "")
    if outside:
        text = f"{outside} of {len(times)} times are outside the range of the law"
        text += f", X from {law.x_low:.3g} to {law.x_high:.3g}; elsewhere indent a surface made by viscorough generate"
        messages.warn(text)
    if output:
        files.write_output(estimate_to_content(result, unit), output, unit, hurst=hurst, **numbers, **about)
        messages.announce(output, f"{len(times)} times, {len(times) - outside} in the range of the law")
    else:
        _print(result, unit)


def _print(result: Estimate, unit: str) -> None:
    """Write the law, the units of the table, and the table to standard output."""
    from viscorough.law.calibrated_law import ACROSS

    law = result.law
    (low, high), (least, most), region = law.beta_interval, law.zeta_interval, law.region
    click.echo(
        f"vt/h = X + g(X) for H = {law.hurst:g}, X from {law.x_low:.3g} to {law.x_high:.3g}, discs of {ACROSS} "
        f"elements across; X^beta/zeta from {region[0]:.3g} to {region[1]:.3g}: "
        f"beta {law.beta:.4g} [{low:.4g}, {high:.4g}], zeta {law.zeta:.4g} [{least:.4g}, {most:.4g}]"
    )
    si = "time [s], depth [m], velocity [m/s]"
    plain = "time in the unit of --times, depth in the unit of --rms, velocity in that unit per unit of time"
    click.echo(plain if unit == units.UNKNOWN else si)
    click.echo(str(result))
