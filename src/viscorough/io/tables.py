"""Tables as CSV: what a NetCDF file with one dimension holds, for spreadsheets and other programs.

The first lines start with "#": a line "# name: value" for each global attribute, with texts in quotation marks, and a
line "# column name: meaning" for each column. Then come a header with the names of the columns, each with its unit in
parentheses, and a row for each level, in full precision. Where a value is missing, the field is empty.
"""

import contextlib
import csv
import io
import itertools
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from viscorough.arrays import read_only
from viscorough.io import netcdf
from viscorough.io.atomic import atomic_write, reading
from viscorough.io.netcdf import Content, Variable
from viscorough.types import Array, FilePath

_ATTRIBUTE = re.compile(r"# ?((?:column )?[A-Za-z]\w*): (.*)", re.ASCII)
_COLUMN = re.compile(r"(\w+)\s*(?:\((.*)\)|\[(.*)\])?")


def is_table(path: FilePath) -> bool:
    """Whether a file name asks for a table: it ends in .csv."""
    return Path(path).suffix.lower() == ".csv"


def write(content: Content, path: FilePath) -> None:
    """Write a Content, whose variables share one dimension, as CSV, atomically; numbers without one are attributes.

    Raises ValueError for other contents, missing attributes and a path that cannot be written, OSError if writing
    fails.
    """
    columns = {name: variable for name, variable in content.variables.items() if variable.dimensions}
    dimensions = {variable.dimensions for variable in columns.values()}
    if len(dimensions) != 1 or len(*dimensions) != 1:
        raise ValueError(f"{path}: what was computed is no table of one dimension; a NetCDF file (.nc) is needed")
    for name, variable in content.variables.items():
        netcdf.check_attributes(path, name, np.asarray(variable.values).dtype, variable.attributes)
    scalars = {name: v.values[()] for name, v in content.variables.items() if not v.dimensions}
    attributes = content.attributes | scalars | netcdf.global_attributes()
    lines = [f"# {name}: {_as_text(value)}" for name, value in attributes.items()]
    lines += [f"# column {name}: {_as_text(variable.attributes['long_name'])}" for name, variable in columns.items()]
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(_title(name, variable.attributes.get("units", "1")) for name, variable in columns.items())
    cells = [["" if value != value else repr(value) for value in v.values.tolist()] for v in columns.values()]
    table.writerows(zip(*cells, strict=True))
    with atomic_write(path) as temporary:
        temporary.write_text("\n".join(lines) + "\n" + text.getvalue(), encoding="utf-8")


def read(path: FilePath) -> Content:
    """Read a table that `write` made into memory as a Content on the dimension `level`; empty fields are nan.

    Raises a one-line ValueError if the file is missing or is no such table.
    """
    with reading(path, "a whole table of viscorough is needed", OSError, ValueError, csv.Error):
        lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
        about = dict(filter(None, (_attribute(line) for line in lines if line.startswith("#"))))
        table = itertools.dropwhile(lambda line: line.startswith("#"), filter(str.strip, lines))
        titles, *rows = csv.reader(table, strict=True)
        if not rows or any(len(row) != len(titles) for row in rows):
            raise ValueError(f"not every row has {len(titles)} fields, or there is none")
        variables = {}
        for title, cells in zip(titles, zip(*rows, strict=True), strict=True):
            match = _COLUMN.fullmatch(title.strip())
            if match is None or match[1] in variables:
                raise ValueError(f"{title[:40]!r} is not a name that no other column has, with or without (unit)")
            name, unit = match[1], match[2] or match[3] or "1"
            attributes = {"long_name": about.pop(f"column {name}", name), "units": unit}
            variables[name] = Variable(("level",), _numbers(cells), attributes)
        return Content(variables, about)


def _title(name: str, unit: str) -> str:
    return name if unit == "1" else f"{name} ({unit})"


def _as_text(value: object) -> str:
    """A value of an attribute as JSON."""
    return json.dumps(np.asarray(value).tolist(), ensure_ascii=False)


def _attribute(line: str) -> tuple[str, Any] | None:
    """Name and value in a line "# name: value"; None for other lines. A value that is no JSON is a text."""
    match = _ATTRIBUTE.fullmatch(line.strip())
    if match is None:
        return None
    name, text = match.groups()
    with contextlib.suppress(ValueError):
        value = json.loads(text)
        if type(value) in (str, float) or (type(value) is int and abs(value) < 2**53):
            return name, value
    return name, text


def _numbers(cells: Sequence[str]) -> Array:
    """The numbers in a column; whole ones, such as counts, if all are written without point and exponent."""
    whole = all(cell.isdecimal() and len(cell) < 16 for cell in cells)
    return read_only(np.array([(int if whole else float)(cell or "nan") for cell in cells]))
