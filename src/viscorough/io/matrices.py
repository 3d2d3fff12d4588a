"""Read matrices of numbers: .npy files and text. Neither states a spacing or a unit.

A text has one delimiter (spaces, tab, comma or semicolon), points as decimal marks, and the same number of cells in
every row. Lines that start with # above or below the rows are comments. The word nan marks missing points. All other
texts are refused, since their meaning would be a guess. A text with a single row or column is a line of heights.
"""

import io
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from viscorough.basics.types import Array
from viscorough.io.refusals import Refused
from viscorough.io.scan import Scan

# Control characters that occur in no text file. \x1a is left out, since it ends text files of DOS.
_CONTROLS = bytes(set(range(32)) - set(b"\t\n\v\f\r\x1a"))
_UTF16 = (b"\xff\xfe", b"\xfe\xff")
DELIMITERS = (";", "\t", ",")
_NAN = re.compile(r"(?<![^\s,;])[+-]?nan(?![^\s,;])", re.IGNORECASE)
_NUMBER = re.compile(r"\s*[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|nan)\s*", re.ASCII | re.IGNORECASE)
_NO_NUMBER = re.compile(r"[^0-9eE+\-.,; \t]")
_FRACTION = re.compile(r"\d+(?:e[-+]?\d+)?", re.ASCII | re.IGNORECASE)
# A comment may not contain a unit, a word that announces one, or a number after a colon or an equals sign.
_STATEMENT = re.compile(
    r"(?<![^\W\d_])(?:[kcdmuµμnpf]?m|Å|inch|m?V|m?rad|deg|px)(?![^\W\d_])|°|[:=]\s*[-+]?[.,]?\d"
    r"|(?i:(?:cell|size|d[xy]\b|step|pitch|width|length|distance|sampling)\w*\W*\d|met(?:er|re)|mi[ck]ron|mikrom|angstr|ångstr|unit|einheit|unité|pixel|spacing|resolution|scale)"
)
# A text with at most this many columns or rows may be a table of points, a profile or a record.
_MOST_OF_TABLES = 6
# A table of points has more than this many times as many rows as columns.
_ELONGATION = 2
# A row or column at the edge holds positions if at least this many numbers, or all, rise or fall in equal steps.
_LEAST_LABELS = 4
# Steps are equal if they differ from their mean by at most this share, as rounding of positions can cause.
_UNEVENNESS = 0.02
# A .npy array of three columns holds points x, y, z if it has at least this many rows.
_LEAST_POINTS = 9


def is_npy(content: bytes, name: str) -> bool:
    """Return True if a file is named .npy or begins like a .npy file."""
    return Path(name).suffix.lower() == ".npy" or content.startswith(np.lib.format.MAGIC_PREFIX)


def is_text(content: bytes) -> bool:
    """Return True if the content of a file is text: UTF-16 with a byte order mark, or without control characters."""
    return content.startswith(_UTF16) or len(content.translate(None, _CONTROLS)) == len(content)


def lines_of(content: bytes) -> list[str]:
    """Return the lines of a text in UTF-16 with a byte order mark, UTF-8 or Windows-1252, without the last line end."""
    if content.startswith(_UTF16):
        text = content.decode("utf-16", errors="replace")
    else:
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = content.decode("cp1252", errors="replace")
    return text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\n\x1a").split("\n")


def delimiter_of(line: str) -> str | None:
    """Return the delimiter of the cells in a line; None for spaces. Raises ValueError for several delimiters."""
    found = [mark for mark in DELIMITERS if mark in line.strip(" ")]
    if len(found) > 1:
        text = f"{found[0]!r} and {found[1]!r} in one row; one delimiter, and points as decimal marks, are needed"
        raise Refused(text)
    return found[0] if found else None


def read_npy(content: bytes, name: str) -> Scan:
    """Read a .npy file of heights. Raises ValueError for pickled objects, and for columns x, y, z."""
    heights = np.lib.format.read_array(io.BytesIO(content), allow_pickle=False)
    if heights.ndim == 2 and heights.shape[1] == 3 and len(heights) >= _LEAST_POINTS:
        raise Refused(_way_from_points(f'np.load("{name}")'))
    return Scan(heights)


def read_text(content: bytes, name: str) -> Scan:
    """Read a matrix of heights, or a line of heights, from text.

    Raises ValueError for a text with words, with several delimiters, with rows of different lengths, with a comment
    that states a unit, and for a table that may hold points, positions or a profile.
    """
    lines = lines_of(content)
    numbers = [number for number, line in enumerate(lines, 1) if line.strip() and not line.startswith("#")]
    if not numbers:
        raise Refused("no row of numbers; a matrix of heights is needed")
    first, last = numbers[0], numbers[-1]
    for number, line in enumerate(lines, 1):
        if line.startswith("#") and _STATEMENT.search(line):
            text = "holds a unit or a number, which are not read from text"
            raise Refused(f"line {number} ({line[:60]!r}) {text}; save as .gwy or NetCDF, or remove the line")
        if first < number < last and (not line.strip() or line.startswith("#")):
            raise Refused(f"line {number} separates two matrices; one matrix is needed")
    table = _table(lines[first - 1 : last], first)
    if 1 in table.shape:
        return Scan(table.ravel())
    _refuse_tables(table, name, delimiter_of(lines[first - 1]))
    return Scan(table)


