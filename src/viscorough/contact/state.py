"""The types that the parts of the contact solver exchange.

Inside the solver, lengths are in units of the largest initial gap, so that results do not depend on the user's unit of
length; such quantities are called reduced. `Units` converts them, and nothing else does.
"""

from dataclasses import dataclass

import numpy as np

from viscorough.contact.halfspace import influence_coefficient


@dataclass(frozen=True)
class Units:
    """What reduced quantities are multiplied by.

    length : the largest initial gap; of an indenter without gaps 1 [length]
    spacing : side d of an element [length]
    """

    length: float
    spacing: float

    @property
    def stiffness(self):
        """k/G = 4π d Σq [length]."""
        return 4 * np.pi * self.spacing

    @property
    def force(self):
        """F/G = 4π d ΣP [length²]."""
        return 4 * np.pi * self.spacing * self.length

    @property
    def pressure(self):
        """p/G = 4π P/d [1]."""
        return 4 * np.pi * self.length / self.spacing


@dataclass(frozen=True)
class Elements:
    """The elements of an indenter by rank: in the order of increasing initial gap. Arrays of shape (elements,).

    row, column : positions on the grid, from the first row and column with an element on
    initial_gap : reduced distance to the surface when the highest element touches
    map_place : rows and columns in the indenter's heights
    shape : rows and columns of the smallest grid with all elements
    influence : K by distance in rows and columns, of that shape
    """

    row: np.ndarray
    column: np.ndarray
    initial_gap: np.ndarray
    map_place: tuple
    shape: tuple
    influence: np.ndarray

    @property
    def count(self):
        """Number of elements."""
        return self.initial_gap.size


def elements_of(indenter):
    """The Elements of an indenter, and the Units in which their initial gaps are."""
    rows, columns = np.nonzero(np.isfinite(indenter.heights))
    gap = indenter.initial_gap[rows, columns].astype(float)
    order = np.argsort(gap, kind="stable")
    units = Units(gap.max() or 1.0, indenter.spacing)
    row, column = ((position[order] - position.min()).astype(np.int32) for position in (rows, columns))
    shape = int(row.max()) + 1, int(column.max()) + 1
    distance = [np.arange(n, dtype=float) for n in shape]
    influence = influence_coefficient(distance[0][:, None], distance[1][None, :])
    place = rows[order], columns[order]
    return Elements(row, column, gap[order] / units.length, place, shape, influence), units


@dataclass
class BoundedField:
    """A field on the flat grid, and a bound on the rounding error accumulated in it."""

    values: np.ndarray
    rounding: float


@dataclass(frozen=True)
class ContactSet:
    """The elements of a grid that are in contact.

    inside : whether each place of the flat grid is in contact
    places : the places in contact, in flat fields
    slots : the same elements in the load array of the half-space operator, which has no border
    """

    inside: np.ndarray
    places: np.ndarray
    slots: np.ndarray


@dataclass(frozen=True)
class GridFields:
    """A contact on the grid; flat arrays with a border, reduced.

    pressure : P
    gap : e = w − u + g, zero in contact
    tangent : q = dP/du
    tangent_gap : e_q = K q − 1, zero in contact; the gap opens by e_q per depth
    place : places of the elements, by rank
    """

    pressure: np.ndarray
    gap: BoundedField
    tangent: np.ndarray
    tangent_gap: BoundedField
    place: np.ndarray

    def gap_at(self, ranks):
        """Gap e at the elements of given rank."""
        return self.gap.values[self.place[ranks]]


@dataclass(frozen=True)
class Contact:
    """The contact at one depth.

    units : of the reduced quantities
    reduced_depth : u
    members : elements in contact, as ranks, shape (count,)
    reduced_pressure, tangent : P and q = dP/du on the members, shape (count,)
    pressure_sum, tangent_sum : ΣP and Σq, corrected to second order by the residuals that were left
    residual : largest |e| on the contact set or overlap outside it, rounding included, over the depth
    fields : the same on the grid, None where the dense solution never needed it
    """

    units: Units
    reduced_depth: float
    members: np.ndarray
    reduced_pressure: np.ndarray
    tangent: np.ndarray
    pressure_sum: float
    tangent_sum: float
    residual: float = 0.0
    fields: GridFields | None = None

    @property
    def count(self):
        """Number of elements in contact."""
        return self.members.size

    @property
    def depth(self):
        """Depth u [length]."""
        return self.reduced_depth * self.units.length

    @property
    def force(self):
        """F/G = 4π d ΣP [length²]."""
        return self.pressure_sum * self.units.force

    @property
    def stiffness(self):
        """Tangent stiffness k/G = 4π d Σq [length]."""
        return self.tangent_sum * self.units.stiffness

    @property
    def pressure(self):
        """p/G on the members, shape (count,) [1]."""
        return self.reduced_pressure * self.units.pressure
