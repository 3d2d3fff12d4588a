"""Unpack the values of NetCDF variables, and mask missing values (CF-1.11, sections 2.5 and 8).

Attributes of a variable state which values are missing. netCDF4 and xarray ignore an attribute whose type differs from
the type of the variable, such as a missing value of 1e20 in double precision for a variable in single precision. The
value 1e20 would then become the highest peak.
"""

from typing import Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

from viscorough.basics.types import Array

# Attributes that state which values are missing (MISSING), and all attributes that describe how values are stored
# (STORAGE). None of them applies to unpacked values.
MISSING = ("_FillValue", "missing_value", "valid_range", "valid_min", "valid_max")
STORAGE = (*MISSING, "scale_factor", "add_offset", "_Unsigned")
_DEFAULT_FILL = {kind: [fill] for kind, fill in netCDF4.default_fillvals.items() if kind not in ("i1", "u1")}


def unpacked(variable: netCDF4.Variable) -> NDArray[Any]:
    """Return the unpacked values of a netCDF4.Variable, as a masked array if any are missing; text is unchanged.

    A value is missing if it equals _FillValue or missing_value, or lies outside valid_range or valid_min and valid_max.
    Without the attribute _FillValue, the default fill value of NetCDF marks missing values, but not in variables of
    single bytes, in which all values are valid. If _Unsigned is "true", whole numbers that are stored in a signed type
    are read as unsigned numbers. If _Unsigned is "false", unsigned numbers are read as signed numbers.

    Raises ValueError if an attribute is not a number of the stored type, or if _Unsigned is another text.
    """
    variable.set_auto_maskandscale(False)
    stored = np.asarray(variable[...])
    if stored.dtype.kind not in "iuf":
        return stored
    kind = _kind(variable, stored.dtype)
    names = [name for name in variable.ncattrs() if name in STORAGE and name != "_Unsigned"]
    stated = {name: _numbers(variable, name, stored.dtype, kind) for name in names}
    default = _as_kind(np.array(_DEFAULT_FILL.get(stored.dtype.str[1:], [])), stored.dtype, kind)
    stored = stored.view(kind)
    low, high = stated.get("valid_range", (-np.inf, np.inf))
    missing = stored < max(low, *stated.get("valid_min", [low]))
    missing |= stored > min(high, *stated.get("valid_max", [high]))
    for mark in [*stated.get("_FillValue", default), *stated.get("missing_value", [])]:
        missing |= stored == mark
    values = stored
    if {"scale_factor", "add_offset"} & set(stated):
        values = stored * np.float64(stated.get("scale_factor", [1])[0]) + np.float64(stated.get("add_offset", [0])[0])
    return np.ma.array(values, mask=missing) if missing.any() else values


def _kind(variable: netCDF4.Variable, stored: np.dtype[Any]) -> np.dtype[Any]:
    """Return the type of the values: the stored type, made signed or unsigned as the attribute _Unsigned requires."""
    if "_Unsigned" not in variable.ncattrs() or stored.kind == "f":
        return stored
    text = str(variable.getncattr("_Unsigned")).lower()
    if text not in ("true", "false"):
        raise ValueError(f"attribute _Unsigned of {variable.name} is {text!r}, not 'true' or 'false'")
    return np.dtype(f"{stored.byteorder}{'u' if text == 'true' else 'i'}{stored.itemsize}")


def _as_kind(numbers: Array, stored: np.dtype[Any], kind: np.dtype[Any]) -> Array:
    """Reinterpret the bytes of whole numbers of the type `stored` as numbers of the type `kind`.

    Numbers that are not whole, and numbers that the type `stored` cannot hold, are returned unchanged.
    """
    if kind == stored or not numbers.size or numbers.dtype.kind not in "iu":
        return numbers
    limits = np.iinfo(stored)
    if numbers.min() < limits.min or numbers.max() > limits.max:
        return numbers
    return np.asarray(numbers, stored).view(kind)


def _numbers(variable: netCDF4.Variable, name: str, stored: np.dtype[Any], kind: np.dtype[Any]) -> Array:
    """Return the attribute `name` of a variable as an array of numbers.

    Numbers that are compared with the stored values, such as missing_value, get the precision of the stored values.

    stored : type of the stored values
    kind : type of the values: like `stored`, but perhaps unsigned instead of signed, or signed instead of unsigned

    Raises ValueError if the attribute does not hold the type and the count of numbers that its name requires.
    """
    value = variable.getncattr(name)
    numbers = np.ravel(value)
    count = {"valid_range": 2, "missing_value": numbers.size}.get(name, 1)
    # If the stored values are whole numbers, a limit with a decimal point may be meant for the unpacked values. It is
    # not certain, so such a limit is refused.
    odd_limit = name.startswith("valid") and stored.kind != "f" and numbers.dtype.kind == "f"
    if numbers.dtype.kind not in "iuf" or numbers.size != count or odd_limit:
        needed = "two numbers" if name == "valid_range" else "a number"
        raise ValueError(f"attribute {name} of {variable.name} is {value!r}, not {needed} like those stored")
    if name in ("scale_factor", "add_offset"):
        return numbers
    if stored.kind == "f":
        with np.errstate(over="ignore"):
            return numbers.astype(stored)
    return _as_kind(numbers, stored, kind)
