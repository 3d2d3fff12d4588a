"""Fit of a medium to the measured depth of a contact that only grows, under a known force.

By the correspondence (viscous.kinetics) the elastic force at the depth is the creep,

    F_el(u(t))/G = Φ(t) = ∫₀ᵗ J(t − s) dF(s),

which for a step of force is F J(t), and otherwise a Volterra equation of the first kind for J. Two families of
compliances are fitted to the depth by least squares:

1. Media of springs and dashpots, J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)) with amounts ≥ 0. Their grid of retardation times
   is refined about those found. Few of the amounts are positive, so that the residuals show the scatter of the record.
2. All compliances that do not decrease and are concave, which those of media that relax are. Such a J is a sum
   J₀ + Σ c_k min(t, τ_k) with J₀, c_k ≥ 0, and under the impulse I(t) = ∫F dt min(t, τ) creeps by I(t) − I(t − τ).
   It can pass through every row of a short or precise record, so that its own residuals show nothing. The intervals
   of J are taken in this family, at the scatter found with the first one or given by the user.

Between its knots τ_k the second family is straight. The creep due to the difference between the first family and its
chords is subtracted from the record, so that the chords do not shift the fit.
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

_KNOTS = 60  # of J, at most
_EARLIER = 64  # ratio of the first row to the first knot under a ramp of force
# Largest numbers of iterations of Gauss and Newton: the elastic curve bends little over the scatter of the depth, but
# more over its offset. They end if the depth changes by less than this share of the largest depth.
_ITERATIONS, _ITERATIONS_OF_SHIFT, _CLOSE = 6, 60, 1e-13
_HALVINGS = 12  # of a step that does not make the sum of squares smaller


def fit_growing_depth(
    curve: LoadingCurve, load: Load, place: Integers, depth: Array, kind: str, scatter: float | None, shift: Shift
) -> RecordFit:
    """Fit a medium to the measured depth of a contact that grows.

    load : force over time in consistent units, with samples at the rows of the record
    place : index of the sample of each row
    depth : measured depth, shape (rows,)
    kind : "table", "prony" or "springpot"
    scatter : standard deviation of the depth; None to find it; nan for a fit without intervals
    shift : which errors of the zero of depth are fitted
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
    compliance = np.maximum.accumulate(values @ coefficients)  # a constant J may decrease by rounding
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
    """Return the amounts J₀, φ and J_j of these retardation times, and offset and drift, that fit a growing contact.

    load, place, depth : as in fit_growing_depth; signed : as in _Record
    """
    return _Record(curve, depth, signed).fit(_spectral_responses(load, place, times))


def _spectral_responses(load: Load, place: Integers, times: Array) -> Array:
    """Return the creep responses of J = 1, t and 1 − exp(−t/θ_j), shape (rows, 2 + times)."""
    delayed, _ = branch_states(np.diff(load.time), load.values, times)
    return np.column_stack([load.values[place], load.integral[place], delayed[place]])


def first_lag(load: Load, lags: Array) -> float:
    """Return the time after the start of the load of the first row that shows J."""
    return 0.0 if lags[0] == 0 < load.values[0] else float(lags[lags > 0][0])


def knots_of(load: Load, lags: Array) -> Array:
    """Return the times at which J is given: those of the rows, at most _KNOTS of them."""
    knots = lags[lags > 0]
    if load.values[0] == 0:  # a ramp shows J before the first row, too
        return np.geomspace(knots[0] / _EARLIER, knots[-1], _KNOTS)
    if knots.size > _KNOTS:  # a subset at equal ratios
        spread = np.geomspace(knots[0], knots[-1], _KNOTS)
        knots = knots[np.unique(np.clip(np.searchsorted(knots, spread * (1 - 1e-12)), 0, knots.size - 1))]
    return knots


def _amounts(compliance: Array, knots: Array) -> Array:
    """Return J₀ and c_k of the J that has these values at time 0 and at the knots, and is straight in between."""
    slopes = np.diff(compliance) / np.diff(knots, prepend=0.0)
    return np.append(compliance[0], slopes - np.append(slopes[1:], 0.0))


