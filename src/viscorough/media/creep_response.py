"""Creep response Φ(t) = ∫ J(t − s) dF(s) of a medium to a force F that is linear between samples and may have steps.

J is the creep compliance. The integral is computed exactly, in two ways:

- In a medium of springs and dashpots, Φ is a sum of one state per retardation time. The states are advanced from sample
  to sample, at a cost of samples × retardation times.
- In any other medium, Φ at each sample is a sum over all earlier samples, at a cost of samples².
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
from viscorough.media.medium import Medium
from viscorough.media.spectra import RetardationSpectrum

# Number of pairs of samples that sums over the past hold in memory at a time.
_CHUNK = 2**20
# Let x be the length of an interval divided by a retardation time. For x below _SERIES_BELOW, (exp(−x) − 1 + x)/x is
# computed by a series with _SERIES_TERMS terms, because the formula would lose digits.
_SERIES_BELOW, _SERIES_TERMS = 0.3, 12
# For x above _KEPT_FROM, `decay` computes exp(−x) first, otherwise 1 − exp(−x). From x = _VANISHED on, exp(−x) is less
# than the smallest floating-point number.
_KEPT_FROM, _VANISHED = 1.0, 746.0


class CreepResponse(NamedTuple):
    """Creep response Φ to a force history, and the first time at which Φ decreases.

    creep, rate : Φ and dΦ/dt at the samples, shape (samples,). At a step, which has two samples, the first sample has
        the limits before the step, and the second has the limits after it. At all other samples dΦ/dt is the limit
        after the sample, except at the last sample, where it is the limit before it
    receding_from : first time from which Φ decreases, at or between samples; nan if Φ never decreases
    """

    creep: Array
    rate: Array
    receding_from: float


def creep_response(medium: Medium, load: Load) -> CreepResponse:
    """Return the CreepResponse of a medium to a force history; the force is 0 before the first sample."""
    times, force = load.time, load.values
    creep, terms = by_sums(medium, load) if medium.retardation is None else by_states(medium.retardation, load)
    # In a medium with an instantaneous response, Φ decreases at every downward step of the force.
    with np.errstate(over="ignore"):
        responds = medium.creep_compliance(0.0) > 0 or np.isinf(medium.creep_rate(0.0))
    down = times[responds & (jumps_and_slopes(times, force)[0] < -ROUNDING * force)]
    time = first_decrease(times, terms, down.min(initial=np.inf))
    return CreepResponse(creep, rate_at_samples(times, terms), time if np.isfinite(time) else np.nan)


def constant_creep(force: float, medium: Medium, times: Array) -> tuple[Array, Array]:
    """Return the creep response Φ and dΦ/dt at `times` under a force that is constant from time 0 on."""
    if times[-1] > medium.last_time:
        allowed = f"allowed: up to the last time of the table, {medium.last_time:g}"
        raise ValueError(f"{argument('times')}: up to {times[-1]:g}; {allowed}")
    with np.errstate(over="ignore"):
        return force * medium.creep_compliance(times), force * medium.creep_rate(times)


def by_states(retardation: RetardationSpectrum, load: Load) -> tuple[Array, Terms]:
    """Return the creep response Φ of springs and dashpots at the samples, and a function for the terms of dΦ/dt.

    The function has the type `Terms`. The state of each retardation time θ is the delayed response y, with
    θ y' + y = F, and the remainder z = F − y. y and z are exact for a force that is linear in time. If the force is
    positive, y and z are computed without cancellation.
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
    """Return the creep response Φ at the samples, and a function for the terms of dΦ/dt, by sums over the past.

    The function has the type `Terms`. These sums serve for media that do not consist of springs and dashpots. Since J
    is concave, dJ/dt decreases with time. So the contributions of earlier increases of the force to dΦ/dt are positive
    and fall with time, and the contributions of earlier decreases are negative and rise.
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
    """Return the sum of all positive responses to the past of a load, and the sum of all negative responses.

    Each returned array has the shape of `sample`, with one sum per output time. An output time lies `offset` after a
    sample, and the past is the load up to this sample.

    times, load : times of the samples, and the load at the samples, as in `arrays.jumps_and_slopes`
    sample, offset : index of the sample before each output time, and time since this sample
    jump_response : response to a unit jump of the load, a function of the time since the jump
    ramp_response : response to a unit slope within an interval, a function of the times since its end and its start
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


@njit(inner=True)
def decay(x):
    """Return exp(−x), and (1 − exp(−x))/x, the mean of exp(−s) for s from 0 to x.

    Exponential functions take most of the time of a motion. So only one of the two results is computed with such a
    function. The other result follows from it, without a loss of digits.
    """
    if x > _KEPT_FROM:
        kept = exponential(x)
        return kept, (1 - kept) / x
    mean = -np.expm1(-x) / x if x > 0 else 1.0
    return 1 - x * mean, mean


@njit(inner=True)
def exponential(x):
    """Return exp(−x). Where the result is 0, the exponential function of the C library takes three times as long."""
    return np.exp(-x) if x < _VANISHED else 0.0


@njit
def branch_forces(lengths, loads, relaxation_times):
    """Return, for each load F and each relaxation time τ, the state z with z' + z/τ = F', at every sample.

    The shape is (loads, samples, times). F is 0 before the first sample.

    lengths : lengths of the intervals between samples; F jumps at an interval of length 0
    loads : F at the samples, for one or more loads, shape (loads, samples)
    """
    states = np.zeros((loads.shape[0], loads.shape[1], relaxation_times.size))
    for i in range(loads.shape[0]):
        states[i, 0] = loads[i, 0]
    for k in range(lengths.size):
        for j in range(relaxation_times.size):
            kept, mean = decay(lengths[k] / relaxation_times[j])
            for i in range(loads.shape[0]):
                states[i, k + 1, j] = states[i, k, j] * kept + mean * (loads[i, k + 1] - loads[i, k])
    return states


@njit
def branch_states(lengths, force, retardation_times):
    """Return, for each retardation time θ, the state y with θ y' + y = F, and z = F − y, at every sample.

    Both arrays have the shape (samples, times). F is 0 before the first sample.

    lengths : lengths of the intervals between samples; F jumps at an interval of length 0
    force : F at the samples
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
                kept, mean = decay(x)
                # For the forces F0 and F1 at the start and end of the interval, y becomes exp(−x) y + a F0 + b F1, with
                # b = 1 − (1 − exp(−x))/x and a = 1 − exp(−x) − b.
                if x < _SERIES_BELOW:
                    b = 0.0
                    for n in range(_SERIES_TERMS, 0, -1):
                        b = (1 - b) * x / (n + 1)
                    a = x * mean - b
                else:
                    a, b = mean - kept, 1 - mean
                y = y * kept + a * force[k] + b * force[k + 1]
                z = z * kept + mean * (force[k + 1] - force[k])
            delayed[k + 1, j], left[k + 1, j] = y, z
    return delayed, left
