"""Read maps and lines of heights from files of many formats, and convert them to the content of NetCDF files."""

import re
import warnings
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.arrays import positive
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, FilePath
from viscorough.io import netcdf
from viscorough.io.atomic import path_named, reading
from viscorough.io.instruments import (
    holds_instrument_line,
    is_sdf_text,
    read_instrument,
    read_instrument_line,
    refuse_raster,
)
from viscorough.io.profiles import holds_profile, read_profile
from viscorough.io.scan import Distance, Scan, to_indenter, uniform_spacing
from viscorough.io.text import is_binary, read_text
from viscorough.io.unpacking import unpacked
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.preparation import doubts, prepare

# Suffixes of georeferenced rasters, which are not read.
_RASTERS = (".adf", ".bil", ".dem", ".flt", ".hgt", ".img", ".dt0", ".dt1", ".dt2", ".vrt")
# The theory of small slopes is doubtful above this rms slope.
_STEEP_SLOPE = 0.3


def read_heights(
    path: FilePath,
    spacing: Distance | str | tuple[Distance | str, Distance | str] | None = None,
    *,
    unit: str | None = None,
    lateral_unit: str | None = None,
    channel: str | None = None,
    scale: float | str | units.Quantity | None = None,
    **preparation: Any,
) -> Indenter:
    """Read a map of heights as an Indenter.

    The highest point touches first. Points that the file marks as missing are nan and lie outside the indenter. x runs
    along each row and y from row to row, in the order of the file; points x, y, z are sorted by increasing x and y. An
    AccuracyWarning is given for each defect of the prepared map, such as tilt, spikes and holes, and for an rms slope
    above 0.3.

    Parameters
    ----------
    path : path
        .npy, NetCDF (.nc), text with any suffix (a matrix, an ESRI grid, or columns x, y, z),
        TIFF, or a format of an instrument (pip install "viscorough[formats]").
    spacing : number or text or pair of them, optional
        Distance between neighbouring points, or (dx, dy) from column to column and from row to row. Plain numbers are
        in the unit of the heights; texts have a unit, such as "0.2 um". Needed if the file states no spacing.
    unit : str, optional
        Unit of length of the heights, such as "um", if the file states none. It also applies to positions x and y
        without a unit.
    lateral_unit : str, optional
        Unit of positions x and y, and of a spacing in plain numbers, such as "mm", if it is not the unit of the
        heights.
    channel : str, optional
        Name or number (from 0) of the map in a file with several maps. The default is the variable `heights` in a
        NetCDF file, and the first channel with heights in a file of an instrument.
    scale : float or str or units.Quantity, optional
        Factor that converts the numbers in a file to heights, if these numbers have no unit of length. Examples are
        "0.053 nm" per count of a detector, or "53 nm" per radian if the file states radians.
    preparation : Any
        Keyword arguments of viscorough.prepare.

    Returns
    -------
    Indenter

    Raises
    ------
    ValueError
        For a file without a map of heights, and if spacing or unit is missing or contradicts the file. The one-line
        message names the file, its fault and the remedy.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.save(f"{folder}/heights.npy", 1e-2 * np.random.default_rng(1).normal(size=(8, 8)))
    ...     surface = viscorough.read_heights(f"{folder}/heights.npy", 0.5, unit="um")
    >>> surface.heights.shape, surface.spacing, surface.length_unit
    ((8, 8), 0.5, 'um')
    """
    with path_named(path):
        scan = _read_scan(path, channel, is_map=isinstance(spacing, tuple | list | np.ndarray))
        if scan.down and preparation.get("flip"):
            raise ValueError(f"{argument('flip')}: the file states positive = down, which is obeyed; leave it out")
        indenter = to_indenter(scan if scale is None else _scaled(scan, scale), spacing, unit, lateral_unit)
        indenter = prepare(indenter, **preparation)
    texts = doubts(indenter)
    if (slope := indenter.rms_slope) > _STEEP_SLOPE:
        texts.append(f"the rms slope is {slope:.2g}; the theory holds for small slopes, below about {_STEEP_SLOPE}")
    for text in texts:
        warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=2)
    return indenter


