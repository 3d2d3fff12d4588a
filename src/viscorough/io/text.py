"""Maps of heights in text files: matrices, ESRI ASCII grids, and columns x, y, z of the points of a grid.

A table of one or two rows or columns may be a profile (io.profiles). It is a map only if the user gives the distances
in both directions.

Lines before the first row of numbers are a header, and lines that start with #, %, //, ! or ; are comments; ; starts a
row where semicolons delimit the table. What they state about spacing and units is used (io.headers). A file is refused
where its delimiter, its decimal mark or the number of its cells is not certain: every row has the same number of cells,
and nothing is left out but comments.
"""

import io
import re
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from viscorough.argument_names import spelled
from viscorough.io.atomic import reading, reason
from viscorough.io.grids import even_spacing, gridded
from viscorough.io.headers import Spacing, read_header, states
from viscorough.io.scan import Scan
from viscorough.io.zygo import zygo_scan
from viscorough.types import Array, FilePath

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?"
_MISSING = (
    r"[+-]?nan|n/?a|n\.a\.|#n/?a!?|#nv|none|null|bad|void|masked|missing|no ?data|[+-]?1\.#(?:qnan|ind)0*"
    r"|\?+|\*+|[-–—]+"
)
_FIELD = re.compile(rf"{_NUMBER}|[+-]?inf(?:inity)?|{_MISSING}|", re.IGNORECASE)
_MARK = re.compile(rf"(?<![^\s,;])(?:{_MISSING})(?![^\s,;])", re.IGNORECASE)
_ALMOST_A_NUMBER = re.compile(rf"[^\w\s]*\s?\d.*|{_MISSING}", re.IGNORECASE)
_HASH = r"#(?!n/?a\b|nv\b|[^\W\d]+(?:/0)?[!?])"  # not that of a mark such as #N/A or #DIV/0!
_COMMENT = re.compile(rf"[ \t]*(?:[%;!]|//|{_HASH})", re.IGNORECASE)
_DIGITS = re.compile(r"\d[^:=]*[\s;,\"][^:=]*\d")
_QUOTED = re.compile(r'"([^".]*|[^",]*)"')  # commas are decimal, without points beside them
_REMARK = re.compile(rf"\s(?:{_HASH}|%)(?:\s*[^\W\d].*|\s*$)", re.IGNORECASE)
_ROW_NUMBERS = re.compile(r"rows?|index|nos?\.?|nr\.?|zeilen?|lines?|lignes?", re.IGNORECASE)
_PLAIN = b"0123456789.,;+-eE \t\n"  # a body of other characters holds marks of missing points
_ESRI_KEY = re.compile(r"(?i)^\s*(ncols|nrows|cellsize|dx|dy|nodata_value|[xy]ll(?:corner|center))\s+(\S+)\s*$")
_CONTROLS = bytes(set(range(32)) - set(b"\t\n\v\f\r\x1a"))  # characters that no text holds; \x1a ends it under DOS
_LEAST_LABELS = 6  # evenly spaced numbers that are taken for positions rather than heights
_LEAST_POSITIONS = 10  # the same for numbers that rise, or fall, in any steps
_MOST_OF_PROFILES = 4  # columns of a table that may be x, z, a second quantity, and a number


class Table(NamedTuple):
    """The numbers in a text file, and the lines that are no rows of numbers.

    values : shape (rows, columns); missing values are nan
    header : lines above the first row
    comments : lines between and below the rows
    delimiter, decimal : of the rows; the delimiter is None for white space
    separated : number of the first line that empty lines separate from the rows above; 0 if there is none
    esri : keys of an ESRI grid and their numbers; empty for other files
    """

    values: Array
    header: list[str]
    comments: list[str]
    delimiter: str | None
    decimal: str
    separated: int
    esri: dict[str, float]


