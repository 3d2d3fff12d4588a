"""Read histories of force or depth from files."""

import warnings
from collections.abc import Mapping

import numpy as np

from viscorough.basics import units
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, FilePath
from viscorough.io.atomic import path_named
from viscorough.io.columns import read_columns
from viscorough.media.load import Load

# Negative forces down to this share of the largest force count as noise of the force sensor before or after contact.
_NOISE = 1e-2


def read_load(
    path: FilePath,
    kind: str = "force",
    length_unit: str = units.UNKNOWN,
    columns: Mapping[str, str | int] | None = None,
) -> Load:
    """Read a history of force or depth from a file with columns of times and values.

    A heading with names or units, such as "t [ms]", decides which columns are read; their order does not matter, and
    other columns are ignored. Without a heading, the file has two columns, times and values. Negative forces of less
    than 1 % of the largest force, as before contact, are set to 0, with an AccuracyWarning.

    Parameters
    ----------
    path : path
        Text, such as .csv, or .npy.
    kind : {"force", "depth"}, optional
        Quantity to read.
    length_unit : str, optional
        Unit of length of the indenter, such as "um". Times are then converted to s, forces to N and depths to this
        unit, from the units in the heading of the file. By default all numbers are in consistent units, and a heading
        with units is refused.
    columns : mapping, optional
        Names or numbers (from 1) of columns, such as ``{"time": 1, "force": "Load cell"}``, for a file whose heading
        does not name them. A unit may follow a number, as in "2 [mN]".

    Returns
    -------
    Load

    Raises
    ------
    ValueError
        For a file that is missing or damaged, if it is not certain which columns are meant, and for numbers that Load
        refuses. The one-line message names the file.

    Examples
    --------
    >>> import tempfile
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with open(f"{folder}/force.csv", "w") as file:
    ...         _ = file.write("t [ms],F [mN]\\n0,1\\n500,3\\n")
    ...     load = viscorough.read_load(f"{folder}/force.csv", length_unit="um")
    >>> load.time.tolist(), load.force.tolist()
    ([0.0, 0.5], [0.001, 0.003])
    """
    if kind not in ("force", "depth"):
        raise ValueError(f"kind {kind!r}; allowed: force, depth")
    unit = "N" if kind == "force" else length_unit
    times, values = read_columns(path, f"a {kind} history", {"time": "s", kind: unit}, length_unit, columns)
    with path_named(path):
        return Load(times, **{kind: _without_noise(path, values) if kind == "force" else values})


def _without_noise(path: FilePath, forces: Array) -> Array:
    """Set small negative forces to 0, with an AccuracyWarning; larger negative forces remain."""
    largest, least = forces.max(), forces.min()
    if not -_NOISE * largest <= least < 0:
        return forces
    text = f"{np.count_nonzero(forces < 0)} forces below 0, down to {least:.3g}, count as noise and are set to 0"
    warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=3)
    return np.maximum(forces, 0.0)
