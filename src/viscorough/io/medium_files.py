"""Read and write media as YAML files: one mapping with the kind of medium and its parameters."""

import contextlib
import dataclasses
import inspect
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import yaml

from viscorough.basics.types import FilePath
from viscorough.io import tables
from viscorough.io.atomic import atomic_write, path_named, reading
from viscorough.io.columns import read_columns
from viscorough.io.netcdf import Content, Quantities, described
from viscorough.io.suffixes import MEDIA, check_suffix
from viscorough.io.unique_keys import UniqueKeys
from viscorough.media import kinds
from viscorough.media.identified_medium import IdentifiedMedium
from viscorough.media.medium import Medium
from viscorough.media.table import CreepTable, FreeForm, RelaxationTable

# Columns of the file of a table: {class: {name: unit}}.
_COLUMNS: dict[Any, dict[str, str]] = {
    CreepTable: {"time": "s", "compliance": "1/Pa"},
    RelaxationTable: {"time": "s", "relaxation_modulus": "Pa"},
}
# First columns of every table of an identified medium: {name: (meaning, unit)}.
_COMPLIANCE: dict[str, tuple[str, int | str]] = {
    "time": ("time since a step of the force", "s"),
    "compliance": ("creep compliance J", "1/Pa"),
}
# All columns of the table of an identified medium, {name: (meaning, unit)}. They depend on which quantity was measured,
# the depth or the force; the keys "depth" and "force" name this quantity.
_TABLES: dict[str, Quantities] = {
    "depth": _COMPLIANCE
    | {
        "low": ("creep compliance J, lower end of 95 %, missing if the scatter is unknown", "1/Pa"),
        "high": ("creep compliance J, upper end of 95 %, missing if the scatter is unknown", "1/Pa"),
    },
    "force": _COMPLIANCE
    | {
        "relaxation_modulus": ("relaxation modulus at this time after a step of the depth", "Pa"),
        "low": ("relaxation modulus, lower end of 95 %, missing if the scatter is unknown", "Pa"),
        "high": ("relaxation modulus, upper end of 95 %, missing if it or the scatter is unknown", "Pa"),
    },
}
_LARGEST_FILE = 1_000_000  # largest size of a YAML file in bytes