def read_text(path: FilePath, *, is_map: bool = False) -> Scan:
    """The Scan in a text file.

    is_map : whether the user stated that the table is a map; else one of at most two rows or columns is refused as a
        profile, unless it is an ESRI grid

    Raises a one-line ValueError if the file holds no map of heights, or none for certain.
    """
    lines = decoded_lines(path)
    if lines[0].startswith("Zygo XYZ Data File"):
        return zygo_scan(lines)
    if is_own_table(lines):
        raise ValueError("a table that viscorough wrote holds no map of heights; one is needed")
    table = parsed(lines)
    if table.esri:
        return _esri_scan(table.values, table.esri)
    unit, spacing, lateral_unit, columns = read_header(
        [*table.header, *table.comments], table.values.shape, table.decimal
    )
    points = table.values if columns is None else table.values[:, [columns.index(name) for name in "xyz"]]
    grid = _grid(points, spacing, required=columns is not None or str(path).lower().endswith(".xyz"))
    if grid is not None:
        heights, spacing = grid
        return Scan(heights, unit, spacing, lateral_unit)
    if not is_map:
        _check_not_profile(table.values.shape)
    if table.separated:
        raise ValueError(f"line {table.separated}: empty lines separate it from the rows above; one map is needed")
    _check_positions(table.values)
    return Scan(table.values, unit, spacing, lateral_unit)


def parsed(lines: Sequence[str]) -> Table:
    """The Table in the lines of a file. Raises a one-line ValueError if there is none, or none for certain."""
    first = next((number for number, line in enumerate(lines) if _is_row(line)), None)
    if first is None:
        almost = [f" (line {number} is {line[:40]!r})" for number, line in enumerate(lines, 1) if _DIGITS.search(line)]
        raise ValueError(f"no row of numbers{''.join(almost[:1])}; a matrix of heights, or columns x, y, z, is needed")
    rows, comments, separated = _rows(lines, first)
    delimiter, decimal = _punctuation(rows)
    cells = next(iter(rows.values())).split(delimiter)
    values = _values(rows, delimiter, decimal)
    header = list(lines[:first])
    esri = _esri(header)
    _check_above(header, delimiter, {values.shape[1], len(cells)}, esri)
    return Table(values, header, comments, delimiter, decimal, separated, esri)


def is_own_table(lines: Sequence[str]) -> bool:
    """Return True for the lines of a table that viscorough wrote."""
    return any(line.startswith('# source: "viscorough') for line in lines[:100])


def is_binary(path: FilePath) -> bool:
    """Whether a file cannot be text: it has control characters. Raises a one-line ValueError if it cannot be read."""
    start = _content(path, 4096)
    return len(start.translate(None, _CONTROLS)) < len(start) and _utf16(start) is None


