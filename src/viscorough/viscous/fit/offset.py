"""Profile of the offset of the depth: the best fit to a record at each of several offsets.

The prediction is not linear in the offset. Besides, elements that are faster than the first measurements have almost
the same effect as a small offset, and the noise hides the difference. Therefore a separate fit is made at each of
several offsets. If the medium has a dashpot, an early measurement determines the offset so accurately that only closely
spaced offsets show the interval.
"""

from collections.abc import Callable

import numpy as np

from viscorough.basics.argument_names import argument
from viscorough.basics.types import Array, Integers
from viscorough.viscous.fit.nonlinear import ElementFit, fit_elements, with_finer_times
from viscorough.viscous.fit.records import Record

# The first fits are made at these offsets of the depth, given as shares of the largest depth.
_OFFSETS = np.linspace(-0.1, 0.1, 21)
# After the first fits, new fits are made at _FINER_OFFSETS offsets that just cover the confidence interval of the
# offset. This is repeated, up to _REPLACEMENTS times in all, until at least _RESOLVED of the offsets lie within the
# interval.
_FINER_OFFSETS, _REPLACEMENTS, _RESOLVED = 15, 4, 5
# Number of bisections to find each end of the confidence interval of the offset.
_BISECTIONS = 5


def fits_of_offsets(record: Record, allowed: Callable[[ElementFit], float]) -> list[tuple[Record, ElementFit]]:
    """Return fits at increasing offsets, which include the best offset and enclose its confidence interval.

    allowed : function of the best fit. It returns how much the sum of squared residuals may exceed that of the best fit
        at an offset within the confidence interval

    Raises ValueError if the best offset is the smallest or the largest that is allowed, and 0 is significantly worse.
    """
    times = record.grid()

    def fit(offset: float, near: ElementFit | None = None) -> tuple[Record, ElementFit]:
        """Fit at an offset, starting from the fit at an offset near to it.

        The grid is refined: the misfit of an element between two of its times would count as an error of the offset.
        """
        moved = record.at_offset(offset)
        if near is not None:
            return moved, fit_elements(moved, near.times, (near.amounts, near.shift))
        return moved, with_finer_times(moved, fit_elements(moved, times))

    def fit_all(offsets: Array) -> list[tuple[Record, ElementFit]]:
        """Fit at each offset, and once more from the best of its neighbours if this is better."""
        fits = [fit(offset) for offset in offsets]
        for order in (range(1, len(fits)), range(len(fits) - 2, -1, -1)):
            step = order.step
            for k in order:
                near = fits[k - step][1]
                if near.squares < fits[k][1].squares:
                    again = fit(offsets[k], near)
                    fits[k] = again if again[1].squares < fits[k][1].squares else fits[k]
        return fits

    offsets = _OFFSETS * record.largest
    fits = fit_all(offsets)
    best = int(np.argmin([each.squares for _, each in fits]))
    # If the record hardly determines the offset, the best offset may be at an end by chance. Then 0 fits as well.
    if best in (0, offsets.size - 1) and offsets.size // 2 not in within(fits, allowed):
        raise ValueError(
            f"{argument('fit_offset')}: the zero of the depth is off by {offsets[best]:.3g} or more; allowed: errors "
            f"below {offsets[-1]:.3g}, {100 * _OFFSETS[-1]:g} % of the largest depth; a better zero is needed"
        )
    for _ in range(_REPLACEMENTS):
        inside = within(fits, allowed)
        low, high = offsets[max(inside[0] - 1, 0)], offsets[min(inside[-1] + 1, offsets.size - 1)]
        offsets = np.linspace(low, high, _FINER_OFFSETS)
        fits = fit_all(offsets)
        if within(fits, allowed).size >= _RESOLVED:
            break
    # Outside the interval the sum of squares may rise so steeply that only bisection finds the ends of the interval.
    for _ in range(_BISECTIONS):
        inside = within(fits, allowed)
        first, last = int(inside[0]), int(inside[-1])
        if last + 1 < len(fits):
            fits.insert(last + 1, fit(0.5 * (fits[last][0].offset + fits[last + 1][0].offset)))
        if first > 0:
            fits.insert(first, fit(0.5 * (fits[first - 1][0].offset + fits[first][0].offset)))
    inside = within(fits, allowed)
    return fits[max(inside[0] - 1, 0) : inside[-1] + 2]


def within(fits: list[tuple[Record, ElementFit]], allowed: Callable[[ElementFit], float]) -> Integers:
    """Return the indices of the fits whose offsets lie within the confidence interval of the offset."""
    squares = np.array([fit.squares for _, fit in fits])
    best = int(squares.argmin())
    return np.flatnonzero(squares <= squares[best] + allowed(fits[best][1]))


def crossing(offsets: Array, excess: Array) -> float:
    """Return the end of the confidence interval of the offset: after it, the excess is positive.

    The excess is interpolated linearly between two offsets.

    offsets : increasing for the upper end of the interval, decreasing for the lower end
    excess : sum of squared residuals at each offset, minus the largest sum that the confidence interval allows
    """
    k = int(np.flatnonzero(excess <= 0)[-1])
    if k == offsets.size - 1:
        return float(offsets[k])
    return float(offsets[k] + (offsets[k + 1] - offsets[k]) * excess[k] / (excess[k] - excess[k + 1]))
