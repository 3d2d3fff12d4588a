"""Read and write CF NetCDF files with netCDF4. `io.datasets` converts their content to datasets of xarray."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np
from numpy.typing import NDArray

from viscorough import __version__
from viscorough.basics.summaries import si_unit, unit_power
from viscorough.basics.types import Array, FilePath
from viscorough.io.atomic import Refused, atomic_write, reading
from viscorough.io.digest import add_digest, check_digest

# {name of a variable: (long_name, unit)}. The unit is a number n (the unit of length to the power n), "time" (always in
# s), "velocity" (length per s), or an SI unit such as "N". If the unit of length is not known, SI units become "1".
Quantities = Mapping[str, tuple[str, int | str]]
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


class Variable(NamedTuple):
    """Variable of a NetCDF file: names of its dimensions, array of values, attributes {name: value}."""

    dimensions: tuple
    values: np.ndarray
    attributes: dict


class Content(NamedTuple):
    """Content of a NetCDF file: variables {name: Variable} and global attributes {name: value}.

    path : path of the file from which the Content was read, for error messages; None if it was not read from a file
    """

    variables: dict[str, Variable]
    attributes: dict[str, Any]
    path: FilePath | None = None

    def with_attributes(self, **attributes: Any) -> "Content":
        """Return the content with global attributes added or replaced."""
        return self._replace(attributes=self.attributes | attributes)


def described(
    dimensions: tuple[str, ...], values: Mapping[str, Any], quantities: Quantities, length_unit: str
) -> dict[str, Variable]:
    """Return {name: Variable}: arrays with their dimensions, long names and units.

    dimensions : names of the dimensions of all arrays
    values : {name: array}
    quantities : {name: (long_name, unit)}, see `Quantities`
    length_unit : unit of length; "1" if it is not known
    """
    spelled: dict[int | str, str] = {power: unit_power(length_unit, power) for power in (0, 1, 2)}
    spelled |= {"time": "s", "velocity": "s-1" if length_unit == "1" else f"{length_unit} s-1"}
    variables = {}
    for name, array in values.items():
        long_name, unit = quantities[name]
        attributes = {"long_name": long_name, "units": spelled.get(unit) or si_unit(str(unit), length_unit)}
        variables[name] = Variable(dimensions, array, attributes)
    return variables


def axes_of(
    shape: tuple[int, ...],
    spacings: Mapping[str, float],
    unit: str,
    stated: Mapping[str, Array | None] | None = None,
) -> dict[str, Variable]:
    """Return the coordinates of the points of a map or line, {dimension: Variable}.

    spacings : {dimension: distance between neighbouring points}, in the order of `shape`
    stated : {dimension: coordinates}, if they are known; other coordinates rise, and are 0 at the centre
    unit : unit of the spacings and coordinates
    """
    axes = {}
    for (name, spacing), points in zip(spacings.items(), shape, strict=True):
        positions = (stated or {}).get(name)
        if positions is None:
            positions = spacing * (np.arange(points) - (points - 1) / 2)
        axes[name] = Variable((name,), positions, {"long_name": f"position along {name}", "units": unit})
    return axes


def padded(rows: Sequence[Array]) -> Array:
    """Combine rows of numbers into one array, with nan beyond the ends of shorter rows."""
    table = np.full((len(rows), max(map(len, rows))), np.nan)
    for whole, row in zip(table, rows, strict=True):
        whole[: len(row)] = row
    return table


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


def write(content: Content, path: FilePath) -> None:
    """Write a Content as CF-1.11 NetCDF, atomically; nan is the fill value.

    Every variable needs the attribute `long_name`, and `units` unless it holds text. The file gets global_attributes
    and a digest, and large arrays are compressed. Raises ValueError for a path that cannot be written, OSError if
    writing fails.
    """
    with written_with_digest(path) as temporary, netCDF4.Dataset(temporary, "w") as file:
        file.setncatts(content.attributes | global_attributes())
        for name, (dimensions, values, attributes) in content.variables.items():
            values = np.asarray(values)
            for dimension, size in zip(dimensions, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            kind = str if values.dtype.kind in "UO" else values.dtype
            # The CF conventions forbid missing values in a coordinate, so coordinates get no fill value.
            fill = np.nan if values.dtype.kind == "f" and name not in dimensions else None
            is_large = values.size >= COMPRESSED_FROM
            stored = file.createVariable(name, kind, dimensions, fill_value=fill, zlib=is_large, complevel=1)
            stored.setncatts(attributes)
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
    """Read a NetCDF file into memory as a Content; missing values are nan.

    content : content of the file, if it was read before

    Raises a one-line ValueError if the file is missing or damaged.
    """
    with opened(path, content) as file:
        variables = {}
        for name, variable in file.variables.items():
            attributes = {key: variable.getncattr(key) for key in variable.ncattrs() if key not in _STORAGE}
            variables[name] = Variable(variable.dimensions, unpacked(variable), attributes)
        return Content(variables, {name: file.getncattr(name) for name in file.ncattrs()}, path)
