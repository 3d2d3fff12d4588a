"""The medium from a measured indentation: creep compliance J(t) from the depth u(t) of a body with a known curve.

By the correspondence (viscous.kinetics) the elastic force at the measured depth is the creep,

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

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import fdtri, gamma, stdtrit

from viscorough import units
from viscorough.arrays import ReadOnlyArrays, increasing, integral
from viscorough.errors import AccuracyWarning
from viscorough.loading_curve import LoadingCurve, check_curve
from viscorough.saved import Saved
from viscorough.summaries import si_unit, span, with_unit
from viscorough.types import Array, Integers
from viscorough.viscous.creep_response import branch_states, by_states, by_sums
from viscorough.viscous.load import Load, force_load
from viscorough.viscous.media import CreepTable, Prony, Springpot
from viscorough.viscous.medium import Medium
from viscorough.viscous.non_negative import extremes, non_negative
from viscorough.viscous.spectra import zero_of_increasing

KINDS = ("table", "prony", "springpot")
_KNOTS = 60  # of J, at most
_EARLIER = 64  # ratio of the first row to the first knot under a ramp of force
# Grid of retardation times: by this factor it begins before and ends after the record. Around the times found it is
# refined once.
_BEYOND, _TIMES_PER_DECADE, _FINER = 3.0, 10, 10
_ITERATIONS = 6  # of Gauss and Newton; the elastic curve bends little over the scatter of the depth
# Standard deviations by which the mean depth of some rows may lie below that of earlier rows: 3 + √(2 ln n) for n
# means, times 1 + 13/(rows - 4), because few rows show their own standard deviation badly. In records of noise alone,
# without creep, about one of ten thousand exceeds them.
_LARGEST_DROP, _LARGER_FOR_FEW_ROWS = 3.0, 13.0
_ROUNDING = 1e-9  # scatter relative to the depth below which a record is exact
_FIRST_LEVEL = 1e-3  # of the largest depth: up to there the curve may be taken for straight
# Degrees of freedom per positive amount. The mean of the sum of squares lies between those for 1 and for 2 (Meyer and
# Woodroofe 2000), and 1.5 keeps the intervals from being too narrow. Fewer degrees of freedom than the second number
# leave the scatter undetermined.
_PER_AMOUNT, _LEAST_FREEDOM = 1.5, 2
_LEVEL = 0.95  # of the intervals
# A misfit is larger than the scatter if the chance of it is below 1 - this; without known scatter, if it is larger than
# this share of the largest depth.
_SIGNIFICANT, _SMALL_MISFIT = 0.999, 1e-3


@dataclass(frozen=True)
class IdentifiedMedium(ReadOnlyArrays, Saved):
    """A medium identified from a record of depth over time, as `identify_medium` returns it.

    Attributes
    ----------
    medium : Medium
        Of the kind that was asked for.
    time : array
        0 and the times where J was determined, shape (times,).
    compliance : array
        J at these times, of the table, also if another kind was fitted.
    low, high : array
        Ends of the interval of J at each time, at the level of 95 %; before the first row `low` is 0. Both are nan if
        the scatter is not known.
    scatter : float
        Standard deviation of the measured depth [length], as given or as found from the record; nan if it is not known.
    misfit : float
        Root mean square of the difference between the measured depth and that in `medium` [length].
    length_unit : str
        Unit of the depth; if it is known, moduli are in Pa and times in s.

    Examples
    --------
    >>> import numpy as np
    >>> import viscorough
    >>> curve = viscorough.indent(viscorough.self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1))
    >>> record = viscorough.kinetics(curve, 5e-6, 1e6, np.geomspace(0.1, 100, 50))
    >>> identified = viscorough.identify_medium(curve, 5e-6, record.time, record.depth, scatter=1e-9)
    >>> print(f"{1e6 * identified.low[-1]:.1f} to {1e6 * identified.high[-1]:.1f}")
    99.9 to 100.1
    """

    medium: Medium
    time: np.ndarray
    compliance: np.ndarray
    low: np.ndarray
    high: np.ndarray
    scatter: float
    misfit: float
    length_unit: str = units.UNKNOWN

    def __str__(self) -> str:
        """Kind of medium, J over time, scatter and misfit."""
        unit = self.length_unit
        return (
            f"{type(self.medium).__name__} identified from a record of depth\n"
            f"time t {span(self.time, si_unit('s', unit))}\n"
            f"compliance J {span(self.medium.creep_compliance(self.time), si_unit('1/Pa', unit))}\n"
            f"{self.quality}"
        )

    @property
    def quality(self) -> str:
        """Scatter and misfit in words, on one line."""
        if np.isnan(self.scatter):
            scatter = "scatter of depth unknown, so that J has no intervals (scatter or --scatter states it)"
        else:
            scatter = f"scatter of depth {with_unit(self.scatter, self.length_unit, 3)}"
        return f"{scatter}, misfit of the medium {with_unit(self.misfit, self.length_unit, 3)} (rms)"


def identify_medium(
    curve: LoadingCurve,
    force: ArrayLike | Load,
    times: ArrayLike,
    depth: ArrayLike,
    *,
    kind: str = "table",
    scatter: float | str | None = None,
) -> IdentifiedMedium:
    """Identify the medium of a half-space from the measured depth of an indenter with the given loading curve.

    Parameters
    ----------
    curve : LoadingCurve
        LoadingCurve of the indenter, to the largest depth of the record.
    force : array_like or Load
        As in `kinetics`: the constant force applied at time 0, samples at `times`, or a Load.
    times, depth : array_like
        The record, shape (rows,); times increase. The scatter of the depth is taken for independent from row to row and
        of one size.
    kind : str, optional
        "table": a CreepTable, the concave J that fits best; "prony" or "springpot": that medium, fitted by least
        squares in depth.
    scatter : float or str, optional
        Standard deviation of the measured depth [length], or a text as "2 nm". State it if it is known from the
        instrument: short or very precise records do not determine it, and without it J has no intervals then.

    Returns
    -------
    IdentifiedMedium
        Medium in Pa and s if the curve's unit of length is known. The interval of J at a time holds all values for
        which the best fit with that value is not significantly worse than the best of all (profile likelihood, 95 %),
        among the concave J and among all that do not decrease. Between two times J is at least the chord of `low`.

    Raises
    ------
    ValueError
        For a record of fewer than five rows, or that leaves the curve, or whose depth recedes by more than its scatter
        explains, for a kind that the record does not determine, and for a scatter that is not above 0.

    Warns
    -----
    AccuracyWarning
        If a Prony series or a springpot misses the record by more than the scatter, or by more than 0.1 % of the
        largest depth if the scatter is not known (rms).

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
    unit = curve.length_unit
    if scatter is not None:
        scatter = units.number(scatter, unit, unit, "scatter")
        if not (np.ndim(scatter) == 0 and 0 < scatter < np.inf):
            raise ValueError(f"scatter: {scatter!r:.60}; allowed: a finite length above 0, or None to find it")
    times, depth = _checked_record(curve, times, depth, scatter or 0.0)
    load, place = force_load(force, times, unit).with_times(times)
    lags = times - load.time[0]
    record = _Record(curve, depth)
    spectrum = _Spectrum(record, load, place, lags[lags > 0])
    freedom = np.inf
    if scatter is None:
        scatter, freedom = _scatter(record, spectrum)
    knots, responses = _knots(load, place, lags)
    time = np.append(0.0, knots)
    values = np.column_stack([np.ones(time.size), np.minimum(time[:, None], knots)])
    bend = spectrum.creep - responses @ _amounts(spectrum.compliance(time), knots)
    coefficients = record.fit(responses, bend)
    compliance = np.maximum.accumulate(values @ coefficients)  # a constant J may decrease by rounding
    if np.isnan(scatter):
        low = high = np.full(time.size, np.nan)
    else:
        distance = scatter * stdtrit(freedom, 0.5 + 0.5 * _LEVEL)
        low, high = record.intervals(coefficients, responses, bend, values, distance)
        # Before the first row that shows J, all that is known is that J does not decrease.
        before = time < (0.0 if lags[0] == 0 < load.values[0] else lags[lags > 0][0])
        low[before], high[before] = 0.0, high[~before][0]
    if kind == "prony":
        medium: Medium = spectrum.prony(load.values[place].max())
    elif kind == "springpot":
        medium = _springpot(record, load, place)
    else:
        medium = CreepTable(time, compliance)
    spectra = medium.retardation
    creep, _ = by_sums(medium, load) if spectra is None else by_states(spectra, load)
    misfit = float(np.sqrt(np.mean(record.residual(creep[place]) ** 2)))
    if kind != "table":
        _check_misfit(misfit, scatter, freedom, depth)
    return IdentifiedMedium(medium, time, compliance, low, high, float(scatter), misfit, unit)


