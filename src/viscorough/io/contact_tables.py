"""Compute, write and read tables with one row for each load of each file of heights.

The columns are depth, force, stiffness, contact area, pressures and, on request, grid errors. Lengths are in um and
areas in um2. If the shear modulus is given, forces are in N, stiffnesses in N/m and pressures in MPa. For the units in
other cases see viscorough.basics.units.result_units. A file that could not be evaluated has one row with the error and
without numbers. Every row has a digest of its file and of the settings, so that rows of unchanged files can be kept.
"""

import csv
import hashlib
import itertools
import warnings
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.errors import REPORTED, AccuracyWarning, message
from viscorough.basics.types import Array, FilePath, Progress
from viscorough.contact.loading_path import indent, part_of
from viscorough.contact.one_contact import contact_at
from viscorough.io.atomic import reading
from viscorough.io.contact_files import NUMBERS, NUMBERS_WITH_MODULUS, PATCHES
from viscorough.io.curves import ABOUT_GRID, OVER_LEVELS
from viscorough.io.netcdf import Content, Variable
from viscorough.results.contact_maps import Contact
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter

# Quantities in tables: {quantity: key under which units.result_units gives its unit; None for counts and shares}.
_MEASURES = {
    "depth": "length",
    "force": "force",
    "stiffness": "stiffness",
    "contact_count": None,
    "contact_fraction": None,
    "contact_area": "area",
    "corrected_contact_area": "area",
    "mean_pressure": "pressure",
    "largest_pressure": "pressure",
    "patches": None,
    **dict.fromkeys(ABOUT_GRID),
}
# Names of the columns with F, k and p, which replace F/G, k/G and p/G if the shear modulus G is given:
# {quantity: name of the column}.
_WITH_MODULUS = {"force": "normal_force", "stiffness": "normal_stiffness"}
_WITH_MODULUS |= {"mean_pressure": "mean_normal_pressure", "largest_pressure": "largest_normal_pressure"}
# Quantities in a table of contacts (_CONTACT_QUANTITIES) and in a table of loading curves (_CURVE_QUANTITIES).
_CONTACT_QUANTITIES = [name for name in _MEASURES if name not in ("contact_count", *ABOUT_GRID)]
_CURVE_QUANTITIES = [
    "depth",
    "force",
    "stiffness",
    "contact_count",
    "contact_fraction",
    "contact_area",
    "mean_pressure",
]
# Columns that hold whole numbers.
_COUNTS = ("contact_count", "patches")
# Quantities that users may prescribe. They are shown with six digits, and all other quantities with four.
_PRESCRIBED = ("depth", "force", "normal_force")
# A digest in a table is shortened to this number of hexadecimal digits.
_DIGEST_DIGITS = 16
# Columns that hold texts: {name: meaning}.
_TEXTS = {
    "file": "file of heights",
    "error": "why the file has no numbers; empty if it has",
    "warnings": "doubts about the numbers; empty if there are none",
    "digest": f"SHA-256, first {_DIGEST_DIGITS} digits, of the file, of the settings and of the version of viscorough",
}
_MEANINGS = {
    name: text for name, (text, _) in (OVER_LEVELS | ABOUT_GRID | NUMBERS | NUMBERS_WITH_MODULUS | PATCHES).items()
}
# All columns of a table of contacts, if the shear modulus is given and grid errors are requested:
# {column: (meaning, unit)}. The unit is None for texts.
SI_COLUMNS: dict[str, tuple[str, str | None]] = {
    "file": (_TEXTS["file"], None),
    **{
        _WITH_MODULUS.get(name, name): (
            _MEANINGS[_WITH_MODULUS.get(name, name)],
            "1" if measure is None else units.result_units("um", 1.0)[measure].name,
        )
        for name, measure in _MEASURES.items()
        if name != "contact_count"
    },
    **{name: (text, None) for name, text in _TEXTS.items() if name != "file"},
}
# Suffixes of companion files of an ESRI grid.
_COMPANIONS = (".prj", ".PRJ")

