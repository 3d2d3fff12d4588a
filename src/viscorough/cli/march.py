"""`viscorough march`: integrate the viscous or viscoelastic problem directly in time."""

from pathlib import Path
from typing import Any

import click

import viscorough
from viscorough.basics.summaries import si_unit, with_unit
from viscorough.basics.units import Quantity
from viscorough.cli import files, messages, options, surface_options

METHODS = ("events", "implicit")


@click.command(cls=options.Command, short_help="Penetration over time by direct integration.")
@surface_options.heights_input()
@options.output("KIN.nc")
@click.option(
    "--method",
    type=click.Choice(METHODS),
    required=True,
    help="By contact events or by time steps.",
)
@click.option("--force", type=options.QuantityOption("N"), help="Constant force F  [default: 1]")
@click.option("--viscosity", type=options.QuantityOption("Pa s"), help="Shear viscosity  [default: 1]")
@options.medium
@click.option(
    "--times", type=options.Increasing(), help="Times of the output and ends of the steps, under a constant force."
)
@options.force_history
@options.columns
@options.until("1")
@options.progress
def march(
    heights: surface_options.HeightsFile,
    output: Any,
    *,
    method: str,
    force: Quantity | None,
    viscosity: Quantity | None,
    medium: Path | None,
    times: Any,
    force_history: Path | None,
    columns: dict[str, int] | None,
    until_fraction: float | None,
    progress: bool,
) -> None:
    """Integrate the viscous or viscoelastic problem directly in time, without using a loading curve.

    HEIGHTS and units are as for indent and kinetics. KIN.nc has the variables time, depth, velocity, force and
    contact_fraction along the dimension "level", with one level for each time of --times or of the force history.

    The method events is exact from one contact event to the next, in a Newtonian medium. It takes seconds for 3000
    elements, its memory grows with the square of their number, and it shows no progress. The method implicit solves one
    contact problem per time step, of second order, in every medium of springs and dashpots. Both are slow and serve to
    check the other commands.

    \b
    Example:
        viscorough march heights.npy --spacing 2 --unit um --method events --times 1,2,4,8 \\
            -o events.nc
        viscorough march heights.npy --spacing 2 --unit um --method implicit \\
            --medium rubber.yaml \\
            --force-history pulses.csv -o pulses.nc
    """
    text = f"--until-fraction is not for --method {method}; allowed: events"
    options.require(until_fraction is None or method == "events", text)
    options.require((force_history is None) == bool(times), "one of --times and --force-history is needed")
    options.require(not (force_history and force), "--force-history replaces --force; they exclude each other")
    options.require(not (medium and viscosity), "--medium replaces --viscosity; they exclude each other")

    import numpy as np

    from viscorough.io.motion_files import motion_to_content

    indenter, unit = heights.read(output, force_history=force_history, medium=medium)
    load, load_attributes = files.load_from_options(force or Quantity(1.0), force_history, unit, columns=columns)
    if times:  # with --times, `load` is a number, the constant force
        load = viscorough.Load(np.append(0.0, times), force=np.full(1 + len(times), load))
    half_space, about = files.read_half_space(viscosity or Quantity(1.0), medium, unit)
    how: dict[str, Any] = {"method": method} | ({} if until_fraction is None else {"until_fraction": until_fraction})
    with messages.progress_bar("viscorough march", progress) as report:
        motion = viscorough.march(indenter, load, half_space, **how, progress=report)
    content = motion_to_content(motion)
    about |= load_attributes | heights.attributes(indenter, unit)
    files.write_output(content, output, unit, method=method, **about)
    depth = with_unit(motion.depth[-1], motion.length_unit, 6)
    last = with_unit(motion.time[-1], si_unit("s", unit), 6)
    contact = f"{round(motion.contact_fraction[-1] * indenter.elements)} of {indenter.elements} elements in contact"
    messages.announce(output, f"{motion.time.size} times, depth {depth} at time {last} with {contact}")
