"""Direct integration of growing viscoelastic contact, exact from contact event to contact event.

While the contact set does not change, its elements move with the indenter: y' = q u' with K q = 1 on the set, and the
internal variables of every element (internal_variables) follow from those of the sum over all elements,

    ΣQ = F/(4πd),    (Σy)' = u' Σq,

a linear differential equation with constant coefficients, whose solution is a matrix exponential. Nothing here uses the
correspondence with the elastic problem, nor retardation times: this module checks both.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm

from viscorough import memory, units
from viscorough.contact.growing_cholesky import append_element, solve_flat_punch
from viscorough.errors import ConvergenceError
from viscorough.indenter import Indenter
from viscorough.types import Array, Progress
from viscorough.viscous.integration.elements import MapElements, elements_of_map
from viscorough.viscous.integration.internal_variables import MediumMotion, branch_factors, load_samples, spectrum_of
from viscorough.viscous.medium import Medium, RelaxationSpectrum

_TENSION = 1e-9  # relative to the largest pressure
_ROUNDING = 1e-12  # of the motion in a step in which nothing moves
_MAX_NEWTON_ITERATIONS = 60


@dataclass(frozen=True, kw_only=True)
class MediumEvents(MediumMotion):
    """Motion of an indenter in a viscoelastic half-space, with all contact events.

    Attributes
    ----------
    event_time, event_depth : array
        Times and depths at which the contact set grew, from the second element on; read-only, shape (events,).
    """

    event_time: np.ndarray
    event_depth: np.ndarray


def march_medium_events(
    indenter: Indenter,
    medium: Medium | float,
    times: ArrayLike,
    *,
    force: ArrayLike | None = None,
    depth: ArrayLike | None = None,
    until_fraction: float = 1.0,
    progress: Progress | None = None,
) -> MediumEvents:
    """Motion of a rigid indenter on a viscoelastic half-space while the contact grows, exact between contact events.

    Parameters
    ----------
    indenter, medium, times, force, depth, progress
        As of march_medium.
    until_fraction : float, optional
        Contact fraction up to which there is room for elements, in (0, 1].

    Returns
    -------
    MediumEvents

    Raises
    ------
    ValueError
        For arguments out of range, and with the time from which on the contact recedes (march_medium goes on there).
    ConvergenceError
        If more elements touch than until_fraction allows or one of them comes under tension.
    MemoryError
        If 8 (until_fraction · elements)² bytes are not available.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 9, rms=0.01, seed=1)
    >>> solid = viscorough.StandardLinearSolid(4.0, 1.0, 0.5)
    >>> motion = viscorough.march_medium_events(disc, solid, [0.0, 1.0], force=[0.001, 0.001])
    >>> bool(motion.depth[0] < motion.depth[1])
    True
    """
    if not 0 < until_fraction <= 1:
        raise ValueError(f"march_medium_events: until_fraction must lie in (0, 1], not {until_fraction!r}")
    relaxation = spectrum_of("march_medium_events", medium, indenter.length_unit)
    area = units.square_metres(indenter.length_unit)
    times, load = load_samples("march_medium_events", times, force, depth, area)
    elements = elements_of_map(indenter, "march_medium_events")
    contact = _GrowingContact(elements, relaxation, int(np.ceil(until_fraction * elements.count)))
    law = _ByForce(relaxation, elements.scale) if depth is None else _ByDepth(relaxation)
    rows = []
    for k in range(times.size):
        start = times[max(k - 1, 0)]  # before the first sample there is no load
        _advance(contact, law, start, times[k] - start, (load[k - 1] if k else 0.0, load[k]))
        force_now = load[k] if depth is None else elements.scale * contact.pressure.sum()
        rows.append((contact.depth, force_now, contact.count))
        if progress:
            progress(len(rows) / times.size)
    depths, forces, counts = np.array(rows).T
    event_time, event_depth = np.array(contact.events).reshape(-1, 2).T
    pressure = contact.pressure
    if depth is None and relaxation.viscosity:  # the dashpot carries a step of the force at the last time
        pressure = pressure + (load[-1] / elements.scale - pressure.sum()) * contact.punch_share
    moved = times, depths, forces * area, counts.astype(int), elements.count, elements.pressure_map(pressure)
    return MediumEvents(*moved, indenter.length_unit, event_time=event_time, event_depth=event_depth)


def _advance(
    contact: "_GrowingContact", law: "_ByForce | _ByDepth", start: float, length: float, loads: tuple[float, float]
) -> None:
    """From one sample to the next, through the contact events in between; a step of the load if the length is 0."""
    law.begin(length, *loads)
    if law.end_motion < law.motion(0.0) - _ROUNDING * abs(law.end_motion):
        raise ValueError(
            f"march_medium_events: from a time between {start:.6g} and {start + length:.6g} on the contact recedes; "
            "allowed: contact that grows (march_medium goes on there)"
        )
    passed = 0.0
    while (event := law.motion(passed) + contact.depth_to_next * law.motion_per_depth(contact)) < law.end_motion:
        share = law.reach(event, passed)
        contact.follow(law, passed, share)
        contact.add_next(start + share * length)
        passed = share
    contact.follow(law, passed, 1.0)


class _ByForce:
    """The motion Y = Σy over all elements under a force that is linear in time, from 0 to 1 in a step."""

    def __init__(self, relaxation: RelaxationSpectrum, scale: float) -> None:
        self._medium, self._scale = relaxation, scale
        self._state: Array = np.zeros(1 + relaxation.moduli.size)  # Y and the sums W_i of the internal variables

    def begin(self, length: float, load: float, end_load: float) -> None:
        viscosity, relaxed, moduli, times = self._medium
        self.length, size = length, self._state.size
        if length == 0:  # all springs respond elastically; with a dashpot in parallel, none does
            spring = 0.0 if viscosity else (end_load - load) / self._scale / self._medium.instantaneous_modulus
            self._matrix, self._start, self._change = None, self._state, np.full(size, spring)
        elif viscosity:
            # η Y' = F − G∞ Y; a second unknown would be F itself, which is linear: F₀ comes from the state.
            slope = (end_load - load) / length
            self._matrix = np.array([[-relaxed / viscosity, 1 / viscosity, 0], [0, 0, slope / self._scale], [0, 0, 0]])
            self._augmented = np.array([self._state[0], (end_load - slope * length) / self._scale, 1.0])
        else:
            # From the derivative of ΣQ: G₀ Y' = F' + Σ G_i W_i/τ_i, and W_i' = Y' − W_i/τ_i.
            force_rate = (end_load - load) / length / self._scale
            self._matrix = np.zeros((size + 1, size + 1))
            self._matrix[:size] = (
                np.concatenate([[0.0], moduli / times, [force_rate]]) / self._medium.instantaneous_modulus
            )
            self._matrix[1:size, 1:size] -= np.diag(1 / times)
            self._augmented = np.append(self._state, 1.0)
        self._state = self.state(1.0)
        self.end_motion = self._state[0]

    def state(self, share: float) -> Array:
        """Y and W_i after a share of the step."""
        if self._matrix is None:
            return self._start + share * self._change
        return (expm(share * self.length * self._matrix) @ self._augmented)[: self._state.size]

    def motion(self, share: float) -> float:
        return self.state(share)[0]

    def motion_per_depth(self, contact: "_GrowingContact") -> float:
        return contact.punch

    def rate(self, share: float) -> float:
        """Y' per share of the step."""
        if self._matrix is None:
            return self._change[0]
        return self.length * (self._matrix @ expm(share * self.length * self._matrix) @ self._augmented)[0]

    def reach(self, motion: float, passed: float) -> float:
        """The share of the step at which Y has grown to `motion`: by Newton's method, kept inside a bracket."""
        low, high, share = passed, 1.0, passed
        for _ in range(_MAX_NEWTON_ITERATIONS):
            missing = motion - self.motion(share)
            low, high = (share, high) if missing > 0 else (low, share)
            rate = self.rate(share)
            proposed = share + missing / rate if rate > 0 else np.inf
            following = proposed if low < proposed < high else 0.5 * (low + high)
            if abs(following - share) <= 1e-15 * max(share, 1e-300):
                return following
            share = following
        return share

    def internal(self, before: Array, punch_share: Array, first: float, last: float) -> tuple[Array, Array, Array]:
        """Internal variables of elements with a share q/Σq of the motion, from one share of the step to another."""
        viscosity, _, _, times = self._medium
        start, end = self.state(first), self.state(last)
        decay = np.exp(-(last - first) * self.length / times)[:, None]
        after = before * decay + punch_share * (end[1:, None] - decay * start[1:, None])
        rate = self.rate(last) / self.length if viscosity and self.length else 0.0
        return punch_share * (end[0] - start[0]), after, punch_share * rate


