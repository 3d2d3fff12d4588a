"""`viscorough kinetics`: compute penetration over time from a loading curve."""

from pathlib import Path
from typing import Any

import click

import viscorough
from viscorough.basics.summaries import si_unit, with_unit
from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options

_CORRESPONDENCE = (
    "row of unilateral springs of the loading curve; while the contact grows, depth at a time is the elastic one at "
    "F/G = integral of J(t - s) dF(s), velocity its derivative over k/G; exact for every topography, without "
    "1/Gamma(2 - alpha)"
)


@click.command(cls=options.Command, short_help="Penetration over time in any linear viscoelastic half-space.")
@click.argument("curve", type=options.FILE, metavar="CURVE.nc")
@click.option("--force", type=options.QuantityOption("N"), help="Constant force F, applied at time 0.")
@options.force_history
@click.option(
    "--depth-history",
    type=options.FILE,
    metavar="DEPTH.csv",
    help="Columns time (s) and depth (um), instead of a force: linear in between; a time given twice is a step. A "
    "depth below 0 lifts the indenter.",
)
@options.columns
@options.viscosity
@options.medium
@click.option(
    "--times",
    type=options.Times(),
    metavar="A,B,C or FIRST:LAST:COUNT",
    help="Times of the output, or so many equally spaced times  [default: a hundred, or those of the history]",
)
@options.output("KIN.nc")
def kinetics(
    curve: Path,
    *,
    force: Quantity | None,
    force_history: Path | None,
    depth_history: Path | None,
    columns: dict[str, int] | None,
    viscosity: Quantity | None,
    medium: Path | None,
    times: list[float] | None,
    output: Path,
) -> None:
    """Compute penetration over time of the indenter with the loading curve in CURVE.nc.

    A history may load, hold, unload and reload; with --depth-history the depth is given, and the force is computed.
    KIN.nc holds time, depth, velocity, force and contact fraction.

    Without --times, the output has the times of the history. A history of few rows, such as a ramp and a hold, thus
    needs --times to give a smooth curve. Under a constant force, the output has a hundred times at equal ratios. These
    times reach from the first to the last level of the curve, or until creep has almost ended. They start after time 0
    if the medium responds elastically at t = 0.

    While the contact grows, the depth is read from the curve at F/G equal to the creep response, the integral of
    J(t - s) dF(s) with the creep compliance J. On a linearly viscous half-space this integral is the impulse divided by
    the viscosity. When the contact recedes, independent springs with the same curve replace the indenter, which is
    exact as well. Without a force, the indenter rests on the recovering surface. If the curve states a grid error,
    KIN.nc and the closing line state an error, too: the error of the velocity if the force is given, or the error of
    the force at the largest depth if the depth is given.

    MEDIUM.yaml is one mapping with the kind of the medium and its parameters, as {kind: maxwell, shear_modulus: 2 MPa,
    viscosity: 1 kPa s}. The documentation has a table of all kinds (Theory, Viscoelastic media), and an unknown kind
    or key is answered with those that are allowed. Moduli are shear moduli. Young's moduli E = 3 G may be given
    instead, as young_modulus or relaxed_young_modulus; the key poisson may then state the Poisson ratio, by default
    0.5.

    If the unit of length of the curve is known, forces are in N, moduli in Pa and viscosities in Pa s. They may also
    have another unit, as in --viscosity "2 kPa s" or in the headings time (ms),force (mN) of a force history. If the
    unit of length is not known, all are plain numbers in consistent units; for heights in metres these are N, Pa and
    Pa s.

    \b
    Examples:
        viscorough kinetics curve.nc --force 5 --viscosity 1e6 -o kinetics.nc
        viscorough kinetics curve.nc --force-history ramp.csv --medium rubber.yaml \\
            --times 1,10,100 -o kinetics.nc
        viscorough kinetics curve.nc --depth-history approach_retract.csv \\
            --medium rubber.yaml --times 0:2:201 -o loop.nc
    """
    given = sum(each is not None for each in (force, force_history, depth_history))
    options.require(given == 1, "exactly one of --force, --force-history and --depth-history is needed")
    options.require((viscosity is None) != (medium is None), "exactly one of --viscosity and --medium is needed")

    import numpy as np

    from viscorough.io.motion_files import motion_to_content

    files.check_output(output, curve=curve, force_history=force_history, depth_history=depth_history, medium=medium)
    loading, unit = files.read_curve(curve)
    half_space, about = files.read_half_space(viscosity, medium, unit)
    load, load_attributes = files.load_from_options(force, force_history, unit, depth_history, columns)
    grid_error, error_attributes = _stated_grid_error(loading, load)
    about |= error_attributes
    motion = viscorough.kinetics(loading, load, half_space, times)
    unknown = np.count_nonzero(~np.isfinite(motion.depth + motion.force + motion.velocity))
    if unknown == motion.time.size:
        raise ValueError(
            "all times are before the curve's first level; later ones (--times) are needed, or an earlier level"
        )
    if unknown:
        text = f"at {unknown} of {motion.time.size} times depth, force or velocity are missing: before the first level "
        messages.warn(f"{text}of the curve, or where a step in a springpot has no bound")
    content = motion_to_content(motion)
    files.write_output(content, output, unit, **about, **load_attributes, correspondence=_CORRESPONDENCE)
    depth = f"depth {with_unit(motion.depth[-1], motion.length_unit, 6)}"
    if depth_history is not None:
        depth += f" and force {with_unit(motion.force[-1], si_unit('N', unit), 6)}"
    time = with_unit(motion.time[-1], si_unit("s", unit), 6)
    text = f"{motion.time.size} times, {depth} at time {time}"
    messages.announce(output, "\n".join(filter(None, [text, grid_error])))


def _stated_grid_error(curve: "viscorough.LoadingCurve", load: Any) -> tuple[str, dict[str, float]]:
    """Return the estimated grid error as a text and as attributes; "" and {} if the curve states no grid error.

    If the load is a force, the result is the error of the velocity. If the load is a depth, the result is the error of
    the elastic force at the largest depth.
    """
    import numpy as np

    if curve.mean_grid_error is None or curve.force_grid_error is None:
        return "", {}
    if not (isinstance(load, viscorough.Load) and load.by_depth):
        return curve.grid_error_text, {"mean_grid_error": curve.mean_grid_error}
    largest = load.values.max()
    error = float(np.interp(largest, curve.depth, curve.force_grid_error))
    if not np.isfinite(error):
        return "", {}
    text = f"grid error of the force about {100 * error:.2g} % at the largest depth: a scan twice as fine would change "
    return f"{text}it by about that", {"force_grid_error": error}
