"""Fit of a medium to the measured depth of a contact that recedes, under a known force that decreases.

The medium has the creep compliance J = J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)), with retardation times θ_j on a grid. The
unknown coefficients J₀, φ, J_j ≥ 0 are called amounts. Independent viscoelastic springs with gaps, which have the same
loading curve, replace the contact (viscous.row). For given amounts, the depth as a function of time follows from
the exact motion of these springs (viscous.move). It is not linear in the amounts, so the Gauss-Newton method
finds the amounts that fit the measured depth. The derivatives of the depth are computed as difference quotients. The
first guess is a fit to the measurements before the force decreases.

A row of the record is one measurement, a time with a depth.
"""

import numpy as np

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.types import Array, Integers
from viscorough.media.kinds import Prony, Springpot
from viscorough.media.load import Load
from viscorough.media.spectra import RetardationSpectrum, relaxation_spectrum, spectrum_of
from viscorough.media.table import FreeForm, free_form_of_creep
from viscorough.results.loading_curve import LoadingCurve
from viscorough.viscous.creep_fit import first_lag, knots_of, prony_series, spectrum_of_growth
from viscorough.viscous.kinetics import kinetics
from viscorough.viscous.move import move_row
from viscorough.viscous.non_negative import extremes, non_negative
from viscorough.viscous.record_fit import (
    RESOLUTION,
    ROUNDING,
    RecordFit,
    Shift,
    damped_step,
    distance_of,
    finer_times,
    limit_early_times,
    no_prony_series,
    scatter_of,
    spread_times,
)
from viscorough.viscous.row import merged, row_of_springs

# Largest number of Gauss-Newton iterations, and of trial steps in an iteration. If a step increases the sum of squares,
# the next trial step has half the length.
_ITERATIONS, _HALVINGS = 12, 6
# The Gauss-Newton iterations end when the sum of squares decreases by less than this share.
_STALLED = 1e-3
# The refined grid of retardation times has this number of steps in one step of the first grid.
_FINER = 4
# Neighbouring springs that replace the contact are merged until there are at most this number of springs.
_SPRINGS = 1000
# Smallest J₀, and smallest φ multiplied by the duration of the load, as shares of J at the end of the load. Both must
# be above 0, because the motion needs the relaxation spectrum of the medium.
_LEAST_SPRING, _LEAST_DASHPOT = 1e-6, 1e-7
# For a difference quotient, J₀, φ or one J_j is increased so that J at the end of the load grows by this share.
_STEP = 1e-4


def fit_receding_depth(
    curve: LoadingCurve, load: Load, place: Integers, depth: Array, kind: str, scatter: float | None, shift: Shift
) -> RecordFit:
    """Fit a medium to the measured depth of a contact that recedes.

    The arguments are the same as in creep_fit.fit_growing_depth.

    Raises ValueError if fewer than five measurements precede the first decrease of the force. Also raises it if the
    contact would grow beyond the end of the loading curve in the medium that fits these measurements.
    """
    lags = load.time[place] - load.time[0]
    falls = np.flatnonzero(np.diff(load.values) < 0)
    grown = place <= falls[0]
    if np.count_nonzero(grown) < 5:
        raise ValueError(
            f"record: {np.count_nonzero(grown)} rows before the force decreases at time {load.time[falls[0]]:g}; "
            "allowed: five or more"
        )
    spread = spread_times(*lags[lags > 0][[0, -1]])
    signed = shift.columns(lags)
    amounts, shifted = spectrum_of_growth(curve, load, place[grown], depth[grown], spread, signed[grown])
    record = _RecedingRecord(curve, load, place, depth, spread, signed)
    amounts, shifted, predicted, columns = record.fit(amounts, shifted)
    if (amounts[2:] > 0).any():
        times, start = _refined(spread, amounts)
        record = _RecedingRecord(curve, load, place, depth, times, signed)
        amounts, shifted, predicted, columns = record.fit(start, shifted)
    residual, resolution, freedom = depth - predicted - signed @ shifted, RESOLUTION * depth.max(), np.inf
    if scatter is None:
        scatter, freedom = scatter_of(residual, amounts, shifted.size, resolution)
    time = np.append(0.0, knots_of(load, lags))
    values = np.column_stack([np.ones(time.size), time, -np.expm1(-time[:, None] / record.times)])
    low = high = np.full(time.size + shifted.size, np.nan)
    if not np.isnan(scatter):
        target = depth - predicted + columns @ amounts
        # Offset and drift have almost the same effect as slow elements. So their intervals, and those of J, follow from
        # a joint confidence region of all unknowns above 0.
        unknowns = shifted.size + int(np.count_nonzero(amounts)) if shifted.size else 1
        distance = distance_of(np.hypot(scatter, resolution), freedom, unknowns)
        low, high = extremes(columns, target, values, distance, signed)
        limit_early_times(low, high, time, first_lag(load, lags))
    compliance = values @ amounts
    medium: FreeForm | Prony | Springpot = free_form_of_creep(time, compliance)
    if kind == "prony":
        medium = _prony(amounts, record.times, compliance[-1])
    elif kind == "springpot":
        medium, residual = _springpot(curve, load, place, depth, time[1:], compliance[1:], signed)
    misfit = float(np.sqrt(np.mean(residual**2)))
    (low, shift_low), (high, shift_high) = (np.split(ends, [time.size]) for ends in (low, high))
    return RecordFit(
        medium, time, compliance, None, low, high, float(scatter), float(freedom), misfit,
        shifted, shift_low, shift_high,
    )  # fmt: skip


