"""Check numbers and arrays in arguments, store arrays read-only in objects, and evaluate samples over time.

Every public function checks its plain numbers with `real_number`, `real_numbers` or `whole_number`. Numbers that may
have a unit are first converted by viscorough.basics.units. Objects store arrays as copies that cannot be changed, in
which masked entries are nan. `name` is always the name of the checked argument, with which the error message starts.
"""

import contextlib
import dataclasses
import functools
import math
from collections.abc import Iterator
from numbers import Integral, Real
from typing import Any, cast, get_args, get_type_hints

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscorough.basics.types import Array, Mask, Numbers

# Values of these types have no unit. Comparing the type is faster than looking for an attribute `units`.
_PLAIN = {float, int, bool, str, complex, type(None), np.float64, np.ndarray}
# Names, for messages, of values that are no real numbers: {attribute `kind` of their numpy.dtype: name}.
_KINDS = {"b": "truth values", "c": "complex numbers", "U": "texts", "S": "texts", "m": "times", "M": "dates"}
# Python counts these types as whole numbers (numbers.Integral), but truth values and durations are refused as numbers.
_NO_NUMBERS = (bool, np.timedelta64)
_BEYOND = "a number beyond double precision; a number that double precision holds is needed"


def read_only(values: Any) -> NDArray[Any]:
    """Return the values as an array that cannot be changed: a copy, unless the given array is immutable already.

    Masked entries of a masked array of numpy, or of masked arrays in a list, become nan.
    """
    if isinstance(values, list | tuple) and any(map(np.ma.isMaskedArray, values)):
        values = np.ma.array(values)
    mask, array = np.ma.getmask(values), np.ma.getdata(values, subok=False)
    if mask is not np.ma.nomask and mask.any() and array.dtype.kind in "iuf":
        array = np.where(mask, np.nan, array)
    elif not _cannot_change(array):
        array = np.array(array)
    array.flags.writeable = False
    return array


def unit_attribute(value: Any) -> str:
    """Return the unit of a quantity of pint or a similar library (attribute `units` or `unit`); "" for plain values.

    For a list or an array of objects, return the first unit among its entries.
    """
    if type(value) is np.ndarray and value.dtype.kind == "O":
        value = list(value.flat)
    if isinstance(value, list | tuple):
        return next(filter(None, map(unit_attribute, value)), "")
    if type(value) in _PLAIN:
        return ""
    unit = getattr(value, "units", getattr(value, "unit", ""))
    return "" if unit is None or callable(unit) else str(unit)


@contextlib.contextmanager
def named(name: str) -> Iterator[None]:
    """Replace errors that numpy raises within this context by a ValueError; its message starts with `name`."""
    try:
        yield
    except ValueError:
        raise ValueError(f"{name}: rows of different lengths; rows of one length are needed") from None
    except OverflowError:
        raise ValueError(f"{name}: {_BEYOND}") from None


def real_numbers(name: str, values: Any) -> Array:
    """Return the values as a read-only array of double precision; masked entries are nan.

    values : real numbers of any type and shape, which may be nan or infinite

    Raises ValueError, with a message that starts with `name`, for complex numbers, truth values, texts, other objects
    and quantities with a unit, for rows of different lengths, and for numbers beyond double precision.
    """
    if unit := unit_attribute(values):
        raise ValueError(f"{name}: has the unit {unit}; plain numbers are needed")
    with named(name):
        array = read_only(values)
        if array.dtype.kind == "O" and all(isinstance(v, Real) and not isinstance(v, _NO_NUMBERS) for v in array.flat):
            array = np.array([float(v) for v in array.flat]).reshape(array.shape)
    if array.dtype.kind not in "iuf" or _holds_truth_value(values):
        found = _KINDS.get(array.dtype.kind, "something else than real numbers")
        raise ValueError(f"{name}: {found if array.ndim else shown(values)}; real numbers are needed")
    with np.errstate(over="ignore", under="ignore"):
        converted = array.astype(float, copy=False)
    if array.itemsize > 8 and ((np.isinf(converted) & np.isfinite(array)) | ((converted == 0) & (array != 0))).any():
        raise ValueError(f"{name}: {_BEYOND}")
    return read_only(converted)