# If grid errors are computed as well, the computation of the contacts counts as this share of the progress.
_SHARE_OF_CONTACTS = 0.3
# For grid errors, contacts at these multiples of the force of each load are computed as well. A grid error is a mean
# over half a decade of forces, since the difference of two curves at a single force can be zero by chance.
_FORCES_BELOW = (10**-0.5, 10**-0.25)
# A contact for grid errors is left out if its force differs from the force of another contact by less than this share:
# the results of both contacts would differ by less than the tolerance.
_LEAST_DIFFERENCE = 0.02

Row = dict[str, float | int]
Rows = tuple[Sequence[Row], dict[str, str]]  # (rows of a table, {column: unit})


class FileRows(NamedTuple):
    """Rows of a table of contacts that belong to one file of heights, one row for each load.

    file : name of the file
    digest : digest of the file and the settings; "" if the file cannot be read
    rows : one {column: number} for each load; empty if the file could not be evaluated
    units : {column: unit}
    error : reason why there are no rows; "" if there are rows
    warnings : doubts about the numbers; "" if there are none
    """

    file: str
    digest: str
    rows: Sequence[Row] = ()
    units: dict[str, str] = {}  # noqa: RUF012  # never changed
    error: str = ""
    warnings: str = ""


def rows_of_contacts(contacts: Sequence[Contact], grid_errors: dict[str, Array] | None = None) -> Rows:
    """Return (rows of a table, {column: unit}), with one row for each contact.

    grid_errors : {quantity in io.curves.ABOUT_GRID: its value for each contact}; None for a table without grid errors
    """
    values: dict[str, Any] = {name: [] for name in _CONTACT_QUANTITIES}
    for contact in contacts:
        for name in values:
            values[name].append(contact.patches().areas.size if name == "patches" else getattr(contact, name))
    return _rows(values | (grid_errors or {}), contacts[0].length_unit, contacts[0].shear_modulus)


def rows_of_curve(curve: LoadingCurve, indenter: Indenter, shear_modulus: float | None) -> Rows:
    """Return (rows of a table, {column: unit}), with one row for each computed contact of a loading curve.

    indenter : indenter of the curve, whose spacing gives the contact area
    shear_modulus : G [Pa], or in consistent units if the unit of length is not known; None if it is not given
    """
    area = curve.contact_count * indenter.spacing * indenter.row_spacing
    derived = {"contact_area": area, "mean_pressure": curve.force / area}
    values = {name: derived[name] if name in derived else getattr(curve, name) for name in _CURVE_QUANTITIES}
    values |= {name: getattr(curve, name) for name in ABOUT_GRID if getattr(curve, name) is not None}
    return _rows(values, curve.length_unit, shear_modulus)


def _rows(values: dict[str, Any], length_unit: str, shear_modulus: float | None) -> Rows:
    """Convert results of the solver to (rows of a table, {column: unit}), in the units of units.result_units.

    values : {quantity: its value for each row}
    """
    read, stated = units.result_units(length_unit, shear_modulus), {}
    columns: dict[str, list[float | int]] = {}
    for quantity, numbers in values.items():
        measure = _MEASURES[quantity]
        name = quantity if shear_modulus is None else _WITH_MODULUS.get(quantity, quantity)
        stated[name], factor = ("1", None) if measure is None else read[measure]
        if quantity in _COUNTS:
            columns[name] = [int(number) for number in numbers]
        else:
            columns[name] = [_rounded(number * (factor or 1.0)) for number in numbers]
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)], stated


def _rounded(number: float) -> float:
    """Round a number to 15 digits. A force of 5 uN is thus exactly 5e-06 N after a conversion to F/G and back."""
    return float(f"{number:.15g}")