def _refined(times: Array, amounts: Array) -> tuple[Array, Array]:
    """Refine the grid of retardation times around the times with positive amounts.

    Return the refined grid, and first guesses of the amounts J₀, φ and J_j for a new fit.

    times : first grid of retardation times θ_j
    amounts : J₀, φ and J_j of the fit on the first grid
    """
    found = amounts[2:] > 0
    finer = finer_times(times[found], times, _FINER)
    start = np.append(amounts[:2], np.zeros(finer.size))
    start[2 + np.abs(np.subtract.outer(times[found], finer)).argmin(axis=1)] = amounts[2:][found]
    return finer, start


def _prony(amounts: Array, times: Array, last: float) -> Prony:
    """Return the Prony series with given J₀, φ and J_j. Raises ValueError if J₀ is 0, or if φ and all J_j are 0.

    amounts : coefficients J₀, φ and J_j of the creep compliance (see the module)
    times : retardation times θ_j
    last : J at the end of the record; J₀ counts as 0 if it is a negligible share of this value
    """
    if amounts[0] <= ROUNDING * last or not amounts[1:].any():
        raise no_prony_series()
    return prony_series(float(amounts[0]), float(amounts[1]), amounts[2:], times)


class _RecedingRecord:
    """Measured depths of a receding contact, with the least-squares fit of J₀, φ and J_j (see the module) to them.

    load, place, depth : see creep_fit.fit_growing_depth
    times : retardation times θ_j, shape (elements,)
    signed : derivatives of the measured depth with respect to offset and drift, one column for each that is fitted,
        shape (rows, 0 to 2)
    """

    def __init__(
        self, curve: LoadingCurve, load: Load, place: Integers, depth: Array, times: Array, signed: Array
    ) -> None:
        self.load, self.place, self.depth, self.times, self.signed = load, place, depth, times, signed
        row = row_of_springs(curve)
        self.gap, self.stiffness = merged(row.gap, row.stiffness, curve.depth[-1], _SPRINGS)
        self.limit = row.limit
        self.duration = load.time[-1] - load.time[0]
        # Derivatives of J at the end of the load with respect to J₀, φ and J_j.
        self.ends = np.append([1.0, self.duration], -np.expm1(-self.duration / times))

    def fit(self, amounts: Array, shift: Array) -> tuple[Array, Array, Array, Array]:
        """Fit the medium, and an offset and a drift of the depth, to the measured depth by the Gauss-Newton method.

        Return four arrays: the amounts J₀, φ and J_j of the medium (see the module); the offset and the drift, as far
        as they are fitted; the fitted depth at the time of each measurement, without offset and drift; and the
        derivatives of this depth with respect to the amounts.

        amounts : first guesses of J₀, φ and J_j
        shift : first guesses of offset and drift, as far as they are fitted
        """
        predicted = self._predicted(amounts)
        if np.isnan(predicted).any():
            raise ValueError(
                "record: in the medium that the rows before the decrease of the force show, the contact grows beyond "
                f"the curve's last level; allowed: curves of larger contacts, with {argument('until_fraction', 1)}"
            )
        count = amounts.size

        def evaluate(unknowns: Array) -> tuple[float, Array]:
            """Return the sum of squared residuals, and the depth at the time of each measurement.

            If the contact grows beyond the end of the loading curve, the sum is nan. A step with this result is not
            accepted.
            """
            predicted = self._predicted(unknowns[:count])
            return float(((self.depth - predicted - self.signed @ unknowns[count:]) ** 2).sum()), predicted

        unknowns = np.append(amounts, shift)
        squares, predicted = evaluate(unknowns)
        columns = self._derivatives(amounts, predicted)
        for _ in range(_ITERATIONS):
            target = self.depth - predicted + columns @ unknowns[:count]
            aim = np.concatenate(non_negative(columns, target, self.signed))
            step = damped_step(evaluate, unknowns, aim, squares, _HALVINGS)
            if step is None:
                break
            last = squares
            unknowns, squares, predicted = step
            columns = self._derivatives(unknowns[:count], predicted)
            if squares > (1 - _STALLED) * last:
                break
        return unknowns[:count], unknowns[count:], predicted, columns

    def _predicted(self, amounts: Array) -> Array:
        """Return the depth at the time of each measurement in a medium with the given J₀, φ and J_j.

        After the contact has grown beyond the end of the loading curve, the depth is nan.
        """
        largest = amounts @ self.ends
        kept = amounts[2:] > 0
        retardation = RetardationSpectrum(
            max(float(amounts[0]), _LEAST_SPRING * largest),
            max(float(amounts[1]), _LEAST_DASHPOT * largest / self.duration),
            amounts[2:][kept],
            self.times[kept],
        )
        spectrum = spectrum_of(relaxation_spectrum(retardation), retardation)
        moved = move_row(
            self.gap, self.stiffness, self.limit, spectrum, self.load.time, self.load.values, by_depth=False
        )
        return moved.depth[self.place]

    def _derivatives(self, amounts: Array, predicted: Array) -> Array:
        """Return the derivatives of the depth with respect to J₀, φ and J_j at the time of each measurement.

        The array has a row for each measurement, and a column for each of the amounts J₀, φ and J_j.

        predicted : depth at the time of each measurement for these amounts
        """
        columns = np.empty((predicted.size, amounts.size))
        for k, step in enumerate(_STEP * (amounts @ self.ends) / self.ends):
            changed = amounts.copy()
            changed[k] += step
            columns[:, k] = (self._predicted(changed) - predicted) / step
        return np.nan_to_num(columns)