def _utf16(start: bytes) -> str | None:
    """The encoding of UTF-16 text, with or without a byte order mark; None for other text."""
    if start.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "utf-16"
    places = np.flatnonzero(np.frombuffer(start, np.uint8) == 0) % 2
    if not places.size or 2 * places.size < 0.9 * (len(start) // 2 * 2) or np.ptp(places):
        return None
    return "utf-16-le" if places[0] else "utf-16-be"


def _content(path: FilePath, size: int = -1) -> bytes:
    """The first bytes of a file."""
    with reading(path, "a text file of heights is needed"), open(path, "rb") as file:
        return file.read(size)


def decoded_lines(path: FilePath) -> list[str]:
    """The lines of a text file, in the encodings that instruments use, with ASCII minus signs."""
    content = _content(path)
    if encoding := _utf16(content[:4096]):
        text = content.decode(encoding, errors="replace")
    else:
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = content.decode("cp1252", errors="replace")
    return text.replace("\r\n", "\n").replace("\r", "\n").replace("\N{MINUS SIGN}", "-").split("\n")


def _is_row(line: str) -> bool:
    """Whether a line starts a table: numbers, marks of missing points and empty cells only, and at least one number."""
    line = _REMARK.sub("", _MARK.sub("nan", line.replace('"', "").strip()))
    if (_COMMENT.match(line) and not line.startswith(";")) or not re.search(r"\d|nan", line, re.IGNORECASE):
        return False
    return all(map(_FIELD.fullmatch, re.split(r"[;,\s]", line)))


def _rows(lines: Sequence[str], first: int) -> tuple[dict[int, str], list[str], int]:
    """({number of a line: row}, comments, line of the first row that empty lines separate from those above, or 0).

    Comments beside rows are removed from them; those that are returned have lines of their own. Empty lines separate
    nothing where there are as many above every row.

    Raises ValueError for a comment between rows that states something, as between two maps.
    """
    has_tabs = "\t" in lines[first].strip(" ")
    starts_row = (";",) * (";" in lines[first]) + ("\t",) * has_tabs
    rows, comments = {}, {}
    empty = [0]  # number of empty lines above each row, and below the last one
    for number, line in enumerate(lines[first:], first + 1):
        if not line.strip(" ") or (not line.strip() and not has_tabs):
            empty[-1] += 1
        elif _COMMENT.match(line) and not line.lstrip(" ").startswith(starts_row):
            comments[number] = line
        else:
            line = _REMARK.sub("", line) if "#" in line or "%" in line else line
            rows[number] = _QUOTED.sub(lambda cell: cell[1].replace(",", "."), line).strip(" ")
            if '"' in rows[number]:
                raise ValueError(f"line {number} ({line[:40]!r}) is not a row of numbers; one decimal mark is needed")
            empty.append(0)
    last, least = max(rows), min(empty[1:-1], default=0)
    for number, comment in comments.items():
        if number < last and states(comment):
            raise ValueError(f"line {number} ({comment[:40]!r}) stands between rows; one map is needed")
    following = zip([*rows][1:], empty[1:], strict=False)
    separated = next((number for number, above in following if above != least), 0)
    return rows, [*comments.values()], separated


def _punctuation(rows: dict[int, str]) -> tuple[str | None, str]:
    """(delimiter, decimal mark) of rows; the delimiter is None for white space. Raises ValueError if not certain."""
    body = "\n".join(rows.values())
    delimiter = ";" if ";" in body else "\t" if "\t" in body else None
    if "," not in body:
        return delimiter, "."
    point, tight, spaced = "." in body, re.search(r"\d,\d", body), re.search(r", | ,", body)
    if delimiter is not None:
        doubt: object = point
    elif point:
        doubt = spaced and re.search(r"(?<![\d.])\d+,\d+(?![\d.])", body)
    elif tight and re.search(r"[^,\s] +[^,\s]", body):
        return None, ","
    else:  # else one column with decimal commas, or columns of whole numbers
        one_in_each = all(line.count(",") == 1 for line in rows.values())
        doubt = tight and (spaced or one_in_each or re.search(r"(?<!\d)0\d", body))
    if doubt:
        where = next(f"line {number} ({line[:40]!r})" for number, line in rows.items())
        raise ValueError(f"{where}: commas may be decimal marks or not; decimal points, or semicolons, are needed")
    return delimiter or ",", "," if delimiter else "."


def _values(rows: dict[int, str], delimiter: str | None, decimal: str) -> Array:
    """The rows as an array of two dimensions; missing values are nan. Raises ValueError that names the line."""
    text = "\n".join(rows.values())
    if decimal == ",":
        text = text.replace(",", ".")
    odd = text.encode(errors="replace").translate(None, _PLAIN)
    if odd.replace(b"nan", b"") or any(f"-{end}" in text for end in (delimiter or " ", "\n")) or text.endswith("-"):
        text = _MARK.sub("nan", text)
        text = re.sub(r"(?<=[\d.])[dD](?=[+-]?\d)", "e", text)
    if delimiter is not None:
        text = _fill_empty_cells(text, delimiter)
    try:
        if not text.isascii():
            raise ValueError("other characters than those of numbers")
        with np.errstate(over="ignore"):
            return np.loadtxt(io.StringIO(text), delimiter=delimiter, ndmin=2, comments=None)
    except ValueError as error:
        raise ValueError(_fault([*rows], text.split("\n"), delimiter) or reason(error)) from error


def _fill_empty_cells(text: str, delimiter: str) -> str:
    """A text with nan in empty cells; a delimiter that ends, or starts, every line is left out."""
    lines = re.sub(rf"{delimiter} +", delimiter, text).split("\n")
    if all(line.endswith(delimiter) for line in lines):
        lines = [line[:-1] for line in lines]
    if all(line.startswith(delimiter) for line in lines):
        lines = [line[1:] for line in lines]
    text = "\n".join(lines)
    if f"{delimiter}{delimiter}" in text or any(not line or delimiter in (line[0], line[-1]) for line in lines):
        text = re.sub(rf"(?:(?<={delimiter})|^)(?={delimiter}|$)", "nan", text, flags=re.MULTILINE)
    return text


def _fault(numbers: Sequence[int], lines: Sequence[str], delimiter: str | None) -> str:
    """Which line is not a row of as many numbers as the first, in words; "" for none."""
    wanted = len(lines[0].split(delimiter))
    for number, line in zip(numbers, lines, strict=False):
        if not line.isascii():
            odd = next(letter for letter in line if not letter.isascii())
            return f"line {number} holds {odd!r}; numbers, and nan for missing points, are needed"
        cells = line.split(delimiter)
        if odd := next((cell for cell in cells if not _FIELD.fullmatch(cell.strip(" "))), ""):
            return f"line {number}: {odd[:40]!r} is not a number; numbers, and nan for missing points, are needed"
        if len(cells) != wanted:
            return f"line {number}: {len(cells)} cells, {wanted} in line {numbers[0]}; rows of equal length are needed"
    return ""


def _check_above(lines: Sequence[str], delimiter: str | None, counts: set[int], esri: dict[str, float]) -> None:
    """Raise ValueError if a line above the first row may be a row itself: nothing of a map is left out for a misprint.

    Such a line has as many cells as the table, with or without outer delimiters, and one of them is, or almost is, a
    number, or all that are not empty are the same or without a letter.
    """
    for number, line in enumerate(lines, 1):
        is_comment = _COMMENT.match(line) and not (delimiter == ";" and line.lstrip().startswith(";"))
        is_statement = re.search(r"[:=]", line) or (esri and _ESRI_KEY.match(line))
        if is_comment or is_statement or not line.strip(" " if delimiter == "\t" else None):
            continue
        cells = [cell.strip(' "') for cell in _REMARK.sub("", line).strip(" ").split(delimiter)]
        if delimiter is not None and len(cells) > 1 and not any(cells):
            text = "a row of empty cells apart from the others, or of another length"
            raise ValueError(f"line {number}: {text}; rows of equal length are needed")
        if len(cells) not in counts:
            continue
        of_points = {"x", "y", "z"} <= {cell.lower()[:1] for cell in cells}
        if len(cells) > 1 and _ROW_NUMBERS.fullmatch(cells[0]) and not of_points:
            raise ValueError(f"line {number} ({line[:40]!r}) heads a column of row numbers; heights alone are needed")
        filled = [cell for cell in cells if cell]
        alike = len(cells) > 1 and (len(filled) > len(set(filled)) == 1 or not re.search(r"\w", line))
        if alike or any(_ALMOST_A_NUMBER.fullmatch(cell) for cell in cells):
            raise ValueError(f"line {number} ({line[:40]!r}) is not a row of numbers; numbers or a comment are needed")


def _check_not_profile(shape: tuple[int, ...]) -> None:
    """Raise ValueError for a table of at most two rows or columns, which may hold a profile and its positions."""
    count, name = min(zip(shape, ("row", "column"), strict=True))
    if count <= 2:
        text = f"a single {name}, as of a profile" if count == 1 else f"two {name}s, as x and z of a profile"
        reads, both = spelled("viscorough reduce", "read_line"), spelled("--spacing DX,DY", "spacing=(dx, dy)")
        way = f"{reads} reads profiles; a map of this shape needs both distances, {both}"
        raise ValueError(f"{text}; {way}")


def _check_positions(table: Array) -> None:
    """Raise ValueError if a column or row at an edge holds positions or numbers of points, unlike the others.

    The first one does if it rises, or falls, in equal steps. A table of few columns may be a profile. There, so does
    the last one, and one more column may be even (x and a number); steps may be unequal if no other column rises, or
    falls, throughout. On a wide map, heights along an edge may do the same.
    """
    # Positions along both axes may have any number in the corner where they meet.
    has_corner = min(table.shape) >= _LEAST_LABELS and _is_even(table[1:, 0]) and _is_even(table[0, 1:])
    for name, vectors in (("column", table.T), ("row", table)):
        are_few = len(vectors) <= _MOST_OF_PROFILES
        edges = [("first", vectors[0], vectors[1:]), ("last", vectors[-1], vectors[:-1])]
        for place, vector, others in edges if are_few else edges[:1]:
            labels = vector[1:] if place == "first" and (has_corner or np.isnan(vector[0])) else vector
            if not len(others) or vector.size < _LEAST_LABELS or not _is_monotonic(labels):
                continue
            most = min(1, len(others) - 1) if are_few else 0  # all columns of a tilted plane are even
            even = _is_even(labels) and sum(map(_is_even, others)) <= most
            if even or (are_few and labels.size >= _LEAST_POSITIONS and not any(map(_is_monotonic, others))):
                text = f"the {place} {name} counts up {'evenly' if even else 'throughout'}, unlike the others"
                needed = "heights alone, columns x, y, z, or a .npy array, are needed"
                reads = f"{spelled('viscorough reduce', 'read_line')} reads profiles"
                raise ValueError(f"{text}, as positions do; {needed}; {reads}")


def _is_monotonic(values: Any) -> bool:
    """Return True if values rise, or fall, from each to the next."""
    with np.errstate(invalid="ignore", over="ignore"):
        steps = np.diff(values)
    return bool((steps > 0).all() or (steps < 0).all())


def _is_even(values: Any) -> bool:
    """Return True if values rise, or fall, in equal steps."""
    return even_spacing(values) is not None


def _grid(table: Array, stated: Spacing | None, required: bool) -> tuple[Array, Spacing] | None:
    """(heights, (dx, dy)) of a table with columns x, y, z; None for a matrix of heights.

    stated : spacing that a header states, in the unit of x and y

    Raises ValueError for points that form no grid or one of another spacing, and for a table that may be either.
    """
    grid = gridded(table, required=required)
    if grid is None and 3 < table.shape[1] <= 6 and gridded(table[:, :3], required=False) is not None:
        raise ValueError(f"{table.shape[1]} columns, of which two are positions; three, x, y and z, are needed")
    if grid is not None and stated is not None:
        dx, dy = grid[1]
        if any(abs(a - b) > 1e-3 * b for a, b in zip(stated, (dx, dy), strict=True)):
            text = f"({stated[0]:g}, {stated[1]:g}) in the header, ({dx:g}, {dy:g}) between points x, y, z"
            raise ValueError(f"spacing {text}; statements that agree are needed")
    return grid


def _esri(lines: Sequence[str]) -> dict[str, float]:
    """The keys of an ESRI grid in lines, and their numbers. Raises ValueError for no number, and for two of a key."""
    found: dict[str, float] = {}
    for number, line in enumerate(lines, 1):
        if match := _ESRI_KEY.match(line):
            key, text = match[1].lower(), match[2].replace(",", ".")
            if key in found or not re.fullmatch(rf"{_NUMBER}|nan", text, re.IGNORECASE):
                raise ValueError(f"line {number} ({line[:40]!r}): one number is needed for {match[1]}")
            found[key] = float(text)
    return found if {"ncols", "nrows"} <= set(found) else {}


def _esri_scan(table: Array, esri: dict[str, float]) -> Scan:
    """A grid with the keys ncols, nrows, cellsize (or dx, dy) and nodata_value."""
    columns, rows = esri["ncols"], esri["nrows"]
    if table.shape != (rows, columns):
        text = f"{len(table)} lines of {table.shape[1]} numbers contradict {rows:g} rows and {columns:g} columns"
        raise ValueError(f"{text}; a line for each row is needed")
    mark = esri.get("nodata_value", -9999.0)
    # Marks such as -3.4e38 are printed with few digits.
    missing = np.isclose(table, mark, rtol=1e-5, atol=0) if abs(mark) > 1e30 else table == mark
    heights = np.where(missing, np.nan, table)
    dx, dy = (esri.get(key, esri.get("cellsize")) for key in ("dx", "dy"))
    if dx is None or dy is None:
        return Scan(heights)
    left = esri.get("xllcenter", esri.get("xllcorner", np.nan) + dx / 2)
    bottom = esri.get("yllcenter", esri.get("yllcorner", np.nan) + dy / 2)
    return Scan(heights, spacing=(dx, dy), corners=(left, bottom, left + dx * (columns - 1), bottom + dy * (rows - 1)))
