"""Direct integration of viscoelastic contact with internal variables, whether the contact grows or recedes.

With Q = p d/(4π) the surface is at w = K y, where every element follows the law of the medium by itself,

    Q = G∞ y + Σ G_i w_i + η y',    w_i' = y' − w_i/τ_i,

with one internal variable w_i for each of its Maxwell branches. Every step in time solves a contact problem for the
pressures at its end: Q ≥ 0, no overlap, and Q = 0 where there is a gap. Nothing here uses the correspondence with the
elastic problem, which holds only while the contact grows: where the creep of the force would decrease, elements leave
the contact, and the surface behind them recovers.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import cho_factor, cho_solve
from scipy.special import exprel

from viscorough import units
from viscorough.arrays import ReadOnlyArrays, increasing, read_only, samples
from viscorough.errors import ConvergenceError
from viscorough.indenter import Indenter
from viscorough.types import Array, Integers, Progress
from viscorough.viscous.integration.elements import MapElements, elements_of_map
from viscorough.viscous.media import medium_of
from viscorough.viscous.medium import Medium, RelaxationSpectrum

_MAX_ITERATIONS, _ADDED_AT_ONCE = 300, 8
_ROUNDING = 1e-12  # of gaps, relative to the depth


@dataclass(frozen=True)
class MediumMotion(ReadOnlyArrays):
    """Motion of an indenter in a viscoelastic half-space; read-only arrays of shape (times,).

    Attributes
    ----------
    time : array
        Times t.
    depth : array
        u [length].
    force : array
        Force F.
    contact_count : array
        Elements in contact.
    length_unit : str
        Unit of the lengths, as UDUNITS spells it; "1" if it is not known.
    pressure : array or None
        p at the last time, after a step of the force there, on the grid of the heights, nan outside the indenter.
    receding_from : float
        The first time at which an element had left the contact, so that the correspondence with the elastic
        problem holds no more; nan if none has.
    """

    time: np.ndarray
    depth: np.ndarray
    force: np.ndarray
    contact_count: np.ndarray
    length_unit: str = "1"
    pressure: np.ndarray | None = None
    receding_from: float = np.nan


def march_medium(
    indenter: Indenter,
    medium: Medium | float,
    times: ArrayLike,
    *,
    force: ArrayLike | None = None,
    depth: ArrayLike | None = None,
    progress: Progress | None = None,
) -> MediumMotion:
    """Motion of a rigid indenter on a viscoelastic half-space, one contact problem per step in time.

    Branches are integrated exactly for surfaces that move linearly within a step; a parallel dashpot (Newtonian,
    Kelvin-Voigt) exactly for pressures that are constant within it: the method is of second order in the steps. It
    keeps pressures positive where the exact ones are, and needs no short steps to be stable.

    Parameters
    ----------
    indenter : Indenter
        Indenter with a small two-dimensional map: the cost is of third order in the elements in contact.
    medium : Medium or float
        Medium of springs and dashpots (no Springpot, no CreepTable), or the viscosity of a Newtonian one.
    times : array_like
        Ends of the steps, increasing; a time given twice is a step of the load.
    force, depth : array_like, optional
        One of them, a load at these times, of shape (times,), F ≥ 0 and linear in between; before times[0] there is
        none, so that its first value is a step. A force may decrease, and so may a depth: the contact recedes. Forces
        are in N and moduli in Pa if the unit of length is known.
    progress : Progress, optional
        Function that is called at each of the times with the share of them that is done.

    Returns
    -------
    MediumMotion

    Raises
    ------
    ValueError
        For arguments out of range.
    ConvergenceError
        If a contact problem is not solved.
    MemoryError
        If the elements in contact are too many for the memory.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> motion = viscorough.march_medium(disc, 30.0, [0.0, 1.0, 2.0], force=[1.0, 1.0, 1.0])
    >>> bool(motion.depth[1] < motion.depth[2])
    True
    """
    relaxation, area, times, load = checked_input("march_medium", indenter, medium, times, force, depth)
    elements = elements_of_map(indenter, "march_medium")
    by_depth, rows, receding, rate = force is None, [], np.nan, 0.0
    state = _State(elements, relaxation, by_depth=by_depth)
    for k in range(times.size):
        length = times[k] - times[k - 1] if k else 0.0
        rate = (load[k] - load[k - 1]) / length if length else rate
        before = state.members
        if length > 0 or relaxation.viscosity == 0:
            at_end = by_depth or relaxation.viscosity == 0
            value = load[k] if at_end else 0.5 * (load[k - 1] + load[k])
            state.advance(length, value)
            if np.isnan(receding) and not np.isin(before, state.members).all():
                receding = times[k]
        elif by_depth and load[k] != state.depth:
            raise ValueError(
                f"march_medium: depth steps at time {times[k]:g}, which takes an infinite force; allowed: ramps"
            )
        if by_depth or k == times.size - 1:
            pressure = state.pressure_now(rate if by_depth else load[k])
        force_now = elements.units.force * pressure.sum() if by_depth else load[k]
        rows.append((state.depth, force_now, state.members.size))
        if progress:
            progress(len(rows) / times.size)
    depths, forces, counts = np.array(rows).T
    last_pressure = np.full(elements.shape, np.nan)
    last_pressure[elements.row, elements.column] = elements.units.pressure * pressure
    moved = times, depths, forces * area, counts.astype(int), indenter.length_unit
    return MediumMotion(*moved, read_only(last_pressure), float(receding))


def checked_input(
    caller: str, indenter: Indenter, medium: Any, times: Any, force: Any, depth: Any = None
) -> tuple[RelaxationSpectrum, float, Array, Array]:
    """The medium's RelaxationSpectrum, the area in m² that forces are divided by, times and load, of shape (times,).

    The load is a depth, or a force over that area. Raises ValueError that starts with the caller.
    """
    medium, area = medium_of(medium, indenter.length_unit), units.square_metres(indenter.length_unit)
    if medium.relaxation is None:
        raise ValueError(f"{caller}: {type(medium).__name__}; allowed: media of springs and dashpots")
    if (force is None) == (depth is None):
        raise ValueError(f"{caller}: one of force and depth is needed")
    name, load = ("depth", depth) if force is None else ("force", force)
    times = increasing(f"{caller}: times", times, steps=f"the {name}")
    load = samples(f"{caller}: {name}", load, times) / (area if depth is None else 1.0)
    return medium.relaxation, area, times, load


class _State:
    """Motion y, pressures Q and internal variables w of all elements under forces, or depths if `by_depth`.

    With a parallel dashpot Q is that which a step assumes, its mean over the step. The contact problem of a step is
    solved by an active-set method, which releases elements under tension and adds elements that overlap until there are
    neither. `members` is the contact set, the first guess of the next problem.
    """

    def __init__(self, elements: MapElements, relaxation: RelaxationSpectrum, *, by_depth: bool) -> None:
        self._elements, self._relaxation, self._by_depth = elements, relaxation, by_depth
        self.depth = 0.0
        self.motion: Array = np.zeros(elements.count)
        self.pressure: Array = np.zeros(elements.count)
        self._branches: Array = np.zeros((relaxation.moduli.size, elements.count))
        self.members: Integers = np.array([], int)
        self._of_factor = self.members  # the members that the Cholesky factor is of

    def advance(self, length: float, load: float) -> None:
        """One step, at whose end Q = `kept` + c (y − y₀): a contact problem in Q alone."""
        viscosity, relaxed, moduli, times = self._relaxation
        x = length / times
        # Factors of w₀ and of y − y₀ in the internal variables at the end of the step.
        decay, gain = np.exp(-x), exprel(-x)
        # With a dashpot, in the mean pressure: y − y₀ = (Q/G∞ − y₀)(1 − exp(−h G∞/η)) under a constant one, exactly.
        spring = viscosity / (length * exprel(-length * relaxed / viscosity)) if viscosity else relaxed
        stiffness = spring + moduli @ gain
        kept = relaxed * self.motion + (moduli * decay) @ self._branches
        # c times the gap is e + K Q − c u, with e that of a surface which nothing presses from now on.
        free = self._elements.deflection(stiffness * self.motion - kept)
        free += stiffness * self._elements.initial_gap
        wanted = stiffness * load if self._by_depth else load / self._elements.units.force
        self.pressure, depth = self._solve(free, wanted)
        self.depth = load if self._by_depth else depth / stiffness
        change = (self.pressure - kept) / stiffness
        self._branches = decay[:, None] * self._branches + np.outer(gain, change)
        self.motion = self.motion + change

    def pressure_now(self, load: float) -> Array:
        """Q at this time: with a parallel dashpot, K y' = u' on the contact set, and Q = 0 elsewhere.

        load : the force F, or u' if `by_depth`
        """
        viscosity, relaxed, moduli, _ = self._relaxation
        if viscosity == 0:
            return self.pressure
        kept = relaxed * self.motion + moduli @ self._branches
        wanted = viscosity * load if self._by_depth else load / self._elements.units.force
        members = self.members
        if members.size == 0:
            height = self._elements.initial_gap + self._elements.deflection(self.motion)
            members = np.flatnonzero(height == height.min())
        return self._solve_among(members, -self._elements.deflection(kept), wanted)[0]

    def _solve(self, free: Array, wanted: float) -> tuple[Array, float]:
        """Q ≥ 0 of all elements with e + K Q − c u ≥ 0, one of them zero, and c u.

        free : e; wanted : c u if `by_depth`, else ΣQ. Without a force the indenter is placed at first contact.
        """
        members = self.members if self.members.size else np.array([np.argmin(free)])
        for _ in range(_MAX_ITERATIONS):
            pressure, depth, members = self._solve_among(members, free, wanted)
            deflection = self._elements.deflection(pressure)
            gap = free + deflection - depth
            gap[members] = 0
            overlaps = gap < -_ROUNDING * max(abs(depth), deflection.max(initial=0))
            if not overlaps.any():
                self.members = members
                return pressure, depth
            # The deepest first: under a force on too few elements, most others would overlap.
            deepest = np.argsort(gap)[: min(np.count_nonzero(overlaps), members.size + _ADDED_AT_ONCE)]
            members = np.union1d(members, deepest)
        raise ConvergenceError(f"march_medium: no contact set found in {_MAX_ITERATIONS} iterations")

    def _solve_among(self, members: Integers, free: Array, wanted: float) -> tuple[Array, float, Integers]:
        """Q, c u and the contact set where only some elements may touch, those of them under tension released."""
        pressure = np.zeros(free.size)
        if not self._by_depth and wanted <= 0:
            return pressure, free.min(), members[:0]
        while members.size:
            if not np.array_equal(members, self._of_factor):
                self._factor, self._of_factor = cho_factor(self._elements.influence_among(members)), members
            solved = cho_solve(self._factor, np.column_stack([np.ones(members.size), free[members]]))
            punch, rest = solved.T
            depth = wanted if self._by_depth else (wanted + rest.sum()) / punch.sum()
            load = depth * punch - rest
            if not (load < 0).any():
                pressure[members] = load
                return pressure, depth, members
            members = members[load >= 0]
        return pressure, wanted, members
