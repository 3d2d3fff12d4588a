"""Define the symbols of the contact solver, and the types that its parts exchange.

The indenter consists of elements with the sides dx and dy, pressed into an incompressible half-space of shear modulus
G. With d = √(dx dy), the symbols are:

    u                  depth of the indenter below first contact
    g                  initial gap between indenter and undeformed surface at first contact
    P = p d/(4πG)      pressure p of an element, expressed as a length
    K                  influence coefficients, dimensionless: w = K P is the deflection of the surface
    e = w − u + g      gap between indenter and deformed surface, zero in contact
    q = dP/du          tangent, dimensionless: K q = 1 for the elements in contact (the contact set), q = 0 for others
    e_q = K q − 1      tangent gap de/du, dimensionless, zero in contact

Inside the solver, u, g, P and e are divided by the largest initial gap, so results do not depend on the user's unit of
length. Such quantities are called reduced. `Units` contains the factors that convert them back.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from viscorough.basics.types import Array, Integers
from viscorough.contact.halfspace.influence import influence_table


@dataclass(frozen=True)
class Units:
    """Factors that convert reduced quantities to the user's units.

    length : largest initial gap, or d if all heights of the indenter are equal [length]
    side : side d = √(dx dy) of the square that has the area of an element [length]
    """

    length: float
    side: float

    @property
    def stiffness(self) -> float:
        """Return the factor 4π d that converts the sum of q = dP/du to the tangent stiffness k/G [length].

        d is the side of an element, `side`.
        """
        return 4 * np.pi * self.side

    @property
    def force(self) -> float:
        """Return the factor 4π d s that converts the sum of reduced pressures P to the force F/G [length²].

        d is the side of an element, `side`. s is the unit of reduced lengths, `length`.
        """
        return 4 * np.pi * self.side * self.length

    @property
    def pressure(self) -> float:
        """Return the factor 4π s/d that converts a reduced pressure P to the dimensionless pressure p/G.

        d is the side of an element, `side`. s is the unit of reduced lengths, `length`.
        """
        return 4 * np.pi * self.length / self.side


@dataclass(frozen=True)
class ElementGrid:
    """Smallest rectangle of the map of heights that contains all elements of an indenter.

    origin : first row and first column of the map that contain an element
    shape : number of rows and columns of the rectangle
    aspect : ratio dy/dx of the sides of an element
    """

    origin: tuple[int, int]
    shape: tuple[int, int]
    aspect: float

    @cached_property
    def influence(self) -> Array:
        """Return influence coefficients K as a table [distance in rows, distance in columns].

        The table is needed for contacts that are solved with a dense matrix.
        """
        rows, columns = (np.arange(n, dtype=float) for n in self.shape)
        return influence_table(rows, columns, self.aspect)


@dataclass(frozen=True)
class Elements:
    """Elements of an indenter in the order of increasing initial gap; the index of an element is called its rank.

    Only the elements with the smallest initial gaps are ranked, as far as a contact needs them. Arrays have the shape
    (ranked elements,).

    row, column : positions of the elements on the grid
    initial_gap : g, reduced
    grid : ElementGrid with all elements, ranked or not
    units : Units of the reduced quantities
    unranked : number of elements that are not ranked yet; their initial gaps are larger
    ranked_depth : all elements whose reduced initial gap does not exceed this depth are ranked
    """

    row: Integers
    column: Integers
    initial_gap: Array
    grid: ElementGrid
    units: Units
    unranked: int = field(default=0, kw_only=True)
    ranked_depth: float = field(default=np.inf, kw_only=True)

    @property
    def shape(self) -> tuple[int, int]:
        """Return the numbers of rows and columns of the grid."""
        return self.grid.shape

    @property
    def aspect(self) -> float:
        """Return the ratio dy/dx of the sides of an element."""
        return self.grid.aspect

    @property
    def influence(self) -> Array:
        """Return influence coefficients K as a table [distance in rows, distance in columns].

        The table is needed for contacts that are solved with a dense matrix.
        """
        return self.grid.influence

    @property
    def count(self) -> int:
        """Return the number of all elements, ranked or not."""
        return self.initial_gap.size + self.unranked

    def count_below(self, depth: float) -> int:
        """Return the number of ranked elements whose initial gap is below a reduced depth, so that they may touch."""
        return int(np.searchsorted(self.initial_gap, depth))

    def next_gap(self, count: int) -> float:
        """Return a lower bound of the initial gaps after the first `count` elements, infinity if there are none."""
        return float(self.initial_gap[count]) if count < self.initial_gap.size else self.ranked_depth

    def places_on_map(self, ranks: Integers | slice = slice(None)) -> tuple[Integers, Integers]:
        """Return the rows and the columns of elements in the map of heights.

        ranks : ranks of the elements; by default all ranked elements
        """
        return self.row[ranks] + self.grid.origin[0], self.column[ranks] + self.grid.origin[1]


@dataclass
class BoundedField:
    """Reduced quantity, such as a gap, at every point of a grid, with a bound on its accumulated rounding error.

    values : values on the grid and on a border around it, as a flattened array
    rounding : bound on the rounding error of every value
    """

    values: np.ndarray
    rounding: float


class ContactSet(NamedTuple):
    """Elements of a grid that are in contact.

    A flat field is the flattened array of values on the grid and on a border around it.

    inside : flat field, True for elements in contact
    places : indices of the elements in contact in a flat field, shape (count,)
    slots : indices of the elements in contact in the flattened load array of the half-space operator, which has no
        border, shape (count,)
    """

    inside: np.ndarray
    places: np.ndarray
    slots: np.ndarray


class MemberLoads(NamedTuple):
    """Loads of the elements in contact, without values for other elements.

    members : ranks of the elements in contact, increasing, shape (count,)
    pressure, tangent : P and q = dP/du of these elements, shape (count,)
    """

    members: np.ndarray
    pressure: np.ndarray
    tangent: np.ndarray


@dataclass(frozen=True)
class GridFields:
    """Reduced quantities of a contact at every point of a grid and of a border around it, as flattened arrays.

    The symbols are defined at the top of this module.

    inside : True for elements in contact
    pressure : P
    gap_change : e − g = w − u, the change of the gap since first contact. Its magnitude never exceeds the depth, while
        e can be much larger, so single precision suffices for e − g
    tangent : q = dP/du
    tangent_gap : e_q = K q − 1 = de/du, zero in contact
    initial_gap : g
    place : index of every element in the flattened arrays, in the order of the ranks
    """

    inside: np.ndarray
    pressure: np.ndarray
    gap_change: BoundedField
    tangent: np.ndarray
    tangent_gap: BoundedField
    initial_gap: np.ndarray
    place: np.ndarray

    def gap(self, places: Integers) -> Array:
        """Return the reduced gap e at the given indices of the flattened arrays."""
        return self.gap_change.values[places] + self.initial_gap[places]

    def member_loads(self) -> MemberLoads:
        """Return the loads of the elements in contact, in double precision."""
        members = np.flatnonzero(self.inside[self.place])
        place = self.place[members]
        return MemberLoads(members, self.pressure[place].astype(float), self.tangent[place].astype(float))


class TargetForce(NamedTuple):
    """Force at which a contact on a grid is to be solved.

    pressure_sum : the force as the sum ΣP of reduced pressures
    largest_depth : largest reduced depth. If the force is larger than at this depth, the contact is solved at this
        depth instead
    """

    pressure_sum: float
    largest_depth: float


@dataclass(frozen=True)
class ContactState(ABC):
    """Contact at one depth: base class of DenseContact and GridContact (see the module for symbols and reduced units).

    units : Units of the reduced quantities
    reduced_depth : u, reduced
    count : number of elements in contact
    pressure_sum, tangent_sum : reduced ΣP, and Σq. Both sums are corrected for the remaining residuals. For the given
        contact set, their errors are therefore of second order in the residuals
    residual : largest gap |e| in contact or overlap outside the contact, divided by the depth; includes a bound on
        rounding errors
    """

    units: Units
    reduced_depth: float
    count: int
    pressure_sum: float
    tangent_sum: float
    residual: float = 0.0

    @abstractmethod
    def member_loads(self) -> MemberLoads:
        """Return the loads of the elements in contact."""

    @property
    def members(self) -> Integers:
        """Return the ranks of the elements in contact, shape (count,)."""
        return self.member_loads().members

    @property
    def depth(self) -> float:
        """Return the depth u [length]."""
        return self.reduced_depth * self.units.length

    @property
    def force(self) -> float:
        """Return the force F on the indenter, divided by the shear modulus, F/G [length²]."""
        return self.pressure_sum * self.units.force

    @property
    def stiffness(self) -> float:
        """Return the tangent stiffness k = dF/du, divided by the shear modulus, k/G [length].

        It is computed as k/G = 4π d Σq, with the side d of an element, and the sum of q = dP/du over all elements.
        """
        return self.tangent_sum * self.units.stiffness


@dataclass(frozen=True)
class DenseContact(ContactState):
    """Contact solved directly, with a dense matrix; exact within rounding if `residual` is 0.

    loads : MemberLoads of the elements in contact
    """

    loads: MemberLoads = field(kw_only=True)

    def member_loads(self) -> MemberLoads:
        """Return the loads of the elements in contact."""
        return self.loads


@dataclass(frozen=True)
class GridContact(ContactState):
    """Contact solved by iteration on a grid.

    fields : GridFields of the contact
    """

    fields: GridFields = field(kw_only=True)

    def member_loads(self) -> MemberLoads:
        """Return the loads of the elements in contact, gathered from the fields at every call."""
        return self.fields.member_loads()


def unloaded_contact(units: Units) -> DenseContact:
    """Return the contact at depth zero: no pressure, and no element in contact yet."""
    nothing = np.empty(0)
    loads = MemberLoads(nothing.astype(int), nothing, nothing)
    return DenseContact(units, 0.0, 0, 0.0, 0.0, loads=loads)
