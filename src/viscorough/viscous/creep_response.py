"""Creep response Φ(t) = ∫ J(t − s) dF(s) of a medium to a force that is linear between samples and may have steps.

For media of springs and dashpots Φ is a sum of states that are carried from sample to sample, at a cost of samples ×
branches. For others every sample is summed over all before it, at a cost of samples². Either way the integral is exact.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from viscorough.compilation import njit
from viscorough.types import Array, Integers
from viscorough.viscous.medium import Medium, RetardationSpectrum

if TYPE_CHECKING:
    from viscorough.viscous.correspondence import ForceHistory

_ROUNDING = 1e-12  # relative to the terms of dΦ/dt, which may be negative by as much
_HALVINGS = 60  # of an interval in which dΦ/dt may change its sign
_CHUNK = 2**20  # pairs of samples at a time
# The series of (exp(−x) − 1 + x)/x and its number of terms, for small x and for smaller ones.
_SERIES_BELOW, _SERIES_TERMS, _FEWER_BELOW, _FEWER_TERMS = 0.3, 12, 0.01, 6


def creep_response(medium: Medium, history: ForceHistory) -> tuple[Array, Array]:
    """Φ and dΦ/dt at the samples of a force history: two arrays of shape (times,).

    history : ForceHistory; before its first sample the force is 0. At a step (one time in two samples) Φ and dΦ/dt are
        the limits from either side; elsewhere dΦ/dt is that just after the sample, after the last one that before it

    Raises ValueError, with the time, where Φ decreases: at a sample, at a step or in between.
    """
    if (duration := history.times[-1] - history.times[0]) > medium.last_time:
        raise ValueError(
            f"times: {duration:g} after the first; allowed: up to the last time of the table, {medium.last_time:g}"
        )
    response = (
        _BySums(medium, history) if medium.retardation is None else _ByStates(medium, medium.retardation, history)
    )
    time = response.first_decrease()
    if np.isfinite(time):
        raise ValueError(
            f"force: from time {time:.6g} on the contact would recede, since the creep ∫J dF decreases; allowed: "
            "forces under which it grows; direct integration with internal variables goes on there (march_medium, on "
            "the command line viscorough march --medium --method second_order)"
        )
    return response.creep, response.rate


class _Intervals(ABC):
    """The force between the samples of a history, and the times at which dΦ/dt is evaluated."""

    def __init__(self, medium: Medium, history: ForceHistory) -> None:
        self.medium, self.times, self.force = medium, history.times, history.force
        self.lengths, increments = np.diff(self.times), np.diff(self.force)
        step = self.lengths == 0
        self.slopes = np.divide(increments, self.lengths, out=np.zeros_like(increments), where=~step)
        self.jumps = np.append(self.force[0], np.where(step, increments, 0.0))  # just before each sample
        self.intervals = np.flatnonzero(~step)

    @abstractmethod
    def parts(self, interval: Integers, offset: Array, *, left: bool) -> tuple[Array, Array, Array]:
        """Terms of dΦ/dt that rise and that fall with the time after the start of an interval, and their size."""

    def first_decrease(self) -> float:
        """The first time at which Φ decreases; infinite if it never does.

        dΦ/dt is a sum of terms that rise and terms that fall within an interval, so that it is nowhere below the sum of
        the former at the start and the latter at the end. Intervals whose bound is negative are halved.
        """
        found = self._first_jump_down()
        interval, start, end = self.intervals, np.zeros(self.intervals.size), self.lengths[self.intervals]
        for _ in range(_HALVINGS):
            rising, falling, terms = self.parts(interval, start, left=False)
            rising_at_end, falling_at_end, terms_at_end = self.parts(interval, end, left=True)
            begins = self.times[interval]
            negative = rising + falling < -_ROUNDING * terms
            negative_at_end = rising_at_end + falling_at_end < -_ROUNDING * terms_at_end
            for which, offset in ((negative, start), (negative_at_end, end)):
                found = min(found, (begins + offset)[which].min(initial=np.inf))
            doubtful = ~negative & (rising + falling_at_end < -_ROUNDING * np.minimum(terms, terms_at_end))
            doubtful &= begins + start < found
            if not doubtful.any():
                break
            interval, start, end = interval[doubtful], start[doubtful], end[doubtful]
            middle = start + 0.5 * (end - start)
            interval = np.concatenate([interval, interval])
            start, end = np.concatenate([start, middle]), np.concatenate([middle, end])
        return found

    def _first_jump_down(self) -> float:
        """The first time of a downward step to which the medium responds instantaneously."""
        with np.errstate(over="ignore"):
            at_once = self.medium.creep_compliance(0.0) > 0 or np.isinf(self.medium.creep_rate(0.0))
        down = self.jumps < -_ROUNDING * self.force
        return self.times[down].min(initial=np.inf) if at_once else np.inf

    def rate_at_samples(self) -> Array:
        """dΦ/dt just after every sample; just before it at the last one and before a step."""
        count = self.times.size
        after = np.append(self.lengths > 0, False)
        before = np.append(False, self.lengths > 0) & ~after
        rate = np.zeros(count)
        for which, shift in ((after, 0), (before, 1)):
            interval = np.flatnonzero(which) - shift
            offset = self.lengths[interval] if shift else np.zeros(interval.size)
            rising, falling, _ = self.parts(interval, offset, left=bool(shift))
            rate[which] = rising + falling
        return rate


class _ByStates(_Intervals):
    """Springs and dashpots: the delayed response y of every retardation time θ, and the remainder z = F − y.

    θ y' + y = F; both are exact for a force linear in time, and computed without cancellation where it is positive.
    """

    def __init__(self, medium: Medium, retardation: RetardationSpectrum, history: ForceHistory) -> None:
        super().__init__(medium, history)
        instantaneous, fluidity, self.compliances, self.retardation_times = retardation
        self.instantaneous, self.fluidity = instantaneous, fluidity
        delayed, self.left = branch_states(self.lengths, self.force, self.jumps, self.retardation_times)
        self.creep = instantaneous * self.force + fluidity * history.impulse + delayed @ self.compliances
        self.rate = self.rate_at_samples()

    def parts(self, interval: Integers, offset: Array, *, left: bool) -> tuple[Array, Array, Array]:
        own = self.instantaneous, self.fluidity, self.compliances, self.retardation_times
        return _parts(interval, offset, self.slopes, self.force, self.left, *own)


class _BySums(_Intervals):
    """Media without a discrete spectrum: sums over all steps and intervals before."""

    def __init__(self, medium: Medium, history: ForceHistory) -> None:
        super().__init__(medium, history)
        sample = np.arange(self.times.size)
        self.creep = self._over_the_past(sample, np.zeros(sample.size), self._creep_of, sample)[0]
        self.rate = self.rate_at_samples()

    def _creep_of(self, time: Array, left: bool) -> tuple[Array, Array]:
        jumps = self.medium.creep_compliance(np.maximum(time - self.times, 0))
        return jumps, self._of_intervals(self.medium.creep_integral, time)

    def _rate_of(self, time: Array, left: bool) -> tuple[Array, Array]:
        jumps = self.medium.creep_rate(np.maximum(time - self.times, 0), left=left)
        return jumps, self._of_intervals(self.medium.creep_increment, time)

    def _of_intervals(self, function: Callable[[Array, Array], Array], time: Array) -> Array:
        start, end = self.times[:-1], self.times[1:]
        return function(np.maximum(time - end, 0), np.maximum(time - start, 0))

    def _over_the_past(
        self,
        sample: Integers,
        offset: Array,
        kernels: Callable[[Array, bool], tuple[Array, Array]],
        last_interval: Integers,
        *,
        left: bool = False,
    ) -> tuple[Array, Array, Array]:
        """Sums over jumps up to `sample` and intervals before `last_interval`: all, positive, negative terms."""
        positive, negative = np.zeros(sample.size), np.zeros(sample.size)
        rows = max(1, _CHUNK // self.times.size)
        for first in range(0, sample.size, rows):
            chunk = slice(first, first + rows)
            time = (self.times[sample[chunk]] + offset[chunk])[:, None]
            of_jumps, of_intervals = kernels(time, left)
            place = np.arange(self.times.size)
            past_jumps = (place <= sample[chunk, None]) & (self.jumps != 0)
            past_intervals = (place[:-1] < last_interval[chunk, None]) & (self.slopes != 0)
            jumps = np.where(past_jumps, self.jumps, 0.0) * np.where(past_jumps, of_jumps, 0.0)
            intervals = np.where(past_intervals, self.slopes, 0.0) * np.where(past_intervals, of_intervals, 0.0)
            for total, clip in ((positive, np.maximum), (negative, np.minimum)):
                total[chunk] = clip(jumps, 0).sum(axis=1) + clip(intervals, 0).sum(axis=1)
        return positive + negative, positive, negative

    def parts(self, interval: Integers, offset: Array, *, left: bool) -> tuple[Array, Array, Array]:
        """As of _ByStates; J is concave, so that positive contributions of the past decrease with time."""
        _, falling, rising = self._over_the_past(interval, offset, self._rate_of, interval, left=left)
        present = self.slopes[interval] * self.medium.creep_compliance(offset)
        terms = falling - rising + abs(present)
        return rising + np.maximum(present, 0), falling + np.minimum(present, 0), terms


@njit
def _decay(x):
    """exp(−x) and 1 − exp(−x), both to rounding."""
    if x < 0.5:
        gone = -np.expm1(-x)
        return 1 - gone, gone
    kept = np.exp(-x)
    return kept, 1 - kept


@njit
def _parts(interval, offset, slopes, force, left, instantaneous, fluidity, compliances, retardation_times):
    rising, falling, terms = np.empty(interval.size), np.empty(interval.size), np.empty(interval.size)
    for i in range(interval.size):
        k, time = interval[i], offset[i]
        flow, drift, steady = fluidity * force[k], fluidity * slopes[k] * time, instantaneous * slopes[k]
        up, down, size = flow + steady + max(drift, 0.0), min(drift, 0.0), flow + abs(steady) + abs(drift)
        for j in range(compliances.size):
            kept, gone = 1.0, 0.0
            if time > 0:
                kept, gone = _decay(time / retardation_times[j])
            decaying = compliances[j] / retardation_times[j] * left[k, j] * kept
            growing = compliances[j] * slopes[k] * gone
            up += min(decaying, 0.0) + max(growing, 0.0)
            down += max(decaying, 0.0) + min(growing, 0.0)
            size += abs(decaying) + abs(growing)
        rising[i], falling[i], terms[i] = up, down, size
    return rising, falling, terms


@njit
def branch_states(lengths, force, jumps, retardation_times):
    """y and z = F − y at every sample, shape (samples, times), with θ y' + y = F and F = 0 before the first sample.

    lengths : of the intervals between samples; jumps : of F at every sample after an interval of length 0
    """
    samples, count = force.size, retardation_times.size
    delayed, left = np.zeros((samples, count)), np.zeros((samples, count))
    left[0] = force[0]
    for k in range(samples - 1):
        for j in range(count):
            y, z = delayed[k, j], left[k, j]
            if lengths[k] == 0:
                z += jumps[k + 1]
            else:
                x = lengths[k] / retardation_times[j]
                kept, gone = _decay(x)
                # Weights of the forces at both ends in y: a + b = 1 − exp(−x), b = 1 − (1 − exp(−x))/x.
                if x < _SERIES_BELOW:
                    b = 0.0
                    for n in range(_SERIES_TERMS if x > _FEWER_BELOW else _FEWER_TERMS, 0, -1):
                        b = (1 - b) * x / (n + 1)
                    a, mean = gone - b, 1 - b
                else:
                    mean = gone / x
                    a, b = mean - kept, 1 - mean
                y = y * kept + a * force[k] + b * force[k + 1]
                z = z * kept + mean * (force[k + 1] - force[k])
            delayed[k + 1, j], left[k + 1, j] = y, z
    return delayed, left