def _table(rows: Sequence[str], first: int) -> Array:
    """Convert rows to numbers, shape (rows, columns).

    first : line number of the first row, for messages
    """
    try:
        delimiter = delimiter_of(rows[0])
    except Refused as error:
        raise Refused(f"line {first} has {error}") from error
    values: list[list[float]] = []
    for number, row in enumerate(rows, first):
        if found := _NO_NUMBER.search(_NAN.sub("0", row)):
            text = f"line {number} ({row[:40]!r}) has {found[0]!r} in it; a matrix of numbers alone, with points as"
            raise Refused(f"{text} decimal marks and nan for missing points, is needed")
        cells = row.strip(" ").split(delimiter)
        if len(cells) != (count := len(values[0]) if values else len(cells)):
            text = f"line {number} has {len(cells)} cells, line {first} has {count}"
            raise Refused(f"{text}; rows of one length are needed")
        try:
            values.append([float(cell) for cell in cells])
        except ValueError:
            values.append([number_of(cell, number) for cell in cells])  # raises an error for the cell
    if delimiter == ",":
        refuse_decimal_commas(rows)
    return np.array(values)


def refuse_decimal_commas(rows: Sequence[str]) -> None:
    """Raise ValueError if the commas in rows without points may be decimal marks as well as delimiters."""
    cells = [row.split(",") for row in rows]
    fractions = [fraction.strip() for row in cells for fraction in row[1::2]]
    in_pairs = len(cells[0]) % 2 == 0 and len(cells[0]) > 2 and all(map(_FRACTION.fullmatch, fractions))
    if in_pairs and not any("." in row for row in rows):
        raise Refused("its commas may be decimal marks; another delimiter, and points as decimal marks, are needed")


def number_of(cell: str, line: int) -> float:
    """Convert a cell to a number. Raises ValueError, with the number of the line, for other texts."""
    if _NUMBER.fullmatch(cell):
        return float(cell)
    if not cell.strip():
        raise Refused(f"line {line} has an empty cell; numbers are needed, or nan if one is missing")
    marks = "; one delimiter, and points as decimal marks, are needed" if re.search(r"[,\s]", cell.strip()) else ""
    raise Refused(f"line {line} has {cell.strip()[:40]!r}, which is no number{marks}")


def _refuse_tables(table: Array, name: str, delimiter: str | None) -> None:
    """Raise ValueError for a table that may hold points, positions, or a profile, and no map of heights."""
    rows, columns = table.shape
    few, many = sorted(table.shape)
    if columns == 3 and rows > 3:
        separated = f', float, "#", {delimiter!r}' if delimiter else ""
        raise Refused(_way_from_points(f'np.loadtxt("{name}"{separated})'))
    distinct = [np.unique(table[:, column]).size for column in (0, 1)]
    are_points = columns <= _MOST_OF_TABLES and min(distinct) > 1 and distinct[0] * distinct[1] <= 2 * rows
    if few < 3 or (few == 3 and many > 3) or (few <= _MOST_OF_TABLES and many > _ELONGATION * few) or are_points:
        raise Refused(
            f"a table of {rows} by {columns} may hold points or a profile; a profile has a single column of heights, "
            "and a map of any shape is read from .npy"
        )
    for vectors, edge in ((table.T, "column"), (table, "row")):
        for start in (0, 1):  # the corner of a table with positions along both edges may hold any number
            least = min(_LEAST_LABELS, many)
            if _is_even(vectors[0, start:], least) and not _is_even(vectors[1, start:], least):
                raise Refused(f"the first {edge} rises or falls evenly, as positions do; heights alone are needed")


def _is_even(values: Array, least: int) -> bool:
    """Return True if at least this number of values rise or fall in equal steps."""
    with np.errstate(all="ignore"):
        steps = np.diff(values)
        mean = steps.mean()
        return values.size >= least and mean != 0 and bool(np.abs(steps / mean - 1).max() <= _UNEVENNESS)


def _way_from_points(load: str) -> str:
    """Return a message that refuses points x, y, z, with the lines of numpy that make a map of them.

    load : call that returns the points
    """
    grid = "p = p[np.lexsort(p.T[:2])]; x, y = map(np.unique, p.T[:2]); assert (p[:, 0].reshape(y.size, -1) == x).all()"
    steps = 'print(np.diff(x), np.diff(y)); np.save("map.npy", p[:, 2].reshape(y.size, -1))'
    text = "three columns, as of points x, y, z, are no map; points on a grid of equal steps become one in Python"
    return f"{text}: import numpy as np; p = {load}; {grid}; {steps}"