def read_line(
    path: FilePath,
    spacing: Distance | str | None = None,
    *,
    unit: str | None = None,
    lateral_unit: str | None = None,
) -> Indenter:
    """Read the heights of a line as an Indenter, for the method of dimensionality reduction (`reduce`).

    Parameters
    ----------
    path : path
        .npy of shape (points,), .nc with a variable `heights` of one dimension or a single variable of one dimension,
        a profile of Digital Surf (.pro), or text with any suffix. A text holds one column or row of heights, or two
        columns or rows with positions x and heights z. If a heading names x and z, such as "x [um], z [nm]", other
        columns are ignored.
    spacing : number or text, optional
        Distance between neighbouring points: a number in the unit of the heights, or a text such as "0.2 um". Needed if
        the file states no spacing. Positions in the file must be equally spaced, within one unit of their last digit.
        Positions 0, 1, 2, … or 1, 2, 3, … without a heading number the points and state no spacing.
    unit : str, optional
        Unit of length of the heights, such as "um", if the file states none. It also applies to positions without a
        unit.
    lateral_unit : str, optional
        Unit of positions x, and of a spacing in plain numbers, such as "mm", if it is not the unit of the heights.

    Returns
    -------
    Indenter

    Raises
    ------
    ValueError
        For a file without a line of heights, and if spacing or unit is missing or contradicts the file. The one-line
        message names the file and its fault.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.save(f"{folder}/line.npy", np.random.default_rng(1).normal(size=64))
    ...     line = viscorough.read_line(f"{folder}/line.npy", 0.5)
    >>> line.heights.shape
    (64,)
    """
    with path_named(path):
        if is_npy(path):
            scan = Scan(npy_array(path))
        elif Path(path).suffix.lower() == ".nc":
            scan = netcdf_scan(path, None, dimensions=1)
        elif is_binary(path):
            scan = read_instrument_line(path)
        else:
            scan = read_profile(path)
        spacings = None if spacing is None else (spacing, spacing)
        return to_indenter(scan, spacings, unit, lateral_unit, dimensions=1)


def surface_to_content(indenter: Indenter) -> netcdf.Content:
    """Convert an Indenter to the content of a NetCDF file: heights with the dimensions (y, x), or (x) for a line.

    The coordinates y and x are those of the indenter, or 0 at the centre of the map or line.
    """
    axes = {"x": indenter.spacing} if indenter.heights.ndim == 1 else {"y": indenter.row_spacing, "x": indenter.spacing}
    unit = indenter.length_unit
    variables = {"heights": netcdf.Variable(tuple(axes), indenter.heights, {"long_name": "height", "units": unit})}
    stated = {"y": indenter.row_positions, "x": indenter.column_positions}
    variables |= netcdf.axes_of(indenter.heights.shape, axes, unit, stated)
    return netcdf.Content(variables, {"title": "Heights of a rigid indenter; larger is higher and touches first"})


def dimensions_of_heights(path: FilePath) -> int:
    """Return the number of dimensions of the heights in a file: 1 for a line (.npy, NetCDF or text), otherwise 2."""
    if is_npy(path):
        return npy_array(path).ndim
    if Path(path).suffix.lower() != ".nc":
        with path_named(path):
            if is_binary(path) or is_sdf_text(path):
                return 1 if holds_instrument_line(path) else 2
            return 1 if holds_profile(path) else 2
    with netcdf.opened(path) as file:
        maps = [name for name, each in file.variables.items() if each.ndim >= 2]
        return min(file["heights"].ndim, 2) if "heights" in file.variables else 2 if maps else 1


def _scaled(scan: Scan, scale: float | str | units.Quantity) -> Scan:
    """Multiply the heights of a Scan by a scale. If the scale has a unit, the heights get this unit."""
    quantity = units.with_unit(scale)
    number, unit = (quantity.number, quantity.unit) if isinstance(quantity, units.Quantity) else (quantity, "")
    if unit and units.is_length(scan.unit):
        raise ValueError(
            f"{argument('scale')} {scale}: heights are in {scan.unit} in the file; a plain number is needed"
        )
    number = positive(argument("scale"), number)
    if scan.heights.dtype.kind not in "iuf":
        return scan  # Indenter refuses heights that are no numbers
    return scan._replace(heights=scan.heights * number, unit=unit or scan.unit)


