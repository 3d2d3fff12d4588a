"""Shared parts of the fits of media to records: result type, scatter, errors of the zero of the depth, and times.

A record is a measured depth or force at a series of times; each time is a row. The measured depth may have a wrong
zero, and the zero may drift. With an offset a and a drift b, the measured depth is

    u_measured = u + a + b (t − t₀),

where u is the true depth and t₀ the start of the load. a and b are unknowns of any sign in a least-squares fit.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.special import fdtri

from viscorough.basics.argument_names import spelled
from viscorough.basics.types import Array
from viscorough.media.kinds import CreepTable, Prony, Springpot

# A record whose scatter, relative to its largest value, is below this number counts as exact.
ROUNDING = 1e-9
# Relative accuracy of fits that move a row of merged springs and use a grid of retardation or relaxation times. A
# record with a smaller scatter counts as exact in these fits.
RESOLUTION = 5e-5
# Degrees of freedom that each positive unknown of a non-negative least-squares fit uses up. The mean of the sum of
# squares lies between the values for 1 and for 2 (Meyer and Woodroofe 2000), and 1.5 keeps the intervals from being too
# narrow. If fewer degrees of freedom than _LEAST_FREEDOM are left, the scatter is not determined.
_PER_AMOUNT, _LEAST_FREEDOM = 1.5, 2
# Confidence level of the intervals.
_LEVEL = 0.95
# Number of degrees of freedom that is used instead of infinity if the scatter is known.
_MANY = 1e9
# A fit uses a grid of retardation or relaxation times. The grid begins at the first time of the record divided by
# BEYOND, and ends at the last time multiplied by BEYOND. It is then refined once around the times with positive
# amounts.
BEYOND, _TIMES_PER_DECADE = 3.0, 10


class RecordFit(NamedTuple):
    """Result of fitting a medium to a record.

    medium : medium of the requested kind
    time, compliance : times, and creep compliance J at these times, shape (times,)
    modulus : relaxation modulus ψ at the times of `time` if the force was measured, else None
    low, high : ends of the interval at each time, of J if the depth was measured, of ψ if the force was measured; nan
        if the scatter is not known
    scatter, freedom : standard deviation of the record, and its number of degrees of freedom; nan if not known
    misfit : root mean square of the residuals of `medium`
    shift, shift_low, shift_high : values, and ends of the intervals, of offset and drift. Each array contains only the
        quantities that were fitted, offset first
    """

    medium: CreepTable | Prony | Springpot
    time: Array
    compliance: Array
    modulus: Array | None
    low: Array
    high: Array
    scatter: float
    freedom: float
    misfit: float
    shift: Array
    shift_low: Array
    shift_high: Array


class Shift(NamedTuple):
    """Which errors of the zero of the depth are fitted.

    offset : whether a constant is added to the depth
    drift : whether a term that is linear in time is added to the depth
    """

    offset: bool
    drift: bool

    def columns(self, lags: Array) -> Array:
        """Return the change of the measured depth by a unit of offset and of drift, if they are fitted.

        The shape is (times, 0 to 2), with a column for each fitted quantity.

        lags : times after the start of the load, shape (times,)
        """
        columns = [np.ones(lags.size)] * self.offset + [lags] * self.drift
        return np.array(columns).reshape(-1, lags.size).T


def no_prony_series() -> ValueError:
    """Return the error to raise if no Prony series describes a record."""
    name = spelled("--fit prony", "kind 'prony'")
    text = "the record shows no compliance at once, or no creep, which a Prony series needs"
    return ValueError(f"{name}: {text}; allowed: table or springpot")


def scatter_of(residual: Array, amounts: Array, others: int, exact: float) -> tuple[float, float]:
    """Return the standard deviation of a record about a fit, and its number of degrees of freedom.

    Both are nan if the record does not determine them.

    residual : measured values less fitted values, shape (rows,)
    amounts : values of the non-negative unknowns of the fit
    others : number of unknowns of any sign
    exact : if the standard deviation is at most this, the record counts as exact, and both results are nan
    """
    freedom = residual.size - _PER_AMOUNT * np.count_nonzero(amounts) - others
    if freedom < _LEAST_FREEDOM:
        return np.nan, np.nan
    scatter = np.sqrt((residual**2).sum() / freedom)
    return (scatter, freedom) if scatter > exact else (np.nan, np.nan)


def distance_of(scatter: float, freedom: float, unknowns: int = 1) -> float:
    """Return the distance that determines the width of confidence intervals.

    The interval of a quantity contains a value if the sum of squared residuals of the best fit with this value exceeds
    the smallest sum of all fits by at most distance².

    scatter, freedom : standard deviation of the record, and its number of degrees of freedom
    unknowns : number of unknowns whose joint confidence region gives the interval
    """
    return scatter * np.sqrt(unknowns * fdtri(unknowns, min(freedom, _MANY), _LEVEL))


def damped_step(
    evaluate: Callable[[Array], tuple[float, Any]], last: Array, aim: Array, squares: float, halvings: int
) -> tuple[Array, float, Any] | None:
    """Take a step of the Gauss-Newton method from `last` towards `aim`, and halve it until the fit is not worse.

    Return the new unknowns, their sum of squared residuals, and their state; or None if no step is found.

    evaluate : function of the unknowns that returns the sum of squared residuals and a state
    last, aim : unknowns before the step, and after a full step
    squares : sum of squared residuals at `last`
    halvings : largest number of steps that are tried
    """
    for _ in range(halvings):
        new, state = evaluate(aim)
        if new <= squares:
            return aim, new, state
        aim = 0.5 * (aim + last)
    return None


def limit_early_times(low: Array, high: Array, time: Array, first: float) -> None:
    """Widen the intervals of J at times before the first row of a record that shows J, in place.

    Before that row the record shows only that J does not decrease. So the lower end becomes 0, and the upper end
    becomes its value at the time `first` of the row.

    low, high : ends of the intervals at the times `time`
    """
    before = np.flatnonzero(time < first)
    low[before], high[before] = 0.0, high[before.size]


def spread_times(first: float, last: float) -> Array:
    """Return retardation or relaxation times at equal ratios, from first/BEYOND to last·BEYOND.

    first, last : first and last time of a record
    """
    first, last = first / BEYOND, last * BEYOND
    return np.geomspace(first, last, 2 + int(_TIMES_PER_DECADE * np.log10(last / first)))


def finer_times(found: Array, times: Array, finer: int = 10) -> Array:
    """Return a finer grid of retardation or relaxation times around some times of a grid.

    found : times of the grid around which it is refined, up to the neighbouring times
    times : the grid, with times at equal ratios
    finer : number of steps of the finer grid in a step of the grid
    """
    step = np.log(times[-1] / times[-2])
    near = np.arange(-finer, finer + 1) / finer * step
    # Grids around neighbouring times have points in common, which differ by rounding.
    return np.exp(np.unique(np.round(np.add.outer(np.log(found), near), 9)))