def _scatter(record: "_Record", spectrum: "_Spectrum") -> tuple[float, float]:
    """Return the standard deviation of the depth about the fit of springs and dashpots, and its degrees of freedom.

    Both are nan where the record does not determine them.
    """
    freedom = record.depth.size - _PER_AMOUNT * np.count_nonzero(spectrum.amounts)
    if freedom < _LEAST_FREEDOM:
        return np.nan, np.nan
    scatter = np.sqrt((record.residual(spectrum.creep) ** 2).sum() / freedom)
    return (scatter, freedom) if scatter > _ROUNDING * record.depth.max() else (np.nan, np.nan)


def _check_misfit(misfit: float, scatter: float, freedom: float, depth: Array) -> None:
    """Give an AccuracyWarning for a misfit of the medium that is larger than the scatter explains."""
    largest = _SMALL_MISFIT * depth.max()
    if not np.isnan(scatter):
        largest = scatter * np.sqrt(fdtri(depth.size, min(freedom, 1e9), _SIGNIFICANT))
    if misfit > largest:
        size = f"{misfit:.3g} (rms), {100 * misfit / depth.max():.2g} % of the largest depth"
        text = "the scatter is unknown" if np.isnan(scatter) else f"the scatter is {scatter:.3g}"
        text = f"the medium misses the record by {size}; {text}: fit another kind, such as a table"
        warnings.warn(text, AccuracyWarning, stacklevel=3)


