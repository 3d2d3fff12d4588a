"""Read profiles from text files: heights along a line, with or without positions x, in columns or rows.

Delimiters, decimal marks, missing values, comments and headers are read as in maps (io.text, io.headers).
"""

import re

import numpy as np

from viscorough.basics import units
from viscorough.basics.types import Array, FilePath
from viscorough.io.grids import even_spacing
from viscorough.io.headers import names_profile, read_header
from viscorough.io.scan import Scan
from viscorough.io.text import Table, decoded_lines, is_own_table, parsed

# A profile has at least this many points. With only two points, x and z could be the rows or the columns of the table.
_LEAST_POINTS = 3
# The distance between positions and the spacing that the header states may differ by at most this share.
_STEPS_AGREE = 1e-3


def read_profile(path: FilePath) -> Scan:
    """Read a profile from a text file as a Scan with heights of shape (points,), in increasing order of x.

    A single column or row holds heights; two columns or rows hold x and z. If a heading names x and z, columns may have
    any order, and columns other than x and z are ignored. Positions 0, 1, 2, … or 1, 2, 3, … without a unit and a name
    only number the points, so no spacing follows from them.

    Raises a one-line ValueError unless the file can be recognised as a profile.
    """
    lines = decoded_lines(path)
    table = parsed(lines)
    texts = [*table.header, *table.comments]
    rows, count = table.values.shape
    points = count if rows <= 2 else rows
    header = read_header(texts, (1, points), table.decimal, profile_columns=count)
    columns = header.columns
    if table.esri or (is_own_table(lines) and columns is None):
        raise ValueError("the file holds no heights along a line; one column, or columns x and z, are needed")
    if table.separated:
        raise ValueError(f"line {table.separated}: empty lines separate it from the rows above; one line is needed")
    x, heights = _positions_and_heights(table, columns)
    if missing := np.count_nonzero(np.isnan(heights)):
        text = f"{missing} of {heights.size} heights are missing"
        raise ValueError(f"{text}; every point of a line needs a height, so cut it or fill the gaps first")
    step = float("nan") if header.spacing is None else header.spacing[0]
    if x is not None and not (columns is None and header.lateral_unit == units.UNKNOWN and _counts_points(x)):
        spacing = _spacing(x)
        if abs(step - spacing) > _STEPS_AGREE * spacing:
            text = f"spacing {step:g} in the header, {spacing:g} between positions x"
            raise ValueError(f"{text}; statements that agree are needed")
        step, heights = spacing, heights if x[0] < x[-1] else heights[::-1]
    spacing = None if np.isnan(step) else (step, step)
    return Scan(heights, header.unit, spacing, header.lateral_unit, mentions=header.mentions)


def holds_profile(path: FilePath) -> bool:
    """Return True if a text file holds a profile and not a map.

    A profile has one or two rows or columns, or a heading that names columns x and z.

    Raises a one-line ValueError unless the file certainly holds a table.
    """
    lines = decoded_lines(path)
    if lines[0].startswith("Zygo XYZ Data File") or str(path).lower().endswith(".xyz"):
        return False
    table = parsed(lines)
    if table.esri or min(table.values.shape) <= 2:
        return not table.esri
    return names_profile([*table.header, *table.comments], table.values.shape[1])


def _positions_and_heights(table: Table, columns: tuple[str, ...] | None) -> tuple[Array | None, Array]:
    """Return (positions x, heights) of the points in a table; positions are None if the table holds heights only.

    columns : names of the columns in the heading; None if there is no heading

    Raises ValueError for a table that does not have the shape of a profile, and for columns of uncertain meaning.
    """
    values = table.values
    if columns is not None:
        x, heights = (values[:, columns.index(name)] for name in "xz")
    elif min(values.shape) > 2:
        text = f"{len(values)} rows of {values.shape[1]} numbers; a line is a single column or row, two of x and z"
        raise ValueError(f"{text}, or columns under a heading such as 'x [um], z [nm], n'; read_heights reads maps")
    else:
        _check_not_named(table)
        ordered = values.T if values.shape[0] > values.shape[1] else values
        x, heights = (ordered[0], ordered[1]) if len(ordered) == 2 else (None, ordered[0])
    if heights.size < _LEAST_POINTS:
        raise ValueError(f"{values.size} numbers; a line of at least {_LEAST_POINTS} points is needed")
    return x, heights


def _check_not_named(table: Table) -> None:
    """Raise ValueError if the line above the first row names two columns other than x and z."""
    filled = [line for line in table.header if line.strip()]
    line = filled[-1].strip("#%/;!| \t") if filled else ""
    names = [name.strip(' "') for name in line.split(table.delimiter)]
    if len(names) == table.values.shape[1] == 2 and all(re.match(r"[^\W\d_]", name) for name in names):
        raise ValueError(f"{line[:60]!r} names two columns; a heading such as 'x [um], z [nm]' is needed for x and z")


def _counts_points(x: Array) -> bool:
    """Return True if positions only number the points: 0, 1, 2, … or 1, 2, 3, …."""
    return any(np.array_equal(x, np.arange(first, first + x.size)) for first in (0, 1))


def _spacing(x: Array) -> float:
    """Return the distance between neighbouring positions. Raises ValueError if positions are not equally spaced."""
    spacing = even_spacing(x)
    if spacing is None:
        if np.isfinite(x).all():
            with np.errstate(over="ignore"):
                steps = np.diff(x)
            text = f"positions x are not equally spaced: their steps lie between {steps.min():g} and {steps.max():g}"
        else:
            text = "positions x are not finite everywhere"
        way = "heights at equal steps, interpolated for instance by numpy.interp, are needed"
        raise ValueError(f"{text}; {way}")
    return spacing
