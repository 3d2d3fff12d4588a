"""Penetration over time in NetCDF files, and force histories read from files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.io.columns import read_columns
from viscorough.io.curves import level_attributes
from viscorough.io.netcdf import Content, Variable
from viscorough.summaries import velocity_unit
from viscorough.types import Array, FilePath
from viscorough.viscous.correspondence import impulses

if TYPE_CHECKING:
    from viscorough.estimates import Estimate
    from viscorough.viscous.correspondence import ForceHistory, Kinetics
    from viscorough.viscous.integration.internal_variables import MediumMotion
    from viscorough.viscous.integration.motion import ViscousMotion


def with_motion(content: Content, time: Array, velocity: Array) -> Content:
    """The Content with time [s] and velocity [length unit of its depth per s] over levels added.

    Raises ValueError unless they are finite, which they are not where force and viscosity are too far apart.
    """
    if not np.isfinite([time, velocity]).all():
        raise ValueError("times or velocities overflow; a force and a viscosity closer to each other are needed")
    return _with_time_and_velocity(content, time, velocity)


def _with_time_and_velocity(content: Content, time: Array, velocity: Array) -> Content:
    unit = content.variables["depth"].attributes.get("units", "1")
    velocity = _over_levels(velocity, "velocity of penetration du/dt", velocity_unit(unit))
    return Content({"time": _time(time)} | content.variables | {"velocity": velocity}, content.attributes)


def _over_levels(values: Any, long_name: str, unit: str) -> Variable:
    return Variable(("level",), values, {"long_name": long_name, "units": unit})


def _time(values: Array) -> Variable:
    return _over_levels(values, "time since the force was applied", "s")


def _force(values: Array, length_unit: str) -> Variable:
    return _over_levels(values, "force F at that time", "1" if length_unit == "1" else "N")


def _of_levels(length_unit: str, **values: Any) -> dict[str, Variable]:
    """Variables of curves.OVER_LEVELS."""
    return {name: Variable(("level",), array, level_attributes(name, length_unit)) for name, array in values.items()}


def viscous_motion_to_content(motion: ViscousMotion) -> Content:
    """A viscous.integration.motion.ViscousMotion as a Content over its times."""
    variables = _of_levels(motion.length_unit, depth=motion.depth, contact_count=motion.contact_count)
    title = "Penetration of a rigid indenter, integrated directly in time"
    if motion.force is None:
        variables["overlap"] = _over_levels(motion.overlap, "largest overlap of indenter and surface, over depth", "1")
    else:
        variables["force"] = _force(motion.force, motion.length_unit)
        title = "Penetration of a rigid indenter under a force history, integrated directly in time"
    return with_motion(Content(variables, {"title": title}), motion.time, motion.velocity)


def medium_motion_to_content(motion: MediumMotion) -> Content:
    """A direct integration in a viscoelastic medium as a Content over its times.

    motion : viscous.integration.internal_variables.MediumMotion
    """
    unit = motion.length_unit
    variables = {"time": _time(motion.time), **_of_levels(unit, depth=motion.depth)}
    variables |= {"force": _force(motion.force, unit), **_of_levels(unit, contact_count=motion.contact_count)}
    title = "Penetration of a rigid indenter into a viscoelastic half-space, integrated directly in time"
    attributes: dict[str, Any] = {"title": title}
    if np.isfinite(motion.receding_from):
        text = "From the time receding_from on the contact recedes; no elastic contact corresponds to it."
        attributes |= {"receding_from": motion.receding_from, "comment": text}
    return Content(variables, attributes)


def estimate_to_content(estimate: Estimate, length_unit: str = "1") -> Content:
    """An estimates.Estimate as a Content; values are nan at times at which the law does not hold."""
    x = _over_levels(estimate.x, "dimensionless force X = F J(t)/(4 h L)", "1")
    variables, per_time = {"time": _time(estimate.time), "x": x}, velocity_unit(length_unit)
    about = (("depth", "depth of penetration u", length_unit), ("velocity", "velocity of penetration du/dt", per_time))
    for name, text, unit in about:
        for end, meaning in {"": "", "_low": ", lower end of 95 %", "_high": ", upper end of 95 %"}.items():
            variables[name + end] = _over_levels(getattr(estimate, name + end), text + meaning, unit)
    return Content(variables, {"title": "Penetration of a self-affine indenter by the calibrated law, no simulation"})


def read_force_history(path: FilePath, length_unit: str = "1") -> ForceHistory:
    """The ForceHistory in a file of two columns, times and forces: .csv or .npy (io.columns.read_columns).

    Parameters
    ----------
    path : path
        A .csv or .npy file of two columns.
    length_unit : str, optional
        Of the indenter. If it is known, numbers are converted to s and N from the units that a heading states.

    Raises
    ------
    ValueError
        In one line, with the file and what is wrong.

    Examples
    --------
    >>> import tempfile
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with open(f"{folder}/ramp.csv", "w") as file:
    ...         _ = file.write("t,F\\n0,0\\n2,1\\n")
    ...     history = viscorough.read_force_history(f"{folder}/ramp.csv")
    >>> history.impulse.tolist()
    [0.0, 1.0]
    """
    times, force = read_columns(path, "a force history", {"time": "s", "force": "N"}, length_unit)
    try:
        return impulses(force, times)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def kinetics_to_content(motion: Kinetics, force: ArrayLike | None, length_unit: str = "1") -> Content:
    """A viscous.correspondence.Kinetics as a Content over its times; `force` is F there, or a constant; None for none.

    Where a depth is undetermined (before the curve's first level) or a velocity infinite, the value is missing.
    """
    variables = _of_levels(length_unit, depth=motion.depth)
    if force is not None:
        force = np.broadcast_to(np.asarray(force, dtype=float), motion.time.shape)
        variables |= {"force": _force(force, length_unit)}
    velocity = np.where(np.isinf(motion.velocity), np.nan, motion.velocity)
    title = {} if force is not None else {"title": "Penetration of a rigid indenter into a viscoelastic half-space"}
    return _with_time_and_velocity(Content(variables, title), motion.time, velocity)
