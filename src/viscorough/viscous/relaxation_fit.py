"""Fit of a medium to the measured force on an indenter whose depth is known.

Independent springs with gaps, which have the same loading curve, replace the contact (viscous.row). Let spring i
have the stiffness k_i and touch at time t_i, and let the first n springs be in contact at time t. In a medium with the
relaxation modulus ψ(t) = G∞ + Σ G_j exp(−t/τ_j) the force is

    F(t) = Σ_{i<n} k_i ∫_{t_i}^t ψ(t − s) du(s).

The relaxation times τ_j are given by a grid. The unknown moduli G∞, G_j ≥ 0 are found by least squares:

- If the contact only grows, n does not depend on the medium, and the force is linear in the moduli.
- Otherwise n and the force follow from the exact motion of the springs (viscous.move), and the Gauss-Newton
  method finds the moduli. The formula with constant n gives the derivatives of the force. This is correct because a
  spring has no force when it is released: the change of n with the moduli changes the force to second order only.
  (Under a prescribed depth, the motion of a spring does not depend on the other springs.)

To evaluate the formula for one branch of modulus 1 and relaxation time τ, let R(t) = ∫ exp(−(t − s)/τ) dF_el(s) and
Z(t) = ∫ exp(−(t − s)/τ) du(s), where F_el is the elastic force at the depth u. With K_n = Σ_{i<n} k_i, and with the
time t_n when the last spring in contact touched,

    Σ_{i<n} k_i ∫_{t_i}^t exp(−(t − s)/τ) du = exp(−(t − t_n)/τ) R(t_n) + K_n (Z(t) − exp(−(t − t_n)/τ) Z(t_n)).

A dashpot parallel to the medium is fitted as a branch that relaxes long before the first measurement. A row of the
record is one measurement, a time with a force.
"""

from typing import NamedTuple

import numpy as np

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.types import Array, Integers
from viscorough.media.creep_response import branch_forces
from viscorough.media.kinds import Prony, Springpot
from viscorough.media.load import Load
from viscorough.media.spectra import RelaxationSpectrum, retardation_spectrum, spectrum_of
from viscorough.media.table import FreeForm, free_form_of_creep
from viscorough.results.loading_curve import LoadingCurve
from viscorough.viscous.kinetics import kinetics
from viscorough.viscous.move import move_row
from viscorough.viscous.non_negative import extremes, non_negative
from viscorough.viscous.record_fit import (
    RESOLUTION,
    RecordFit,
    Shift,
    damped_step,
    distance_of,
    finer_times,
    scatter_of,
    spread_times,
)
from viscorough.viscous.row import merged, row_of_springs

# Largest number of Gauss-Newton iterations. The iterations end earlier if the sum of squares decreases by less than the
# share _STALLED, or if the root mean square of the residuals is below the share _EXACT of the largest force.
_ITERATIONS, _STALLED, _EXACT = 8, 1e-2, 1e-10
# Largest number of springs that replace the contact, without and with a fit of the offset. With 5000 springs the
# relative error of the force is 1e-5, and the relative error of its derivative with respect to the depth is 1e-3.
_SPRINGS, _FEWER_SPRINGS = 5000, 2000
# Relaxation times of the branches that represent a parallel dashpot, divided by the time of the first measurement.
_DASHPOTS = (1e-4, 1e-3, 1e-2, 1e-1)
# The resulting J and ψ are given at _KNOTS times. The first of them is the time of the first measurement divided by
# _EARLIER.
_KNOTS, _EARLIER = 120, 64
# Step of the drift in difference quotients: the largest change of the depth that it causes, divided by the largest
# depth. This change is larger than the distance between the gaps of neighbouring springs, because the force of a
# dashpot jumps when a spring touches.
_DRIFT_STEP = 2e-3
# The first fits are made at these offsets of the depth, given as shares of the largest depth.
_OFFSETS = np.linspace(-0.1, 0.1, 21)
# After the first fits, new fits are made at _FINER_OFFSETS offsets that just cover the confidence interval of the
# offset. This is repeated, up to _REPLACEMENTS times in all, until at least _RESOLVED of the offsets lie within the
# interval.
_FINER_OFFSETS, _REPLACEMENTS, _RESOLVED = 15, 4, 5
# If the offset is fitted, the refined grid of relaxation times has this number of steps in one step of the first grid.
_FINER = 4
# Number of bisections to find each end of the confidence interval of the offset.
_BISECTIONS = 5
# At most this number of fits, with offsets within the confidence interval of the offset, is used to compute the
# confidence intervals of ψ.
_INSIDE = 12
# Largest number of trial steps in a Gauss-Newton iteration. If a step increases the sum of squares, the next trial step
# has half the length.
_HALVINGS = 8


