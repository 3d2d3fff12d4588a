"""Two columns of numbers read from a file: force histories and tables of creep."""

import contextlib
import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from viscorough import units
from viscorough.argument_names import argument
from viscorough.io.atomic import path_named, reading
from viscorough.io.heights import npy_array
from viscorough.types import Array, FilePath

# A common unit as the last word of a heading, as in t_ms.
_LAST_WORD = re.compile(
    r"(?:.*[\s_:;])?((?:[kMmunpµμ]|kilo|milli|micro|nano)?(?:[sN]|sec|seconds?|newtons?)"
    r"|min|minutes?|h|hours?|[kMG]?Pa\^?-1|[munµμ]m)"
)
_LOAD, _TIME = (re.compile(rf"(?:{names})(?![^\W\d_])", re.IGNORECASE) for names in ("force|depth|f|u", "time|t"))
# A number, nan, infinity, or what starts with a digit: "1N" is a mistake, not a heading.
_LIKE_A_NUMBER = re.compile(r"\s*[-+]?(?:\.?\d|(?:nan|inf|infinity)\s*$)", re.IGNORECASE)
_LETTER = re.compile(r"[^\W\d_]")
_TWO_NAMES = re.compile(r"# *[^\W\d_][^,]*, *[^\W\d_][^,]*")
# What spreadsheets write for a number that is missing, such as #N/A, looks like a comment.
_MISSING = re.compile(r"#[A-Z][^\s,]*,\s*[-+.\d]")


def read_columns(path: FilePath, what: str, columns: dict[str, str], length_unit: str) -> tuple[Array, Array]:
    """The first two columns in a .csv or .npy file, arrays of shape (rows,) with at least two rows.

    The first row of a .csv file may be a heading, in which no field is or starts like a number, nan or infinity; only
    under a heading that names them all may there be more than two columns. Lines
    that start with "#" are comments; two names above the first row are a heading there, too. Where a heading states
    units, as in t [ms], t (ms), t/ms, t in ms or t_ms, numbers are converted.

    what : what is read, for messages
    columns : {what a column holds: unit to which it is converted}
    length_unit : "1" if it is not known. Numbers are then in consistent units of the user's choice, and headings that
        state units are refused

    Raises a one-line ValueError that names the file and what is wrong.
    """
    if Path(path).suffix not in (".npy", ".csv"):
        raise ValueError(f"{path}: unknown kind of file; {what} is read from .csv and .npy")
    names = " and ".join(columns)
    if Path(path).suffix == ".npy":
        table, factors = npy_array(path), [1.0, 1.0]
    else:
        with reading(path, f"two columns, {names}, are needed"):
            table, factors = _rows_and_factors(path, columns.values(), length_unit)
    if table.ndim != 2 or table.shape[1] != 2 or table.shape[0] < 2 or table.dtype.kind not in "iuf":
        raise ValueError(f"{path}: has the shape {table.shape}; two columns, {names}, and two rows are needed")
    return table[:, 0].astype(float) * factors[0], table[:, 1].astype(float) * factors[1]


def _rows_and_factors(path: FilePath, wanted: Iterable[str], length_unit: str) -> tuple[Array, list[float]]:
    """The numbers in a .csv file, and the factors that convert its columns to the units wanted."""
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
        # Only the first two are read: unknown ends of intervals are empty.
        heading, *rows = (",".join(row.split(",")[:2]) for row in [heading, *rows])
    table = np.loadtxt(rows, delimiter=",", ndmin=2) if rows else np.empty((0, 0))
    for comment in comments:
        stated = None if comment is heading else _unit_in(comment.strip("# "))
        if stated is not None and any(_is_another(stated, unit) for unit in wanted):
            raise ValueError(f"the comment {comment[:40]!r} states a unit; a heading of both columns is needed for it")
    return table, _factors(heading, wanted, length_unit) if heading else [1.0, 1.0]


def _factors(heading: str, wanted: Iterable[str], length_unit: str) -> list[float]:
    """Factors that convert the columns from the units in their heading to those wanted."""
    fields = [field.strip('# \t"') for field in heading.split(",")]
    if len(fields) != 2 or fields[0] == fields[1] or not all(map(_LETTER.search, fields)):
        raise ValueError(f"{heading[:40]!r} is neither two numbers nor the names of two columns")
    if _LOAD.match(fields[0]) or _TIME.match(fields[1]):
        raise ValueError(f"the heading {heading[:40]!r}: times are needed in the first column")
    factors = [1.0, 1.0]
    for i, (field, unit) in enumerate(zip(fields, wanted, strict=True)):
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
    """The unit that a heading states; None for none."""
    if match := re.search(r"[\[(]([^\])]*)[\])]|/\s*(.+)$|\bin\s+(\S+)$", heading):
        return next(text for text in match.groups() if text is not None).strip()
    last = _LAST_WORD.fullmatch(heading)
    return last[1] if last else None


def _is_another(unit: str, wanted: str) -> bool:
    """Whether a text is a unit that measures the same as that wanted, but another one."""
    with contextlib.suppress(ValueError):
        return units.factor(unit, wanted) != 1
    return False