def real_number(name: str, value: Any) -> float:
    """Return the value as a finite float.

    Raises ValueError like `real_numbers`, and also for an array of values, for nan and for infinity.
    """
    value = _float(name, value)
    if not math.isfinite(value):
        raise ValueError(f"{name}: {value}; a finite number is needed")
    return value


def positive(name: str, value: float) -> float:
    """Return the value as a float. Raises ValueError unless 0 < value < infinity; the message starts with `name`."""
    try:
        number = float(real_numbers(name, value))
    except (TypeError, ValueError):
        raise ValueError(f"{name}: must be a positive number, not {shown(value)}") from None
    if not (math.isfinite(number) and number > 0):
        raise ValueError(f"{name}: must be positive and finite, not {number}")
    return number


def _float(name: str, value: Any) -> float:
    """Return the value as a float, which may be nan or infinite. Raises ValueError like `real_number`."""
    if type(value) is float:
        return value
    array = real_numbers(name, value)
    if array.ndim:
        raise ValueError(f"{name}: an array of shape {array.shape}; one number is needed")
    return float(array)


def float_or_array(name: str, values: Any) -> Numbers:
    """Return numbers for use in a formula: a float for a single number, otherwise an array.

    A Series of pandas, or a similar object with labels, is returned unchanged if its numbers are in double precision.
    Raises ValueError like `real_numbers`.
    """
    numbers = real_numbers(name, values)
    if not numbers.ndim:
        return float(numbers)
    keeps_labels = hasattr(values, "dtype") and not isinstance(values, np.ndarray) and values.dtype == numbers.dtype
    return values if keeps_labels else numbers


def whole_number(name: str, value: Any, at_least: int, at_most: float = 2**63 - 1) -> int:
    """Return the value as an int.

    Raises ValueError, with a message that starts with `name`, unless the value is a whole number from `at_least` to
    `at_most`.
    """
    if not is_whole(value) or value < at_least:
        raise ValueError(f"{name}: must be a whole number of at least {at_least}, not {shown(value)}")
    if value > at_most:
        raise ValueError(f"{name}: must be a whole number of at most {at_most}, not {shown(value)}")
    return int(value)


def is_whole(value: Any) -> bool:
    """Return True for a whole number of any integer type; truth values and durations (timedelta64) do not count."""
    return isinstance(value, Integral) and not isinstance(value, _NO_NUMBERS)


def fraction(name: str, value: Any) -> float:
    """Return the value as a float. Raises ValueError unless 0 < value ≤ 1; the message starts with `name`."""
    number = real_number(name, value)
    if not 0 < number <= 1:
        raise ValueError(f"{name} must lie in (0, 1], not {number!r}")
    return number


def shown(value: Any) -> str:
    """Return the repr of a value for a message, on one line and cut off after 60 characters."""
    try:
        return " ".join(repr(value).split())[:60]
    except ValueError:  # Python refuses to write a whole number of more than 4300 digits
        return type(value).__name__


class ReadOnlyArrays:
    """Base class of frozen dataclasses whose arrays are read-only and are compared as a whole.

    A field that is declared as an array of numbers, a float or an int accepts only real numbers; other values raise
    ValueError. Arrays stay read-only in copies and after pickling. If a class defines `__str__`, notebooks show this
    text instead of all numbers of the arrays.
    """

    # With None, numpy leaves `array == object` to the method __eq__ of this class. Otherwise numpy would compare the
    # object with each entry of the array.
    __array_ufunc__ = None

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        # The comparison that a dataclass generates compares tuples of the fields, which fails for arrays.
        cls.__eq__ = ReadOnlyArrays.__eq__  # type: ignore[method-assign]  # prevents the generated __eq__
        if "__str__" in vars(cls) and "__repr__" not in vars(cls):
            cls.__repr__ = cls.__str__  # type: ignore[method-assign]  # prevents the generated __repr__

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        names = [field.name for field in dataclasses.fields(cast(Any, self)) if field.compare]
        return all(_are_equal(getattr(self, name), getattr(other, name)) for name in names)

    def __post_init__(self) -> None:
        for field, declared in _types_of_fields(cast(Any, type(self))).items():
            value, name = getattr(self, field), f"{type(self).__name__}: {field}"
            kinds: Any = (declared,) if declared in _CONVERSIONS else get_args(declared)
            for kind in kinds if value is not None or type(None) not in kinds else ():
                if kind in _CONVERSIONS:
                    object.__setattr__(self, field, _CONVERSIONS[kind](name, value))

    def __setstate__(self, state: dict[str, Any]) -> None:
        for name, value in state.items():
            object.__setattr__(self, name, value)
            if isinstance(value, np.ndarray):
                value.flags.writeable = False


