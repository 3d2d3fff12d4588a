"""One contact of an indenter: maps of pressure, gap and contact, and what follows from them."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viscorough.arrays import ReadOnlyArrays, ReadOnlyTuple, real_number
from viscorough.summaries import span, unit_power, with_unit
from viscorough.types import Mask
from viscorough.units import in_metres, result_units, square_metres

# Mean area by which a whole element exceeds the contact, per change of contact between two elements, over dx dy.
EXCESS_PER_CHANGE = (np.pi - 1 + np.log(2)) / 24


class _Patches(NamedTuple):
    labels: np.ndarray
    areas: np.ndarray


class Patches(ReadOnlyTuple, _Patches):
    """The contact patches of a map: connected regions of elements in contact.

    Attributes
    ----------
    labels : array
        Map, 0 where there is no contact and 1 … n in the patches, the largest first.
    areas : array
        Of the patches in this order, shape (n,) [length²].
    """

    __slots__ = ()

    def __repr__(self) -> str:
        """Number and areas of the patches, instead of the map."""
        areas = f", areas {span(self.areas)}" if len(self.areas) else ""
        return f"Patches: {len(self.areas)} of the contact{areas}"


@dataclass(frozen=True)
class Contact(ReadOnlyArrays):
    """The contact of a rigid indenter with an elastic half-space at one depth, as `contact_at` returns it.

    Arrays are copied and read-only.

    Attributes
    ----------
    pressure : array
        p/G, G the shear modulus of the incompressible half-space; zero outside the contact, nan outside the indenter;
        shape (rows, columns) of the heights [1].
    gap : array
        Between the deformed surface and the indenter; nan outside the indenter [length]. In contact it is zero within
        `residual` times the depth, and nowhere is it below zero by more than that.
    contact : array
        Whether an element is in contact, which is where the pressure is above zero.
    depth : float
        u, from first contact [length].
    force : float
        F/G, the sum of the pressures times the area of an element [length²].
    stiffness : float
        k/G = d(F/G)/du, of the elements in contact [length].
    residual : float
        Largest gap in contact or overlap outside it, rounding included, over the depth [1].
    tolerance : float
        Requested bound of the residual.
    spacing, row_spacing : float
        Distances between neighbouring columns and rows, dx and dy [length].
    length_unit : str
        Unit of all lengths; "1" if it is not known.
    shear_modulus : float or None
        G [Pa], or in consistent units if the unit of length is not known; None if it is not known.

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
    shear_modulus: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("depth", "force", "stiffness", "residual", "tolerance", "spacing", "row_spacing"):
            real_number(f"Contact: {name}", getattr(self, name))
        if self.shear_modulus is not None:
            real_number("Contact: shear_modulus", self.shear_modulus)
        if not self.pressure.shape == self.gap.shape == self.contact.shape:
            shapes = f"{self.pressure.shape}, {self.gap.shape} and {self.contact.shape}"
            raise ValueError(f"Contact: pressure, gap and contact have the shapes {shapes}; one shape is needed")

    def __str__(self) -> str:
        """What it is; depth, force and stiffness; contact and pressure."""
        unit, area = self.length_unit, unit_power(self.length_unit, 2)
        text = (
            f"Contact of {self.contact_count} of {self.elements} elements\n"
            f"depth u {with_unit(self.depth, unit)}, force F/G {with_unit(self.force, area)}, "
            f"stiffness k/G {with_unit(self.stiffness, unit)}\n"
            f"contact area {with_unit(self.contact_area, area)} ({100 * self.contact_fraction:.3g} %), "
            f"corrected {with_unit(self.corrected_contact_area, area)}, "
            f"mean p/G {with_unit(self.mean_pressure)}, largest p/G {with_unit(self.largest_pressure)}"
        )
        if self.shear_modulus is not None:
            read = result_units(unit, self.shear_modulus)
            text += f"\nforce F {read['force'].text(self.force)}, mean p {read['pressure'].text(self.mean_pressure)}, "
            text += f"largest p {read['pressure'].text(self.largest_pressure)}, "
            text += f"stiffness k {read['stiffness'].text(self.stiffness)}"
        return text

    @property
    def normal_force(self) -> float | None:
        """Force F [N], or in consistent units if the unit of length is not known; None without a shear modulus."""
        if self.shear_modulus is None:
            return None
        return self.force * self.shear_modulus * square_metres(self.length_unit)

    @property
    def normal_stiffness(self) -> float | None:
        """Stiffness k = dF/du [N/m], or in consistent units as `normal_force`; None without a shear modulus."""
        if self.shear_modulus is None:
            return None
        return self.stiffness * self.shear_modulus * in_metres(self.length_unit)

    @property
    def elements(self) -> int:
        """Number of elements of the indenter."""
        return int(np.count_nonzero(~np.isnan(self.pressure)))

    @property
    def contact_count(self) -> int:
        """Number of elements in contact."""
        return int(np.count_nonzero(self.contact))

    @property
    def contact_fraction(self) -> float:
        """Share of the indenter's elements that are in contact."""
        return self.contact_count / self.elements

    @property
    def contact_area(self) -> float:
        """Area of the elements in contact [length²]."""
        return self.contact_count * self.spacing * self.row_spacing

    @property
    def corrected_contact_area(self) -> float:
        """Area of the contact, whose edge cuts elements that `contact_area` counts whole [length²].

        A* = A − ((π − 1 + ln 2)/24) M dx dy, with M the number of changes between contact and no contact along all rows
        and columns of the indenter; its own edge counts none. A stretch that makes squares of the elements leaves M
        and ratios of areas as they are, hence dx dy.

        Source: V. A. Yastrebov, G. Anciaux, J.-F. Molinari, Tribology International 114, 161 (2017).
        """
        inside, changes = ~np.isnan(self.pressure), 0
        for contact, known in ((self.contact, inside), (self.contact.T, inside.T)):
            changes += np.count_nonzero((contact[1:] != contact[:-1]) & known[1:] & known[:-1])
        return self.contact_area - float(EXCESS_PER_CHANGE * changes * self.spacing * self.row_spacing)

    @property
    def mean_pressure(self) -> float:
        """Mean of p/G over the contact [1]."""
        return self.force / self.contact_area

    @property
    def largest_pressure(self) -> float:
        """Largest p/G [1]."""
        return float(np.nanmax(self.pressure))

    def patches(self) -> Patches:
        """The Patches of the contact: regions of elements in contact that are connected by their sides."""
        from scipy import ndimage  # takes long to import

        labels, count = ndimage.label(self.contact)
        sizes = np.bincount(labels.ravel(), minlength=count + 1)[1:]
        order = np.argsort(-sizes, kind="stable")
        rank = np.append(0, 1 + np.argsort(order)).astype(labels.dtype)
        return Patches(rank[labels], sizes[order] * self.spacing * self.row_spacing)
