"""Maps of heights read from files.

Lengths are in a unit of the user's choice, which a NetCDF file may state. CF files of results need a unit that can be
parsed: where the unit is not known it is "1", and the numbers are multiples of the unit of the heights.
"""

from pathlib import Path

import numpy as np

from viscorough.indenter import Indenter
from viscorough.io import netcdf
from viscorough.io.atomic import reason
from viscorough.io.unpacking import unpacked


def read_heights(path, spacing):
    """Read a map of heights as an Indenter: the highest point touches first, points that are nan lie outside it.

    path : .npy of shape (rows, columns), or .nc with one two-dimensional variable or one named `heights`
    spacing : distance between neighbouring points, in the unit of the heights

    Missing values of a NetCDF file are nan. Raises a one-line ValueError that names the file and what is wrong.
    """
    suffix = Path(path).suffix
    if suffix not in (".npy", ".nc"):
        raise ValueError(f"{path}: unknown kind of file; heights are read from .npy and .nc")
    heights = npy_array(path) if suffix == ".npy" else _with_height_variable(path, unpacked)
    if heights.dtype.kind not in "iuf":
        raise ValueError(f"{path}: heights are of type {heights.dtype}; real numbers are needed")
    if heights.ndim != 2:
        raise ValueError(f"{path}: heights have the shape {heights.shape}; a two-dimensional map is needed")
    try:
        return Indenter(heights, spacing, length_unit=length_unit_of(path))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def length_unit_of(path):
    """Unit that a .nc file states for the heights; "1" if it states none, and for .npy files."""
    if Path(path).suffix != ".nc":
        return "1"
    unit = _with_height_variable(path, netcdf.attributes_of).get("units")
    return unit if isinstance(unit, str) and unit.strip() else "1"


def npy_array(path):
    """The array in a .npy file. Raises a one-line ValueError if it cannot be read; pickled objects are refused."""
    try:
        with open(path, "rb") as file:
            return np.lib.format.read_array(file, allow_pickle=False)
    except MemoryError:
        raise
    except Exception as error:  # numpy parses the header as Python code, so damage raises errors of many kinds
        raise ValueError(f"{path}: not readable ({reason(error)}); a .npy file of numbers is needed") from error


def _with_height_variable(path, function):
    """function(variable) of the NetCDF variable named `heights`, or else of the only two-dimensional one."""
    with netcdf.opened(path) as file:
        maps = [name for name, variable in file.variables.items() if variable.ndim == 2]
        names = ["heights"] if "heights" in file.variables else maps
        if len(names) == 1:
            return function(file.variables[names[0]])
    kind = f"two-dimensional variables {', '.join(maps)}" if maps else "no two-dimensional variable"
    raise ValueError(f"{path}: {kind}; exactly one, or one named heights, is needed")
