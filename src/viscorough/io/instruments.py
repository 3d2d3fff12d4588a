"""Read maps of heights from files of instruments, with the package SurfaceTopography if it is installed."""

import io
import re
import struct
import warnings
import zipfile
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from viscorough.basics import units
from viscorough.basics.argument_names import argument, spelled
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, FilePath
from viscorough.io.atomic import reading
from viscorough.io.scan import Scan

# In these formats of plain arrays the first index runs along y. In all other formats that SurfaceTopography reads, the
# first index of its arrays runs along x.
_ARRAY_FORMATS = ("npy", "npz", "mat", "h5")
# Numbers of at least this magnitude, such as -1.8e308, mark missing points. No height in any unit is as large.
_LARGEST_HEIGHT = 1e30
# A field that an instrument measures has sides between these lengths [m]. Other lengths suggest a wrong unit.
_LEAST_SIDE, _LARGEST_SIDE = 1e-8, 1.0
# Several formats use each of these suffixes. The error that the reader of one format raises may thus be misleading.
_SHARED_SUFFIXES = ("asc", "csv", "dat", "txt", "xyz", "zip")
_NANOMETRES_PER_MILLIMETRE = 1e6
# Messages list at most this many channels.
_MOST_NAMES = 5
# First bytes of SDF files (ISO 25178-71) in text; the dialect BCR differs from ISO only in this name.
_SDF_TEXT = (b"aISO-1.0", b"aBCR-1.0")
# Objects in files of Digital Surf: {code: name}.
_PROFILE, _SURFACE = 1, 2
_OBJECTS = {
    _PROFILE: "a profile",
    3: "a binary image",
    4: "a series of profiles",
    5: "a series of surfaces",
    7: "a profile of several layers",
    8: "a surface of several layers",
    10: "an intensity image",
    11: "an intensity surface",
    12: "a picture in colours",
    13: "a picture in colours on a surface",
    14: "a force curve",
    15: "a series of force curves",
    20: "a spectrum",
    22: "a map of spectra",
}


def read_instrument(path: FilePath, channel: str | None = None, *, profile: bool = False) -> Scan:
    """Read heights, spacing and units, as a Scan, from a file in a format that SurfaceTopography recognizes.

    An AccuracyWarning is given if other channels hold heights as well, if the surface is periodic, and if the field is
    larger than 1 m or smaller than 10 nm.

    channel : name or number of the channel, from 0; by default the first channel with heights. It is needed if a file
        of plain arrays, such as a MATLAB or HDF5 file, holds several arrays
    profile : True for a Digital Surf file of a profile, whose heights form a single row

    Raises a one-line ValueError for unknown formats, line scans and channels without heights.
    """
    # Ignore warnings of SurfaceTopography about optional packages and the layout of files: users cannot act on them.
    with (
        reading(path, "a file of heights is needed"),
        warnings.catch_warnings(action="ignore"),
        _opened(path, profile=profile) as file,
    ):
        if file.format() == "gwy" and not file.channels:
            return _gwyddion_scan(path, file, channel)
        chosen, others = _choose(file, channel)
        # SurfaceTopography needs the lengths of the sides of a map. If the file does not state them, the numbers of
        # points are passed as dummies, and no spacing is returned.
        size = {"physical_sizes": chosen.nb_grid_pts} if chosen.physical_sizes is None else {}
        topography = chosen.topography(**size)
        heights = np.ma.filled(np.ma.asarray(topography.heights()).astype(float), np.nan)
        # In an HDF5 file that MATLAB wrote, the arrays are transposed.
        kind = file.format()
        if kind not in _ARRAY_FORMATS or (kind == "h5" and Path(path).suffix.lower() == ".mat"):
            heights = heights.T
        heights[np.abs(heights) >= _LARGEST_HEIGHT] = np.nan
        unit, spacing = chosen.unit or units.UNKNOWN, chosen.pixel_size
        if kind == "nms":
            spacing = _nms_spacing(spacing, unit, heights.shape)
    if others:
        way = f"{argument('channel')} chooses another of {', '.join(map(repr, others))}"
        warnings.warn(f"{path}: the channel {chosen.channel_id!r} is read; {way}", AccuracyWarning, stacklevel=2)
    if chosen.is_periodic:
        text = "states that it is one period of a periodic surface; it is treated as a body with edges"
        warnings.warn(f"{path}: {text}", AccuracyWarning, stacklevel=2)
    if spacing is not None and unit != units.UNKNOWN:
        _check_field(path, spacing, unit, heights.shape)
    return Scan(heights, unit, spacing, unit)


def refuse_raster() -> NoReturn:
    """Raise ValueError for a georeferenced raster, such as GeoTIFF, with the way to convert it."""
    text = "a georeferenced raster is not read; an ESRI ASCII grid in projected coordinates is needed"
    raise ValueError(f"{text}, as 'gdal_translate -of AAIGrid FILE NEW.asc' writes")


