"""Define the result of a single contact: maps of pressure, gap and contact, with areas, pressures and patches."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viscorough.basics.arrays import real_number
from viscorough.basics.summaries import InNotebooks, si_unit, span, with_unit
from viscorough.basics.types import Mask

# The area of the elements in contact is too large, because elements at the edge of the contact are counted as a whole.
# For each pair of neighbouring elements of which only one is in contact, the area is too large by this share of an
# element on average.
EXCESS_PER_CHANGE = (np.pi - 1 + np.log(2)) / 24


class Patches(NamedTuple):
    """Contact patches of a map: connected regions of elements in contact.

    Attributes
    ----------
    labels : array
        For each element, the number of the patch that contains it: 1 for the largest patch, 2 for the second largest,
        and so on; 0 for elements without contact.
    areas : array
        Areas of the patches, the largest first, shape (patches,) [length²].
    """

    labels: np.ndarray
    areas: np.ndarray

    def __repr__(self) -> str:
        """Return a text with the number of the patches and the range of their areas, without the map."""
        areas = f", areas {span(self.areas)}" if len(self.areas) else ""
        return f"Patches: {len(self.areas)} of the contact{areas}"


@dataclass(frozen=True, eq=False)
class Contact(InNotebooks):
    """Contact of a rigid indenter with an elastic half-space at one depth, the result of `contact_at`.

    Attributes
    ----------
    pressure : array
        Pressure p/G, with G the shear modulus of the incompressible half-space, shape (rows, columns). It is zero
        outside the contact and nan outside the indenter.
    gap : array
        Gap between the deformed surface and the indenter, nan outside the indenter [length]. In contact its magnitude
        is at most `residual` times the depth. Elsewhere it may be negative by at most the same amount.
    contact : array
        True for elements in contact, which are the elements with a pressure above zero.
    depth : float
        Depth u from first contact [length].
    force : float
        Force F/G, the sum of p/G times the area of an element [length²].
    stiffness : float
        Tangent stiffness k/G = d(F/G)/du of the elements in contact [length].
    residual : float
        Largest gap in contact or overlap outside the contact, divided by the depth, rounding included.
    tolerance : float
        Requested upper bound of the residual.
    spacing, row_spacing : float
        Distances dx and dy between neighbouring columns and rows [length].
    length_unit : str
        "m" if numbers are in SI units, "1" if they are in consistent units that are not known.
    column_positions, row_positions : array or None
        Coordinates of the columns and rows, as the indenter has them [length].

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> contact = viscorough.contact_at(disc, depth=0.005)
    >>> contact.pressure.shape, bool(contact.contact.any())
    ((17, 17), True)
    """

    pressure: np.ndarray
    gap: np.ndarray
    contact: Mask
    depth: float
    force: float
    stiffness: float
    residual: float
    tolerance: float
    spacing: float
    row_spacing: float
    length_unit: str = "1"
    column_positions: np.ndarray | None = None
    row_positions: np.ndarray | None = None

    def __post_init__(self) -> None:
        for name in ("depth", "force", "stiffness", "residual", "tolerance", "spacing", "row_spacing"):
            real_number(f"Contact: {name}", getattr(self, name))
        if not self.pressure.shape == self.gap.shape == self.contact.shape:
            shapes = f"{self.pressure.shape}, {self.gap.shape} and {self.contact.shape}"
            raise ValueError(f"Contact: pressure, gap and contact have the shapes {shapes}; one shape is needed")

    def __repr__(self) -> str:
        """Return a summary: number of elements in contact, depth, force, stiffness, contact area and pressure."""
        unit, area = self.length_unit, si_unit("m2", self.length_unit)
        return (
            f"Contact of {self.contact_count} of {self.elements} elements\n"
            f"depth u {with_unit(self.depth, unit)}, force F/G {with_unit(self.force, area)}, "
            f"stiffness k/G {with_unit(self.stiffness, unit)}\n"
            f"contact area {with_unit(self.contact_area, area)} ({100 * self.contact_fraction:.3g} %), "
            f"corrected {with_unit(self.corrected_contact_area, area)}, "
            f"mean p/G {with_unit(self.mean_pressure)}, largest p/G {with_unit(self.largest_pressure)}"
        )

    @property
    def elements(self) -> int:
        """Return the number of elements of the indenter."""
        return int(np.count_nonzero(~np.isnan(self.pressure)))

    @property
    def contact_count(self) -> int:
        """Return the number of elements in contact."""
        return int(np.count_nonzero(self.contact))

    @property
    def contact_fraction(self) -> float:
        """Return the share of the indenter's elements that are in contact."""
        return self.contact_count / self.elements

    @property
    def contact_area(self) -> float:
        """Return the area of the elements in contact [length²]."""
        return self.contact_count * self.spacing * self.row_spacing

    @property
    def corrected_contact_area(self) -> float:
        """Return the contact area, corrected for the error of counting whole elements [length²].

        The area A of the elements in contact is too large, since an element at the edge of the contact is only partly
        in contact. The corrected area is A* = A − ((π − 1 + ln 2)/24) M dx dy. M is the number of pairs of neighbouring
        elements, along rows and columns, of which only one element is in contact. Pairs at the edge of the indenter do
        not count. The formula for square elements also holds for rectangular elements, because stretching a map changes
        neither M nor A/(dx dy).

        Source: V. A. Yastrebov, G. Anciaux, J.-F. Molinari, Tribology International 114, 161 (2017).
        """
        inside, changes = ~np.isnan(self.pressure), 0
        for contact, within in ((self.contact, inside), (self.contact.T, inside.T)):
            changes += np.count_nonzero((contact[1:] != contact[:-1]) & within[1:] & within[:-1])
        return self.contact_area - float(EXCESS_PER_CHANGE * changes * self.spacing * self.row_spacing)

    @property
    def mean_pressure(self) -> float:
        """Return the mean pressure in the contact, divided by the shear modulus, ⟨p⟩/G (dimensionless)."""
        return self.force / self.contact_area

    @property
    def largest_pressure(self) -> float:
        """Return the largest pressure, divided by the shear modulus, max p/G (dimensionless)."""
        return float(np.nanmax(self.pressure))

    def patches(self) -> Patches:
        """Return the Patches of the contact. Two elements in contact with a common side belong to the same patch."""
        from scipy import ndimage  # imported here, because this import is slow

        labels, count = ndimage.label(self.contact)
        sizes = np.bincount(labels.ravel(), minlength=count + 1)[1:]
        order = np.argsort(-sizes, kind="stable")
        rank = np.append(0, 1 + np.argsort(order)).astype(labels.dtype)
        return Patches(rank[labels], sizes[order] * self.spacing * self.row_spacing)
