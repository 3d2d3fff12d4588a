"""The elements of a rough map and their influence on each other, for direct integration with internal variables."""

import numpy as np

from viscorough import memory
from viscorough.contact.halfspace import Halfspace
from viscorough.contact.influence import influence_table


class Elements:
    """Elements of an indenter, in the order of their rows; pressures and deflections are arrays of shape (elements,).

    row, column : their places on the grid
    initial_gap : [length]; influence : K by distance in rows and columns
    scale : 4π d, d the side of an element, with which the force is 4π d ΣQ for Q = p d/(4π)

    Raises ValueError unless the heights are two-dimensional.
    """

    def __init__(self, indenter, caller):
        if indenter.heights.ndim != 2:
            raise ValueError(f"{caller}: the indenter's heights must be two-dimensional")
        self.row, self.column = np.nonzero(np.isfinite(indenter.heights))
        self.initial_gap = indenter.initial_gap[self.row, self.column].astype(float)
        distance = [np.arange(n, dtype=float) for n in indenter.heights.shape]
        self.influence = influence_table(*distance, indenter.aspect)
        self.scale = 4 * np.pi * indenter.element_side
        self.count, self.shape = self.initial_gap.size, indenter.heights.shape
        self._side, self._operator = indenter.element_side, Halfspace(*self.shape, aspect=indenter.aspect)

    def deflection(self, load):
        """K times a load at all elements."""
        self._operator.load[self.row, self.column] = load
        return self._operator.apply()[self.row, self.column]

    def influence_among(self, members):
        """K between elements, shape (members, members)."""
        memory.require(24 * members.size**2, f"direct integration with {members.size} elements in contact")
        row, column = self.row[members], self.column[members]
        return self.influence[abs(row[:, None] - row), abs(column[:, None] - column)]

    def pressure_map(self, load):
        """Pressure p = 4π Q/d on the grid, nan where there is no element."""
        pressure = np.full(self.shape, np.nan)
        pressure[self.row, self.column] = 4 * np.pi / self._side * load
        return pressure
