"""Direct integration of viscoelastic contact with internal variables, for contact that grows or recedes.

Let Q = p d/(4π) be the reduced pressure on an element of side d, and K the matrix of influence coefficients. The
deflection of the surface is K y. The motion y of every element follows from its own pressure by the law of the medium,

    Q = G∞ y + Σ_i G_i w_i + η y',    w_i' = y' − w_i/τ_i,

with one internal variable w_i for each Maxwell branch i. Every step in time solves a contact problem for the pressures
at the end of the step: Q ≥ 0, no overlap, and Q = 0 at elements with a gap. This module does not use the correspondence
with the elastic problem, which holds only while the contact grows. So elements may leave the contact, and the surface
then recovers there.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.special import exprel

from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Array, Integers, Mask, Progress
from viscorough.media.kinds import medium_of
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.media.springs_and_dashpots import SpringsAndDashpots
from viscorough.results.motion import Motion
from viscorough.surfaces.indenter import Indenter, check_indenter
from viscorough.viscous.integration.elements import MapElements, elements_of_map

if TYPE_CHECKING:
    from viscorough.media.spectra import RelaxationSpectrum

# Largest number of iterations of the active-set method. In one iteration, a contact set of n elements may grow by up to
# n + _ADDED_AT_ONCE elements.
_MAX_ITERATIONS, _ADDED_AT_ONCE = 300, 8
# Rounding error of gaps, relative to the sum of initial gap, depth, and largest displacement of the surface so far.
_ROUNDING = 1e-12


def integrate_steps(
    indenter: Indenter, medium: Medium | float, load: Load, progress: Progress | None = None
) -> tuple[Motion, Array]:
    """Integrate the contact with one step in time from each sample of the load to the next; see `march`.

    Each step solves one contact problem. A Maxwell branch is integrated exactly if the surface moves linearly within
    the step. A parallel dashpot (Newtonian, Kelvin-Voigt) is integrated exactly if the pressures are constant within
    the step. So the error is of second order in the length of the steps. If the exact pressures are positive, so are
    the computed pressures. The method is stable for steps of any length.

    Returns the Motion, and a map of the pressure p at the last time. The map has the shape of the heights, and is nan
    outside the indenter. If the force steps at the last time, this is the pressure after the step.
    """
    relaxation, times, values = checked_input(indenter, medium, load)
    elements = elements_of_map(indenter, "march")
    rows, receding, rate = [], np.nan, 0.0
    state = _State(elements, relaxation, by_depth=load.by_depth)
    for k in range(times.size):
        length = times[k] - times[k - 1] if k else 0.0
        rate = (values[k] - values[k - 1]) / length if length else rate
        before = state.touching
        if length > 0 or relaxation.viscosity == 0:
            at_end = load.by_depth or relaxation.viscosity == 0
            state.advance(length, values[k] if at_end else 0.5 * (values[k - 1] + values[k]))
        elif load.by_depth and not state.lift_to(values[k]):
            raise ValueError(
                f"march: depth steps into the surface at time {times[k]:g}, which takes an infinite force; allowed: "
                "ramps"
            )
        if np.isnan(receding) and (before & ~state.touching).any():
            receding = times[k]
        if load.by_depth or k == times.size - 1:
            pressure = state.pressure_now(rate if load.by_depth else values[k])
        force_now = elements.units.force * pressure.sum() if load.by_depth else values[k]
        rows.append((state.depth, force_now, np.count_nonzero(state.touching)))
        if progress:
            progress(len(rows) / times.size)
    depths, forces, counts = np.array(rows).T
    last_pressure = np.full(elements.shape, np.nan)
    last_pressure[elements.row, elements.column] = elements.units.pressure * pressure
    moved = times, depths, forces, _mean_velocity(times, depths), counts / elements.count
    return Motion(*moved, indenter.length_unit, float(receding)), last_pressure


def checked_input(indenter: Indenter, medium: Any, load: Load) -> "tuple[RelaxationSpectrum, Array, Array]":
    """Check the arguments of `march`, and return relaxation spectrum, times and values of the load.

    Times and values have the shape (times,); the values are depths or forces.
    """
    check_indenter("march", indenter, 2)
    if not isinstance(load, Load):
        raise TypeError(f"march: load: {type(load).__name__}; a viscorough.Load is needed, before the medium")
    medium = medium_of(medium)
    if not isinstance(medium, SpringsAndDashpots):
        raise ValueError(f"march: {type(medium).__name__}; allowed: media of springs and dashpots")
    return medium.relaxation, load.time, load.values


def _mean_velocity(times: Array, depths: Array) -> Array:
    """Return the mean velocity in the interval after each time, shape (times,).

    At the last time, and at the first of two equal times (a step), return the mean velocity in the interval before
    instead.
    """
    lengths = np.diff(times)
    mean = np.divide(np.diff(depths), lengths, out=np.zeros(lengths.size), where=lengths > 0)
    velocity = np.append(mean, mean[-1:] if lengths.size else 0.0)
    before = np.flatnonzero(lengths == 0)
    velocity[before] = np.where(before > 0, velocity[np.maximum(before, 1) - 1], 0.0)
    return velocity


def check_overflow(values: Array) -> None:
    """Raise ValueError unless all values of a result are finite."""
    if not np.isfinite(values).all():
        raise ValueError(
            "march: depths or forces overflow in this medium; allowed: forces, depths and moduli whose ratios are "
            "ordinary numbers; check their units"
        )


class _State:
    """Present motions y, pressures Q and internal variables w_i of all elements (see the module docstring).

    In a medium with a parallel dashpot, Q is the mean pressure in the last step. The array `touching`, shape
    (elements,), is true for elements in contact. A step that presses on an element brings the element into contact. The
    element leaves the contact when its gap opens.

    by_depth : whether the load is a depth instead of a force
    """

    def __init__(self, elements: MapElements, relaxation: "RelaxationSpectrum", *, by_depth: bool) -> None:
        self._elements, self._relaxation, self._by_depth = elements, relaxation, by_depth
        self.depth = 0.0
        self.motion: Array = np.zeros(elements.count)
        self._largest = 0.0  # largest displacement of the surface so far
        self.pressure: Array = np.zeros(elements.count)
        self._branches: Array = np.zeros((relaxation.moduli.size, elements.count))
        self.touching: Mask = np.zeros(elements.count, bool)
        self._of_factor = np.array([], int)  # elements whose influence matrix has the stored Cholesky factor

    def advance(self, length: float, load: float) -> None:
        """Advance the state by a step in time, and solve a contact problem for the pressures Q.

        At the end of the step, Q = `kept` + c (y − y₀), where y₀ is the motion at the start of the step and c a
        stiffness. With a parallel dashpot, Q is the mean pressure in the step, and a prescribed force is the mean force
        in the step.

        length : length of the step
        load : depth or force at the end of the step
        """
        viscosity, relaxed, moduli, times = self._relaxation
        x = length / times
        # An internal variable at the end of the step is decay × (its value at the start) + gain × (y − y₀).
        decay, gain = np.exp(-x), exprel(-x)
        # With a parallel dashpot and a constant Q in a step of length h, y − y₀ = (Q/G∞ − y₀)(1 − exp(−h G∞/η))
        # exactly.
        spring = viscosity / (length * exprel(-length * relaxed / viscosity)) if viscosity else relaxed
        stiffness = spring + moduli @ gain
        kept = relaxed * self.motion + (moduli * decay) @ self._branches
        # At the end of the step, c × gap = e + K Q − c u, where e = K (c y₀ − kept) + c × initial gap. `surface` is the
        # first term of e.
        surface = self._elements.deflection(stiffness * self.motion - kept)
        initial_gap = stiffness * self._elements.initial_gap
        target = stiffness * load if self._by_depth else load / self._elements.units.force
        size = stiffness * self._largest + initial_gap
        self.pressure, depth, gap = self._solve(surface + initial_gap, size, target, self.touching)
        self.depth = load if self._by_depth else depth / stiffness
        rounding = _ROUNDING * (size + abs(depth))
        closed = gap <= rounding
        if self._by_depth or target > 0:
            pressed = self._elements.influence[0, 0] * self.pressure > rounding
            self.touching = closed & (self.touching | pressed)
        elif not closed[self.touching].all():
            self.touching = np.zeros_like(closed)
        change = (self.pressure - kept) / stiffness
        self._branches = decay[:, None] * self._branches + np.outer(gain, change)
        self.motion = self.motion + change
        self._largest = max(self._largest, abs(self._elements.deflection(self.motion)).max())

    def lift_to(self, depth: float) -> bool:
        """Step the depth of the indenter while the surface does not move, and return True.

        If the indenter would then overlap the surface, change nothing, and return False.
        """
        surface = self._elements.deflection(self.motion)
        gap = surface + self._elements.initial_gap - depth
        rounding = _ROUNDING * (self._largest + self._elements.initial_gap + depth)
        if depth > self.depth and (gap < -rounding).any():
            return False
        if depth != self.depth:
            self.touching = self.touching & (gap <= rounding)
        self.depth = depth
        return True

    def pressure_now(self, load: float) -> Array:
        """Return the pressures Q at the present time.

        load : the force F, or the velocity u' if the load is a depth

        In a medium with a parallel dashpot, Q follows from a contact problem for the rates of the elements in contact:
        Q ≥ 0, K y' − u' ≥ 0, and Q (K y' − u') = 0 at every element. Elements out of contact have Q = 0.
        """
        viscosity, relaxed, moduli, _ = self._relaxation
        if viscosity == 0:
            return self.pressure
        touching = self.touching
        if not (self._by_depth or touching.any()):
            height = self._elements.deflection(self.motion) + self._elements.initial_gap
            touching = height - height.min() <= _ROUNDING * (self._largest + self._elements.initial_gap)
        if not touching.any():
            return np.zeros_like(self.motion)
        kept = relaxed * self.motion + moduli @ self._branches
        target = viscosity * load if self._by_depth else load / self._elements.units.force
        recovery = -self._elements.deflection(kept)
        # An infinite rounding error excludes elements with an open gap from the contact.
        size = np.where(touching, abs(recovery).max(), np.inf)
        return self._solve(recovery, size, target, touching)[0]

    def _solve(self, free: Array, size: Array, target: float, start: Mask) -> tuple[Array, float, Array]:
        """Solve the contact problem Q ≥ 0, e + K Q − c u ≥ 0, and Q (e + K Q − c u) = 0 at every element.

        Return Q, the scaled depth c u, and the scaled gap e + K Q − c u; `advance` explains the stiffness c. Without a
        force the indenter is placed at first contact. The active-set method releases elements under tension and adds
        elements that overlap the indenter, until there are no such elements.

        free : e, the scaled gap without pressures and at depth 0
        size : size of the terms of e, which determines the rounding error of the gap
        target : c u if the load is a depth, ΣQ if the load is a force
        start : first guess of the contact set
        """
        check_overflow(np.append(free, target))
        members = np.flatnonzero(start) if start.any() else np.array([np.argmin(free)])
        for _ in range(_MAX_ITERATIONS):
            pressure, depth, members = self._solve_among(members, free, target)
            gap = free + self._elements.deflection(pressure) - depth
            gap[members] = 0
            overlaps = gap < -_ROUNDING * (size + abs(depth))
            if not overlaps.any():
                return pressure, depth, gap
            # Add only the elements with the deepest overlap. While too few elements carry a force, most other elements
            # overlap, although many of them will not be in contact.
            deepest = np.argsort(np.where(overlaps, gap, np.inf))
            members = np.union1d(members, deepest[: min(np.count_nonzero(overlaps), members.size + _ADDED_AT_ONCE)])
        raise ConvergenceError(f"march: no contact set found in {_MAX_ITERATIONS} iterations")

    def _solve_among(self, members: Integers, free: Array, target: float) -> tuple[Array, float, Integers]:
        """Solve the contact problem of `_solve` among the elements `members`; all other elements stay out of contact.

        Elements under tension are released. Return Q, the scaled depth c u, and the members that remain in contact.
        """
        pressure = np.zeros(free.size)
        if not self._by_depth and target <= 0:
            return pressure, free.min(), members[:0]
        while members.size:
            if not np.array_equal(members, self._of_factor):
                self._factor, self._of_factor = cho_factor(self._elements.influence_among(members)), members
            solved = cho_solve(self._factor, np.column_stack([np.ones(members.size), free[members]]))
            punch, rest = solved.T
            depth = target if self._by_depth else (target + rest.sum()) / punch.sum()
            load = depth * punch - rest
            if not (load < 0).any():
                pressure[members] = load
                return pressure, depth, members
            members = members[load >= 0]
        return pressure, target, members
