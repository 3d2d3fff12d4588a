"""The command line: `viscorough indent`, `viscorough kinetics` and `viscorough march`.

A user's mistake is answered with one line on stderr, "viscorough COMMAND: what, where, what is allowed", exit code 2
and no output file; exit code 1 means that a solver did not converge, exit code 0 that the output file is complete, also
if the closing line could not be written to stdout. Where warnings are errors (PYTHONWARNINGS=error), a warning is
answered like a mistake. Modules that take long to import are imported by
the commands that need them, so that help and messages come quickly.
"""

import sys
import warnings
from signal import SIG_DFL

import click

from viscorough.cli_messages import (
    announce,
    complain,
    discard_what_cannot_be_written,
    escape_letters_without_code,
    report,
)
from viscorough.cli_options import (
    FILE,
    Increasing,
    PositiveNumber,
    check_not_an_input,
    check_opens,
    output_option,
    printable_name,
    read_indenter,
    spacing_option,
    warning_texts,
    write_output,
)
from viscorough.errors import ConvergenceError
from viscorough.interrupts import on_interrupt


@click.group(no_args_is_help=False)
@click.version_option(package_name="viscorough", message="%(prog)s %(version)s")
def cli():
    """Penetration of rough rigid indenters into a linearly viscous half-space.

    \b
    Example: a map of heights in metres, points 2 micrometres apart, pressed by 5 N into 1e6 Pa s:
        viscorough indent heights.npy --spacing 2e-6 -o curve.nc
        viscorough kinetics curve.nc --force 5 --viscosity 1e6 -o kinetics.nc
    """


@cli.command(short_help="Loading curve of an indenter on an elastic half-space.")
@click.argument("heights", type=FILE)
@spacing_option
@output_option("CURVE.nc")
@click.option("--depths", type=Increasing(), help="Levels at exactly these depths  [default: as the tolerance needs]")
@click.option("--tolerance", type=PositiveNumber(0.1), default=1e-3, show_default=True, help="Relative accuracy.")
@click.option("--until-fraction", type=PositiveNumber(1), help="Contact fraction at which to stop  [default: 0.9]")
def indent(heights, spacing, output, *, depths, tolerance, until_fraction):
    """Loading curve of an indenter pressed into an elastic half-space.

    HEIGHTS is a .npy or NetCDF (.nc) file with a two-dimensional map of heights; in a NetCDF file it is the variable
    "heights" or the only two-dimensional one. Larger is higher: the highest point touches first. Points that are
    nan lie outside the indenter. Heights, spacing and depths are in one unit of length of your choice.

    CURVE.nc has the dimension "level" and the variables depth, force = F/G and stiffness = k/G (F the force,
    k its derivative with respect to depth, G the shear modulus of the incompressible half-space),
    contact_count, contact_fraction and residual. Their units are powers of the unit that a NetCDF file states
    for the heights; if none is stated, units are 1, which stands for the unit you chose.

    \b
    Example:
        viscorough indent heights.npy --spacing 2e-6 --depths 1e-6,2e-6,4e-6 -o curve.nc
    """
    if depths is not None and until_fraction is not None:
        raise click.UsageError("--depths and --until-fraction exclude each other; one of them is allowed")
    indenter, length_unit = read_indenter(heights, spacing, output)

    from viscorough.contact.loading_path import indent
    from viscorough.io.curves import curve_to_content

    stop = {"until_fraction": until_fraction} if until_fraction else {}
    curve = indent(indenter, tolerance=tolerance, depths=depths, **stop)
    write_output(curve_to_content(curve, length_unit), output, heights=printable_name(heights), spacing=spacing)
    count = f"{curve.contact_count[-1]} of {curve.elements} elements in contact"
    announce(output, f"{curve.depth.size} levels, the last at depth {curve.depth[-1]:.6g} with {count}")