class _ByDepth:
    """The depth itself as the motion, linear in time, from 0 to 1 in a step."""

    def __init__(self, relaxation: RelaxationSpectrum) -> None:
        self._medium = relaxation

    def begin(self, length: float, load: float, end_load: float) -> None:
        self.length, self._begin, self.end_motion = length, load, end_load
        if self._medium.viscosity and length == 0 and load != end_load:
            raise ValueError(
                "march_medium_events: a step of depth takes an infinite force in this medium; allowed: ramps"
            )

    def motion(self, share: float) -> float:
        return self._begin + share * (self.end_motion - self._begin)

    def motion_per_depth(self, contact: "_GrowingContact") -> float:
        return 1.0

    def reach(self, motion: float, passed: float) -> float:
        return (motion - self._begin) / (self.end_motion - self._begin)

    def internal(self, before: Array, punch_share: Array, first: float, last: float) -> tuple[Array, Array, Array]:
        """As of _ByForce, with q in place of q/Σq."""
        decay, mean = branch_factors((last - first) * self.length / self._medium.times, "second_order")
        change = self.motion(last) - self.motion(first)
        after = before * decay[:, None] + punch_share * (mean * change)[:, None]
        rate = (self.end_motion - self._begin) / self.length if self.length else 0.0
        return punch_share * change, after, punch_share * rate


