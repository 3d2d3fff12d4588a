"""Fit of a medium to the measured depth of a growing contact under a known force.

While the contact grows, the elastic force F_el at the measured depth u equals the creep response Φ (viscous.kinetics):

    F_el(u(t))/G = Φ(t) = ∫₀ᵗ J(t − s) dF(s).

After a step of the force from 0 to F, Φ = F J(t). For any other force, this is a Volterra equation of the first kind
for the creep compliance J. Two families of J are fitted to the depth by least squares:

1. Media of springs and dashpots: J = J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)), with unknown amounts J₀, φ, J_j ≥ 0. The grid
   of retardation times θ_j is refined around the times with J_j > 0. Only a few of the amounts are positive in the best
   fit, so that its residuals show the scatter of the record.
2. All J that are concave and do not decrease; every medium that relaxes has such a J. The fit uses
   J = J₀ + Σ c_k min(t, τ_k), with times τ_k (knots) and unknown amounts J₀, c_k ≥ 0. The creep response of min(t, τ)
   is I(t) − I(t − τ), with the impulse I(t) = ∫₀ᵗ F dt. This family can pass through every measurement of a short or
   precise record, so its residuals do not show the scatter.

The confidence intervals of J contain every J that fits the record well enough: in the second family, and among all J
that do not decrease (`_Record.intervals`). They use the scatter of the first fit, or the scatter that the user stated.

Straight lines between the knots alone would shift the fit of the second family. Therefore a correction is added to its
creep response. The correction follows from the J that was fitted in the first family: it is the creep response of this
J, minus the response of the straight lines between its values at the knots.
"""

import numpy as np
from scipy.special import gamma

