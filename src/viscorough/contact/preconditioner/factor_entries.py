"""Tabulate all possible rows of the sparse factor G of the preconditioner.

In this package G is the sparse factor, not the shear modulus. The neighbours of element i are the twelve nearest
elements before element i, in the order of rows and columns. Row i of G depends only on which neighbours are in contact.
Each neighbour is in contact or not, so there are 2¹² = 4096 possible rows.
"""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscorough.contact.border import BORDER
from viscorough.contact.halfspace.influence import influence_coefficient

# Positions (row, column) of the twelve neighbours that come before an element, relative to the element. They are at
# most as far away as the border of flat fields is wide.
BEFORE = [(r, c) for r in range(-BORDER, 1) for c in range(-BORDER, BORDER + 1) if (r, c) < (0, 0)]
NEIGHBOURS = len(BEFORE)
# In single precision the entries of G are rounded to whole numbers, and the largest entry becomes this number. The
# number is below 127, because the sum of a row must fit into a byte, too: rounding changes each of its thirteen entries
# by up to one half.
_LARGEST_ENTRY = 120


@lru_cache(maxsize=4)
def factor_entries(aspect: float, precision: type[Any]) -> tuple[NDArray[Any], Any]:
    """Return a table of all possible rows of the sparse factor G, and the unit of the numbers in the table.

    A contact pattern is a whole number whose bit s is set if neighbour s of an element is in contact. Let A be the
    influence matrix of the element and of its neighbours in contact, and b the unit vector of the element. Then the row
    of G for the element is A⁻¹ b / (bᵀ A⁻¹ b)^½. The row is zero at neighbours without contact.

    aspect : dy/dx of the elements
    precision : floating-point type of the preconditioner; in single precision, entries are rounded to one byte

    Returns an array of shape (14, 4096), with a column for every pattern: the entries of the twelve neighbours, the
    entry of the element itself, and the sum of these thirteen entries. The second result is the unit: the array times
    the unit gives the entries of G.
    """
    places = np.array([*BEFORE, (0, 0)], dtype=float)
    patterns, (row, column) = np.arange(1 << NEIGHBOURS), np.moveaxis(places[:, None] - places, -1, 0)
    present = np.ones((patterns.size, NEIGHBOURS + 1), dtype=bool)
    present[:, :-1] = patterns[:, None] >> np.arange(NEIGHBOURS) & 1
    # Replace the rows and columns of neighbours without contact by rows and columns of the identity matrix.
    both = present[:, :, None] & present[:, None, :]
    matrices = np.where(both, influence_coefficient(row, column, aspect), np.eye(NEIGHBOURS + 1))
    own = np.zeros((patterns.size, NEIGHBOURS + 1, 1))
    own[:, -1] = 1
    rows, unit = np.linalg.solve(matrices, own)[..., 0], 1.0
    rows /= np.sqrt(rows[:, -1:])
    if precision == np.float32:
        unit = rows.max() / _LARGEST_ENTRY
        rows = np.round(rows / unit)
    entries = np.column_stack([rows, rows.sum(axis=1)])
    entries = np.ascontiguousarray(entries.T, np.int8 if precision == np.float32 else precision)
    return entries, precision(unit)
