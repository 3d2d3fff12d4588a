"""Read maps and lines of heights from files, and convert them to the content of NetCDF files.

A file is read once. Its content, and not its name, selects one of four readers: .npy, NetCDF, text, and binary files of
instruments. Each reader returns a Scan, which `io.scan` converts to an Indenter.
"""

import warnings
from typing import Any

import numpy as np

from viscorough.basics import units
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import FilePath
from viscorough.io import matrices, netcdf
from viscorough.io.instruments import read_instrument
from viscorough.io.netcdf_heights import read_netcdf
from viscorough.io.refusals import path_named, reading
from viscorough.io.scan import Distance, Scan, in_metres, to_indenter
from viscorough.results.contact_maps import Contact
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.preparation import doubts, prepare

# The theory of small slopes is doubtful above this rms slope.
_STEEP_SLOPE = 0.3
# A field has sides between these lengths [m]. Other lengths suggest a wrong unit.
_LEAST_SIDE, _LARGEST_SIDE = 1e-9, 10.0
# Steps between numbers in single precision may be at most this share of the rms height.
_LARGEST_STEP = 0.1
_CUT = (
    "a line cut from a measured surface is stiffer than the surface, by a factor of 1.1 to 1.6: Eq. 13 holds for "
    "lines whose spectrum is that of the surface times q"
)


def read_heights(
    path: FilePath,
    spacing: Distance | tuple[Distance, Distance] | None = None,
    *,
    unit: str | None = None,
    channel: str | None = None,
    scale: float | str | None = None,
    **preparation: Any,
) -> Indenter:
    """Read a map of heights as an Indenter, with lengths in metres.

    The highest point touches first. Points that the file marks as missing are nan and lie outside the indenter. x runs
    along each row and y from row to row, in the order of the file. An AccuracyWarning is given for each defect of the
    prepared map, such as tilt, spikes and holes, for an rms slope above 0.3, for a field narrower than 1 nm or wider
    than 10 m, and for heights in single precision that are too coarse.

    Parameters
    ----------
    path : path
        A matrix (.npy, or text with one delimiter), NetCDF, or a binary file of an instrument, which needs
        pip install "viscorough[formats]".
    spacing : number or text or pair of them, optional
        Distance between neighbouring points, or (dx, dy) from column to column and from row to row. Plain numbers are
        in the unit of the heights; texts have a unit, such as "0.2 um". Needed if the file states no spacing, as
        matrices do.
    unit : str, optional
        Unit of length of the heights in the file, such as "um", if the file states none. By default all numbers are
        in consistent units, and are not converted.
    channel : str, optional
        Name or number (from 0) of the map in a file with several maps. The default is the variable `heights` in a
        NetCDF file, and the first channel with heights in a file of an instrument.
    scale : float or str, optional
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
        For a file without a map of heights, for a file of which the meaning is not certain, and if spacing or unit is
        missing or contradicts the file. The one-line message names the file, its fault and the remedy.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.save(f"{folder}/heights.npy", 1e-2 * np.random.default_rng(1).normal(size=(8, 8)))
    ...     surface = viscorough.read_heights(f"{folder}/heights.npy", 0.5, unit="um")
    >>> surface.heights.shape, surface.spacing, surface.length_unit
    ((8, 8), 5e-07, 'm')
    """
    content = content_of(path)
    scan = scan_of(path, content, channel=channel, dimensions=2, flip=bool(preparation.get("flip")))
    return in_metres(*map_of(path, scan, spacing, unit=unit, scale=scale, **preparation))


def read_line(path: FilePath, spacing: Distance | None = None, *, unit: str | None = None) -> Indenter:
    """Read the heights of a line as an Indenter in metres, for the method of dimensionality reduction (`reduce`).

    An AccuracyWarning is given for a file that viscorough did not write: `reduce` does not hold for a line that was cut
    from a surface.

    Parameters
    ----------
    path : path
        .npy of shape (points,), NetCDF with a variable `heights` of one dimension or a single variable of one
        dimension, or text with one row or one column of heights.
    spacing : number or text, optional
        Distance between neighbouring points: a number in the unit of the heights, or a text such as "0.2 um". Needed if
        the file states no spacing. Positions in a NetCDF file must be equally spaced.
    unit : str, optional
        Unit of length of the heights, such as "um", if the file states none.

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
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save(viscorough.self_affine_line(0.7, 64, seed=1), f"{folder}/line.nc")
    ...     line = viscorough.read_line(f"{folder}/line.nc")
    >>> line.heights.shape
    (64,)
    """
    content = content_of(path)
    return in_metres(*line_of(path, content, scan_of(path, content, dimensions=1), spacing, unit=unit))


def content_of(path: FilePath) -> bytes:
    """Return the content of a file. Raises a one-line ValueError if it is empty or cannot be read."""
    with reading(path, "a file of heights is needed"):
        with open(path, "rb") as file:
            content = file.read()
        if not content:
            raise ValueError("it is empty")
    return content


