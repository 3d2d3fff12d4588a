"""Medium, confidence intervals, scatter and misfit of a record, for every kind of record and medium."""

from typing import NamedTuple

import numpy as np
from scipy.special import fdtri, gamma

from viscorough.basics.argument_names import spelled
from viscorough.basics.types import Array
from viscorough.media.free_form import creep_columns, relaxation_columns
from viscorough.media.kinds import Prony, Springpot
from viscorough.media.spectra import RelaxationSpectrum
from viscorough.media.table import FreeForm, free_form_of
from viscorough.viscous.fit.linear import extremes
from viscorough.viscous.fit.nonlinear import (
    ElementFit,
    fit_elements,
    fit_springpot,
    fit_without_drift,
    with_free_times,
)
from viscorough.viscous.fit.offset import crossing, fits_of_offsets
from viscorough.viscous.fit.records import ForceRecord, Record

# If fewer degrees of freedom are left, the scatter is not determined.
_LEAST_FREEDOM = 2
# Confidence level of all intervals.
_LEVEL = 0.95
# If the scatter is known, the number of degrees of freedom is infinite. This number is used instead of infinity.
_MANY = 1e9
# J and ψ are given at time 0, at _KNOTS times with equal ratios, and at the times of up to _KNOTS measurements. If
# measurements depend on J or ψ before the first of them, the first time is the time of the first measurement divided by
# _EARLIER.
_KNOTS, _EARLIER = 60, 64
# At most this number of fits at different offsets is used to compute the confidence intervals of J or ψ.
_INSIDE = 12
# Two times count as equal if their relative difference is below this number.
_SAME = 1e-9
# J₀ counts as 0 if it is below this share of J at the end of the record.
_NO_SPRING = 1e-9


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


def fit_record(record: Record, kind: str, scatter: float | None) -> RecordFit:
    """Fit a medium to a record.

    kind : kind of medium: "table", "prony" or "springpot"
    scatter : standard deviation of the measured values; None to estimate it from the record; nan for a fit without
        confidence intervals

    Raises ValueError if the record shows no force or no relaxation, or does not determine a medium of this kind.
    """
    by_force = isinstance(record, ForceRecord)

    def allowed(fit: ElementFit) -> float:
        deviation, freedom = _scatter(record, fit, scatter)
        return float(np.nan_to_num(_distance(record, fit, deviation, freedom))) ** 2

    if record.profile:
        fits = fits_of_offsets(record, allowed)
    else:
        fits = [(record, with_free_times(record, fit_elements(record, record.grid())))]
    record, fit = min(fits, key=lambda pair: pair[1].squares)
    if not fit.amounts.any():
        quantity = "force" if by_force else "depth"
        raise ValueError(f"record: no {quantity}; allowed: records that show how the medium creeps or relaxes")
    scatter, freedom = _scatter(record, fit, scatter)
    distance = _distance(record, fit, scatter, freedom)
    found, time = _medium(record, fit), _times(record)
    low, high, shift_low, shift_high = _intervals(fits, time, distance)
    if not np.isnan(distance):
        _limit_early_times(record, low, high, time)
    compliance = found.creep_compliance(time)
    medium: FreeForm | Prony | Springpot = found
    shift, residual = fit.shift, record.measured - fit.tangent.predicted
    if kind == "prony":
        medium = _prony(found)
    elif kind == "springpot":
        medium, shift, residual = fit_springpot(record, _power_law(time[1:], compliance[1:]), fit.shift)
    modulus = _columns(record, fit.times, time) @ fit.amounts if by_force else None
    if record.profile:
        shift = np.append(record.offset, shift)
    misfit = float(np.sqrt(np.mean(residual**2)))
    return RecordFit(
        medium, time, compliance, modulus, low, high, scatter, freedom, misfit, shift, shift_low, shift_high
    )


def _scatter(record: Record, fit: ElementFit, scatter: float | None) -> tuple[float, float]:
    """Return the standard deviation of a record about a fit, and its number of degrees of freedom.

    Both results are nan if the record does not determine them.

    scatter : known standard deviation; None to estimate it from the residuals of the fit
    """
    if scatter is not None:
        return scatter, np.inf
    freedom = float(record.measured.size - _unknowns(record, fit))
    if freedom < _LEAST_FREEDOM:
        return np.nan, np.nan
    scatter = float(np.sqrt(fit.squares / freedom))
    return (scatter, freedom) if scatter > record.resolution else (np.nan, np.nan)


def _distance(record: Record, fit: ElementFit, scatter: float, freedom: float) -> float:
    """Return the distance that determines the width of confidence intervals; nan if the scatter is not known.

    The confidence region contains all media whose sum of squared residuals exceeds the minimum by at most distance².
    The interval of a quantity is its range in this region. For the true medium, the excess divided by the variance
    follows a chi-squared distribution. Its number of degrees of freedom is the number of unknowns that the constraints
    leave free in the best fit (Shapiro, Int. Stat. Rev. 56, 49, 1988).

    scatter, freedom : standard deviation of the record, and its number of degrees of freedom
    """
    unknowns = _unknowns(record, fit)
    quantile = float(fdtri(unknowns, min(freedom, _MANY), _LEVEL))
    return float(np.hypot(scatter, record.resolution) * np.sqrt(unknowns * quantile))


def _unknowns(record: Record, fit: ElementFit) -> int:
    """Return the number of fitted unknowns: of the medium, and offset and drift as far as they are fitted."""
    return fit.number_of_unknowns(record.leading) + fit.shift.size + record.profile


