"""Tabulate the possible rows of the sparse factor G of the preconditioner.

In this package G is the sparse factor, not the shear modulus. Row i of G depends only on the contact of the twelve
elements that precede element i and are nearest to it: each may be in contact or not, so there are 4096 rows.
"""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscorough.contact.halfspace.influence import influence_coefficient

# Largest distance of a neighbour, in rows or columns: the width of the border that fields need.
REACH = 2
# Relative positions (row, column) of the neighbours.
BEFORE = [(r, c) for r in range(-REACH, 1) for c in range(-REACH, REACH + 1) if (r, c) < (0, 0)]
NEIGHBOURS = len(BEFORE)
# Largest entry as a whole number; the sum of a row, which is rounded up at most thirteen times, fits into a byte, too.
_LARGEST_ENTRY = 120


@lru_cache(maxsize=4)
def factor_entries(aspect: float, precision: type[Any]) -> tuple[NDArray[Any], Any]:
    """Return entries of G by neighbour and pattern, and their unit of storage, for elements of an aspect dy/dx.

    Bit s of a pattern is set if neighbour s is in contact. With A the influence matrix of the neighbours in contact and
    the element, the row is A⁻¹ b / (bᵀ A⁻¹ b)^½, b the unit vector of the element. Entries are zero for neighbours
    without contact. The last row but one has the entries of the element, the last row the sums; shape (14, 4096).
    """
    places = np.array([*BEFORE, (0, 0)], dtype=float)
    patterns, (row, column) = np.arange(1 << NEIGHBOURS), np.moveaxis(places[:, None] - places, -1, 0)
    present = np.ones((patterns.size, NEIGHBOURS + 1), dtype=bool)
    present[:, :-1] = patterns[:, None] >> np.arange(NEIGHBOURS) & 1
    # Absent neighbours are replaced by identity rows.
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
