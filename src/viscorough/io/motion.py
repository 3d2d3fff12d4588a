"""Motions in NetCDF files, and loads read from files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscorough.io.atomic import path_named
from viscorough.io.columns import read_columns
from viscorough.io.curves import OVER_LEVELS
from viscorough.io.netcdf import Content, Quantities, described
from viscorough.types import FilePath
from viscorough.viscous.load import Load
from viscorough.viscous.motion import Motion

if TYPE_CHECKING:
    from viscorough.estimates import Estimate


# Quantities over time.
_QUANTITIES: Quantities = {
    **OVER_LEVELS,
    "time": ("time since the load was applied", "time"),
    "x": ("dimensionless force X = F J(t)/(4 h L)", 0),
    "velocity": ("velocity of penetration du/dt", "velocity"),
    "force": ("force F at that time", "N"),
}


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


def read_load(path: FilePath, kind: str, length_unit: str) -> Load:
    """Read the Load in a file; see `Load.read`."""
    if kind not in ("force", "depth"):
        raise ValueError(f"kind {kind!r}; allowed: force, depth")
    unit = "N" if kind == "force" else length_unit
    times, values = read_columns(path, f"a {kind} history", {"time": "s", kind: unit}, length_unit)
    with path_named(path):
        return Load(times, **{kind: values})


def motion_to_content(motion: Motion) -> Content:
    """Return a Motion as a Content over its times.

    Where a value is undetermined (before the curve's first level) or infinite, it is missing.
    """
    names = ("time", "depth", "force", "velocity", "contact_fraction")
    finite = {name: np.where(np.isinf(values := getattr(motion, name)), np.nan, values) for name in names}
    attributes: dict[str, Any] = {"title": "Motion of a rigid indenter in a viscoelastic half-space"}
    if np.isfinite(motion.receding_from):
        text = "From the time receding_from on the contact has receded, at first."
        attributes |= {"receding_from": motion.receding_from, "comment": text}
    return Content(described(("level",), finite, _QUANTITIES, motion.length_unit), attributes)
