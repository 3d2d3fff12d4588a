"""Compute the rate of the response to a load, and find the first time at which the response decreases.

The rate is known at any time between two samples of the load. Bounds of the rate in an interval between two samples
show whether the response may decrease in this interval.
"""

from collections.abc import Callable

import numpy as np

from viscorough.basics.types import Array

# Rounding error of a rate, divided by the sum of the absolute values of the terms of the rate.
ROUNDING = 1e-12
# Type of a function that evaluates the rate of a response. The arguments are indices of intervals between samples,
# times since the starts of these intervals, and the keyword `left`. At a kink, left=True requests the rate before the
# kink, and left=False the rate after the kink. The function returns three arrays: the sum of the terms of the rate that
# rise within the interval, the sum of the terms that fall, and the sum of the absolute values of all terms.
Terms = Callable[..., tuple[Array, Array, Array]]
# Largest number of times that an interval is halved. This is enough to separate neighbouring floating-point numbers.
_HALVINGS = 60


def first_decrease(times: Array, terms: Terms, limit: float = np.inf) -> float:
    """Return the first time at which a response decreases, or `limit` if `limit` is earlier.

    The rate of the response is a sum of terms that rise within an interval between samples and terms that fall. So it
    is bounded from below by the rising terms at the start of the interval plus the falling terms at its end. Intervals
    with a negative bound are halved until the sign of the rate is known.

    times : times of the samples of the load
    terms : function that evaluates the terms of the rate, see `Terms`
    """
    interval = np.flatnonzero(np.diff(times))
    start, end = np.zeros(interval.size), np.diff(times)[interval]
    for _ in range(_HALVINGS):
        rising, falling, size = terms(interval, start, left=False)
        rising_at_end, falling_at_end, size_at_end = terms(interval, end, left=True)
        begins = times[interval]
        with np.errstate(invalid="ignore"):  # ∞ − ∞ is nan, which does not count as negative
            negative = rising + falling < -ROUNDING * size
            negative_at_end = rising_at_end + falling_at_end < -ROUNDING * size_at_end
        for which, offset in ((negative, start), (negative_at_end, end)):
            limit = min(limit, (begins + offset)[which].min(initial=np.inf))
        doubtful = ~negative & (rising + falling_at_end < -ROUNDING * np.minimum(size, size_at_end))
        doubtful &= begins + start < limit
        if not doubtful.any():
            break
        interval, start, end = interval[doubtful], start[doubtful], end[doubtful]
        middle = start + 0.5 * (end - start)
        interval = np.concatenate([interval, interval])
        start, end = np.concatenate([start, middle]), np.concatenate([middle, end])
    return limit


def rate_at_samples(times: Array, terms: Terms) -> Array:
    """Return the rate of a response just after every sample of the load, shape of `times`.

    For the last sample, and for the first of the two samples of a step, the rate just before the sample is returned.

    terms : function that evaluates the terms of the rate, see `Terms`
    """
    lengths, rate = np.diff(times), np.zeros(times.size)
    after = np.flatnonzero(lengths)
    before = after[np.append(lengths, 0)[after + 1] == 0]  # intervals that end at a step or at the last sample
    for interval, shift in ((after, 0), (before, 1)):
        rising, falling, _ = terms(interval, shift * lengths[interval], left=bool(shift))
        with np.errstate(invalid="ignore"):  # ∞ − ∞ is nan: the rate is not known
            rate[interval + shift] = rising + falling
    return rate
