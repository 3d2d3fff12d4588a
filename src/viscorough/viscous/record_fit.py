"""Result of fitting a medium to a record, the scatter of a record, and the errors of its zero of depth.

The measured depth may have a wrong zero and may drift. It is then the depth plus an offset and a drift,

    u_measured = u + a + b (t − t₀),

with t₀ the start of the load. Both are unknowns of any sign in a least-squares fit.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.special import fdtri

from viscorough.basics.argument_names import spelled
from viscorough.basics.types import Array
from viscorough.media.kinds import CreepTable, Prony, Springpot

ROUNDING = 1e-9  # scatter relative to the largest value below which a record is exact
# The same for fits that move a row of merged springs with a grid of times: they are exact to about this.
RESOLUTION = 5e-5
# Degrees of freedom per positive amount. The mean of the sum of squares lies between the values for 1 and for 2 (Meyer
# and Woodroofe 2000), and 1.5 keeps the intervals from being too narrow. Fewer degrees of freedom than the second
# number leave the scatter undetermined.
_PER_AMOUNT, _LEAST_FREEDOM = 1.5, 2
_LEVEL = 0.95  # of the intervals
_MANY = 1e9  # degrees of freedom that stand for a known scatter
# Grid of retardation or relaxation times: by this factor it begins before and ends after the record. Around the times
# that are found it is refined once.
BEYOND, _TIMES_PER_DECADE = 3.0, 10


class RecordFit(NamedTuple):
    """A medium that was fitted to a record.

    medium : of the requested kind
    time, compliance : times, and J there, shape (times,)
    modulus : ψ at these times, if the force was measured
    low, high : ends of the interval of J, or of ψ if the force was measured; nan if the scatter is not known
    scatter, freedom : standard deviation of the record and its degrees of freedom; nan if they are not known
    misfit : root mean square of the residuals of the medium
    shift, shift_low, shift_high : the fitted ones of offset and drift, and the ends of their intervals
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
    """Which errors of the zero of depth are fitted.

    offset, drift : whether a constant, and a term linear in time, are added to the depth
    """

    offset: bool
    drift: bool

    def columns(self, lags: Array) -> Array:
        """Return the change of the measured depth by a unit of each fitted one, shape (times, 0 to 2).

        lags : times after the start of the load
        """
        columns = [np.ones(lags.size)] * self.offset + [lags] * self.drift
        return np.array(columns).reshape(-1, lags.size).T


def no_prony_series() -> ValueError:
    """Return the error of a record that no Prony series describes."""
    name = spelled("--fit prony", "kind 'prony'")
    text = "the record shows no compliance at once, or no creep, which a Prony series needs"
    return ValueError(f"{name}: {text}; allowed: table or springpot")


def scatter_of(residual: Array, amounts: Array, others: int, exact: float) -> tuple[float, float]:
    """Return the standard deviation of a record about a fit and its degrees of freedom; nan if not determined.

    amounts : the non-negative unknowns; others : number of unknowns of any sign
    exact : scatter up to which the record is exact to the resolution of the fit
    """
    freedom = residual.size - _PER_AMOUNT * np.count_nonzero(amounts) - others
    if freedom < _LEAST_FREEDOM:
        return np.nan, np.nan
    scatter = np.sqrt((residual**2).sum() / freedom)
    return (scatter, freedom) if scatter > exact else (np.nan, np.nan)


def distance_of(scatter: float, freedom: float, unknowns: int = 1) -> float:
    """Return √(least squares of a value at the end of its interval − least squares).

    unknowns : number of unknowns whose joint region gives the interval
    """
    return scatter * np.sqrt(unknowns * fdtri(unknowns, min(freedom, _MANY), _LEVEL))


def damped_step(
    evaluate: Callable[[Array], tuple[float, Any]], last: Array, aim: Array, squares: float, halvings: int
) -> tuple[Array, float, Any] | None:
    """Return the first unknowns on the way back from `aim` to `last` that fit as well as `last`; None if none does.

    evaluate : function of the unknowns that returns the sum of squared residuals and a state. Both are returned with
        the unknowns.
    squares : sum of squared residuals at `last`
    halvings : largest number of unknowns that are tried
    """
    for _ in range(halvings):
        new, state = evaluate(aim)
        if new <= squares:
            return aim, new, state
        aim = 0.5 * (aim + last)
    return None


def limit_early_times(low: Array, high: Array, time: Array, first: float) -> None:
    """Change intervals of J before the time `first`, in place: there the record shows only that J does not decrease."""
    before = np.flatnonzero(time < first)
    low[before], high[before] = 0.0, high[before.size]


def spread_times(first: float, last: float) -> Array:
    """Return times of branches at equal ratios from before the first to after the last time of a record."""
    first, last = first / BEYOND, last * BEYOND
    return np.geomspace(first, last, 2 + int(_TIMES_PER_DECADE * np.log10(last / first)))


def finer_times(found: Array, times: Array, finer: int = 10) -> Array:
    """Return times of branches about those that were found among `times`, which lie at equal ratios.

    finer : number of steps that replace one
    """
    step = np.log(times[-1] / times[-2])
    near = np.arange(-finer, finer + 1) / finer * step
    # Points of neighbouring grids coincide up to rounding.
    return np.exp(np.unique(np.round(np.add.outer(np.log(found), near), 9)))
