"""Units of measurement as users and files write them: "um", "1e-6 m", "µm", "micron", "Pa s", "N s m-2".

They are spelled as UDUNITS does, the units library of the CF conventions, in which a number behind a unit is its power;
pint knows them. It takes a second to import, and is imported when a unit is read that is not in a short table. The unit
"1" stands for a unit of length that is not known.
"""

import contextlib
import functools
import math
import re
from dataclasses import dataclass
from typing import Any, NamedTuple

from viscorough import summaries
from viscorough.argument_names import argument, spelled

UNKNOWN = "1"
# Units of length that are read without pint, as files and results spell them; users may write µ for u.
_METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
# Patterns are compiled at first use, so that the command line starts faster.
_ALLOWED = r"[\w.()+\-*/^ µμÅ°\"'%]{1,60}"
_POWER = r"(?<![\w.])([^\W\d_]+|(?<=[(*/ ])[^\W\d_]+)([+-]?\d)(?![\w.])|\)([+-]?\d)(?![\w.])"
_LONG_POWER = r"(\*\*|\^)(?!\s*[+-]?\d(?![\d.eE]|\s*(\*\*|\^)))"
_POINTS = r"(?i:px|pix|pixels?|pts?|points?|dots?|samples?|punkte?|bildpunkte?)"
# Lengths of printers that pint knows by names that elsewhere mean the points of a picture.
_PRINTED = ("pixel", "point", "pica", "didot", "cicero")
_QUANTITY = r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.+?)\s*"


@dataclass(frozen=True)
class Quantity:
    """A number with a unit, or a plain number, whose unit is empty."""

    number: float
    unit: str = ""

    def to(self, unit: str) -> float:
        """The number in another unit; a plain number is returned unchanged. Raises ValueError as `factor` does."""
        return self.number * factor(self.unit, unit) if self.unit else self.number

    def __str__(self) -> str:
        return f"{self.number:g} {self.unit}".rstrip()


def quantity(text: str) -> Quantity:
    """The Quantity that a text such as "5 mN", "1e6 Pa s" or "2" states. Raises ValueError if it states none."""
    with contextlib.suppress(ValueError):
        return Quantity(float(text))
    match = re.fullmatch(_QUANTITY, text)
    if match is None:
        raise ValueError(f"{text!r} is not a number, with or without a unit")
    _parsed(match[2])
    return Quantity(float(match[1]), match[2])


def with_unit(value: Any) -> Any:
    """The Quantity that a text or a quantity of pint stands for; anything else is returned unchanged.

    Raises ValueError as `quantity`.
    """
    from viscorough.arrays import real_number  # numpy takes long to import, and reading the options does not need it

    if hasattr(value, "magnitude") and hasattr(value, "units"):
        return Quantity(real_number(str(value.units), value.magnitude), str(value.units))
    return quantity(value) if isinstance(value, str) else value


def number(value: Any, unit: str, length_unit: str, name: str) -> float:
    """Return a finite number in `unit`, given as a plain number, a Quantity, also of pint, or a text as "5 mN".

    Raises ValueError, which starts with the name, for anything else, and for a number with a unit although the unit of
    length is not known: numbers are then in consistent units.
    """
    from viscorough.arrays import real_number

    return real_number(name, numbers(value, unit, length_unit, name))


def numbers(values: Any, unit: str, length_unit: str, name: str) -> Any:
    """Return real numbers in `unit` as an array of the same shape; the values may have units as in `number`.

    values : a number, an array, also of pint, or a list whose entries may have different units
    """
    from viscorough.arrays import read_only, real_numbers, unit_attribute

    if isinstance(values, list | tuple) and any(isinstance(v, str | Quantity) or unit_attribute(v) for v in values):
        for value in values:
            if isinstance(value, str) and not quantity(value).unit:
                raise ValueError(f"{name}: {value!r} is a text without a unit; a plain number is needed")
        return real_numbers(name, [numbers(value, unit, length_unit, name) for value in values])
    try:
        values = quantity(values) if isinstance(values, str) else values
        if isinstance(values, Quantity):
            stated, own, magnitude = f"{name} {values}", values.unit, values.number
        elif hasattr(values, "magnitude") and hasattr(values, "units"):
            stated, own, magnitude = f"{name} in {values.units}", str(values.units), values.magnitude
        else:
            stated, own, magnitude = name, "", values
        conversion = factor(own, unit) if own and length_unit != UNKNOWN else 1.0
    except ValueError as error:
        raise ValueError(f"{name}: {error}; a number in {unit}, or with such a unit, is needed") from error
    if own and length_unit == UNKNOWN:
        text = f"{stated}: needs a plain number, since the unit of length is not known"
        raise ValueError(f"{text}; {argument('unit')} where heights are read states it")
    converted = real_numbers(name, magnitude)
    return converted if conversion == 1 else read_only(converted * conversion)


def forces_over_modulus(forces: Any, shear_modulus: float | None, length_unit: str, name: str) -> Any:
    """F/G [length²] of one force or several, as an array of their shape.

    shear_modulus : G in Pa, forces then are in N, or both are in consistent units if the unit of length is not known;
        None if the forces are F/G

    Raises ValueError, which starts with the name, as `numbers` does, and for a force with a unit where G is not known.
    """
    from viscorough.arrays import unit_attribute

    if shear_modulus is not None:
        newtons, divisor = numbers(forces, "N", length_unit, name), shear_modulus * square_metres(length_unit)
        if not divisor:
            raise ValueError(f"{name}: the shear modulus {shear_modulus:g} is too small; a larger one is needed")
        return newtons / divisor
    for force in forces if isinstance(forces, list | tuple) else [forces]:
        if isinstance(force, str) or unit_attribute(force):
            moduli = spelled("--shear-modulus or --young", "shear_modulus or young_modulus")
            text = f"a force needs {moduli}; a plain number is F/G"
            shown = force if isinstance(force, str | Quantity) else f"in {unit_attribute(force)}"
            raise ValueError(f"{name} {shown}: {text}")
    return numbers(forces, "N", length_unit, name)


