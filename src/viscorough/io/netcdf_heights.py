"""Read maps and lines of heights from NetCDF files, with the coordinates and units that the CF conventions define."""

from typing import Any

import netCDF4
import numpy as np

from viscorough.basics import units
from viscorough.basics.types import Array, FilePath
from viscorough.io import netcdf
from viscorough.io.refusals import Refused
from viscorough.io.scan import NOT_STATED, Scan

# The netCDF4 library gives dimensions this name if an HDF5 file names none, as files of other programs than NetCDF.
_UNNAMED = "phony_dim_"
# Coordinates count as equally spaced if, apart from rounding, each step differs from the mean by at most this share.
_UNIFORMITY = 1e-2


def read_netcdf(path: FilePath, content: bytes, channel: str | None, dimensions: int | None, *, flip: bool) -> Scan:
    """Read heights, spacing and units from a variable of a NetCDF file, as a Scan.

    content : content of the file at `path`
    channel : name of the variable. None for the variable `heights` or, if there is none, for the only variable with
        this number of dimensions
    dimensions : 2 for a map, 1 for a line, None for a map if the file holds one, otherwise a line; leading dimensions
        of length 1, such as a time, do not count
    flip : True if the user states that larger numbers are lower

    Raises ValueError for a file that holds no such variable, or several; for HDF5 files without named dimensions; and
    for a depth of which the file does not state whether larger is lower.
    """
    with netcdf.opened(path, content) as file:
        _refuse_hdf5(file, path)
        dimensions = _dimensions(file) if dimensions is None else dimensions
        variable = _variable(file, channel, dimensions)
        if leading := _leading(variable, dimensions):
            first = leading.split(" ", maxsplit=1)[0]
            text = f"variable {variable.name} has the further dimensions {leading}; a variable without them is needed"
            raise Refused(f"{text}, as isel({first}=0) of xarray gives")
        unit = _unit_of(variable)
        down = _is_down(variable, flip)
        heights = netcdf.unpacked(variable)
        axes = variable.dimensions[-dimensions:]
        positions = [_positions_along(file, axis, variable.name) for axis in axes]
        is_packed = {"scale_factor", "add_offset"} & set(variable.ncattrs())
        is_integer = np.dtype(variable.dtype).kind in "iu"
    heights = heights.reshape(heights.shape[-dimensions:]) if heights.ndim >= dimensions else heights
    if [axis.lower() for axis in axes] == ["x", "y"]:
        heights, positions = heights.T, positions[::-1]
    spacing, spacing_unit, places = _spacing(positions[0], positions[-1])
    counts = not is_packed and (is_integer or (unit == NOT_STATED and _are_whole(heights)))
    return Scan(-heights if down else heights, unit, spacing, spacing_unit, places, down, counts)


def _refuse_hdf5(file: netCDF4.Dataset, path: FilePath) -> None:
    """Raise ValueError for an HDF5 file that is no NetCDF file, with the lines of h5py that make a map of it."""
    unnamed = [name for name in file.dimensions if name.startswith(_UNNAMED)]
    if unnamed or (file.groups and not file.variables):
        maps = [each.name for each in file.variables.values() if each.ndim == 2]
        lines = f'import h5py, numpy as np; np.save("map.npy", h5py.File("{path}")["{maps[0] if maps else "NAME"}"][:])'
        raise Refused(f"it is HDF5, but no NetCDF; a map in .npy is made in Python: {lines}")


def _dimensions(file: netCDF4.Dataset) -> int:
    """Return 2 if a file holds a map of heights, otherwise 1."""
    if "heights" in file.variables:
        return min(file["heights"].ndim, 2)
    return 2 if any(each.ndim >= 2 for each in file.variables.values()) else 1


def _variable(file: netCDF4.Dataset, channel: str | None, dimensions: int) -> netCDF4.Variable:
    """Choose the variable of heights; see `read_netcdf`."""
    data = [each for name, each in file.variables.items() if name not in file.dimensions and each.dtype is not str]
    maps = [each.name for each in data if each.ndim >= dimensions and not _leading(each, dimensions)]
    larger = [each.name for each in data if each.ndim > dimensions and each.name not in maps]
    names = [channel] if channel else ["heights"] if "heights" in file.variables else maps or larger
    if len(names) != 1 or names[0] not in file.variables:
        needed = f"none of them is the channel {channel}" if channel else "exactly one, or one named heights, is needed"
        raise Refused(f"maps of {dimensions} dimensions: {', '.join(maps) or 'none'}; {needed}")
    return file.variables[names[0]]


def _leading(variable: netCDF4.Variable, dimensions: int) -> str:
    """Return a text that lists the leading dimensions longer than 1, such as "time (3)"; "" if there are none.

    dimensions : number of trailing dimensions, which belong to the map (2) or line (1); all others are leading
    """
    lengths = zip(variable.dimensions[:-dimensions], variable.shape[:-dimensions], strict=True)
    return ", ".join(f"{name} ({length})" for name, length in lengths if length != 1)


def _are_whole(heights: Array) -> bool:
    """Return True if all heights are whole numbers, not all of them equal, as counts of a detector are."""
    values = heights[np.isfinite(heights)] if heights.dtype.kind == "f" else np.zeros(0)
    return bool(values.size and np.ptp(values) > 0 and (values == np.rint(values)).all())


