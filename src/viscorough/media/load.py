"""Load on an indenter: its depth, or the force on it, as a function of time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import increasing, real_numbers
from viscorough.basics.summaries import span
from viscorough.basics.types import Array, Integers

# Two times that differ by less than this share of their value count as equal. In a shorter interval, the change of a
# load would be as small as its rounding error.
_SAME_TIME = 1e-13
# A first value above this share of the largest value is a step and not due to noise.
_LARGEST_NOISE = 0.1
# Two slopes of a load count as equal if their relative difference is at most _SAME_SLOPE. If a sample follows a turn of
# the load after a time t, `shortest_interval` is at most _CLOSE · t.
_SAME_SLOPE, _CLOSE = 1e-6, 10.0


@dataclass(frozen=True, eq=False)
class Load:
    """Force or depth as a function of time, linear between samples; arrays of shape (samples,).

    Before the first sample, force and depth are zero, so that a first value above zero is a step (`kinetics` states an
    exception for noisy depths). Times are in s, forces in N and depths in m, or all numbers are in consistent units.

    Parameters
    ----------
    time : array_like
        Times t, increasing. A time given twice is a step from the first of its two values to the second.
    force : array_like, optional
        Force F ≥ 0 at the times of `time`. It cannot be negative, as there is no adhesion.
    depth : array_like, optional
        Depth u at the times of `time`. A negative depth lifts the indenter above the plane of first contact. Either the
        force or the depth must be given.

    Raises
    ------
    ValueError
        For times that decrease, values that are not finite, a negative force, and if neither or both of force and depth
        are given.

    Examples
    --------
    >>> import viscorough
    >>> load = viscorough.Load([0.0, 1.0, 3.0], force=[0.0, 2.0, 2.0])  # a ramp and a hold
    >>> load.integral.tolist()
    [0.0, 1.0, 5.0]
    """

    time: np.ndarray
    force: np.ndarray | None = None
    depth: np.ndarray | None = None

    if TYPE_CHECKING:  # the constructor also accepts lists, which become arrays

        def __init__(self, time: ArrayLike, force: ArrayLike | None = None, depth: ArrayLike | None = None) -> None: ...

    def __repr__(self) -> str:
        """Return a summary, without the arrays: the number of samples, and the ranges of times and values."""
        name = "depth" if self.by_depth else "force"
        return f"Load of {self.time.size} samples, time {span(self.time)}, {name} {span(self.values)}"

    def __post_init__(self) -> None:
        if (self.force is None) == (self.depth is None):
            raise ValueError("Load: one of force and depth is needed")
        name = "depth" if self.force is None else "force"
        time = increasing("Load: time", self.time, steps=f"the {name}")
        values = real_numbers(f"Load: {name}", getattr(self, name))
        if values.shape != time.shape:
            raise ValueError(
                f"Load: {name}: samples of shape {values.shape}; allowed: one per time, shape {time.shape}"
            )
        allowed = np.isfinite(values) if self.by_depth else np.isfinite(values) & (values >= 0)
        if not allowed.all():
            where = int(np.argmin(allowed))
            text = "finite" if self.by_depth else "finite, 0 or more (without adhesion a pull opens the contact)"
            raise ValueError(f"Load: {name}: sample {where} is {values[where]}; allowed: {text}")
        object.__setattr__(self, "time", time)
        object.__setattr__(self, name, values)

    @property
    def by_depth(self) -> bool:
        """Return True if the load prescribes the depth, False if it prescribes the force."""
        return self.force is None

    @property
    def values(self) -> Array:
        """Return the samples of the prescribed depth or force, shape (samples,)."""
        values = self.depth if self.force is None else self.force
        assert values is not None
        return values

    @property
    def integral(self) -> Array:
        """Return ∫F dt or ∫u dt from the first sample to each sample, shape (samples,)."""
        means = 0.5 * (self.values[1:] + self.values[:-1])
        return np.append(0.0, np.cumsum(means * np.diff(self.time)))

    @property
    def jumps(self) -> Array:
        """Return the jump of the load just before each sample, shape (samples,)."""
        return np.append(self.values[0], np.where(np.diff(self.time) == 0, np.diff(self.values), 0.0))

    @property
    def slopes(self) -> Array:
        """Return the slope of the load from each sample to the next, shape (samples − 1,); 0 at a step."""
        lengths, rises = np.diff(self.time), np.diff(self.values)
        return np.divide(rises, lengths, out=np.zeros_like(rises), where=lengths > 0)

    @property
    def duration(self) -> float:
        """Return the time from the first to the last sample."""
        return float(self.time[-1] - self.time[0])

    @property
    def shortest_interval(self) -> float:
        """Return the shortest interval between two successive turns; 1 if the duration is 0.

        At a turn, the slope of the load changes, or a step begins or ends. A sample soon after any turn also limits the
        result: the result is at most _CLOSE times the time from the turn to the sample.
        """
        if self.duration == 0:
            return 1.0
        time, values = self.time, self.values
        lengths = np.diff(time)
        # The slope is nan at a step of the load.
        slopes = np.divide(np.diff(values), lengths, out=np.full(lengths.size, np.nan), where=lengths > 0)
        differ = ~(np.abs(np.diff(slopes)) <= _SAME_SLOPE * np.maximum(np.abs(slopes[1:]), np.abs(slopes[:-1])))
        turns = np.concatenate([[True], differ, [True]])
        latest = time[np.maximum.accumulate(np.where(turns, np.arange(time.size), 0))]
        between, since = np.diff(time[turns]), time - latest
        return float(min(between[between > 0].min(), _CLOSE * since[since > 0].min(initial=np.inf)))

    def with_times(self, times: ArrayLike) -> tuple[Load, Integers]:
        """Return the load with samples added at `times`, and the indices of the samples at `times`.

        If the load steps at a time, the index belongs to the sample after the step. Times that are equal within
        rounding share a sample. Raises ValueError if `times` do not increase or lie outside the load.
        """
        times = increasing("times", times)
        rounding = _SAME_TIME * np.abs(times)
        if times[0] < self.time[0] - rounding[0] or times[-1] > self.time[-1] + rounding[-1]:
            kind = "depth" if self.by_depth else "force"
            raise ValueError(
                f"times: from {times[0]:g} to {times[-1]:g}; allowed: within the history of the {kind}, "
                f"{self.time[0]:g} to {self.time[-1]:g}"
            )
        apart = (_distance(times, self.time) > rounding) & (np.diff(times, prepend=-np.inf) > rounding)
        new = times[apart]
        place = np.searchsorted(self.time, new)
        values = np.insert(self.values, place, np.interp(new, self.time, self.values))
        load = Load(np.insert(self.time, place, new), **{"depth" if self.by_depth else "force": values})
        return load, np.searchsorted(load.time, times + rounding, side="right") - 1

    def with_first_ramp(self) -> Load:
        """Return the load with a ramp from zero before the first sample, if this sample is above zero by chance.

        A record that was shifted to zero before contact often begins slightly above zero, because of noise. This is
        assumed if the first value is above zero, but neither above a tenth of the largest value nor above the largest
        rise from a sample to the next. The ramp then begins at zero, and lasts as long as the interval between the
        first two samples. Any other load is returned unchanged: a larger first value is a step, as is a time that is
        given twice.
        """
        time, values = self.time, self.values
        lengths, rises = np.diff(time), np.diff(values)
        if time.size < 2 or lengths[0] == 0:
            return self
        if not 0 < values[0] <= min(rises[lengths > 0].max(), _LARGEST_NOISE * values.max()):
            return self
        name = "depth" if self.by_depth else "force"
        return Load(np.append(2 * time[0] - time[1], time), **{name: np.append(0.0, values)})


def _distance(times: Array, samples: Array) -> Array:
    """Return the distance of each time from the nearest sample time; both arrays increase."""
    after = np.searchsorted(samples, times)
    before = np.abs(times - samples[np.maximum(after - 1, 0)])
    return np.minimum(before, np.abs(samples[np.minimum(after, samples.size - 1)] - times))
