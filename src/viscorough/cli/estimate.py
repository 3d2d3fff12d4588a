"""`viscorough estimate`: depth and velocity from the calibrated law alone."""

import warnings

import click

from viscorough.cli.messages import announce
from viscorough.cli.options import FILE, Increasing, PositiveNumber, write_output
from viscorough.errors import AccuracyWarning


@click.command(short_help="Depth and velocity of a self-affine surface by the calibrated law, without a simulation.")
@click.option("--hurst", type=PositiveNumber(1), required=True, help="Hurst exponent H, from 0.1 to 0.9.")
@click.option("--rms", type=PositiveNumber(), required=True, help="Rms height h of the surface.")
@click.option("--diameter", type=PositiveNumber(), required=True, help="Diameter L of the indenter.")
@click.option("--force", type=PositiveNumber(), required=True, help="Constant force F, applied at time 0.")
@click.option("--viscosity", type=PositiveNumber(), help="Shear viscosity of a Newtonian half-space.")
@click.option("--times", type=Increasing(), required=True, help="Times at which depth and velocity are wanted.")
@click.option("-o", "--output", type=FILE, metavar="FILE", help="NetCDF file or table (.csv) to write  [default: none]")
def estimate(hurst, rms, diameter, force, viscosity, times, output):
    """Depth and velocity of a self-affine indenter without a simulation, from the calibrated penetration law.

    The law, vt/h = X^beta/zeta with X = Ft/(4 viscosity h L), was calibrated with boundary elements on discs of 257
    elements across. It gives the mean of many surfaces, with a 95 % interval of this mean; a single surface scatters
    more. It holds from the first few contact spots until the contact is nearly complete; outside of that range no
    number is given, and the last column says on which side the time is.

    Lengths, force and viscosity are in consistent units: m, N and Pa s, for example.

    \b
    Example:
        viscorough estimate --hurst 0.8 --rms 1e-6 --diameter 0.01 --force 10 --viscosity 1e6 --times 1e-3,1e-2,0.1
    """
    import numpy as np

    from viscorough.estimates import estimate
    from viscorough.io.atomic import check_output
    from viscorough.io.motion import estimate_to_content

    if output:
        check_output(output)
    result = estimate(hurst, rms, diameter, force, viscosity, times)
    law, outside = result.law, np.count_nonzero(result.where != "")
    if outside:
        text = f"{outside} of {len(times)} times are outside the range of the law"
        text += f", X from {law.x_low:.3g} to {law.x_high:.3g}; elsewhere indent a surface made by viscorough generate"
        warnings.warn(text, AccuracyWarning, stacklevel=2)
    if not output:
        click.echo(_heading(law))
        click.echo(str(result))
        return
    about = {"hurst": hurst, "rms": rms, "diameter": diameter, "force": force, "viscosity": viscosity}
    write_output(estimate_to_content(result), output, **about)
    announce(output, f"{len(times)} times, {len(times) - outside} in the range of the law")


def _heading(law):
    (low, high), (least, most) = law.beta_interval, law.zeta_interval
    return (
        f"vt/h = X^beta/zeta for H = {law.hurst:g}: beta {law.beta:.4g} [{low:.4g}, {high:.4g}], "
        f"zeta {law.zeta:.4g} [{least:.4g}, {most:.4g}], X from {law.x_low:.3g} to {law.x_high:.3g}"
    )
