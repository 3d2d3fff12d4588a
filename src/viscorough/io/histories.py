"""Read histories of force or depth from CSV files with two named columns.

The headings are "time (s)" and "force (N)" or "depth (um)", with any unit of the same dimension. Other columns are
ignored if they have other names. Lines above the headings that start with # are comments. Without headings, the numbers
of the columns are given instead.
"""

import csv
import re
import warnings
from collections.abc import Mapping, Sequence

import numpy as np

from viscorough.basics import units
from viscorough.basics.arrays import whole_number
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, FilePath
from viscorough.io.matrices import delimiter_of, is_text, lines_of, number_of, refuse_decimal_commas
from viscorough.io.refusals import Refused, path_named, reading
from viscorough.media.load import Load

# Negative forces down to this share of the largest force count as noise of the force sensor before or after contact.
_NOISE = 1e-2
_HEADING = re.compile(r"\s*(time|force|depth)\s*(?:\(([^()]*)\))?\s*", re.IGNORECASE)


def read_load(
    path: FilePath,
    kind: str = "force",
    length_unit: str = "m",
    columns: Mapping[str, int] | None = None,
) -> Load:
    """Read a history of force or depth from a CSV file with columns of times and values.

    The headings are "time (s)" and "force (mN)" or "depth (nm)", in either order and with any unit of the right
    dimension. Other columns are ignored if they have other names. Negative forces of less than 1 % of the largest
    force, as before contact, are set to 0, with an AccuracyWarning.

    Parameters
    ----------
    path : path
        Text with one delimiter: comma, semicolon or tab.
    kind : {"force", "depth"}, optional
        Quantity to read.
    length_unit : str, optional
        Unit of length of the indenter, "1" if it is not known: numbers are then in consistent units, and the headings
        have no units. Otherwise times are converted to s, forces to N and depths to m.
    columns : mapping, optional
        Numbers of columns, from 1, such as ``{"time": 1, "force": 3}``, for a file without headings. Times are then in
        s, forces in N and depths in the unit of length of the indenter.

    Returns
    -------
    Load

    Raises
    ------
    ValueError
        For a file that is missing or damaged, for headings that are missing, double or without a unit, and for numbers
        that Load refuses. The one-line message names the file.

    Examples
    --------
    >>> import tempfile
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with open(f"{folder}/force.csv", "w") as file:
    ...         _ = file.write("time (ms),force (mN)\\n0,1\\n500,3\\n")
    ...     load = viscorough.read_load(f"{folder}/force.csv", length_unit="m")
    >>> load.time.tolist(), load.force.tolist()
    ([0.0, 0.5], [0.001, 0.003])
    """
    if kind not in ("force", "depth"):
        raise ValueError(f"kind {kind!r}; allowed: force, depth")
    if columns is not None:
        columns = _checked_columns(columns, kind)
    unit = units.UNKNOWN if length_unit == units.UNKNOWN else "m"
    wanted = {"time": "s", kind: "N" if kind == "force" else unit}
    with reading(path, f"columns of times and {kind}s are needed"):
        with open(path, "rb") as file:
            content = file.read()
        if not is_text(content):
            raise Refused(f"it is no text; a CSV file with the columns {_named(wanted)} is needed")
        times, values = _read(lines_of(content), wanted, length_unit, columns)
    with path_named(path):
        return Load(times, **{kind: _without_noise(path, values) if kind == "force" else values})


def _checked_columns(columns: Mapping[str, int], kind: str) -> dict[str, int]:
    """Return the numbers of the columns of times and of the quantity `kind`."""
    if not isinstance(columns, Mapping) or not {"time", kind} <= columns.keys() <= {"time", "force", "depth"}:
        raise ValueError(f"argument columns: the numbers of the columns of time and {kind} are needed")
    chosen = {name: whole_number(f"argument columns {name}", columns[name], 1) for name in ("time", kind)}
    if chosen["time"] == chosen[kind]:
        raise ValueError(f"argument columns: time and {kind} are in the same column; two columns are needed")
    return chosen


