"""Maps of heights in the file formats of instruments, read by SurfaceTopography if that is installed."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np

from viscorough import units
from viscorough.errors import AccuracyWarning
from viscorough.io.atomic import reading
from viscorough.io.scan import Scan
from viscorough.types import FilePath

# Formats that hold plain arrays, with rows along y; SurfaceTopography's first index runs along x.
_OF_ARRAYS = ("npy", "npz", "mat", "h5")


def read_instrument(path: FilePath, channel: str | None = None) -> Scan:
    """The Scan in a file of any format that SurfaceTopography knows; its formats are told apart by their contents.

    channel : name or number of the channel, from 0. By default the first one of heights, with a warning that names the
        others if there are any

    Raises a one-line ValueError for files of no known format, line scans and channels that hold no heights.
    """
    # The warnings are about optional packages and the layout of files, which no user can change.
    with reading(path, "a file of heights is needed"), warnings.catch_warnings(action="ignore"):
        if not Path(path).stat().st_size:
            raise ValueError("it is empty")
        try:
            from SurfaceTopography.IO import CannotDetectFileFormat, open_topography
        except ImportError as error:
            text = "unknown kind of file; .npy, .nc, text and TIFF are read directly, formats of instruments with"
            raise ValueError(f"{text} pip install 'viscorough[formats]'") from error
        try:
            file = open_topography(str(path))
        except CannotDetectFileFormat as error:
            raise ValueError("no known format") from error
        with file:
            kind, suffix = file.format(), Path(path).suffix.lower()
            if kind == "hgt" and suffix != ".hgt":  # which any file of a suitable size could be
                raise ValueError("no known format")
            chosen, others = _choose(file, channel)
            # A size is required also where the file states none; it is not used then.
            size = {"physical_sizes": chosen.nb_grid_pts} if chosen.physical_sizes is None else {}
            topography = chosen.topography(**size)
            heights = np.ma.filled(np.ma.asarray(topography.heights()).astype(float), np.nan)
            # HDF5 files that MATLAB wrote hold its arrays transposed.
            if kind not in _OF_ARRAYS or (kind == "h5" and suffix == ".mat"):
                heights = heights.T
    if others:
        text = f"the channel {chosen.channel_id!r} is read; --channel chooses another of {', '.join(map(repr, others))}"
        warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=2)
    if chosen.is_periodic:
        text = "states that it is one period of a periodic surface; it is treated as a body with edges"
        warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=2)
    unit = chosen.unit or units.UNKNOWN
    return Scan(heights, unit, chosen.pixel_size, unit)


def _choose(file: Any, wanted: str | None) -> Any:
    """The channel to read, and the names of the other channels of heights if none was asked for."""
    maps = [channel for channel in file.channels if channel.dim == 2]
    called = [channel for channel in maps if wanted in (channel.channel_id, channel.name, str(channel.index))]
    matches = maps if wanted is None else called[:1]
    of_heights = [channel for channel in matches if _holds_heights(channel)]
    if not of_heights:
        names = ", ".join(repr(channel.channel_id) for channel in maps) or "none"
        what = "no map of heights" if wanted is None else f"no map of heights is called {wanted!r}"
        raise ValueError(f"{what}; its maps of two dimensions are {names}")
    return of_heights[0], [channel.channel_id for channel in of_heights[1:]]


def _holds_heights(channel: Any) -> bool:
    """Whether a channel holds heights, in a unit of length or in none."""
    unit = channel.unit
    return channel.is_height_channel and (unit is None or (isinstance(unit, str) and units.is_length(unit)))
