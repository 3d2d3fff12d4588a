"""The command line: `viscorough indent`, `viscorough kinetics` and `viscorough march`.

Whatever the user got wrong is one line on stderr, "viscorough COMMAND: what, where, what is allowed", exit
code 2 and no output file; exit code 1 is for a solver that did not converge. Modules that take long to import
are imported by the commands that need them, so that help and mistakes are quick.
"""

import contextlib
import itertools
import os
import signal
import sys
import threading
import warnings
from importlib.metadata import version
from pathlib import Path

import click

from viscorough.loading_curve import AccuracyWarning, ConvergenceError

_STEEP = 0.3  # rms slope from which on users are warned


class PositiveNumber(click.ParamType):
    """A finite number above 0 and not above `maximum`."""

    name = "number"

    def __init__(self, maximum=float("inf")):
        self.maximum = maximum

    def convert(self, value, param, ctx):
        try:
            number = float(value)
        except ValueError:
            number = float("nan")
        if not (0 < number <= self.maximum and number < float("inf")):
            limit = "finite" if self.maximum == float("inf") else f"up to {self.maximum:g}"
            self.fail(f"{value!r} is not a number above 0 and {limit}", param, ctx)
        return number


class Increasing(click.ParamType):
    """Numbers separated by commas, each larger than the one before, the first above 0."""

    name = "a,b,c"

    def convert(self, value, param, ctx):
        numbers = [PositiveNumber().convert(entry.strip(), param, ctx) for entry in value.split(",")]
        for last, number in itertools.pairwise(numbers):
            if number <= last:
                self.fail(f"{number!r} follows {last!r}, each must be larger than the last", param, ctx)
        return numbers


file = click.Path(path_type=Path)


@click.group(no_args_is_help=False)
@click.version_option(version("viscorough"), message="%(prog)s %(version)s")
def cli():
    """Penetration of rough rigid indenters into a linearly viscous half-space.

    \b
    Example: a map of heights in metres, points 2 micrometres apart, pressed by 5 N into 1e6 Pa s:
        viscorough indent heights.npy --spacing 2e-6 -o curve.nc
        viscorough kinetics curve.nc --force 5 --viscosity 1e6 -o kinetics.nc
    """