from viscorough.basics.arrays import integral
from viscorough.basics.types import Array, Integers
from viscorough.media.creep_response import branch_states, creep_response
from viscorough.media.kinds import Prony, Springpot
from viscorough.media.load import Load
from viscorough.media.spectra import zero_of_increasing
from viscorough.media.table import FreeForm, free_form_of_creep
from viscorough.results.loading_curve import LoadingCurve
from viscorough.viscous.non_negative import extremes, non_negative
from viscorough.viscous.record_fit import (
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

# Largest number of knots (times between which the fitted J is straight).
_KNOTS = 60
# If the force starts with a ramp, the first knot is the time of the first measurement divided by this number.
_EARLIER = 64
# Largest number of Gauss-Newton iterations, without and with a fitted offset or drift of the depth. Without them, few
# iterations are enough, because the loading curve is almost straight within the scatter of the depth. The iterations
# end when the residuals change by less than the share _CLOSE of the largest depth.
_ITERATIONS, _ITERATIONS_OF_SHIFT, _CLOSE = 6, 60, 1e-13
# Largest number of trial steps in a Gauss-Newton iteration. If a step increases the sum of squares, the next trial step
# has half the length.
_HALVINGS = 12


def fit_growing_depth(
    curve: LoadingCurve, load: Load, place: Integers, depth: Array, kind: str, scatter: float | None, shift: Shift
) -> RecordFit:
    """Fit a medium to the measured depth of a contact that grows.

    curve : loading curve of the indenter
    load : force as a function of time, in units of modulus × length², with a sample at the time of each measurement
    place : index of the sample of the load at the time of each measurement (row of the record), shape (rows,)
    depth : measured depth, shape (rows,)
    kind : kind of medium: "table", "prony" or "springpot"
    scatter : standard deviation of the measured depth; None to estimate it from the record; nan for a fit without
        confidence intervals
    shift : whether an offset and a drift of the depth are fitted, too
    """
    lags = load.time[place] - load.time[0]
    record = _Record(curve, depth, shift.columns(lags))
    spectrum = _Spectrum(record, load, place, lags[lags > 0])
    freedom = np.inf
    if scatter is None:
        residual = record.residual(spectrum.creep)
        scatter, freedom = scatter_of(residual, spectrum.amounts, record.signed.shape[1], ROUNDING * depth.max())
    knots = knots_of(load, lags)
    times = load.time[place]
    impulse, earlier = (integral(load.time, load.values, t) for t in (times[:, None], times[:, None] - knots))
    responses = np.column_stack([load.values[place], impulse - earlier])
    time = np.append(0.0, knots)
    values = np.column_stack([np.ones(time.size), np.minimum(time[:, None], knots)])
    bend = spectrum.creep - responses @ _amounts(spectrum.compliance(time), knots)
    coefficients, _ = record.fit(responses, bend)
    compliance = np.maximum.accumulate(values @ coefficients)  # rounding may make a constant J decrease
    fitted = record.signed.shape[1]
    low = high = np.full(time.size + fitted, np.nan)
    if not np.isnan(scatter):
        low, high = record.intervals(coefficients, responses, bend, values, distance_of(scatter, freedom))
        limit_early_times(low, high, time, first_lag(load, lags))
    if kind == "prony":
        medium: FreeForm | Prony | Springpot = spectrum.prony(load.values[place].max())
    elif kind == "springpot":
        medium = _springpot(record, load, place)
    else:
        medium = free_form_of_creep(time, compliance)
    creep = creep_response(medium.spectrum(load)[0], load)[place]
    misfit = float(np.sqrt(np.mean(record.residual(creep) ** 2)))
    (low, shift_low), (high, shift_high) = (np.split(ends, [time.size]) for ends in (low, high))
    return RecordFit(
        medium, time, compliance, None, low, high, float(scatter), float(freedom), misfit,
        record.shift(creep), shift_low, shift_high,
    )  # fmt: skip


def spectrum_of_growth(
    curve: LoadingCurve, load: Load, place: Integers, depth: Array, times: Array, signed: Array
) -> tuple[Array, Array]:
    """Fit springs and dashpots to the measured depth of a growing contact.

    Return the coefficients J₀, φ and J_j of J (see the module), and the offset and drift of the depth (as far as they
    are fitted).

    curve, load, place, depth : see fit_growing_depth
    times : retardation times θ_j, shape (elements,)
    signed : derivatives of the measured depth with respect to offset and drift, one column for each that is fitted,
        shape (rows, 0 to 2)
    """
    return _Record(curve, depth, signed).fit(_spectral_responses(load, place, times))


def _spectral_responses(load: Load, place: Integers, times: Array) -> Array:
    """Return the creep responses of J = 1, J = t and J = 1 − exp(−t/θ_j) at the time of each measurement.

    The shape is (rows, 2 + elements), with a row for each measurement.

    times : retardation times θ_j, shape (elements,)
    """
    delayed, _ = branch_states(np.diff(load.time), load.values, times)
    return np.column_stack([load.values[place], load.integral[place], delayed[place]])


def first_lag(load: Load, lags: Array) -> float:
    """Return the time, after the start of the load, of the first measurement that depends on J.

    If the force starts with a step and the depth is measured at this time, this measurement depends on J, and the
    result is 0. Otherwise the first measurement after the start depends on J.

    lags : times of the measurements, counted from the start of the load
    """
    return 0.0 if lags[0] == 0 < load.values[0] else float(lags[lags > 0][0])


def knots_of(load: Load, lags: Array) -> Array:
    """Return the knots, the times between which the fitted J is straight, measured from the start of the load.

    If the force starts with a step, each knot is the time of a measurement, and there are at most _KNOTS knots. If the
    force starts with a ramp, there are _KNOTS knots. The ratio of successive knots is then constant, the first knot
    lies before the first measurement, and the last knot is the time of the last measurement.

    lags : times of the measurements, counted from the start of the load
    """
    knots = lags[lags > 0]
    # If the force starts with a ramp from 0, the depth at the first measurement depends on J at all times before it. So
    # these times need knots, too.
    if load.values[0] == 0:
        return np.geomspace(knots[0] / _EARLIER, knots[-1], _KNOTS)
    if knots.size > _KNOTS:  # keep times with about equal ratios
        spread = np.geomspace(knots[0], knots[-1], _KNOTS)
        knots = knots[np.unique(np.clip(np.searchsorted(knots, spread * (1 - 1e-12)), 0, knots.size - 1))]
    return knots


def _amounts(compliance: Array, knots: Array) -> Array:
    """Compute the coefficients J₀ and c_k of J = J₀ + Σ c_k min(t, τ_k) from values of J.

    compliance : J at time 0 and at the knots τ_k, shape (1 + knots,)
    """
    slopes = np.diff(compliance) / np.diff(knots, prepend=0.0)
    return np.append(compliance[0], slopes - np.append(slopes[1:], 0.0))


class _Record:
    """Measured depths of a growing contact (the record), with the least-squares fit of J to them.

    J is a sum of given functions of time, each multiplied by an unknown coefficient ≥ 0, its amount. A row of the
    record is one measurement, a time with a depth.

    signed : derivatives of the measured depth with respect to offset and drift, one column for each that is fitted,
        shape (rows, 0 to 2)
    """

    def __init__(self, curve: LoadingCurve, depth: Array, signed: Array) -> None:
        self.curve, self.depth, self.signed = curve, depth, signed
        self.creep, self.stiffness = elastic_force(curve, depth)  # F/G and k/G of the curve at the measured depths

    def fit(self, responses: Array, bend: Array | float = 0.0) -> tuple[Array, Array]:
        """Fit J = Σ a_m f_m(t), and an offset and a drift, to the measured depth by the Gauss-Newton method.

        Return the coefficients a_m ≥ 0 (amounts), and an array with offset and drift (as far as they are fitted).

        responses : creep response to the force for J = f_m at each row of the record, shape (rows, amounts)
        bend : known creep response that is added to Σ a_m × response, shape (rows,)
        """
        # First guess: replace the curve by its tangent at each measured depth, and take offset and drift as 0.
        amounts, _ = non_negative(responses / self.stiffness[:, None], (self.creep - bend) / self.stiffness)
        shift = np.zeros(self.signed.shape[1])
        count = amounts.size

        def evaluate(unknowns: Array) -> tuple[float, tuple[Array, Array, Array]]:
            elastic_depth, stiffness = self._elastic(responses @ unknowns[:count] + bend)
            residual = self.depth - elastic_depth - self.signed @ unknowns[count:]
            return float(residual @ residual), (elastic_depth, stiffness, residual)

        unknowns = np.append(amounts, shift)
        squares, (elastic_depth, stiffness, residual) = evaluate(unknowns)
        for _ in range(_ITERATIONS_OF_SHIFT if shift.size else _ITERATIONS):
            target = responses @ unknowns[:count] / stiffness + self.depth - elastic_depth
            aim = np.concatenate(non_negative(responses / stiffness[:, None], target, self.signed))
            step = damped_step(evaluate, unknowns, aim, squares, _HALVINGS)
            if step is None:
                break
            last = residual
            unknowns, squares, (elastic_depth, stiffness, residual) = step
            if np.abs(residual - last).max() <= _CLOSE * np.abs(self.depth).max():
                break
        return unknowns[:count], unknowns[count:]

    def _elastic(self, creep: Array) -> tuple[Array, Array]:
        """Return depth and stiffness k/G of the loading curve at the elastic force F/G = creep.

        Before its first computed point, the curve is taken to be a straight line from the origin.
        """
        curve = self.curve
        creep = np.minimum(creep, curve.force[-1])
        depth, stiffness = curve.at_force(creep)
        before = creep < curve.force[0]
        line = curve.force[0] / curve.depth[0]
        return np.where(before, creep / line, depth), np.where(before, line, stiffness)

    def intervals(
        self, amounts: Array, responses: Array, bend: Array, values: Array, distance: float
    ) -> tuple[Array, Array]:
        """Return the lower ends and the upper ends of the confidence intervals of J, offset and drift.

        Each array starts with the ends for J, followed by offset and drift (as far as they are fitted). An interval
        contains a value if the sum of squared residuals of the best fit with this value exceeds the minimum by at most
        distance². Such fits are made twice: among all concave J, and among all J that do not decrease. The returned
        interval contains both intervals. Concave J alone do not suffice, because concave fits of an almost straight J,
        as in a fluid, lie above this J.

        J = Σ a_m f_m(t) is a sum of given functions of time with unknown coefficients a_m ≥ 0 (amounts).

        amounts : coefficients a_m of the concave J that `fit` returned
        responses : creep response to the force for J = f_m at each row of the record, shape (rows, amounts)
        bend : known creep response that is added to Σ a_m × response, shape (rows,)
        values : f_m at the times of the intervals, shape (times, amounts)
        """
        creep = responses @ amounts
        elastic_depth, stiffness = self._elastic(creep + bend)
        target = creep / stiffness + self.depth - elastic_depth
        concave = responses / stiffness[:, None], values
        steps = [np.column_stack([part[:, :2], np.diff(part[:, 1:], axis=1)]) for part in concave]
        lows, highs = zip(
            *(extremes(rows, target, row, distance, self.signed) for rows, row in (concave, steps)), strict=True
        )
        low, high = np.minimum(*lows), np.maximum(*highs)
        low[: values.shape[0]] = np.maximum(low[: values.shape[0]], 0.0)
        return low, high

    def shift(self, creep: Array) -> Array:
        """Return the offset and drift that fit the measured depth best for a given creep response.

        creep : creep response at the time of each measurement
        """
        return np.linalg.lstsq(self.signed, self.depth - self._elastic(creep)[0])[0]

    def residual(self, creep: Array) -> Array:
        """Return the measured depth minus the fitted depth, shape (rows,).

        The fitted depth follows from the given creep response, and from the offset and drift that fit best.
        """
        return self.depth - self._elastic(creep)[0] - self.signed @ self.shift(creep)


class _Spectrum:
    """Medium of springs and dashpots that fits the depth of a growing contact best.

    times : retardation times θ_j
    amounts : coefficients J₀, φ and J_j of the creep compliance (see the module)
    creep : creep response of the medium at the time of each measurement
    """

    def __init__(self, record: _Record, load: Load, place: Integers, lags: Array) -> None:
        times = spread_times(lags[0], lags[-1])
        self._fit(record, load, place, times)
        if (found := self.times[self.amounts[2:] > 0]).size:
            self._fit(record, load, place, finer_times(found, times))

    def _fit(self, record: _Record, load: Load, place: Integers, times: Array) -> None:
        responses = _spectral_responses(load, place, times)
        self.times, (self.amounts, _) = times, record.fit(responses)
        self.creep = responses @ self.amounts

    def compliance(self, time: Array) -> Array:
        """Return the creep compliance J of the medium at given times."""
        delayed = -np.expm1(-np.divide.outer(time, self.times)) @ self.amounts[2:]
        return self.amounts[0] + self.amounts[1] * time + delayed

    def prony(self, force: float) -> Prony:
        """Return the medium as a Prony series. Raises ValueError if J₀ is 0, or if φ and all J_j are 0.

        force : largest force F of the record; J₀ counts as 0 if J₀ F is a negligible share of the largest creep
            response
        """
        instantaneous, fluidity, strengths = self.amounts[0], self.amounts[1], self.amounts[2:]
        if instantaneous * force <= ROUNDING * self.creep.max() or not (fluidity or strengths.any()):
            raise no_prony_series()
        return prony_series(instantaneous, fluidity, strengths, self.times)


def prony_series(instantaneous: float, fluidity: float, strengths: Array, times: Array) -> Prony:
    """Return the Prony series with the compliance J = J₀ + φ t + Σ J_j (1 − exp(−ρ_j t)), ρ_j = 1/θ_j.

    instantaneous, fluidity : J₀ > 0 and φ ≥ 0
    strengths, times : J_j ≥ 0 and θ_j, shape (elements,)

    The conversion is exact. Let D = diag(0, ρ_j), and let b be the vector whose squared entries are φ and J_j ρ_j. The
    relaxation rates are the eigenvalues λ of D + b bᵀ/J₀. With the eigenvectors q of norm 1, the moduli are
    (b·q)²/(λ J₀²).
    """
    kept = strengths > 0
    strengths, rates = strengths[kept], 1 / times[kept]
    squares = strengths * rates
    if fluidity:
        squares, rates = np.append(fluidity, squares), np.append(0.0, rates)
    b = np.sqrt(squares)
    values, vectors = np.linalg.eigh(np.diag(rates) + np.outer(b, b) / instantaneous)
    moduli = (b @ vectors) ** 2 / (values * instantaneous**2)
    relaxed = 0.0 if fluidity else 1 / (instantaneous + strengths.sum())
    return Prony(relaxed, tuple(moduli.tolist()), tuple((1 / values).tolist()))


def _springpot(record: _Record, load: Load, place: Integers) -> Springpot:
    """Return the springpot that fits the depth of a record best."""
    from scipy.optimize import minimize_scalar  # this import takes long

    def response(exponent: float) -> Array:
        # Creep response of J = t^exponent at the time of each measurement.
        return creep_response(Springpot(1 / gamma(1 + exponent), exponent).spectrum(load)[0], load)[place, None]

    def squares(exponent: float) -> float:
        column = response(exponent)
        return float((record.residual(column @ record.fit(column)[0]) ** 2).sum())

    exponent = float(minimize_scalar(squares, bounds=(0.001, 0.999), method="bounded", options={"xatol": 1e-7}).x)
    ((amount,), _) = record.fit(response(exponent))
    return Springpot(1 / (amount * gamma(1 + exponent)), exponent)


def elastic_force(curve: LoadingCurve, depth: Array) -> tuple[Array, Array]:
    """Return force F_el/G and stiffness k/G of the loading curve at given depths.

    No depth may lie beyond the end of the curve. Before its first computed point, the curve is taken to be a straight
    line from the origin.
    """
    stiffness = np.full(depth.shape, curve.force[0] / curve.depth[0])
    force = depth * stiffness
    inside = depth >= curve.depth[0]
    target = depth[inside]
    force[inside] = zero_of_increasing(lambda force: curve.at_force(force)[0] - target, *curve.force[[0, -1]])
    stiffness[inside] = curve.at_force(force[inside])[1]
    return force, stiffness
