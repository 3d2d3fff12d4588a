"""Solve contacts of few elements directly, with a dense matrix, which is exact within rounding and faster than a grid.

Elements are identified by their rank in the order of increasing initial gap. Only elements with an initial gap below
the depth can be in contact, so these elements have the lowest ranks.

The module contact.state defines the symbols: depth u, pressure P, tangent q, initial gap g, influence coefficients K.
"""

from typing import NamedTuple

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Array, Integers
from viscorough.contact.halfspace.growing_cholesky import append_element, solve_factored, solve_flat_punch
from viscorough.contact.options import LATE
from viscorough.contact.state import DenseContact, Elements, MemberLoads, Units

# Allowed relative rounding error: of a gap relative to the depth, of a pressure relative to the largest pressure, and
# of the depth at which an element touches, relative to this depth.
ROUNDING = 1e-12
# Largest number of contact sets that are tried for one contact. If none of them is correct, ConvergenceError is raised.
_MAX_ITERATIONS = 100
# Depth for an element that never touches. It is finite, because the compiler assumes finite numbers in loops with
# fastmath.
_NEVER = 1e300


class ContactEvents(NamedTuple):
    """Contact events: the depths at which further elements touch, in increasing order.

    All fields are arrays of shape (events,) in reduced units. The order of the fields is the same as in
    step_control.Level.

    depth : depth u of each event
    pressure_sum, tangent_sum : sums of the pressures P and of the tangents q = dP/du of the elements in contact, just
        beyond the event
    count : number of elements in contact just beyond the event
    """

    depth: np.ndarray
    pressure_sum: np.ndarray
    tangent_sum: np.ndarray
    count: np.ndarray  # type: ignore[assignment]  # this field hides the method `count` of tuples


@njit
def _influence_matrix(influence, row, column, members):
    """Return the influence matrix K of the elements in contact, shape (count, count); only its lower triangle is set.

    influence : influence coefficients by distance in rows and columns
    row, column : position of each element on the grid
    members : ranks of the elements in contact, shape (count,)
    """
    n = members.size
    matrix = np.empty((n, n))
    for a in range(n):
        r, c = row[members[a]], column[members[a]]
        for b in range(a + 1):
            matrix[a, b] = influence[abs(r - row[members[b]]), abs(c - column[members[b]])]
    return matrix


@njit(fastmath=True)
def _sum_deflections(influence, row, column, target_row, target_column, pressure, tangent, deflections):
    """Compute Σ_j K_ij P_j and Σ_j K_ij q_j at the target elements i; see `_deflections`.

    row, column : positions of the elements j in contact
    target_row, target_column : positions of the target elements i
    deflections : the two sums are stored here, shape (2, targets)
    """
    for i in range(target_row.size):
        by_pressure, by_tangent = 0.0, 0.0
        for j in range(row.size):
            value = influence[abs(row[j] - target_row[i]), abs(column[j] - target_column[i])]
            by_pressure += value * pressure[j]
            by_tangent += value * tangent[j]
        deflections[0, i], deflections[1, i] = by_pressure, by_tangent


def _deflections(elements: Elements, loads: MemberLoads, targets: Integers) -> Array:
    """Return the deflections Σ_j K_ij P_j and their increase with depth Σ_j K_ij q_j at the elements i of `targets`.

    The sums are over the elements j in contact, with pressures P_j and tangents q_j. Shape (2, targets).
    """
    deflections, (members, pressure, tangent) = np.empty((2, targets.size)), loads
    position, target = ((elements.row[ranks], elements.column[ranks]) for ranks in (members, targets))
    # numba would compile the function again for arrays that are not contiguous.
    pressure, tangent = np.ascontiguousarray(pressure), np.ascontiguousarray(tangent)
    _sum_deflections(elements.influence, *position, *target, pressure, tangent, deflections)
    return deflections


def solve_highest_element(elements: Elements, depth: float) -> DenseContact:
    """Return the contact of the highest element alone, at a depth so small that no other element touches.

    depth : reduced depth (see contact.state)
    """
    factor = 1 / np.sqrt(elements.influence[0, 0])
    # Multiply twice by the factor, as the Cholesky solution does, so that rounding is the same.
    pressure, tangent = (right * factor * factor for right in (np.array([depth]), np.ones(1)))
    return _exact_contact(elements.units, depth, np.zeros(1, int), pressure, tangent)


