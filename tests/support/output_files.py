"""Read the tables of docs/output.md that describe NetCDF files."""

import re
from typing import NamedTuple


class Row(NamedTuple):
    """Describe a file as a row of the table does. dimensions, variables : names, in order"""

    dimensions: list
    variables: list


def documented(text):
    """Return {text of the first column, without marks: Row} of the tables with dimensions and variables."""
    rows = re.findall(r"^\| (`[^|]*) \| ([^|]*) \| ([^|]*) \|$", text, re.MULTILINE)
    return {file.replace("`", ""): Row(_names(dimensions), _names(names)) for file, dimensions, names in rows}


def _names(cell):
    return re.findall(r"`(\w+)`", cell)
