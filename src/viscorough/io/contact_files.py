"""Convert contacts to the content of NetCDF files: maps with coordinates, and numbers such as depth and force."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import DTypeLike

from viscorough.basics.types import Array
from viscorough.io.curves import OVER_LEVELS, WITH_MODULUS, described, padded
from viscorough.io.heights import positions_of
from viscorough.io.netcdf import Content
from viscorough.results.contact_maps import Contact

COMMENT = (
    "Rigid indenter on an incompressible half-space, no friction, no adhesion. Depth is from first contact, "
    "force is F/G, the sum of pressure times the area of an element, pressure is p/G, stiffness is d(F/G)/du. Gap is "
    "deflection - depth + initial gap, the initial gap being the depth of heights below their highest; the deflection "
    "of an element is the sum of sqrt(dx dy)/(4 pi) K pressure, K Love's influence coefficients. In contact, the gap "
    "is zero within residual times depth. Patches are regions in contact that are connected by sides of elements."
)
# Maps of a contact: {name: (long_name, SI unit)}.
MAPS = {
    "pressure": ("pressure over shear modulus p/G", "1"),
    "gap": ("gap between the deformed surface and the indenter", "m"),
    "contact": ("whether an element is in contact", "1"),
}
# Variables with a single number for each contact: {name: (long_name, SI unit)}.
NUMBERS = {
    **{name: OVER_LEVELS[name] for name in ("depth", "force", "stiffness", "contact_fraction")},
    "contact_area": ("area of the elements in contact", "m2"),
    "corrected_contact_area": ("contact area less what elements at its edge add", "m2"),
    "mean_pressure": ("mean pressure in contact over shear modulus", "1"),
    "largest_pressure": ("largest pressure over shear modulus", "1"),
    "residual": OVER_LEVELS["residual"],
}
# Additional variables with a single number for each contact, if the shear modulus is given: {name: (long_name, unit)}.
NUMBERS_WITH_MODULUS = {
    **WITH_MODULUS,
    "mean_normal_pressure": ("mean normal pressure p", "Pa"),
    "largest_normal_pressure": ("largest normal pressure p", "Pa"),
}
# Names of these variables, F, k and p, by the quantities F/G, k/G and p/G that G multiplies.
NAMES_WITH_MODULUS = {
    "force": "normal_force",
    "stiffness": "normal_stiffness",
    "mean_pressure": "mean_normal_pressure",
    "largest_pressure": "largest_normal_pressure",
}
# Additional map of a contact, if the shear modulus is given: {name: (long_name, unit)}.
_MAP_WITH_MODULUS = {"normal_pressure": ("normal pressure p", "Pa")}
PATCHES = {"patches": ("number of patches of contact", "1"), "patch_area": ("area of a patch", "m2")}
# Store maps in single precision if the tolerance is at least this: the solver then uses single precision, too.
_SINGLE_FROM = 1e-4
# Store maps in single precision only if their numbers are in this range. Single precision reaches from 1e-38 to 3e38.
_SINGLE_RANGE = (1e-25, 1e30)


def contacts_to_content(
    contacts: Sequence[Contact], heights: Array | None = None, shear_modulus: float | None = None
) -> Content:
    """Convert contacts of one indenter to the content of a NetCDF file.

    The variables MAPS and `heights` have the dimensions (y, x). The coordinates y and x are those of the
    indenter, or 0 at the centre of the map.
    The variables NUMBERS and `patches` (number of contact patches) are single numbers. `patch_area` has the dimension
    `patch` and lists the areas of the patches in decreasing order, filled up with nan. For several contacts, all these
    variables except `heights` have the first dimension `level`, with one level for each contact.

    heights : heights of the indenter, shape (rows, columns) [length]; None to leave them out
    shear_modulus : G [Pa], or in consistent units; if it is given, the variables NUMBERS_WITH_MODULUS and a map of
        normal pressures are added
    """
    first = contacts[0]
    unit, level = first.length_unit, ("level",) if len(contacts) > 1 else ()

    variables = positions_of(first, first.gap.shape)

    def add(dimensions: tuple[str, ...], quantities: dict[str, tuple[str, str]], **values: Sequence[Any]) -> None:
        for name, each in values.items():
            stacked = np.stack(each) if level else np.asarray(each[0])
            variables[name] = (*level, *dimensions), stacked, described(*quantities[name], unit)

    if heights is not None:
        variables["heights"] = ("y", "x"), heights, {"long_name": "height", "units": unit}
    kinds = dict.fromkeys(MAPS, _kind_of_maps(contacts)) | {"contact": np.int8}
    maps = {name: [getattr(contact, name).astype(kind) for contact in contacts] for name, kind in kinds.items()}
    add(("y", "x"), MAPS, **maps)
    variables["contact"][2].update(flag_values=np.array([0, 1], np.int8), flag_meanings="apart in_contact")
    add((), NUMBERS, **{name: [getattr(contact, name) for contact in contacts] for name in NUMBERS})
    if shear_modulus is not None:
        for name, new in NAMES_WITH_MODULUS.items():
            numbers = [shear_modulus * getattr(contact, name) for contact in contacts]
            add((), NUMBERS_WITH_MODULUS, **{new: numbers})
        add(("y", "x"), _MAP_WITH_MODULUS, normal_pressure=[shear_modulus * each for each in maps["pressure"]])
    areas = [contact.patches().areas for contact in contacts]
    add((), PATCHES, patches=[len(patch_areas) for patch_areas in areas])
    add(("patch",), PATCHES, patch_area=list(padded(areas)))
    about = {"title": "Contact of a rigid indenter with an elastic half-space", "comment": COMMENT}
    return variables, about | {"tolerance": first.tolerance, "spacing": [first.spacing, first.row_spacing]}


def _kind_of_maps(contacts: Sequence[Contact]) -> DTypeLike:
    """Return the floating-point type in which maps of pressure and gap are stored."""
    least, largest = _SINGLE_RANGE
    small = min(min(contact.depth, contact.mean_pressure) for contact in contacts)
    large = max(max(contact.largest_pressure, np.nanmax(contact.gap)) for contact in contacts)
    fits = contacts[0].tolerance >= _SINGLE_FROM and small > least and large < largest
    return np.float32 if fits else np.float64
