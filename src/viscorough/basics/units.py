"""Read and convert units as users and files write them: "um", "1e-6 m", "µm", "micron", "Pa s", "N s m-2".

Results spell units like UDUNITS, the units library of the CF conventions: a number after a unit is its exponent, as in
m2. The library pint converts units. Since the import of pint takes a second, it is not used for the lengths in METRES.
The unit "1" means that the unit of length is not known. Only the command line and the readers and writers of files use
this module: inside the library, numbers are in SI units, or in consistent units that are not known.
"""

import contextlib
import functools
import math
import re
from dataclasses import dataclass
from typing import Any

from viscorough.basics.summaries import LENGTH_POWERS, METRES

UNKNOWN = "1"
# These patterns are compiled at their first use, so that the command line starts faster.
_ALLOWED = r"[\w.()+\-*/^ µμÅ°·⋅\"'%]{1,60}"
_POWER = r"(?<![\w.])([^\W\d_]+|(?<=[(*/ ])[^\W\d_]+)([+-]?\d)(?![\w.])|\)([+-]?\d)(?![\w.])"
_LONG_POWER = r"(\*\*|\^)(?!\s*[+-]?\d(?![\d.eE]|\s*(\*\*|\^)))"
_POINTS = r"(?i:px|pix|pixels?|pts?|points?|dots?|samples?|punkte?|bildpunkte?)"
# pint takes units whose names end in these words for printers' units of length. In files of heights they mean points of
# the map, so they are refused.
_PRINTED = ("pixel", "point", "pica", "didot", "cicero")
_DECIMAL_COMMA = r"\s*[+-]?\d*,\d+(?:[eE][+-]?\d+)?(?:\s*[^\d\s,].*)?"
_QUANTITY = r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.+?)\s*"


@dataclass(frozen=True)
class Quantity:
    """Number with a unit; the unit is "" for a plain number."""

    number: float
    unit: str = ""

    def to(self, unit: str) -> float:
        """Convert the number to another unit; a plain number is returned unchanged. Raises the errors of `factor`."""
        return self.number * factor(self.unit, unit) if self.unit else self.number

    def __str__(self) -> str:
        return f"{self.number:g} {self.unit}".rstrip()


def quantity(text: str) -> Quantity:
    """Read the Quantity in a text such as "5 mN", "1e6 Pa s" or "2". Raises ValueError for other texts."""
    with contextlib.suppress(ValueError):
        return Quantity(float(text))
    match = re.fullmatch(_QUANTITY, text)
    if re.fullmatch(_DECIMAL_COMMA, text):
        raise ValueError(f"{text!r} has a comma in its number; write {text.strip().replace(',', '.')!r}")
    if match is None:
        raise ValueError(f"{text!r} is not a number, with or without a unit")
    _parsed(match[2])
    return Quantity(float(match[1]), match[2])


def in_si(stated: Quantity, unit: str, length_unit: str, name: str) -> float:
    """Convert a number with or without a unit to a finite number in the SI unit `unit`.

    length_unit : unit of a plain length. If it is "1" (not known), numbers are in consistent units and are returned
        unchanged

    Raises ValueError, with a message that starts with `name`, for a unit of another dimension, and for any unit if the
    unit of length is not known.
    """
    if stated.unit and length_unit == UNKNOWN:
        text = f"{name} {stated}: needs a plain number, since the unit of length is not known"
        raise ValueError(f"{text}; argument unit where heights are read states it")
    if not stated.unit and unit == "m" and length_unit != UNKNOWN:
        stated = Quantity(stated.number, length_unit)
    try:
        number = stated.to(unit)
    except ValueError as error:
        raise ValueError(f"{name} {stated}: {error}; a number in {unit}, or with such a unit, is needed") from error
    if not math.isfinite(number):
        raise ValueError(f"{name} {stated}: is beyond double precision; a finite number is needed")
    return number


def factor(unit: str, to: str) -> float:
    """Return the conversion factor from `unit` to the unit `to`.

    Raises ValueError for texts that are not units, and for units of different dimensions.
    """
    if unit in METRES and to in METRES:
        return _rounded(METRES[unit] / METRES[to])
    one, other = _parsed(unit), _parsed(to)
    if one.dimensionality != other.dimensionality:
        raise ValueError(f"unit {unit!r}: cannot be converted to {to}")
    return _rounded((one / other).to_base_units().magnitude)


def counts_points(unit: str) -> bool:
    """Return True if a unit, such as px, counts the points of a map, and is therefore no unit of length."""
    return bool(re.fullmatch(_POINTS, unit.strip()))


def metres(unit: str) -> float:
    """Return the length of a unit in m, for example 1e-6 for "um". Raises ValueError unless it is a unit of length."""
    return factor(length_unit(unit), "m")


def length_unit(text: str) -> str:
    """Return a unit of length in the spelling of results: "um" for µm, micron and micrometer.

    Raises ValueError unless the text is a unit of length.
    """
    text = text.strip()
    if (spelled := re.sub("[µμ]", "u", text)) in METRES:
        return spelled
    unit = _parsed(text)
    if not unit.check("[length]"):
        raise ValueError(f"unit {text!r}: not a unit of length, such as um, nm or m")
    metres = _rounded(unit.to_base_units().magnitude)
    return next((spelling for spelling, length in METRES.items() if length == metres), f"{metres!r} m")


def with_length(unit: str, length: str) -> str:
    """Return an SI unit in which another unit of length replaces the metre, as results spell it: "um2", "(1e-6 m)2".

    A unit that is not in LENGTH_POWERS is returned unchanged; of the others, "1" if the unit of length is "1".
    """
    if unit not in LENGTH_POWERS:
        return unit
    if length == UNKNOWN:
        return UNKNOWN
    in_brackets = LENGTH_POWERS[unit] > 1 and not (length.isascii() and length.isalpha())
    return (f"({length})" if in_brackets else length) + unit.removeprefix("m")


def is_length(text: str) -> bool:
    """Return True if a text is a unit of length."""
    with contextlib.suppress(ValueError):
        return bool(length_unit(text))
    return False


def _rounded(number: float) -> float:
    """Round a factor to 14 digits, so that a nanometre is exactly 1e-9 metres."""
    return float(f"{number:.14g}")


@functools.cache
def _registry() -> Any:
    import pint

    registry: Any = pint.UnitRegistry()
    registry.define("@alias angstrom = Angstrom")
    return registry


@functools.cache
def _parsed(text: str) -> Any:
    """Convert the text of a unit, such as "1e-6 m", to a quantity of pint. Raises ValueError for other texts.

    Exponents of more than one digit and powers of powers are refused, since pint could take forever to compute them.
    """
    needed = "a unit such as um, nm, N or Pa s is needed"
    spelled = re.sub("[·⋅]", "*", text)
    spelled = re.sub(_POWER, lambda match: f"{match[1] or ')'}**{match[2] or match[3]}", spelled)
    if not re.fullmatch(_ALLOWED, text) or re.search(_LONG_POWER, spelled) or spelled.count("**") > 6:
        raise ValueError(f"unit {text[:60]!r}: {needed}")
    try:
        parsed = _registry().Quantity(spelled)
        size = float(parsed.to_base_units().magnitude)
    except Exception as error:  # pint raises errors of many types
        raise ValueError(f"unit {text!r}: {needed}") from error
    if not (math.isfinite(size) and size > 0):
        raise ValueError(f"unit {text!r}: {needed}")
    if any(name.endswith(_PRINTED) for name, _ in parsed.unit_items()):
        raise ValueError(f"unit {text!r}: counts the points of a picture; {needed}")
    return parsed