def fit_force(
    curve: LoadingCurve, load: Load, place: Integers, force: Array, kind: str, scatter: float | None, shift: Shift
) -> RecordFit:
    """Fit a medium to the measured force at a known depth.

    curve : loading curve of the indenter
    load : depth as a function of time, with a sample at the time of each measurement
    place : index of the sample of the load at the time of each measurement (row of the record), shape (rows,)
    force : measured force, in units of modulus × length², shape (rows,)
    kind : kind of medium: "table", "prony" or "springpot"
    scatter : standard deviation of the measured force; None to estimate it from the record; nan for a fit without
        confidence intervals
    shift : whether an offset and a drift of the depth are fitted, too

    Raises ValueError if the record shows no force or no relaxation, and if a fitted offset is too large.
    """
    lags = load.time[place] - load.time[0]
    record = _ForceRecord(curve, load, place, force, shift)
    resolution = RESOLUTION * np.abs(force).max()
    first, last = lags[lags > 0][[0, -1]]
    dashpots, spread = first * np.array(_DASHPOTS), spread_times(first, last)
    times = np.append(dashpots, spread)
    if shift.offset:
        fits = _fits_of_offsets(record, times, scatter, resolution)
        found = spread[min(fits, key=record.squares).amounts[1 + dashpots.size :] > 0]
        if found.size:
            times = np.concatenate([dashpots, _with_finer_times(spread, found)])
            fits = [record.fit(times, fit.offset) for fit in fits]
    else:
        fit = record.fit(times, 0.0)
        if (found := spread[fit.amounts[1 + dashpots.size :] > 0]).size:
            fit = record.fit(np.append(dashpots, finer_times(found, spread)), 0.0)
        fits = [fit]
    fit = min(fits, key=record.squares)
    if not fit.amounts.any():
        raise ValueError("record: no force; allowed: records that show how the force relaxes")
    scatter, freedom = _scatter(record, fit, scatter, resolution)
    time = np.append(0.0, np.geomspace(first / _EARLIER, last, _KNOTS))
    unknowns = _unknowns_of_region(fit) if shift.offset else 1
    intervals = _intervals(record, fits, time, distance_of(np.hypot(scatter, resolution), freedom, unknowns))
    low, high, shift_low, shift_high = intervals
    # Before the first measurement, ψ may be a high pulse: the record shows only its integral over time. So ψ has no
    # upper limit there.
    high[time < first * (1 - 1e-12)] += np.inf
    low[low < resolution / record.elastic_force] = 0.0
    prony, residual = _prony(fit), force - fit.force
    compliance, modulus = prony.creep_compliance(time), prony.relaxation_modulus(time)
    medium: FreeForm | Prony | Springpot = prony
    if kind == "table":
        medium = free_form_of_creep(time, compliance)
    elif kind == "springpot":
        medium, residual = _springpot(record, fit)
    misfit = float(np.sqrt(np.mean(residual**2)))
    fitted = np.append([fit.offset] * shift.offset, fit.drift)
    return RecordFit(
        medium, time, compliance, modulus, low, high, scatter, freedom, misfit, fitted, shift_low, shift_high
    )


def _with_finer_times(times: Array, found: Array) -> Array:
    """Refine a grid of relaxation times around the times `found`, and return the whole refined grid.

    Times far from `found` are kept, because fits at other offsets may need them.

    times : grid whose times have equal ratios
    """
    apart = np.abs(np.log(np.divide.outer(times, found))).min(axis=1) > 1.5 * np.log(times[1] / times[0])
    return np.sort(np.append(times[apart], finer_times(found, times, _FINER)))


