"""Read and convert units as users and files write them: "um", "1e-6 m", "µm", "micron", "Pa s", "N s m-2".

Results spell units like UDUNITS, the units library of the CF conventions: a number after a unit is its exponent, as in
m2. The library pint converts units. Since the import of pint takes a second, common units are converted by a short
table. The unit "1" means that the unit of length is not known.
"""

import contextlib
import functools
import math
import re
from dataclasses import dataclass
from typing import Any, NamedTuple

from viscorough.basics import summaries
from viscorough.basics.argument_names import argument, spelled

UNKNOWN = "1"
# Units of length that are converted without pint: {spelling in files and results: metres}. Users may write µ for u.
_METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
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


def with_unit(value: Any) -> Any:
    """Convert a text or a quantity of pint to a Quantity; other values are returned unchanged.

    Raises the errors of `quantity`.
    """
    # The module `arrays` imports numpy, which takes long. The command line reads its options before this import.
    from viscorough.basics.arrays import real_number

    if hasattr(value, "magnitude") and hasattr(value, "units"):
        return Quantity(real_number(str(value.units), value.magnitude), str(value.units))
    return quantity(value) if isinstance(value, str) else value


def number(value: Any, unit: str, length_unit: str, name: str) -> float:
    """Convert a plain number, a Quantity, a quantity of pint, or a text such as "5 mN" to a finite number in `unit`.

    length_unit : unit of length of the indenter; if it is "1" (not known), numbers are in consistent units and are not
        converted

    Raises ValueError, with a message that starts with `name`, for other values, and for a number with a unit if the
    unit of length is not known.
    """
    from viscorough.basics.arrays import real_number

    return real_number(name, numbers(value, unit, length_unit, name))


def numbers(values: Any, unit: str, length_unit: str, name: str) -> Any:
    """Convert values to an array of real numbers in `unit`. Values may have units, as in `number`.

    values : a value that `number` accepts, an array, an array of pint, or a list whose entries may have different units
    """
    from viscorough.basics.arrays import read_only, real_numbers, unit_attribute

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
    """Convert a force or several forces F to F/G [length²], an array of the same shape.

    shear_modulus : G [Pa]; the forces are then in N. If the unit of length is not known, G and F are in consistent
        units. None if the given forces are already F/G

    Raises the errors of `numbers`, and ValueError for a force with a unit if G is not given.
    """
    from viscorough.basics.arrays import unit_attribute

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
    """Return the square of a unit of length in m², for example 1e-12 for "um"; 1 if the unit is not known.

    If F/G is given in squared units of length, the force in N is F/G times this area times the modulus G in Pa.
    """
    return in_metres(length_unit) ** 2


def in_metres(length_unit: str) -> float:
    """Return the length of a unit in m, for example 1e-6 for "um"; 1 if the unit is not known."""
    return 1.0 if length_unit == UNKNOWN else metres(length_unit)


class ResultUnit(NamedTuple):
    """Unit in which users read a quantity: the name of the unit, and the factor that converts a result of the solver.

    The solver computes lengths in the unit of the heights, areas in the square of this unit, and the ratios F/G, k/G
    and p/G of force, stiffness and pressure to the shear modulus.
    """

    name: str
    factor: float

    def text(self, value: float, digits: int = 4) -> str:
        """Convert a result of the solver to this unit, and return it as text."""
        return summaries.with_unit(value * self.factor, self.name, digits)


def result_units(length_unit: str, shear_modulus: float | None) -> dict[str, ResultUnit]:
    """Return the units in which users read results: {"length", "area", "force", "stiffness", "pressure": ResultUnit}.

    Lengths are in um and areas in um2. If the shear modulus [Pa] is given, forces are in N, stiffnesses in N/m and
    pressures in MPa; otherwise they are F/G in um2, k/G in um and p/G without a unit ("1"). If the unit of length is
    not known, all numbers are in consistent units, which are called "1".
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
    """Return the conversion factor from `unit` to the unit `to`.

    Raises ValueError for texts that are not units, and for units of different dimensions.
    """
    if unit in _METRES and to in _METRES:
        return _rounded(_METRES[unit] / _METRES[to])
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
    if (spelled := re.sub("[µμ]", "u", text)) in _METRES:
        return spelled
    unit = _parsed(text)
    if not unit.check("[length]"):
        raise ValueError(f"unit {text!r}: not a unit of length, such as um, nm or m")
    metres = _rounded(unit.to_base_units().magnitude)
    return next((spelling for spelling, length in _METRES.items() if length == metres), f"{metres!r} m")


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