def is_sdf_text(path: FilePath) -> bool:
    """Return True if a file is an SDF file in text, which SurfaceTopography reads."""
    with reading(path, "a file of heights is needed"), open(path, "rb") as file:
        return file.read(8) in _SDF_TEXT


def holds_instrument_line(path: FilePath) -> bool:
    """Return True if a file of an instrument holds a profile and no map; only Digital Surf's files of profiles do."""
    with reading(path, "a file of heights is needed"), open(path, "rb") as file:
        start = file.read(20)
    return start.startswith(b"DIGITAL SURF") and struct.unpack_from("<H", start, 18)[0] == _PROFILE


def read_instrument_line(path: FilePath) -> Scan:
    """Read heights along a line, spacing and units from a Digital Surf file of a profile, as a Scan.

    Raises a one-line ValueError for other files, and for a profile with missing heights.
    """
    if not holds_instrument_line(path):
        raise ValueError("unknown kind of file; a line is read from .npy, .nc, text, and Digital Surf's .pro files")
    scan = read_instrument(path, profile=True)
    heights = scan.heights[0]
    if missing := np.count_nonzero(np.isnan(heights)):
        raise ValueError(f"{missing} of {heights.size} heights are missing; every point of a line needs a height")
    return scan._replace(heights=heights, spacing=None if scan.spacing is None else (scan.spacing[0],) * 2)


def _check_digital_surf(path: FilePath, *, profile: bool) -> None:
    """Raise ValueError for a Digital Surf file of other objects than one surface, or one profile if `profile` is True.

    The header states the number of objects and the kind of the first object at the bytes 14 and 18.
    """
    content = Path(path).read_bytes()
    if not content.startswith(b"DIGITAL SURF") or len(content) < 512:
        return
    count, kind = struct.unpack_from("<H", content, 14)[0], struct.unpack_from("<H", content, 18)[0]
    count = max(count, content.count(b"DIGITAL SURF\0"))
    name = _OBJECTS.get(kind, f"an object of kind {kind}")
    if kind == _PROFILE and count == 1 and not profile:
        raise ValueError(f"it holds a profile; {spelled('viscorough reduce', 'read_line')} reads it")
    if count > 1 or kind != (_PROFILE if profile else _SURFACE):
        several = f"{count} objects" + (f", {name}" if kind != _SURFACE else ", surfaces") if count > 1 else name
        raise ValueError(f"it holds {several}; one surface is needed, so export one of them alone")


def _opened(path: FilePath, *, profile: bool) -> Any:
    """Return a SurfaceTopography reader for a file, whose format is found from its content or from its suffix.

    Raises ValueError for an unknown format. If the content indicates no format, the reader for the suffix raises an
    error that states the fault.
    """
    try:
        from SurfaceTopography.IO import CannotDetectFileFormat, open_topography, readers
    except ImportError as error:
        text = "unknown kind of file; .npy, .nc, text and TIFF are read directly, formats of instruments with"
        raise ValueError(f'{text} pip install "viscorough[formats]"') from error
    if not Path(path).stat().st_size:
        raise ValueError("it is empty")
    with open(path, "rb") as file:
        if file.read(12) == b"DSCOMPRESSED":
            raise ValueError("compressed Digital Surf files are not read; save it without compression")
    _check_digital_surf(path, profile=profile)
    source, suffix = _in_known_dialect(path), Path(path).suffix.lower().lstrip(".")
    kinds = [reader.format() for reader in readers if suffix in reader.file_extensions()]
    try:
        file = open_topography(source)
    except CannotDetectFileFormat as error:
        if not kinds or suffix in _SHARED_SUFFIXES:
            raise ValueError("no known format") from error
        return open_topography(source, format=kinds[0])
    # SurfaceTopography takes every file of a suitable size for this format.
    if file.format() == "hgt":
        raise ValueError("no known format")
    if file.format() in kinds or _maps(file) or not kinds:
        return file
    # The format found from the content does not suit the suffix and gives no map, so the format of the suffix is used.
    file.close()
    return open_topography(source, format=kinds[0])


def _in_known_dialect(path: FilePath) -> Any:
    """Return the path as text, or the content of a file whose dialect SurfaceTopography does not know, in another one.

    Some x3p files spell their revision with a dash; SurfaceTopography needs the spelling "ISO5436 - 2000". SDF files of
    the dialect BCR have the layout of ISO.
    """
    content = Path(path).read_bytes()
    if content[1:8] == b"BCR-1.0" and content[:1] in b"ab":
        return io.BytesIO(content[:1] + b"ISO-1.0" + content[8:])
    if Path(path).suffix.lower() != ".x3p" or not zipfile.is_zipfile(path):
        return str(path)
    revised = io.BytesIO()
    with zipfile.ZipFile(path) as archive, zipfile.ZipFile(revised, "w") as copy:
        for name in archive.namelist():
            member = archive.read(name)
            if name == "main.xml":
                member = re.sub(rb"ISO\s?5436[^<\w]+2000", b"ISO5436 - 2000", member)
            copy.writestr(name, member)
    revised.seek(0)
    return revised