def _unit_of(variable: netCDF4.Variable) -> str:
    """Return the unit of a variable from its attribute `units`; NOT_STATED without it.

    Raises ValueError for a unit in another attribute, of which it is not certain what it means.
    """
    for name in ("unit", "Units", "Unit", "UNITS"):
        if name in variable.ncattrs() and "units" not in variable.ncattrs():
            text = f"of {variable.name} is {variable.getncattr(name)!r}; the unit belongs into the attribute units"
            raise Refused(f"attribute {name} {text}, after a check of the numbers")
    unit = getattr(variable, "units", None)
    return unit if isinstance(unit, str) and unit.strip() else NOT_STATED


def _is_down(variable: netCDF4.Variable, flip: bool) -> bool:
    """Return True if larger numbers are lower, by the attribute `positive` of CF.

    flip : True if the user states that larger numbers are lower

    Raises ValueError for other texts than up and down, for a depth without this attribute unless `flip` is True, and
    if `flip` contradicts or repeats the attribute.
    """
    stated = [variable.name, *(str(getattr(variable, key, "")) for key in ("standard_name", "long_name"))]
    if "positive" not in variable.ncattrs():
        if any("depth" in text.lower() for text in stated) and not flip:
            text = f"variable {variable.name} is a depth, of which larger may be lower; argument flip states this"
            raise Refused(f"{text}, and the attribute positive = up of the variable the opposite")
        return False
    positive = str(variable.getncattr("positive")).strip().lower()
    if positive not in ("up", "down"):
        raise Refused(f"attribute positive of {variable.name} is {positive!r}; up or down is needed")
    if flip:
        raise Refused(f"argument flip: the file states positive = {positive}, which is obeyed; leave it out")
    return positive == "down"


def _positions_along(file: netCDF4.Dataset, dimension: str, heights: str) -> tuple[str, Array, str] | None:
    """Return (name, positions, unit) of the variable with the positions along a dimension; None if there is none.

    The coordinate with the name of the dimension is chosen first. Without a coordinate, a numeric variable that has
    only this dimension is chosen, provided that there is a single variable of this kind.

    heights : name of the variable of heights, which is never chosen
    """
    variables = {name: each for name, each in file.variables.items() if each.dimensions == (dimension,)}
    along = [name for name, each in variables.items() if np.dtype(each.dtype).kind in "iuf" and name != heights]
    name = dimension if dimension in along else along[0] if len(along) == 1 else None
    return None if name is None else (name, netcdf.unpacked(file.variables[name]), _unit_of(file.variables[name]))


def _spacing(rows: tuple[str, Array, str] | None, columns: tuple[str, Array, str] | None) -> tuple[Any, ...]:
    """Return ((dx, dy), unit, positions of columns and rows); (None, NOT_STATED, None) without positions.

    rows, columns : (name, positions, unit) from `_positions_along`. Positions that only number the points are ignored

    Raises ValueError if only the rows or only the columns have positions, and if only one of the two has a unit.
    """
    stated = [axis for axis in (columns, rows) if axis is not None and not _are_indices(*axis[1:])]
    if not stated:
        return None, NOT_STATED, None
    if len(stated) == 1:
        raise Refused(f"only the coordinate {stated[0][0]} states a spacing; both directions, or none, are needed")
    (_, x, unit), (_, y, other) = stated
    distances = [uniform_spacing(name, positions) for name, positions, _ in stated]
    if unit != other:
        if {unit, other} & {NOT_STATED, units.UNKNOWN}:
            raise Refused(f"coordinates are in {unit or 'no unit'} and {other or 'no unit'}; one unit is needed")
        distances[1] *= units.metres(other) / units.metres(unit)
        y = y * (units.metres(other) / units.metres(unit))
    return tuple(distances), unit, (np.asarray(x, float), np.asarray(y, float))


def _are_indices(positions: Array, unit: str) -> bool:
    """Return True if positions only number the points, from 0 or 1, and therefore state no distance."""
    counts = (np.arange(first, first + positions.size) for first in (0, 1))
    counts_up = any(np.array_equal(positions, count) for count in counts)
    return units.counts_points(unit) or (unit in (NOT_STATED, units.UNKNOWN) and counts_up)


def uniform_spacing(name: str, positions: Array) -> float:
    """Return the distance between equally spaced positions, which may rise or fall.

    name : name of the coordinate in the file, for messages

    Raises ValueError for fewer than two positions, and for distances that differ by more than rounding can cause.
    """
    positions = np.asarray(positions, float)
    if positions.size < 2:
        raise Refused(f"coordinate {name} has {positions.size} position; at least two are needed for a spacing")
    if not np.isfinite(positions).all():
        raise Refused(f"coordinate {name} is not finite everywhere; equally spaced numbers are needed")
    with np.errstate(over="ignore"):
        steps = np.diff(positions)
        mean = (positions[-1] - positions[0]) / (positions.size - 1)
        largest = np.abs(positions).max()
        # If single precision represents all positions exactly, they may have been rounded to single precision.
        in_single = np.array_equal(positions, positions.astype(np.float32))
        rounding = float(np.spacing(largest.astype(np.float32))) if in_single else 4 * np.spacing(largest)
    is_uniform = mean != 0 and np.isfinite(mean) and np.abs(steps - mean).max() <= _UNIFORMITY * abs(mean) + rounding
    if not is_uniform or (np.sign(steps) != np.sign(mean)).any():
        text = f"coordinate {name} is not uniform: its steps lie between {steps.min():g} and {steps.max():g}"
        raise Refused(f"{text}; equal spacing is needed")
    if rounding > _UNIFORMITY * abs(mean) * steps.size and np.ptp(steps) > _UNIFORMITY * abs(mean):
        raise Refused(f"coordinate {name} is too coarse for its steps of {abs(mean):g}; argument spacing is needed")
    return abs(mean)
