"""Write the content of a NetCDF file with one dimension as a CSV table, for spreadsheets and other programs.

The first lines start with "#": a line "# name: value" for each global attribute, with texts in quotation marks, and a
line "# column name: meaning" for each column. The next line names the columns and their units, such as "depth (um)".
All other lines are rows of numbers in full precision. The field of a missing value is empty.
"""

import csv
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from viscorough.basics.types import FilePath
from viscorough.io.atomic import atomic_write
from viscorough.io.netcdf import Variables, global_attributes


def write(path: FilePath, variables: Variables, attributes: Mapping[str, Any]) -> None:
    """Write variables that share one dimension as CSV, atomically.

    Raises ValueError for variables without a common dimension and for a path that cannot be written, OSError if writing
    fails.
    """
    dimensions = {along for along, _, _ in variables.values()}
    if len(dimensions) != 1 or len(*dimensions) != 1:
        raise ValueError(f"{path}: what was computed is no table of one dimension; a NetCDF file (.nc) is needed")
    attributes = {**attributes, **global_attributes()}
    attributes |= {f"column {name}": about["long_name"] for name, (_, _, about) in variables.items()}
    units = {name: about.get("units", "1") for name, (_, _, about) in variables.items()}
    cells = [[_cell(value) for value in np.asarray(values).tolist()] for _, values, _ in variables.values()]
    with atomic_write(path) as temporary, open(temporary, "w", encoding="utf-8", newline="") as file:
        for name, value in attributes.items():
            file.write(f"# {name}: {json.dumps(np.asarray(value).tolist(), ensure_ascii=False)}\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow(name if unit == "1" else f"{name} ({unit})" for name, unit in units.items())
        table.writerows(zip(*cells, strict=True))


def _cell(value: float | str) -> str:
    """Convert a value to the text of its cell: a number in full precision, "" for nan, a text unchanged."""
    if isinstance(value, str):
        return value
    return "" if value != value else repr(value)