def _knots(load: Load, place: Integers, lags: Array) -> tuple[Array, Array]:
    """Return the knots τ_k of J and the creep responses to 1 and to all min(t, τ_k), shape (rows, 1 + knots)."""
    knots = lags[lags > 0]
    if knots.size > _KNOTS:  # a subset at equal ratios
        spread = np.geomspace(knots[0], knots[-1], _KNOTS)
        knots = knots[np.unique(np.clip(np.searchsorted(knots, spread * (1 - 1e-12)), 0, knots.size - 1))]
    if load.values[0] == 0:  # a ramp shows J before the first row, too
        knots = np.geomspace(knots[0] / _EARLIER, knots[-1], _KNOTS)
    times = load.time[place]
    impulse, earlier = (integral(load.time, load.values, t) for t in (times[:, None], times[:, None] - knots))
    return knots, np.column_stack([load.values[place], impulse - earlier])


def _amounts(compliance: Array, knots: Array) -> Array:
    """Return J₀ and c_k of the J that has these values at time 0 and at the knots, and is straight in between."""
    slopes = np.diff(compliance) / np.diff(knots, prepend=0.0)
    return np.append(compliance[0], slopes - np.append(slopes[1:], 0.0))


def _checked_record(curve: LoadingCurve, times: ArrayLike, depth: ArrayLike, scatter: float) -> tuple[Array, Array]:
    """Return the record as arrays of floats."""
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
    _check_growth(times, depth, scatter)
    return times, depth


def _check_growth(times: Array, depth: Array, scatter: float) -> None:
    """Raise ValueError where the depth recedes by more than scatter and resolution of the record explain.

    scatter : stated scatter of the depth, 0 if none is; the scatter of the second differences counts if it is larger
    """
    steps = np.diff(depth)
    found = 1.4826 * np.median(abs(np.diff(steps))) / np.sqrt(6)
    deviation = max(scatter, found * (1 + _LARGER_FOR_FEW_ROWS / (depth.size - 4)))
    resolution = abs(steps[steps != 0]).min() if 0 < np.count_nonzero(steps) < steps.size else 0.0
    for size in (2**k for k in range(depth.size.bit_length() - 1)):
        count = depth.size // size
        mean = depth[: count * size].reshape(count, size).mean(axis=1)
        drop = np.maximum.accumulate(mean) - mean
        largest = (_LARGEST_DROP + np.sqrt(2 * np.log(count))) * deviation * np.sqrt(2 / size)
        allowed = largest + resolution + _ROUNDING * abs(depth).max()
        if (drop > allowed).any():
            where = int(np.argmax(drop > allowed))
            raise ValueError(
                f"record: at time {times[where * size]:.6g} the depth has receded by {drop[where]:.3g}, more than its "
                f"scatter, {max(scatter, found):.3g}, explains; allowed: depths that grow, under which the contact "
                "does not recede"
            )


