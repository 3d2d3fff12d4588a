"""Update the Cholesky factor L of the influence matrix of a contact set that grows element by element.

It serves the two methods that follow contact events: the dense elastic path and the direct integration of the viscous
problem. The second method checks the first; they share only the influence coefficients and this linear algebra, which
is tested against a full factorisation. Compiled functions take plain arrays, hence their many arguments.
"""

import numpy as np

from viscorough.basics.compilation import njit


@njit(inner=True, fastmath=True)
def append_element(factor, influence, row, column, members, count, element, forward):
    """Add an element to the set of `count` members: a row of L and an entry of L⁻¹·1, in place.

    influence : influence coefficients K by distance in rows and columns
    row, column : positions of all elements on the grid
    factor : L, shape (most, most), most being the largest number of members
    members : the elements of the set, shape (most,)
    forward : L⁻¹·1, shape (most,)
    """
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


@njit(inner=True, fastmath=True)
def solve_flat_punch(factor, count, forward, tangent):
    """Store the tangent q = L⁻ᵀ (L⁻¹·1) of the `count` members, the solution of K q = 1, in `tangent`; returns Σq."""
    for i in range(count):  # a copy of slices would take a second to compile, for the message that their sizes differ
        tangent[i] = forward[i]
    total = 0.0
    for i in range(count - 1, -1, -1):
        below = factor[i]
        value = tangent[i] / below[i]
        tangent[i] = value
        total += value
        for j in range(i):
            tangent[j] -= below[j] * value
    return total


@njit(fastmath=True)
def solve_factored(factor, right):
    """Replace each row b of `right`, shape (sides, count), by the x with L Lᵀ x = b, L of shape (count, ≥ count)."""
    for side in right:
        for i in range(side.size):
            row, value = factor[i], side[i]
            for j in range(i):
                value -= row[j] * side[j]
            side[i] = value / row[i]
        for i in range(side.size - 1, -1, -1):
            row = factor[i]
            value = side[i] / row[i]
            side[i] = value
            for j in range(i):
                side[j] -= row[j] * value
