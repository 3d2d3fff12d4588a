"""Numbers and units in short texts about a result, for print and for notebooks."""

from typing import Any


def span(values: Any, unit: str = "1") -> str:
    """First and last of an array of values, with their unit: "1e-09 to 2e-07 m"."""
    first, last = with_unit(values[0]), with_unit(values[-1], unit)
    return f"{first} to {last}" if len(values) > 1 else last


def with_unit(value: float, unit: str = "1", digits: int = 4) -> str:
    """A number of so many digits, with its unit unless that is "1"."""
    return f"{float(value):.{digits}g}{'' if unit == '1' else f' {unit}'}"


def unit_power(unit: str, exponent: int) -> str:
    """A unit of length to a power, as UDUNITS spells it: m2, but (1e-6 m)2; "1" for "1"."""
    if unit == "1" or exponent == 0:
        return "1"
    if exponent == 1:
        return unit
    return f"{unit if unit.isascii() and unit.isalpha() else f'({unit})'}{exponent}"


def si_unit(unit: str, length_unit: str) -> str:
    """An SI unit such as "s" or "Pa"; "1" where the unit of length is "1", so that all units are those of the user."""
    return "1" if length_unit == "1" else unit
