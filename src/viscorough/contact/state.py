"""Define the types that the parts of the contact solver exchange, and their symbols.

For elements of sides dx and dy on an incompressible half-space of shear modulus G, with d = √(dx dy):

    u                  depth of the indenter below first contact
    g                  initial gap, between the undeformed surfaces at first contact
    P = p d/(4πG)      pressure p of an element, expressed as a length
    K                  influence coefficients, dimensionless: w = K P is the deflection of the surface
    e = w − u + g      gap between the deformed surfaces, zero in contact
    q = dP/du          tangent, dimensionless: K q = 1 on the contact set, q = 0 outside it
    e_q = K q − 1      tangent gap de/du, dimensionless, zero in contact

Inside the solver, u, g, P and e are in units of the largest initial gap, so results do not depend on the user's unit of
length; such quantities are called reduced. `Units` holds the factors that convert them.
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

    length : the largest initial gap, or the side d for an indenter of one height [length]
    side : d, the side of the square with the area of an element [length]
    """

    length: float
    side: float

    @property
    def stiffness(self) -> float:
        """Return the factor 4π d of the tangent stiffness k/G = 4π d Σq [length]."""
        return 4 * np.pi * self.side

    @property
    def force(self) -> float:
        """Return the factor of the force F/G = 4π d ΣP [length²]."""
        return 4 * np.pi * self.side * self.length

    @property
    def pressure(self) -> float:
        """Return the factor of the pressure p/G = 4π P/d [1]."""
        return 4 * np.pi * self.length / self.side


@dataclass(frozen=True)
class ElementGrid:
    """The smallest grid with all elements of an indenter.

    origin : first row and column of the indenter's heights that have an element
    shape : rows and columns
    aspect : dy/dx of the elements
    """

    origin: tuple[int, int]
    shape: tuple[int, int]
    aspect: float

    @cached_property
    def influence(self) -> Array:
        """Return influence coefficients K by distance in rows and columns, for dense solutions."""
        rows, columns = (np.arange(n, dtype=float) for n in self.shape)
        return influence_table(rows, columns, self.aspect)


@dataclass(frozen=True)
class Elements:
    """The elements of an indenter, ranked in the order of increasing initial gap; arrays of shape (ranked elements,).

    row, column : positions on the grid
    initial_gap : g, reduced
    grid : ElementGrid
    units : Units of the reduced quantities
    unranked : number of further elements, with larger initial gaps
    ranked_depth : all elements up to this depth are ranked
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
        """Return rows and columns of the grid."""
        return self.grid.shape

    @property
    def aspect(self) -> float:
        """Return dy/dx of the elements."""
        return self.grid.aspect

    @property
    def influence(self) -> Array:
        """Return influence coefficients K by distance in rows and columns, for dense solutions."""
        return self.grid.influence

    @property
    def count(self) -> int:
        """Return the number of elements."""
        return self.initial_gap.size + self.unranked

    def count_below(self, depth: float) -> int:
        """Return the number of ranked elements with initial gaps below a reduced depth: only these can touch at it."""
        return int(np.searchsorted(self.initial_gap, depth))

    def next_gap(self, count: int) -> float:
        """Return a lower bound of the initial gaps after the `count` first elements; infinite if there are no more."""
        return float(self.initial_gap[count]) if count < self.initial_gap.size else self.ranked_depth

    def places_on_map(self, ranks: Integers | slice = slice(None)) -> tuple[Integers, Integers]:
        """Return rows and columns in the indenter's heights of elements of given ranks, or of all ranked elements."""
        return self.row[ranks] + self.grid.origin[0], self.column[ranks] + self.grid.origin[1]


@dataclass
class BoundedField:
    """A reduced field on the grid, as a flat array, and a bound on the rounding error accumulated in it."""

    values: np.ndarray
    rounding: float


