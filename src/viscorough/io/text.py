"""Maps of heights in text files: matrices, ESRI ASCII grids, and columns x, y, z of the points of a grid.

Lines before the first row of numbers, and lines that start with #, %, // or ;, are comments. What they state about
spacing and units is used: as Gwyddion ("Width: 12.34 µm"), optical profilers ("pixel size=3.7e-07 m") and tables of
points ("x [µm]") write it.
"""

import io
import re
from pathlib import Path

import numpy as np

from viscorough.io.atomic import reason
from viscorough.io.grids import gridded
from viscorough.io.scan import Scan

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?"
_MISSING = r"[+-]?(?:nan|inf|na|n/a|null|bad|void|no data|\*+|-{2,})"
_FIELD = re.compile(rf"(?:{_NUMBER}|{_MISSING}|)", re.IGNORECASE)
_GAPS = re.compile(r"(?<![^\s,;])(?:na|n/a|null|bad|void|no data|\*+|-{2,})(?![^\s,;])", re.IGNORECASE)
_UTF16 = (b"\xff\xfe", b"\xfe\xff")
_COMMENT = ("#", "%", "//", ";")
_REMARK = re.compile(r"\s[#%].*")
_LENGTH = rf"({_NUMBER})[ \t]*([^\d\s,;)]*)"
_WIDTH = re.compile(rf"\b(?:width|breite|scan ?size ?x|x[ _-]?size)\s*[:=]\s*{_LENGTH}", re.IGNORECASE)
_HEIGHT = re.compile(rf"\b(?:height|höhe|scan ?size ?y|y[ _-]?size)\s*[:=]\s*{_LENGTH}", re.IGNORECASE)
_PIXEL = re.compile(rf"\b(?:pixel ?size|(?:x[ _-]?)?spacing|dx)\s*[:=]\s*{_LENGTH}", re.IGNORECASE)
_PIXEL_Y = re.compile(rf"\b(?:y[ _-]?spacing|dy)\s*[:=]\s*{_LENGTH}", re.IGNORECASE)
_UNIT = re.compile(r"\b(?:value units?|werteinheit(?:en)?|z[ _-]?units?|units?)\s*[:=]\s*([^\s,;]+)", re.IGNORECASE)
_FACTOR = re.compile(rf"height conversion factor \(-> (\w+)\)\s*=\s*({_NUMBER})", re.IGNORECASE)
_COLUMN_UNIT = re.compile(r"\b([xyz])\b\w*\s*[\[(]\s*([^\])]+?)\s*[\])]", re.IGNORECASE)
_ESRI = re.compile(rf"^\s*(ncols|nrows|cellsize|dx|dy|nodata_value)\s+({_NUMBER})\s*$", re.IGNORECASE | re.MULTILINE)


def read_text(path):
    """The Scan in a text file. Raises a one-line ValueError if it holds no map of heights."""
    header, rows = _lines(_decoded(path))
    if not rows:
        raise ValueError(f"{path}: no row of numbers; a matrix of heights, or columns x, y, z, is needed")
    table = _numbers(path, rows)
    esri = {key.lower(): float(number.replace("D", "e")) for key, number in _ESRI.findall(header)}
    if {"ncols", "nrows"} <= set(esri):
        return _esri_scan(path, table, esri)
    spacing, spacing_unit = _header_spacing(header, table.shape)
    columns = {name.lower(): unit for name, unit in _COLUMN_UNIT.findall(header)}
    are_points = str(path).lower().endswith(".xyz") or (table.shape[1] == 3 and set(columns) == set("xyz"))
    if are_points or (table.shape[1] == 3 and spacing is None):
        grid = gridded(table, required=are_points)
        if grid is not None:
            return _xyz_scan(path, grid, columns, header)
    unit, factor = _header_unit(header)
    return Scan(table if factor == 1 else factor * table, unit, spacing, spacing_unit)


def is_binary(path):
    """Whether a file cannot be text. Raises a one-line ValueError if it cannot be read."""
    return b"\x00" in (start := _content(path, 4096)) and not start.startswith(_UTF16)


def _content(path, size=-1):
    """The first bytes of a regular file."""
    try:
        if Path(path).is_fifo():  # opening it would wait for a writer
            raise ValueError(f"{path}: not readable (it is a pipe); a text file of heights is needed")
        with open(path, "rb") as file:
            return file.read(size)
    except OSError as error:
        raise ValueError(f"{path}: not readable ({reason(error)}); a text file of heights is needed") from error


