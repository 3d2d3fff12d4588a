"""Read maps of heights from TIFF files of one channel, with the spacing that the program ImageJ writes into them.

TIFF files of Park Systems microscopes are passed on to io.instruments. Georeferenced rasters (GeoTIFF) are refused.
"""

import logging
import os
from typing import Any

from numpy.typing import NDArray

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.types import FilePath
from viscorough.io.atomic import reading
from viscorough.io.instruments import read_instrument, refuse_raster
from viscorough.io.scan import Scan

_PARK_SYSTEMS = 50432  # TIFF tag of Park Systems microscopes, whose files hold the heights outside the picture
# TIFF tags of GeoTIFF (scale, place and rotation of the pixels, geographic keys) and of GDAL (metadata, value for
# missing data).
_RASTER_TAGS = (33550, 33922, 34264, 34735, 42112, 42113)
_MASK = 4  # bit in the tag NewSubfileType that is set if a page is a mask
# Endings of the names of GDAL's companion files. They hold the mask, the units and the value for missing data of a
# TIFF file.
_SIDECARS = (".msk", ".aux.xml")
# Suppress the log of tifffile about a damaged file: our error message states the fault in one line.
logging.getLogger("tifffile").addHandler(logging.NullHandler())


def read_tiff(path: FilePath, channel: str | None = None) -> Scan:
    """Read a map of heights from a TIFF file, as a Scan with its spacing and units.

    channel : number of the page, from 0; needed if the file has several pages. Pages of reduced size are not counted

    Raises a one-line ValueError for a picture in colours, and for a file with a tag of GeoTIFF or GDAL, a mask, or a
    companion file of GDAL.
    """
    import tifffile

    with reading(path, "a TIFF file of one channel is needed"), tifffile.TiffFile(path) as file:
        pages: list[Any] = [*file.pages]
        pages = [page for page in pages if page.imagewidth and not page.is_reduced]
        if not pages:
            raise ValueError("it has no picture")
        is_park_systems = _PARK_SYSTEMS in pages[0].tags
        is_raster = any(page.subfiletype & _MASK or set(_RASTER_TAGS) & set(page.tags.keys()) for page in pages)
        if not is_park_systems:
            if is_raster or any(os.path.exists(f"{path}{end}") for end in _SIDECARS):
                refuse_raster()
            return _scan(file, pages, channel)
    return read_instrument(path, channel)


def _scan(file: Any, pages: list[Any], channel: str | None) -> Scan:
    """Return heights and spacing, as a Scan, from the page that `channel` selects.

    file : tifffile.TiffFile
    pages : the pages with a picture in full resolution
    channel : number of the page, from 0; None for the only page
    """
    page = _page(pages, channel)
    if page.samplesperpixel != 1:
        raise ValueError(f"a picture of {page.samplesperpixel} colours; a map of heights is needed")
    if page.photometric in (0, 3):
        text = "in which low numbers are white" if page.photometric == 0 else "in false colours"
        raise ValueError(f"a picture {text}; a map of heights is needed")
    if "cf" in (file.imagej_metadata or {}):
        text = "its numbers are heights only after a scale and an offset are applied"
        raise ValueError(f"{text}; heights are needed")
    spacing, unit = _stated_spacing(file, page)
    return Scan(_heights(page), spacing=spacing, spacing_unit=unit)


def _page(pages: list[Any], channel: str | None) -> Any:
    """Return the page with the number `channel`, or the only page if `channel` is None."""
    if channel is None and len(pages) == 1:
        return pages[0]
    if channel is None or not (channel.isascii() and channel.isdigit() and int(channel) < len(pages)):
        raise ValueError(f"it has {len(pages)} pages; {argument('channel')} 0 to {len(pages) - 1} chooses one")
    return pages[int(channel)]


def _heights(page: Any) -> NDArray[Any]:
    """Return the values of all pixels of a page of the file, which are the heights of the map.

    Raises ValueError if the page is compressed and the package that can decompress it is not installed.
    """
    try:
        return page.asarray()
    except (ImportError, ValueError) as error:
        if isinstance(error, ValueError) and "imagecodecs" not in str(error):
            raise
        coding = page.compression.name + (", predictor 3" if page.predictor == 3 else "")
        text = 'pip install "viscorough[formats]" installs the decoder'
        raise ValueError(f"compressed by {coding}; {text}") from error


def _stated_spacing(file: Any, page: Any) -> tuple[tuple[float, float] | None, str]:
    """Return the spacing (dx, dy) that ImageJ states in the file, and its unit; (None, "1") if none is stated."""
    stated = file.imagej_metadata or {}
    unit = str(stated.get("unit") or units.UNKNOWN).replace("\\u00B5", "µ")
    if unit == units.UNKNOWN or units.counts_points(unit) or "yunit" in stated:
        return None, units.UNKNOWN
    dx, dy = (length / points for points, length in (page.tags[name].value for name in ("XResolution", "YResolution")))
    return (dx, dy), unit
