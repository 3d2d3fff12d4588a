"""Direct integration of the viscous contact problem in time, without the correspondence with the elastic problem.

The surface moves down at the velocity ẇ = (1/4πη) ∫ p/r dA. For square elements of side d, let Q = p d/(4πη), and let K
be the matrix of influence coefficients. Then ẇ = K Q, and the force is given by F/η = 4π d ΣQ.

Between two contact events the contact set does not change, and its elements move with the indenter at the velocity v.
So K Q = v on the set, and hence Q = v q with K q = 1 on the set. The velocity is v = F/(4π d η Σq), and the surface
outside the set moves at v K q. Therefore depth, pressure impulse ∫Q dt and surface are linear in the impulse ∫F dt. The
depth at which the next element touches (the next contact event) follows exactly.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics import memory
from viscorough.basics.arrays import fraction, real_numbers
from viscorough.basics.compilation import njit
from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Array, Integers
from viscorough.contact.halfspace.growing_cholesky import append_element, solve_flat_punch
from viscorough.surfaces.indenter import Indenter
from viscorough.viscous.integration.elements import elements_of_map


@dataclass(frozen=True, eq=False)
class Events:
    """Penetration of an indenter into a viscous half-space, event by event; arrays of shape (events,).

    At a contact event an element touches, and the contact set grows.

    Attributes
    ----------
    impulse : array
        Impulse ∫F dt/η at each event [length²].
    depth : array
        Depth u at each event [length].
    resistance : array
        Ratio F/(ηv) between each event and the next [length].
    contact_count : array
        Number of elements in contact after each event.
    elements : int
        Number of elements of the indenter.
    length_unit : str
        "m" if numbers are in SI units, "1" if they are in consistent units that are not known.
    """

    impulse: np.ndarray
    depth: np.ndarray
    resistance: np.ndarray
    contact_count: np.ndarray
    elements: int
    length_unit: str = "1"

    def depth_at(self, impulse: ArrayLike) -> Array:
        """Return the depth [length] at impulses ∫F dt/η [length²], an array of any shape.

        The depth is linear in the impulse between events, and after the last event.
        """
        impulse = _impulses(impulse)
        i = self.event_at(impulse)
        return self.depth[i] + (impulse - self.impulse[i]) / self.resistance[i]

    def event_at(self, impulse: ArrayLike) -> Integers:
        """Return the index of the last event at or before each impulse ∫F dt/η [length²], an array of any shape."""
        return np.searchsorted(self.impulse, _impulses(impulse), side="right") - 1


def _impulses(values: ArrayLike) -> Array:
    """Return impulses as an array. Raises ValueError unless they are finite and 0 or more."""
    impulses = real_numbers("impulse", values)
    if not (np.isfinite(impulses) & (impulses >= 0)).all():
        raise ValueError("impulse: finite numbers of at least 0 are allowed; some are not")
    return impulses


def newtonian_events(indenter: Indenter, *, until_fraction: float = 1.0) -> Events:
    """Compute the penetration of a rigid indenter into a linearly viscous half-space, exactly from event to event.

    Every contact event adds one element to the contact set, and one row to the Cholesky factor of the influence matrix
    of this set. The deflection of the surface follows from the impulse of the pressures. No gap closes faster than the
    indenter moves, so only elements that can touch next are evaluated.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    until_fraction : float, optional
        Contact fraction at which the computation stops, in (0, 1].

    Returns
    -------
    Events
        Contact events up to `until_fraction`. The computation needs 8 (until_fraction · elements)² bytes of memory. Its
        time grows with the third power of the number of elements in contact.

    Raises
    ------
    ValueError
        For arguments out of range, and for heights so large that depths overflow.
    MemoryError
        If there is not enough memory.
    ConvergenceError
        If an element comes under tension. The contact could then open, which is impossible without adhesion and with
        F ≥ 0.

    Examples
    --------
    >>> import viscorough
    >>> from viscorough.viscous.integration.events import newtonian_events
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> events = newtonian_events(disc, until_fraction=0.1)
    >>> int(events.contact_count[-1])
    20
    """
    elements = elements_of_map(indenter, "march")
    until_fraction = fraction("march: until_fraction", until_fraction)
    order = np.argsort(elements.initial_gap, kind="stable")
    row, column, gap = (values[order] for values in (elements.row, elements.column, elements.initial_gap))
    most = max(1, int(np.ceil(until_fraction * gap.size)))
    memory.require(8 * most**2, f"march: the factor for {most} elements in contact")
    # The dense solution of a contact has whole numbers of 32 bits, too, so that numba compiles shared functions once.
    row, column = row.astype(np.int32), column.astype(np.int32)
    factor, members, inside = np.empty((most, most)), np.empty(most, int), np.zeros(gap.size, bool)
    impulse, depth, resistance = events = np.zeros((3, most))
    scratch = *np.zeros((3, most)), inside, gap.copy(), np.zeros(gap.size)
    tension_index = _march(elements.influence, row, column, gap, factor, members, events, *scratch)
    if tension_index >= 0:
        raise ConvergenceError(f"march: tension on element {tension_index} of the contact set; contact would open")
    with np.errstate(over="ignore"):
        impulse, resistance = elements.units.force * impulse, elements.units.stiffness * resistance
    if not np.isfinite(impulse).all():
        raise ValueError("march: impulses are too large to represent; a larger unit of length is needed")
    return Events(impulse, depth, resistance, np.arange(1, most + 1), gap.size, indenter.length_unit)


@njit(inner=True, fastmath=True)
def _respond(influence, row, column, members, count, first, second, element):
    """Return Σ_j K_ij first_j and Σ_j K_ij second_j for the element i = `element`.

    The sums include all elements j in contact.

    members, count : indices of the elements in contact, and their number
    """
    a, b = 0.0, 0.0
    r, c = row[element], column[element]
    for t in range(count):
        value = influence[abs(row[members[t]] - r), abs(column[members[t]] - c)]
        a += value * first[t]
        b += value * second[t]
    return a, b


@njit
def _march(
    influence, row, column, initial_gap, factor, members, events, forward, tangent, load, inside, last_gap, last_depth
):  # fmt: skip
    """Compute contact events until `most` elements are in contact; return the index of an element under tension.

    d is the side of an element, and q solves K q = 1 on the contact set (see the module). The index is a position in
    the contact set; −1 if no element is under tension.

    initial_gap : initial gaps, in increasing order
    factor : scratch array for the Cholesky factor of the influence matrix, shape (most, most)
    members : scratch array for the indices of the elements in contact, shape (most,)
    events : impulse/(4π d), depth and Σq at every event are stored here, shape (3, most)
    forward, tangent, load : scratch arrays, zero on entry, shape (most,)
    inside : True for elements in contact, False on entry
    last_gap, last_depth : for each element, the gap that was last evaluated, and the depth of the indenter at that
        time; the initial gap and zero on entry. Since then the gap has closed by no more than the increase of the depth
    """
    elements, most = initial_gap.size, members.size
    element, depth_now, total = 0, 0.0, 0.0
    for count in range(1, most + 1):
        append_element(factor, influence, row, column, members, count - 1, element, forward)
        inside[element] = True
        stiffness = solve_flat_punch(factor, count, forward, tangent)
        for t in range(count):
            if tangent[t] < 0:
                return t
        events[0, count - 1], events[1, count - 1], events[2, count - 1] = total, depth_now, stiffness
        if count == most:
            break

        nearest, element = np.inf, -1
        for i in range(elements):
            if not inside[i] and last_gap[i] + last_depth[i] < nearest:
                nearest, element = last_gap[i] + last_depth[i], i
        depth_step, next_to_touch = np.inf, -1
        # Evaluate the element first that probably touches next. Its depth of touch rules out most other elements.
        candidate = element
        for i in range(-1, elements):
            if i >= 0:
                candidate = i
                if inside[i] or last_gap[i] + last_depth[i] - depth_now >= depth_step:
                    continue
            deflection, deflection_per_depth = _respond(
                influence, row, column, members, count, load, tangent, candidate
            )
            last_gap[candidate], last_depth[candidate] = deflection - depth_now + initial_gap[candidate], depth_now
            step_to_touch = max(last_gap[candidate], 0.0) / max(1.0 - deflection_per_depth, 1e-300)
            if step_to_touch < depth_step:
                depth_step, next_to_touch = step_to_touch, candidate
        if next_to_touch < 0:
            raise ValueError("march: depths overflow; smaller heights, in a larger unit, are needed")
        element = next_to_touch
        depth_now += depth_step
        total += depth_step * stiffness
        for t in range(count):
            load[t] += depth_step * tangent[t]
    return -1
