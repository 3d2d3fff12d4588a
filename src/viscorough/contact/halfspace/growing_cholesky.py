"""Update the Cholesky factor L of the influence matrix of a contact set that grows element by element.

Two methods use this module, because both add one element after another to the contact: the elastic solver for contacts
of few elements (contact.dense), and the direct integration of the viscous problem (viscous.integration.events). The
integration serves as a check of the elastic solver. The two methods share only the influence coefficients and this
linear algebra, which is tested against a full factorisation. The functions have many arguments because compiled code
takes plain arrays only.
"""

import numpy as np

from viscorough.basics.compilation import njit


@njit(inner=True, fastmath=True)
def append_element(factor, influence, row, column, members, count, element, forward):
    """Add an element to a contact set of `count` members: append a row to L and an entry to L⁻¹·1, in place.

    factor : Cholesky factor L of the influence matrix of the members, shape (most, most), with `most` the largest
        number of members
    influence : influence coefficients K by distance in rows and columns
    row, column : positions of all elements on the grid
    members : indices of the members, shape (most,); the new element is appended
    element : index of the new element
    forward : L⁻¹·1, the product of L⁻¹ with a vector of ones, shape (most,)
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
    """Solve K q = 1 for the `count` members of a contact set: store q in `tangent` and return Σq.

    The solution is q = L⁻ᵀ (L⁻¹·1), with the Cholesky factor L in `factor` and L⁻¹·1 in `forward`.
    """
    # Copy in a loop. An assignment of slices would take a second longer to compile, because numba adds an error message
    # for slices of different sizes.
    for i in range(count):
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
    """Solve L Lᵀ x = b for every row b of `right`, and replace b by x.

    factor : Cholesky factor L, shape (count, count) or wider
    right : right-hand sides b, shape (number of right-hand sides, count)
    """
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
