"""Read columns of numbers from text and .npy files: histories of force or depth, records, tables of a medium.

A heading decides which column holds which quantity, from names and units. Columns may have any order, and other columns
are ignored. The heading is the last line of names above the numbers; a line of units may follow it. Without a heading,
the file has two columns, times and values. Delimiter, decimal mark, encoding and comments are found as in maps
(io.text). A file is refused if it is not certain which column holds a quantity.
"""

import contextlib
import csv
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.types import Array, FilePath
from viscorough.io.atomic import path_named
from viscorough.io.heights import is_npy, npy_array
from viscorough.io.text import decoded_lines, is_binary, parsed

# Words that name a quantity in the heading of a column.
_NAMES = {
    "time": "t time times zeit zeiten testzeit prüfzeit messzeit temps tiempo tempo seconds sec",
    "depth": "u h δ delta depth depths displacement displacements indentation indentations penetration eindringtiefe "
    "eindringung tiefe weg verschiebung profondeur enfoncement déplacement deplacement profundidad desplazamiento",
    "force": "f p fn fz force forces load loads kraft kräfte normalkraft prüfkraft last effort fuerza",
    "compliance": "j compliance nachgiebigkeit kriechnachgiebigkeit complaisance",
    "relaxation_modulus": "psi ψ relaxationsmodul",
}
_QUANTITY_OF = {word: quantity for quantity, words in _NAMES.items() for word in words.split()}
# A column whose name has one of these words holds another quantity, such as the rate or the error of a force.
_WORDS_OF_OTHERS = (
    "error err fehler std sd sigma uncertainty deviation noise rate speed velocity geschwindigkeit "
    "vitesse setpoint set target command commanded nominal demand soll sollwert min max minimum "
    "maximum offset drift low high lower upper limit threshold raw index number no stress strain "
    "change derivative ratio normalized normalised relative squared log ln correction lateral "
    "tangential friction shear querkraft adhesion crosshead voltage counts remaining zero initial "
    "stiffness modulus energy work power stamp contraction "
)
_OTHER = set(_WORDS_OF_OTHERS.split())
# Units in which the quantities of a column are measured: {quantity: unit}.
_UNITS = {"time": "s", "depth": "m", "force": "N", "compliance": "1/Pa", "relaxation_modulus": "Pa"}
# Without a known name, a length is taken for the depth only if the column has one of these names. Other lengths, such
# as the height of a piezo or the position of a tip, are no depths.
_NAMES_OF_DEPTH = ("", "d")
# Pattern of a heading that ends with a common unit, such as t_ms or "Time, ms".
_LAST_WORD = re.compile(
    r"(?:(.*)[\s_:;,])?((?:[kMmunpµμ]|kilo|milli|micro|nano)?(?:[sN]|sec|seconds?|newtons?)"
    r"|min|minutes?|h|hours?|[kMG]?Pa(?:\^?-1)?|[pmunµμc]?m|[Mm]icrons?)"
)
_BRACKET = re.compile(r"\s*[\[({<]([^\])}>]*)[\])}>]")
_LETTER = re.compile(r"[^\W\d_]|[δψ]")
# Pattern of a cell that is no name: nan, infinity, or a text that starts like a number. A cell such as "1N" is thus a
# faulty number and no heading.
_LIKE_A_NUMBER = re.compile(r"\s*[-+]?(?:[.,]?\d|(?:nan|inf|infinity)\s*$)", re.IGNORECASE)
_COMMENT = re.compile(r"\s*(?:#|%|//|!)\s*")
# Spreadsheets mark missing numbers by texts such as #N/A and #DIV/0!, which look like comments.
_MISSING_MARK = re.compile(r"\s*#(?:n/?a\b|nv\b|[^\W\d]+(?:/0)?[!?])", re.IGNORECASE)
_NUMBER, _POINT_NUMBER = (
    re.compile(rf"[-+]?(?:\d+(?:{mark}\d*)?|{mark}\d+)(?:[eEdD][-+]?\d+)?|[-+]?inf(?:inity)?", re.IGNORECASE)
    for mark in ("[.,]", r"\.")
)
# Delimiters of cells; None for white space.
_DELIMITERS = (";", "\t", ",", None)


