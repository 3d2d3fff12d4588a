"""A measured creep compliance, as a medium."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viscorough.arrays import ReadOnlyArrays, read_only

_ROUNDING = 1e-9  # relative; slopes of tables with ten digits may increase by as much


@dataclass(frozen=True)
class CreepTable(ReadOnlyArrays):
    """A measured creep compliance, linear between its points.

    times : 0 and increasing; compliances : J at these times, J(0+) first; arrays of shape (points,), copied

    Raises ValueError unless there are two points, all are finite and J is 0 or more, does not decrease and is concave,
    as the compliance of every passive medium is: noise has to be smoothed first. Beyond its last point nothing is
    known.
    """

    times: np.ndarray
    compliances: np.ndarray

    def __post_init__(self):
        super().__post_init__()
        times, values = self.times, self.compliances
        if times.ndim != 1 or times.shape != values.shape or times.size < 2:
            raise ValueError(
                f"CreepTable: shapes {times.shape} and {values.shape}; allowed: two rows of equal length, 2+"
            )
        if not all(array.dtype.kind in "iuf" and np.isfinite(array).all() for array in (times, values)):
            raise ValueError("CreepTable: allowed are finite real numbers")
        for name, array in (("times", times), ("compliances", values)):
            object.__setattr__(self, name, read_only(array.astype(float)))
        if times[0] != 0 or not (np.diff(times) > 0).all():
            raise ValueError("CreepTable: allowed are times that start with 0 and increase")
        slopes = self._slopes
        if not (values[0] >= 0 and (slopes >= 0).all() and values[-1] > 0 and np.isfinite(slopes).all()):
            raise ValueError("CreepTable: allowed is a compliance that starts at 0 or more, grows and never decreases")
        if (steeper := slopes[1:] > slopes[:-1] * (1 + _ROUNDING)).any():
            where = self.times[1 + int(np.argmax(steeper))]
            raise ValueError(
                f"CreepTable: J grows faster after time {where:g} than before; allowed: a concave J, as of every "
                "passive medium (smooth what was measured)"
            )

    @cached_property
    def _slopes(self):
        return np.diff(self.compliances) / np.diff(self.times)

    @cached_property
    def _integrals(self):
        """∫J dt up to every point."""
        return np.append(0.0, np.cumsum(0.5 * (self.compliances[1:] + self.compliances[:-1]) * np.diff(self.times)))

    def creep_compliance(self, time):
        """J at times 0 ≤ t up to the last point, any shape; nan beyond it."""
        return np.interp(time, self.times, self.compliances, right=np.nan)

    def creep_rate(self, time, *, left=False):
        """dJ/dt at times 0 ≤ t up to the last point, any shape: that after each point, or with `left` before it."""
        place = np.searchsorted(self.times, time, side="left" if left else "right") - 1
        return self._slopes[np.clip(place, 0, self._slopes.size - 1)]

    def creep_increment(self, start, end):
        """J(end) − J(start) for 0 ≤ start ≤ end."""
        return self.creep_compliance(end) - self.creep_compliance(start)

    def creep_integral(self, start, end):
        """∫J dt from start ≥ 0 to end ≥ start, without differences of large numbers."""
        start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        first = np.searchsorted(self.times, start, side="right")  # the first point after the start
        last = np.searchsorted(self.times, end, side="left") - 1  # the last point before the end
        at_start, at_end = self.creep_compliance(start), self.creep_compliance(end)
        within = 0.5 * (end - start) * (at_start + at_end)
        a, b = np.minimum(first, self.times.size - 1), np.maximum(last, 0)
        across = (
            0.5 * (self.times[a] - start) * (at_start + self.compliances[a])
            + (self._integrals[b] - self._integrals[a])
            + 0.5 * (end - self.times[b]) * (self.compliances[b] + at_end)
        )
        return np.where(first > last, within, across)
