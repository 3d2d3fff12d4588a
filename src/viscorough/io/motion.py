"""Penetration over time in NetCDF files, and force histories read from files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.arrays import ForceHistory
from viscorough.io.atomic import path_named
from viscorough.io.columns import read_columns
from viscorough.io.curves import OVER_LEVELS
from viscorough.io.netcdf import Content, Quantities, described
from viscorough.types import Array, FilePath
from viscorough.viscous.correspondence import Kinetics, impulses

if TYPE_CHECKING:
    from viscorough.estimates import Estimate
    from viscorough.viscous.integration.internal_variables import MediumMotion


# Quantities over time.
_QUANTITIES: Quantities = {
    **OVER_LEVELS,
    "time": ("time since the force was applied", "time"),
    "x": ("dimensionless force X = F J(t)/(4 h L)", 0),
    "velocity": ("velocity of penetration du/dt", "velocity"),
    "force": ("force F at that time", "N"),
    "overlap": ("largest overlap of indenter and surface, over depth", 0),
}


def viscous_motion_to_content(motion: dict[str, Array], length_unit: str) -> Content:
    """What viscous.integration.motion gives as a Content over its times.

    Raises ValueError unless times and velocities are finite.
    """
    if not np.isfinite([motion["time"], motion["velocity"]]).all():
        raise ValueError("times or velocities overflow; a force and a viscosity closer to each other are needed")
    load = " under a force history" if "force" in motion else ""
    title = f"Penetration of a rigid indenter{load}, integrated directly in time"
    return Content(described(("level",), motion, _QUANTITIES, length_unit), {"title": title})


def medium_motion_to_content(motion: MediumMotion) -> Content:
    """A direct integration in a viscoelastic medium as a Content over its times.

    motion : viscous.integration.internal_variables.MediumMotion
    """
    values = {name: getattr(motion, name) for name in ("time", "depth", "force", "contact_count")}
    title = "Penetration of a rigid indenter into a viscoelastic half-space, integrated directly in time"
    attributes: dict[str, Any] = {"title": title}
    if np.isfinite(motion.receding_from):
        text = "From the time receding_from on the contact recedes; no elastic contact corresponds to it."
        attributes |= {"receding_from": motion.receding_from, "comment": text}
    return Content(described(("level",), values, _QUANTITIES, motion.length_unit), attributes)


def estimate_to_content(estimate: Estimate, length_unit: str = "1") -> Content:
    """An estimates.Estimate as a Content; values are nan at times at which the law does not hold."""
    quantities = {name: _QUANTITIES[name] for name in ("time", "x")}
    for name, text, unit in (("depth", "depth of penetration u", 1), ("velocity", *_QUANTITIES["velocity"])):
        for end, side in {"": "", "_low": "lower", "_high": "upper"}.items():
            of_single = f", {side} end of the interval of 95 % of single surfaces" if end else ", mean over surfaces"
            quantities[name + end] = text + of_single, unit
    variables = described(("level",), {name: getattr(estimate, name) for name in quantities}, quantities, length_unit)
    attributes = {
        "title": "Penetration of a self-affine indenter by the calibrated law, no simulation",
        "depth_error": estimate.law.depth_error,
        "velocity_error": estimate.law.velocity_error,
        "comment": "The mean over many surfaces lies within these shares of depth and velocity.",
    }
    return Content(variables, attributes)


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
    with path_named(path):
        return impulses(force, times)


def kinetics_to_content(motion: Kinetics, force: ArrayLike | None = None) -> Content:
    """A viscous.correspondence.Kinetics as a Content over its times; `force` is F there, or a constant; None for none.

    Where a depth is undetermined (before the curve's first level) or a velocity infinite, the value is missing.
    """
    given = {} if force is None else {"force": np.broadcast_to(np.asarray(force, dtype=float), motion.time.shape)}
    velocity = np.where(np.isinf(motion.velocity), np.nan, motion.velocity)
    values = {"time": motion.time, "depth": motion.depth, **given, "velocity": velocity}
    variables = described(("level",), values, _QUANTITIES, motion.length_unit)
    return Content(variables, {"title": "Penetration of a rigid indenter into a viscoelastic half-space"})