class _GrowingContact:
    """The contact set, its flat-punch solution q, and the state of its elements."""

    def __init__(self, elements: MapElements, relaxation: RelaxationSpectrum, most: int) -> None:
        memory.require(8 * most**2, f"march_medium_events: the factor for {most} elements in contact")
        self._elements, self._medium, self._most = elements, relaxation, most
        self.gap, self._factor, self._members = elements.initial_gap.copy(), np.empty((most, most)), np.zeros(most, int)
        self._forward, self._tangent = np.zeros(most), np.zeros(most)
        self.motion: Array = np.zeros(elements.count)
        self.pressure: Array = np.zeros(elements.count)
        self._branches: Array = np.zeros((relaxation.moduli.size, elements.count))
        self.depth, self.count, self.punch = 0.0, 0, 0.0
        self.events: list[tuple[float, float]] = []  # times and depths
        self._next = int(np.argmin(self.gap))
        self.add_next(None)

    def add_next(self, time: float | None) -> None:
        """Add the element that touches now; `time` is that of the event, None for the first element."""
        if self.count == self._most:
            raise ConvergenceError(
                f"march_medium_events: more than {self._most} elements touch at time {time:.6g}; "
                "a larger until_fraction is needed"
            )
        elements, count = self._elements, self.count
        places = elements.row, elements.column, self._members
        append_element(self._factor, elements.influence, *places, count, self._next, self._forward)
        self.punch = solve_flat_punch(self._factor, count + 1, self._forward, self._tangent)
        self.count = count + 1
        if time is not None:
            self.events.append((time, self.depth))
        members = self._members[: self.count]
        self._inside, self._load = np.zeros(elements.count, bool), np.zeros(elements.count)
        self._inside[members], self._load[members] = True, self._tangent[: self.count]
        self.gap[self._inside] = 0.0
        self._closing = 1 - elements.deflection(self._load)
        self._find_next()

    @property
    def punch_share(self) -> Array:
        """q over Σq of the contact set, for all elements."""
        return self._load / self.punch

    def _find_next(self) -> None:
        with np.errstate(divide="ignore"):
            depth_step = np.where(self._inside, np.inf, np.maximum(self.gap, 0) / np.maximum(self._closing, 1e-300))
        self._next = int(np.argmin(depth_step))
        self.depth_to_next = depth_step[self._next]

    def follow(self, law: "_ByForce | _ByDepth", first: float, last: float) -> None:
        """Move on with this contact set from one share of the step to another."""
        punch = law.motion_per_depth(self)
        share = self._load / punch
        moved = (law.motion(last) - law.motion(first)) / punch
        motion, self._branches, rate = law.internal(self._branches, share, first, last)
        self.motion = self.motion + motion
        self.depth += moved
        self.gap -= moved * self._closing
        self.gap[self._inside] = 0.0
        viscosity, relaxed, moduli, _ = self._medium
        self.pressure = relaxed * self.motion + (moduli[:, None] * self._branches).sum(axis=0) + viscosity * rate
        self._find_next()
        if self.pressure.min() < -_TENSION * self.pressure.max():
            raise ConvergenceError("march_medium_events: an element comes under tension; the contact would recede")
