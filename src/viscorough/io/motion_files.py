"""Convert motions and estimates to the content of NetCDF files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscorough.io.curves import OVER_LEVELS, described
from viscorough.io.netcdf import Content
from viscorough.results.motion import Motion

if TYPE_CHECKING:
    from viscorough.law.estimate import Estimate


# Variables with one value for each time: {name: (long_name, SI unit)}.
_QUANTITIES: dict[str, tuple[str, str]] = {
    **OVER_LEVELS,
    "time": ("time since the load was applied", "s"),
    "x": ("dimensionless force X = F J(t)/(4 h L)", "1"),
    "velocity": ("velocity of penetration du/dt", "m s-1"),
    "force": ("force F at that time", "N"),
}


def estimate_to_content(estimate: Estimate, length_unit: str = "1") -> Content:
    """Convert an Estimate to the content of a NetCDF file. Values are nan at times when the law does not hold."""
    quantities = {name: _QUANTITIES[name] for name in ("time", "x")}
    for name, text, unit in (("depth", "depth of penetration u", "m"), ("velocity", *_QUANTITIES["velocity"])):
        quantities[name] = (f"{text}, mean over surfaces", unit)
    variables: dict[str, Any] = {
        name: (("level",), getattr(estimate, name), described(*quantity, length_unit))
        for name, quantity in quantities.items()
    }
    attributes: dict[str, Any] = {
        "title": "Penetration of a self-affine indenter by the calibrated law, no simulation",
        "depth_error": estimate.law.depth_error,
        "velocity_error": estimate.law.velocity_error,
        "comment": "The mean over many surfaces lies within these shares of depth and velocity.",
    }
    return variables, attributes


def motion_to_content(motion: Motion) -> Content:
    """Convert a Motion to the content of a NetCDF file, whose dimension `level` counts the times of the motion.

    Undetermined values (at times before the first level of the loading curve) and infinite values become nan.
    """
    names = ("time", "depth", "force", "velocity", "contact_fraction")
    finite = {name: np.where(np.isinf(values := getattr(motion, name)), np.nan, values) for name in names}
    attributes: dict[str, Any] = {"title": "Motion of a rigid indenter in a viscoelastic half-space"}
    if np.isfinite(motion.receding_from):
        text = "From the time receding_from on the contact has receded, at first."
        attributes |= {"receding_from": motion.receding_from, "comment": text}
    unit = motion.length_unit
    return {name: (("level",), finite[name], described(*_QUANTITIES[name], unit)) for name in names}, attributes