class _Column(NamedTuple):
    """Heading of a column.

    text : the whole heading
    name : heading without its unit
    unit : unit in the heading; None if it states none
    """

    text: str
    name: str
    unit: str | None


class _Heading(NamedTuple):
    """Heading of a table.

    line : index of the line with the names
    units : index of the line with the units of the columns; -1 if there is none
    rows_from : index of the first line that may hold numbers
    delimiter : delimiter of the cells in the rows; None for white space
    columns : the columns of the table
    """

    line: int
    units: int
    rows_from: int
    delimiter: str | None
    columns: list[_Column]


class _Place(NamedTuple):
    """Place of a quantity in a table: index of the column, and the unit of its numbers; None if no unit is stated."""

    column: int
    unit: str | None


def read_columns(
    path: FilePath,
    content: str,
    quantities: Mapping[str, str],
    length_unit: str,
    chosen: Mapping[str, str | int] | None = None,
) -> tuple[Array, ...]:
    """Read quantities from a text or .npy file, each as an array of shape (rows,), with at least two rows.

    content : words for the content of the file in messages, such as "a record"
    quantities : {name of a quantity: unit of the returned numbers}. Without a heading, a file has exactly these columns
        in this order
    length_unit : unit of length of the indenter. If it is "1" (not known), numbers are in consistent units of the
        user's choice, and headings with units are refused
    chosen : {quantity: name or number, from 1, of its column}, for columns that the heading does not name. A unit may
        follow in brackets, such as "2 [nm]"

    Raises a one-line ValueError that names the file and its fault.
    """
    with path_named(path):
        if is_npy(path):
            table = npy_array(path)
            places = _chosen_places(quantities, [], chosen or {}) or dict(_in_order(quantities))
            if table.ndim == 2 and table.dtype.kind in "iuf" and not chosen and table.shape[1] != len(quantities):
                raise ValueError(f"has the shape {table.shape}; {_needed(quantities)}")
            if table.ndim != 2 or table.dtype.kind not in "iuf":
                raise ValueError(f"is an array of shape {table.shape} and type {table.dtype}; {_needed(quantities)}")
            table = table[:, [_checked_index(place.column, table.shape[1]) for place in places.values()]]
        elif is_binary(path):
            raise ValueError(f"unknown kind of file; {content} is read from text (such as .csv) and .npy files")
        else:
            places, table = _places_and_table(decoded_lines(path), quantities, length_unit, chosen or {})
        if len(table) < 2:
            raise ValueError(f"{len(table)} rows; {_needed(quantities)}, and at least two rows")
        values = []
        for column, (quantity, place) in zip(table.T.astype(float), places.items(), strict=True):
            values.append(column * _factor(quantity, place.unit, quantities[quantity], length_unit))
        return tuple(values)


def _needed(quantities: Mapping[str, str]) -> str:
    """Return the end of a message: the columns that the file needs."""
    return f"{'two' if len(quantities) == 2 else len(quantities)} columns, {' and '.join(quantities)}, are needed"


def _way(quantity: str) -> str:
    """Return the end of a message: how to choose the column of a quantity."""
    return f"{argument('columns')} states it, as in {quantity}=NAME or {quantity}=NUMBER, counted from 1"


def _in_order(quantities: Mapping[str, str]) -> Iterator[tuple[str, _Place]]:
    for index, quantity in enumerate(quantities):
        yield quantity, _Place(index, None)


def _factor(quantity: str, stated: str | None, unit: str, length_unit: str) -> float:
    """Return the factor that converts numbers from the stated unit, or 1 if no unit is stated."""
    if stated is None:
        return 1.0
    if length_unit == units.UNKNOWN:
        text = f"column {quantity} [{stated}] states a unit, but the unit of length is not known"
        raise ValueError(f"{text}; {argument('unit')} where the heights are read states it")
    with path_named(f"column {quantity} [{stated}]"):
        return units.factor(stated, unit)


# ---- tables in text