def _scatter(record: "_ForceRecord", fit: "_Fit", scatter: float | None, exact: float) -> tuple[float, float]:
    """Return the standard deviation of the measured force, and its number of degrees of freedom.

    scatter : known standard deviation; None to estimate it from the residuals of the fit
    exact : if an estimated standard deviation is not above this value, the record counts as exact
    """
    if scatter is not None:
        return scatter, np.inf
    return scatter_of(record.force - fit.force, fit.amounts, fit.drift.size + record.fits_offset, exact)


def _fits_of_offsets(record: "_ForceRecord", times: Array, scatter: float | None, resolution: float) -> list["_Fit"]:
    """Return fits at increasing offsets, which include the best offset and enclose its confidence interval.

    The force is not linear in the offset. Besides, branches that relax before the first measurements have almost the
    same effect as a small offset, and the noise hides the difference. Therefore a separate fit is made at each of
    several offsets. If the medium has a dashpot, an early measurement determines the offset so accurately that only
    closely spaced offsets show the interval.

    times : grid of relaxation times
    scatter, resolution : standard deviation of the force (None if not known), and error of the computed force
    """
    offsets = _OFFSETS * record.load.values.max()
    fits = [record.fit(times, offset) for offset in offsets]
    best = int(np.argmin([record.squares(fit) for fit in fits]))
    if best in (0, offsets.size - 1):
        raise ValueError(
            f"{argument('fit_offset')}: the zero of the depth is off by {offsets[best]:.3g} or more; allowed: errors "
            f"below {offsets[-1]:.3g}, {100 * _OFFSETS[-1]:g} % of the largest depth; a better zero is needed"
        )
    for _ in range(_REPLACEMENTS):
        inside = _inside(record, fits, scatter, resolution)
        low, high = offsets[max(inside[0] - 1, 0)], offsets[min(inside[-1] + 1, offsets.size - 1)]
        offsets = np.linspace(low, high, _FINER_OFFSETS)
        fits = [record.fit(times, offset) for offset in offsets]
        inside = _inside(record, fits, scatter, resolution)
        if inside.size >= _RESOLVED:
            break
    # Outside the interval the sum of squares may rise so steeply that only bisection finds the ends of the interval.
    for _ in range(_BISECTIONS):
        inside = _inside(record, fits, scatter, resolution)
        first, last = int(inside[0]), int(inside[-1])
        if last + 1 < len(fits):
            fits.insert(last + 1, record.fit(times, 0.5 * (fits[last].offset + fits[last + 1].offset)))
        if first > 0:
            fits.insert(first, record.fit(times, 0.5 * (fits[first - 1].offset + fits[first].offset)))
    inside = _inside(record, fits, scatter, resolution)
    return fits[max(inside[0] - 1, 0) : inside[-1] + 2]


def _inside(record: "_ForceRecord", fits: list["_Fit"], scatter: float | None, resolution: float) -> Integers:
    """Return the indices of the fits whose offsets lie within the confidence interval of the offset.

    fits : fits, each at its own prescribed offset
    scatter, resolution : standard deviation of the force (None if not known), and error of the computed force
    """
    squares = np.array([record.squares(fit) for fit in fits])
    best = int(squares.argmin())
    deviation, freedom = _scatter(record, fits[best], scatter, resolution)
    unknowns = _unknowns_of_region(fits[best])
    distance = np.nan_to_num(distance_of(np.hypot(deviation, resolution), freedom, unknowns))
    return np.flatnonzero(squares <= squares[best] + distance**2)


def _unknowns_of_region(fit: "_Fit") -> int:
    """Return the number of fitted unknowns, the argument `unknowns` of `distance_of` for a fit with an offset.

    The unknowns are the offset, the drift, and the moduli above 0. The drift, and branches that relax before the first
    measurements, have almost the same effect as a part of the offset. The true values of the unknowns may then lie at
    the edge of the range of values that fit the record, and an interval for a single unknown would be too narrow.
    Therefore the intervals follow from a joint confidence region of all unknowns.
    """
    return 1 + fit.drift.size + int(np.count_nonzero(fit.amounts))


