"""Elements of a map of heights, and their influence coefficients, for direct integration in time."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viscorough.basics import memory
from viscorough.basics.types import Array, Integers
from viscorough.contact.halfspace.operator import Halfspace
from viscorough.contact.state import ElementGrid, Elements, Units
from viscorough.surfaces.indenter import Indenter, check_indenter


@dataclass(frozen=True)
class MapElements(Elements):
    """Elements of an indenter, row after row of the map; pressures and deflections are arrays of shape (elements,).

    initial_gap : initial gap of each element [length]
    shape : numbers of rows and columns of the heights
    units : factors that convert the reduced pressure Q = p d/(4π) of square elements of side d to the force 4π d ΣQ and
        to the pressure p = 4π Q/d. Lengths are in the unit of the indenter; see viscorough.contact.state.Units
    """

    units: Units

    @cached_property
    def _operator(self) -> Halfspace:
        return Halfspace(*self.shape, aspect=self.aspect)

    def deflection(self, load: Array) -> Array:
        """Return the deflections K Q of all elements, with the matrix K of influence coefficients.

        load : reduced pressures Q of all elements
        """
        self._operator.load[self.row, self.column] = load
        return self._operator.apply()[self.row, self.column]

    def influence_among(self, members: Integers) -> Array:
        """Return the matrix of the influence coefficients K among some elements, shape (members, members).

        members : indices of these elements

        Raises MemoryError if there is not enough memory for the matrix.
        """
        memory.require(24 * members.size**2, f"direct integration with {members.size} elements in contact")
        row, column = self.row[members], self.column[members]
        return self.influence[abs(row[:, None] - row), abs(column[:, None] - column)]


def elements_of_map(indenter: Indenter, caller: str) -> MapElements:
    """Return the MapElements of an indenter with two-dimensional heights. Raises ValueError for other indenters.

    caller : name of the function that the user called, for the error message
    """
    check_indenter(caller, indenter, 2)
    row, column = np.nonzero(np.isfinite(indenter.heights))
    gap = indenter.initial_gap[row, column]
    units = Units(1.0, indenter.element_side)
    grid = ElementGrid((0, 0), indenter.heights.shape, indenter.aspect)
    return MapElements(row, column, gap, grid, units)