def _named(wanted: Mapping[str, str]) -> str:
    """Return the headings that are needed, as in "time (s) and force (N)"."""
    return " and ".join(name if unit == units.UNKNOWN else f"{name} ({unit})" for name, unit in wanted.items())


def _read(
    lines: Sequence[str], wanted: Mapping[str, str], length_unit: str, columns: Mapping[str, int] | None
) -> list[Array]:
    """Return the numbers of the wanted columns, in the wanted units.

    wanted : {name of a column: unit}
    columns : {name of a column: its number}, for lines without headings
    """
    numbers = [number for number, line in enumerate(lines, 1) if line.strip() and not line.startswith("#")]
    if len(numbers) < 2:
        raise Refused(f"it has no rows; the columns {_named(wanted)} are needed")
    first = numbers[0]
    delimiter = delimiter_of(lines[first - 1])
    rows = [_cells(lines[number - 1], delimiter) for number in numbers]
    if columns is None:
        places, factors = _places(rows[0], wanted, length_unit)
        rows, numbers, width = rows[1:], numbers[1:], len(rows[0])
    else:
        places, factors = [columns[name] - 1 for name in wanted], [1.0, 1.0]
        if "depth" in wanted and length_unit != units.UNKNOWN:
            factors[1] = units.metres(length_unit)
        width = len(rows[0])
        if delimiter == ",":
            refuse_decimal_commas([",".join(cells) for cells in rows])
        if max(places) >= width:
            raise Refused(f"argument columns {max(places) + 1}: line {first} has {width} columns")
        if any(re.search(r"[^\W\d]", re.sub(r"(?i)nan|\de[-+]?\d", "", rows[0][place])) for place in places):
            text = f"line {first} is a heading, with argument columns; name its columns {_named(wanted)}"
            raise Refused(f"{text}, or remove the heading")
    found: list[list[float]] = [[], []]
    for number, cells in zip(numbers, rows, strict=True):
        if len(cells) != width:
            raise Refused(
                f"line {number} has {len(cells)} cells, line {first} has {width}; rows of one length are needed"
            )
        for values, place in zip(found, places, strict=True):
            values.append(number_of(cells[place], number))
    return [np.array(values) * factor for values, factor in zip(found, factors, strict=True)]


def _cells(line: str, delimiter: str | None) -> list[str]:
    """Return the cells of a line; cells in quotation marks may contain the delimiter."""
    if delimiter is None:
        return line.split()
    return next(csv.reader([line], delimiter=delimiter))


def _places(headings: Sequence[str], wanted: Mapping[str, str], length_unit: str) -> tuple[list[int], list[float]]:
    """Return the indices of the wanted columns, and the factors that convert their numbers to the wanted units."""
    places, factors = [], []
    for name, unit in wanted.items():
        found = [(place, match) for place, text in enumerate(headings) if (match := _HEADING.fullmatch(text))]
        found = [(place, match) for place, match in found if match[1].lower() == name]
        if len(found) != 1:
            heads = ", ".join(repr(text.strip()[:30]) for text in headings[:6])
            text = f"{'no' if not found else 'more than one'} column is named {name}; the headings are {heads}"
            way = f"{_named(wanted)} are needed, or argument columns for a file without headings"
            raise Refused(f"{text}; {way}")
        (place, match), stated = found[0], (found[0][1][2] or "").strip()
        if bool(stated) != (length_unit != units.UNKNOWN):
            known = (
                "not known, so that no heading may have one"
                if stated
                else f"{length_unit}, so that each needs one, as in {_named(wanted)}"
            )
            raise Refused(f"heading {headings[place].strip()!r}: the unit of length of the indenter is {known}")
        places.append(place)
        factors.append(units.factor(stated, unit) if stated else 1.0)
    return places, factors


def _without_noise(path: FilePath, forces: Array) -> Array:
    """Set small negative forces to 0, with an AccuracyWarning; larger negative forces remain."""
    largest, least = forces.max(), forces.min()
    if not -_NOISE * largest <= least < 0:
        return forces
    text = f"{np.count_nonzero(forces < 0)} forces below 0, down to {least:.3g}, count as noise and are set to 0"
    warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=3)
    return np.maximum(forces, 0.0)