def rows_at_loads(
    indenter: Indenter,
    *,
    force: Any = None,
    depth: Any = None,
    shear_modulus: float | None = None,
    grid_error: bool = False,
    progress: Progress | None = None,
    **how: Any,
) -> Rows:
    """Compute the contact at each load. Return (rows of a table, {column: unit}), with one row for each load.

    Raises the errors of `contact_at`.

    force, depth : increasing forces [N, or length² without a modulus] or depths [length]; give one of the two
    shear_modulus : G [Pa], or in consistent units if the unit of length is not known
    grid_error : True for the columns grid_error, force_grid_error and area_change
    progress : function called with the finished share of the computation
    how : further arguments of `contact_at` and `indent`: tolerance and threads
    """
    loads: dict[str, Any] = {"force": force, "depth": depth, "shear_modulus": shear_modulus}
    if not grid_error:
        return rows_of_contacts(contact_at(indenter, **loads, **how, progress=progress))
    progress = progress or (lambda done: None)
    contacts: list[Contact] = contact_at(indenter, **loads, **how, progress=part_of(progress, 0.0, _SHARE_OF_CONTACTS))
    curve = _curve_with_grid_errors(indenter, contacts, progress=part_of(progress, _SHARE_OF_CONTACTS, 1.0), **how)
    places = [int(np.argmin(np.abs(curve.force - contact.force))) for contact in contacts]
    return rows_of_contacts(contacts, {name: getattr(curve, name)[places] for name in ABOUT_GRID})


def _curve_with_grid_errors(indenter: Indenter, contacts: list[Contact], **how: Any) -> LoadingCurve:
    """Return the loading curve with grid errors, at the forces of the contacts and at lower forces (_FORCES_BELOW)."""
    forces = _with_forces_below(np.array([contact.force for contact in contacts]))
    # The computation of the contacts has already given the same warnings.
    with warnings.catch_warnings(action="ignore", category=AccuracyWarning):
        return indent(indenter, forces=forces, estimate_grid_error=True, **how)


def _with_forces_below(forces: Array) -> Array:
    """Return the given forces and the lower forces for grid errors (_FORCES_BELOW), in increasing order."""
    levels = list(forces)
    for candidate in np.multiply.outer(forces, _FORCES_BELOW).ravel():
        if all(abs(candidate - level) > _LEAST_DIFFERENCE * level for level in levels):
            levels.append(candidate)
    return np.sort(levels)


def text_of_row(row: Row, stated: dict[str, str]) -> str:
    """Return one line of text with the main numbers of a contact.

    row : row of a table of contacts
    stated : {column: unit} of the table
    """

    def text(name: str) -> str:
        return units.ResultUnit(stated[name], 1.0).text(row[name], 6 if name in _PRESCRIBED else 4)

    parts = [f"depth {text('depth')}"]
    if "normal_force" in row:
        parts += [f"F {text('normal_force')}", f"largest p {text('largest_normal_pressure')}"]
        parts += [f"k {text('normal_stiffness')}"]
    else:
        parts += [f"F/G {text('force')}"]
    parts += [f"contact fraction {text('contact_fraction')}", f"contact area {text('contact_area')}"]
    parts[-1] += f" (corrected {text('corrected_contact_area')})"
    return ", ".join([*parts, f"{row['patches']} patch{'' if row['patches'] == 1 else 'es'}"])


def evaluated(
    file: FileRows, path: Path, read: Callable[[], Indenter], evaluate: Callable[[Indenter], Rows]
) -> FileRows:
    """Read and evaluate a file of heights. Return `file` with the rows and warnings, or with the error that occurred.

    file : FileRows with the name and the digest of the file
    path : path of the file. It is removed from messages, since the table has a column with the name of the file
    read : function that reads the file and returns the indenter
    evaluate : function of the indenter that returns the rows and {column: unit}
    """
    with warnings.catch_warnings(record=True) as caught:
        try:
            rows, stated = evaluate(read())
            file = file._replace(rows=rows, units=stated)
        except REPORTED as error:
            file = file._replace(error=_without_path(message(error), path))
        # Any other error is a fault of viscorough. It is reported, too, so that the evaluation of other files goes on.
        except Exception as error:
            file = file._replace(error=f"{type(error).__name__}: {_without_path(message(error), path)}")
    texts = dict.fromkeys(_without_path(str(warning.message), path) for warning in caught)
    return file._replace(warnings="; ".join(texts))


def _without_path(text: str, path: Path) -> str:
    """Return the text of an error or warning on one line, without the path at its start."""
    return " ".join(text.split()).removeprefix(f"{path}: ")


