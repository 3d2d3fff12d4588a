"""The medium from a measured indentation: creep compliance J(t) from the depth u(t) of a body with a known curve.

By the correspondence (viscous.correspondence) the elastic force at the measured depth is the creep,

    F_el(u(t))/G = Φ(t) = ∫₀ᵗ J(t − s) dF(s),

which for a step of force is F J(t), and otherwise a Volterra equation of the first kind for J. It is solved by least
squares in depth over all compliances that a passive medium can have: J does not decrease and is concave, which is a sum
J₀ + Σ c_k min(t, τ_k) with J₀, c_k ≥ 0, and under the impulse I(t) = ∫F dt min(t, τ) creeps by I(t) − I(t − τ).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma, stdtrit

from viscorough import units
from viscorough.arrays import ForceHistory, ReadOnlyArrays, increasing, integral
from viscorough.loading_curve import LoadingCurve, check_curve
from viscorough.saved import Saved
from viscorough.summaries import si_unit, span, with_unit
from viscorough.types import Array, Integers
from viscorough.viscous.correspondence import consistent_force, impulses, resampled
from viscorough.viscous.creep_response import branch_states
from viscorough.viscous.media import CreepTable, Prony, Springpot
from viscorough.viscous.medium import Medium
from viscorough.viscous.relaxation import elastic_force

KINDS = ("table", "prony", "springpot")
_KNOTS = 60  # of J, at most
_EARLIER = 64  # ratio of the first row to the first knot under a ramp of force
_RETARDATION_TIMES_PER_DECADE = 10
_ITERATIONS = 6  # of Gauss and Newton; the elastic curve bends little over the scatter of the depth
_LARGEST_DROP = 5  # standard deviations of the depth that scatter may explain
_ROUNDING = 1e-9  # scatter relative to the depth below which a record is exact
_FIRST_LEVEL = 1e-3  # of the largest depth: up to there the curve may be taken for straight
_FIXED = 1e4  # weight of a prescribed J, in units of the weight of the record
_TRIALS, _CLOSE = 8, 0.02  # for an end of an interval: of its distance from the fit, and its relative accuracy


@dataclass(frozen=True)
class IdentifiedMedium(ReadOnlyArrays, Saved):
    """A medium identified from a record of depth over time, as `identify_medium` returns it.

    Attributes
    ----------
    medium : Medium
        Of the kind that was asked for.
    time : array
        0 and the times at which J was determined, shape (times,).
    compliance : array
        J there, of the table, whichever kind was fitted.
    low, high : array
        Ends of the interval of J at each time at the level of 95 %, from the scatter of the record; before its first
        row from 0 on.
    scatter : float
        Standard deviation of the measured depth about that of the table [length].
    length_unit : str
        Of the depth; if it is known, moduli are in Pa and times in s.

    Examples
    --------
    >>> import numpy as np
    >>> import viscorough
    >>> curve = viscorough.indent(viscorough.self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1))
    >>> record = viscorough.kinetics(curve, 5e-6, 1e6, np.geomspace(0.1, 100, 50))
    >>> identified = viscorough.identify_medium(curve, 5e-6, record.time, record.depth)
    >>> bool((identified.low <= identified.compliance).all())
    True
    """

    medium: Medium
    time: np.ndarray
    compliance: np.ndarray
    low: np.ndarray
    high: np.ndarray
    scatter: float
    length_unit: str = units.UNKNOWN

    def __str__(self) -> str:
        """What it is; J over time."""
        return (
            f"{type(self.medium).__name__} identified from a record of depth\n"
            f"time t {span(self.time, si_unit('s', self.length_unit))}\n"
            f"compliance J {span(self.compliance, si_unit('1/Pa', self.length_unit))}\n"
            f"scatter of depth {with_unit(self.scatter, self.length_unit, 3)}"
        )


def identify_medium(
    curve: LoadingCurve, force: ArrayLike | ForceHistory, times: ArrayLike, depth: ArrayLike, *, kind: str = "table"
) -> IdentifiedMedium:
    """The medium of a half-space from the measured depth of an indenter with the given loading curve.

    Parameters
    ----------
    curve : LoadingCurve
        LoadingCurve of the indenter, to the largest depth of the record.
    force : array_like or ForceHistory
        As of `kinetics`: the constant force applied at time 0, samples at `times`, or a ForceHistory.
    times, depth : array_like
        The record, shape (rows,); times increase. The scatter of the depth is taken for independent from row to row and
        of one size.
    kind : str, optional
        "table": a CreepTable, the concave J that fits best; "prony" or "springpot": that medium, fitted by least
        squares in depth.

    Returns
    -------
    IdentifiedMedium
        , in Pa and s if the curve's unit of length is known. The interval of J at a time holds all values for which the
        best fit with that value is not significantly worse than the best of all (profile likelihood, 95 %), among the
        concave J and among all that do not decrease.

    Raises
    ------
    ValueError
        For a record of fewer than five rows, or that leaves the curve, or whose depth recedes by more than its scatter
        explains, and for a kind that the record does not determine.

    Examples
    --------
    >>> import numpy as np
    >>> from viscorough import identify_medium, indent, kinetics, self_affine_disc
    >>> curve = indent(self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1))
    >>> times = np.geomspace(0.1, 100, 50)
    >>> record = kinetics(curve, 5e-6, 1e6, times)
    >>> identified = identify_medium(curve, 5e-6, record.time, record.depth)
    >>> print(f"{1e6 * identified.medium.creep_compliance(10.0):.3f}")
    10.000
    """
    if kind not in KINDS:
        raise ValueError(f"kind {kind!r}; allowed: {', '.join(KINDS)}")
    check_curve("identify_medium", curve)
    times, depth = _checked_record(curve, times, depth)
    force = consistent_force(force, curve.length_unit)
    if np.ndim(force) == 0:
        if not (0 < force < np.inf and times[0] >= 0):
            raise ValueError(f"force: {force:g} from time 0 on, record from {times[0]:g} on; allowed: both above 0")
        force = impulses([force, force], [0.0, times[-1]])
    history, place = resampled(force, times)
    lags = times - history.times[0]
    knots = lags[lags > 0]
    if knots.size > _KNOTS:  # a subset at equal ratios
        wanted = np.geomspace(knots[0], knots[-1], _KNOTS)
        knots = knots[np.unique(np.clip(np.searchsorted(knots, wanted * (1 - 1e-12)), 0, knots.size - 1))]
    if history.force[0] == 0:  # a ramp shows J before the first row, too
        knots = np.geomspace(knots[0] / _EARLIER, knots[-1], _KNOTS)
    # The creep of J = min(t, τ) is I(t) − I(t − τ), shape (times, knots).
    impulse, earlier = (integral(history.times, history.force, t) for t in (times[:, None], times[:, None] - knots))
    record = _Record(curve, depth, np.column_stack([history.force[place], impulse - earlier]))
    coefficients = record.fit(record.responses)
    freedom = max(depth.size - int(np.count_nonzero(coefficients)), 1)
    scatter = np.sqrt((record.residual(record.responses @ coefficients) ** 2).sum() / freedom)
    time = np.append(0.0, knots)
    values = np.column_stack([np.ones(time.size), np.minimum(time[:, None], knots)])
    compliance = np.maximum.accumulate(values @ coefficients)  # where J is constant, its rounding is not
    if scatter > _ROUNDING * depth.max():
        low, high = record.intervals(coefficients, values, scatter * stdtrit(freedom, 0.975))
        # Before the first row that shows J, all that is known is that J does not decrease.
        before = time < (0.0 if lags[0] == 0 < history.force[0] else lags[lags > 0][0])
        low[before], high[before] = 0.0, high[~before][0]
    else:
        low = high = compliance
    if kind == "prony":
        medium = _prony(record, history, place, lags)
    elif kind == "springpot":
        medium = _springpot(record, knots)
    else:
        medium = CreepTable(time, compliance)
    return IdentifiedMedium(medium, time, compliance, low, high, float(scatter), curve.length_unit)


def _checked_record(curve: LoadingCurve, times: ArrayLike, depth: ArrayLike) -> tuple[Array, Array]:
    """The record as arrays of floats."""
    unit = curve.length_unit
    times = increasing("record, times", units.numbers(times, "s", unit, "record, times"))
    depth = units.numbers(depth, unit, unit, "record, depth")
    if depth.shape != times.shape or depth.size < 5 or not np.isfinite(depth).all():
        raise ValueError(
            f"record: {times.size} times, depths of shape {depth.shape}; allowed: five or more rows of finite numbers"
        )
    if depth.max() > curve.depth[-1]:
        where = int(np.argmax(depth > curve.depth[-1]))
        raise ValueError(
            f"record: depth {depth[where]:.6g} at time {times[where]:.6g} is beyond the curve's last level; allowed: "
            f"up to {curve.depth[-1]:.6g}; indent further, with until_fraction=1 or a level at that depth (depths)"
        )
    undetermined = np.isnan(curve.at_force(curve.force[0] / 2)[0]) and curve.depth[0] > _FIRST_LEVEL * depth.max()
    if undetermined and (before := (depth < curve.depth[0]) & (depth != 0)).any():
        where = int(np.argmax(before))
        raise ValueError(
            f"record: depth {depth[where]:.6g} at time {times[where]:.6g} is before the curve's first level; allowed: "
            f"from {curve.depth[0]:.6g} on; indent from smaller depths, or leave these rows out"
        )
    _check_growth(times, depth)
    return times, depth


def _check_growth(times: Array, depth: Array) -> None:
    """Raise ValueError where the depth recedes by more than scatter and resolution of the record explain."""
    steps = np.diff(depth)
    scatter = 1.4826 * np.median(abs(np.diff(steps))) / np.sqrt(6)
    resolution = abs(steps[steps != 0]).min() if 0 < np.count_nonzero(steps) < steps.size else 0.0
    for size in (2**k for k in range(depth.size.bit_length() - 1)):
        count = depth.size // size
        mean = depth[: count * size].reshape(count, size).mean(axis=1)
        drop = np.maximum.accumulate(mean) - mean
        allowed = _LARGEST_DROP * scatter * np.sqrt(2 / size) + resolution + _ROUNDING * abs(depth).max()
        if (drop > allowed).any():
            where = int(np.argmax(drop > allowed))
            raise ValueError(
                f"record: at time {times[where * size]:.6g} the depth has receded by {drop[where]:.3g}, more than its "
                f"scatter, {scatter:.3g}, explains; allowed: depths that grow, under which the contact does not recede"
            )


class _Record:
    """Least squares in depth: the creep of non-negative amounts of given compliances against the measured depth."""

    def __init__(self, curve: LoadingCurve, depth: Array, responses: Array) -> None:
        self.curve, self.depth, self.responses = curve, depth, responses

    def fit(self, responses: Array) -> Array:
        """Amounts of compliances with these responses, shape (rows, amounts): Gauss-Newton, non-negative."""
        creep, stiffness = elastic_force(self.curve, self.depth)
        scale = abs(responses).max(axis=0)
        scale[scale == 0] = 1.0
        for _ in range(_ITERATIONS):
            amounts = _non_negative(responses / scale / stiffness[:, None], creep / stiffness) / scale
            last, (elastic_depth, stiffness) = creep, self._elastic(responses @ amounts)
            creep = responses @ amounts + stiffness * (self.depth - elastic_depth)
            if abs(creep - last).max() <= 1e-12 * abs(creep).max():
                break
        return amounts

    def _elastic(self, creep: Array) -> tuple[Array, Array]:
        """Depth and k/G at F/G = creep; along the straight line from the origin before the first level."""
        curve = self.curve
        creep = np.minimum(creep, curve.force[-1])
        depth, stiffness = curve.at_force(creep)
        before = creep < curve.force[0]
        line = curve.force[0] / curve.depth[0]
        return np.where(before, creep / line, depth), np.where(before, line, stiffness)

    def intervals(self, amounts: Array, values: Array, distance: float) -> tuple[Array, Array]:
        """Ends of the intervals of J, rows of `values` @ amounts: there the best fit is worse by `distance`².

        They hold the intervals of concave compliances and those of all that do not decrease: of a J that hardly bends,
        as a fluid's, concave ones lie above the truth.
        """
        creep = self.responses @ amounts
        _, stiffness = self._elastic(creep)
        rows = np.vstack([self.responses / stiffness[:, None], values])
        target = creep / stiffness + self.residual(creep)
        steps = np.column_stack([rows[:, 0], rows[:, 1], np.diff(rows[:, 1:], axis=1)])
        low, high = ([_ends(one, target, side * distance) for one in (rows, steps)] for side in (-1, 1))
        return np.minimum(*low), np.maximum(*high)

    def residual(self, creep: Array) -> Array:
        return self.depth - self._elastic(creep)[0]


def _ends(rows: Array, target: Array, distance: float) -> Array:
    """Values at which the best non-negative fit is worse than the best of all by distance².

    rows : responses, of as many rows as the target, and the values wanted; their columns are of amounts x ≥ 0
    distance : negative for the values below those of the best fit

    A prescribed value is one more equation, of a large weight.
    """
    scale = np.linalg.norm(rows[: target.size], axis=0)
    rows = rows / np.where(scale > 0, scale, 1.0)
    reduced: Any = np.linalg.qr(np.column_stack([rows[: target.size], target]), mode="r")
    matrix, target, wanted = reduced[:, :-1], reduced[:, -1], rows[target.size :]
    start = _non_negative(matrix, target)
    least = float(np.sum((matrix @ start - target) ** 2))
    ends = np.empty(len(wanted))
    for i, row in enumerate(wanted):
        weight, best = _FIXED / np.linalg.norm(row), row @ start
        value = best + distance * np.linalg.norm(np.linalg.lstsq(matrix.T, row, rcond=1e-10)[0])  # without x ≥ 0
        for _ in range(_TRIALS):
            value = max(value, 0.0)
            x = _non_negative(np.vstack([matrix, weight * row]), np.append(target, weight * value))
            excess = np.sqrt(max(float(np.sum((matrix @ x - target) ** 2)) - least, 0.0))
            ratio = abs(distance) / max(excess, 1e-3 * abs(distance))
            if abs(ratio - 1) < _CLOSE or (value == 0 and ratio > 1):
                break
            value = best + (value - best) * min(ratio, 4.0)
        ends[i] = value
    return ends


def _non_negative(matrix: Array, target: Array) -> Array:
    from scipy.optimize import nnls  # takes long to import

    if matrix.shape[0] > matrix.shape[1] + 1:
        reduced: Any = np.linalg.qr(np.column_stack([matrix, target]), mode="r")
        matrix, target = reduced[:, :-1], reduced[:, -1]
    return nnls(matrix, target, maxiter=30 * matrix.shape[1])[0]


def _prony(record: _Record, history: ForceHistory, place: Integers, lags: Array) -> Prony:
    """The Prony series that fits best, with retardation times on a grid: of most of them there is none."""
    first, last = lags[lags > 0][0] / 3, 3 * lags[-1]
    count = 2 + int(_RETARDATION_TIMES_PER_DECADE * np.log10(last / first))
    times = np.geomspace(first, last, count)
    delayed, _ = branch_states(np.diff(history.times), history.force, times)
    responses = np.column_stack([history.force[place], history.impulse[place], delayed[place]])
    amounts = record.fit(responses)
    instantaneous, fluidity, strengths = amounts[0], amounts[1], amounts[2:]
    kept, at_once = strengths > 0, instantaneous * history.force[place].max()
    if at_once <= _ROUNDING * (responses @ amounts).max() or not (fluidity or kept.any()):
        raise ValueError(
            "kind prony: the record shows no compliance at once, or no creep, which a Prony series needs; allowed: "
            "table or springpot"
        )
    # J = J₀ + φ t + Σ J_j (1 − exp(−ρ_j t)) is that of a Prony series, exactly: the rates of relaxation are the
    # eigenvalues of D + b bᵀ/J₀ with D = diag(0, ρ_j), b² = (φ, J_j ρ_j), and the moduli (b·q)²/(λ J₀²), q the
    # eigenvectors.
    strengths, rates = strengths[kept], 1 / times[kept]
    squares = strengths * rates
    if fluidity:
        squares, rates = np.append(fluidity, squares), np.append(0.0, rates)
    b = np.sqrt(squares)
    values, vectors = np.linalg.eigh(np.diag(rates) + np.outer(b, b) / instantaneous)
    moduli = (b @ vectors) ** 2 / (values * instantaneous**2)
    relaxed = 0.0 if fluidity else 1 / (instantaneous + strengths.sum())
    return Prony(relaxed, tuple(moduli.tolist()), tuple((1 / values).tolist()))


def _springpot(record: _Record, knots: Array) -> Springpot:
    """The springpot that fits best; its J is sampled at the knots."""
    from scipy.optimize import minimize_scalar  # takes long to import

    def response(exponent: float) -> Array:
        slopes = np.diff(np.append(0.0, knots**exponent)) / np.diff(knots, prepend=0.0)
        return record.responses[:, 1:] @ (slopes - np.append(slopes[1:], 0.0))

    def squares(exponent: float) -> float:
        column = response(exponent)[:, None]
        return float((record.residual(column @ record.fit(column)) ** 2).sum())

    exponent = float(minimize_scalar(squares, bounds=(0.001, 0.999), method="bounded", options={"xatol": 1e-7}).x)
    (amount,) = record.fit(response(exponent)[:, None])
    return Springpot(1 / (amount * gamma(1 + exponent)), exponent)
