"""Creep response Φ(t) = ∫ J(t − s) dF(s) of a medium to a force that is linear between samples and may have steps.

For media of springs and dashpots Φ is a sum of states that are carried from sample to sample, at a cost of samples ×
branches. For others every sample is summed over all before it, at a cost of samples². Either way the integral is exact.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from viscorough.basics.argument_names import argument
from viscorough.basics.arrays import jumps_and_slopes
from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Integers
from viscorough.media.first_decrease import ROUNDING, Terms, first_decrease, rate_at_samples
from viscorough.media.load import Load
from viscorough.media.medium import Medium, RetardationSpectrum

_CHUNK = 2**20  # pairs of samples at a time
_SERIES_BELOW, _SERIES_TERMS = 0.3, 12  # the series of (exp(−x) − 1 + x)/x, and its number of terms


class CreepResponse(NamedTuple):
    """Creep response to a force history, and the first time at which it decreases.

    creep, rate : Φ and dΦ/dt at the samples, shape (samples,). At a step (one time in two samples) these are the limits
        from either side; elsewhere dΦ/dt is the limit after the sample, and before it at the last one
    receding_from : time from which Φ decreases: at a sample, at a step or in between; nan if it does not
    """

    creep: Array
    rate: Array
    receding_from: float


def creep_response(medium: Medium, load: Load) -> CreepResponse:
    """Return the CreepResponse of a medium to a force; before its first sample the force is 0."""
    times, force = load.time, load.values
    creep, terms = by_sums(medium, load) if medium.retardation is None else by_states(medium.retardation, load)
    # Of a downward step to which the medium responds instantaneously.
    with np.errstate(over="ignore"):
        responds = medium.creep_compliance(0.0) > 0 or np.isinf(medium.creep_rate(0.0))
    down = times[responds & (jumps_and_slopes(times, force)[0] < -ROUNDING * force)]
    time = first_decrease(times, terms, down.min(initial=np.inf))
    return CreepResponse(creep, rate_at_samples(times, terms), time if np.isfinite(time) else np.nan)


def constant_creep(force: float, medium: Medium, times: Array) -> tuple[Array, Array]:
    """Return Φ and dΦ/dt at times under a force that is constant from time 0 on."""
    if times[-1] > medium.last_time:
        allowed = f"allowed: up to the last time of the table, {medium.last_time:g}"
        raise ValueError(f"{argument('times')}: up to {times[-1]:g}; {allowed}")
    with np.errstate(over="ignore"):
        return force * medium.creep_compliance(times), force * medium.creep_rate(times)


def by_states(retardation: RetardationSpectrum, load: Load) -> tuple[Array, Terms]:
    """Φ at the samples, and the terms of dΦ/dt, of springs and dashpots.

    Its states are the delayed response y of every retardation time θ, θ y' + y = F, and the remainder z = F − y; both
    are exact for a force linear in time, and computed without cancellation where it is positive.
    """
    instantaneous, fluidity, compliances, times = retardation
    _, slopes = jumps_and_slopes(load.time, load.values)
    delayed, remainder = branch_states(np.diff(load.time), load.values, times)

    def terms(interval: Integers, offset: Array, *, left: bool) -> tuple[Array, Array, Array]:
        slope, x = slopes[interval], offset[:, None] / times
        decaying = compliances / times * remainder[interval] * np.exp(-x)
        growing = compliances * slope[:, None] * -np.expm1(-x)
        flow, drift, steady = fluidity * load.values[interval], fluidity * slope * offset, instantaneous * slope
        size = flow + abs(steady) + abs(drift) + (abs(decaying) + abs(growing)).sum(axis=1)
        rising = np.maximum(drift, 0) + (np.minimum(decaying, 0) + np.maximum(growing, 0)).sum(axis=1)
        falling = np.minimum(drift, 0) + (np.maximum(decaying, 0) + np.minimum(growing, 0)).sum(axis=1)
        return flow + steady + rising, falling, size

    return instantaneous * load.values + fluidity * load.integral + delayed @ compliances, terms


def by_sums(medium: Medium, load: Load) -> tuple[Array, Terms]:
    """Φ at the samples, and the terms of dΦ/dt, of media without a discrete spectrum: sums over the past.

    J is concave, so that positive contributions of the past decrease with time.
    """
    _, slopes = jumps_and_slopes(load.time, load.values)
    sums = partial(sums_over_the_past, load.time, load.values)

    def terms(interval: Integers, offset: Array, *, left: bool) -> tuple[Array, Array, Array]:
        falling, rising = sums(interval, offset, partial(medium.creep_rate, left=left), medium.creep_increment)
        present = slopes[interval] * medium.creep_compliance(offset)
        size = falling - rising + abs(present)
        with np.errstate(invalid="ignore"):  # the rate of a springpot at a step is infinite
            return rising + np.maximum(present, 0), falling + np.minimum(present, 0), size

    sample, offset = np.arange(load.time.size), np.zeros(load.time.size)
    return np.add(*sums(sample, offset, medium.creep_compliance, medium.creep_integral)), terms


def sums_over_the_past(
    times: Array,
    load: Array,
    sample: Integers,
    offset: Array,
    jump_response: Callable[[Array], Array],
    ramp_response: Callable[[Array, Array], Array],
) -> tuple[Array, Array]:
    """Sums of the positive and of the negative responses to a load, at times after samples; shape of `sample`.

    times, load : as of `arrays.jumps_and_slopes`
    sample, offset : indices of samples up to which the load counts, and times after them
    jump_response : response to a unit jump, by the time since then
    ramp_response : response to a unit slope, by the times since its end and since its start
    """
    jumps, slopes = jumps_and_slopes(times, load)
    positive, negative = np.zeros(sample.size), np.zeros(sample.size)
    rows, place = max(1, _CHUNK // times.size), np.arange(times.size)
    for first in range(0, sample.size, rows):
        chunk = slice(first, first + rows)
        lag = np.maximum((times[sample[chunk]] + offset[chunk])[:, None] - times, 0)
        past_jumps = (place <= sample[chunk, None]) & (jumps != 0)
        past_intervals = (place[1:] <= sample[chunk, None]) & (slopes != 0)
        at_jumps = jumps * np.where(past_jumps, jump_response(lag), 0.0)
        over_intervals = slopes * np.where(past_intervals, ramp_response(lag[:, 1:], lag[:, :-1]), 0.0)
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
