"""Read maps of heights from text files: matrices, ESRI ASCII grids, and columns x, y, z of the points of a grid.

A table of one or two rows or columns may be a profile (io.profiles). It is read as a map only if the user gives the
spacings in both directions.

Lines before the first row of numbers are a header. Lines that start with #, %, //, ! or ; are comments. If semicolons
delimit the columns, however, a line that starts with ; is a row. Header and comments may state spacing and units
(io.headers). All rows must have the same number of cells, and no row is skipped. A file is refused if its delimiter,
its decimal mark or its number of cells is not certain.
"""

import io
import re
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from viscorough.basics.argument_names import spelled
from viscorough.basics.types import Array, FilePath
from viscorough.io.atomic import reading, reason
from viscorough.io.grids import even_spacing, gridded
from viscorough.io.headers import Spacing, is_statement, read_header, states
from viscorough.io.scan import Scan
from viscorough.io.zygo import zygo_scan

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?"
_MISSING = (
    r"[+-]?nan|n/?a|n\.a\.|#n/?a!?|#nv|none|null|bad|void|masked|missing|no ?data|[+-]?1\.#(?:qnan|ind)0*"
    r"|\?+|\*+|[-–—]+"
)
_FIELD = re.compile(rf"{_NUMBER}|[+-]?inf(?:inity)?|{_MISSING}|", re.IGNORECASE)
_MARK = re.compile(rf"(?<![^\s,;])(?:{_MISSING})(?![^\s,;])", re.IGNORECASE)
_ALMOST_A_NUMBER = re.compile(rf"[^\w\s]*\s?\d.*|{_MISSING}", re.IGNORECASE)
# Pattern of # at the start of a comment. In marks of missing numbers, such as #N/A and #DIV/0!, # starts no comment.
_HASH = r"#(?!n/?a\b|nv\b|[^\W\d]+(?:/0)?[!?])"
_COMMENT = re.compile(rf"[ \t]*(?:[%;!]|//|{_HASH})", re.IGNORECASE)
_DIGITS = re.compile(r"\d[^:=]*[\s;,\"][^:=]*\d")
# Pattern of a cell in quotation marks that has commas or points as decimal marks, but not both, such as "1,5".
_QUOTED = re.compile(r'"([^".]*|[^",]*)"')
_REMARK = re.compile(rf"\s(?:{_HASH}|%)(?:\s*[^\W\d].*|\s*$)", re.IGNORECASE)
_ROW_NUMBERS = re.compile(r"rows?|index|nos?\.?|nr\.?|zeilen?|lines?|lignes?", re.IGNORECASE)
# Characters of plain numbers and delimiters. Rows with other characters are searched for marks of missing points.
_PLAIN = b"0123456789.,;+-eE \t\n"
_ESRI_KEY = re.compile(
    r"(?i)^\W*(ncols|nrows|cellsize|dx|dy|nodata_value|[xy]ll(?:corner|center))\W*?[\s:=,;]\s*([-+.\w]\S*?)[\s,;]*$"
)
# First words of text files in formats that are not read: {word: name of the format}.
_UNREAD = {"DSAA": "Surfer grid", "DSBB": "Surfer grid", "ISO 5436": "SMD"}
# Control characters that occur in no text file. \x1a is left out, since it ends text files of DOS.
_CONTROLS = bytes(set(range(32)) - set(b"\t\n\v\f\r\x1a"))
# A row or column at an edge of a table holds positions if at least this many numbers rise or fall in equal steps.
_LEAST_LABELS = 6
# In a table that may be a profile, a row or column also holds positions if at least this many numbers rise or fall in
# unequal steps.
_LEAST_POSITIONS = 10
# A profile has at most this many columns: x, z, a second quantity, and the number of the point.
_MOST_PROFILE_COLUMNS = 4