def _intervals(
    record: "_ForceRecord", fits: list["_Fit"], time: Array, distance: float
) -> tuple[Array, Array, Array, Array]:
    """Return the ends of the confidence intervals of ψ, and of offset and drift.

    The four arrays are the lower and the upper ends for ψ, and the lower and the upper ends for offset and drift.

    fits : fits at one or more offsets, in increasing order
    time : times of the intervals of ψ, shape (times,)
    distance : an interval contains a value if the sum of squared residuals of the best fit with this value exceeds the
        minimum by at most distance²; nan for no intervals
    """
    fitted = record.fits_offset + fits[0].drift.size
    if np.isnan(distance):
        return *np.full((2, time.size), np.nan), *np.full((2, fitted), np.nan)
    squares = np.array([record.squares(fit) for fit in fits])
    excess = squares - squares.min() - distance**2
    inside = np.flatnonzero(excess <= 0)
    chosen = np.unique(np.append(inside[np.linspace(0, inside.size - 1, _INSIDE).astype(int)], squares.argmin()))
    lows, highs = [], []
    for fit in (fits[k] for k in chosen):
        values = np.column_stack([np.ones(time.size), np.exp(-time[:, None] / fit.times)])
        target = record.force - fit.force + fit.columns @ fit.amounts + fit.signed @ fit.drift
        left = np.sqrt(distance**2 - (record.squares(fit) - squares.min()))
        low, high = extremes(fit.columns, target, values, left, fit.signed)
        # Include the values of the fit itself. At an end of the interval of the offset, the interval contains no other
        # values.
        lows.append(np.minimum(low, np.append(values @ fit.amounts, fit.drift)))
        highs.append(np.maximum(high, np.append(values @ fit.amounts, fit.drift)))
    low, high = np.min(lows, axis=0), np.max(highs, axis=0)
    ends_low, ends_high = low[time.size :], high[time.size :]
    if record.fits_offset:
        offsets = np.array([fit.offset for fit in fits])
        ends = [_crossing(offsets[:: -1 if first else 1], excess[:: -1 if first else 1]) for first in (True, False)]
        ends_low, ends_high = np.append(ends[0], ends_low), np.append(ends[1], ends_high)
    return low[: time.size], high[: time.size], ends_low, ends_high


def _crossing(offsets: Array, excess: Array) -> float:
    """Return the end of the confidence interval of the offset: after it, the excess is positive.

    The excess is interpolated linearly between two offsets.

    offsets : increasing for the upper end of the interval, decreasing for the lower end
    excess : sum of squared residuals at each offset, minus the largest sum that the confidence interval allows
    """
    k = int(np.flatnonzero(excess <= 0)[-1])
    if k == offsets.size - 1:
        return float(offsets[k])
    return float(offsets[k] + (offsets[k + 1] - offsets[k]) * excess[k] / (excess[k] - excess[k + 1]))


class _Path(NamedTuple):
    """Depth as a function of time, with a sample at the first touch of every spring.

    time, depth : times, and depths at these times, shape (samples,)
    touches : index of the sample at which each spring first touches, shape (springs that ever touch,)
    place : index of the sample at the time of each measurement (row of the record), shape (rows,)
    """

    time: Array
    depth: Array
    touches: Integers
    place: Integers


class _Fit(NamedTuple):
    """Result of a fit: the unknowns, the force that follows from them, and the derivatives of this force.

    times : grid of relaxation times τ_j, shape (branches,)
    amounts : moduli G∞ and G_j, shape (1 + branches,)
    offset : offset of the depth, which is prescribed
    drift : drift of the depth, shape (1,); or shape (0,) if the drift is not fitted
    force : force at the time of each row of the record, shape (rows,)
    columns : derivatives of the force with respect to the moduli G∞ and G_j, shape (rows, 1 + branches)
    signed : derivative of the force with respect to the drift, shape (rows, 1); or (rows, 0) if the drift is not fitted
    """

    times: Array
    amounts: Array
    offset: float
    drift: Array
    force: Array
    columns: Array
    signed: Array


