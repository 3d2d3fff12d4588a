"""Rate of a response at the samples of a load, and its first decrease, from bounds of the rate between them."""

from collections.abc import Callable

import numpy as np

from viscorough.basics.types import Array

ROUNDING = 1e-12  # of a rate, relative to its terms
# Function of intervals between samples, times after their starts, and whether a kink counts as before it (`left`): the
# terms of the rate that rise and those that fall within an interval, and the size of all.
Terms = Callable[..., tuple[Array, Array, Array]]
_HALVINGS = 60  # of an interval, enough to separate neighbouring numbers


def first_decrease(times: Array, terms: Terms, limit: float = np.inf) -> float:
    """Return the first time when a response decreases, or the limit if that is earlier.

    Its rate is a sum of terms that rise and terms that fall within an interval, so that it is nowhere below the sum of
    the former at the start and the latter at the end. Intervals whose bound is negative are halved.
    """
    interval = np.flatnonzero(np.diff(times))
    start, end = np.zeros(interval.size), np.diff(times)[interval]
    for _ in range(_HALVINGS):
        rising, falling, size = terms(interval, start, left=False)
        rising_at_end, falling_at_end, size_at_end = terms(interval, end, left=True)
        begins = times[interval]
        with np.errstate(invalid="ignore"):  # terms of both signs that are infinite decide nothing
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
    """Return the rate just after every sample; just before it at the last one and before a step."""
    lengths, rate = np.diff(times), np.zeros(times.size)
    after = np.flatnonzero(lengths)
    before = after[np.append(lengths, 0)[after + 1] == 0]  # intervals that end there
    for interval, shift in ((after, 0), (before, 1)):
        rising, falling, _ = terms(interval, shift * lengths[interval], left=bool(shift))
        with np.errstate(invalid="ignore"):  # the rate of two infinite terms of both signs is not known
            rate[interval + shift] = rising + falling
    return rate
