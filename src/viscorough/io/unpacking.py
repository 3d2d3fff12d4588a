"""Values of NetCDF variables: what their attributes say about packing and missing values (CF-1.11, sections 2.5 and 8).

netCDF4 and xarray ignore attributes whose type is not that of the variable, such as a missing value of 1e20 in double
precision for a variable in single precision, so that a missing value would become the highest peak.
"""

from typing import Any

import netCDF4
import numpy as np
from netCDF4 import Variable as NetCDFVariable
from numpy.typing import NDArray

from viscorough.types import Array, Integers, Mask

# Attributes that describe how values are stored; they no longer hold for values that were read.
MISSING = ("_FillValue", "missing_value", "valid_range", "valid_min", "valid_max")
STORAGE = (*MISSING, "scale_factor", "add_offset", "_Unsigned")
_DEFAULT_FILL = {kind: fill for kind, fill in netCDF4.default_fillvals.items() if kind not in ("i1", "u1")}


def unpacked(variable: NetCDFVariable) -> NDArray[Any]:
    """The values of a netCDF4.Variable: unpacked, as a masked array if any are missing; text is returned unchanged.

    Missing are those that equal _FillValue (without it, what the format writes where nothing was written, except for
    single bytes, of which every value is valid) or missing_value, and those outside valid_range or valid_min and
    valid_max. Raises ValueError where one of these attributes is not a number.
    """
    variable.set_auto_maskandscale(False)
    stored = np.asarray(variable[...])
    if stored.dtype.kind not in "iuf":
        return stored
    attributes = {name: variable.getncattr(name) for name in variable.ncattrs() if name in STORAGE}
    if str(attributes.pop("_Unsigned", "false")).lower() == "true" and stored.dtype.kind == "i":
        stored = stored.view(stored.dtype.str.replace("i", "u"))
    numbers = {name: _numbers(variable, name, value, stored.dtype) for name, value in attributes.items()}
    scale, offset = numbers.get("scale_factor"), numbers.get("add_offset")
    values = stored
    if scale is not None or offset is not None:
        values = stored * np.float64(1 if scale is None else scale[0]) + np.float64(0 if offset is None else offset[0])
    missing = _absent(stored, numbers) | _invalid(stored, values, numbers)
    return np.ma.array(values, mask=missing) if missing.any() else values


def _numbers(variable: NetCDFVariable, name: str, value: float, stored: np.dtype[Any]) -> Array:
    """An attribute as an array of numbers; those that are compared with stored values have their precision."""
    try:
        numbers = np.atleast_1d(np.asarray(value)).ravel()
        if numbers.dtype.kind not in "iuf":
            numbers = numbers.astype(float)
    except (TypeError, ValueError):
        numbers = np.empty(0)
    allowed = {"valid_range": [2], "missing_value": range(1, numbers.size + 1)}.get(name, [1])
    if numbers.size not in allowed:
        wanted = "two numbers" if name == "valid_range" else "a number"
        raise ValueError(f"attribute {name} of {variable.name} is {value!r}, not {wanted}")
    if stored.kind == "f" and name not in ("scale_factor", "add_offset"):
        with np.errstate(over="ignore"):
            return numbers.astype(stored)
    signed = stored.str.replace("u", "i")
    return numbers.view(stored) if numbers.dtype == signed else numbers  # as the format stores unsigned numbers


def _absent(stored: NDArray[Any], numbers: dict[str, Any]) -> Mask:
    """Where stored values are the fill value or a missing value."""
    kind, absent = stored.dtype.str[1:], np.zeros(stored.shape, dtype=bool)
    default = [_DEFAULT_FILL[kind]] if kind in _DEFAULT_FILL else []
    for mark in (*numbers.get("_FillValue", default), *numbers.get("missing_value", ())):
        absent |= np.isnan(stored) if np.isnan(mark) else stored == mark
    return absent


def _invalid(stored: NDArray[Any], values: Array | Integers, numbers: dict[str, Any]) -> Mask:
    """Where values lie outside the valid range, which holds for stored values or, if it is finer, for unpacked ones."""
    invalid = np.zeros(stored.shape, dtype=bool)
    limits = {name: numbers[name] for name in ("valid_range", "valid_min", "valid_max") if name in numbers}
    for name, limit in limits.items():
        compared = values if limit.dtype.kind == "f" and stored.dtype.kind != "f" else stored
        if name != "valid_max":
            invalid |= compared < limit[0]
        if name != "valid_min":
            invalid |= compared > limit[-1]
    return invalid
