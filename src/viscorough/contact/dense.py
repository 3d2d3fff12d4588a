"""Dense contact solutions for the few elements that can touch: exact to rounding, cheaper than any grid.

Elements are named by their rank in the order of increasing gap, so that those which can touch at a given
depth are the first ones.
"""

import numpy as np
import scipy.linalg

from viscorough.compilation import njit
from viscorough.errors import ConvergenceError
from viscorough.interrupts import uninterrupted


@njit
def _matrix(influence, row, column, members):
    """Influence matrix K of the members, shape (count, count)."""
    n = members.size
    matrix = np.empty((n, n))
    for a in range(n):
        for b in range(a + 1):
            value = influence[abs(row[members[a]] - row[members[b]]), abs(column[members[a]] - column[members[b]])]
            matrix[a, b] = value
            matrix[b, a] = value
    return matrix


@njit(fastmath=True)
def _deflection(influence, row, column, members, load, stop):
    """Σ_j K_ij load_j at the elements of rank i < stop."""
    result = np.zeros(stop)
    for b in range(members.size):
        r, c = row[members[b]], column[members[b]]
        for i in range(stop):
            result[i] += load[b] * influence[abs(row[i] - r), abs(column[i] - c)]
    return result


def pressures(problem, members, depth):
    """P and q = dP/du of the given contact set at the given depth, each of shape (count,)."""
    matrix = _matrix(problem.influence, problem.row, problem.column, members)
    right = np.stack([depth - problem.gap[members], np.ones(members.size)], axis=1)
    factor = scipy.linalg.cho_factor(matrix, overwrite_a=True, check_finite=False)
    solution = scipy.linalg.cho_solve(factor, right, overwrite_b=True, check_finite=False)
    return solution[:, 0], solution[:, 1]


def gaps(problem, contact):
    """Gap e between the surfaces at every element, by rank."""
    of_problem = problem.influence, problem.row, problem.column
    deflection = _deflection(*of_problem, contact.members, contact.pressure, problem.elements)
    return deflection - contact.depth + problem.gap


def solve(problem, contact, depth, candidates, largest):
    """The contact at `depth` by the primal-dual active set method: its members, P and q. None above `largest` members.

    Only the `candidates` lowest-ranked elements have a gap below the depth and can be in contact. Starts from those in
    contact before, whose pressures at the new depth are known, or from all candidates where there are none.
    Raises ConvergenceError if the set does not settle.
    """
    if contact.count:
        members, rate = contact.members, contact.rate
        pressure = contact.pressure + (depth - contact.depth) * rate
    elif candidates > largest:
        return None
    else:
        members = np.arange(candidates)
        pressure, rate = pressures(problem, members, depth)
    for _ in range(100):
        deflection = _deflection(problem.influence, problem.row, problem.column, members, pressure, candidates)
        # Rounding decides nothing: an element within it of the surface stays as it is.
        rounding = 1e-12 * depth
        wanted = deflection - depth + problem.gap[:candidates] < -rounding
        wanted[members] = pressure >= -1e-12 * pressure.max()
        found = np.flatnonzero(wanted)
        if np.array_equal(found, members):
            return members, pressure, rate
        if found.size > largest:
            return None
        members = found
        pressure, rate = pressures(problem, members, depth)
    raise ConvergenceError(f"contact at depth {depth:g}: the contact set of {members.size} elements does not settle")


def follow_events(problem, contact, most, force):
    """Contact after contact at the depths at which the next elements touch, up to `most` elements or beyond `force`.

    Pressures grow at the constant rate q from event to event. Every element that touches adds a row to the Cholesky
    factor of the influence matrix, so that 400 events cost no more than ten dense solutions (measured). The same
    recursion, in time, integrates the viscous problem; that is a check of this and keeps code of its own (marching).

    Returns depths, ΣP, Σq, numbers of elements in contact at the events, shape (events,), and the elements in the order
    in which they touch. Elements that touch at one depth, to rounding, are one event.
    """
    with uninterrupted():
        depth, total, stiffness, members = _follow(
            problem.influence, problem.row, problem.column, problem.gap, contact.depth, contact.members,
            contact.pressure, min(most, problem.elements), force,
        )  # fmt: skip
    count = np.arange(contact.count, contact.count + depth.size)
    # The first entry is the contact itself; the last event has all its elements only if another one follows.
    complete = np.append(np.diff(depth) > 1e-12 * depth[1:], members.size == problem.elements)
    complete[0] = False
    return depth[complete], total[complete], stiffness[complete], count[complete], members


@njit(fastmath=True)
def _follow(influence, row, column, gap, depth, start, pressure, most, force):
    factor, members = np.empty((most, most)), np.empty(most, np.int64)
    forward, rate, load = np.zeros(most), np.zeros(most), np.zeros(most)
    depths, totals, stiffnesses = np.zeros(most), np.zeros(most), np.zeros(most)
    inside = np.zeros(gap.size, np.bool_)
    # What is known of an element's gap: at `known_at` it was `known`; it closes no faster than the depth grows.
    known, known_at = gap.copy(), np.zeros(gap.size)
    count, total = 0, 0.0
    for t in range(start.size - 1):
        _append(factor, influence, row, column, members, count, start[t], forward)
        inside[start[t]] = True
        count += 1
    load[: start.size] = pressure
    total, element, events = pressure.sum(), start[start.size - 1], 0
    while True:
        _append(factor, influence, row, column, members, count, element, forward)
        inside[element] = True
        count += 1
        stiffness = _rates(factor, count, forward, rate)
        depths[events], totals[events], stiffnesses[events] = depth, total, stiffness
        events += 1
        if count == most or total > force or rate[:count].min() < 0:
            break
        wait, element = np.inf, -1
        for i in range(gap.size):  # by rank: elements further down cannot touch before the surface has met them
            if gap[i] - depth >= wait:
                break
            if inside[i] or known[i] + known_at[i] - depth >= wait:
                continue
            sunk, speed = 0.0, 0.0
            for t in range(count):
                value = influence[abs(row[members[t]] - row[i]), abs(column[members[t]] - column[i])]
                sunk += value * load[t]
                speed += value * rate[t]
            known[i], known_at[i] = sunk - depth + gap[i], depth
            touch = max(known[i], 0.0) / max(1.0 - speed, 1e-300)
            if touch < wait:
                wait, element = touch, i
        depth += wait
        total += wait * stiffness
        for t in range(count):
            load[t] += wait * rate[t]
    return depths[:events], totals[:events], stiffnesses[:events], members[:count]


@njit(fastmath=True)
def _append(factor, influence, row, column, members, count, element, forward):
    """Add an element to the set: a row of the Cholesky factor L, and the entry of L⁻¹·1 that belongs to it."""
    new = factor[count]
    for t in range(count):
        new[t] = influence[abs(row[members[t]] - row[element]), abs(column[members[t]] - column[element])]
    square, total = influence[0, 0], 1.0
    for i in range(count):
        above = factor[i]
        value = new[i]
        for j in range(i):
            value -= above[j] * new[j]
        value /= above[i]
        new[i] = value
        square -= value * value
        total -= value * forward[i]
    new[count] = np.sqrt(square)
    forward[count] = total / new[count]
    members[count] = element


@njit(fastmath=True)
def _rates(factor, count, forward, rate):
    """q = L⁻ᵀ (L⁻¹·1) of the set; returns its sum."""
    rate[:count] = forward[:count]
    total = 0.0
    for i in range(count - 1, -1, -1):
        below = factor[i]
        value = rate[i] / below[i]
        rate[i] = value
        total += value
        for j in range(i):
            rate[j] -= below[j] * value
    return total
