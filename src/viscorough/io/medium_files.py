"""Read media from YAML files: one mapping with the kind of medium and its parameters.

Values may have units, and Young's moduli may replace shear moduli. Contact without friction depends on E/(1 − ν²)
alone, at every time if the Poisson ratio ν is constant. The medium is therefore replaced by the incompressible medium
with the same E(t)/(1 − ν²) (basics.elasticity).
"""

import contextlib
import dataclasses
import math
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from viscorough.basics import units
from viscorough.basics.elasticity import INCOMPRESSIBLE, shear_over_incompressible, young_over_shear
from viscorough.basics.types import FilePath
from viscorough.io.refusals import path_named, reading
from viscorough.io.unique_keys import UniqueKeys
from viscorough.media import kinds
from viscorough.media.medium import Medium

# How to describe a medium that is known by measured values of J or ψ.
_OF_A_TABLE = "For a table of J or ψ, fit a Prony series, for example with pyRheo or RHEOS, and give kind: prony"
_LARGEST_FILE = 1_000_000  # largest size of a YAML file in bytes


def read_medium(path: FilePath, length_unit: str = "1") -> Medium:
    """Read a medium from a YAML file with one mapping: its kind and its parameters.

    Parameters
    ----------
    path : path
        YAML file. The table of media in the documentation lists the kinds of media and their keys.
    length_unit : str, optional
        Unit of length of the indenter, such as "um". Values are then in Pa and s, or have units. By default all values
        are plain numbers in consistent units.

    Returns
    -------
    Medium

    Raises
    ------
    ValueError
        For a missing or damaged file, an unknown kind or key, and values out of range. The message has one line.

    Examples
    --------
    >>> import tempfile
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with open(f"{folder}/medium.yaml", "w") as file:
    ...         _ = file.write("{kind: maxwell, shear_modulus: 2, viscosity: 5}")
    ...     medium = viscorough.read_medium(f"{folder}/medium.yaml")
    >>> medium
    Maxwell(shear_modulus=2.0, viscosity=5.0)
    """
    with path_named(path):
        return medium_from_mapping(_mapping(path), length_unit)


def medium_from_mapping(mapping: Mapping[str, Any], length_unit: str = "1") -> Medium:
    """Return the medium that a mapping describes.

    mapping : the key `kind`, one of kinds.KINDS, and all parameters of this class. Shear moduli may be replaced by
        Young's moduli (`_young_key`); `poisson` is then an optional key
    length_unit : unit of length of the indenter. If it is known, plain moduli are in Pa, viscosities in Pa s and times
        in s, and values may have units ("2 MPa"). If it is "1", all values are plain numbers in consistent units of the
        user's choice

    Raises a one-line ValueError for an unknown kind or key, missing keys, and values out of range.
    """
    kind = mapping.get("kind")
    if not isinstance(kind, str) or kind not in kinds.KINDS:
        raise ValueError(f"kind {repr(kind)[:60]}; allowed: {', '.join(kinds.KINDS)}. {_OF_A_TABLE}")
    medium = kinds.KINDS[kind]
    needed = [field.name for field in dataclasses.fields(medium)]
    young = {name: _young_key(name) for name in needed if _is_modulus(name)}
    keys = [*needed, *young.values(), *(["poisson"] if young else [])]
    if unknown := [key for key in mapping if key != "kind" and key not in keys]:
        raise ValueError(f"unknown key {repr(unknown[0])[:60]}; allowed for {kind}: {', '.join(keys)}")
    by_young = any(key in mapping for key in young.values())
    if by_young and any(name in mapping for name in young):
        raise ValueError(f"{', '.join(young)} and {', '.join(young.values())} exclude each other; one kind is allowed")
    if missing := [name for name in needed if (young.get(name, name) if by_young else name) not in mapping]:
        needs = [f"{name} (or {young[name]})" if name in young else name for name in needed]
        raise ValueError(f"lacks {', '.join(missing)}; {kind} needs {', '.join(needs)}")
    if "poisson" in mapping and not by_young:
        raise ValueError(f"poisson is for use with {', '.join(young.values())}")
    ratio = _value("poisson", mapping.get("poisson", INCOMPRESSIBLE), None, length_unit)
    if not (isinstance(ratio, int | float) and -1 < ratio <= INCOMPRESSIBLE):
        raise ValueError(f"poisson: must be above -1 and at most 0.5, not {ratio!r}")
    divisors = {name: young_over_shear(ratio) for name in young} if by_young else {}
    divisors |= {"viscosity": shear_over_incompressible(ratio)}
    parameters = {}
    for name in needed:
        key = young[name] if by_young and name in young else name
        value = _value(key, mapping[key], _unit_of(name), length_unit)
        parameters[name] = _divided(value, divisors.get(name, 1.0))
    return medium(**parameters)


def _is_modulus(name: str) -> bool:
    return name.endswith(("modulus", "moduli"))


def _young_key(name: str) -> str:
    """Return the key of the Young's modulus that replaces a shear modulus, such as relaxed_young_modulus."""
    return name.removeprefix("shear_").replace("modul", "young_modul")


def _unit_of(name: str) -> str | None:
    """Return the SI unit of a parameter; None if it has none, or none that is the same for every medium."""
    if name == "viscosity":
        return "Pa s"
    if name.startswith("relaxation_time"):
        return "s"
    return "Pa" if _is_modulus(name) and name != "modulus" else None


def _divided(value: Any, divisor: float) -> Any:
    """Divide numbers by a divisor; the class of the medium refuses all other values."""
    if isinstance(value, list):
        return [_divided(entry, divisor) for entry in value]
    if divisor == 1 or isinstance(value, bool) or not isinstance(value, int | float):
        return value
    return float(value) / divisor if abs(value) < sys.float_info.max else math.inf


class _WithoutAliases(UniqueKeys):
    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        if self.check_event(yaml.AliasEvent):
            raise yaml.YAMLError("aliases are not allowed")
        return super().compose_node(parent, index)


def _mapping(path: FilePath) -> dict[str, Any]:
    with reading(path, "one mapping of YAML with the kind of medium and its parameters is needed"):
        if Path(path).stat().st_size > _LARGEST_FILE:
            raise ValueError("it is too large")
        content = yaml.load(Path(path).read_bytes(), Loader=_WithoutAliases)
        if not isinstance(content, dict):
            raise ValueError(f"it holds {repr(content)[:60]}")
    return content


def _value(key: str, value: object, unit: str | None, length_unit: str) -> Any:
    """Convert the value of a key in a YAML file, or a list of values, to SI numbers.

    unit : SI unit of the value; None if it has none

    Raises ValueError for a value with a unit if `length_unit` is "1", since the unit of length is then not known.
    """
    if isinstance(value, list):
        return [_value(f"{key}[{i}]", entry, unit, length_unit) for i, entry in enumerate(value)]
    if isinstance(value, str):
        with contextlib.suppress(ValueError):
            return float(value)  # YAML reads 1e6, without a point, as a text
        if length_unit == units.UNKNOWN or unit is None:
            reason = "its unit is not fixed" if unit is None else "the unit of length is not known"
            raise ValueError(f"{key}: {repr(value)[:60]}; allowed: a plain number, since {reason}")
        try:
            quantity = units.quantity(value)
        except ValueError as error:
            raise ValueError(f"{key}: {error}") from error
        return units.in_si(quantity, unit, length_unit, key)
    return value
