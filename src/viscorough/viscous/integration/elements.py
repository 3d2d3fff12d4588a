"""The elements of a rough map and their influence on each other, for direct integration in time."""

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
    """Elements of an indenter, in the order of their rows; pressures and deflections are arrays of shape (elements,).

    initial_gap : [length]; shape : rows and columns of the heights
    units : state.Units for lengths in the unit of the indenter: the force is 4π d ΣQ and p = 4π Q/d for Q = p d/(4π)
    """

    units: Units

    @cached_property
    def _operator(self) -> Halfspace:
        return Halfspace(*self.shape, aspect=self.aspect)

    def deflection(self, load: Array) -> Array:
        """K times a load at all elements."""
        self._operator.load[self.row, self.column] = load
        return self._operator.apply()[self.row, self.column]

    def influence_among(self, members: Integers) -> Array:
        """K between elements, shape (members, members)."""
        memory.require(24 * members.size**2, f"direct integration with {members.size} elements in contact")
        row, column = self.row[members], self.column[members]
        return self.influence[abs(row[:, None] - row), abs(column[:, None] - column)]


def elements_of_map(indenter: Indenter, caller: str) -> MapElements:
    """The MapElements of an indenter. Raises ValueError, which starts with the caller, unless it is a map."""
    check_indenter(caller, indenter, 2)
    row, column = np.nonzero(np.isfinite(indenter.heights))
    gap = indenter.initial_gap[row, column]
    units = Units(1.0, indenter.element_side)
    grid = ElementGrid((0, 0), indenter.heights.shape, indenter.aspect)
    return MapElements(row, column, gap, grid, units)