def scan_of(
    path: FilePath, content: bytes, *, channel: str | None = None, dimensions: int | None = None, flip: bool = False
) -> Scan:
    """Read heights, spacing and units from the content of a file, as a Scan.

    channel : name or number of the map in a file with several
    dimensions : 2 for a map, 1 for a line; None for whichever the file holds
    flip : True if the user states that larger numbers are lower

    Raises ValueError for content of which the meaning is not certain, and for heights of other dimensions.
    """
    name = str(path)
    with reading(path, "a file of heights is needed"):
        if netcdf.is_netcdf(content):
            scan = read_netcdf(path, content, channel, dimensions, flip=flip)
        elif matrices.is_npy(content, name) or matrices.is_text(content):
            if channel is not None:
                raise ValueError(f"argument channel {channel}: a file of this kind holds one map; leave it out")
            read = matrices.read_npy if matrices.is_npy(content, name) else matrices.read_text
            scan = read(content, name)
        else:
            scan = read_instrument(path, content, channel)
    if scan.heights.ndim not in ((1, 2) if dimensions is None else (dimensions,)):
        needed = "a map" if dimensions != 1 else "a line"
        other = {1: "; lines are for reduce", 2: "; maps are for indent"}.get(scan.heights.ndim, "")
        raise ValueError(f"{path}: heights have the shape {scan.heights.shape}; {needed} is needed{other}")
    return scan


def map_of(
    path: FilePath, scan: Scan, spacing: Any = None, *, unit: str | None = None, scale: Any = None, **preparation: Any
) -> tuple[Indenter, str]:
    """Convert a Scan of a map to a prepared Indenter and its unit, with the warnings of `read_heights`."""
    with path_named(path):
        indenter, length_unit = to_indenter(scan, spacing, unit, scale)
        indenter = prepare(indenter, **preparation)
    texts = [*doubts(indenter), *_doubts_about_numbers(scan, indenter, length_unit)]
    if (slope := indenter.rms_slope) > _STEEP_SLOPE:
        texts.append(f"the rms slope is {slope:.2g}; the theory holds for small slopes, below about {_STEEP_SLOPE}")
    for text in texts:
        warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=3)
    return indenter, length_unit


def line_of(
    path: FilePath, content: bytes, scan: Scan, spacing: Any = None, *, unit: str | None = None
) -> tuple[Indenter, str]:
    """Convert a Scan of a line to an Indenter and its unit, with the warnings of `read_line`.

    content : content of the file at `path`
    """
    with path_named(path):
        indenter, length_unit = to_indenter(scan, spacing, unit)
    texts = _doubts_about_numbers(scan, indenter, length_unit)
    if not (netcdf.is_netcdf(content) and netcdf.is_own(path, content)):
        texts.append(_CUT)
    for text in texts:
        warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=3)
    return indenter, length_unit


def _doubts_about_numbers(scan: Scan, indenter: Indenter, unit: str) -> list[str]:
    """Return one text for each doubt about the size of the field and the precision of the heights."""
    texts = []
    spacings = (indenter.row_spacing, indenter.spacing)[-indenter.heights.ndim :]
    metres = 1.0 if unit == units.UNKNOWN else units.metres(unit)
    sides = [points * spacing * metres for points, spacing in zip(indenter.heights.shape, spacings, strict=True)]
    if unit != units.UNKNOWN and not _LEAST_SIDE <= min(sides) <= max(sides) <= _LARGEST_SIDE:
        size = " by ".join(f"{side:.3g} m" for side in sides[::-1])
        text = f"the field is {size} wide; fields are from 1 nm to 10 m wide"
        texts.append(f"{text}: check argument spacing and argument unit")
    if scan.heights.dtype.kind == "f" and scan.heights.dtype.itemsize <= np.dtype(np.float32).itemsize:
        step = float(np.spacing(np.nanmax(np.abs(scan.heights))))
        if step > _LARGEST_STEP * (rms := float(np.nanstd(scan.heights.astype(float)))) > 0:
            text = f"heights are stored in steps of {step:.2g}, {step / rms:.2g} times the rms height"
            texts.append(f"{text}; subtract their mean before they are stored in single precision")
    return texts


def surface_to_content(indenter: Indenter) -> netcdf.Content:
    """Convert an Indenter to the content of a NetCDF file: heights with the dimensions (y, x), or (x) for a line."""
    variables = positions_of(indenter, indenter.heights.shape)
    about = {"long_name": "height", "units": indenter.length_unit}
    heights = {"heights": (tuple(variables), indenter.heights, about)}
    return heights | variables, {"title": "Heights of a rigid indenter; larger is higher and touches first"}


def positions_of(surface: Indenter | Contact, shape: tuple[int, ...]) -> dict[str, Any]:
    """Return the coordinates y and x of the points of a map, or x of a line, as variables of a NetCDF file.

    They are those of the surface, or 0 at the centre of the map or line.

    shape : numbers of rows and columns of the map, or number of points of the line
    """
    stated = {"y": surface.row_positions, "x": surface.column_positions}
    spacings = {"y": surface.row_spacing, "x": surface.spacing}
    variables: dict[str, Any] = {}
    for name, points in zip(("y", "x")[-len(shape) :], shape, strict=True):
        positions = stated[name]
        if positions is None:
            positions = spacings[name] * (np.arange(points) - (points - 1) / 2)
        variables[name] = (name,), positions, {"long_name": f"position along {name}", "units": surface.length_unit}
    return variables
