"""Read media from YAML files: one mapping with the kind of medium and its parameters."""

import contextlib
import dataclasses
import inspect
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from viscorough.basics.types import FilePath
from viscorough.io.atomic import path_named, reading
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
        YAML file. `viscorough kinetics --help` lists the kinds of media and their keys.
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

    mapping : the key `kind`, one of kinds.KINDS, and all its parameters. Shear moduli may be replaced by Young's
        moduli (kinds.YOUNG); `poisson` is then an optional key
    length_unit : unit of length of the indenter. If it is known, plain moduli are in Pa, viscosities in Pa s and times
        in s, and values may have units ("2 MPa"), except for a springpot. If it is "1", all values are plain numbers in
        consistent units of the user's choice

    Raises a one-line ValueError for an unknown kind or key, missing keys, and values out of range.
    """
    kind = mapping.get("kind")
    if not isinstance(kind, str) or kind not in kinds.KINDS:
        raise ValueError(f"kind {repr(kind)[:60]}; allowed: {', '.join(kinds.KINDS)}. {_OF_A_TABLE}")
    make = kinds.KINDS[kind]
    needed = [field.name for field in dataclasses.fields(make)]
    keys = list(inspect.signature(make).parameters)
    if unknown := [key for key in mapping if key != "kind" and key not in keys]:
        raise ValueError(f"unknown key {repr(unknown[0])[:60]}; allowed for {kind}: {', '.join(keys)}")
    if missing := [key for key in needed if not {key, kinds.YOUNG.get(key)} & mapping.keys()]:
        needs = [f"{key} (or {kinds.YOUNG[key]})" if kinds.YOUNG.get(key) in keys else key for key in needed]
        raise ValueError(f"lacks {', '.join(missing)}; {kind} needs {', '.join(needs)}")
    return make(**{key: _values(key, value, length_unit) for key, value in mapping.items() if key != "kind"})


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


def _values(key: str, value: object, length_unit: str) -> Any:
    """Convert the value of a key in a YAML file, or a list of values, to an argument for the class of the medium.

    Raises ValueError for a value with a unit if `length_unit` is "1", since the unit of length is then not known.
    """
    if isinstance(value, list):
        return [_values(f"{key}[{i}]", entry, length_unit) for i, entry in enumerate(value)]
    if isinstance(value, str):
        with contextlib.suppress(ValueError):
            return float(value)  # YAML reads 1e6, without a point, as a text
        if length_unit == "1":
            text = "allowed: a plain number, since the unit of length is not known"
            raise ValueError(f"{key}: {repr(value)[:60]}; {text}")
    return value
