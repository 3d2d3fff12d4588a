"""The tables of docs/output.md that describe NetCDF files."""

import re
from typing import NamedTuple


class Row(NamedTuple):
    """What a row says of a file. dimensions, variables : names, in order"""

    dimensions: list
    variables: list


def documented(text):
    """{text of the first column, without marks: Row} of the tables with the columns file, dimensions and variables."""
    rows = re.findall(r"^\| (`[^|]*) \| ([^|]*) \| ([^|]*) \|$", text, re.MULTILINE)
    return {file.replace("`", ""): Row(_names(dimensions), _names(names)) for file, dimensions, names in rows}


def _names(cell):
    return re.findall(r"`(\w+)`", cell)