class _Record:
    """Least squares in depth: the creep of non-negative amounts of given compliances against the measured depth."""

    def __init__(self, curve: LoadingCurve, depth: Array) -> None:
        self.curve, self.depth = curve, depth
        self.creep, self.stiffness = _elastic_force(curve, depth)  # F/G and k/G at the measured depth

    def fit(self, responses: Array, bend: Array | float = 0.0) -> Array:
        """Return amounts ≥ 0 of compliances with these creep responses, by the Gauss-Newton method.

        responses : shape (rows, amounts)
        bend : creep that is added, shape (rows,)
        """
        creep, stiffness = self.creep, self.stiffness
        scale = abs(responses).max(axis=0)
        scale[scale == 0] = 1.0
        for _ in range(_ITERATIONS):
            amounts = non_negative(responses / scale / stiffness[:, None], (creep - bend) / stiffness) / scale
            last, (elastic_depth, stiffness) = creep, self._elastic(responses @ amounts + bend)
            creep = responses @ amounts + bend + stiffness * (self.depth - elastic_depth)
            if abs(creep - last).max() <= 1e-12 * abs(creep).max():
                break
        return amounts

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

        Each holds the intervals in two families: concave compliances, and all compliances that do not decrease. If J is
        nearly straight, as in a fluid, concave fits lie above it.
        """
        creep = responses @ amounts
        _, stiffness = self._elastic(creep + bend)
        target = creep / stiffness + self.residual(creep + bend)
        concave = responses / stiffness[:, None], values
        steps = (np.column_stack([one[:, :2], np.diff(one[:, 1:], axis=1)]) for one in concave)
        lows, highs = zip(*(extremes(rows, target, row, distance) for rows, row in (concave, steps)), strict=True)
        return np.maximum(np.minimum(*lows), 0.0), np.maximum(*highs)

    def residual(self, creep: Array) -> Array:
        """Return the measured depth less that at the given creep."""
        return self.depth - self._elastic(creep)[0]


class _Spectrum:
    """The medium of springs and dashpots that fits a record best; its amounts are J₀, φ and J_j of the times θ_j."""

    def __init__(self, record: _Record, load: Load, place: Integers, lags: Array) -> None:
        first, last = lags[0] / _BEYOND, lags[-1] * _BEYOND
        times = np.geomspace(first, last, 2 + int(_TIMES_PER_DECADE * np.log10(last / first)))
        step = np.log(times[1] / times[0])
        self._fit(record, load, place, times)
        if (found := self.times[self.amounts[2:] > 0]).size:
            finer = np.arange(-_FINER, _FINER + 1) / _FINER * step
            # Points of neighbouring grids coincide up to rounding.
            times = np.exp(np.unique(np.round(np.add.outer(np.log(found), finer), 9)))
            self._fit(record, load, place, times)

    def _fit(self, record: _Record, load: Load, place: Integers, times: Array) -> None:
        delayed, _ = branch_states(np.diff(load.time), load.values, times)
        responses = np.column_stack([load.values[place], load.integral[place], delayed[place]])
        self.times, self.amounts = times, record.fit(responses)
        self.creep = responses @ self.amounts

    def compliance(self, time: Array) -> Array:
        """Return J at these times."""
        delayed = -np.expm1(-np.divide.outer(time, self.times)) @ self.amounts[2:]
        return self.amounts[0] + self.amounts[1] * time + delayed

    def prony(self, force: float) -> Prony:
        """Return it as a Prony series. Raises ValueError where it has no compliance at once or no creep.

        force : largest force of the record

        J = J₀ + φ t + Σ J_j (1 − exp(−ρ_j t)) belongs to a Prony series, exactly: the rates of relaxation are the
        eigenvalues of D + b bᵀ/J₀ with D = diag(0, ρ_j), b² = (φ, J_j ρ_j), and the moduli (b·q)²/(λ J₀²), q the
        eigenvectors.
        """
        instantaneous, fluidity, strengths = self.amounts[0], self.amounts[1], self.amounts[2:]
        kept = strengths > 0
        if instantaneous * force <= _ROUNDING * self.creep.max() or not (fluidity or kept.any()):
            raise ValueError(
                "kind prony: the record shows no compliance at once, or no creep, which a Prony series needs; allowed: "
                "table or springpot"
            )
        strengths, rates = strengths[kept], 1 / self.times[kept]
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
        return float((record.residual(column @ record.fit(column)) ** 2).sum())

    exponent = float(minimize_scalar(squares, bounds=(0.001, 0.999), method="bounded", options={"xatol": 1e-7}).x)
    (amount,) = record.fit(response(exponent))
    return Springpot(1 / (amount * gamma(1 + exponent)), exponent)


def _elastic_force(curve: LoadingCurve, depth: Array) -> tuple[Array, Array]:
    """Return F_el/G and k/G at depths up to the last level; before the first one the curve is taken for straight."""
    stiffness = np.full(depth.shape, curve.force[0] / curve.depth[0])
    force = depth * stiffness
    inside = depth >= curve.depth[0]
    target = depth[inside]
    force[inside] = zero_of_increasing(lambda force: curve.at_force(force)[0] - target, *curve.force[[0, -1]])
    stiffness[inside] = curve.at_force(force[inside])[1]
    return force, stiffness
