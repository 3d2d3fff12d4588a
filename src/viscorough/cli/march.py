"""`viscorough march`: direct integration of the viscous or viscoelastic problem in time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscorough import units
from viscorough.cli import files, messages, options, surface_options
from viscorough.summaries import si_unit, with_unit
from viscorough.units import Quantity

if TYPE_CHECKING:
    from viscorough.indenter import Indenter
    from viscorough.io.netcdf import Content
    from viscorough.viscous.correspondence import ForceHistory
    from viscorough.viscous.medium import Medium

METHODS = ("events", "explicit", "heun", "implicit", "second_order")
_OF_MEDIA = ("events", "second_order")  # methods that integrate viscoelastic media
_METHODS_OF = {"until_fraction": ("events",)}  # {option: methods that have it}


@click.command()
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
    times: list[float] | None,
    force_history: Path | None,
    progress: bool,
    **of_method: Any,
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
    of_method = {name: value for name, value in of_method.items() if value is not None}
    _check_usage(method, medium, force_history, times, of_method)
    options.require(not (force_history and force), "--force-history replaces --force; they exclude each other")
    options.require(not (medium and viscosity), "--medium replaces --viscosity; they exclude each other")
    files.check_output(output, force_history=force_history, medium=medium)
    indenter = surface_options.read_indenter(surface, output)
    unit = indenter.length_unit
    load: Any
    load, of_load = files.read_load(force or Quantity(1.0), force_history, unit)
    half_space, about = files.read_half_space(viscosity or Quantity(1.0), medium, unit)
    if force_history and not load.impulse[-1] > 0:
        text = "no time passes while there is a force; allowed: a force above zero for some time"
        raise ValueError(f"{force_history}: {text}")
    with messages.progress_bar("viscorough march", progress) as report:
        of_method |= {} if method == "events" else {"progress": report}
        if isinstance(half_space, float):
            content = _in_viscous_medium(indenter, method, half_space, load, times, **of_method)
        else:
            content = _in_medium(indenter, method, half_space, load, times, **of_method)
    files.write_output(content, output, method=method, **about, **of_load, **surface.attributes(indenter))
    time, depths, count = (content.variables[name].values for name in ("time", "depth", "contact_count"))
    depth = with_unit(depths[-1], unit, 6)
    contact = f"{count[-1]} of {indenter.elements} elements in contact"
    last = with_unit(time[-1], si_unit("s", unit), 6)
    messages.announce(output, f"{time.size} levels, depth {depth} at time {last} with {contact}")


def _check_usage(
    method: str, medium: Path | None, history: Path | None, times: list[float] | None, of_method: dict[str, Any]
) -> None:
    """Raise UsageError if an option that the method requires is missing, or one is given that does not apply to it."""
    allowed = {"medium": _OF_MEDIA} if medium else {}
    for name, methods in (allowed | {name: _METHODS_OF[name] for name in of_method}).items():
        option = name.replace("_", "-")
        options.require(method in methods, f"--{option} is not for --method {method}; allowed: {', '.join(methods)}")
    options.require(bool(medium) or method != "second_order", "--method second_order is for use with --medium")
    needed = not history and (bool(medium) or method != "events")
    options.require(needed == bool(times), f"--times is {'not for' if times else 'needed by'} --method {method}")


def _in_viscous_medium(
    indenter: Indenter, method: str, viscosity: float, load: float | ForceHistory, times: Any, **options: Any
) -> Content:
    """Content of the output for a Newtonian medium; viscosity in Pa s where the unit of length is known."""
    import numpy as np

    from viscorough.io.motion import viscous_motion_to_content
    from viscorough.viscous.integration.events import march_events
    from viscorough.viscous.integration.motion import under_constant_force, under_force_history
    from viscorough.viscous.integration.stepping import march_steps

    viscosity *= units.square_metres(indenter.length_unit)
    if method == "events":
        integrated = march_events(indenter, **options)
    elif isinstance(load, float):
        integrated = march_steps(indenter, load / viscosity * np.array(times), scheme=method, **options)
    else:
        steps = np.unique(load.impulse[load.impulse > 0]) / viscosity
        integrated = march_steps(indenter, steps, scheme=method, **options)
    if isinstance(load, float):
        motion = under_constant_force(integrated, load / viscosity)
    else:
        motion = under_force_history(integrated, load, viscosity)
    return viscous_motion_to_content(motion, indenter.length_unit)


def _in_medium(
    indenter: Indenter, method: str, medium: Medium, load: float | ForceHistory, times: Any, **options: Any
) -> Content:
    """Content of the output for a viscoelastic medium."""
    from viscorough.io.motion import medium_motion_to_content
    from viscorough.viscous.integration.internal_variable_events import march_medium_events
    from viscorough.viscous.integration.internal_variables import march_medium

    steps, force = ([0.0, *times], [load] * (1 + len(times))) if isinstance(load, float) else load[:2]
    integrate = march_medium_events if method == "events" else march_medium
    return medium_motion_to_content(integrate(indenter, medium, steps, force=force, **options))
