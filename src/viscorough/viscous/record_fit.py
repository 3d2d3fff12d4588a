"""Common parts of the fits of media to records: result type, scatter, offset and drift, and grids of times.

A record consists of rows; each row is a time with a measured depth or force. The measured depth may have a wrong zero,
and the zero may drift. With an offset a and a drift b, the measured depth is

    u_measured = u + a + b (t − t₀),

where u is the true depth and t₀ the start of the load. a and b may have any sign, and are fitted together with the
medium.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.special import fdtri

from viscorough.basics.argument_names import spelled
from viscorough.basics.types import Array
from viscorough.media.kinds import Prony, Springpot
from viscorough.media.table import FreeForm

# A record counts as exact if its scatter, divided by its largest value, is below this number.
ROUNDING = 1e-9
# Relative accuracy of fits in which springs with gaps replace the contact, neighbouring springs are merged, and a grid
# of retardation or relaxation times is used. For these fits, a record with a smaller scatter counts as exact.
RESOLUTION = 5e-5
# In a non-negative least-squares fit, each positive unknown reduces the number of degrees of freedom by _PER_AMOUNT.
# The expected sum of squares corresponds to a value between 1 and 2 (Meyer and Woodroofe 2000); with 1.5 the confidence
# intervals are not too narrow. If fewer than _LEAST_FREEDOM degrees of freedom are left, the scatter is not determined.
_PER_AMOUNT, _LEAST_FREEDOM = 1.5, 2
# Confidence level of all intervals.
_LEVEL = 0.95
# If the scatter is known, the number of degrees of freedom is infinite. This number is used instead of infinity.
_MANY = 1e9
# The grid of retardation or relaxation times of a fit begins at the first time of the record divided by BEYOND, and
# ends at the last time multiplied by BEYOND. It has about _TIMES_PER_DECADE times per decade. After a first fit, it is
# refined around the times at which the medium has a positive compliance or modulus.
BEYOND, _TIMES_PER_DECADE = 3.0, 10


class RecordFit(NamedTuple):
    """Result of fitting a medium to a record.

    medium : medium of the requested kind
    time : times of the following arrays, shape (times,)
    compliance : creep compliance J at these times
    modulus : relaxation modulus ψ at these times if the force was measured, else None
    low, high : ends of the confidence intervals at these times: of J if the depth was measured, of ψ if the force was
        measured; nan if the scatter is not known
    scatter, freedom : standard deviation of the record, and its number of degrees of freedom; nan if not known
    misfit : root mean square of the residuals of `medium`
    shift : fitted offset and drift; the array contains only the quantities that were fitted
    shift_low, shift_high : ends of the confidence intervals of the quantities in `shift`
    """

    medium: FreeForm | Prony | Springpot
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
    """Choice of the errors of the measured depth that are fitted.

    offset : whether a constant error is fitted
    drift : whether an error that is linear in time is fitted
    """

    offset: bool
    drift: bool

    def columns(self, lags: Array) -> Array:
        """Return the derivatives of the measured depth with respect to offset and drift.

        The array has one column for each of the two that is fitted, shape (times, 0 to 2).

        lags : times after the start of the load, shape (times,)
        """
        columns = [np.ones(lags.size)] * self.offset + [lags] * self.drift
        return np.array(columns).reshape(-1, lags.size).T


def no_prony_series() -> ValueError:
    """Return the ValueError for a record that no Prony series describes."""
    name = spelled("--fit prony", "kind 'prony'")
    text = "the record shows no compliance at once, or no creep, which a Prony series needs"
    return ValueError(f"{name}: {text}; allowed: table or springpot")


def scatter_of(residual: Array, amounts: Array, others: int, exact: float) -> tuple[float, float]:
    """Return the standard deviation of a record about a fit, and its number of degrees of freedom.

    Both results are nan if the record does not determine them.

    residual : measured values minus fitted values, shape (rows,)
    amounts : values of the unknowns of the fit that cannot be negative, such as moduli
    others : number of unknowns that may have any sign
    exact : if the standard deviation is not above this value, the record counts as exact, and both results are nan
    """
    freedom = residual.size - _PER_AMOUNT * np.count_nonzero(amounts) - others
    if freedom < _LEAST_FREEDOM:
        return np.nan, np.nan
    scatter = np.sqrt((residual**2).sum() / freedom)
    return (scatter, freedom) if scatter > exact else (np.nan, np.nan)


def distance_of(scatter: float, freedom: float, unknowns: int = 1) -> float:
    """Return the distance that determines the width of confidence intervals.

    To test whether an interval contains a value, fix the quantity at this value and fit all other unknowns. The
    interval contains the value if the sum of squared residuals exceeds its minimum by at most distance².

    scatter, freedom : standard deviation of the record, and its number of degrees of freedom
    unknowns : number of unknowns of the joint confidence region whose extent is the interval; 1 for an interval of a
        single unknown
    """
    return scatter * np.sqrt(unknowns * fdtri(unknowns, min(freedom, _MANY), _LEVEL))


def damped_step(
    evaluate: Callable[[Array], tuple[float, Any]], last: Array, aim: Array, squares: float, halvings: int
) -> tuple[Array, float, Any] | None:
    """Take a step of the Gauss-Newton method from `last` towards `aim`, and halve it until the fit is not worse.

    Return the new unknowns, and the results of `evaluate` for them. Return None if all trial steps make the fit worse.

    evaluate : function of the unknowns that returns the sum of squared residuals and further results
    last, aim : unknowns before the step, and after a full step
    squares : sum of squared residuals at `last`
    halvings : largest number of trial steps, including the full step
    """
    for _ in range(halvings):
        new, state = evaluate(aim)
        if new <= squares:
            return aim, new, state
        aim = 0.5 * (aim + last)
    return None


def limit_early_times(low: Array, high: Array, time: Array, first: float) -> None:
    """Widen, in place, the intervals of J at times before the first measurement that depends on J.

    At these times the record shows only that J does not decrease. So the lower ends become 0, and the upper ends become
    equal to the upper end at the time of the first measurement that depends on J.

    low, high : ends of the intervals of J at the times `time`
    first : time of the first measurement that depends on J
    """
    before = np.flatnonzero(time < first)
    low[before], high[before] = 0.0, high[before.size]


def spread_times(first: float, last: float) -> Array:
    """Return a grid of retardation or relaxation times with equal ratios, from first/BEYOND to last·BEYOND.

    first, last : first and last time of a record
    """
    first, last = first / BEYOND, last * BEYOND
    return np.geomspace(first, last, 2 + int(_TIMES_PER_DECADE * np.log10(last / first)))


def finer_times(found: Array, times: Array, finer: int = 10) -> Array:
    """Return a finer grid in the neighbourhood of some retardation or relaxation times of a grid.

    found : times of the grid; the finer grid extends to their neighbours on both sides
    times : the grid, whose times have equal ratios
    finer : number of steps of the finer grid in one step of the grid
    """
    step = np.log(times[-1] / times[-2])
    near = np.arange(-finer, finer + 1) / finer * step
    # Neighbouring times of `found` give some points twice, with different rounding errors. Round the logarithms to make
    # these points equal.
    return np.exp(np.unique(np.round(np.add.outer(np.log(found), near), 9)))