def _places_and_table(
    lines: list[str], quantities: Mapping[str, str], length_unit: str, chosen: Mapping[str, str | int]
) -> tuple[dict[str, _Place], Array]:
    """Return ({quantity: place in the file}, numbers of these quantities, shape (rows, quantities))."""
    if marked := next((line for line in lines if _MISSING_MARK.match(line)), None):
        raise ValueError(f"{marked.strip()[:40]!r} is no row of numbers; {_needed(quantities)}")
    heading = _heading(lines)
    names = [] if heading is None else heading.columns
    places = _chosen_places(quantities, names, chosen)
    if heading is None and not places:
        _check_nothing_named(lines, quantities)
        places = dict(_in_order(quantities))
    elif heading is not None:
        rest = [quantity for quantity in quantities if quantity not in places]
        places |= {quantity: _named_place(quantity, names, quantities) for quantity in rest}
        places = {quantity: places[quantity] for quantity in quantities}
    if missing := [quantity for quantity in quantities if quantity not in places]:
        raise ValueError(f"{_needed(quantities)}, and no column is named {missing[0]}; {_way(missing[0])}")
    if len({place.column for place in places.values()}) < len(places):
        raise ValueError(f"one column for {' and '.join(places)}; a column for each of them is needed")
    not_stated = {quantity: quantities[quantity] for quantity, place in places.items() if place.unit is None}
    _check_comments(lines, heading, not_stated)
    with _needing(quantities):
        if heading is None:
            heading = _without_names(lines)
            if not chosen and len(heading.columns) != len(quantities):
                text = f"{len(heading.columns)} columns without names"
                raise ValueError(f"{text}; a heading, or {argument('columns')}, states their order")
        indices = [_checked_index(place.column, len(heading.columns)) for place in places.values()]
        table = parsed(_selected(lines, heading, indices)).values
        if np.isnan(table).any():
            raise ValueError(f"row {1 + int(np.argmax(np.isnan(table).any(axis=1)))} lacks a number")
    return places, table


