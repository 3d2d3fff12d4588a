"""Creep response Φ(t) = ∫ J(t − s) dF(s) of a medium to a force that is linear between samples and may have steps.

For media of springs and dashpots Φ is a sum of states that are carried from sample to sample, at a cost of samples ×
branches. For others every sample is summed over all before it, at a cost of samples². Either way the integral is exact.
"""

from __future__ import annotations

import functools
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
_SERIES_BELOW, _SERIES_TERMS = 0.3, 12  # the series of (exp(−x) − 1 + x)/x, and its number of terms


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
    return response.creep, response.rate_at_samples()


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
        after = np.append(self.lengths > 0, False)
        before = np.append(False, self.lengths > 0) & ~after
        rate = np.zeros(self.times.size)
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
        self.retardation = instantaneous, fluidity, compliances, times = retardation
        delayed, self.left = branch_states(self.lengths, self.force, times)
        self.creep = instantaneous * self.force + fluidity * history.impulse + delayed @ compliances

    def parts(self, interval: Integers, offset: Array, *, left: bool) -> tuple[Array, Array, Array]:
        instantaneous, fluidity, compliances, times = self.retardation
        slope, x = self.slopes[interval], offset[:, None] / times
        decaying = compliances / times * self.left[interval] * np.exp(-x)
        growing = compliances * slope[:, None] * -np.expm1(-x)
        flow, drift, steady = fluidity * self.force[interval], fluidity * slope * offset, instantaneous * slope
        terms = flow + abs(steady) + abs(drift) + (abs(decaying) + abs(growing)).sum(axis=1)
        rising = np.maximum(drift, 0) + (np.minimum(decaying, 0) + np.maximum(growing, 0)).sum(axis=1)
        falling = np.minimum(drift, 0) + (np.maximum(decaying, 0) + np.minimum(growing, 0)).sum(axis=1)
        return flow + steady + rising, falling, terms


class _BySums(_Intervals):
    """Media without a discrete spectrum: sums over all steps and intervals before."""

    def __init__(self, medium: Medium, history: ForceHistory) -> None:
        super().__init__(medium, history)
        self._sums = functools.partial(sums_over_the_past, self.times, self.jumps, self.slopes)
        sample, offset = np.arange(self.times.size), np.zeros(self.times.size)
        self.creep = np.add(*self._sums(sample, offset, medium.creep_compliance, medium.creep_integral))

    def parts(self, interval: Integers, offset: Array, *, left: bool) -> tuple[Array, Array, Array]:
        """As of _ByStates; J is concave, so that positive contributions of the past decrease with time."""
        rate = functools.partial(self.medium.creep_rate, left=left)
        falling, rising = self._sums(interval, offset, rate, self.medium.creep_increment)
        present = self.slopes[interval] * self.medium.creep_compliance(offset)
        terms = falling - rising + abs(present)
        return rising + np.maximum(present, 0), falling + np.minimum(present, 0), terms


def sums_over_the_past(
    times: Array,
    jumps: Array,
    slopes: Array,
    sample: Integers,
    offset: Array,
    of_jump: Callable[[Array], Array],
    of_interval: Callable[[Array, Array], Array],
) -> tuple[Array, Array]:
    """Sums of the positive and of the negative responses to a load, at times after samples; shape of `sample`.

    times, jumps, slopes : of the load: its samples, its jumps just before them, its slopes from each to the next
    sample, offset : indices of samples up to which the load counts, and times after them
    of_jump : response to a unit jump, by the time since then
    of_interval : response to a unit slope, by the times since its end and since its start
    """
    positive, negative = np.zeros(sample.size), np.zeros(sample.size)
    rows, place = max(1, _CHUNK // times.size), np.arange(times.size)
    for first in range(0, sample.size, rows):
        chunk = slice(first, first + rows)
        lag = np.maximum((times[sample[chunk]] + offset[chunk])[:, None] - times, 0)
        past_jumps = (place <= sample[chunk, None]) & (jumps != 0)
        past_intervals = (place[1:] <= sample[chunk, None]) & (slopes != 0)
        at_jumps = np.where(past_jumps, jumps, 0.0) * np.where(past_jumps, of_jump(lag), 0.0)
        responses = np.where(past_intervals, of_interval(lag[:, 1:], lag[:, :-1]), 0.0)
        over_intervals = np.where(past_intervals, slopes, 0.0) * responses
        for total, clip in ((positive, np.maximum), (negative, np.minimum)):
            total[chunk] = clip(at_jumps, 0).sum(axis=1) + clip(over_intervals, 0).sum(axis=1)
    return positive, negative


@njit
def branch_states(lengths, force, retardation_times):
    """y and z = F − y at every sample, shape (samples, times), with θ y' + y = F and F = 0 before the first sample.

    lengths : of the intervals between samples; after one of length 0, F has jumped
    """
    samples, count = force.size, retardation_times.size
    delayed, left = np.zeros((samples, count)), np.zeros((samples, count))
    left[0] = force[0]
    for k in range(samples - 1):
        for j in range(count):
            y, z = delayed[k, j], left[k, j]
            if lengths[k] == 0:
                z += force[k + 1] - force[k]
            else:
                x = lengths[k] / retardation_times[j]
                kept, gone = np.exp(-x), -np.expm1(-x)
                # Weights of the forces at both ends in y: a + b = 1 − exp(−x), b = 1 − (1 − exp(−x))/x.
                if x < _SERIES_BELOW:
                    b = 0.0
                    for n in range(_SERIES_TERMS, 0, -1):
                        b = (1 - b) * x / (n + 1)
                    a, mean = gone - b, 1 - b
                else:
                    mean = gone / x
                    a, b = mean - kept, 1 - mean
                y = y * kept + a * force[k] + b * force[k + 1]
                z = z * kept + mean * (force[k + 1] - force[k])
            delayed[k + 1, j], left[k + 1, j] = y, z
    return delayed, left