def read_medium(path: FilePath, length_unit: str = "1") -> Medium:
    """Read a medium from a YAML file with one mapping: its kind and its parameters.

    The path of a table is relative to the folder of the YAML file.

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
        return medium_from_mapping(_mapping(path), length_unit, folder=Path(path).parent)


def medium_from_mapping(mapping: Mapping[str, Any], length_unit: str = "1", *, folder: Path = Path()) -> Medium:
    """Return the medium that a mapping describes.

    mapping : the key `kind`, one of kinds.KINDS, and all its parameters. Shear moduli may be replaced by Young's
        moduli (kinds.YOUNG); `poisson` is then an optional key. For a table, the key `file` names a file with the
        columns time and compliance, or time and relaxation_modulus, in s, 1/Pa and Pa unless the heading of the file
        states other units
    length_unit : unit of length of the indenter. If it is known, plain moduli are in Pa, viscosities in Pa s and times
        in s, and values may have units ("2 MPa"), except for a springpot. If it is "1", all values are plain numbers in
        consistent units of the user's choice
    folder : folder in which the file of a table is searched if its name is relative

    Raises a one-line ValueError for an unknown kind or key, missing keys, and values out of range.
    """
    kind = mapping.get("kind")
    if not isinstance(kind, str) or kind not in kinds.KINDS:
        raise ValueError(f"kind {repr(kind)[:60]}; allowed: {', '.join(kinds.KINDS)}")
    make = kinds.KINDS[kind]
    needed = ["file"] if make in _COLUMNS else [field.name for field in dataclasses.fields(make)]
    keys = ["file"] if make in _COLUMNS else list(inspect.signature(make).parameters)
    if unknown := [key for key in mapping if key != "kind" and key not in keys]:
        raise ValueError(f"unknown key {repr(unknown[0])[:60]}; allowed for {kind}: {', '.join(keys)}")
    if missing := [key for key in needed if not {key, kinds.YOUNG.get(key)} & mapping.keys()]:
        needs = [f"{key} (or {kinds.YOUNG[key]})" if kinds.YOUNG.get(key) in keys else key for key in needed]
        raise ValueError(f"lacks {', '.join(missing)}; {kind} needs {', '.join(needs)}")
    if make in _COLUMNS:
        name, columns = mapping["file"], _COLUMNS[make]
        if not isinstance(name, str) or not name or "\0" in name:
            raise ValueError(f"file: {repr(name)[:60]}; allowed: the name of a .csv or .npy file")
        return make(*read_columns(folder / name, f"a {kind.replace('_', ' ')}", columns, length_unit))
    return make(**{key: _values(key, value, length_unit) for key, value in mapping.items() if key != "kind"})


def creep_table_of(path: FilePath) -> Path | None:
    """Return the path of the table that the YAML file of a medium names; None for other media.

    The table need not exist.
    """
    name = _mapping(path).get("file")
    return Path(path).parent / name if isinstance(name, str) and name and "\0" not in name else None


def save_identified(identified: IdentifiedMedium, path: FilePath, **attributes: Any) -> None:
    """Write an IdentifiedMedium as YAML for `read_medium`, atomically.

    A medium of free form is written as a creep table, to a second file in the same folder, with the suffix .csv. The
    table has the columns time, compliance, low and high. low and high are the ends of the 95 % interval of the
    compliance; they are empty if the scatter of the record is unknown. If the force was measured, the table also has
    the column relaxation_modulus, and low and high are the ends of the interval of the relaxation modulus.

    Parameters
    ----------
    identified : IdentifiedMedium
        Result of `identify_medium`.
    path : path
        YAML file to write or replace.
    **attributes : Any
        Further attributes of the table.

    Raises
    ------
    ValueError
        For a path that does not end in .yaml or .yml, or cannot be written.
    OSError
        If writing fails.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> import viscorough
    >>> curve = viscorough.indent(viscorough.self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1))
    >>> record = viscorough.kinetics(curve, 5e-6, 1e6, np.geomspace(0.1, 100, 50))
    >>> identified = viscorough.identify_medium(curve, 5e-6, record.time, record.depth)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save(identified, f"{folder}/medium.yaml")
    ...     medium = viscorough.read_medium(f"{folder}/medium.yaml")
    >>> type(medium).__name__
    'CreepTable'
    """
    path, medium, table = Path(path), identified.medium, check_medium_file(path)
    made = CreepTable if isinstance(medium, FreeForm) else type(medium)
    (kind,) = (kind for kind, make in kinds.KINDS.items() if make is made)
    mapping: dict[str, Any] = {"kind": kind}
    if isinstance(medium, FreeForm):
        tables.write(identified_to_content(identified).with_attributes(**attributes), table)
        mapping["file"] = table.name
    else:
        mapping |= dataclasses.asdict(cast(Any, medium))
    with atomic_write(path) as temporary:
        temporary.write_text(yaml.safe_dump(mapping, sort_keys=False, allow_unicode=True), encoding="utf-8")


def identified_to_content(identified: IdentifiedMedium) -> Content:
    """Convert an IdentifiedMedium to the content of a table, with one row for each time.

    The columns are the time, the creep compliance, the relaxation modulus if the force was measured, and the ends of a
    95 % interval (see `_TABLES`).
    """
    quantities = _TABLES[identified.measured]
    values = {name: getattr(identified, name) for name in quantities}
    variables = described(("level",), values, quantities, identified.length_unit)
    return Content(variables, {"title": f"Medium identified from a record of {identified.measured} over time"})


def check_medium_file(path: FilePath) -> Path:
    """Return the path at which the creep table of a YAML file is written: the same name with the suffix .csv.

    path : path of the YAML file

    Raises ValueError if the suffix of the YAML file is neither .yaml nor .yml.
    """
    check_suffix(path, MEDIA)
    return Path(path).with_suffix(".csv")


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
