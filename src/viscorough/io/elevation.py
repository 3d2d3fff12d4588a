"""Read elevation models, such as GeoTIFF files, with rasterio (GDAL), including units, masks and missing values."""

import contextlib
import math
import os
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.types import FilePath
from viscorough.io.atomic import reading, reason
from viscorough.io.scan import Scan

# Formats of elevation models: {suffix of a file: name of the format in GDAL}.
FORMATS = {".adf": "AIG", ".bil": "EHdr", ".dem": "USGSDEM", ".flt": "EHdr", ".hgt": "SRTMHGT", ".img": "HFA"}
FORMATS |= dict.fromkeys((".dt0", ".dt1", ".dt2"), "DTED")
# Units that GDAL and pint call by different names: {name in GDAL: name in pint}.
_GDAL_UNITS = {"US survey foot": "survey_foot", "sfoot": "survey_foot", "us-ft": "survey_foot"}
# Rows and columns count as perpendicular if the cosine of the angle between them is at most this.
_RIGHT_ANGLE = 1e-6


def read_elevation(path: FilePath, kind: str, channel: str | None = None) -> Scan:
    """Read heights, spacing and units from a file of an elevation model, as a Scan.

    Missing points are nan. A point is missing if it has the file's value for missing data, or if a mask in the file or
    in its .msk file excludes it.

    kind : name of the format in GDAL, a value of FORMATS or "GTiff"
    channel : number of the band, or of the page of a TIFF file, from 0. Needed if the file has several bands or pages

    Raises a one-line ValueError for coordinates in degrees, for pictures, and if rasterio is not installed.
    """
    with _opened(path, kind) as file:
        alpha = [band for band, meaning in zip(file.indexes, file.colorinterp, strict=True) if meaning.name == "alpha"]
        pages, bands = file.subdatasets, [band for band in file.indexes if band not in alpha]
        number = _number(channel, len(pages or bands), "pages" if pages else "bands")
        if not pages:
            return _scan(path, file, bands[number])
    with _opened(path, kind, pages[number]) as file:
        return _scan(path, file, 1)


def units_of_prj(path: FilePath) -> tuple[str, str]:
    """Return (unit of positions, unit of heights) from the .prj file of an ESRI grid; "1" for a unit that is missing.

    path : file of the ESRI grid

    Raises ValueError for coordinates in degrees, and for a reference system that GDAL cannot interpret.
    """
    with _opened(path, "AAIGrid") as file:
        return _units(file.crs)


@contextlib.contextmanager
def _opened(path: FilePath, kind: str, page: str | None = None) -> Iterator[Any]:
    """Yield the rasterio dataset of a file, or of a page of the file.

    kind : GDAL's name of the format
    page : GDAL's name of the page; None for the file itself
    """
    try:
        import rasterio
    except ImportError as error:
        text = 'GeoTIFF and other elevation models are read by rasterio; pip install "viscorough[geo]" installs it'
        raise ValueError(f"{path}: {text}") from error
    with contextlib.ExitStack() as stack:
        with _decoding(path):
            # Maps without coordinates are allowed, so the warnings of rasterio about them are ignored.
            stack.enter_context(warnings.catch_warnings(action="ignore"))
            # The path is absolute, since GDAL could take a name without a folder for an address or for options.
            file = stack.enter_context(rasterio.open(page or os.path.abspath(path), driver=kind))
        yield file


@contextlib.contextmanager
def _decoding(path: FilePath) -> Iterator[None]:
    """Turn every error in a `with` block into a one-line ValueError with the cause that GDAL states."""
    with reading(path, "a whole elevation model, such as GeoTIFF, is needed"):
        try:
            yield
        except Exception as error:
            raise ValueError(reason(error.__cause__ or error)) from error


def _number(channel: str | None, count: int, kind: str) -> int:
    """Return the number, from 0, of the channel to read.

    channel : number that the user gave, as a text; None if the user gave none
    count : number of channels in the file
    kind : word for the channels in the message, "bands" or "pages"
    """
    if channel is None and count == 1:
        return 0
    if channel is None or not (channel.isascii() and channel.isdigit() and int(channel) < count):
        raise ValueError(f"it has {count} {kind}; {argument('channel')} 0 to {count - 1} chooses one")
    return int(channel)