@contextlib.contextmanager
def _needing(quantities: Mapping[str, str]) -> Iterator[None]:
    """Add the columns that the file needs to the message of a ValueError."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{error}; {_needed(quantities)}") from error


def _heading(lines: Sequence[str]) -> _Heading | None:
    """Find the heading of a table: the last line that names columns, followed by rows of as many cells."""
    found = None
    for line, text in enumerate(lines):
        if found is not None and line >= found.rows_from and not _COMMENT.match(text) and text.strip():
            break  # the rows have begun
        if found is not None and line == found.units:
            continue
        for delimiter in _DELIMITERS:
            if (heading := _heading_at(lines, line, delimiter)) is not None:
                found = heading
                break
    return found


def _without_names(lines: Sequence[str]) -> _Heading:
    """Return the delimiter and the number of columns of a table without names.

    The delimiter is the first of _DELIMITERS that splits all rows into the same number of numbers. Raises ValueError if
    there is none.
    """
    first = next((number for number, line in enumerate(lines) if _LIKE_A_NUMBER.match(line.strip('" '))), len(lines))
    rows = [line for line in lines[first:] if line.strip() and not _COMMENT.match(line)]
    for delimiter in _DELIMITERS:
        number = _POINT_NUMBER if delimiter == "," else _NUMBER
        split = [_cells(row, delimiter) for row in rows]
        counts = {len(cells) for cells in split}
        if len(counts) == 1 and min(counts) > 1 and all(number.fullmatch(cell) for cells in split for cell in cells):
            return _Heading(-1, -1, first, delimiter, [_Column("", "", None)] * min(counts))
    raise ValueError(f"line {first + 1} ({lines[first][:40]!r}) is no row of numbers" if rows else "no row of numbers")


def _heading_at(lines: Sequence[str], line: int, delimiter: str | None) -> _Heading | None:
    """Return the heading in a line if the cells of the first row below have this delimiter; otherwise None."""
    names = _cells(_COMMENT.sub("", lines[line], count=1), delimiter, is_heading=True)
    if len(names) < 2 or any(map(_LIKE_A_NUMBER.match, names)) or names[0].startswith("{"):
        return None
    only_units = all((match := _LAST_WORD.fullmatch(name)) and not match[1] for name in names)
    columns = [_Column(name, "", name) if only_units else _column(name) for name in names]
    if not any(_quantity(column) and (column.name or only_units) for column in columns):
        return None
    below = [number for number in range(line + 1, len(lines)) if lines[number].strip()]
    below = [number for number in below if not _COMMENT.match(lines[number]) or _is_row_of_units(lines[number], names)]
    if not below:
        return None
    row, line_of_units = below[0], -1
    stated = _cells(_COMMENT.sub("", lines[row], count=1), delimiter)
    if len(below) > 1 and _is_row_of_units(lines[row], names, delimiter):
        pairs = zip(columns, stated, strict=True)
        columns = [column._replace(unit=_bare(unit) or column.unit) for column, unit in pairs]
        line_of_units, row = below[:2]
    cells = _cells(lines[row], delimiter)
    numbers = [cell for cell in cells if _LIKE_A_NUMBER.match(cell)]
    if len(cells) != len(names) or len(numbers) < 2:
        return None
    # With decimal commas, rows between spaces may have as many commas as the heading.
    if delimiter == "," and any(re.search(r"\s", cell) for cell in numbers):
        return None
    return _Heading(line, line_of_units, row, delimiter, columns)


def _is_row_of_units(line: str, names: Sequence[str], delimiter: str | None = None) -> bool:
    """Return True if a line below the names holds their units: as many cells, each a unit or empty."""
    cells = _cells(_COMMENT.sub("", line, count=1), delimiter)
    units_of = [_bare(cell) for cell in cells]
    return len(cells) == len(names) and any(map(_is_unit, units_of)) and all(map(_is_unit_or_empty, units_of))


def _bare(cell: str) -> str:
    """Return a cell without brackets and spaces."""
    return cell.strip("[](){}<> ")


def _is_unit_or_empty(text: str) -> bool:
    return text in ("", "-", "--", "1", "%", "°", "°C", "K", "a.u.") or _is_unit(text)


def _is_unit(text: str) -> bool:
    """Return True if a text is a unit."""
    if _LAST_WORD.fullmatch(text):
        return True
    if not re.match(r"[^\W\d_]|[%°1]/", text):
        return False
    with contextlib.suppress(ValueError):
        return bool(units.quantity(f"1 {text}").unit)
    return False


def _cells(line: str, delimiter: str | None, *, is_heading: bool = False) -> list[str]:
    """Split a line into cells without quotation marks. In a heading, names between spaces may contain spaces."""
    if delimiter is not None:
        try:
            return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])]
        except csv.Error:
            return []
    line = line.replace('"', "").strip()
    if not is_heading:
        return line.split()
    for pattern in (r"\s*[,;\t]\s*", r"\s{2,}", r"(?<=[\])])\s+"):
        if re.search(pattern, line):
            return [cell.strip() for cell in re.split(pattern, line)]
    return re.sub(r"\s+(?=[\[(])|(?<=/)\s+|\s+(?=/)", "", line).split()


def _selected(lines: Sequence[str], heading: _Heading, indices: Sequence[int]) -> list[str]:
    """Return the lines of a table with the chosen columns only, delimited by semicolons; other lines become empty."""
    kept = [""] * len(lines)
    for number in range(heading.rows_from, len(lines)):
        line = lines[number]
        if not line.strip() or _COMMENT.match(line):
            continue
        cells = _cells(line, heading.delimiter)
        if len(cells) != len(heading.columns):
            text = f"line {number + 1} ({line[:40]!r}): {len(cells)} cells, {len(heading.columns)} in the heading"
            raise ValueError(f"{text}; rows of equal length are needed")
        chosen = [cells[index] or "nan" for index in indices]
        if odd := [cell for cell in chosen if not (_NUMBER.fullmatch(cell) or cell.casefold() == "nan")]:
            raise ValueError(f"line {number + 1}: {odd[0][:40]!r} is not a number")
        kept[number] = ";".join(chosen)
    return kept


def _check_nothing_named(lines: Sequence[str], quantities: Mapping[str, str]) -> None:
    """Raise ValueError if a line above the rows may be a heading that is not understood."""
    first = next((number for number, line in enumerate(lines) if _LIKE_A_NUMBER.match(line.strip('" '))), len(lines))
    above = [line for line in lines[:first] if line.strip()]
    for line in reversed(above):
        if _COMMENT.match(line) and re.search(r"[:=]", line):
            continue
        text = _COMMENT.sub("", line, count=1)
        cells = next((cells for each in _DELIMITERS[:3] if len(cells := _cells(text, each)) > 1), [text])
        names = [cell for cell in cells if _LETTER.search(cell) and not _LIKE_A_NUMBER.match(cell)]
        known = [name for name in names if _quantity(_column(name))]
        may_be_heading = line is above[-1] and (known or (len(cells) > 1 and not _COMMENT.match(line)))
        if may_be_heading or (known and len(cells) > 1):
            text = f"{line.strip()[:60]!r} does not name the columns of the rows below"
            raise ValueError(f"{text}; {_needed(quantities)}; {_way(list(quantities)[-1])}")


def _check_comments(lines: Sequence[str], heading: _Heading | None, not_stated: Mapping[str, str]) -> None:
    """Raise ValueError if a comment states another unit than the unit of a column whose heading states none.

    not_stated : {quantity: unit of its numbers}, for columns without a stated unit
    """
    rows_from = 0 if heading is None else heading.line
    for number, line in enumerate(lines):
        is_text = _COMMENT.match(line) or (number < rows_from and _LETTER.search(line))
        if not is_text or (heading is not None and number in (heading.line, heading.units)):
            continue
        stated = [_column(cell).unit for cell in re.split(r"[,;\t]", _COMMENT.sub("", line, count=1))]
        if any(_is_different(unit, wanted) for unit in stated if unit for wanted in not_stated.values()):
            text = f"line {number + 1} ({line.strip()[:40]!r}) states a unit"
            raise ValueError(f"{text}; {_needed(not_stated)}, with units in their heading")


def _is_different(text: str, unit: str) -> bool:
    """Return True if a text is a unit of another size than `unit` but of the same dimension, such as ms and s."""
    with contextlib.suppress(ValueError):
        return units.factor(text, unit) != 1
    return False


# ---- roles of columns


def _column(heading: str) -> _Column:
    """Separate the name and the unit in the heading of a column, such as "t [ms]", "t/ms", "t in ms" or "t_ms"."""
    text = heading.strip('#% \t"')
    if text.casefold() in _QUANTITY_OF:
        return _Column(text, text, None)
    brackets = [match for match in _BRACKET.finditer(text) if match[1].strip() not in ("t", "x")]
    name = _BRACKET.sub(lambda match: f" {match[1]} " if _is_word(match[1]) else " ", text).strip()
    if stated := [match[1].strip() for match in brackets if not _is_word(match[1])]:
        return _Column(text, name, stated[-1])
    if (match := re.fullmatch(r"(.*?)(?:\s*/\s*|\s+in\s+)([^/]+)", text)) and (
        match[1].strip().casefold() in _QUANTITY_OF or not _is_unit(text)
    ):
        return _Column(text, match[1].strip(), match[2].strip())
    if last := _LAST_WORD.fullmatch(text):
        return _Column(text, (last[1] or "").strip(), last[2])
    if (end := re.fullmatch(r"(.+?)[\s_:;,]+([^\s_:;,]+)", name)) and end[2].casefold() not in _QUANTITY_OF:
        return _Column(text, end[1], end[2]) if _is_unit(end[2]) else _Column(text, name, None)
    return _Column(text, name, None)


def _is_word(text: str) -> bool:
    """Return True if the text in brackets is a word such as "measured & smoothed", and no unit."""
    return bool(re.fullmatch(r"[^\W\d_]{4,}(?:[\s&,+-]+[^\W\d_]{4,})*", text.strip())) and not _is_unit(text.strip())


def _words(name: str) -> list[str]:
    return [word.casefold() for word in re.findall(r"[^\W\d_]+", re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name))]


def _quantity(column: _Column) -> str | None:
    """Return the quantity that the name, or else the unit, of a column states; None for another or none.

    A name and a unit that contradict each other state no quantity.
    """
    words = _words(column.name)
    if {"relaxation", "modulus"} <= set(words):
        named = {"relaxation_modulus"}
    elif set(words) & _OTHER:
        return None
    else:
        named = {_QUANTITY_OF[word] for word in words if word in _QUANTITY_OF}
    measured = None if column.unit is None else _measured_in(column.unit)
    if len(named) > 1:
        return measured if measured in named else None
    if named:
        (quantity,) = named
        return quantity if column.unit is None or measured in (quantity, "") else None
    if measured == "depth" and column.name.casefold() not in _NAMES_OF_DEPTH:
        return None
    return measured or None


def _measured_in(unit: str) -> str | None:
    """Return the quantity that has a unit; "" for a text that is no unit; None for a unit of another quantity."""
    for quantity, needed in _UNITS.items():
        with contextlib.suppress(ValueError):
            units.factor(unit, needed)
            return quantity
    return None if _is_unit(unit) else ""


def _named_place(quantity: str, columns: Sequence[_Column], quantities: Mapping[str, str]) -> _Place:
    """Return the place of the only column that the heading names as a quantity.

    Raises ValueError if no column or more than one column has this quantity.
    """
    found = [index for index, column in enumerate(columns) if _quantity(column) == quantity]
    by_name = [index for index in found if set(_words(columns[index].name)) & _QUANTITY_OF.keys()]
    found = by_name or found
    shown = ", ".join(repr(column.text[:30]) for column in columns[:8])
    if not found:
        named = list(dict.fromkeys(filter(None, map(_quantity, columns))))
        known = f", read as {' and '.join(named)}" if named else ""
        text = f"the heading names no {quantity}: its columns are {shown}{known}"
        raise ValueError(f"{text}; {_needed(quantities)}; {_way(quantity)}")
    if len(found) > 1:
        names = " and ".join(repr(columns[index].text[:30]) for index in found)
        raise ValueError(f"{len(found)} columns of {quantity}, {names}; {_way(quantity)}")
    return _Place(found[0], columns[found[0]].unit)


def _chosen_places(
    quantities: Mapping[str, str], columns: Sequence[_Column], chosen: Mapping[str, str | int]
) -> dict[str, _Place]:
    """Return {quantity: place} for the quantities whose columns the user chooses by name or number.

    Raises ValueError for a name that no column has, and for a unit that contradicts the heading.
    """
    if unknown := [quantity for quantity in chosen if quantity not in _UNITS]:
        raise ValueError(f"{argument('columns')}: {unknown[0]!r}; allowed: {', '.join(quantities)}")
    places = {}
    for quantity in quantities:
        if quantity not in chosen:
            continue
        text = str(chosen[quantity]).strip()
        shown = f"{argument('columns')} {quantity}={text}"
        number = re.fullmatch(r"(\d{1,6})\s*(?:\[([^\]]+)\])?", text)
        named = [index for index, column in enumerate(columns) if text.casefold() in _spellings(column)]
        if len(named) == 1:
            places[quantity] = _Place(named[0], columns[named[0]].unit)
        elif number and not named:
            index, unit = int(number[1]) - 1, number[2]
            if columns and not 0 <= index < len(columns):
                raise ValueError(f"{shown}: allowed are 1 to {len(columns)}")
            if index < 0:
                raise ValueError(f"{shown}: columns are counted from 1")
            in_file = columns[index].unit if columns else None
            if unit and in_file and _is_different(unit, in_file):
                raise ValueError(f"{shown} contradicts the heading {columns[index].text!r}; leave the unit out")
            places[quantity] = _Place(index, unit or in_file)
        else:
            names = ", ".join(repr(column.text[:30]) for column in columns) or "not stated"
            fault = "several columns have this name" if named else "no column has this name"
            raise ValueError(f"{shown}: {fault}; the names of the columns are {names}")
    for quantity, place in places.items():
        other = _quantity(columns[place.column]) if place.column < len(columns) else None
        if other not in (None, quantity):
            text = f"{argument('columns')} {quantity}={chosen[quantity]}: the heading names {other} there"
            raise ValueError(f"{text}, {columns[place.column].text!r}")
    return places


def _spellings(column: _Column) -> tuple[str, str]:
    """Return the names by which the user may choose a column: its whole heading, and the heading without its unit."""
    return column.text.casefold(), column.name.casefold()


def _checked_index(index: int, count: int) -> int:
    """Return the index of a column. Raises ValueError if the table has fewer columns."""
    if index >= count:
        raise ValueError(f"{argument('columns')} {index + 1}: the file has {count} columns")
    return index
