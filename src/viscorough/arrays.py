"""Arrays that an object keeps: copies that cannot be changed, in which masked entries are nan; samples over time."""

import dataclasses
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscorough.types import Array


def read_only(values: Any) -> NDArray[Any]:
    """The values as an array that cannot be changed: a copy, unless already immutable.

    Masked entries of numpy's masked arrays, also of a list of them, become nan.
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


class ReadOnlyArrays:
    """Base of frozen dataclasses: fields declared as arrays become read-only ones, and are compared as a whole.

    Where a class has a text (`__str__`), notebooks show it, too, in place of all numbers of the arrays.
    """

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        # Else dataclasses compare tuples, of which arrays cannot be parts.
        cls.__eq__ = ReadOnlyArrays.__eq__  # type: ignore[method-assign]  # a dataclass makes one of its own
        if "__str__" in vars(cls):
            cls.__repr__ = cls.__str__  # type: ignore[method-assign]  # likewise

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        names = [field.name for field in dataclasses.fields(cast(Any, self))]
        return all(_are_equal(getattr(self, name), getattr(other, name)) for name in names)

    def __post_init__(self) -> None:
        for field in dataclasses.fields(cast(Any, self)):
            if field.type is np.ndarray:
                object.__setattr__(self, field.name, read_only(getattr(self, field.name)))


class ForceHistory(NamedTuple):
    """A force over time, linear between samples, and its integral; read-only arrays of shape (samples,).

    Attributes
    ----------
    times : array
        t, increasing, or the same in two samples: a step from one force to the other.
    force : array
        F(t) ≥ 0.
    impulse : array
        ∫F dt up to t.

    Examples
    --------
    >>> import viscorough
    >>> history = viscorough.impulses([0.0, 1.0], [0.0, 2.0])  # a ramp
    >>> history.impulse.tolist()
    [0.0, 1.0]
    """

    times: np.ndarray
    force: np.ndarray
    impulse: np.ndarray


def increasing(name: str, values: ArrayLike, *, above_zero: bool = False, steps: str | None = None) -> Array:
    """The values as a row of floats. Raises ValueError, which starts with the name, unless they increase.

    steps : quantity that steps at a time given twice, for the message; None if no value may be given twice
    """
    values = read_only(values)
    if values.dtype.kind in "iuf" and values.ndim == 1 and values.size and np.isfinite(values).all():
        values = values.astype(float)
        rises = np.diff(values)
        apart = rises if steps is None else rises[1:] + rises[:-1]  # from the one before, or the one before that
        if (rises >= 0).all() and (apart > 0).all() and (values[0] > 0 or not above_zero):
            return values
    allowed = f"one row of finite numbers{' above 0' if above_zero else ''}, each larger than the one before"
    raise ValueError(f"{name}: allowed is {allowed}{f', or given twice where {steps} steps' if steps else ''}")


def samples(name: str, values: ArrayLike | None, times: Array, reason: str = "") -> Array:
    """A load at the times, as floats. Raises ValueError unless there is a finite one from 0 on for each of them.

    reason : why it must be, for the message
    """
    values = read_only(values).astype(float)
    if values.shape != times.shape:
        raise ValueError(f"{name}: samples of shape {values.shape}; allowed: one per time, shape {times.shape}")
    if not (allowed := np.isfinite(values) & (values >= 0)).all():
        where = int(np.argmin(allowed))
        raise ValueError(f"{name}: sample {where} is {values[where]}; allowed: finite, 0 or more{reason}")
    return values


def jumps_and_slopes(times: Array, load: Array) -> tuple[Array, Array]:
    """Jumps of a load just before its samples, before the first of which it is 0, and its slopes from each to the next.

    times, load : shape (samples,); a time given twice is a jump

    Returns arrays of shapes (samples,) and (samples − 1,).
    """
    lengths, increments = np.diff(times), np.diff(load)
    slopes = np.divide(increments, lengths, out=np.zeros_like(increments), where=lengths > 0)
    return np.append(load[0], np.where(lengths == 0, increments, 0.0)), slopes


def integral(times: Array, values: Array, until: Any) -> Array:
    """Integrals, to times of any shape, of what is linear between samples and 0 before them, exactly.

    times, values : of the samples, shape (samples,)
    """
    at_samples = np.append(0.0, np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(times)))
    slopes = np.append(jumps_and_slopes(times, values)[1], 0.0)
    place = np.maximum(np.searchsorted(times, until, side="right") - 1, 0)
    after = np.maximum(until - times[place], 0)
    return at_samples[place] + after * (values[place] + 0.5 * slopes[place] * after)


def _are_equal(one: Any, other: Any) -> bool:
    """Whether two values are equal; nan equals nan in arrays."""
    if not isinstance(one, np.ndarray):
        return one == other
    return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")


def _cannot_change(array: NDArray[Any] | None) -> bool:
    """Whether an array and all arrays that it is a view of are read-only."""
    while isinstance(array, np.ndarray):
        if array.flags.writeable:
            return False
        array = array.base
    return array is None