def digest_of_file(path: FilePath, settings: str) -> str:
    """Return a digest of a file of heights, of its companion file (.prj), and of the settings.

    settings : text that states the version of viscorough, the command and its options

    Returns "" if one of the files cannot be read.
    """
    file = Path(path)
    companions = [file.with_suffix(suffix) for suffix in _COMPANIONS]
    digest = hashlib.sha256(settings.encode(errors="backslashreplace"))
    try:
        for each in [file, *(companion for companion in companions if companion != file and companion.is_file())]:
            with reading(each, "a file of heights is needed"), open(each, "rb") as opened:
                digest.update(hashlib.file_digest(opened, "sha256").digest())
    except ValueError:
        return ""
    return digest.hexdigest()[:_DIGEST_DIGITS]


def with_one_unit(results: Iterable[FileRows]) -> list[FileRows]:
    """Sort the results of files by file name, and ensure that each column of their rows has a single unit.

    If some files state a unit of length and others do not, the files without a unit get an error instead of rows.
    """
    listed = sorted(results, key=lambda result: result.file)
    if len({result.units["depth"] for result in listed if result.rows}) < 2:
        return listed
    without = f"states no unit of length, but other files do; {argument('unit')} is needed"
    return [
        result._replace(rows=(), units={}, error=without) if result.units.get("depth") == units.UNKNOWN else result
        for result in listed
    ]


def lines_of_files(results: Iterable[FileRows]) -> list[dict[str, Any]]:
    """Return all rows of a table, each as a dict {column: value}, from the results of several files of heights.

    A file has one row for each load. A file that could not be evaluated has one row, with the error instead of numbers.
    """
    return [row | {name: getattr(result, name) for name in _TEXTS} for result in results for row in result.rows or [{}]]


def contact_table(results: Sequence[FileRows], **attributes: Any) -> Content:
    """Convert the results of files to the content of a table.

    results : rows or error of each file, as `with_one_unit` returns them
    attributes : further global attributes of the content
    """
    stated = next((result.units for result in results if result.rows), {})
    lines = lines_of_files(results)
    variables = {"file": _column([line["file"] for line in lines], _TEXTS["file"])}
    for name, unit in stated.items():
        variables[name] = _column([line.get(name, np.nan) for line in lines], _MEANINGS[name], units=unit)
    for name in ("error", "warnings", "digest"):
        variables[name] = _column([line[name] for line in lines], _TEXTS[name])
    return Content(variables, {"title": "Contacts of rigid indenters with an elastic half-space"} | attributes)


def _column(values: list[Any], meaning: str, **attributes: str) -> Variable:
    # In an array of objects, whole numbers stay whole numbers even if other entries are nan.
    column: Array = np.empty(len(values), dtype=object)
    column[:] = values
    return Variable(("row",), column, {"long_name": meaning, **attributes})


def rows_in_table(path: FilePath) -> dict[str, FileRows]:
    """Read a table of contacts that was written earlier, and return {name of a file of heights: its rows}.

    Files of heights with an error are left out. Return {} if `path` is missing or is no table of contacts, for example
    because another program has changed its form.
    """
    found: dict[str, FileRows] = {}
    try:
        with open(path, encoding="utf-8", newline="") as file:
            table = csv.DictReader(itertools.dropwhile(lambda line: line.startswith("# "), file))
            headings = [_heading(name) for name in table.fieldnames or ()]
            stated = {name: unit for name, unit in headings if name in _MEANINGS}
            for line in table:
                cells = {name: line[text] for (name, _), text in zip(headings, table.fieldnames or (), strict=True)}
                if cells["error"]:
                    continue
                row: Row = {name: (int if name in _COUNTS else float)(cells[name]) for name in stated}
                name = cells["file"]
                before = found.get(name, FileRows(name, cells["digest"], units=stated, warnings=cells["warnings"]))
                found[name] = before._replace(rows=[*before.rows, row])
    except (OSError, KeyError, TypeError, ValueError, csv.Error):
        return {}
    return found


def _heading(text: str) -> tuple[str, str]:
    """Return (name, unit) from the heading of a column, such as "depth (um)"; the unit is "1" if none is stated."""
    name, _, unit = text.removesuffix(")").partition(" (")
    return name, unit or units.UNKNOWN
