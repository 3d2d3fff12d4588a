"""`viscorough march`: direct integration of the viscous or viscoelastic problem in time."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscorough import units
from viscorough.cli.files import check_output, printable_name, write_output
from viscorough.cli.messages import announce
from viscorough.cli.options import (
    FILE,
    Increasing,
    PositiveNumber,
    QuantityOption,
    force_history_option,
    number_in,
    output_option,
)
from viscorough.cli.progress import progress_bar, progress_option
from viscorough.cli.surface_options import Surface, heights_input, read_indenter
from viscorough.summaries import si_unit, with_unit
from viscorough.units import Quantity

if TYPE_CHECKING:
    from viscorough.indenter import Indenter
    from viscorough.io.netcdf import Content
    from viscorough.types import FilePath
    from viscorough.viscous.correspondence import ForceHistory

METHODS = ("events", "explicit", "heun", "implicit", "second_order")
_OF_MEDIA = ("events", "second_order")  # methods that integrate viscoelastic media
_METHODS_OF = {"overlap": ("explicit", "heun"), "until_fraction": ("events",)}  # {option: methods that have it}


@click.command()
@heights_input()
@output_option("KIN.nc")
@click.option(
    "--method",
    type=click.Choice(METHODS),
    required=True,
    help="events: exactly from one contact event to the next; or in time steps by the forward Euler (explicit), "
    "Heun (heun) or backward Euler method (implicit), or with --medium by one of second order.",
)
@click.option("--force", type=QuantityOption("N"), help="Constant force F  [default: 1]")
@click.option("--viscosity", type=QuantityOption("Pa s"), help="Shear viscosity  [default: 1]")
@click.option("--medium", type=FILE, metavar="MEDIUM.yaml", help="Medium, as for kinetics, instead of --viscosity.")
@click.option("--times", type=Increasing(), help="Ends of the time steps; for events with --medium, times of output.")
@force_history_option
@click.option(
    "--overlap",
    type=PositiveNumber(1),
    help="Largest overlap allowed, relative to the depth; explicit and heun divide their steps to keep to it.",
)
@click.option("--until-fraction", type=PositiveNumber(1), help="Contact fraction at which events stop  [default: 1]")
@progress_option
def march(
    surface: Surface,
    output: Any,
    *,
    method: str,
    force: Quantity | None,
    viscosity: Quantity | None,
    medium: Path | None,
    times: list[float] | None,
    force_history: Path | None,
    progress: bool,
    **of_method: float | None,
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
    if force_history and (force or times):
        raise click.UsageError("--force-history replaces --force and --times; they exclude each other")
    if medium and viscosity:
        raise click.UsageError("--medium replaces --viscosity; they exclude each other")
    options: dict[str, Any] = {name: value for name, value in of_method.items() if value is not None}
    _check_options_of_method(method, bool(medium), bool(force_history), times, options)
    check_output(output, force_history=force_history, medium=medium)
    indenter = read_indenter(surface, output)
    unit = indenter.length_unit
    load: Any = 1.0 if force is None else number_in("N", force, unit, "--force")
    viscosity = 1.0 if viscosity is None else number_in("Pa s", viscosity, unit, "--viscosity")
    about: dict[str, Any] = {"medium": printable_name(medium)} if medium else {"viscosity": viscosity}
    about["force"] = printable_name(force_history) if force_history else load
    if force_history:
        load = _read_history(force_history, unit)
    with progress_bar("viscorough march", progress) as report:
        options |= {} if method == "events" else {"progress": report}
        if medium:
            content = _in_medium(indenter, method, medium, load, times, **options)
        else:
            content = _in_viscous_medium(indenter, method, viscosity, load, times, **options)
    write_output(content, output, method=method, **about, **surface.attributes(indenter))
    time, depths, count = (content.variables[name].values for name in ("time", "depth", "contact_count"))
    depth = with_unit(depths[-1], unit, 6)
    contact = f"{count[-1]} of {indenter.elements} elements in contact"
    last = with_unit(time[-1], si_unit("s", unit), 6)
    announce(output, f"{time.size} levels, depth {depth} at time {last} with {contact}")


def _check_options_of_method(
    method: str, has_medium: bool, has_history: bool, times: list[float] | None, options: Iterable[str]
) -> None:
    """Raise UsageError if an option that the method requires is missing, or one is given that does not apply to it."""
    if has_medium and method not in _OF_MEDIA:
        raise click.UsageError(f"--method {method} is not for --medium; allowed: {', '.join(_OF_MEDIA)}")
    if not has_medium and method == "second_order":
        raise click.UsageError("--method second_order is for use with --medium")
    needs_times = has_medium or method != "events"
    if not has_history and needs_times == (times is None):
        raise click.UsageError(f"--times is {'not for' if times else 'needed by'} --method {method}")
    for name in options:
        if method not in (allowed := _METHODS_OF[name]):
            option = name.replace("_", "-")
            raise click.UsageError(f"--{option} is not for --method {method}; allowed: {', '.join(allowed)}")


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
        return viscous_motion_to_content(under_constant_force(integrated, load / viscosity))
    return viscous_motion_to_content(under_force_history(integrated, load, viscosity))


def _in_medium(
    indenter: Indenter, method: str, medium: Path, load: float | ForceHistory, times: Any, **options: Any
) -> Content:
    """Content of the output for a viscoelastic medium."""
    from viscorough.io.media import read_medium
    from viscorough.io.motion import medium_motion_to_content
    from viscorough.viscous.integration.internal_variable_events import march_medium_events
    from viscorough.viscous.integration.internal_variables import march_medium

    law = read_medium(medium, indenter.length_unit)
    steps, force = ([0.0, *times], [load] * (1 + len(times))) if isinstance(load, float) else load[:2]
    integrate = march_medium_events if method == "events" else march_medium
    return medium_motion_to_content(integrate(indenter, law, steps, force=force, **options))


def _read_history(path: FilePath, length_unit: str) -> ForceHistory:
    """The ForceHistory in a file. Raises ValueError if the file holds none, or if the force is zero at all times."""
    from viscorough.io.motion import read_force_history

    history = read_force_history(path, length_unit)
    if not history.impulse[-1] > 0:
        raise ValueError(f"{path}: no time passes while there is a force; allowed: a force above zero for some time")
    return history