def _read_scan(path: FilePath, channel: str | None, *, is_map: bool) -> Scan:
    """Read heights, spacing and units from a file, as a Scan.

    The suffix selects the reader of NetCDF and TIFF, and the content of the file all other readers.

    is_map : True if the user gives both dx and dy. A text file with one or two rows or columns is then read as a map;
        otherwise it is refused, since it may hold a profile
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".nc":
        return netcdf_scan(path, channel)
    if suffix in (".tif", ".tiff"):
        from viscorough.io.tiff import read_tiff

        return read_tiff(path, channel)
    if is_npy(path) or not (is_binary(path) or is_sdf_text(path)):
        if channel is not None:
            raise ValueError(f"{argument('channel')} {channel}: a file of this kind holds one map; leave it out")
        return Scan(npy_array(path)) if is_npy(path) else _with_units_of_prj(read_text(path, is_map=is_map), path)
    if suffix in _RASTERS:
        refuse_raster()
    return read_instrument(path, channel)


def _with_units_of_prj(scan: Scan, path: FilePath) -> Scan:
    """Return the Scan of an ESRI grid with the units that its .prj file states; return other Scans unchanged.

    path : text file from which the Scan was read. The .prj file has the same name with the suffix .prj or .PRJ, and
        holds a coordinate reference system as text (WKT). The unit of x and y follows the projection, and the unit of
        heights is in a part VERTCS

    Raises ValueError for coordinates in degrees, and for another text.
    """
    found = [each for end in (".prj", ".PRJ") if (each := Path(path).with_suffix(end)).exists()]
    if scan.corners is None or not found:
        return scan
    with reading(found[0], "a coordinate reference system in projected coordinates is needed"):
        horizontal, _, vertical = found[0].read_text(encoding="utf-8", errors="replace").partition("VERTCS")
        metres = [re.findall(r'UNIT\["[^"]*",\s*([\d.eE+-]+)', part) for part in (horizontal, vertical)]
        if not re.match(r"\s*(?:COMPD_CS\[\"[^\"]*\",\s*)?PROJCS", horizontal) or not metres[0]:
            raise ValueError("its coordinates are in degrees, or in an unknown system")
        lateral, height = (f"{float(each[-1])!r} m" if each else units.UNKNOWN for each in metres)
    return scan._replace(unit=height, spacing_unit=lateral)


def is_npy(path: FilePath) -> bool:
    """Return True if a file is named .npy or begins like a .npy file. Raises ValueError for an unreadable file."""
    if Path(path).suffix.lower() == ".npy":
        return True
    with reading(path, "a file of numbers is needed"), open(path, "rb") as file:
        return file.read(len(np.lib.format.MAGIC_PREFIX)) == np.lib.format.MAGIC_PREFIX


def npy_array(path: FilePath) -> NDArray[Any]:
    """Return the array in a .npy file. Raises a one-line ValueError for unreadable files and pickled objects."""
    with reading(path, "a .npy file of numbers is needed"), open(path, "rb") as file:
        return np.lib.format.read_array(file, allow_pickle=False)


def netcdf_scan(path: FilePath, channel: str | None, dimensions: int = 2) -> Scan:
    """Read heights, spacing and units from a variable of a NetCDF file, as a Scan.

    channel : name of the variable. None for the variable `heights` or, if there is none, for the only variable with
        this number of dimensions
    dimensions : 2 for a map, 1 for a line; leading dimensions of length 1, such as a time, do not count
    """
    with netcdf.opened(path) as file:
        data = [each for name, each in file.variables.items() if name not in file.dimensions]
        maps = [each.name for each in data if each.ndim >= dimensions and not _leading(each, dimensions)]
        larger = [each.name for each in data if each.ndim > dimensions and each.name not in maps]
        default = ["heights"] if "heights" in file.variables else maps or larger
        names = [channel] if channel else default
        if found := len(names) == 1 and names[0] in file.variables:
            variable = file.variables[names[0]]
            leading = _leading(variable, dimensions)
            heights, unit, axes = unpacked(variable), _unit_of(variable), variable.dimensions[-dimensions:]
            positions = [_positions_along(file, axis, names[0]) for axis in axes]
            down = _is_down(variable)
    if not found:
        needed = f"none of them is the channel {channel}" if channel else "exactly one, or one named heights, is needed"
        raise ValueError(f"{path}: maps of {dimensions} dimensions: {', '.join(maps) or 'none'}; {needed}")
    if leading:
        first = leading.split(" ", maxsplit=1)[0]
        text = f"variable {names[0]} has the further dimensions {leading}; a variable without them is needed"
        raise ValueError(f"{path}: {text}, as isel({first}=0) of xarray gives")
    if heights.ndim < dimensions:
        return Scan(heights, unit)
    heights = heights.reshape(heights.shape[-dimensions:])
    if [axis.lower() for axis in axes] == ["x", "y"]:
        heights, positions = heights.T, positions[::-1]
    spacing, spacing_unit, places = _spacing(positions[0], positions[-1])
    return Scan(-heights if down else heights, unit, spacing, spacing_unit, positions=places, down=down)


def _leading(variable: netCDF4.Variable, dimensions: int) -> str:
    """Return a text that lists the leading dimensions longer than 1, such as "time (3)"; "" if there are none.

    dimensions : number of trailing dimensions, which belong to the map (2) or line (1); all others are leading
    """
    lengths = zip(variable.dimensions[:-dimensions], variable.shape[:-dimensions], strict=True)
    return ", ".join(f"{name} ({length})" for name, length in lengths if length != 1)


def _unit_of(variable: netCDF4.Variable) -> str:
    """Return the unit of a NetCDF variable from its attribute `units` or `unit`; "1" if it has neither."""
    unit = getattr(variable, "units", getattr(variable, "unit", None))
    return unit if isinstance(unit, str) and unit.strip() else "1"


def _is_down(variable: netCDF4.Variable) -> bool:
    """Return True if larger numbers are lower, by the attribute `positive` of CF. Raises ValueError for other texts."""
    positive = str(getattr(variable, "positive", "up")).strip().lower()
    if positive not in ("up", "down"):
        raise ValueError(f"attribute positive of {variable.name} is {positive!r}; up or down is needed")
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
    return None if name is None else (name, unpacked(file.variables[name]), _unit_of(file.variables[name]))


def _spacing(rows: tuple[str, Array, str] | None, columns: tuple[str, Array, str] | None) -> tuple[Any, ...]:
    """Return ((dx, dy), unit, positions of columns and rows); (None, "1", None) without positions.

    rows, columns : (name, positions, unit) from `_positions_along`. Positions that only number the points are ignored

    Raises ValueError if only the rows or only the columns have positions, and if only one of the two has a unit.
    """
    stated = [axis for axis in (columns, rows) if axis is not None and not _are_indices(*axis[1:])]
    if not stated:
        return None, "1", None
    if len(stated) == 1:
        raise ValueError(f"only the coordinate {stated[0][0]} states a spacing; both directions, or none, are needed")
    (_, x, unit), (_, y, other) = stated
    distances = [uniform_spacing(name, positions) for name, positions, _ in stated]
    if unit != other:
        if "1" in (unit, other):
            raise ValueError(f"coordinates are in {unit} and {other}; units of length are needed for both")
        distances[1] *= units.metres(other) / units.metres(unit)
        y = y * (units.metres(other) / units.metres(unit))
    return tuple(distances), unit, (np.asarray(x, float), np.asarray(y, float))


def _are_indices(positions: Array, unit: str) -> bool:
    """Return True if positions only number the points, from 0 or 1, and therefore state no distance."""
    counts = (np.arange(first, first + positions.size) for first in (0, 1))
    counts_up = not np.ma.is_masked(positions) and any(np.array_equal(positions, count) for count in counts)
    return units.counts_points(unit) or (unit == "1" and counts_up)
