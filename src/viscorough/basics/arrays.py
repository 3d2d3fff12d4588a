"""Check numbers and arrays in arguments.

Public functions check their numbers with these functions. Values are SI numbers, or numbers in consistent units; texts,
truth values, masked arrays and quantities with a unit are refused. `name` is always the name of the checked argument,
with which the error message starts.
"""

import contextlib
import math
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.types import Array, Numbers


def real_numbers(name: str, values: Any) -> Array:
    """Return the values as a new array of double precision; they may be nan or infinite.

    Raises ValueError, with a message that starts with `name`, unless the values are plain real numbers.
    """
    array = np.array(np.nan, object)
    if not (np.ma.isMaskedArray(values) or hasattr(values, "units")):
        with contextlib.suppress(ValueError):  # numpy raises it for rows of different lengths
            array = np.asarray(values)
    if array.dtype.kind not in "iuf":
        found = f"an array of {array.dtype}" if array.ndim else shown(values)
        raise ValueError(f"{name}: {found}; real numbers are needed")
    return array.astype(float)  # a copy, so that results do not change with the arguments


def real_number(name: str, value: Any) -> float:
    """Return the value as a finite float. Raises ValueError like `real_numbers`, and for arrays, nan and infinity."""
    array = real_numbers(name, value)
    if array.ndim or not math.isfinite(array):
        raise ValueError(f"{name}: {shown(value)}; one finite number is needed")
    return float(array)


def positive(name: str, value: Any) -> float:
    """Return the value as a float. Raises ValueError unless 0 < value < infinity; the message starts with `name`."""
    try:
        number = real_number(name, value)
    except ValueError:
        number = math.nan
    if not number > 0:
        raise ValueError(f"{name}: must be a positive number, not {shown(value)}")
    return number


def fraction(name: str, value: Any) -> float:
    """Return the value as a float. Raises ValueError unless 0 < value ≤ 1; the message starts with `name`."""
    number = real_number(name, value)
    if not 0 < number <= 1:
        raise ValueError(f"{name} must lie in (0, 1], not {number!r}")
    return number


def float_or_array(name: str, values: Any) -> Numbers:
    """Return numbers for use in a formula: a float for a single number, otherwise an array."""
    numbers = real_numbers(name, values)
    return numbers if numbers.ndim else float(numbers)


def whole_number(name: str, value: Any, at_least: int, at_most: float = 2**63 - 1) -> int:
    """Return the value as an int.

    Raises ValueError, with a message that starts with `name`, unless the value is a whole number from `at_least` to
    `at_most`.
    """
    is_whole = isinstance(value, Integral) and not isinstance(value, bool | np.timedelta64)
    if not is_whole or not at_least <= value <= at_most:
        needed = f"of at least {at_least}" if at_most >= 2**63 - 1 else f"from {at_least} to {at_most:g}"
        raise ValueError(f"{name}: must be a whole number {needed}, not {shown(value)}")
    return int(value)


def shown(value: Any) -> str:
    """Return the repr of a value for a message, on one line and cut off after 60 characters."""
    return " ".join(repr(value).split())[:60]


def increasing(name: str, values: ArrayLike, *, above_zero: bool = False, steps: str | None = None) -> Array:
    """Return the values as a one-dimensional array of floats. Raises ValueError unless the values increase.

    name : name of the values, with which the message of the error starts
    above_zero : True if the first value must be above 0
    steps : None if all values must differ. Otherwise the values are times, and a time may be given twice, which means a
        step of a quantity at this time; `steps` is the name of this quantity for the message
    """
    values = real_numbers(name, values)
    if values.ndim == 1 and values.size and np.isfinite(values).all():
        rises = np.diff(values)
        # Differences that must be above 0. Without steps they are the differences v[i + 1] − v[i] of the values v. With
        # steps they are v[i + 2] − v[i], so that a time can be given twice, but not three times.
        apart = rises if steps is None else rises[1:] + rises[:-1]
        if (rises >= 0).all() and (apart > 0).all() and (values[0] > 0 or not above_zero):
            return values
    allowed = f"one row of finite numbers{' above 0' if above_zero else ''}, each larger than the one before"
    raise ValueError(f"{name}: allowed is {allowed}{f', or given twice where {steps} steps' if steps else ''}")
