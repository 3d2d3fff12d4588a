"""Read maps of heights from binary files of instruments, with the package SurfaceTopography if it is installed."""

import io
import logging
import re
import struct
import warnings
import zipfile
from typing import Any

import numpy as np

from viscorough.basics import units
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import FilePath
from viscorough.io.refusals import Refused
from viscorough.io.scan import Scan

# Formats that SurfaceTopography guesses, and formats of plain arrays, of which it does not know the order of the axes.
_UNREAD = ("asc", "h5", "hgt", "mat", "nc", "npy", "npz", "xyz")
_TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
# Numbers of at least this magnitude, such as -1.8e308, mark missing points. No height in any unit is as large.
_LARGEST_HEIGHT = 1e30
_SURFACE = 2  # code of a surface in a file of Digital Surf
_UNKNOWN = "its content has no known format; .npy, NetCDF, a matrix in text, or a file of an instrument is needed"
# Messages list at most this many channels.
_MOST_NAMES = 5
# Suppress the log of tifffile about damaged files: our error message states the fault in one line.
logging.getLogger("tifffile").addHandler(logging.NullHandler())


def read_instrument(path: FilePath, content: bytes, channel: str | None) -> Scan:
    """Read heights, spacing and units, as a Scan, from a file in a format that SurfaceTopography recognizes.

    An AccuracyWarning is given if other channels hold heights as well, and if the surface is periodic.

    content : content of the file at `path`
    channel : name or number of the channel, from 0; None for the first channel with heights

    Raises ValueError for unknown formats, line scans and channels without heights.
    """
    # Ignore warnings of SurfaceTopography about optional packages and the layout of files: users cannot act on them.
    with warnings.catch_warnings(action="ignore"), _opened(path, content) as file:
        chosen, others = _choose(file, channel)
        # SurfaceTopography needs the lengths of the sides of a map. If the file does not state them, the numbers of
        # points are passed as dummies, and no spacing is returned.
        size = {"physical_sizes": chosen.nb_grid_pts} if chosen.physical_sizes is None else {}
        topography = chosen.topography(**size)
        # The first index of arrays of SurfaceTopography runs along x.
        heights = np.ma.filled(np.ma.asarray(topography.heights()).astype(float), np.nan).T
        heights[np.abs(heights) >= _LARGEST_HEIGHT] = np.nan
    if others:
        way = f"argument channel chooses another of {', '.join(map(repr, others))}"
        warnings.warn(f"{path}: the channel {chosen.channel_id!r} is read; {way}", AccuracyWarning, stacklevel=2)
    if chosen.is_periodic:
        text = "states that it is one period of a periodic surface; it is treated as a body with edges"
        warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=2)
    if not chosen.unit:  # distances without a unit are numbers of points
        return Scan(heights)
    return Scan(heights, chosen.unit, chosen.pixel_size, chosen.unit)


def _opened(path: FilePath, content: bytes) -> Any:
    """Return a SurfaceTopography reader for the content of a file, from which the format is found.

    Raises ValueError for an unknown format, and for formats whose content is not certain.
    """
    _refuse_archives(path, content)
    try:
        from SurfaceTopography.IO import CannotDetectFileFormat, open_topography
    except ImportError as error:
        _refuse_tiff(path, content)
        text = "unknown kind of file; .npy, NetCDF and text are read directly, formats of instruments with"
        raise Refused(f'{text} pip install "viscorough[formats]"') from error
    try:
        file = open_topography(io.BytesIO(content))
    except CannotDetectFileFormat as error:
        _refuse_tiff(path, content)
        _refuse_x3p(content)
        raise Refused(_UNKNOWN) from error
    if not _maps(file):  # some formats of instruments are TIFF, and only their readers find maps in it
        _refuse_tiff(path, content)
    if file.format() in _UNREAD:
        raise Refused(_UNKNOWN)
    return file


def _refuse_archives(path: FilePath, content: bytes) -> None:
    """Raise ValueError for archives of arrays of numpy and MATLAB, and for objects of Digital Surf but one surface."""
    lines = {
        b"MATLAB 5.0 MAT": f'import numpy as np, scipy.io; np.save("map.npy", scipy.io.loadmat("{path}")["NAME"])',
        b"PK": f'import numpy as np; np.save("map.npy", np.load("{path}")["NAME"])',
    }
    for start, line in lines.items():
        if content.startswith(start) and (start != b"PK" or b".npy" in content[:300]):
            raise Refused(f"an archive of arrays is not read; a map in .npy is made in Python: {line}")
    if content.startswith(b"DIGITAL SURF") and len(content) >= 20:
        count, kind = struct.unpack_from("<H", content, 14)[0], struct.unpack_from("<H", content, 18)[0]
        count = max(count, content.count(b"DIGITAL SURF\0"))
        if count != 1 or kind != _SURFACE:
            text = f"it holds {count} objects" if count != 1 else f"it holds an object of kind {kind}, not a surface"
            raise Refused(f"{text}; one surface is needed, so export it alone")


def _maps(file: Any) -> list[Any]:
    """Return the channels of a file that are maps."""
    return [channel for channel in file.channels if channel.dim == 2]


def _refuse_tiff(path: FilePath, content: bytes) -> None:
    """Raise ValueError for a TIFF file, with the line that makes a map of it."""
    if content.startswith(_TIFF):
        line = f'import numpy as np, tifffile; np.save("map.npy", tifffile.imread("{path}"))'
        text = "TIFF is not read; argument spacing then states the size of its pixels; .npy is made in Python"
        raise Refused(f"{text}: {line}")


def _refuse_x3p(content: bytes) -> None:
    """Raise ValueError for an x3p file of a revision that SurfaceTopography does not read."""
    if zipfile.is_zipfile(io.BytesIO(content)):
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            if "main.xml" in archive.namelist():
                found = re.search(rb"<Revision>([^<]{0,60})", archive.read("main.xml"))
                revision = found[1].decode(errors="replace") if found else "not stated"
                text = f"x3p files are read in the revision 'ISO5436 - 2000', and its revision is {revision}"
                raise Refused(f"{text}; save it in the former, or as .npy")


def _choose(file: Any, name: str | None) -> tuple[Any, list[str]]:
    """Return (channel to read, names of the other channels with heights).

    name : name or number of the channel to read; None for the first channel with heights. If `name` is given, no names
        of other channels are returned
    """
    maps = _maps(file)
    called = [channel for channel in maps if name in (channel.channel_id, channel.name, str(channel.index))]
    matches = maps if name is None else called[:1]
    with_heights = [channel for channel in matches if _holds_heights(channel)]
    names = ", ".join(repr(channel.channel_id) for channel in maps[:_MOST_NAMES])
    names += f" and {len(maps) - _MOST_NAMES} more" if len(maps) > _MOST_NAMES else ""
    if not maps:
        raise Refused("it holds no map of two dimensions with units of length")
    if not with_heights:
        text = "no map of heights" if name is None else f"no map of heights is called {name!r}"
        raise Refused(f"{text}; its maps of two dimensions are {names}")
    return with_heights[0], [channel.channel_id for channel in with_heights[1:]]


def _holds_heights(channel: Any) -> bool:
    """Return True if a channel holds heights, in a unit of length or without a unit."""
    unit = channel.unit
    return channel.is_height_channel and (unit is None or (isinstance(unit, str) and units.is_length(unit)))