class Table(NamedTuple):
    """Numbers in a text file, and its other lines.

    values : numbers of the rows, shape (rows, columns); missing values are nan
    header : lines above the first row
    comments : comments between and below the rows
    delimiter : delimiter of the cells; None for white space
    decimal : decimal mark
    separated : line number of the first row that empty lines separate from the rows above; 0 without such a row
    esri : {key: number} in the header of an ESRI grid; empty for other files
    """

    values: Array
    header: list[str]
    comments: list[str]
    delimiter: str | None
    decimal: str
    separated: int
    esri: dict[str, float]


def read_text(path: FilePath, *, is_map: bool = False) -> Scan:
    """Read a map of heights from a text file, as a Scan with its spacing and units.

    is_map : True if the user stated that the table is a map. If False, a table of one or two rows or columns is refused
        since it may be a profile, unless it is an ESRI grid

    Raises a one-line ValueError unless the file can be recognised as a map of heights.
    """
    lines = decoded_lines(path)
    if lines[0].startswith("Zygo XYZ Data File"):
        return zygo_scan(lines)
    for word, name in _UNREAD.items():
        if lines[0].startswith(word):
            raise ValueError(f"files of the format {name} are not read; .x3p, a matrix or points x, y, z are needed")
    if is_own_table(lines):
        raise ValueError(
            "a table that viscorough wrote holds no map of heights; one is needed. To plot a result, write it as .nc"
        )
    table = parsed(lines)
    if table.esri:
        return _esri_scan(table.values, table.esri)
    header = read_header([*table.header, *table.comments], table.values.shape, table.decimal)
    names = header.columns
    table = table._replace(values=_without_missing(table.values, header.missing))
    points = table.values if names is None else table.values[:, [names.index(name) for name in "xyz"]]
    grid = _grid(points, header.spacing, required=names is not None or str(path).lower().endswith(".xyz"))
    if grid is not None:
        heights, spacing = grid
        x, y = (np.nanmin(points[:, axis]) + spacing[axis] * np.arange(heights.shape[1 - axis]) for axis in (0, 1))
        unit, lateral = header.unit, header.lateral_unit
        return Scan(heights, unit, spacing, lateral, mentions=header.mentions, positions=(x, y))
    if not is_map:
        _check_not_profile(table.values.shape)
    if table.separated:
        raise ValueError(f"line {table.separated}: empty lines separate it from the rows above; one map is needed")
    _check_positions(table.values)
    return Scan(table.values, header.unit, header.spacing, header.lateral_unit, mentions=header.mentions)


def parsed(lines: Sequence[str]) -> Table:
    """Return the Table in the lines of a file. Raises a one-line ValueError unless they certainly form a table."""
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
    """Return True if the lines are a table that viscorough wrote."""
    return any(line.startswith('# source: "viscorough') for line in lines[:100])


def is_binary(path: FilePath) -> bool:
    """Return True if a file is no text: it contains control characters and is not UTF-16.

    Raises ValueError for an unreadable file.
    """
    content = _content(path)
    return len(content.translate(None, _CONTROLS)) < len(content) and _utf16(content[:4096]) is None


