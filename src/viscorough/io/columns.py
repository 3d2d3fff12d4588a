"""Read two columns of numbers, such as force histories and creep tables, from files."""

import contextlib
import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.types import Array, FilePath
from viscorough.io.atomic import path_named, reading
from viscorough.io.heights import npy_array

# Pattern of a heading of a column that ends with a common unit, such as t_ms.
_LAST_WORD = re.compile(
    r"(?:.*[\s_:;])?((?:[kMmunpµμ]|kilo|milli|micro|nano)?(?:[sN]|sec|seconds?|newtons?)"
    r"|min|minutes?|h|hours?|[kMG]?Pa\^?-1|[munµμ]m)"
)
_LOAD, _TIME = (re.compile(rf"(?:{names})(?![^\W\d_])", re.IGNORECASE) for names in ("force|depth|f|u", "time|t"))
# Pattern of a cell that is no heading: nan, infinity, or a text that starts like a number. A cell such as "1N" is
# therefore refused as a faulty number and does not become a heading.
_LIKE_A_NUMBER = re.compile(r"\s*[-+]?(?:\.?\d|(?:nan|inf|infinity)\s*$)", re.IGNORECASE)
_LETTER = re.compile(r"[^\W\d_]")
_TWO_NAMES = re.compile(r"# *[^\W\d_][^,]*, *[^\W\d_][^,]*")
# Pattern of a row with a missing number. Spreadsheets mark missing numbers by texts such as #N/A, which look like
# comments.
_MISSING = re.compile(r"#[A-Z][^\s,]*,\s*[-+.\d]")


def read_columns(path: FilePath, content: str, columns: dict[str, str], length_unit: str) -> tuple[Array, Array]:
    """Read the first two columns of a .csv or .npy file as arrays of shape (rows,), with at least two rows.

    The first row of a .csv file is a heading if none of its fields starts like a number, nan or infinity. Lines that
    start with "#" are comments. If the last comment above the first row consists of two names, it is a heading, too.
    The file may have more than two columns if the heading names all of them. If a heading states units, as in t [ms],
    t (ms), t/ms, t in ms or t_ms, the numbers are converted.

    content : words for the content of the file in messages, such as "a record"
    columns : {quantity in a column of the file: unit of the returned numbers}, for the two columns in order
    length_unit : unit of length of the indenter. If it is "1" (not known), numbers are in consistent units of the
        user's choice, and headings with units are refused

    Raises a one-line ValueError that names the file and its fault.
    """
    if Path(path).suffix not in (".npy", ".csv"):
        raise ValueError(f"{path}: unknown kind of file; {content} is read from .csv and .npy")
    names = " and ".join(columns)
    if Path(path).suffix == ".npy":
        table, factors = npy_array(path), [1.0, 1.0]
    else:
        with reading(path, f"two columns, {names}, are needed"):
            table, factors = _rows_and_factors(path, columns.values(), length_unit)
    if table.ndim != 2 or table.shape[1] != 2 or table.shape[0] < 2 or table.dtype.kind not in "iuf":
        raise ValueError(f"{path}: has the shape {table.shape}; two columns, {names}, and two rows are needed")
    return table[:, 0].astype(float) * factors[0], table[:, 1].astype(float) * factors[1]


def _rows_and_factors(path: FilePath, result_units: Iterable[str], length_unit: str) -> tuple[Array, list[float]]:
    """Return the numbers in a .csv file, and the factors that convert its columns to `result_units`."""
    lines = [line.strip() for line in Path(path).read_text(encoding="utf-8-sig").splitlines() if line.strip()]
    if missing := next(filter(_MISSING.match, lines), None):
        raise ValueError(f"{missing[:40]!r} is no row of two numbers")
    comments = [line for line in lines if line.startswith("#")]
    rows = [line for line in lines if not line.startswith("#")]
    above = lines[: lines.index(rows[0])] if rows else []
    if rows and not any(map(_LIKE_A_NUMBER.match, rows[0].split(","))):
        heading = rows.pop(0)
    else:
        heading = above[-1] if above and _TWO_NAMES.fullmatch(above[-1]) else None
    if heading is not None and heading.count(",") > 1 and {row.count(",") for row in rows} == {heading.count(",")}:
        # Read only the first two columns. Other columns may have empty fields, for example if an interval is unknown.
        heading, *rows = (",".join(row.split(",")[:2]) for row in [heading, *rows])
    table = np.loadtxt(rows, delimiter=",", ndmin=2) if rows else np.empty((0, 0))
    for comment in comments:
        stated = None if comment is heading else _unit_in(comment.strip("# "))
        if stated is not None and any(_is_different_unit(stated, unit) for unit in result_units):
            raise ValueError(f"the comment {comment[:40]!r} states a unit; a heading of both columns is needed for it")
    return table, _factors(heading, result_units, length_unit) if heading else [1.0, 1.0]


def _factors(heading: str, result_units: Iterable[str], length_unit: str) -> list[float]:
    """Return the two factors that convert the columns from the units in the heading to `result_units`."""
    fields = [field.strip('# \t"') for field in heading.split(",")]
    if len(fields) != 2 or fields[0] == fields[1] or not all(map(_LETTER.search, fields)):
        raise ValueError(f"{heading[:40]!r} is neither two numbers nor the names of two columns")
    if _LOAD.match(fields[0]) or _TIME.match(fields[1]):
        raise ValueError(f"the heading {heading[:40]!r}: times are needed in the first column")
    factors = [1.0, 1.0]
    for i, (field, unit) in enumerate(zip(fields, result_units, strict=True)):
        stated = _unit_in(field)
        if stated is not None and length_unit == units.UNKNOWN:
            text = "states a unit, but the unit of length is not known; "
            text += f"{argument('unit')} where the heights are read states it"
            raise ValueError(f"the heading {field[:40]!r} {text}")
        if stated is not None:
            with path_named(f"the heading {field[:40]!r}"):
                factors[i] = units.factor(stated, unit)
    return factors


def _unit_in(heading: str) -> str | None:
    """Return the unit that the heading of a column states, or None."""
    if match := re.search(r"[\[(]([^\])]*)[\])]|/\s*(.+)$|\bin\s+(\S+)$", heading):
        return next(text for text in match.groups() if text is not None).strip()
    last = _LAST_WORD.fullmatch(heading)
    return last[1] if last else None


def _is_different_unit(text: str, unit: str) -> bool:
    """Return True if a text is a unit of another size than `unit` but of the same dimension, such as ms and s."""
    with contextlib.suppress(ValueError):
        return units.factor(text, unit) != 1
    return False