@cli.command(short_help="Loading curve of an indenter on an elastic half-space.")
@click.argument("heights", type=file)
@click.option("--spacing", type=PositiveNumber(), required=True, help="Distance of neighbouring points.")
@click.option("-o", "--output", type=file, required=True, metavar="CURVE.nc", help="File to write or replace.")
@click.option("--depths", type=Increasing(), help="Exactly these depths, in order  [default: as the tolerance asks]")
@click.option(
    "--tolerance",
    type=PositiveNumber(0.1),
    default=1e-3,
    show_default=True,
    help="Relative accuracy.",
)
@click.option("--until-fraction", type=PositiveNumber(1), help="Contact fraction to stop at  [default: 0.9]")
def indent(heights, spacing, output, depths, tolerance, until_fraction):
    """Loading curve of an indenter pressed into an elastic half-space.

    HEIGHTS is a .npy or NetCDF (.nc) file with a two-dimensional map of heights, in NetCDF the only one in
    the file or the one named "heights". Larger is higher: the highest point touches first. Points that are
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
    indenter, length_unit = _read_indenter(heights, spacing, output)

    from viscorough.contact.loading_path import indent
    from viscorough.io import storage

    stop = {"until_fraction": until_fraction} if until_fraction else {}
    curve = indent(indenter, tolerance=tolerance, depths=depths, **stop)
    ds = storage.curve_to_dataset(curve, length_unit)
    _write(ds, output, heights=heights.name, spacing=spacing)
    click.echo(
        f"{output}: {curve.depth.size} levels, the last at depth {curve.depth[-1]:.6g} "
        f"with {curve.contact_fraction[-1]:.4g} of {curve.elements} elements in contact"
    )


def _read_indenter(heights, spacing, output):
    """The indenter and its unit of length, once the output is known to be possible."""
    from viscorough.io import storage

    target = storage.check_output(output)
    if target.exists() and heights.exists() and target.samefile(heights):
        raise ValueError(f"{output}: would replace the heights; another name is needed")
    indenter = storage.read_heights(heights, spacing)
    if (slope := indenter.rms_slope) > _STEEP:
        text = f"{heights}: its rms slope is {slope:.2g}; the theory is that of small slopes, below about {_STEEP}"
        warnings.warn(text, AccuracyWarning, stacklevel=1)
    return indenter, storage.length_unit_of(heights)


def _texts(caught):
    return list(dict.fromkeys(" ".join(str(warning.message).split()) for warning in caught))


@contextlib.contextmanager
def _on_interrupt(handler):
    """Have an interrupt handled so in here."""
    if threading.current_thread() is not threading.main_thread():  # to which interrupts never come
        yield
        return
    before = signal.signal(signal.SIGINT, handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _leave(*_):
    """End at once: an exception raised in a callback of the compiler would be lost."""
    os._exit(130)


def _write(ds, output, **attributes):
    """Write a dataset with attributes, and the warnings up to here in one of them."""
    from viscorough.io import storage

    if texts := _texts(click.get_current_context().obj):
        attributes["warnings"] = "; ".join(texts)
    with _on_interrupt(signal.default_int_handler):  # an exception, so that no part of a file stays
        storage.write_dataset(ds.assign_attrs(attributes), output)


@cli.command(short_help="Penetration over time under a constant force.")
@click.argument("curve", type=file, metavar="CURVE.nc")
@click.option("--force", type=PositiveNumber(), required=True, help="Constant force F, applied at time 0.")
@click.option("--viscosity", type=PositiveNumber(), required=True, help="Shear viscosity of the half-space.")
@click.option("-o", "--output", type=file, required=True, metavar="KIN.nc", help="File to write or replace.")
def kinetics(curve, force, viscosity, output):
    """Penetration over time, under a constant force, of the indenter whose loading curve is in CURVE.nc.

    For each level of the curve, the time at which a linearly viscous half-space is penetrated to that depth,
    and the velocity there: time = (F/G) VISCOSITY/FORCE, velocity = FORCE/(VISCOSITY k/G). This
    correspondence is exact. KIN.nc is CURVE.nc with the variables time (in s) and velocity added.

    The unit of force is your choice; the viscosity is then in (unit of force) s/(unit of length)^2, the unit
    of length being that of the curve. With heights in metres and the force in newtons this is Pa s; with
    heights in micrometres and the force in newtons, 1 Pa s = 1e-12 N s/um^2.

    \b
    Example, 5 N on a medium of 1e6 Pa s, heights in metres:
        viscorough kinetics curve.nc --force 5 --viscosity 1e6 -o kinetics.nc
    """
    import numpy as np

    from viscorough.io import storage
    from viscorough.viscous import correspondence

    storage.check_output(output)
    ds = storage.read_dataset(curve)
    try:
        loading = storage.curve_from_dataset(ds)
    except ValueError as error:
        raise ValueError(f"{curve}: {error}") from error
    moving = correspondence.kinetics(loading, force, viscosity)
    if not np.isfinite([moving.time, moving.velocity]).all():
        raise ValueError(f"--force {force:g}, --viscosity {viscosity:g}: times overflow; closer values are allowed")
    ds = storage.with_motion(ds, moving.time, moving.velocity)
    ds = ds.assign_attrs(
        title="Penetration of a rigid indenter into a linearly viscous half-space under a constant force",
        force=force,
        viscosity=viscosity,
        correspondence="depth at a time is the elastic one at F/G = force * time / viscosity, velocity is "
        "force / (viscosity * k/G) there; exact for every topography, without 1/Gamma(2 - alpha)",
    )
    storage.write_dataset(ds, output)
    click.echo(f"{output}: {moving.time.size} levels, depth {moving.depth[-1]:.6g} at time {moving.time[-1]:.6g}")


@cli.command(short_help="Penetration over time, by direct integration.")
@click.argument("heights", type=file)
@click.option("--spacing", type=PositiveNumber(), required=True, help="Distance of neighbouring points.")
@click.option("-o", "--output", type=file, required=True, metavar="KIN.nc", help="File to write or replace.")
@click.option(
    "--method",
    type=click.Choice(["events", "explicit", "heun", "implicit"]),
    required=True,
    help="From contact event to contact event, exactly; or by steps: forward Euler, Heun, backward Euler.",
)
@click.option("--force", type=PositiveNumber(), help="Constant force F  [default: 1]")
@click.option("--viscosity", type=PositiveNumber(), default=1.0, show_default=True, help="Shear viscosity.")
@click.option("--times", type=Increasing(), help="Ends of the steps; needed by, and only for, the methods by steps.")
@click.option(
    "--force-history",
    type=file,
    metavar="FORCE.csv",
    help="Times and forces, two columns, in place of --force and --times: F >= 0, linear in between.",
)
@click.option("--overlap", type=PositiveNumber(1), help="Divide explicit steps to stay below it, over the depth.")
@click.option("--until-fraction", type=PositiveNumber(1), help="Contact fraction to stop at, of events  [default: 1]")
def march(heights, spacing, output, method, force, viscosity, times, force_history, overlap, until_fraction):
    """Integrate the viscous problem directly in time, without its correspondence with the elastic one.

    HEIGHTS and units are as for indent and kinetics. KIN.nc has the dimension "level", contact events or ends of steps,
    and the variables time, depth, velocity, contact_count and overlap (of the surface by the indenter, over the
    depth, which only explicit and heun allow); under a force history a level is one of its times. This is slow, a check
    of the other commands: the events of 3000 elements take seconds, memory grows with their square.

    \b
    Example:
        viscorough march heights.npy --spacing 2e-6 --method events --until-fraction 0.05 -o events.nc
        viscorough march heights.npy --spacing 2e-6 --method implicit --times 1,2,4,8 -o steps.nc
        viscorough march heights.npy --spacing 2e-6 --method heun --force-history pulses.csv -o pulses.nc
    """
    if force_history and (force or times):
        raise click.UsageError("--force-history is in place of --force and --times")
    if not force_history and (method == "events") != (times is None):
        raise click.UsageError(f"--times is {'not for' if times else 'needed by'} --method {method}")
    if overlap is not None and method not in ("explicit", "heun"):
        raise click.UsageError(f"--overlap is not for --method {method}; allowed: explicit, heun")
    if until_fraction is not None and method != "events":
        raise click.UsageError(f"--until-fraction is not for --method {method}; allowed: events")
    indenter, length_unit = _read_indenter(heights, spacing, output)

    import numpy as np

    from viscorough.io import storage
    from viscorough.viscous import correspondence
    from viscorough.viscous.events import march_events
    from viscorough.viscous.stepping import march_steps

    if force_history:
        times, history = storage.read_force_history(force_history)
        try:
            times, history, impulse = correspondence.impulses(history, times)
            if not impulse[-1] > 0:
                raise ValueError("the force is zero at all times; allowed: above zero at some time")
        except ValueError as error:
            raise ValueError(f"{force_history}: {error}") from error
        steps = np.unique(impulse[impulse > 0]) / viscosity
    else:
        force = force or 1.0
        per_time = force / viscosity
        steps = None if times is None else per_time * np.array(times)
    if method == "events":
        marched = march_events(indenter, until_fraction=until_fraction or 1.0)
    else:
        options = {} if overlap is None else {"overlap": overlap}
        marched = march_steps(indenter, steps, scheme=method, **options)
    if force_history:
        ds = storage.march_under_history(marched, times, history, impulse, viscosity, length_unit)
        force = force_history.name
    else:
        ds = storage.march_to_dataset(marched, per_time, length_unit)
    about = {"method": method, "force": force, "viscosity": viscosity, "heights": heights.name, "spacing": spacing}
    _write(ds, output, **about)
    click.echo(
        f"{output}: {ds.sizes['level']} levels, depth {ds['depth'].values[-1]:.6g} at time {ds['time'].values[-1]:.6g} "
        f"with {ds['contact_count'].values[-1]} of {indenter.elements} elements in contact"
    )


def _complain(command, error):
    """The one line on an error, on stderr."""
    hint = ""
    if isinstance(error, click.ClickException):
        text = error.format_message()
        if isinstance(error, click.UsageError):
            command = error.ctx.command_path if error.ctx else command
            hint = f"; see {command} --help"
    elif isinstance(error, MemoryError):
        text = f"not enough memory{f' ({error})' if str(error) else ''}; a smaller map of heights is needed"
    else:
        text = str(error)
    click.echo(f"{command}: {' '.join(text.split()).removesuffix('.')}{hint}", err=True)


def main(arguments=None):
    """Run the command line on the arguments (default: of the process) and return the exit code."""
    command = "viscorough"
    try:
        with (
            _on_interrupt(_leave),
            warnings.catch_warnings(record=True) as caught,
            cli.make_context(
                "viscorough", list(sys.argv[1:] if arguments is None else arguments), obj=caught
            ) as context,
        ):
            try:
                cli.invoke(context)
            finally:
                command = f"{command} {context.invoked_subcommand or ''}".rstrip()
        for text in _texts(caught):
            click.echo(f"{command}: warning: {text}", err=True)
    except click.exceptions.Exit as done:
        return done.exit_code
    except KeyboardInterrupt:
        return 130
    except ConvergenceError as error:
        _complain(command, error)
        return 1
    except (click.ClickException, ValueError, OSError, MemoryError) as error:
        _complain(command, error)
        return 2
    return 0