def solve(
    elements: Elements, contact: DenseContact, depth: float, candidates: int, max_count: int
) -> DenseContact | None:
    """Solve the contact at a larger reduced depth by the primal-dual active set method.

    The method repeats two steps until the contact set no longer changes: it solves for the pressures of the set, then
    removes elements under tension and adds elements that overlap the surface. Gaps are convex functions of the depth,
    so an element can join the contact only if it overlaps the surface for the predicted pressures P + Δu q, with the
    depth step Δu. The first contact set consists of the elements in contact at the smaller depth and of overlapping
    elements, but without elements that touch late in the step (see options.LATE).

    contact : contact at a smaller depth
    candidates : number of elements with an initial gap below `depth`
    max_count : largest number of elements in contact

    Returns None if more than `max_count` elements come into contact.
    Raises ConvergenceError if the set still changes after _MAX_ITERATIONS solutions.
    """
    # Give up if too many elements touch already, because contact only grows with depth. Also give up if many elements
    # can touch and there is no contact to start from.
    if candidates > max_count and not 0 < contact.count < max_count:
        return None
    loads, depth_step = contact.loads, depth - contact.reduced_depth
    others = _without(np.arange(candidates), loads.members)
    deflection, rate = _deflections(elements, loads, others)
    gap = deflection - contact.reduced_depth + elements.initial_gap[others]
    # An element in contact stays in contact if its pressure is zero within rounding. An element outside the contact
    # stays outside if its gap is zero within rounding.
    overlap = -ROUNDING * depth
    is_early = gap + depth_step * (1 - LATE * depth_step / depth) * (rate - 1) < overlap
    members = np.sort(np.append(loads.members, others[is_early]))
    possible = np.append(loads.members, others[gap + depth_step * (rate - 1) < overlap])
    for _ in range(_MAX_ITERATIONS):
        if members.size > max_count:
            return None
        pressure, tangent = _pressure_and_tangent(elements, members, depth)
        others = _without(possible, members)
        deflection, _ = _deflections(elements, MemberLoads(members, pressure, tangent), others)
        joining = others[deflection - depth + elements.initial_gap[others] < overlap]
        staying = members[pressure >= -ROUNDING * pressure.max()]
        if joining.size == 0 and staying.size == members.size:
            return _exact_contact(contact.units, depth, members, pressure, tangent)
        members = np.sort(np.append(staying, joining))
    raise ConvergenceError(
        f"contact at depth {depth * contact.units.length:g}: the contact set of {members.size} elements does not settle"
    )


def follow_events(
    elements: Elements, contact: DenseContact, most: int, pressure_sum: float
) -> tuple[ContactEvents, DenseContact, bool]:
    """Compute contact events after a given contact: the depths at which the next elements touch, one after the other.

    Until the next element touches, the pressures grow linearly with the depth, at the constant rate q. The depths of
    events are therefore exact. Every element that touches adds a row to the Cholesky factor of the influence matrix, so
    hundreds of events cost as much as a few solutions of linear equations. Elements that touch at the same depth,
    within rounding, are one event. The module viscous.integration.events integrates the viscous problem in time by the
    same recursion.

    most : the computation stops when this number of elements is in contact
    pressure_sum : the computation stops when the sum ΣP of reduced pressures exceeds this value

    Returns the ContactEvents after the given contact, the DenseContact at the last of these events, and True if ΣP
    reaches `pressure_sum` before another element touches.
    """
    loads = contact.loads
    depth, total, stiffness, members, factor = _follow(
        elements.influence, elements.row, elements.column, elements.initial_gap, contact.reduced_depth,
        loads.members, loads.pressure, min(most, elements.initial_gap.size), pressure_sum,
    )  # fmt: skip
    count = np.arange(contact.count, contact.count + depth.size)
    # An event is complete if no further element touches at the same depth. The last event is certain to be complete
    # only if all elements are in contact. The first entry is the given contact, which is no event.
    complete = np.append(np.diff(depth) > ROUNDING * depth[1:], members.size == elements.count)
    complete[0] = False
    events = ContactEvents(depth[complete], total[complete], stiffness[complete], count[complete])
    ends_at_force = bool(total[-1] > pressure_sum)
    if events.depth.size == 0:
        return events, contact, ends_at_force
    # Solve the contact at the last event again, with the known Cholesky factor of the influence matrix.
    last, last_depth = events.count[-1], events.depth[-1]
    solution = np.stack([last_depth - elements.initial_gap[members[:last]], np.ones(last)])
    solve_factored(factor[:last], solution)
    order = np.argsort(members[:last])
    return events, _exact_contact(contact.units, last_depth, members[order], *solution[:, order]), ends_at_force


def _without(elements: Integers, members: Integers) -> Integers:
    """Return the numbers in `elements` that are not in `members`, in the same order."""
    stays = np.ones(max(elements.max(initial=-1), members.max(initial=-1)) + 1, bool)
    stays[members] = False
    return elements[stays[elements]]


def _pressure_and_tangent(elements: Elements, members: Integers, depth: float) -> tuple[Array, Array]:
    """Return pressure P and tangent q of the elements of a contact set at a depth, each of shape (count,)."""
    from scipy.linalg.lapack import dposv  # imported here, because this import takes long

    matrix = _influence_matrix(elements.influence, elements.row, elements.column, members)
    right = np.stack([depth - elements.initial_gap[members], np.ones(members.size)])
    # LAPACK stores matrices by columns and numpy by rows, so the transposed matrix needs no copy. Its upper triangle is
    # the lower triangle of `matrix`.
    _, solution, failed = dposv(matrix.T, right.T, lower=False, overwrite_a=True, overwrite_b=True)
    if failed:
        raise ConvergenceError(f"contact of {members.size} elements: their influence matrix is not positive definite")
    return solution[:, 0], solution[:, 1]


