"""Measured records, and the values that a medium predicts for them.

A record consists of rows. Each row is a time with a measured depth or force. Every class of this module computes the
values of the rows for a medium of springs and dashpots (`Record`):

- `DepthRecord`: depth of a contact that grows under a known force. The elastic force F_el at the depth equals the creep
  response (viscous.kinetics), F_el/G = ∫₀ᵗ J(t − s) dF(s).
- `RecedingRecord`: depth under a known force that decreases so far that the contact recedes.
- `ForceRecord`: force at a known depth, which may increase and decrease.

The medium is a sum of elements with unknown amounts x ≥ 0 and given times. For a measured depth, the amounts are the
compliances J₀, φ and J_j of J = J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)). For a measured force, they are the moduli G∞ and
G_j of ψ = G∞ + Σ G_j exp(−t/τ_j).

The measured depth may have a wrong zero, which may drift. With an offset a and a drift b, the measured depth is

    u_measured = u + a + b (t − t₀),

where u is the true depth and t₀ the start of the load. a and b may have any sign.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from copy import copy
from typing import NamedTuple, Self

import numpy as np

from viscorough.basics.argument_names import argument
from viscorough.basics.types import Array, Integers
from viscorough.media.creep_response import branch_forces, branch_states
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.media.spectra import (
    RelaxationSpectrum,
    retardation_spectrum,
    spectrum_of,
    zero_of_increasing,
)
from viscorough.media.table import FreeForm
from viscorough.results.loading_curve import LoadingCurve
from viscorough.viscous.fit.linear import non_negative
from viscorough.viscous.move import move_row
from viscorough.viscous.row import merged, row_of_springs

# The grid of retardation or relaxation times begins at the first time of the record divided by _BEYOND, and ends at the
# last time multiplied by _BEYOND. It has about _TIMES_PER_DECADE times per decade.
_BEYOND, _TIMES_PER_DECADE = 3.0, 10
# Depth that counts as small for the first guess of a fit, as a share of the largest depth.
_SMALL_DEPTH = 0.02
# Relative accuracy of the prediction for a growing depth, and of predictions in which springs with gaps replace the
# contact and neighbouring springs are merged.
_ROUNDING, _RESOLUTION = 1e-9, 5e-5
# Largest number of springs that replace the contact: a receding contact, for its depth and for derivatives of the
# depth, and a contact at a known depth, without and with a fit of the offset. With 5000 springs the relative error of
# the force is 1e-5, and the relative error of its derivative with respect to the depth is 1e-3.
_SPRINGS, _SPRINGS_OF_DERIVATIVES = 1000, 250
_SPRINGS_AT_DEPTH, _FEWER_SPRINGS = 5000, 2000
# For a difference quotient, J₀, φ or one J_j is increased so that J at the end of the load grows by this share.
_STEP = 1e-4
# Relaxation times of the branches that represent a parallel dashpot, divided by the time of the first measurement.
_DASHPOTS = (1e-4, 1e-3, 1e-2, 1e-1)
# Step of the drift in difference quotients: the largest change of the depth that it causes, divided by the largest
# depth. This change is larger than the distance between the gaps of neighbouring springs, because the force of a
# dashpot jumps when a spring touches.
_DRIFT_STEP = 2e-3


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


class Tangent(NamedTuple):
    """Predicted values of a record, and their derivatives.

    predicted : predicted values, shape (rows,)
    columns : derivatives with respect to the amounts, shape (rows, amounts)
    signed : derivatives with respect to offset and drift, as far as they are unknowns, shape (rows, 0 to 2)
    """

    predicted: Array
    columns: Array
    signed: Array


class Record(ABC):
    """Measured values of a record, and their prediction for a medium.

    measured : measured depths or forces, shape (rows,)
    lags : times of the measurements, counted from the start of the load, shape (rows,)
    load : prescribed load, with a sample at the time of each measurement
    place : index of the sample of the load at the time of each measurement, shape (rows,)
    signed : derivatives of the measured or prescribed depth with respect to offset and drift, as far as they are
        unknowns; the drift is the last of them
    shift_scales : change of offset and drift, as far as they are unknowns, that moves the depth by its largest value
    drift : whether the drift is an unknown
    profile : whether the offset is fitted by separate fits at several offsets (`at_offset`); otherwise, if it is
        fitted, it is an unknown of any sign
    offset : offset that `at_offset` has subtracted from the depth
    largest : largest depth
    resolution : error of the predicted values. A record whose scatter is not above it counts as exact
    leading : number of amounts without a time: 2 (J₀ and φ) for depths, 1 (G∞) for forces
    """

    measured: Array
    lags: Array
    load: Load
    place: Integers
    signed: Array
    shift_scales: Array
    drift: bool
    profile: bool
    offset: float
    largest: float
    resolution: float
    leading: int

    @property
    def first(self) -> float:
        """Return the time, after the start of the load, of the first measurement after the start."""
        return float(self.lags[self.lags > 0][0])

    def grid(self) -> Array:
        """Return the grid of retardation or relaxation times, with equal ratios."""
        first, last = self.first / _BEYOND, float(self.lags[-1]) * _BEYOND
        return np.geomspace(first, last, 2 + int(_TIMES_PER_DECADE * np.log10(last / first)))

    @abstractmethod
    def __init__(self, curve: LoadingCurve, load: Load, place: Integers, measured: Array, shift: Shift) -> None: ...

    @abstractmethod
    def at_offset(self, offset: float) -> Self:
        """Return the record with an offset subtracted from the depth."""

    def without_drift(self) -> Self:
        """Return the record with a drift of 0, which is no longer an unknown."""
        still = copy(self)
        still.signed, still.shift_scales, still.drift = self.signed[:, :-1], self.shift_scales[:-1], False
        return still

    @abstractmethod
    def start(self, times: Array) -> tuple[Array, Array]:
        """Return first guesses of the amounts, and of offset and drift, for given times of the elements."""

    @abstractmethod
    def predicted(self, times: Array, amounts: Array, shift: Array) -> Array:
        """Return the predicted values of the rows; nan after the contact has grown beyond the loading curve."""

    @abstractmethod
    def tangent(self, times: Array, amounts: Array, shift: Array) -> Tangent:
        """Return the predicted values and their derivatives."""

    @abstractmethod
    def elements_of(self, medium: Medium) -> tuple[Array, Array]:
        """Return times and amounts of the elements of which a medium consists under the load of the record."""


class DepthRecord(Record):
    """Measured depths of a contact that grows under a known force."""

    leading = 2

    def __init__(self, curve: LoadingCurve, load: Load, place: Integers, depth: Array, shift: Shift) -> None:
        self.curve, self.load, self.place, self.measured = curve, load, place, depth
        self.lags = load.time[place] - load.time[0]
        self.signed = shift._replace(offset=False).columns(self.lags)
        self.largest = depth.max()
        self.shift_scales = self.largest / np.abs(self.signed).max(axis=0)
        self.drift, self.profile, self.offset = shift.drift, shift.offset, 0.0
        self.resolution = _ROUNDING * self.largest

    def at_offset(self, offset: float) -> Self:
        moved = copy(self)
        moved.measured, moved.offset = self.measured + self.offset - offset, offset
        return moved

    def start(self, times: Array) -> tuple[Array, Array]:
        # Replace the curve by its tangent at each measured depth, and take the drift as 0. The slope of a tangent at a
        # small depth is very uncertain, and the slope at _SMALL_DEPTH replaces it.
        depth = np.minimum(self.measured, self.curve.depth[-1])
        force, _ = elastic_force(self.curve, depth)
        _, stiffness = elastic_force(self.curve, np.maximum(depth, _SMALL_DEPTH * self.largest))
        amounts, _ = non_negative(self._responses(times) / stiffness[:, None], force / stiffness)
        return amounts, np.zeros(self.shift_scales.size)

    def predicted(self, times: Array, amounts: Array, shift: Array) -> Array:
        return self._elastic(self._responses(times) @ amounts)[0] + self.signed @ shift

    def tangent(self, times: Array, amounts: Array, shift: Array) -> Tangent:
        responses = self._responses(times)
        depth, stiffness = self._elastic(responses @ amounts)
        return Tangent(depth + self.signed @ shift, responses / stiffness[:, None], self.signed)

    def elements_of(self, medium: Medium) -> tuple[Array, Array]:
        return creep_elements(medium, self.load)

    def _responses(self, times: Array) -> Array:
        """Return the creep responses of J = 1, J = t and J = 1 − exp(−t/θ_j), shape (rows, 2 + elements)."""
        delayed, _ = branch_states(np.diff(self.load.time), self.load.values, times)
        return np.column_stack([self.load.values[self.place], self.load.integral[self.place], delayed[self.place]])

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


class RecedingRecord(Record):
    """Measured depths of a contact that recedes, because the known force decreases.

    Independent viscoelastic springs with gaps, which have the same loading curve, replace the contact
    (viscous.row). The depth follows from their exact motion (viscous.move).
    """

    leading = 2

    def __init__(self, curve: LoadingCurve, load: Load, place: Integers, depth: Array, shift: Shift) -> None:
        self.load, self.place, self.measured = load, place, depth
        self.lags = load.time[place] - load.time[0]
        self.signed = shift.columns(self.lags)
        # Fits at many offsets would take too long.
        self.drift, self.profile, self.offset, self.largest = shift.drift, False, 0.0, depth.max()
        self.shift_scales = self.largest / np.abs(self.signed).max(axis=0)
        self.resolution = _RESOLUTION * self.largest
        row = row_of_springs(curve)
        self.springs = merged(row.gap, row.stiffness, curve.depth[-1], _SPRINGS)
        self.fewer_springs = merged(row.gap, row.stiffness, curve.depth[-1], _SPRINGS_OF_DERIVATIVES)
        self.limit, self.duration = row.limit, load.time[-1] - load.time[0]
        falls = np.flatnonzero(np.diff(load.values) < 0)[0]
        grown = place <= falls
        if np.count_nonzero(grown) < 5:
            raise ValueError(
                f"record: {np.count_nonzero(grown)} rows before the force decreases at time {load.time[falls]:g}; "
                "allowed: five or more"
            )
        self.grown = DepthRecord(curve, load, place[grown], depth[grown], Shift(offset=False, drift=False))

    def at_offset(self, offset: float) -> Self:
        moved = copy(self)
        moved.measured, moved.offset = self.measured + self.offset - offset, offset
        moved.grown = self.grown.at_offset(offset)
        return moved

    def start(self, times: Array) -> tuple[Array, Array]:
        amounts, shift = self.grown.start(times)[0], np.zeros(self.shift_scales.size)
        if not amounts.any():
            raise ValueError(
                "record: no depth before the force decreases; allowed: records that show how the medium creeps"
            )
        if np.isnan(self.predicted(times, amounts, shift)).any():
            raise ValueError(
                "record: in the medium that the rows before the decrease of the force show, the contact grows beyond "
                f"the curve's last level; allowed: curves of larger contacts, with {argument('until_fraction', 1)}"
            )
        return amounts, shift

    def predicted(self, times: Array, amounts: Array, shift: Array) -> Array:
        return self._depth(self.springs, times, amounts) + self.signed @ shift

    def tangent(self, times: Array, amounts: Array, shift: Array) -> Tangent:
        ends, columns = self._ends(times), np.empty((self.measured.size, amounts.size))
        before = self._depth(self.fewer_springs, times, amounts)
        for k, step in enumerate(_STEP * (amounts @ ends) / ends):
            changed = amounts.copy()
            changed[k] += step
            columns[:, k] = (self._depth(self.fewer_springs, times, changed) - before) / step
        return Tangent(self.predicted(times, amounts, shift), np.nan_to_num(columns), self.signed)

    def _depth(self, springs: tuple[Array, Array], times: Array, amounts: Array) -> Array:
        """Return the depth at the time of each measurement.

        springs : gaps and stiffnesses of the springs that replace the contact
        """
        medium = FreeForm(float(amounts[0]), float(amounts[1]), amounts[2:], times, self.first)
        spectrum = spectrum_of(medium.relaxation, medium.retardation)
        moved = move_row(*springs, self.limit, spectrum, self.load.time, self.load.values, by_depth=False)
        return moved.depth[self.place]

    def elements_of(self, medium: Medium) -> tuple[Array, Array]:
        return creep_elements(medium, self.load)

    def _ends(self, times: Array) -> Array:
        """Return the derivatives of J at the end of the load with respect to J₀, φ and J_j."""
        return np.append([1.0, self.duration], -np.expm1(-self.duration / times))


class _Path(NamedTuple):
    """Depth as a function of time, with a sample at the first touch of every spring.

    time, depth : times, and depths at these times, shape (samples,)
    touches : index of the sample at which each spring first touches, shape (springs that ever touch,)
    place : index of the sample at the time of each row of the record, shape (rows,)
    """

    time: Array
    depth: Array
    touches: Integers
    place: Integers


class ForceRecord(Record):
    """Measured forces at a known depth, which may increase and decrease.

    Independent viscoelastic springs with gaps, which have the same loading curve, replace the contact
    (viscous.row). Let spring i have the stiffness k_i and touch at time t_i, and let the first n springs be in
    contact at time t. Then the force is

        F(t) = Σ_{i<n} k_i ∫_{t_i}^t ψ(t − s) du(s).

    If the contact only grows, n does not depend on the medium, and the force is linear in the moduli. Otherwise n
    follows from the motion of the springs (viscous.move). The formula with constant n gives the derivatives of
    the force, because a spring has no force when it is released: the change of n with the moduli changes the force to
    second order only.

    To evaluate the formula for one branch of modulus 1 and relaxation time τ, let R(t) = ∫ exp(−(t − s)/τ) dF_el(s) and
    Z(t) = ∫ exp(−(t − s)/τ) du(s), where F_el is the elastic force at the depth u. With K_n = Σ_{i<n} k_i, and with the
    time t_n when the last spring in contact touched,

        Σ_{i<n} k_i ∫_{t_i}^t exp(−(t − s)/τ) du = exp(−(t − t_n)/τ) R(t_n) + K_n (Z(t) − exp(−(t − t_n)/τ) Z(t_n)).

    A dashpot parallel to the medium is fitted as a branch that relaxes long before the first measurement.

    The record may have a fitted drift of the depth. Its offset is prescribed (`at_offset`).
    """

    leading = 1

    def __init__(self, curve: LoadingCurve, load: Load, place: Integers, force: Array, shift: Shift) -> None:
        self.load, self.place, self.measured = load, place, force
        self.lags = load.time[place] - load.time[0]
        self.signed = shift._replace(offset=False).columns(load.time - load.time[0])
        self.shift_scales = load.values.max() / np.abs(self.signed).max(axis=0)
        self.resolution = _RESOLUTION * np.abs(force).max()
        self.drift, self.profile, self.offset, self.largest = shift.drift, shift.offset, 0.0, load.values.max()
        row = row_of_springs(curve)
        most = _FEWER_SPRINGS if shift.offset else _SPRINGS_AT_DEPTH
        self.gap, self.spring = merged(row.gap, row.stiffness, self.largest, most)
        # Sums over the first n springs, n = 0, 1, …: of stiffness, and of stiffness × gap.
        self.stiffness = np.append(0.0, np.cumsum(self.spring))
        self.moment = np.append(0.0, np.cumsum(self.spring * self.gap))
        self.elastic_force = self.largest * self.stiffness[-1] - self.moment[-1]
        self.grows = bool((np.diff(load.values) >= 0).all())

    def at_offset(self, offset: float) -> Self:
        moved = copy(self)
        moved.offset = offset
        moved.load = Load(self.load.time, depth=self.load.values + self.offset - offset)
        return moved

    def grid(self) -> Array:
        return np.append(self.first * np.array(_DASHPOTS), super().grid())

    def start(self, times: Array) -> tuple[Array, Array]:
        # The springs with gaps below the depth are in contact, like the elements of an elastic contact.
        shift = np.zeros(self.shift_scales.size)
        path = self._path(shift)
        columns = self._columns(path, times, np.searchsorted(self.gap, path.depth[path.place]))
        return non_negative(columns, self.measured)[0], shift

    def predicted(self, times: Array, amounts: Array, shift: Array) -> Array:
        path, in_contact = self._contact(times, amounts, shift)
        used = amounts[1:] > 0
        return self._columns(path, times[used], in_contact) @ np.append(amounts[0], amounts[1:][used])

    def tangent(self, times: Array, amounts: Array, shift: Array) -> Tangent:
        path, in_contact = self._contact(times, amounts, shift)
        columns = self._columns(path, times, in_contact)
        signed = np.empty((self.measured.size, shift.size))
        if shift.size:
            step = _DRIFT_STEP * self.shift_scales
            above, below = (self.predicted(times, amounts, shift + sign * step) for sign in (1, -1))
            signed[:, 0] = (above - below) / (2 * step)
        return Tangent(columns @ amounts, columns, signed)

    def elements_of(self, medium: Medium) -> tuple[Array, Array]:
        spectrum, _ = medium.spectrum(self.load)
        return 1 / spectrum.rates, np.append(spectrum.relaxed, spectrum.moduli)

    def _contact(self, times: Array, amounts: Array, shift: Array) -> tuple[_Path, Integers]:
        """Return the depth as a function of time, and the number of springs in contact at each measurement."""
        path, used = self._path(shift), amounts[1:] > 0
        if self.grows or not used.any():
            return path, np.searchsorted(self.gap, path.depth[path.place])
        spectrum = RelaxationSpectrum(0.0, float(amounts[0]), amounts[1:][used], times[used])
        law = spectrum_of(spectrum, retardation_spectrum(spectrum))
        depth = self.load.values - self.signed @ shift
        moved = move_row(self.gap, self.spring, np.inf, law, self.load.time, depth, by_depth=True)
        return path, moved.in_contact[self.place]

    def _path(self, shift: Array) -> _Path:
        """Return the depth, minus the drift, as a function of time, with samples where springs first touch."""
        depth = self.load.values - self.signed @ shift
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
        if not path.touches.size:  # the indenter never touches
            return np.zeros((self.measured.size, 1 + times.size))
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


def creep_elements(medium: Medium, load: Load) -> tuple[Array, Array]:
    """Return retardation times and amounts (J₀, φ and J_j) of the elements of which a medium consists under a load."""
    spectrum, _ = medium.spectrum(load)
    amounts = np.append([spectrum.instantaneous, spectrum.fluidity], spectrum.flows / spectrum.decays)
    return 1 / spectrum.decays, amounts


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