class ContactSet(NamedTuple):
    """The elements of a grid that are in contact.

    inside : for every place of the flat grid, True if it is in contact
    places : indices of the elements in contact in flat fields, shape (count,)
    slots : indices of the same elements in the flattened load array of the half-space operator, which has no border
    """

    inside: np.ndarray
    places: np.ndarray
    slots: np.ndarray


class MemberLoads(NamedTuple):
    """Loads of the elements in contact, without the fields of a grid.

    members : elements in contact, as ranks, increasing, shape (count,)
    pressure, tangent : P and q = dP/du on the members, shape (count,)
    """

    members: np.ndarray
    pressure: np.ndarray
    tangent: np.ndarray


@dataclass(frozen=True)
class GridFields:
    """A contact on the grid: reduced fields as flat arrays with a border.

    inside : True for places in contact
    pressure : P
    gap_change : e − g = w − u, the change of the gap since first contact; unlike e it does not exceed the depth, so
        single precision suffices for it
    tangent : q = dP/du
    tangent_gap : e_q = K q − 1 = de/du, zero in contact
    initial_gap : g
    place : indices of the elements in the flat arrays, by rank
    """

    inside: np.ndarray
    pressure: np.ndarray
    gap_change: BoundedField
    tangent: np.ndarray
    tangent_gap: BoundedField
    initial_gap: np.ndarray
    place: np.ndarray

    def gap(self, places: Integers) -> Array:
        """Return the reduced gap e at places of the flat arrays."""
        return self.gap_change.values[places] + self.initial_gap[places]

    def member_loads(self) -> MemberLoads:
        """Return the MemberLoads, in double precision."""
        members = np.flatnonzero(self.inside[self.place])
        place = self.place[members]
        return MemberLoads(members, self.pressure[place].astype(float), self.tangent[place].astype(float))


class TargetForce(NamedTuple):
    """Force to be met by a contact on a grid.

    pressure_sum : reduced ΣP to be met
    largest_depth : largest reduced depth; there a smaller sum is accepted
    """

    pressure_sum: float
    largest_depth: float


@dataclass(frozen=True)
class ContactState(ABC):
    """The contact at one depth: the quantities that a dense contact and a contact on a grid have in common.

    units : Units of the reduced quantities
    reduced_depth : u
    count : number of elements in contact
    pressure_sum, tangent_sum : reduced ΣP, and Σq, corrected for the remaining residuals; both errors are then of
        second order in the residuals for the given contact set
    residual : largest |e| on the contact set or overlap outside it, rounding included, over the depth
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
        """Return elements in contact as ranks, shape (count,)."""
        return self.member_loads().members

    @property
    def depth(self) -> float:
        """Return the depth u [length]."""
        return self.reduced_depth * self.units.length

    @property
    def force(self) -> float:
        """Return F/G = 4π d ΣP [length²]."""
        return self.pressure_sum * self.units.force

    @property
    def stiffness(self) -> float:
        """Return the tangent stiffness k/G = 4π d Σq [length]."""
        return self.tangent_sum * self.units.stiffness


@dataclass(frozen=True)
class DenseContact(ContactState):
    """A contact from dense linear algebra, exact to rounding unless it has a residual.

    loads : MemberLoads of the elements in contact
    """

    loads: MemberLoads = field(kw_only=True)

    def member_loads(self) -> MemberLoads:
        """Return the loads of the elements in contact."""
        return self.loads


@dataclass(frozen=True)
class GridContact(ContactState):
    """A contact on a grid, solved by iteration.

    fields : GridFields of the contact
    """

    fields: GridFields = field(kw_only=True)

    def member_loads(self) -> MemberLoads:
        """Gather the loads of the elements in contact from the fields; they are not stored."""
        return self.fields.member_loads()


def unloaded_contact(units: Units) -> DenseContact:
    """Return the contact at depth zero: no pressure, and no element in contact yet."""
    nothing = np.empty(0)
    loads = MemberLoads(nothing.astype(int), nothing, nothing)
    return DenseContact(units, 0.0, 0, 0.0, 0.0, loads=loads)
