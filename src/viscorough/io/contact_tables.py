"""Convert contacts to tables with one row for each load, in the units in which people read results.

Lengths are in um and areas in um2. If the shear modulus is given, forces are in N, stiffnesses in N/m and pressures in
MPa. For the units in other cases see `result_units`.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from viscorough.basics import summaries
from viscorough.basics.types import Array
from viscorough.io.contact_files import NAMES_WITH_MODULUS, NUMBERS, NUMBERS_WITH_MODULUS, PATCHES
from viscorough.io.curves import ABOUT_GRID, OVER_LEVELS
from viscorough.io.netcdf import Content
from viscorough.results.contact_maps import Contact

# Quantities in tables: {quantity: key under which result_units gives its unit; None for counts and shares}.
MEASURES = {
    "depth": "length",
    "force": "force",
    "stiffness": "stiffness",
    "contact_fraction": None,
    "contact_area": "area",
    "corrected_contact_area": "area",
    "mean_pressure": "pressure",
    "largest_pressure": "pressure",
    "patches": None,
    **dict.fromkeys(ABOUT_GRID),
}
# Quantities in tables that are attributes of a Contact.
_OF_CONTACT = [name for name in MEASURES if name != "patches" and name not in ABOUT_GRID]
# Quantities that users may prescribe. They are shown with six digits, and all other quantities with four.
_PRESCRIBED = ("depth", "force", "normal_force")
# {column: meaning}, of all columns that a table of contacts may have.
MEANINGS = {
    name: text for name, (text, _) in (OVER_LEVELS | ABOUT_GRID | NUMBERS | NUMBERS_WITH_MODULUS | PATCHES).items()
}

Table = dict[str, tuple[Array, str]]  # {column: (its values, their unit)}


class ResultUnit(NamedTuple):
    """Unit in which people read a quantity: the name of the unit, and the factor that converts a result of the solver.

    Results of the solver are lengths, areas, and the ratios F/G, k/G and p/G of force, stiffness and pressure to the
    shear modulus.
    """

    name: str
    factor: float

    def text(self, value: float, digits: int = 4) -> str:
        """Convert a result of the solver to this unit, and return it as text."""
        return summaries.with_unit(value * self.factor, self.name, digits)


def result_units(length_unit: str, shear_modulus: float | None) -> dict[str, ResultUnit]:
    """Return the units in which people read results: {"length", "area", "force", "stiffness", "pressure": ResultUnit}.

    Lengths are in um and areas in um2. If the shear modulus [Pa] is given, forces are in N, stiffnesses in N/m and
    pressures in MPa; otherwise they are F/G in um2, k/G in um and p/G without a unit ("1"). If `length_unit` is "1",
    all numbers are in consistent units, which are called "1".
    """
    if length_unit == "1":
        modulus = 1.0 if shear_modulus is None else shear_modulus
        factors = {"length": 1.0, "area": 1.0, "force": modulus, "stiffness": modulus, "pressure": modulus}
        return {name: ResultUnit("1", factor) for name, factor in factors.items()}
    length, area = ResultUnit("um", 1e6), ResultUnit("um2", 1e12)
    if shear_modulus is None:
        return {"length": length, "area": area, "force": area, "stiffness": length, "pressure": ResultUnit("1", 1.0)}
    return {
        "length": length,
        "area": area,
        "force": ResultUnit("N", shear_modulus),
        "stiffness": ResultUnit("N/m", shear_modulus),
        "pressure": ResultUnit("MPa", shear_modulus * 1e-6),
    }


def table_of_contacts(
    contacts: Sequence[Contact], shear_modulus: float | None = None, grid_errors: dict[str, Array] | None = None
) -> Table:
    """Return the table of contacts of one indenter, with one row for each contact, in the units of result_units.

    shear_modulus : G [Pa], or in consistent units; None if forces are F/G
    grid_errors : {quantity in io.curves.ABOUT_GRID: its value for each contact}; None for a table without grid errors
    """
    values: dict[str, Any] = {name: [getattr(each, name) for each in contacts] for name in _OF_CONTACT}
    values["patches"] = [contact.patches().areas.size for contact in contacts]
    read = result_units(contacts[0].length_unit, shear_modulus)
    table = {}
    for quantity, numbers in (values | (grid_errors or {})).items():
        measure = MEASURES[quantity]
        unit = ResultUnit("1", 1.0) if measure is None else read[measure]
        name = quantity if shear_modulus is None else NAMES_WITH_MODULUS.get(quantity, quantity)
        column = numbers if quantity == "patches" else [_rounded(number * unit.factor) for number in numbers]
        table[name] = np.array(column), unit.name
    return table


def _rounded(number: float) -> float:
    """Round a number to 15 digits. A force of 5 uN is thus exactly 5e-06 N after a conversion to F/G and back."""
    return float(f"{number:.15g}")


def text_of_last(table: Table) -> str:
    """Return one line of text with the main numbers of the last contact in a table of contacts."""

    def text(name: str) -> str:
        values, unit = table[name]
        return ResultUnit(unit, 1.0).text(values[-1], 6 if name in _PRESCRIBED else 4)

    parts = [f"depth {text('depth')}"]
    if "normal_force" in table:
        parts += [f"F {text('normal_force')}", f"largest p {text('largest_normal_pressure')}"]
        parts += [f"k {text('normal_stiffness')}"]
    else:
        parts += [f"F/G {text('force')}"]
    parts += [f"contact fraction {text('contact_fraction')}", f"contact area {text('contact_area')}"]
    parts[-1] += f" (corrected {text('corrected_contact_area')})"
    patches = table["patches"][0][-1]
    return ", ".join([*parts, f"{patches} patch{'' if patches == 1 else 'es'}"])


def table_to_content(table: Table) -> Content:
    """Convert a table of contacts to the content of a file with one row for each contact."""
    variables: dict[str, Any] = {
        name: (("row",), values, {"long_name": MEANINGS[name], "units": unit}) for name, (values, unit) in table.items()
    }
    return variables, {"title": "Contacts of a rigid indenter with an elastic half-space"}
