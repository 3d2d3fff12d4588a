"""`viscorough march`: direct integration of the viscous or viscoelastic problem in time."""

from pathlib import Path
from typing import Any

import click

import viscorough
from viscorough import units
from viscorough.cli import files, messages, options, surface_options
from viscorough.summaries import si_unit, with_unit
from viscorough.units import Quantity

METHODS = ("events", "explicit", "heun", "implicit", "second_order")
_OF_MEDIA = ("events", "second_order")  # methods that integrate viscoelastic media


@click.command(short_help="Penetration over time by direct integration.")
@surface_options.heights_input()
@options.output("KIN.nc")
@click.option(
    "--method",
    type=click.Choice(METHODS),
    required=True,
    help="events: exactly from one contact event to the next; or in time steps by the forward Euler (explicit), "
    "Heun (heun) or backward Euler method (implicit), or with --medium by one of second order.",
)
@click.option("--force", type=options.QuantityOption("N"), help="Constant force F  [default: 1]")
@click.option("--viscosity", type=options.QuantityOption("Pa s"), help="Shear viscosity  [default: 1]")
@options.medium
@click.option(
    "--times", type=options.Increasing(), help="Ends of the time steps; for events with --medium, times of output."
)
@options.force_history
@options.until(1)
@options.progress
def march(
    surface: surface_options.Surface,
    output: Any,
    *,
    method: str,
    force: Quantity | None,
    viscosity: Quantity | None,
    medium: Path | None,
    times: Any,
    force_history: Path | None,
    until_fraction: float | None,
    progress: bool,
) -> None:
    """Integrate the viscous or viscoelastic problem directly in time, without its correspondence with the elastic one.

    HEIGHTS and units are as for indent and kinetics. KIN.nc has the dimension "level" (contact events or ends of steps)
    and the variables time, depth, velocity, contact_count and overlap (of the indenter with the surface, relative to
    the depth; only explicit and heun allow it). Under a force history a level is one of its times. This is slow and
    serves to check the other commands: the events of 3000 elements take seconds, and memory grows with the square of
    their number. Events show no progress.

    With --medium, springs and dashpots are integrated with internal variables, for small maps. The steps of
    second_order go on where the force falls and the contact recedes, for which kinetics has no answer. KIN.nc then
    holds time, depth, force and contact_count.

    \b
    Example:
        viscorough march heights.npy --spacing 2e-6 --method events --until-fraction 0.05 -o events.nc
        viscorough march heights.npy --spacing 2e-6 --method implicit --times 1,2,4,8 -o steps.nc
        viscorough march heights.npy --spacing 2e-6 --method second_order --medium rubber.yaml \\
            --force-history pulses.csv -o pulses.nc
    """
    for option, value, methods in (("medium", medium, _OF_MEDIA), ("until-fraction", until_fraction, ("events",))):
        wrong = f"--{option} is not for --method {method}; allowed: {', '.join(methods)}"
        options.require(value is None or method in methods, wrong)
    options.require(bool(medium) or method != "second_order", "--method second_order is for use with --medium")
    needed = not force_history and (bool(medium) or method != "events")
    options.require(needed == bool(times), f"--times is {'not for' if times else 'needed by'} --method {method}")
    options.require(not (force_history and force), "--force-history replaces --force; they exclude each other")
    options.require(not (medium and viscosity), "--medium replaces --viscosity; they exclude each other")

    import numpy as np

    from viscorough.io.motion import medium_motion_to_content, viscous_motion_to_content
    from viscorough.viscous.integration.motion import under_constant_force, under_force_history

    indenter = surface_options.read_indenter(surface, output, force_history=force_history, medium=medium)
    unit = indenter.length_unit
    load, of_load = files.read_load(force or Quantity(1.0), force_history, unit)
    half_space, about = files.read_half_space(viscosity or Quantity(1.0), medium, unit)
    if force_history and not load.impulse[-1] > 0:
        text = "no time passes while there is a force; allowed: a force above zero for some time"
        raise ValueError(f"{force_history}: {text}")
    how: dict[str, Any] = {} if until_fraction is None else {"until_fraction": until_fraction}
    with messages.progress_bar("viscorough march", progress) as report:
        how |= {} if method == "events" else {"progress": report}
        if medium:
            steps, forces = load[:2] if force_history else ([0.0, *times], [load] * (1 + len(times)))
            integrate = viscorough.march_medium_events if method == "events" else viscorough.march_medium
            content = medium_motion_to_content(integrate(indenter, half_space, steps, force=forces, **how))
        else:
            per_area = half_space * units.square_metres(unit)  # viscosity in the unit of the lengths
            if method == "events":
                integrated: Any = viscorough.march_events(indenter, **how)
            else:
                # The impulse of a history rises from 0.
                ends = np.unique(load.impulse)[1:] / per_area if force_history else load / per_area * np.array(times)
                integrated = viscorough.march_steps(indenter, ends, scheme=method, **how)
            if force_history:
                motion = under_force_history(integrated, load, per_area)
            else:
                motion = under_constant_force(integrated, load / per_area)
            content = viscous_motion_to_content(motion, unit)
    files.write_output(content, output, method=method, **about, **of_load, **surface.attributes(indenter))
    time, depths, count = (content.variables[name].values for name in ("time", "depth", "contact_count"))
    depth = with_unit(depths[-1], unit, 6)
    contact = f"{count[-1]} of {indenter.elements} elements in contact"
    last = with_unit(time[-1], si_unit("s", unit), 6)
    messages.announce(output, f"{time.size} levels, depth {depth} at time {last} with {contact}")
