"""Short texts about a result: lines for print and for notebooks."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from viscorough.types import Array

# A title, and the quantities and texts of each line.
Summary = tuple[str, *tuple[Sequence[tuple[str, str]], ...]]


class Summarised(ABC):
    """A result with the method `_summary`, which gives a title, and rows of (quantity, text), one for each line."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        # Else that of a dataclass, with all numbers of its arrays.
        cls.__repr__ = Summarised.__str__  # type: ignore[assignment, method-assign]  # defined for objects of all kinds

    @abstractmethod
    def _summary(self) -> Summary: ...

    def __str__(self) -> str:
        title, *lines = self._summary()
        return "\n".join([title, *(", ".join(f"{name} {text}" for name, text in line) for line in lines)])


def span(values: Array, unit: str = "1") -> str:
    """First and last of some values, with their unit: "1e-09 to 2e-07 m"."""
    first, last = (f"{float(values[i]):.4g}" for i in (0, -1))
    return f"{first} to {last}{'' if unit == '1' else f' {unit}'}" if len(values) > 1 else with_unit(values[0], unit)


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


def velocity_unit(unit: str) -> str:
    """The unit of a velocity with times in s: "um s-1"; "s-1" for "1", a unit of length that is not known."""
    return "s-1" if unit == "1" else f"{unit} s-1"
