"""Fit of a medium to the measured depth of a contact that only grows, under a known force.

While the contact grows, the elastic force at the measured depth is the creep response Φ (viscous.kinetics),

    F_el(u(t))/G = Φ(t) = ∫₀ᵗ J(t − s) dF(s).

For a step of the force this is F J(t). For any other force it is a Volterra equation of the first kind for J. Two
families of creep compliances J are fitted to the depth by least squares:

1. Media of springs and dashpots, J = J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)), with unknown amounts J₀, φ, J_j ≥ 0. The grid
   of retardation times θ_j is refined around the times with J_j > 0. Few of the amounts are positive, so that the
   residuals of this fit show the scatter of the record.
2. All J that are concave and do not decrease, as in every medium that relaxes. Such a J is a sum
   J₀ + Σ c_k min(t, τ_k) with unknown J₀, c_k ≥ 0. The creep response of min(t, τ) is I(t) − I(t − τ), with the impulse
   I(t) = ∫₀ᵗ F dt. This family can pass through every row of a short or precise record, so its residuals do not show
   the scatter. The intervals of J are the intervals within this family. They use the scatter of the fit of the first
   family, or the scatter that the user stated.

J of the second family is straight between the knots τ_k. In the fit, the difference in creep between the fit of the
first family and its chords between the knots is added to the creep of the second family. So the straight lines do not
shift the fit.
"""

import numpy as np
from scipy.special import gamma

from viscorough.basics.arrays import integral
from viscorough.basics.types import Array, Integers
from viscorough.media.creep_response import branch_states, by_states, by_sums
from viscorough.media.kinds import CreepTable, Prony, Springpot
from viscorough.media.load import Load
from viscorough.media.spectra import zero_of_increasing
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

# Largest number of knots, which are the times with a value of J.
_KNOTS = 60
# Ratio of the time of the first row to the first knot if the force starts with a ramp.
_EARLIER = 64
# Largest numbers of Gauss-Newton iterations: without, and with an offset or a drift. Within the scatter of the depth
# the loading curve is almost straight, so that few iterations are needed; within an offset it is not. The iterations
# end if the residuals change by less than the share _CLOSE of the largest depth.
_ITERATIONS, _ITERATIONS_OF_SHIFT, _CLOSE = 6, 60, 1e-13
# Largest number of trials with a halved step if the sum of squares does not decrease.
_HALVINGS = 12


