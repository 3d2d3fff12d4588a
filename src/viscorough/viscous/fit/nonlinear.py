"""The fit of a medium to a record by nonlinear least squares.

The unknowns are parameters of a medium, and offset and drift of the depth as far as they are fitted. The parameters
determine the medium, and the medium predicts the record (viscous.fit.records).

- `fit_elements` fits a medium of springs and dashpots with given times and unknown amounts x ≥ 0. If the prediction is
  linear in the unknowns, one non-negative least-squares fit gives the best medium. Otherwise the amounts take
  steps towards such a fit to the tangent of the prediction, which are shortened until the sum of squares decreases.
- `with_finer_times` refines the grid of times at the elements that are present.
- `with_free_times` also fits the times of the elements that are present.
- `fit_without_drift` fits a medium for a drift of 0.
- `fit_springpot` fits the two parameters of a springpot.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from viscorough.basics.types import Array, Integers
from viscorough.media.kinds import Springpot
from viscorough.viscous.fit.linear import non_negative
from viscorough.viscous.fit.records import Record, Tangent

# Largest number of fits to tangents. They end earlier if the sum of squares would decrease by less than the share
# _STALLED, if it decreases by less than the share _LEAST_GAIN, or if the root mean square of the residuals is below the
# share _EXACT of the largest value.
_ROUNDS, _STALLED, _LEAST_GAIN, _EXACT = 60, 1e-3, 1e-6, 1e-13
# A step towards the best fit to a tangent is accepted if the sum of squares decreases by the share _SUFFICIENT of the
# decrease that the tangent predicts. Otherwise it is shortened to the share _SHORTER, up to _SHARES times.
_SUFFICIENT, _SHORTER, _SHARES = 0.25, 0.4, 8
# Largest number of steps of a nonlinear fit. It ends earlier if the sum of squares or the unknowns change by less than
# the share _CLOSE in a step. Derivatives that are not known are difference quotients with steps of the share _STEP.
_EVALUATIONS, _CLOSE, _STEP = 15, 1e-9, 1e-6
# Relative difference of two times whose derivatives give the derivative with respect to the time of an element.
_NEAR = 1e-4
# Number of refinements of a grid, and of new times between two neighbours.
_REFINEMENTS, _FINER = 2, 4
# Two times count as equal if their relative difference is below this number.
_SAME = 1e-6
# Limits of the exponent of a springpot.
_LEAST_EXPONENT, _LARGEST_EXPONENT = 0.001, 0.999


class ElementFit(NamedTuple):
    """Best medium of elements with given times.

    times : retardation or relaxation times of the elements, shape (elements,)
    amounts : amounts of the elements, see viscous.fit.records, shape (leading + elements,)
    shift : fitted offset and drift, as far as they are unknowns of the record
    tangent : prediction for these values, and its derivatives
    squares : sum of squared residuals
    """

    times: Array
    amounts: Array
    shift: Array
    tangent: Tangent
    squares: float

    def elements(self, leading: int) -> tuple[Integers, Integers]:
        """Return the indices of the times with a positive amount, and the number of the element of each of them.

        Neighbouring times of the grid belong to one element, whose time lies between them.

        leading : number of amounts without a time
        """
        used = np.flatnonzero(self.amounts[leading:] > 0)
        return used, np.cumsum(np.diff(used, prepend=used[:1]) > 1)

    def number_of_unknowns(self, leading: int) -> int:
        """Return the number of unknowns of the medium: amounts above 0, and the time of each element."""
        elements = np.unique(self.elements(leading)[1]).size
        return int(np.count_nonzero(self.amounts[:leading])) + 2 * elements

    def target(self, measured: Array) -> Array:
        """Return the measured values minus the part of the tangent that does not depend on the unknowns."""
        tangent = self.tangent
        return measured - tangent.predicted + tangent.columns @ self.amounts + tangent.signed @ self.shift


def fit_elements(record: Record, times: Array, start: tuple[Array, Array] | None = None) -> ElementFit:
    """Return the best medium of elements with given times.

    start : first guesses of the amounts, and of offset and drift; None for the guesses of the record
    """
    amounts, shift = record.start(times) if start is None else start
    fit = _at(record, times, amounts, shift)
    for _ in range(_ROUNDS):
        target = fit.target(record.measured)
        amounts, shift = non_negative(fit.tangent.columns, target, fit.tangent.signed)
        expected = _sum_of_squares(target - fit.tangent.columns @ amounts - fit.tangent.signed @ shift)
        exact = record.measured.size * (_EXACT * np.abs(record.measured).max()) ** 2
        if fit.squares <= exact or expected > (1 - _STALLED) * fit.squares:
            break
        better = _towards(record, fit, amounts, shift, expected)
        if better is None:
            break
        fit = _at(record, times, *better)
    return fit


def with_finer_times(record: Record, fit: ElementFit) -> ElementFit:
    """Return the best medium on a grid with more times next to the times of the elements that are present.

    New times without an element are left out of the result.
    """
    leading, grid = record.leading, fit.times
    for _ in range(_REFINEMENTS):
        used = np.flatnonzero(fit.amounts[leading:] > 0)
        gaps = np.unique(np.clip(np.append(used - 1, used), 0, fit.times.size - 2))
        shares = np.arange(1, _FINER + 1) / (_FINER + 1)
        finer = fit.times[gaps, None] * (fit.times[gaps + 1] / fit.times[gaps])[:, None] ** shares
        times = np.append(fit.times, finer)
        amounts = np.append(fit.amounts[leading:], np.zeros(finer.size))
        order = np.argsort(times)
        fit = fit_elements(record, times[order], (np.append(fit.amounts[:leading], amounts[order]), fit.shift))
    kept = np.isin(fit.times, grid) | (fit.amounts[leading:] > 0)
    amounts = np.append(fit.amounts[:leading], fit.amounts[leading:][kept])
    return _at(record, fit.times[kept], amounts, fit.shift)


def with_free_times(record: Record, fit: ElementFit) -> ElementFit:
    """Return the best medium of elements whose times are free, starting from a medium with times on a grid.

    A time between two times of the grid appears as positive amounts of both. Such neighbours become one element. The
    grid is kept, because the intervals need it, and the times that are found are added to it.
    """
    leading, grid = record.leading, fit.times
    used, group = fit.elements(leading)
    if not used.size:
        return fit
    amounts = fit.amounts[leading:][used]
    sums = np.bincount(group, amounts)
    logarithms = np.bincount(group, amounts * np.log(grid[used])) / sums
    size, count, elements = np.abs(record.measured).max(), leading + sums.size, sums.size
    first = np.append(fit.amounts[:leading], sums)
    # Scale the unknowns so that a change of any of them by 1 changes the prediction by about its size. The logarithm of
    # a time has the scale 1.
    lengths = np.abs(fit.tangent.columns).max(axis=0)
    lengths = np.append(lengths[:leading], [lengths[leading:][used][group == k].max() for k in range(elements)])
    scales = np.concatenate([size / np.where(lengths > 0, lengths, size), np.ones(elements), record.shift_scales])

    def values(unknowns: Array) -> tuple[Array, Array, Array]:
        parts = np.split(unknowns * scales, [count, count + elements])
        return np.exp(parts[1]), parts[0], parts[2]

    def residual(unknowns: Array) -> Array:
        return (record.predicted(*values(unknowns)) - record.measured) / size

    def derivatives(unknowns: Array) -> Array:
        times, amounts, shift = values(unknowns)
        near = np.append(times, times * (1 + _NEAR))
        tangent = record.tangent(near, np.append(amounts, np.zeros(elements)), shift)
        by_amount, by_near_amount = tangent.columns[:, :count], tangent.columns[:, count:]
        by_logarithm = amounts[leading:] * (by_near_amount - by_amount[:, leading:]) / _NEAR
        return np.column_stack([by_amount, by_logarithm, tangent.signed]) * scales / size

    low = np.concatenate([np.zeros(count), np.full(elements, np.log(grid[0])), np.full(fit.shift.size, -np.inf)])
    high = np.concatenate(
        [np.full(count, np.inf), np.full(elements, np.log(grid[-1])), np.full(fit.shift.size, np.inf)]
    )
    start = np.concatenate([first, np.clip(logarithms, np.log(grid[0]), np.log(grid[-1])), fit.shift]) / scales
    found = _solution(residual, start, (low, high), derivatives)
    times, amounts, shift = values(found)
    if not _squares(record, times, amounts, shift) < fit.squares:
        return fit
    apart = (np.abs(np.log(np.divide.outer(grid, times))) > _SAME).all(axis=1)
    all_times = np.append(grid[apart], times)
    all_amounts = np.concatenate([amounts[:leading], np.zeros(np.count_nonzero(apart)), amounts[leading:]])
    order = np.argsort(all_times)
    return _at(record, all_times[order], np.append(all_amounts[:leading], all_amounts[leading:][order]), shift)


def fit_without_drift(record: Record, times: Array) -> ElementFit:
    """Return the best medium of elements with given times for a drift of 0, at which the drift remains an unknown."""
    still = fit_elements(record.without_drift(), times)
    return _at(record, times, still.amounts, np.append(still.shift, 0.0))


def fit_springpot(record: Record, start: Springpot, shift: Array) -> tuple[Springpot, Array, Array]:
    """Return the springpot that fits a record best, the fitted offset and drift, and the residuals.

    start, shift : first guesses
    """
    size = np.abs(record.measured).max()
    scales = record.shift_scales

    def parameters(unknowns: Array) -> tuple[Springpot, Array]:
        return Springpot(float(start.modulus * np.exp(unknowns[0])), float(unknowns[1])), unknowns[2:] * scales

    def residual(unknowns: Array) -> Array:
        springpot, shift = parameters(unknowns)
        return (record.measured - record.predicted(*record.elements_of(springpot), shift)) / size

    first = np.append([0.0, np.clip(start.exponent, 2 * _LEAST_EXPONENT, 2 * _LARGEST_EXPONENT - 1)], shift / scales)
    low, high = np.full(first.size, -np.inf), np.full(first.size, np.inf)
    low[1], high[1] = _LEAST_EXPONENT, _LARGEST_EXPONENT
    found = _solution(residual, first, (low, high))
    return *parameters(found), residual(found) * size


def _towards(
    record: Record, fit: ElementFit, amounts: Array, shift: Array, expected: float
) -> tuple[Array, Array] | None:
    """Return the amounts, and offset and drift, of a step that reduces the sum of squares; None if no step does.

    The step leads to the best fit to the tangent, or a share of the way, since the prediction is not linear.

    fit : fit before
    amounts, shift, expected : values that fit the tangent best, and the sum of squares that the tangent predicts
    """
    best, least, share = None, (1 - _LEAST_GAIN) * fit.squares, 1.0
    for _ in range(_SHARES):
        values = fit.amounts + share * (amounts - fit.amounts), fit.shift + share * (shift - fit.shift)
        squares = _squares(record, fit.times, *values)
        if squares < least:
            best, least = values, squares
        if squares <= fit.squares - _SUFFICIENT * share * (fit.squares - expected):
            break
        share *= _SHORTER
    return best


def _solution(
    residual: Callable[[Array], Array],
    start: Array,
    bounds: tuple[Array, Array],
    derivatives: Callable[[Array], Array] | None = None,
) -> Array:
    """Return the unknowns that minimise the sum of squared residuals between bounds.

    derivatives : derivatives of the residuals, shape (rows, unknowns); None for difference quotients
    """
    from scipy.optimize import least_squares  # this import takes long

    with np.errstate(invalid="ignore"):  # infinite distances to a bound, in directions without a gradient
        found: Any = least_squares(
            residual, start, jac=derivatives or "2-point", bounds=bounds, method="dogbox", ftol=_CLOSE, xtol=_CLOSE,
            gtol=None, max_nfev=_EVALUATIONS, diff_step=_STEP,
        )  # fmt: skip
    return np.clip(found.x, *bounds)


def _at(record: Record, times: Array, amounts: Array, shift: Array) -> ElementFit:
    tangent = record.tangent(times, amounts, shift)
    return ElementFit(times, amounts, shift, tangent, _sum_of_squares(record.measured - tangent.predicted))


def _squares(record: Record, times: Array, amounts: Array, shift: Array) -> float:
    return _sum_of_squares(record.measured - record.predicted(times, amounts, shift))


def _sum_of_squares(residual: Array) -> float:
    return float(residual @ residual)
