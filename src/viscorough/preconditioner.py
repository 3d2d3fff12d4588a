"""Sparse approximate inverse of the influence matrix of a contact set, for conjugate gradients.

M = GᵀG with G lower triangular: row i of G holds element i and those of the twelve nearest ones before it (in rows and
columns) that are in contact, and is exact for these few elements alone (Kolotilina and Yeremin 1993). It depends on
nothing but which of the twelve are in contact, so that all 4096 rows that can occur stand in a table.
"""

from functools import cache

import numba
import numpy as np

from viscorough.halfspace import influence_coefficient

# Rows and columns by which neighbours reach out: the width of the border that grids need.
REACH = 2
_BEFORE = [(-r, c) for r in range(REACH + 1) for c in range(-REACH, REACH + 1) if (-r, c) < (0, 0)]
_NEIGHBOURS = len(_BEFORE)


def offsets(width):
    """Places of the neighbours before an element, relative to it, in a flat grid of the given width."""
    return np.array([row * width + column for row, column in _BEFORE])


@cache
def table():
    """Rows of G by pattern, bit s of which tells that neighbour s is in contact; the last entry is the element's own.

    With A the influence matrix of the neighbours in contact and the element, the row is A⁻¹ e / (eᵀ A⁻¹ e)^½, e the
    unit vector of the element. Shape (4096, 13), zero where there is no contact.
    """
    places = np.array([*_BEFORE, (0, 0)], dtype=float)
    row, column = np.moveaxis(places[:, None] - places, -1, 0)
    patterns = np.arange(1 << _NEIGHBOURS)
    present = np.ones((patterns.size, _NEIGHBOURS + 1), dtype=bool)
    present[:, :-1] = patterns[:, None] >> np.arange(_NEIGHBOURS) & 1
    # Neighbours that are not there get an equation of their own.
    both = present[:, :, None] & present[:, None, :]
    matrices = np.where(both, influence_coefficient(row, column), np.eye(_NEIGHBOURS + 1))
    own = np.zeros((patterns.size, _NEIGHBOURS + 1, 1))
    own[:, -1] = 1
    rows = np.linalg.solve(matrices, own)[..., 0]
    return rows / np.sqrt(rows[:, -1:])


@cache
def relief():
    """Load that the eight neighbours of an element take over when it leaves the contact, per load; shape (3, 3).

    Its elimination from the influence matrix of the 5 × 5 elements around it; the centre is −1.
    """
    row, column = np.divmod(np.arange(25.0), 5)
    inverse = np.linalg.inv(influence_coefficient(row[:, None] - row, column[:, None] - column))
    return -inverse[12].reshape(5, 5)[1:-1, 1:-1] / inverse[12, 12]


@numba.njit(cache=True)
def patterns(inside, places, before):
    """Pattern of neighbours in contact of every element of the set."""
    result = np.empty(places.size, np.int16)
    for t in range(places.size):
        pattern = 0
        for s in range(_NEIGHBOURS):
            if inside[places[t] + before[s]]:
                pattern |= 1 << s
        result[t] = pattern
    return result


@numba.njit(cache=True, fastmath=True)
def precondition(residual, places, pattern, rows, before, work, result):
    """result = M r on the set, for a residual r on the grid; `work` is a grid of zeros and left so."""
    for t in range(places.size):
        i, row = places[t], rows[pattern[t]]
        value = row[_NEIGHBOURS] * residual[i]
        for s in range(_NEIGHBOURS):
            value += row[s] * residual[i + before[s]]
        work[i] += row[_NEIGHBOURS] * value
        for s in range(_NEIGHBOURS):
            work[i + before[s]] += row[s] * value
    for t in range(places.size):
        result[t] = work[places[t]]
        work[places[t]] = 0.0
