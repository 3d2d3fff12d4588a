"""Dense contact solutions for the few elements that can touch: exact to rounding, cheaper than any grid.

Elements are named by their rank in the order of increasing gap, so that those which can touch at a given
depth are the first ones.
"""

import numba
import numpy as np
import scipy.linalg

from viscorough.curve import ConvergenceError


@numba.njit(cache=True)
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


@numba.njit(cache=True)
def _deflections(influence, row, column, members, load, start, stop):
    """Σ_j K_ij load_j at the elements of rank start ≤ i < stop, for every row of load; shape (loads, stop − start)."""
    result = np.zeros((load.shape[0], stop - start))
    for b in range(members.size):
        r, c = row[members[b]], column[members[b]]
        for i in range(start, stop):
            value = influence[abs(row[i] - r), abs(column[i] - c)]
            for s in range(load.shape[0]):
                result[s, i - start] += value * load[s, b]
    return result


def pressures(problem, members, depth):
    """P and q = dP/du of the given contact set at the given depth, each of shape (count,)."""
    matrix = _matrix(problem.influence, problem.row, problem.column, members)
    right = np.stack([depth - problem.gap[members], np.ones(members.size)], axis=1)
    solution = scipy.linalg.solve(matrix, right, assume_a="pos", overwrite_a=True, check_finite=False)
    return solution[:, 0], solution[:, 1]


def gaps(problem, contact):
    """Gap e between the surfaces at every element, by rank."""
    deflection = _deflections(
        problem.influence, problem.row, problem.column, contact.members, contact.pressure[None], 0, problem.elements
    )[0]
    return deflection - contact.depth + problem.gap


def solve(problem, contact, depth, candidates, largest):
    """The contact set at `depth` by the primal-dual active set method; None if it exceeds `largest` elements.

    Only the `candidates` lowest-ranked elements have a gap below the depth and can be in contact; where nothing is
    in contact yet, all of them are tried.
    Raises ConvergenceError if the set does not settle.
    """
    rank = np.arange(candidates)
    inside = np.full(candidates, contact.count == 0)
    inside[contact.members] = True
    for _ in range(100):
        members = rank[inside]
        if members.size > largest:
            return None
        pressure, _rate = pressures(problem, members, depth)
        deflection = _deflections(
            problem.influence, problem.row, problem.column, members, pressure[None], 0, candidates
        )[0]
        # Rounding decides nothing: an element within it of the surface stays as it is.
        rounding = 1e-12 * depth
        penetrating = ~inside & (deflection - depth + problem.gap[:candidates] < -rounding)
        pulling = np.zeros_like(inside)
        pulling[members] = pressure < -1e-12 * pressure.max()
        if not (penetrating.any() or pulling.any()):
            return members
        inside = (inside & ~pulling) | penetrating
    raise ConvergenceError(f"contact at depth {depth:g}: the contact set of {members.size} elements does not settle")


def next_event(problem, contact):
    """Depth at which the next elements touch, and the contact set from there on."""
    gap, depth = problem.gap, contact.depth
    load = np.stack([contact.pressure, contact.rate])
    outside = np.ones(problem.elements, dtype=bool)
    outside[contact.members] = False
    stop = min(problem.elements, max(2 * contact.count + 32, int(np.searchsorted(gap, 1.2 * depth))))
    while True:
        deflection, speed = _deflections(problem.influence, problem.row, problem.column, contact.members, load, 0, stop)
        free = outside[:stop]
        wait = np.full(stop, np.inf)
        wait[free] = np.maximum(deflection[free] - depth + gap[:stop][free], 0) / (1 - speed[free])
        first = wait.min()
        # Elements further down have gaps too large to touch before: the surface there only sinks.
        if stop == problem.elements or gap[stop] - depth > first:
            break
        stop = min(problem.elements, 4 * stop)
    touching = np.flatnonzero(wait <= first + 1e-12 * (depth + first))
    return depth + first, np.union1d(contact.members, touching)