def _decoded(path):
    """The text of a file, in the encodings that instruments use."""
    content = _content(path)
    if content.startswith(_UTF16):
        return content.decode("utf-16", errors="replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _lines(text):
    """The header, with all comments, and the lines with rows of numbers.

    Raises ValueError if the line before the first row starts like a row: a height must not be lost for a misprint.
    """
    lines = [line.strip(" ") for line in text.replace('"', "").splitlines()]
    if "#" in text or "%" in text:
        lines = [line if line.startswith(_COMMENT) else _REMARK.sub("", line) for line in lines]
    first = next((number for number, line in enumerate(lines) if _is_row(line)), len(lines))
    before = next((line for line in reversed(lines[:first]) if line.strip()), "")
    if first < len(lines) and re.match(_NUMBER, before) and len(before.split()) == len(lines[first].split()):
        raise ValueError(f"line {first} ({before[:40]!r}) is not a row of numbers; numbers or a comment are needed")
    comments, rows = lines[:first], []
    for line in lines[first:]:
        if line.startswith(_COMMENT):
            comments.append(line)
        elif line.strip():
            rows.append(line)
    return "\n".join(comments), rows


def _is_row(line):
    """Whether a line holds numbers only; at least one of them, so that a line of marks is none."""
    line = _GAPS.sub("nan", line)
    if line.startswith(_COMMENT) or not re.search(r"\d|nan", line, re.IGNORECASE):
        return False
    fields = re.split(r"[;\t]|,(?!\d)|(?<!\d),|\s+", line)
    return all(_FIELD.fullmatch(part) for field in fields for part in field.split(","))


def _numbers(path, rows):
    """The rows as an array of two dimensions; missing values are nan."""
    delimiter, decimal = _punctuation(rows[0])
    if decimal == ",":
        rows = [row.replace(",", ".") for row in rows]
    text = "\n".join(rows)
    if _GAPS.search(text):
        text = _GAPS.sub("nan", text)
    if delimiter is not None:
        if all(row.endswith(delimiter) for row in rows):
            text = "\n".join(row[:-1] for row in text.split("\n"))
        if all(row.startswith(delimiter) for row in rows):
            text = "\n".join(row[1:] for row in text.split("\n"))
        mark = re.escape(delimiter)
        empty = re.compile(rf"(?:(?<={mark})|^)[ ]*(?={mark}|$)", re.MULTILINE)
        if delimiter * 2 in text or re.search(rf"{mark}\s*{mark}|^{mark}|{mark}$", text, re.MULTILINE):
            text = empty.sub("nan", text)
    try:
        with np.errstate(over="ignore"):
            return np.loadtxt(io.StringIO(text), delimiter=delimiter, ndmin=2, comments=None)
    except ValueError as error:
        fault = re.sub(r";? ?use `usecols`.*", "", reason(error))
        raise ValueError(f"{path}: not a matrix of numbers ({fault}); rows of equal length are needed") from error


def _punctuation(row):
    """(delimiter, decimal mark) of a row of numbers; the delimiter is None for white space."""
    for delimiter in (";", "\t"):
        if delimiter in row:
            has_commas = "," in row and "." not in row
            return (
                delimiter if delimiter == ";" or "\t\t" in row or not has_commas else None,
                "," if has_commas else ".",
            )
    if "," not in row:
        return None, "."
    fields = row.split()
    if len(fields) > 1 and all(re.fullmatch(r"[+-]?\d+,\d+(?:[eE][+-]?\d+)?", field) for field in fields):
        return None, ","
    return ",", "."


def _header_spacing(header, shape):
    """((dx, dy), unit) that a header states; (None, "1") for none."""
    sizes = [pattern.search(header) for pattern in (_WIDTH, _HEIGHT)]
    if all(sizes):
        return _pair(*((match, count) for match, count in zip(sizes, shape[::-1], strict=True)))
    if pixel := _PIXEL.search(header):
        return _pair((pixel, 1), (_PIXEL_Y.search(header) or pixel, 1))
    return None, "1"


def _pair(across, along):
    """The lengths of two matches, each divided by a count, in the unit of the first."""
    from viscorough import units

    (dx, unit), (dy, other) = ((float(match[1]) / count, match[2] or "1") for match, count in (across, along))
    if unit != other:
        if "1" in (unit, other):
            raise ValueError("the header states a unit for one direction only; one for both, or none, is needed")
        dy *= units.metres(other) / units.metres(unit)
    return (float(f"{dx:.14g}"), float(f"{dy:.14g}")), unit


def _header_unit(header):
    """(unit, factor) of the heights: the numbers in the file times the factor are in the unit."""
    if conversion := _FACTOR.search(header):
        return conversion[1], float(conversion[2])
    unit = _UNIT.search(header)
    return (unit[1] if unit else "1"), 1


def _esri_scan(path, table, esri):
    """A grid with the keys ncols, nrows, cellsize (or dx, dy) and nodata_value."""
    columns, rows = esri["ncols"], esri["nrows"]
    if table.size != columns * rows or columns % 1 or rows % 1:
        raise ValueError(f"{path}: {table.size} numbers; {columns:g} columns and {rows:g} rows are needed")
    table = table.reshape(int(rows), int(columns))
    mark = esri.get("nodata_value", -9999.0)
    heights = np.where(table == mark, np.nan, table)
    sides = esri.get("dx", esri.get("cellsize")), esri.get("dy", esri.get("cellsize"))
    return Scan(heights, spacing=None if None in sides else sides)


def _xyz_scan(path, grid, columns, header):
    """A grid of points, with the units that the header states for its columns."""
    heights, spacing = grid
    lateral = [columns.get(name, "1") for name in "xy"]
    if lateral[0] != lateral[1]:
        raise ValueError(f"{path}: x is in {lateral[0]}, y in {lateral[1]}; one unit is needed")
    stated, _ = _header_unit(header)
    return Scan(heights, columns.get("z", stated), spacing, lateral[0])
