"""Read maps of heights from TIFF files of one channel, with the spacing that ImageJ states; rasterio reads GeoTIFF."""

import logging
import os
from typing import Any

from numpy.typing import NDArray

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.types import FilePath
from viscorough.io.atomic import reading
from viscorough.io.elevation import read_elevation
from viscorough.io.instruments import read_instrument
from viscorough.io.scan import Scan

_PARK_SYSTEMS = 50432  # tag of atomic force microscopes whose files hold the heights outside the picture
# Tags of GeoTIFF (scale, place and rotation of the pixels, keys) and of GDAL (metadata, value for missing data).
_ELEVATION_TAGS = (33550, 33922, 34264, 34735, 42112, 42113)
_MASK = 4  # bit of the tag NewSubfileType
# Ends of the names of files in which GDAL keeps the mask, the units and the value for missing data of a TIFF file.
_SIDECARS = (".msk", ".aux.xml")
# Do not print the log of tifffile about a damaged file: the error has the fault in one line.
logging.getLogger("tifffile").addHandler(logging.NullHandler())


def read_tiff(path: FilePath, channel: str | None = None) -> Scan:
    """Read the Scan in a TIFF file.

    Files with a tag of GeoTIFF or GDAL, a mask, or a companion file of GDAL are elevation models.

    channel : number of the page, from 0; needed if the file has several of the same size

    Raises a one-line ValueError for a picture in colours, and for geographic coordinates in degrees.
    """
    import tifffile

    with reading(path, "a TIFF file of one channel is needed"), tifffile.TiffFile(path) as file:
        pages: list[Any] = [*file.pages]
        pages = [page for page in pages if page.imagewidth and not page.is_reduced]
        if not pages:
            raise ValueError("it has no picture")
        is_park_systems = _PARK_SYSTEMS in pages[0].tags
        is_elevation = any(page.subfiletype & _MASK or set(_ELEVATION_TAGS) & set(page.tags.keys()) for page in pages)
        if not (is_park_systems or is_elevation or any(os.path.exists(f"{path}{end}") for end in _SIDECARS)):
            return _scan(file, pages, channel)
    return read_instrument(path, channel) if is_park_systems else read_elevation(path, "GTiff", channel)


def _scan(file: Any, pages: list[Any], channel: str | None) -> Scan:
    """Return the Scan in a tifffile.TiffFile with these pages."""
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
    """Return the page of a TIFF file that holds the heights."""
    if channel is None and len(pages) == 1:
        return pages[0]
    if channel is None or not (channel.isascii() and channel.isdigit() and int(channel) < len(pages)):
        raise ValueError(f"it has {len(pages)} pages; {argument('channel')} 0 to {len(pages) - 1} chooses one")
    return pages[int(channel)]


def _heights(page: Any) -> NDArray[Any]:
    """Return the numbers of a page. Raises ValueError with the package to install if they cannot be decompressed."""
    try:
        return page.asarray()
    except (ImportError, ValueError) as error:
        if isinstance(error, ValueError) and "imagecodecs" not in str(error):
            raise
        coding = page.compression.name + (", predictor 3" if page.predictor == 3 else "")
        text = 'pip install "viscorough[formats]" installs the decoder'
        raise ValueError(f"compressed by {coding}; {text}") from error


def _stated_spacing(file: Any, page: Any) -> tuple[tuple[float, float] | None, str]:
    """Return the spacing (dx, dy) and its unit that ImageJ states; None and "1" for none."""
    stated = file.imagej_metadata or {}
    unit = str(stated.get("unit") or units.UNKNOWN).replace("\\u00B5", "µ")
    if unit == units.UNKNOWN or units.counts_points(unit) or "yunit" in stated:
        return None, units.UNKNOWN
    dx, dy = (length / points for points, length in (page.tags[name].value for name in ("XResolution", "YResolution")))
    return (dx, dy), unit