@functools.cache
def _types_of_fields(made: Any) -> dict[str, Any]:
    """Return {field: type} of a dataclass, also if its annotations are texts (from __future__ import annotations)."""
    types = get_type_hints(made)
    return {field.name: types[field.name] for field in dataclasses.fields(made)}


def _kept_numbers(name: str, values: Any) -> NDArray[Any]:
    """Return the values as a read-only array.

    Whole numbers and numbers in single precision keep their type. All other numbers are converted to double precision.
    """
    numbers = real_numbers(name, values)
    kept = np.ma.getdata(values, subok=False).dtype
    return read_only(values) if kept.kind in "iu" or kept == np.float32 else numbers


def _truth_values(name: str, values: Any) -> Mask:
    """Return the values as a read-only array of truth values. Raises ValueError for values of other types."""
    array = read_only(values)
    if array.dtype != bool:
        raise ValueError(f"{name}: {array.dtype}; truth values are needed")
    return array


class ReadOnlyTuple(tuple[Any, ...]):
    """Base class of named tuples whose arrays are read-only, also in copies, and are compared as a whole.

    A derived class names this class first among its bases, and then a NamedTuple that declares the fields.
    """

    __slots__ = ()
    __array_ufunc__ = None

    def __new__(cls, *arrays: Any, **named: Any) -> Any:
        made = super().__new__(cls, *arrays, **named)  # calls __new__ of the NamedTuple, the second base
        return tuple.__new__(cls, [read_only(array) for array in made])

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and all(map(_are_equal, self, cast(Any, other)))

    def __ne__(self, other: object) -> bool:  # replaces the __ne__ that tuple defines
        return not self == other


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


def jumps_and_slopes(times: Array, load: Array) -> tuple[Array, Array]:
    """Return the jump of a load just before each sample, and its slope from each sample to the next.

    times, load : samples, shape (samples,). A repeated time means a jump. The load is 0 before the first sample

    Returns the jumps, shape (samples,), and the slopes, shape (samples − 1,); the slope is 0 at a jump.
    """
    lengths, increments = np.diff(times), np.diff(load)
    slopes = np.divide(increments, lengths, out=np.zeros_like(increments), where=lengths > 0)
    return np.append(load[0], np.where(lengths == 0, increments, 0.0)), slopes


def integral(times: Array, values: Array, until: Any) -> Array:
    """Return the exact integral of a sampled function up to each time of `until`.

    The function is 0 before the first sample, linear between samples, and constant after the last sample.

    times, values : samples of the function, shape (samples,)
    until : upper limits of the integral, of any shape; the result has this shape
    """
    at_samples = np.append(0.0, np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(times)))
    slopes = np.append(jumps_and_slopes(times, values)[1], 0.0)
    place = np.maximum(np.searchsorted(times, until, side="right") - 1, 0)
    after = np.maximum(until - times[place], 0)
    return at_samples[place] + after * (values[place] + 0.5 * slopes[place] * after)


def _holds_truth_value(values: Any) -> bool:
    """Return True for a truth value, and for a list or an array of objects that contains a truth value.

    numpy would convert a truth value among numbers to 0 or 1.
    """
    if type(values) is np.ndarray and values.dtype.kind == "O":
        values = list(values.flat)
    if isinstance(values, list | tuple):
        return any(map(_holds_truth_value, values))
    return isinstance(values, bool | np.bool_)


def _are_equal(one: Any, other: Any) -> bool:
    """Return True if the values that two objects have in the same field are equal; nan equals nan."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other, equal_nan=one.dtype.kind == other.dtype.kind == "f")
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (math.isnan(one) and math.isnan(other))
    return one is other or (type(one) is type(other) and bool(one == other))


_CONVERSIONS: dict[Any, Any] = {
    np.ndarray: _kept_numbers,
    Mask: _truth_values,
    float: _float,
    int: functools.partial(whole_number, at_least=0),
}


def _cannot_change(array: NDArray[Any] | None) -> bool:
    """Return True if an array, and all arrays that it is a view of, are read-only."""
    while isinstance(array, np.ndarray):
        if array.flags.writeable:
            return False
        array = array.base
    return array is None
