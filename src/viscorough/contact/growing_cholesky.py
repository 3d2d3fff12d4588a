"""Cholesky factor L of the influence matrix of a contact set that grows element by element.

Compiled for the two places that follow contact events: the dense elastic path and the direct integration of the viscous
problem. The latter checks the former; what they share is this linear algebra, which is tested against a full
factorisation, and no mechanics. Compiled functions take plain arrays, hence their many arguments.
"""

import numpy as np

from viscorough.compilation import njit


@njit(fastmath=True)
def append_element(factor, influence, row, column, members, count, element, forward):
    """Add an element to the set of `count` members: a row of L, and its entry of L⁻¹·1; all in place.

    influence : K by distance in rows and columns; row, column : of every element
    factor : L, shape (most, most); members : the elements of the set, shape (most,); forward : L⁻¹·1, shape (most,)
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


@njit(fastmath=True)
def solve_flat_punch(factor, count, forward, tangent):
    """q = L⁻ᵀ (L⁻¹·1) of the set, in place; returns its sum."""
    tangent[:count] = forward[:count]
    total = 0.0
    for i in range(count - 1, -1, -1):
        below = factor[i]
        value = tangent[i] / below[i]
        tangent[i] = value
        total += value
        for j in range(i):
            tangent[j] -= below[j] * value
    return total