class _Record:
    """Least squares in depth: the creep of non-negative amounts of given compliances against the measured depth.

    signed : change of the measured depth by a unit of offset and drift, shape (rows, 0 to 2)
    """

    def __init__(self, curve: LoadingCurve, depth: Array, signed: Array) -> None:
        self.curve, self.depth, self.signed = curve, depth, signed
        self.creep, self.stiffness = elastic_force(curve, depth)  # F/G and k/G at the measured depth

    def fit(self, responses: Array, bend: Array | float = 0.0) -> tuple[Array, Array]:
        """Return amounts ≥ 0 of compliances with these creep responses, and offset and drift, by Gauss and Newton.

        responses : shape (rows, amounts)
        bend : creep that is added, shape (rows,)
        """
        # At first the elastic curve is replaced by its tangents at the measured depth, without offset and drift.
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
        """Return depth and k/G at F/G = creep; along the straight line from the origin before the first level."""
        curve = self.curve
        creep = np.minimum(creep, curve.force[-1])
        depth, stiffness = curve.at_force(creep)
        before = creep < curve.force[0]
        line = curve.force[0] / curve.depth[0]
        return np.where(before, creep / line, depth), np.where(before, line, stiffness)

    def intervals(
        self, amounts: Array, responses: Array, bend: Array, values: Array, distance: float
    ) -> tuple[Array, Array]:
        """Return the ends of the intervals of J, rows of `values` @ amounts: there the best fit is worse by distance².

        Intervals of offset and drift follow. Each holds the intervals in two families: concave compliances, and all
        compliances that do not decrease. If J is nearly straight, as in a fluid, concave fits lie above it.
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
        """Return the offset and drift that fit best at the given creep."""
        return np.linalg.lstsq(self.signed, self.depth - self._elastic(creep)[0])[0]

    def residual(self, creep: Array) -> Array:
        """Return the measured depth less the depth at the given creep, with the best offset and drift."""
        return self.depth - self._elastic(creep)[0] - self.signed @ self.shift(creep)


class _Spectrum:
    """The medium of springs and dashpots that fits a record best; its amounts are J₀, φ and J_j of the times θ_j."""

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
        """Return J at these times."""
        delayed = -np.expm1(-np.divide.outer(time, self.times)) @ self.amounts[2:]
        return self.amounts[0] + self.amounts[1] * time + delayed

    def prony(self, force: float) -> Prony:
        """Return it as a Prony series. Raises ValueError where it has no compliance at once or no creep.

        force : largest force of the record
        """
        instantaneous, fluidity, strengths = self.amounts[0], self.amounts[1], self.amounts[2:]
        if instantaneous * force <= ROUNDING * self.creep.max() or not (fluidity or strengths.any()):
            raise no_prony_series()
        return prony_series(instantaneous, fluidity, strengths, self.times)


def prony_series(instantaneous: float, fluidity: float, strengths: Array, times: Array) -> Prony:
    """Return the Prony series with the compliance J = J₀ + φ t + Σ J_j (1 − exp(−ρ_j t)), ρ_j = 1/θ_j.

    instantaneous, fluidity : J₀ > 0 and φ ≥ 0; strengths, times : J_j ≥ 0 and θ_j, shape (elements,)

    It is exact: the rates of relaxation are the eigenvalues of D + b bᵀ/J₀ with D = diag(0, ρ_j), b² = (φ, J_j ρ_j),
    and the moduli (b·q)²/(λ J₀²), q the eigenvectors.
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
    """Return the springpot that fits best."""
    from scipy.optimize import minimize_scalar  # takes long to import

    def response(exponent: float) -> Array:
        return by_sums(Springpot(1 / gamma(1 + exponent), exponent), load)[0][place, None]  # of J = t^a

    def squares(exponent: float) -> float:
        column = response(exponent)
        return float((record.residual(column @ record.fit(column)[0]) ** 2).sum())

    exponent = float(minimize_scalar(squares, bounds=(0.001, 0.999), method="bounded", options={"xatol": 1e-7}).x)
    ((amount,), _) = record.fit(response(exponent))
    return Springpot(1 / (amount * gamma(1 + exponent)), exponent)


def elastic_force(curve: LoadingCurve, depth: Array) -> tuple[Array, Array]:
    """Return F_el/G and k/G at depths up to the last level; before the first one the curve is taken for straight."""
    stiffness = np.full(depth.shape, curve.force[0] / curve.depth[0])
    force = depth * stiffness
    inside = depth >= curve.depth[0]
    target = depth[inside]
    force[inside] = zero_of_increasing(lambda force: curve.at_force(force)[0] - target, *curve.force[[0, -1]])
    stiffness[inside] = curve.at_force(force[inside])[1]
    return force, stiffness