def _times(record: Record) -> Array:
    """Return the times at which J and ψ are given."""
    first, last = record.first, float(record.lags[-1])
    # After a step of the force, the first measurement depends on no J at earlier times.
    starts_with_step = not isinstance(record, ForceRecord) and record.load.values[0] > 0
    knots = np.geomspace(first if starts_with_step else first / _EARLIER, last, _KNOTS)
    rows = record.lags[record.lags > 0]
    if rows.size > _KNOTS:
        return np.append(0.0, knots)
    near = np.abs(np.log(np.divide.outer(knots, rows))).min(axis=1) < _SAME
    return np.append(0.0, np.union1d(knots[~near], rows))


def _columns(record: Record, times: Array, time: Array) -> Array:
    """Return J or ψ of elements of unit amount at the times `time`, shape (times, amounts)."""
    return (relaxation_columns if isinstance(record, ForceRecord) else creep_columns)(time, times)


def _intervals(
    fits: list[tuple[Record, ElementFit]], time: Array, distance: float
) -> tuple[Array, Array, Array, Array]:
    """Return the ends of the confidence intervals of J or ψ, and of offset and drift.

    The four arrays are the lower and the upper ends for J or ψ, and the lower and the upper ends for offset and drift.

    fits : the best fit, or fits at several offsets in increasing order, and their records
    time : times of the intervals of J or ψ, shape (times,)
    distance : see `_distance`; nan for no intervals
    """
    profile = fits[0][0].profile
    fitted = fits[0][1].shift.size + profile
    if np.isnan(distance):
        return *np.full((2, time.size), np.nan), *np.full((2, fitted), np.nan)
    squares = np.array([fit.squares for _, fit in fits])
    largest = squares.min() + distance**2
    excess = squares - largest
    inside = np.flatnonzero(excess <= 0)
    chosen = np.unique(np.append(inside[np.linspace(0, inside.size - 1, _INSIDE).astype(int)], squares.argmin()))
    lows, highs = [], []
    for record, fit in (fits[k] for k in chosen):
        # The tangent at a fit with a large drift, which slow creep compensates, misses the media of small drifts.
        others = [fit_without_drift(record, fit.times)] if record.drift else []
        for near in [fit, *(other for other in others if other.squares <= largest)]:
            values, tangent = _columns(record, near.times, time), near.tangent
            low, high = extremes(tangent.columns, near.target(record.measured), values, largest, tangent.signed)
            # Include the values of the fit itself. At an end of the interval of the offset, the interval contains no
            # other values.
            own = np.append(values @ near.amounts, near.shift)
            lows.append(np.minimum(low, own))
            highs.append(np.maximum(high, own))
    low, high = np.min(lows, axis=0), np.max(highs, axis=0)
    ends_low, ends_high = low[time.size :], high[time.size :]
    if profile:
        offsets = np.array([record.offset for record, _ in fits])
        ends = [crossing(offsets[::way], excess[::way]) for way in (-1, 1)]
        ends_low, ends_high = np.append(ends[0], ends_low), np.append(ends[1], ends_high)
    return low[: time.size], high[: time.size], ends_low, ends_high


def _limit_early_times(record: Record, low: Array, high: Array, time: Array) -> None:
    """Widen, in place, the intervals of J or ψ at times before the first measurement.

    The depth shows only that J does not decrease before this time. So the lower ends become 0, and the upper ends
    become equal to the upper end at this time. The force shows only the integral of ψ before this time, which may be a
    high pulse. So the upper ends become infinite.
    """
    if isinstance(record, ForceRecord):
        high[time < record.first * (1 - _SAME)] += np.inf
        low[low < record.resolution / record.elastic_force] = 0.0
        return
    # If the force starts with a step and the depth is measured at this time, this measurement depends on J.
    if record.lags[0] == 0 < record.load.values[0]:
        return
    before = np.flatnonzero(time < record.first * (1 - _SAME))
    low[before], high[before] = 0.0, high[before.size]


def _medium(record: Record, fit: ElementFit) -> FreeForm:
    """Return the medium of a fit."""
    first, last = 0.0, float(record.lags[-1])
    if not isinstance(record, ForceRecord):
        return FreeForm(float(fit.amounts[0]), float(fit.amounts[1]), fit.amounts[2:], fit.times, first, last)
    used = fit.amounts[1:] > 0
    if not used.any():
        raise ValueError(
            f"record: the force does not relax, as in an elastic body of the modulus {fit.amounts[0]:.6g}; allowed: "
            "records of media that relax"
        )
    relaxation = RelaxationSpectrum(0.0, float(fit.amounts[0]), fit.amounts[1:][used], fit.times[used])
    return free_form_of(relaxation, first, last)


def _prony(medium: FreeForm) -> Prony:
    """Return a medium as a Prony series. Raises ValueError without an instantaneous compliance or without creep."""
    creeps = medium.fluidity > 0 or medium.compliances.size > 0
    last = float(medium.creep_compliance(medium.last_time))
    if not (medium.instantaneous_compliance > _NO_SPRING * last and creeps):
        name = spelled("--fit prony", "kind 'prony'")
        text = "the record shows no compliance at once, or no creep, which a Prony series needs"
        raise ValueError(f"{name}: {text}; allowed: table or springpot")
    _, relaxed, moduli, times = medium.relaxation
    return Prony(float(relaxed), moduli.tolist(), times.tolist())


def _power_law(time: Array, compliance: Array) -> Springpot:
    """Return the springpot whose J is a power law through given values of J."""
    shown = compliance > 0
    exponent = np.polyfit(np.log(time[shown]), np.log(compliance[shown]), 1)[0]
    exponent = float(np.clip(exponent, 0.01, 0.99))
    middle = np.mean(np.log(compliance[shown]) - exponent * np.log(time[shown]))
    return Springpot(float(np.exp(-middle) / gamma(1 + exponent)), exponent)
