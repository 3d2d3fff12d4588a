"""Maps of heights in TIFF files: of one channel, with the spacing that GeoTIFF or ImageJ tags state."""

from __future__ import annotations

import logging
import xml.etree.ElementTree as ElementTree
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from viscorough import units
from viscorough.io.atomic import reason
from viscorough.io.scan import Scan
from viscorough.types import FilePath

if TYPE_CHECKING:
    import tifffile

_PARK_SYSTEMS = 50432  # tag of the atomic force microscopes whose heights are not in the picture
_LINEAR_UNITS = {9001: "m", 9002: "foot", 9003: "survey_foot", 9036: "km"}
_GEOGRAPHIC = 2
_GDAL_METADATA = 42112
# What tifffile logs about a damaged file is not printed: the error says it in one line.
logging.getLogger("tifffile").addHandler(logging.NullHandler())


def read_tiff(path: FilePath, channel: str | None = None) -> Scan:
    """The Scan in a TIFF file.

    channel : number of the page, from 0; needed if the file has several of the same size

    Raises a one-line ValueError for what is no map of one channel, and for geographic coordinates in degrees.
    """
    import tifffile

    try:
        with tifffile.TiffFile(path) as file:
            page = _page(file, channel)
            if _PARK_SYSTEMS in page.tags:
                from viscorough.io.instruments import read_instrument

                return read_instrument(path, channel)
            if page.samplesperpixel != 1:
                raise ValueError(f"a picture of {page.samplesperpixel} colours; a map of heights is needed")
            heights = page.asarray()
            spacing, spacing_unit, unit = _stated(file, page)
            scale, offset, scaled_unit = _scaling(file, page)
            heights = _without(heights, page.tags.get(42113))
            if (scale, offset) != (1, 0):
                heights = scale * heights.astype(float) + offset
            unit = _one_of(unit, scaled_unit)
    except (MemoryError, ModuleNotFoundError):
        raise
    except Exception as error:  # damage raises errors of many kinds, and codecs that are not installed do, too
        raise ValueError(f"{path}: not readable ({reason(error)}); a TIFF file of one channel is needed") from error
    return Scan(heights, unit, spacing, spacing_unit)


def _page(file: tifffile.TiffFile, channel: str | None) -> Any:
    """The page that holds the heights."""
    pages: list[Any] = [page for page in cast(Any, file.pages) if page.imagewidth and not page.is_reduced]
    if not pages:
        raise ValueError("it has no picture")
    if channel is None and len(pages) > 1 and _PARK_SYSTEMS not in pages[0].tags:
        raise ValueError(f"it has {len(pages)} pages; --channel 0 to {len(pages) - 1} chooses one")
    if channel is None or _PARK_SYSTEMS in pages[0].tags:
        return pages[0]
    if not (channel.isascii() and channel.isdigit() and int(channel) < len(pages)):
        raise ValueError(f"--channel {channel} is none of its pages; 0 to {len(pages) - 1} are allowed")
    return pages[int(channel)]


def _stated(file: tifffile.TiffFile, page: Any) -> tuple[Any, ...]:
    """((dx, dy) or None, unit of the spacing, unit of the heights) that tags state."""
    if page.is_geotiff:
        keys = page.geotiff_tags
        unit = _unit_of_key(keys.get("ProjLinearUnitsGeoKey"))
        height_unit = _unit_of_key(keys.get("VerticalUnitsGeoKey"))
        projected = {"ProjectedCSTypeGeoKey", "ProjLinearUnitsGeoKey", "ProjCoordTransGeoKey"} & set(keys)
        angles = {"GeographicTypeGeoKey", "GeogAngularUnitsGeoKey"} & set(keys)
        if keys.get("GTModelTypeGeoKey") == _GEOGRAPHIC or (angles and not projected):
            raise ValueError("its coordinates are in degrees; a map in projected coordinates is needed")
        if "ModelPixelScale" in keys:
            dx, dy = keys["ModelPixelScale"][:2]
        elif "ModelTransformation" in keys:
            matrix = np.reshape(keys["ModelTransformation"], (4, 4))
            if matrix[0, 1] != 0 or matrix[1, 0] != 0:
                raise ValueError("its rows are rotated against the coordinates; a map that is not is needed")
            dx, dy = abs(matrix[0, 0]), abs(matrix[1, 1])
        else:
            return None, "1", height_unit
        return (float(dx), float(dy)), unit, height_unit
    stated = (file.imagej_metadata or {}) if file.is_imagej else {}
    unit, unit_y = _unit_of_imagej(stated.get("unit")), _unit_of_imagej(stated.get("yunit", stated.get("unit")))
    if "1" not in (unit, unit_y) and {"XResolution", "YResolution"} <= {tag.name for tag in page.tags}:
        per_unit = [page.tags[name].value for name in ("XResolution", "YResolution")]
        if all(points > 0 and length > 0 for points, length in per_unit):
            dx, dy = (length / points for points, length in per_unit)
            return (dx, dy if unit_y == unit else dy * units.metres(unit_y) / units.metres(unit)), unit, "1"
    return None, "1", "1"


def _unit_of_imagej(text: str | None) -> str:
    """A unit of ImageJ, in which µ is escaped; "1" for none, and for numbers of points."""
    unit = str(text or "").strip().strip("\x00").replace("\\u00B5", "µ").replace("\\u00b5", "µ")
    return "1" if not unit or units.counts_points(unit) else unit


def _scaling(file: tifffile.TiffFile, page: Any) -> tuple[float, float, str]:
    """(scale, offset, unit) of stored numbers, by GDAL's metadata or ImageJ's calibration; "1" for no unit.

    Raises ValueError for a calibration by a function that is not linear.
    """
    if file.is_imagej and "cf" in (stated := file.imagej_metadata or {}):
        if int(stated["cf"]) != 0 or not {"c0", "c1"} <= set(stated):
            raise ValueError("its heights are calibrated by a function; a linear calibration, or none, is needed")
        return float(stated["c1"]), float(stated["c0"]), _unit_of_imagej(stated.get("vunit"))
    roles = {}
    if _GDAL_METADATA in page.tags:
        for item in ElementTree.fromstring(str(page.tags[_GDAL_METADATA].value).strip("\x00 ")).iter("Item"):
            if (role := item.get("role")) and item.get("sample", "0") == "0":
                roles[role.lower()] = (item.text or "").strip()
    return float(roles.get("scale", 1)), float(roles.get("offset", 0)), roles.get("unittype") or "1"


def _one_of(unit: str, other: str) -> str:
    """The unit that is stated. Raises ValueError for two that differ."""
    if "1" not in (unit, other) and units.metres(unit) != units.metres(other):
        raise ValueError(f"its heights are in {unit} and in {other}; one unit is needed")
    return other if unit == "1" else unit


def _unit_of_key(key: Any) -> str:
    return "1" if key is None else _LINEAR_UNITS.get(int(key), f"EPSG:{int(key)}")


def _without(heights: NDArray[Any], nodata: Any) -> NDArray[Any]:
    """The heights with those that equal the tag of missing values as nan."""
    if nodata is None or heights.dtype.kind not in "iuf":
        return heights
    try:
        mark = float(str(nodata.value).strip("\x00 "))
    except ValueError:
        return heights
    kept = heights.dtype if heights.dtype.kind == "f" else np.float64
    with np.errstate(over="ignore"):
        missing = np.isnan(heights) if np.isnan(mark) else heights == np.asarray(mark).astype(kept)
    return np.where(missing, np.nan, heights.astype(kept))