class _ForceRecord:
    """Record of a measured force, with the least-squares fit of the moduli G∞ and G_j to this force."""

    def __init__(self, curve: LoadingCurve, load: Load, place: Integers, force: Array, shift: Shift) -> None:
        self.curve, self.load, self.place, self.force = curve, load, place, force
        self.fits_offset = shift.offset
        self.drifts = Shift(offset=False, drift=shift.drift).columns(load.time - load.time[0])
        row = row_of_springs(curve)
        self.gap, spring = merged(
            row.gap, row.stiffness, load.values.max(), _FEWER_SPRINGS if shift.offset else _SPRINGS
        )
        # Sums over the first n springs, n = 0, 1, …: of stiffness, and of stiffness × gap.
        self.stiffness = np.append(0.0, np.cumsum(spring))
        self.moment = np.append(0.0, np.cumsum(spring * self.gap))
        self.elastic_force = load.values.max() * self.stiffness[-1] - self.moment[-1]
        self.grows = bool((np.diff(load.values) >= 0).all())

    def fit(self, times: Array, offset: float) -> _Fit:
        """Fit the moduli of a spring and parallel Maxwell branches at a given offset of the depth.

        The drift of the depth is fitted, too, if the user wants it.

        times : relaxation times of the branches
        """
        drift = np.zeros(self.drifts.shape[1])
        path = self._path(offset, drift)
        # First guess: as in an elastic body, the springs with gaps below the depth are in contact.
        columns = self._columns(path, times, np.searchsorted(self.gap, path.depth[path.place]))
        amounts, _ = non_negative(columns, self.force)
        if self.grows and not drift.size:
            return _Fit(times, amounts, offset, drift, columns @ amounts, columns, np.empty((self.force.size, 0)))
        fit = self._linearised(times, amounts, offset, drift)
        count = amounts.size

        def evaluate(unknowns: Array) -> tuple[float, _Fit]:
            new = self._linearised(times, unknowns[:count], offset, unknowns[count:])
            return self.squares(new), new

        for _ in range(_ITERATIONS):
            target = self.force - fit.force + fit.columns @ fit.amounts + fit.signed @ fit.drift
            aim = np.concatenate(non_negative(fit.columns, target, fit.signed))
            last = np.append(fit.amounts, fit.drift)
            step = damped_step(evaluate, last, aim, self.squares(fit), _HALVINGS)
            if step is None:
                return fit
            stalled = step[1] > (1 - _STALLED) * self.squares(fit)
            *_, fit = step
            if stalled or self.squares(fit) < self.force.size * (_EXACT * np.abs(self.force).max()) ** 2:
                break
        return fit

    def squares(self, fit: _Fit) -> float:
        """Return the sum of the squared residuals of a fit."""
        return float(((self.force - fit.force) ** 2).sum())

    def _linearised(self, times: Array, amounts: Array, offset: float, drift: Array) -> _Fit:
        """Return a _Fit with the force at each row of the record, and its derivatives.

        The derivatives are with respect to the moduli and, if it is fitted, to the drift.

        amounts : moduli G∞ and G_j
        """
        path, force, in_contact = self._force(times, amounts, offset, drift)
        columns = self._columns(path, times, in_contact)
        signed = np.empty((force.size, drift.size))
        if drift.size:
            step = _DRIFT_STEP * self.load.values.max() / self.drifts.max()
            above, below = (self._force(times, amounts, offset, drift + sign * step)[1] for sign in (1, -1))
            signed[:, 0] = (above - below) / (2 * step)
        return _Fit(times, amounts, offset, drift, force, columns, signed)

    def _force(self, times: Array, amounts: Array, offset: float, drift: Array) -> tuple[_Path, Array, Integers]:
        """Return the depth as a function of time, and force and number of springs in contact at each measurement.

        times : relaxation times τ_j of the branches
        amounts : moduli G∞ and G_j
        """
        path = self._path(offset, drift)
        branches = amounts[1:] > 0
        if self.grows or not branches.any():
            in_contact = np.searchsorted(self.gap, path.depth[path.place])
            columns = self._columns(path, times[branches], in_contact)
            return path, columns @ np.append(amounts[0], amounts[1:][branches]), in_contact
        spectrum = RelaxationSpectrum(0.0, float(amounts[0]), amounts[1:][branches], times[branches])
        law = spectrum_of(spectrum, retardation_spectrum(spectrum))
        springs, depth = (self.gap, np.diff(self.stiffness)), self.load.values - offset - self.drifts @ drift
        moved = move_row(*springs, np.inf, law, self.load.time, depth, by_depth=True)
        return path, moved.force[self.place], moved.in_contact[self.place]

    def _path(self, offset: float, drift: Array) -> _Path:
        """Return the depth, minus offset and drift, as a function of time, with samples where springs first touch."""
        depth = self.load.values - offset - self.drifts @ drift
        # Add a sample out of contact before the first sample. So a load that starts at a depth starts with a step.
        time, depth = np.append(self.load.time[0], self.load.time), np.append(min(depth[0], 0.0), depth)
        gap = self.gap
        after = np.searchsorted(np.maximum.accumulate(depth), gap, side="right")
        touching = np.arange(np.searchsorted(after, depth.size))
        after = after[touching]
        share = (gap[touching] - depth[after - 1]) / (depth[after] - depth[after - 1])
        touched = time[after - 1] + share * (time[after] - time[after - 1])
        place = self.place + 1
        return _Path(
            np.insert(time, after, touched),
            np.insert(depth, after, gap[touching]),
            after + touching,
            place + np.searchsorted(after, place, side="right"),
        )

    def _columns(self, path: _Path, times: Array, in_contact: Integers) -> Array:
        """Return the forces in media that consist of one spring, or of one branch, of modulus 1.

        The shape is (rows, 1 + times), with a row for each measurement. The first column is for the spring, and each
        further column is for a branch with one of the relaxation times.

        in_contact : number of springs in contact at each measurement
        """
        in_contact = np.minimum(in_contact, path.touches.size)
        stiffness = self.stiffness[in_contact]
        spring = stiffness * path.depth[path.place] - self.moment[in_contact]
        count = np.searchsorted(self.gap, path.depth)
        elastic = self.stiffness[count] * path.depth - self.moment[count]
        to_force, to_depth = branch_forces(np.diff(path.time), np.array([elastic, path.depth]), times)
        touch = path.touches[np.maximum(in_contact, 1) - 1]
        # Time since the last spring in contact touched. For measurements without contact it may be negative; the forces
        # for these measurements are set to 0 below.
        since = np.maximum(path.time[path.place] - path.time[touch], 0.0)
        kept = np.exp(-since[:, None] / times)
        memory = to_depth[path.place] - kept * to_depth[touch]
        columns = kept * to_force[touch] + stiffness[:, None] * memory
        columns = np.column_stack([spring, columns])
        columns[in_contact == 0] = 0.0
        return columns