def _utf16(start: bytes) -> str | None:
    """Return the name of the encoding if a file is UTF-16 text, with or without a byte order mark; None otherwise.

    start : first bytes of the file
    """
    if start.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "utf-16"
    places = np.flatnonzero(np.frombuffer(start, np.uint8) == 0) % 2
    if not places.size or 2 * places.size < 0.9 * (len(start) // 2 * 2) or np.ptp(places):
        return None
    return "utf-16-le" if places[0] else "utf-16-be"


def _content(path: FilePath) -> bytes:
    with reading(path, "a file of numbers is needed"), open(path, "rb") as file:
        return file.read()


def decoded_lines(path: FilePath) -> list[str]:
    """Return the lines of a text file in UTF-16, UTF-8 or Windows-1252; minus signs are converted to ASCII."""
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
    """Return True if a line has only numbers, marks of missing points and empty cells, and at least one number."""
    line = _REMARK.sub("", _MARK.sub("nan", line.replace('"', "").strip()))
    if (_COMMENT.match(line) and not line.startswith(";")) or not re.search(r"\d|nan", line, re.IGNORECASE):
        return False
    return all(map(_FIELD.fullmatch, re.split(r"[;,\s]", line)))


def _rows(lines: Sequence[str], first: int) -> tuple[dict[int, str], list[str], int]:
    """Collect the rows of a table. Return ({line number: row}, comments, line number of the first separated row).

    A comment at the end of a row is removed; only comments on separate lines are returned. A row is separated if it has
    more empty lines above it than other rows. The third value is 0 if no row is separated.

    first : index of the line with the first row

    Raises ValueError for a comment between rows that states a length or unit, since a second map may begin there.
    """
    has_tabs = "\t" in lines[first].strip(" ")
    starts_row = (";",) * (";" in lines[first]) + ("\t",) * has_tabs
    rows, comments = {}, {}
    empty = [0]  # number of empty lines above each row; the last number counts the lines below the last row
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
    """Return (delimiter, decimal mark) of rows; the delimiter is None for white space.

    Raises ValueError if commas may be either decimal marks or delimiters.
    """
    body = "\n".join(rows.values())
    delimiter = ";" if ";" in body else "\t" if "\t" in body else None
    if "," not in body:
        return delimiter, "."
    if delimiter is None and "." not in body and re.search(r"\d,\d", body) and re.search(r"[^,\s] +[^,\s]", body):
        return None, ","  # the delimiter is white space, the decimal mark is a comma
    if "." in body if delimiter else _may_be_decimal_commas(body):
        number, line = next(iter(rows.items()))
        where = f"line {number} ({line[:40]!r})"
        raise ValueError(f"{where}: commas may be decimal marks or not; decimal points, or semicolons, are needed")
    return (delimiter, ",") if delimiter else (",", ".")


def _may_be_decimal_commas(body: str) -> bool:
    """Return True if commas may be decimal marks, in rows without semicolons and tabs.

    body : all rows as one text
    """
    has_spaces = re.search(r", | ,", body) is not None
    # Points and commas may both be decimal marks, as in "1.5, 2,5".
    if "." in body:
        return has_spaces and re.search(r"(?<![\d.])\d+,\d+(?![\d.])", body) is not None
    # The row "1,5" may be one number with a decimal comma, or two whole numbers. In the row "1,05" the comma is
    # probably a decimal mark, since whole numbers do not start with 0.
    may_be_one_number = has_spaces or all(line.count(",") == 1 for line in body.split("\n"))
    return re.search(r"\d,\d", body) is not None and (may_be_one_number or re.search(r"(?<!\d)0\d", body) is not None)


def _values(rows: dict[int, str], delimiter: str | None, decimal: str) -> Array:
    """Convert rows to an array of two dimensions; missing values are nan.

    rows : {line number: row}

    Raises ValueError, which names the faulty line, for a row that is not as long as the first row or holds no numbers.
    """
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
    """Remove a delimiter that starts or ends all lines of a text, and then write nan into empty cells."""
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
    """Describe the first line that is no row of numbers or has another number of cells than the first line.

    numbers : numbers of the lines in the file

    Return "" if there is no such line.
    """
    count = len(lines[0].split(delimiter))
    for number, line in zip(numbers, lines, strict=False):
        if not line.isascii():
            odd = next(letter for letter in line if not letter.isascii())
            return f"line {number} holds {odd!r}; numbers, and nan for missing points, are needed"
        cells = line.split(delimiter)
        if odd := next((cell for cell in cells if not _FIELD.fullmatch(cell.strip(" "))), ""):
            return f"line {number}: {odd[:40]!r} is not a number; numbers, and nan for missing points, are needed"
        if len(cells) != count:
            return f"line {number}: {len(cells)} cells, {count} in line {numbers[0]}; rows of equal length are needed"
    return ""


def _without_missing(table: Array, marks: Sequence[float]) -> Array:
    """Return a table with nan at all numbers that mark missing points.

    A large mark, such as -3.4e38, may be printed with few digits, so it is compared with a tolerance.
    """
    for mark in marks:
        missing = np.isclose(table, mark, rtol=1e-5, atol=0) if abs(mark) > 1e30 else table == mark
        table = np.where(missing, np.nan, table)
    return table


def _check_above(lines: Sequence[str], delimiter: str | None, counts: set[int], esri: dict[str, float]) -> None:
    """Raise ValueError if a line above the table may be a row with a misprint, which must not be skipped.

    A line may be a row if it has as many cells as the rows of the table and

    - one of the cells is a number or almost a number,
    - or all filled cells are equal,
    - or the line has neither letters nor digits.

    A heading of a column of row numbers is refused, too.

    counts : numbers of cells in a row of the table, counted with and without outer delimiters
    esri : {key: number} in the header of an ESRI grid; empty for other files
    """
    for number, line in enumerate(lines, 1):
        is_comment = _COMMENT.match(line) and not (delimiter == ";" and line.lstrip().startswith(";"))
        is_stated = re.search(r"[:=]", line) or is_statement(line) or (esri and _ESRI_KEY.match(line))
        if is_comment or is_stated or not line.strip(" " if delimiter == "\t" else None):
            continue
        cells = [cell.strip(' "') for cell in _REMARK.sub("", line).strip(" ").split(delimiter)]
        if delimiter is not None and len(cells) > 1 and not any(cells):
            text = "a row of empty cells apart from the others, or of another length"
            raise ValueError(f"line {number}: {text}; rows of equal length are needed")
        if len(cells) not in counts:
            continue
        names_points = {"x", "y", "z"} <= {cell.lower()[:1] for cell in cells}
        if len(cells) > 1 and _ROW_NUMBERS.fullmatch(cells[0]) and not names_points:
            raise ValueError(f"line {number} ({line[:40]!r}) heads a column of row numbers; heights alone are needed")
        filled = [cell for cell in cells if cell]
        alike = len(cells) > 1 and (len(filled) > len(set(filled)) == 1 or not re.search(r"\w", line))
        if alike or any(_ALMOST_A_NUMBER.fullmatch(cell) for cell in cells):
            raise ValueError(f"line {number} ({line[:40]!r}) is not a row of numbers; numbers or a comment are needed")


def _check_not_profile(shape: tuple[int, ...]) -> None:
    """Raise ValueError for a table of one or two rows or columns, since it may be a profile and not a map."""
    count, name = min(zip(shape, ("row", "column"), strict=True))
    if count <= 2:
        text = f"a single {name}, as of a profile" if count == 1 else f"two {name}s, as x and z of a profile"
        reads, both = spelled("viscorough reduce", "read_line"), spelled("--spacing DX,DY", "spacing=(dx, dy)")
        way = f"{reads} reads profiles; a map of this shape needs both distances, {both}"
        raise ValueError(f"{text}; {way}")


def _check_positions(table: Array) -> None:
    """Raise ValueError if a column or row at an edge of a table seems to hold positions instead of heights.

    The first column is taken for positions if it rises or falls in equal steps and the other columns do not. A table of
    at most _MOST_PROFILE_COLUMNS columns may be a profile with positions. In such a table

    - the last column may hold the positions, too,
    - a second column may have equal steps, since it may number the points,
    - positions may have unequal steps, if no other column rises or falls throughout.

    In tables with more columns these three cases are not considered, since the heights of a map may rise or fall along
    an edge. Rows are checked like columns.
    """
    # If the first row and the first column both hold positions, the number in their common corner may be any number.
    has_corner = min(table.shape) >= _LEAST_LABELS and _is_even(table[1:, 0]) and _is_even(table[0, 1:])
    for name, vectors in (("column", table.T), ("row", table)):
        are_few = len(vectors) <= _MOST_PROFILE_COLUMNS
        edges = [("first", vectors[0], vectors[1:]), ("last", vectors[-1], vectors[:-1])]
        for place, vector, others in edges if are_few else edges[:1]:
            labels = vector[1:] if place == "first" and (has_corner or np.isnan(vector[0])) else vector
            if not len(others) or vector.size < _LEAST_LABELS or not _is_monotonic(labels):
                continue
            # If more than this number of other columns have equal steps, the table may be a tilted plane of heights.
            most = min(1, len(others) - 1) if are_few else 0
            even = _is_even(labels) and sum(map(_is_even, others)) <= most
            if even or (are_few and labels.size >= _LEAST_POSITIONS and not any(map(_is_monotonic, others))):
                text = f"the {place} {name} counts up {'evenly' if even else 'throughout'}, unlike the others"
                needed = "heights alone, columns x, y, z, or a .npy array, are needed"
                reads = f"{spelled('viscorough reduce', 'read_line')} reads profiles"
                raise ValueError(f"{text}, as positions do; {needed}; {reads}")


def _is_monotonic(values: Any) -> bool:
    """Return True if all values rise, or all fall."""
    with np.errstate(invalid="ignore", over="ignore"):
        steps = np.diff(values)
    return bool((steps > 0).all() or (steps < 0).all())


def _is_even(values: Any) -> bool:
    """Return True if values rise or fall in equal steps."""
    return even_spacing(values) is not None


def _grid(table: Array, stated: Spacing | None, required: bool) -> tuple[Array, Spacing] | None:
    """Return (heights, (dx, dy)) of a table with columns x, y, z; None for a matrix of heights.

    stated : spacing that the header states, in the unit of x and y; None if the header states no spacing
    required : True if the columns certainly are x, y, z

    Raises ValueError if points x, y, z form no grid, if the spacing of the grid differs from the stated spacing, and if
    it is not certain whether columns hold positions or heights.
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
    """Return {key: number} from the header of an ESRI grid; {} for the header of another file.

    Raises ValueError for a key without a number, and for a repeated key.
    """
    found: dict[str, float] = {}
    for number, line in enumerate(lines, 1):
        if match := _ESRI_KEY.match(line):
            key, text = match[1].lower(), match[2].replace(",", ".")
            if key in found or not re.fullmatch(rf"{_NUMBER}|nan", text, re.IGNORECASE):
                raise ValueError(f"line {number} ({line[:40]!r}): one number is needed for {match[1]}")
            found[key] = float(text)
            if key in ("ncols", "nrows") and not (found[key].is_integer() and found[key] > 0):
                raise ValueError(f"line {number} ({line[:40]!r}): a whole number above 0 is needed for {match[1]}")
    return found if {"ncols", "nrows"} <= set(found) else {}


def _esri_scan(table: Array, esri: dict[str, float]) -> Scan:
    """Return the heights and spacing of an ESRI grid, as a Scan.

    table : numbers of the grid, shape (rows, columns)
    esri : {key: number} in the header, with the keys ncols, nrows, cellsize (or dx, dy) and nodata_value
    """
    columns, rows = esri["ncols"], esri["nrows"]
    if table.shape != (rows, columns):
        text = f"{len(table)} lines of {table.shape[1]} numbers contradict {rows:g} rows and {columns:g} columns"
        raise ValueError(f"{text}; a line for each row is needed")
    heights = _without_missing(table, [esri.get("nodata_value", -9999.0)])
    dx, dy = (esri.get(key, esri.get("cellsize")) for key in ("dx", "dy"))
    if dx is None or dy is None:
        return Scan(heights)
    left = esri.get("xllcenter", esri.get("xllcorner", np.nan) + dx / 2)
    bottom = esri.get("yllcenter", esri.get("yllcorner", np.nan) + dy / 2)
    right, top = left + dx * (columns - 1), bottom + dy * (rows - 1)
    known = np.isfinite([left, bottom]).all()
    positions = (np.linspace(left, right, int(columns)), np.linspace(top, bottom, int(rows))) if known else None
    return Scan(heights, spacing=(dx, dy), corners=(left, bottom, right, top), positions=positions)
