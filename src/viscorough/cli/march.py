"""`viscorough march`: direct integration of the viscous problem in time."""

import click

from viscorough.cli.messages import announce
from viscorough.cli.options import (
    FILE,
    Increasing,
    PositiveNumber,
    check_not_an_input,
    output_option,
    printable_name,
    write_output,
)
from viscorough.cli.surface_options import heights_input, read_indenter


@click.command(short_help="Penetration over time by direct integration.")
@heights_input()
@output_option("KIN.nc")
@click.option(
    "--method",
    type=click.Choice(["events", "explicit", "heun", "implicit"]),
    required=True,
    help="events: exactly from one contact event to the next; or in time steps by the forward Euler (explicit), "
    "Heun (heun) or backward Euler method (implicit).",
)
@click.option("--force", type=PositiveNumber(), help="Constant force F  [default: 1]")
@click.option("--viscosity", type=PositiveNumber(), default=1.0, show_default=True, help="Shear viscosity.")
@click.option("--times", type=Increasing(), help="Ends of the time steps; required by the methods that take steps.")
@click.option(
    "--force-history",
    type=FILE,
    metavar="FORCE.csv",
    help="Two columns, times and forces, instead of --force and --times: F >= 0, linear in between.",
)
@click.option(
    "--overlap",
    type=PositiveNumber(1),
    help="Largest overlap allowed, relative to the depth; explicit and heun divide their steps to keep to it.",
)
@click.option("--until-fraction", type=PositiveNumber(1), help="Contact fraction at which events stop  [default: 1]")
def march(surface, output, *, method, force, viscosity, times, force_history, overlap, until_fraction):
    """Integrate the viscous problem directly in time, without its correspondence with the elastic one.

    HEIGHTS and units are as for indent and kinetics. KIN.nc has the dimension "level" (contact events or ends of steps)
    and the variables time, depth, velocity, contact_count and overlap (of the indenter with the surface, relative to
    the depth; only explicit and heun allow it). Under a force history a level is one of its times. This is slow and
    serves to check the other commands: the events of 3000 elements take seconds, and memory grows with the square of
    their number.

    \b
    Example:
        viscorough march heights.npy --spacing 2e-6 --method events --until-fraction 0.05 -o events.nc
        viscorough march heights.npy --spacing 2e-6 --method implicit --times 1,2,4,8 -o steps.nc
        viscorough march heights.npy --spacing 2e-6 --method heun --force-history pulses.csv -o pulses.nc
    """
    if force_history and (force or times):
        raise click.UsageError("--force-history replaces --force and --times; they exclude each other")
    _check_options_of_method(method, bool(force_history), times, overlap, until_fraction)
    if force_history:
        check_not_an_input(output, force_history, "force history")
    indenter = read_indenter(surface, output)

    import numpy as np

    from viscorough.io import motion

    options = {"overlap": overlap, "until_fraction": until_fraction}
    if force_history:
        history = _read_history(force_history)
        steps = np.unique(history.impulse[history.impulse > 0]) / viscosity
        integrated = _integrate(indenter, method, steps, **options)
        content = motion.integration_under_history(integrated, history, viscosity)
        force = printable_name(force_history)
    else:
        force = force or 1.0
        per_time = force / viscosity
        integrated = _integrate(indenter, method, None if times is None else per_time * np.array(times), **options)
        content = motion.integration_to_content(integrated, per_time)
    attributes = {"method": method, "force": force, "viscosity": viscosity, **surface.attributes(indenter)}
    write_output(content, output, **attributes)
    time, depth, count = (content.variables[name].values for name in ("time", "depth", "contact_count"))
    contact = f"{count[-1]} of {indenter.elements} elements in contact"
    announce(output, f"{time.size} levels, depth {depth[-1]:.6g} at time {time[-1]:.6g} with {contact}")


def _check_options_of_method(method, has_history, times, overlap, until_fraction):
    """Raise UsageError if an option that the method requires is missing, or one is given that does not apply to it."""
    if not has_history and (method == "events") != (times is None):
        raise click.UsageError(f"--times is {'not for' if times else 'needed by'} --method {method}")
    if overlap is not None and method not in ("explicit", "heun"):
        raise click.UsageError(f"--overlap is not for --method {method}; allowed: explicit, heun")
    if until_fraction is not None and method != "events":
        raise click.UsageError(f"--until-fraction is not for --method {method}; allowed: events")


def _read_history(path):
    """The ForceHistory in a file. Raises ValueError if the file holds none, or if the force is zero at all times."""
    from viscorough.io.motion import read_force_history
    from viscorough.viscous.correspondence import impulses

    times, force = read_force_history(path)
    try:
        history = impulses(force, times)
        if not history.impulse[-1] > 0:
            raise ValueError("no time passes while there is a force; allowed: a force above zero for some time")
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error
    return history


def _integrate(indenter, method, steps, *, overlap, until_fraction):
    """Events or Steps of a direct integration.

    steps : impulse/viscosity at the ends of the steps [length²]; not used by the method events
    """
    from viscorough.viscous.events import march_events
    from viscorough.viscous.stepping import march_steps

    if method == "events":
        return march_events(indenter, until_fraction=until_fraction or 1.0)
    options = {} if overlap is None else {"overlap": overlap}
    return march_steps(indenter, steps, scheme=method, **options)