@cli.command(short_help="Penetration over time under a constant force.")
@click.argument("curve", type=FILE, metavar="CURVE.nc")
@click.option("--force", type=PositiveNumber(), required=True, help="Constant force F, applied at time 0.")
@click.option("--viscosity", type=PositiveNumber(), required=True, help="Shear viscosity of the half-space.")
@output_option("KIN.nc")
def kinetics(curve, force, viscosity, output):
    """Penetration over time, under a constant force, of the indenter whose loading curve is in CURVE.nc.

    For each level of the curve, the time at which the indenter has penetrated a linearly viscous half-space to that
    depth, and the velocity there: time = (F/G) VISCOSITY/FORCE, velocity = FORCE/(VISCOSITY k/G). This
    correspondence is exact. KIN.nc is CURVE.nc with the variables time (in s) and velocity added.

    The unit of force is your choice; the viscosity is then in (unit of force) s/(unit of length)^2, where the unit
    of length is that of the curve. With heights in metres and the force in newtons this is Pa s; with
    heights in micrometres and the force in newtons, 1 Pa s = 1e-12 N s/um^2.

    \b
    Example, 5 N on a medium of 1e6 Pa s, heights in metres:
        viscorough kinetics curve.nc --force 5 --viscosity 1e6 -o kinetics.nc
    """
    import numpy as np

    from viscorough.io import netcdf
    from viscorough.io.atomic import check_output
    from viscorough.io.curves import curve_from_content
    from viscorough.io.motion import with_motion
    from viscorough.viscous import correspondence

    check_output(output)
    check_opens(curve)
    content = netcdf.read(curve)
    try:
        loading = curve_from_content(content)
    except ValueError as error:
        raise ValueError(f"{curve}: {error}") from error
    motion = correspondence.kinetics(loading, force, viscosity)
    if not (np.diff(motion.time, prepend=0) > 0).all() or not (motion.velocity > 0).all():
        raise ValueError(f"--force {force:g}, --viscosity {viscosity:g}: times overflow; closer values are allowed")
    write_output(
        with_motion(content, motion.time, motion.velocity),
        output,
        title="Penetration of a rigid indenter into a linearly viscous half-space under a constant force",
        force=force,
        viscosity=viscosity,
        correspondence="depth at a time is the elastic one at F/G = force * time / viscosity, velocity is "
        "force / (viscosity * k/G) there; exact for every topography, without 1/Gamma(2 - alpha)",
    )
    announce(output, f"{motion.time.size} levels, depth {motion.depth[-1]:.6g} at time {motion.time[-1]:.6g}")


@cli.command(short_help="Penetration over time by direct integration.")
@click.argument("heights", type=FILE)
@spacing_option
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
def march(heights, spacing, output, *, method, force, viscosity, times, force_history, overlap, until_fraction):
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
    indenter, length_unit = read_indenter(heights, spacing, output)

    import numpy as np

    from viscorough.io import motion

    options = {"overlap": overlap, "until_fraction": until_fraction}
    if force_history:
        history = _read_history(force_history)
        steps = np.unique(history.impulse[history.impulse > 0]) / viscosity
        integrated = _integrate(indenter, method, steps, **options)
        content = motion.integration_under_history(integrated, history, viscosity, length_unit)
        force = printable_name(force_history)
    else:
        force = force or 1.0
        per_time = force / viscosity
        integrated = _integrate(indenter, method, None if times is None else per_time * np.array(times), **options)
        content = motion.integration_to_content(integrated, per_time, length_unit)
    attributes = {
        "method": method,
        "force": force,
        "viscosity": viscosity,
        "heights": printable_name(heights),
        "spacing": spacing,
    }
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
            raise ValueError("the force is zero at all times; allowed: above zero at some time")
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


def main(arguments=None, commands=cli):
    """Run the command line and return its exit code.

    arguments : list of texts; default: those of the process
    commands : the click.Group to run
    """
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    command = "viscorough"
    escape_letters_without_code()
    try:
        with (
            on_interrupt(SIG_DFL),  # ends the process at once, also where libraries do not return to Python
            warnings.catch_warnings(record=True) as caught,
            commands.make_context("viscorough", arguments, obj=caught) as context,
        ):
            try:
                commands.invoke(context)
            finally:
                command = f"{command} {context.invoked_subcommand or ''}".rstrip()
        for text in warning_texts(caught):
            complain(command, f"warning: {text}")
    except click.exceptions.Exit as done:
        return done.exit_code
    except BrokenPipeError:  # what reads standard output has read enough, as in viscorough --help | head
        return 0
    except KeyboardInterrupt:
        return 130
    except ConvergenceError as error:
        report(command, error)
        return 1
    except (click.ClickException, ValueError, OSError, MemoryError, Warning) as error:
        report(command, error)
        return 2
    finally:
        discard_what_cannot_be_written()
    return 0
