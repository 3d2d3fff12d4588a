"""Two columns of numbers read from a file: force histories and tables of creep."""

import contextlib
import re
from pathlib import Path

import numpy as np

from viscorough.io.atomic import check_readable, reason
from viscorough.io.heights import npy_array


def read_columns(path, what, columns):
    """Two columns in a .csv or .npy file, arrays of shape (rows,) with at least two rows.

    The first row of a .csv file may be a header, in which no field is or starts like a number, nan or infinity.

    what : what is read; columns : what the columns hold; both for messages
    Raises a one-line ValueError that names the file and what is wrong.
    """
    if Path(path).suffix not in (".npy", ".csv"):
        raise ValueError(f"{path}: unknown kind of file; {what} is read from .csv and .npy")
    if Path(path).suffix == ".npy":
        table = npy_array(path)
    else:
        check_readable(path)
        try:
            lines = [line for line in Path(path).read_text(encoding="utf-8-sig").splitlines() if line.strip()]
            header = 1 if lines and not any(map(_starts_like_a_number, lines[0].split(","))) else 0
            table = np.loadtxt(lines[header:], delimiter=",", ndmin=2) if lines[header:] else np.empty((0, 0))
        except (OSError, ValueError) as error:
            text = f"{path}: not readable ({reason(error)}); two columns, {columns}, are needed"
            raise ValueError(text) from error
    if table.ndim != 2 or table.shape[1] != 2 or table.shape[0] < 2 or table.dtype.kind not in "iuf":
        raise ValueError(f"{path}: has the shape {table.shape}; two columns, {columns}, and two rows are needed")
    return table[:, 0].astype(float), table[:, 1].astype(float)


def _starts_like_a_number(field):
    """Whether a field is a number, nan or infinite, or starts with a digit ("1N" is a mistake, not a heading)."""
    field = field.strip().lower()
    with contextlib.suppress(ValueError):
        float(field)
        return True
    return bool(re.match(r"[-+]?\.?\d", field))
