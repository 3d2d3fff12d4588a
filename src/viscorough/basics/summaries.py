"""Write numbers and units for short texts about results, for print and notebooks."""

from typing import Any


def span(values: Any, unit: str = "1") -> str:
    """Return the first and last value of an array with their unit, such as "1e-09 to 2e-07 m"."""
    first, last = with_unit(values[0]), with_unit(values[-1], unit)
    return f"{first} to {last}" if len(values) > 1 else last


def with_unit(value: float, unit: str = "1", digits: int = 4) -> str:
    """Return a number with so many digits, and its unit unless it is "1"."""
    return f"{float(value):.{digits}g}{'' if unit == '1' else f' {unit}'}"


def unit_power(unit: str, exponent: int) -> str:
    """Return a power of a unit of length, as UDUNITS spells it: m2, but (1e-6 m)2; "1" for "1"."""
    if unit == "1" or exponent == 0:
        return "1"
    if exponent == 1:
        return unit
    return f"{unit if unit.isascii() and unit.isalpha() else f'({unit})'}{exponent}"


def si_unit(unit: str, length_unit: str) -> str:
    """Return an SI unit such as "s"; "1" if the unit of length is "1", so that all units are those of the user."""
    return "1" if length_unit == "1" else unit
