"""Penetration over time in NetCDF files, and force histories read from files."""

import numpy as np

from viscorough.io.columns import read_columns
from viscorough.io.curves import level_attributes
from viscorough.io.netcdf import Content, Variable
from viscorough.viscous.correspondence import impulses


def with_motion(content, time, velocity):
    """The Content with time [s] and velocity [length unit of its depth per s] over levels added.

    Raises ValueError unless they are finite, which they are not where force and viscosity are too far apart.
    """
    if not np.isfinite([time, velocity]).all():
        raise ValueError("times or velocities overflow; a force and a viscosity closer to each other are needed")
    return _with_time_and_velocity(content, time, velocity)


def _with_time_and_velocity(content, time, velocity):
    unit = content.variables["depth"].attributes.get("units", "1")
    unit = "s-1" if unit == "1" else f"{unit} s-1"
    added = {
        "time": Variable(("level",), time, {"long_name": "time since the force was applied", "units": "s"}),
        "velocity": Variable(("level",), velocity, {"long_name": "velocity of penetration du/dt", "units": unit}),
    }
    return Content(content.variables | added, content.attributes)


def integration_to_content(integration, force_per_viscosity):
    """A direct integration (viscous.events.Events or viscous.stepping.Steps) under constant force as a Content.

    force_per_viscosity : F/η; the time is the impulse over the viscosity, divided by it
    """
    variables = {
        name: Variable(("level",), getattr(integration, name), level_attributes(name, integration.length_unit))
        for name in ("depth", "contact_count")
    }
    overlap = {"long_name": "largest overlap of indenter and surface, over depth", "units": "1"}
    variables["overlap"] = Variable(
        ("level",), getattr(integration, "overlap", np.zeros_like(integration.depth)), overlap
    )
    content = Content(variables, {"title": "Penetration of a rigid indenter, integrated directly in time"})
    return with_motion(content, integration.impulse / force_per_viscosity, force_per_viscosity / integration.resistance)


def integration_under_history(integration, history, viscosity):
    """A direct integration under a force history as a Content; its levels are the times of the history.

    integration : viscous.events.Events, or viscous.stepping.Steps that end at every impulse of the history above zero,
        over the viscosity
    history : viscous.correspondence.ForceHistory

    Raises ValueError for an impulse beyond the last event.
    """
    reached, length_unit = history.impulse / viscosity, integration.length_unit
    if hasattr(integration, "event_at"):
        if reached[-1] > integration.impulse[-1] * (1 + 1e-10) and integration.contact_count[-1] < integration.elements:
            raise ValueError(
                f"impulse: {history.impulse[-1]:.6g} is beyond the contact fraction at which events end; "
                f"allowed: up to {integration.impulse[-1] * viscosity:.6g}"
            )
        i, depth = integration.event_at(reached), integration.depth_at(reached)
    else:
        i = np.searchsorted(integration.impulse, reached * (1 - 1e-12))
        depth = np.where(reached > 0, integration.depth[i], 0.0)
    variables = {
        "depth": Variable(("level",), depth, level_attributes("depth", length_unit)),
        "contact_count": Variable(
            ("level",), integration.contact_count[i], level_attributes("contact_count", length_unit)
        ),
        "force": Variable(
            ("level",),
            history.force,
            {"long_name": "force F at that time", "units": "1" if length_unit == "1" else "N"},
        ),
    }
    title = "Penetration of a rigid indenter under a force history, integrated directly in time"
    velocity = history.force / (viscosity * integration.resistance[i])
    return with_motion(Content(variables, {"title": title}), history.times, velocity)


def medium_motion_to_content(motion):
    """A direct integration in a viscoelastic medium as a Content over its times.

    motion : viscous.internal_variables.MediumMotion or viscous.internal_variable_events.MediumEvents
    """
    force_unit = "1" if motion.length_unit == "1" else "N"
    variables = {
        "time": Variable(("level",), motion.time, {"long_name": "time since the force was applied", "units": "s"}),
        "depth": Variable(("level",), motion.depth, level_attributes("depth", motion.length_unit)),
        "force": Variable(("level",), motion.force, {"long_name": "force F at that time", "units": force_unit}),
        "contact_count": Variable(
            ("level",), motion.contact_count, level_attributes("contact_count", motion.length_unit)
        ),
    }
    attributes = {
        "title": "Penetration of a rigid indenter into a viscoelastic half-space, integrated directly in time"
    }
    if np.isfinite(motion.receding_from):
        attributes["receding_from"] = motion.receding_from
        attributes["comment"] = (
            "From the time receding_from on the contact recedes; no elastic contact corresponds to it."
        )
    return Content(variables, attributes)


def estimate_to_content(estimate, length_unit="1"):
    """An estimates.Estimate as a Content; values are nan at times at which the law does not hold."""
    velocity_unit = "s-1" if length_unit == "1" else f"{length_unit} s-1"
    described = {
        "time": ("time since the force was applied", "s"),
        "x": ("dimensionless force X = F J(t)/(4 h L)", "1"),
        **{
            f"{name}{end}": (f"{text}{meaning}", unit)
            for name, text, unit in (
                ("depth", "depth of penetration u", length_unit),
                ("velocity", "velocity of penetration du/dt", velocity_unit),
            )
            for end, meaning in {"": "", "_low": ", lower end of 95 %", "_high": ", upper end of 95 %"}.items()
        },
    }
    variables = {
        name: Variable(("level",), getattr(estimate, name), {"long_name": text, "units": unit})
        for name, (text, unit) in described.items()
    }
    return Content(variables, {"title": "Penetration of a self-affine indenter by the calibrated law, no simulation"})


def read_force_history(path, length_unit="1"):
    """Times and forces, both of shape (times,), in a file of two columns: .csv or .npy (io.columns.read_columns).

    length_unit : of the indenter. If it is known, numbers are converted to s and N from the units that a heading states

    Raises a one-line ValueError that names the file and what is wrong. Whether the numbers are a force history is
    checked by viscous.correspondence.impulses.
    """
    return read_columns(path, "a force history", {"time": "s", "force": "N"}, length_unit)


def force_history_in(path, length_unit="1"):
    """The ForceHistory in a file, as of `read_force_history`. Raises a one-line ValueError if it holds none."""
    times, force = read_force_history(path, length_unit)
    try:
        return impulses(force, times)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def kinetics_to_content(motion, force, length_unit="1"):
    """A viscous.correspondence.Kinetics as a Content over its times; `force` is F there, or a constant.

    Where a depth is undetermined (before the curve's first level) or a velocity infinite, the value is missing.
    """
    force = np.broadcast_to(np.asarray(force, dtype=float), motion.time.shape)
    unit = "1" if length_unit == "1" else "N"
    variables = {
        "depth": Variable(("level",), motion.depth, level_attributes("depth", length_unit)),
        "force": Variable(("level",), force, {"long_name": "force F at that time", "units": unit}),
    }
    velocity = np.where(np.isinf(motion.velocity), np.nan, motion.velocity)
    return _with_time_and_velocity(Content(variables, {}), motion.time, velocity)