def fit_growing_depth(
    curve: LoadingCurve, load: Load, place: Integers, depth: Array, kind: str, scatter: float | None, shift: Shift
) -> RecordFit:
    """Fit a medium to the measured depth of a contact that grows.

    curve : loading curve of the indenter
    load : force as a function of time in consistent units, with a sample at the time of each row of the record
    place : index of the sample of the load for each row, shape (rows,)
    depth : measured depth, shape (rows,)
    kind : kind of medium: "table", "prony" or "springpot"
    scatter : standard deviation of the depth; None to find it from the record; nan for a fit without intervals
    shift : choice of the errors of the zero of the depth that are fitted
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
        medium: CreepTable | Prony | Springpot = spectrum.prony(load.values[place].max())
    elif kind == "springpot":
        medium = _springpot(record, load, place)
    else:
        medium = CreepTable(time, compliance)
    spectra = medium.retardation
    creep = (by_sums(medium, load) if spectra is None else by_states(spectra, load))[0][place]
    misfit = float(np.sqrt(np.mean(record.residual(creep) ** 2)))
    (low, shift_low), (high, shift_high) = (np.split(ends, [time.size]) for ends in (low, high))
    return RecordFit(
        medium, time, compliance, None, low, high, float(scatter), float(freedom), misfit,
        record.shift(creep), shift_low, shift_high,
    )  # fmt: skip


def spectrum_of_growth(
    curve: LoadingCurve, load: Load, place: Integers, depth: Array, times: Array, signed: Array
) -> tuple[Array, Array]:
    """Return the amounts J₀, φ and J_j, and the offset and drift, that fit the depth of a growing contact best.

    curve, load, place, depth : arguments of fit_growing_depth
    times : retardation times θ_j, shape (elements,)
    signed : change of the measured depth by a unit of offset and of drift, if they are fitted, shape (rows, 0 to 2)
    """
    return _Record(curve, depth, signed).fit(_spectral_responses(load, place, times))


def _spectral_responses(load: Load, place: Integers, times: Array) -> Array:
    """Return the creep responses of J = 1, J = t and J = 1 − exp(−t/θ_j) at the rows, shape (rows, 2 + elements).

    times : retardation times θ_j, shape (elements,)
    """
    delayed, _ = branch_states(np.diff(load.time), load.values, times)
    return np.column_stack([load.values[place], load.integral[place], delayed[place]])


def first_lag(load: Load, lags: Array) -> float:
    """Return the time of the first row that shows J, counted from the start of the load.

    This is the first row after the start, or the row at the start if the force steps there.

    lags : times of the rows after the start of the load
    """
    return 0.0 if lags[0] == 0 < load.values[0] else float(lags[lags > 0][0])


def knots_of(load: Load, lags: Array) -> Array:
    """Return the knots of J, which are times after the start of the load: the times of the rows, at most _KNOTS.

    If the force starts with a ramp, the knots are _KNOTS times at equal ratios, which start before the first row.

    lags : times of the rows after the start of the load
    """
    knots = lags[lags > 0]
    if load.values[0] == 0:  # the response to a ramp depends on J before the first row, too
        return np.geomspace(knots[0] / _EARLIER, knots[-1], _KNOTS)
    if knots.size > _KNOTS:  # choose times of rows at about equal ratios
        spread = np.geomspace(knots[0], knots[-1], _KNOTS)
        knots = knots[np.unique(np.clip(np.searchsorted(knots, spread * (1 - 1e-12)), 0, knots.size - 1))]
    return knots


def _amounts(compliance: Array, knots: Array) -> Array:
    """Return J₀ and c_k of J = J₀ + Σ c_k min(t, τ_k) with given values at time 0 and at the knots τ_k.

    compliance : values of J, shape (1 + knots,)
    """
    slopes = np.diff(compliance) / np.diff(knots, prepend=0.0)
    return np.append(compliance[0], slopes - np.append(slopes[1:], 0.0))


class _Record:
    """A record of a growing contact, and least-squares fits of J, as a sum of given functions of time, to its depth.

    The unknown amounts of these functions in J are non-negative.

    signed : change of the measured depth by a unit of offset and of drift, if they are fitted, shape (rows, 0 to 2)
    """

    def __init__(self, curve: LoadingCurve, depth: Array, signed: Array) -> None:
        self.curve, self.depth, self.signed = curve, depth, signed
        self.creep, self.stiffness = elastic_force(curve, depth)  # F/G and k/G at the measured depth

    def fit(self, responses: Array, bend: Array | float = 0.0) -> tuple[Array, Array]:
        """Return the amounts ≥ 0, and the offset and drift, that fit the depth best, by the Gauss-Newton method.

        responses : creep response at each row to a unit of each amount, shape (rows, amounts)
        bend : known creep that is added to the creep of the amounts, shape (rows,)
        """
        # First guess: the curve is replaced by its tangent at each measured depth, and offset and drift are 0.
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
        """Return depth and stiffness k/G of the curve at the force F/G = creep.

        Before the first level the curve is taken for a straight line from the origin.
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
        """Return the lower and upper ends of the intervals of J, followed by the intervals of offset and drift.

        At the end of an interval, the sum of squared residuals of the best fit exceeds its minimum by distance². An
        interval is the union of the intervals in two families: all concave J, and all J that do not decrease. The
        second family is needed because concave fits of a J that is almost straight, as in a fluid, lie above J.

        amounts, responses, bend : result and arguments of `fit` for concave J
        values : J at the times of the intervals due to a unit of each amount, shape (times, amounts)
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
        """Return the offset and drift that fit the measured depth best if the creep at the rows is given."""
        return np.linalg.lstsq(self.signed, self.depth - self._elastic(creep)[0])[0]

    def residual(self, creep: Array) -> Array:
        """Return the measured depth less the depth that follows from the given creep and the best offset and drift."""
        return self.depth - self._elastic(creep)[0] - self.signed @ self.shift(creep)


class _Spectrum:
    """Medium of springs and dashpots that fits a record of a growing contact best.

    times, amounts : retardation times θ_j, and the amounts J₀, φ and J_j
    creep : creep response of the medium at the rows of the record
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

        force : largest force of the record; a J₀ of a tiny share of the creep at this force counts as 0
        """
        instantaneous, fluidity, strengths = self.amounts[0], self.amounts[1], self.amounts[2:]
        if instantaneous * force <= ROUNDING * self.creep.max() or not (fluidity or strengths.any()):
            raise no_prony_series()
        return prony_series(instantaneous, fluidity, strengths, self.times)


def prony_series(instantaneous: float, fluidity: float, strengths: Array, times: Array) -> Prony:
    """Return the Prony series with the compliance J = J₀ + φ t + Σ J_j (1 − exp(−ρ_j t)), ρ_j = 1/θ_j.

    instantaneous, fluidity : J₀ > 0 and φ ≥ 0; strengths, times : J_j ≥ 0 and θ_j, shape (elements,)

    The conversion is exact. The relaxation rates are the eigenvalues λ of D + b bᵀ/J₀, with D = diag(0, ρ_j) and the
    squares of the entries of b equal to (φ, J_j ρ_j). The moduli are (b·q)²/(λ J₀²), with the eigenvectors q of norm 1.
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
        # Creep response of J = t^exponent at the rows.
        return by_sums(Springpot(1 / gamma(1 + exponent), exponent), load)[0][place, None]

    def squares(exponent: float) -> float:
        column = response(exponent)
        return float((record.residual(column @ record.fit(column)[0]) ** 2).sum())

    exponent = float(minimize_scalar(squares, bounds=(0.001, 0.999), method="bounded", options={"xatol": 1e-7}).x)
    ((amount,), _) = record.fit(response(exponent))
    return Springpot(1 / (amount * gamma(1 + exponent)), exponent)


def elastic_force(curve: LoadingCurve, depth: Array) -> tuple[Array, Array]:
    """Return force F_el/G and stiffness k/G of the curve at depths up to its last level.

    Before the first level the curve is taken for a straight line from the origin.
    """
    stiffness = np.full(depth.shape, curve.force[0] / curve.depth[0])
    force = depth * stiffness
    inside = depth >= curve.depth[0]
    target = depth[inside]
    force[inside] = zero_of_increasing(lambda force: curve.at_force(force)[0] - target, *curve.force[[0, -1]])
    stiffness[inside] = curve.at_force(force[inside])[1]
    return force, stiffness