def _prony(fit: _Fit) -> Prony:
    """Return the medium of a fit as a Prony series. Raises ValueError if all branches have the modulus 0."""
    branches = fit.amounts[1:] > 0
    moduli, times = fit.amounts[1:][branches], fit.times[branches]
    if not branches.any():
        raise ValueError(
            "record: the force does not relax, as in an elastic body of the modulus "
            f"{fit.amounts[0]:.6g}; allowed: records of media that relax"
        )
    return Prony(float(fit.amounts[0]), tuple(moduli.tolist()), tuple(times.tolist()))


def _springpot(record: _ForceRecord, fit: _Fit) -> tuple[Springpot, Array]:
    """Return the springpot that fits the force best, and the residuals of the force.

    Offset and drift are taken from `fit`, a fit of springs and dashpots. Only the exponent is searched for: the force
    at a prescribed depth is proportional to the modulus, so the best modulus for an exponent is known.
    """
    from scipy.optimize import minimize_scalar  # this import takes long

    depth = Load(record.load.time, depth=record.load.values - fit.offset - record.drifts @ fit.drift)
    times = record.load.time[record.place]

    def fitted(exponent: float) -> tuple[float, Array]:
        motion = kinetics(record.curve, depth, Springpot(1.0, exponent), times)
        column = motion.force / units.square_metres(record.curve.length_unit)
        modulus = float(column @ record.force / (column @ column))
        return modulus, record.force - modulus * column

    def squares(exponent: float) -> float:
        return float((fitted(exponent)[1] ** 2).sum())

    exponent = float(minimize_scalar(squares, bounds=(0.001, 0.999), method="bounded", options={"xatol": 1e-5}).x)
    modulus, residual = fitted(exponent)
    return Springpot(modulus, exponent), residual