def _exact_contact(units: Units, depth: float, members: Integers, pressure: Array, tangent: Array) -> DenseContact:
    """Return the DenseContact with the given pressures P and tangents q of its elements."""
    pressure = np.maximum(pressure, 0.0)  # an element that just touches can have a negative pressure due to rounding
    loads = MemberLoads(members, pressure, tangent)
    return DenseContact(units, depth, members.size, pressure.sum(), tangent.sum(), loads=loads)


@njit(fastmath=True)
def _follow(influence, row, column, initial_gap, depth, start, pressure, most, force):
    """Compute the contact events after a given contact (see `follow_events`) in compiled code, from plain arrays.

    The rank of an element is its place in the order of increasing initial gap.

    depth : reduced depth of the given contact
    start, pressure : ranks and pressures P of the elements in contact at this depth
    most : the computation stops when this number of elements is in contact
    force : the computation stops when the sum ΣP of reduced pressures exceeds this value

    Returns five arrays: the depth, ΣP and Σq of every event; the ranks of all elements in contact, in the order in
    which they touch; and the Cholesky factor of their influence matrix. The first event is the given contact.
    """
    factor, members = np.empty((most, most)), np.empty(most, np.int64)
    forward, tangent, load = np.zeros(most), np.zeros(most), np.zeros(most)
    depths, totals, stiffnesses = np.zeros(most), np.zeros(most), np.zeros(most)
    # Lower bound of the depth at which each element touches; _NEVER for elements in contact. The first bound is the
    # initial gap, because a gap closes at most as fast as the depth grows. Later bounds follow from the tangent of the
    # gap, which is a convex function of the depth.
    earliest = initial_gap.copy()
    count, total, following = 0, 0.0, 0
    for t in range(start.size - 1):
        append_element(factor, influence, row, column, members, count, start[t], forward)
        earliest[start[t]] = _NEVER
        count += 1
    for t in range(start.size):
        load[t] = pressure[t]
        total += pressure[t]
    element, events = start[start.size - 1], 0
    while True:
        append_element(factor, influence, row, column, members, count, element, forward)
        earliest[element] = _NEVER
        count += 1
        stiffness = solve_flat_punch(factor, count, forward, tangent)
        depths[events], totals[events], stiffnesses[events] = depth, total, stiffness
        events += 1
        lowest = 0.0
        for t in range(count):
            lowest = min(lowest, tangent[t])
        if count == most or total > force or lowest < 0:
            break
        depth_step, element, following = _next_touch(
            influence, row, column, initial_gap, depth, members[:count], load, tangent, earliest, following
        )
        depth += depth_step
        total += depth_step * stiffness
        for t in range(count):
            load[t] += depth_step * tangent[t]
    return depths[:events], totals[:events], stiffnesses[:events], members[:count], factor


@njit(inner=True, fastmath=True)
def _next_touch(influence, row, column, initial_gap, depth, members, load, tangent, earliest, guess):
    """Find the element that touches next.

    Elements are given by their ranks, their places in the order of increasing initial gap.

    depth : reduced depth of the contact
    members, load, tangent : ranks of the elements in contact, their pressures P and their tangents q
    earliest : lower bound of the depth at which each element touches, _NEVER for elements in contact; raised in place
        for every element whose gap is computed
    guess : element whose gap is computed first; if it touches soon, few other gaps have to be computed

    Returns the increase of the depth until the next touch, the element that touches, and a guess for the next call: the
    element with the smallest lower bound among all other elements.
    """
    depth_step, element, following, first_later = _NEVER, -1, 0, _NEVER
    member_row, member_column = row[members], column[members]
    for position in range(-1, initial_gap.size):
        i = guess if position < 0 else position
        # An element touches only at depths of at least its initial gap. The initial gap increases with the rank, so no
        # element from here on touches earlier.
        if position >= 0 and initial_gap[i] - depth >= depth_step:
            break
        if earliest[i] - depth < depth_step:
            deflection, deflection_per_depth = 0.0, 0.0
            for t in range(members.size):
                value = influence[abs(member_row[t] - row[i]), abs(member_column[t] - column[i])]
                deflection += value * load[t]
                deflection_per_depth += value * tangent[t]
            touch = max(deflection - depth + initial_gap[i], 0.0) / max(1.0 - deflection_per_depth, 1e-300)
            earliest[i] = depth + touch
            if touch < depth_step:
                depth_step, element = touch, i
        if i != element and earliest[i] < first_later:
            first_later, following = earliest[i], i
    return depth_step, element, following