def _maps(file: Any) -> list[Any]:
    """Return the channels of a file that are maps. Plain arrays with a single row or column do not count as maps."""
    maps = [channel for channel in file.channels if channel.dim == 2]
    return [each for each in maps if file.format() not in _ARRAY_FORMATS or min(each.nb_grid_pts) > 1]


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
        raise ValueError("it holds no map of two dimensions")
    if not with_heights:
        text = "no map of heights" if name is None else f"no map of heights is called {name!r}"
        raise ValueError(f"{text}; its maps of two dimensions are {names}")
    if len(with_heights) > 1 and file.format() in _ARRAY_FORMATS:
        raise ValueError(f"it holds several arrays, {names}; {argument('channel')} chooses one")
    return with_heights[0], [channel.channel_id for channel in with_heights[1:]]


def _holds_heights(channel: Any) -> bool:
    """Return True if a channel holds heights, in a unit of length or without a unit."""
    unit = channel.unit
    return channel.is_height_channel and (unit is None or (isinstance(unit, str) and units.is_length(unit)))


def _nms_spacing(spacing: tuple[float, float], unit: str, shape: tuple[int, ...]) -> tuple[float, float]:
    """Return the spacing of a NanoFocus file. The header states the spacing in nanometres or in millimetres.

    SurfaceTopography assumes millimetres. Fields of confocal microscopes are far smaller than 1 m. If the assumption
    gives a field above 1 m, the spacing must be in nanometres.
    """
    if max(np.multiply(spacing, shape[::-1])) * units.metres(unit) <= _LARGEST_SIDE:
        return spacing
    dx, dy = spacing
    return dx / _NANOMETRES_PER_MILLIMETRE, dy / _NANOMETRES_PER_MILLIMETRE


def _check_field(path: FilePath, spacing: tuple[float, float], unit: str, shape: tuple[int, ...]) -> None:
    """Give an AccuracyWarning for a field whose size is unlikely for an instrument."""
    sides = np.multiply(spacing, shape[::-1]) * units.metres(unit)
    if sides.max() > _LARGEST_SIDE or sides.min() < _LEAST_SIDE:
        text = f"the field is {sides[0]:.3g} m by {sides[1]:.3g} m; fields of instruments are 10 nm to 1 m wide"
        warnings.warn(f"{path}: {text}: check the unit of the spacing", AccuracyWarning, stacklevel=3)


# ---- Gwyddion fields in which heights or lateral lengths have no unit; SurfaceTopography ignores such fields


def _gwyddion_scan(path: FilePath, file: Any, name: str | None) -> Scan:
    """Return heights and spacing, as a Scan, of a Gwyddion field in which heights or lateral lengths have no unit.

    If the lateral lengths have no unit, the Scan has no spacing.

    file : reader of SurfaceTopography for the file at `path`
    name : name or number of the field; needed if the file holds several fields
    """
    content = file._metadata
    numbers = [match[1] for match in map(re.compile(r"/(\d+)/data").fullmatch, content) if match]
    names = {number: content.get(f"/{number}/data/title", number) for number in numbers}
    maps = {number: content[f"/{number}/data"]["GwyDataField"] for number in numbers}
    units_of = {number: tuple(_gwyddion_unit(maps[number], axes) for axes in ("z", "xy")) for number in numbers}
    fields = [each for each in numbers if units_of[each][0] == units.UNKNOWN or units.is_length(units_of[each][0])]
    chosen = [each for each in fields if name in (None, each, names[each])]
    if not fields:
        raise ValueError("it holds no map of heights")
    if len(chosen) != 1:
        raise ValueError(
            f"its maps are {', '.join(repr(names[each]) for each in fields)}; {argument('channel')} chooses one"
        )
    field, (unit, lateral) = maps[chosen[0]], units_of[chosen[0]]
    heights = _gwyddion_numbers(path, field)
    if mask := content.get(f"/{chosen[0]}/mask"):
        heights[_gwyddion_numbers(path, mask["GwyDataField"]) > 0.5] = np.nan
    if not units.is_length(lateral):
        return Scan(heights, unit)
    return Scan(heights, unit, (abs(field["xreal"]) / field["xres"], abs(field["yreal"]) / field["yres"]), lateral)


def _gwyddion_unit(field: dict[str, Any], axes: str) -> str:
    """Return the unit of heights (axes "z") or lateral lengths (axes "xy") of a Gwyddion field; "1" if not stated."""
    return field.get(f"si_unit_{axes}", {}).get("GwySIUnit", {}).get("unitstr", "").strip() or units.UNKNOWN


def _gwyddion_numbers(path: FilePath, field: dict[str, Any]) -> Array:
    """Read the numbers of a Gwyddion field as an array of shape (rows, columns).

    At the offset of the field, the file holds 4 bytes with the count of the numbers, and then the numbers in double
    precision.
    """
    shape = field["yres"], field["xres"]
    return np.fromfile(path, "<f8", shape[0] * shape[1], offset=field["data"]["offset"] + 4).reshape(shape)
