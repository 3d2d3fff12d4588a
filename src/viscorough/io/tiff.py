"""Maps of heights in TIFF files: of one channel, with the spacing that GeoTIFF or ImageJ tags state."""

import logging
import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscorough import units
from viscorough.io.atomic import reading
from viscorough.io.scan import Scan
from viscorough.types import FilePath

_PARK_SYSTEMS = 50432  # tag of the atomic force microscopes whose heights are not in the picture
_LINEAR_UNITS = {9001: "m", 9002: "foot", 9003: "survey_foot", 9036: "km"}
_GDAL_METADATA, _GDAL_NODATA = 42112, 42113
# What tifffile logs about a damaged file is not printed: the error says it in one line.
logging.getLogger("tifffile").addHandler(logging.NullHandler())


def read_tiff(path: FilePath, channel: str | None = None) -> Scan:
    """The Scan in a TIFF file.

    channel : number of the page, from 0; needed if the file has several of the same size

    Raises a one-line ValueError for what is no map of one channel, and for geographic coordinates in degrees.
    """
    import tifffile

    with reading(path, "a TIFF file of one channel is needed"), tifffile.TiffFile(path) as file:
        page = _page(file, channel)
        if _PARK_SYSTEMS in page.tags:
            from viscorough.io.instruments import read_instrument

            return read_instrument(path, channel)
        if page.samplesperpixel != 1:
            raise ValueError(f"a picture of {page.samplesperpixel} colours; a map of heights is needed")
        if page.photometric in (0, 3):
            text = "in which low numbers are white" if page.photometric == 0 else "in false colours"
            raise ValueError(f"a picture {text}; a map of heights is needed")
        gdal_metadata = str(page.tags[_GDAL_METADATA].value) if _GDAL_METADATA in page.tags else ""
        if "cf" in (file.imagej_metadata or {}) or re.search('role="(scale|offset)"', gdal_metadata):
            text = "its numbers are heights only after a scale and an offset are applied"
            raise ValueError(f"{text}; heights are needed")
        spacing, spacing_unit, unit = _stated(file, page, gdal_metadata)
        return Scan(_without(page.asarray(), page.tags.get(_GDAL_NODATA)), unit, spacing, spacing_unit)


def _page(file: Any, channel: str | None) -> Any:
    """The page of a tifffile.TiffFile that holds the heights."""
    pages = [page for page in file.pages if page.imagewidth and not page.is_reduced]
    if not pages:
        raise ValueError("it has no picture")
    if _PARK_SYSTEMS in pages[0].tags or (channel is None and len(pages) == 1):
        return pages[0]
    if channel is None or not (channel.isascii() and channel.isdigit() and int(channel) < len(pages)):
        raise ValueError(f"it has {len(pages)} pages; --channel 0 to {len(pages) - 1} chooses one")
    return pages[int(channel)]


def _stated(file: Any, page: Any, gdal_metadata: str) -> tuple[Any, ...]:
    """((dx, dy) or None, unit of the spacing, unit of the heights) that tags state."""
    if page.is_geotiff:
        keys = page.geotiff_tags
        projected = {"ProjectedCSTypeGeoKey", "ProjLinearUnitsGeoKey", "ProjCoordTransGeoKey"} & set(keys)
        angles = {"GeographicTypeGeoKey", "GeogAngularUnitsGeoKey"} & set(keys)
        if keys.get("GTModelTypeGeoKey") == 2 or (angles and not projected):  # 2: a geographic model
            raise ValueError("its coordinates are in degrees; a map in projected coordinates is needed")
        height_unit = _unit_of_key(keys.get("VerticalUnitsGeoKey"))
        if of_gdal := re.search(r'role="unittype"[^>]*>\s*([^<]*\S)\s*<', gdal_metadata):
            if height_unit != units.UNKNOWN and units.metres(height_unit) != units.metres(of_gdal[1]):
                raise ValueError(f"its heights are in {height_unit} and in {of_gdal[1]}; one unit is needed")
            height_unit = of_gdal[1]
        if "ModelPixelScale" not in keys:
            return None, units.UNKNOWN, height_unit
        dx, dy = map(float, keys["ModelPixelScale"][:2])
        return (dx, dy), _unit_of_key(keys.get("ProjLinearUnitsGeoKey")), height_unit
    stated = file.imagej_metadata or {}
    unit = str(stated.get("unit") or units.UNKNOWN).replace("\\u00B5", "µ")
    if unit == units.UNKNOWN or units.counts_points(unit) or "yunit" in stated:
        return None, units.UNKNOWN, units.UNKNOWN
    dx, dy = (length / points for points, length in (page.tags[name].value for name in ("XResolution", "YResolution")))
    return (dx, dy), unit, units.UNKNOWN


def _unit_of_key(key: Any) -> str:
    return "1" if key is None else _LINEAR_UNITS.get(int(key), f"EPSG:{int(key)}")


def _without(heights: NDArray[Any], nodata: Any) -> NDArray[Any]:
    """The heights with those that equal the tag of missing values as nan."""
    if nodata is None or heights.dtype.kind not in "iuf":
        return heights
    kept = heights.dtype if heights.dtype.kind == "f" else np.float64
    with np.errstate(over="ignore"):
        mark = np.asarray(float(str(nodata.value).strip("\x00 "))).astype(kept)
    return np.where(heights == mark, np.nan, heights.astype(kept))