def _springpot(
    curve: LoadingCurve, load: Load, place: Integers, depth: Array, time: Array, compliance: Array, signed: Array
) -> tuple[Springpot, Array]:
    """Return the springpot that fits the depth best, and the residuals of the depth.

    time, compliance : creep compliance J at several times, from a fit of springs and dashpots. The first guess of the
        springpot is a power law through this J
    """
    from scipy.optimize import least_squares  # this import takes long
    from scipy.special import gamma

    exponent, logarithm = np.polyfit(np.log(time), np.log(compliance), 1)
    exponent = float(np.clip(exponent, 0.01, 0.99))

    def medium(x: Array) -> Springpot:
        return Springpot(float(np.exp(-x[0]) / gamma(1 + x[1])), float(x[1]))

    force = Load(load.time, force=load.values * units.square_metres(curve.length_unit))

    def residual(x: Array) -> Array:
        rest = depth - kinetics(curve, force, medium(x), load.time[place]).depth
        return rest - signed @ np.linalg.lstsq(signed, rest)[0]

    bounds = ([-np.inf, 0.001], [np.inf, 0.999])
    found = least_squares(residual, [logarithm, exponent], bounds=bounds, diff_step=1e-4, xtol=1e-6, ftol=1e-8)
    return medium(found.x), found.fun