def square_metres(length_unit: str) -> float:
    """The square of a unit of length in m²; 1 where it is not known, since units are then consistent by themselves.

    Moduli in Pa and forces in N per this area are consistent with lengths in that unit.
    """
    return in_metres(length_unit) ** 2


def in_metres(length_unit: str) -> float:
    """Return a unit of length in m; 1 if it is not known, since units are then consistent by themselves."""
    return 1.0 if length_unit == UNKNOWN else metres(length_unit)


class ResultUnit(NamedTuple):
    """Unit in which people read a quantity: its name, and the factor that converts the solver's number to it.

    The solver's numbers are lengths in the unit of the heights, areas in this unit squared, and F/G, k/G and p/G.
    """

    name: str
    factor: float

    def text(self, value: float, digits: int = 4) -> str:
        """Return a number of the solver as text in this unit."""
        return summaries.with_unit(value * self.factor, self.name, digits)


def result_units(length_unit: str, shear_modulus: float | None) -> dict[str, ResultUnit]:
    """Return the units of "length", "area", "force", "stiffness" and "pressure" for readers.

    Lengths are in um and areas in um2. Forces are in N, stiffnesses in N/m and pressures in MPa if the shear modulus is
    given [Pa]; otherwise they are F/G in um2, k/G in um and p/G in 1. If the unit of length is not known, all numbers
    are in consistent units, which are called "1".
    """
    if length_unit == UNKNOWN:
        moduli = 1.0 if shear_modulus is None else shear_modulus
        factors = {"length": 1.0, "area": 1.0, "force": moduli, "stiffness": moduli, "pressure": moduli}
        return {name: ResultUnit("1", factor) for name, factor in factors.items()}
    micrometres = factor(length_unit, "um")
    length, area = ResultUnit("um", micrometres), ResultUnit("um2", micrometres**2)
    if shear_modulus is None:
        return {"length": length, "area": area, "force": area, "stiffness": length, "pressure": ResultUnit("1", 1.0)}
    return {
        "length": length,
        "area": area,
        "force": ResultUnit("N", shear_modulus * square_metres(length_unit)),
        "stiffness": ResultUnit("N/m", shear_modulus * in_metres(length_unit)),
        "pressure": ResultUnit("MPa", shear_modulus * 1e-6),
    }


def factor(unit: str, to: str) -> float:
    """Conversion factor from `unit` to the unit `to`.

    Raises ValueError if one of them is not a unit, or if they measure different things.
    """
    if unit in _METRES and to in _METRES:
        return _rounded(_METRES[unit] / _METRES[to])
    one, other = _parsed(unit), _parsed(to)
    if one.dimensionality != other.dimensionality:
        raise ValueError(f"unit {unit!r}: cannot be converted to {to}")
    return _rounded((one / other).to_base_units().magnitude)


def counts_points(unit: str) -> bool:
    """Whether a unit counts the points of a map, as px does, so that it is no length."""
    return bool(re.fullmatch(_POINTS, unit.strip()))


def metres(unit: str) -> float:
    """A unit of length in metres. Raises ValueError if it is not a unit of length, as "1" is none."""
    return factor(length_unit(unit), "m")


def length_unit(text: str) -> str:
    """A unit of length as results spell it: "um" for µm, micron and micrometer.

    Raises ValueError unless the text is a unit of length.
    """
    text = text.strip()
    if (spelled := re.sub("[µμ]", "u", text)) in _METRES:
        return spelled
    unit = _parsed(text)
    if not unit.check("[length]"):
        raise ValueError(f"unit {text!r}: not a unit of length, such as um, nm or m")
    metres = _rounded(unit.to_base_units().magnitude)
    return next((spelling for spelling, length in _METRES.items() if length == metres), f"{metres!r} m")


def is_length(text: str) -> bool:
    """Whether a text is a unit of length."""
    with contextlib.suppress(ValueError):
        return bool(length_unit(text))
    return False


def _rounded(number: float) -> float:
    """A factor without the rounding errors of its computation, so that a nanometre is exactly 1e-9 metres."""
    return float(f"{number:.14g}")


@functools.cache
def _registry() -> Any:
    import pint

    registry: Any = pint.UnitRegistry()
    registry.define("@alias angstrom = Angstrom")
    return registry


@functools.cache
def _parsed(text: str) -> Any:
    """A unit as a pint quantity: number and unit. Raises ValueError if it is none.

    Powers of more than one digit and powers of powers are refused: pint would compute them, however long that takes.
    """
    wanted = "a unit such as um, nm, N or Pa s is needed"
    spelled = re.sub(_POWER, lambda match: f"{match[1] or ')'}**{match[2] or match[3]}", text)
    if not re.fullmatch(_ALLOWED, text) or re.search(_LONG_POWER, spelled) or spelled.count("**") > 6:
        raise ValueError(f"unit {text[:60]!r}: {wanted}")
    try:
        parsed = _registry().Quantity(spelled)
        size = float(parsed.to_base_units().magnitude)
    except Exception as error:  # pint raises errors of many kinds for what it cannot parse
        raise ValueError(f"unit {text!r}: {wanted}") from error
    if not (math.isfinite(size) and size > 0):
        raise ValueError(f"unit {text!r}: {wanted}")
    if any(name.endswith(_PRINTED) for name, _ in parsed.unit_items()):
        raise ValueError(f"unit {text!r}: counts the points of a picture; {wanted}")
    return parsed
