"""Read and write CF NetCDF files with netCDF4.

The content of a file is a pair: its variables {name: (dimensions, values, attributes)}, and its global attributes
{name: value}. A dataset of xarray is made of such a pair, too (io.datasets).
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

from viscorough import __version__
from viscorough.basics.types import FilePath
from viscorough.io.atomic import atomic_write
from viscorough.io.digest import add_digest, check_digest
from viscorough.io.refusals import Refused, reading

Variables = Mapping[str, tuple[tuple[str, ...], Any, dict[str, Any]]]
Content = tuple[dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]], dict[str, Any]]
# Attributes that netCDF4 compares with stored values; it ignores them if their type is not that of the values.
_MARKS = ("_FillValue", "missing_value", "valid_range", "valid_min", "valid_max")
# Attributes that describe how values are stored. They do not apply to unpacked values.
_STORAGE = (*_MARKS, "scale_factor", "add_offset", "_Unsigned")
# First bytes of NetCDF files: of the classic formats, and of HDF5, which may follow a block of a user.
_CLASSIC, _HDF5, _HDF5_OFFSETS = (b"CDF\x01", b"CDF\x02", b"CDF\x05"), b"\x89HDF\r\n\x1a\n", (0, 512, 1024, 2048)
# Variables of at least this many values are compressed. For smaller variables, the chunks that compression needs take
# more room than compression saves. Level 1 takes half the time of the usual level 4, and makes files a few percent
# larger.
COMPRESSED_FROM = 4096


def global_attributes() -> dict[str, str]:
    """Return the global attributes that every file gets; they do not depend on the time and place of writing."""
    program = f"viscorough {__version__}"
    return {"Conventions": "CF-1.11", "source": program, "history": f"written by {program}"}


@contextmanager
def written_with_digest(path: FilePath) -> Iterator[Path]:
    """Yield a temporary path for a NetCDF file, add a digest to the written file, and move the file to `path`.

    The caller writes the file at the temporary path, with global_attributes. `opened` checks the digest (io.digest)
    when the file is read. Raises the errors of atomic_write.
    """
    with atomic_write(path) as temporary:
        yield temporary
        with netCDF4.Dataset(temporary, "a") as file:
            add_digest(file)


def write(path: FilePath, variables: Variables, attributes: Mapping[str, Any]) -> None:
    """Write variables and global attributes as CF-1.11 NetCDF, atomically; nan is the fill value.

    Every variable needs the attribute `long_name`, and `units` unless it holds text. The file gets global_attributes
    and a digest, and large arrays are compressed. Raises ValueError for a path that cannot be written, OSError if
    writing fails.
    """
    with written_with_digest(path) as temporary, netCDF4.Dataset(temporary, "w") as file:
        file.setncatts({**attributes, **global_attributes()})
        for name, (dimensions, values, about) in variables.items():
            values = np.asarray(values)
            for dimension, size in zip(dimensions, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            kind = str if values.dtype.kind in "UO" else values.dtype
            # The CF conventions forbid missing values in a coordinate, so coordinates get no fill value.
            fill = np.nan if values.dtype.kind == "f" and name not in dimensions else None
            is_large = values.size >= COMPRESSED_FROM
            stored = file.createVariable(name, kind, dimensions, fill_value=fill, zlib=is_large, complevel=1)
            stored.setncatts(about)
            stored[...] = values


def is_netcdf(content: bytes) -> bool:
    """Return True if a file begins like a NetCDF file or another HDF5 file."""
    return content.startswith(_CLASSIC) or any(content.startswith(_HDF5, offset) for offset in _HDF5_OFFSETS)


def is_own(path: FilePath, content: bytes) -> bool:
    """Return True if viscorough wrote a NetCDF file."""
    with opened(path, content, checked=False) as file:
        return str(getattr(file, "source", "")).startswith("viscorough ")


@contextmanager
def opened(path: FilePath, content: bytes | None = None, *, checked: bool = True) -> Iterator[netCDF4.Dataset]:
    """Yield the netCDF4.Dataset of a file. Every fault of the file becomes a one-line ValueError.

    content : content of the file, if it was read before
    checked : True to read the whole file and compare its content with its digest (io.digest)
    """
    with reading(path, "a whole NetCDF file is needed"), netCDF4.Dataset(path, memory=content) as file:
        if checked:
            check_digest(file)
        yield file


def unpacked(variable: netCDF4.Variable) -> NDArray[Any]:
    """Return the values of a variable as netCDF4 unpacks them; missing values are nan.

    Raises ValueError for attributes that netCDF4 would ignore: marks of missing values that have another type than the
    variable, such as a missing value of 1e20 in double precision in a variable of single precision, and scales that
    are no number.
    """
    is_number = variable.dtype is not str and np.dtype(variable.dtype).kind in "iuf"
    for name in sorted(set(variable.ncattrs()) & set(_STORAGE)) if is_number else ():
        value = np.asarray(variable.getncattr(name))
        if name in _MARKS and value.dtype != np.dtype(variable.dtype):
            text = f"of {variable.name} is {value.dtype}, but the variable is {variable.dtype}"
            raise Refused(f"attribute {name} {text}; the same type is needed")
        if name in ("scale_factor", "add_offset") and (value.dtype.kind not in "iuf" or value.size != 1):
            raise Refused(f"attribute {name} of {variable.name} is {value.tolist()!r}; a number is needed")
        if name == "_Unsigned" and str(value).lower() not in ("true", "false"):
            raise Refused(f"attribute _Unsigned of {variable.name} is {str(value)!r}; 'true' or 'false' is needed")
    variable.set_always_mask(False)
    values = variable[...]
    if (
        is_number
        and variable.dtype.itemsize == 1
        and np.ma.is_masked(values)
        and not set(variable.ncattrs()) & {*_MARKS}
    ):
        number = netCDF4.default_fillvals[np.dtype(variable.dtype).str[1:]]
        text = f"bytes of {variable.name} have the value {number}, which may mark missing values"
        raise Refused(f"{text}; the attribute _FillValue is needed")
    if np.ma.isMaskedArray(values):
        values = np.ma.filled(values if values.dtype.kind == "f" else values.astype(float), np.nan)
    return np.asarray(values)


def read(path: FilePath, content: bytes | None = None) -> Content:
    """Read variables and global attributes of a NetCDF file into memory; missing values are nan.

    content : content of the file, if it was read before

    Raises a one-line ValueError if the file is missing or damaged.
    """
    with opened(path, content) as file:
        variables = {}
        for name, variable in file.variables.items():
            attributes = {key: variable.getncattr(key) for key in variable.ncattrs() if key not in _STORAGE}
            variables[name] = variable.dimensions, unpacked(variable), attributes
        return variables, {name: file.getncattr(name) for name in file.ncattrs()}