def _scan(path: FilePath, file: Any, band: int) -> Scan:
    """Return heights, spacing and units of a band of a rasterio dataset, as a Scan.

    path : path of the file, for messages
    file : rasterio dataset
    band : number of the band, from 1
    """
    if (colour := file.colorinterp[band - 1].name) not in ("gray", "undefined"):
        raise ValueError(f"a picture in colours (band {band - 1} is {colour}); a map of heights is needed")
    lateral, vertical = _units(file.crs)
    stated = file.units[band - 1] or units.UNKNOWN
    unit = _GDAL_UNITS.get(stated, stated)
    if units.UNKNOWN not in (unit, vertical) and units.metres(unit) != units.metres(vertical):
        raise ValueError(f"its heights are in {stated}, and in {vertical} by its reference system; one unit is needed")
    with _decoding(path):
        heights = _heights(file, band)
    unit = vertical if unit == units.UNKNOWN else unit
    if file.transform.is_identity:
        return Scan(heights, unit)
    # Between neighbouring points, the position (x, y) changes by (a, d) along a row and by (b, e) along a column.
    a, b, c, d, e, f = file.transform[:6]
    dx, dy = math.hypot(a, d), math.hypot(b, e)
    if abs(a * b + d * e) > _RIGHT_ANGLE * dx * dy:
        raise ValueError("its rows and columns are not perpendicular; a map with a rectangular grid is needed")
    if lateral != units.UNKNOWN:
        return Scan(heights, unit, (dx, dy), lateral)
    places = [(i + 0.5, j + 0.5) for i in (0, file.width - 1) for j in (0, file.height - 1)]
    x, y = [a * i + b * j + c for i, j in places], [d * i + e * j + f for i, j in places]
    return Scan(heights, unit, (dx, dy), lateral, (min(x), min(y), max(x), max(y)))


def _heights(file: Any, band: int) -> NDArray[Any]:
    """Return the heights of a band, with nan at masked points and at points with the value for missing data."""
    stored, is_measured = file.read(band), file.read_masks(band) != 0
    if stored.dtype.kind not in "iuf":
        return stored
    heights = stored.astype(stored.dtype if stored.dtype.kind == "f" else np.float64)
    # GDAL ignores the value for missing data if the file has a mask. Here, both mark missing points.
    if (nodata := file.nodatavals[band - 1]) is not None:
        with np.errstate(over="ignore"):
            is_measured &= heights != np.asarray(nodata).astype(heights.dtype)
    scale, offset = file.scales[band - 1], file.offsets[band - 1]
    if (scale, offset) != (1, 0):
        heights = heights.astype(float) * scale + offset
    return np.where(is_measured, heights, np.nan)


def _units(system: Any) -> tuple[str, str]:
    """Return (unit of positions, unit of heights) of a coordinate reference system; "1" for a unit that is not stated.

    system : rasterio.crs.CRS, or None for a file without a reference system

    Raises ValueError for coordinates in degrees and for an incomplete system.
    """
    if system is None:
        return units.UNKNOWN, units.UNKNOWN
    definition = system.to_dict(projjson=True)
    if definition["type"] == "EngineeringCRS" and definition["name"] == "unnamed":
        # GDAL assumes metres for an incomplete reference system, although the file may state another unit.
        text = "its coordinate reference system is incomplete, so that the unit of x and y is not certain"
        raise ValueError(f"{text}; a complete one is needed, as 'rio edit-info --crs EPSG:CODE FILE' writes into it")
    lateral = vertical = units.UNKNOWN
    for axis in _axes(definition):
        if axis["direction"] in ("up", "down"):
            vertical = _unit(axis["unit"])
        else:
            lateral = _unit(axis["unit"])
    return lateral, vertical


def _axes(definition: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the axes of a coordinate reference system, given as PROJJSON, including the axes of all its parts."""
    if definition["type"] == "BoundCRS":
        return _axes(definition["source_crs"])
    if definition["type"] == "CompoundCRS":
        return [axis for part in definition["components"] for axis in _axes(part)]
    return definition["coordinate_system"]["axis"]


def _unit(unit: str | dict[str, Any]) -> str:
    """Convert a unit of length as PROJJSON states it to a text such as "0.3048 m". Raises ValueError for degrees."""
    if unit == "metre":
        return "m"
    if isinstance(unit, dict) and unit["type"] == "LinearUnit":
        return f"{unit['conversion_factor']!r} m"
    text = "its coordinates are in degrees; a map in projected coordinates is needed"
    raise ValueError(f"{text}, as 'rio warp FILE NEW.tif --dst-crs EPSG:CODE' writes")
