"""CF NetCDF files read and written with netCDF4 alone, since xarray (`io.datasets`) takes long to import."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np

from viscorough import __version__
from viscorough.arrays import read_only
from viscorough.io.atomic import atomic_write, reading
from viscorough.io.digest import add_digest, check_digest
from viscorough.io.unpacking import STORAGE, unpacked
from viscorough.summaries import si_unit, unit_power
from viscorough.types import Array, FilePath

# {name of a variable: (long_name, unit)}, the unit being a power of that of length, "time", which is in s in any case,
# "velocity", or an SI unit, such as "N", which is "1" where the unit of length is not known.
Quantities = Mapping[str, tuple[str, int | str]]
COMPRESSED_FROM = 4096  # number of values; for fewer, chunks cost more than compression saves


class Variable(NamedTuple):
    """A variable of a NetCDF file: names of its dimensions, array of values, attributes {name: value}."""

    dimensions: tuple
    values: np.ndarray
    attributes: dict


class Content(NamedTuple):
    """The content of a NetCDF file: variables {name: Variable} and global attributes {name: value}.

    path : of the file that was read, for error messages
    """

    variables: dict[str, Variable]
    attributes: dict[str, Any]
    path: FilePath | None = None

    def with_attributes(self, **attributes: Any) -> "Content":
        """The same variables, with global attributes added or replaced."""
        return self._replace(attributes=self.attributes | attributes)


def described(
    dimensions: tuple[str, ...], values: Mapping[str, Any], quantities: Quantities, length_unit: str
) -> dict[str, Variable]:
    """Variables over the same dimensions, each with the long_name and the unit of the quantity of its name."""
    spelled: dict[int | str, str] = {power: unit_power(length_unit, power) for power in (0, 1, 2)}
    spelled |= {"time": "s", "velocity": "s-1" if length_unit == "1" else f"{length_unit} s-1"}
    variables = {}
    for name, array in values.items():
        long_name, unit = quantities[name]
        attributes = {"long_name": long_name, "units": spelled.get(unit) or si_unit(str(unit), length_unit)}
        variables[name] = Variable(dimensions, array, attributes)
    return variables


def centred_axes(shape: tuple[int, ...], spacings: Mapping[str, float], unit: str) -> dict[str, Variable]:
    """Coordinates of the points of a map or line, by dimension; they count from the centre."""
    axes = {}
    for (name, spacing), points in zip(spacings.items(), shape, strict=True):
        positions = spacing * (np.arange(points) - (points - 1) / 2)
        axes[name] = Variable((name,), positions, {"long_name": f"position along {name}", "units": unit})
    return axes


def padded(rows: Sequence[Array]) -> Array:
    """Rows of numbers as one array, nan beyond the end of those that are shorter than the longest."""
    table = np.full((len(rows), max(map(len, rows))), np.nan)
    for whole, row in zip(table, rows, strict=True):
        whole[: len(row)] = row
    return table


def global_attributes() -> dict[str, str]:
    """The attributes that every file gets; nothing in them depends on when or where it is written."""
    program = f"viscorough {__version__}"
    return {"Conventions": "CF-1.11", "source": program, "history": f"written by {program}"}


def compression(size: int) -> dict[str, Any]:
    """Keyword arguments of netCDF4 that compress a variable of `size` values; none if it is small."""
    return {"zlib": True, "complevel": 4, "shuffle": True} if size >= COMPRESSED_FROM else {}


@contextmanager
def written_with_digest(path: FilePath) -> Iterator[Path]:
    """Context that yields a temporary path for a NetCDF file with global_attributes, which then replaces `path`.

    Adds the digest of its content (io.digest), which `opened` checks. Raises what atomic_write raises.
    """
    with atomic_write(path) as temporary:
        yield temporary
        with netCDF4.Dataset(temporary, "a") as file:
            add_digest(file)


def write(content: Content, path: FilePath) -> None:
    """Write a Content of numbers as CF-1.11 NetCDF, atomically; nan is the fill value.

    Every variable needs the attribute `long_name`, and `units` unless it holds text. Adds global_attributes and a
    digest, and compresses large arrays. Raises ValueError for a path that cannot be written, OSError if writing fails.
    """
    with written_with_digest(path) as temporary, netCDF4.Dataset(temporary, "w") as file:
        file.setncatts(content.attributes | global_attributes())
        for name, (dimensions, values, attributes) in content.variables.items():
            values = np.asarray(values)
            for dimension, size in zip(dimensions, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            kind = str if values.dtype.kind in "UO" else values.dtype
            # CF: no coordinate may be missing.
            fill = np.nan if values.dtype.kind == "f" and name not in dimensions else None
            stored = file.createVariable(name, kind, dimensions, fill_value=fill, **compression(values.size))
            stored.setncatts(attributes)
            stored[...] = values


@contextmanager
def opened(path: FilePath, *, checked: bool = True) -> Iterator[netCDF4.Dataset]:
    """Context that yields the netCDF4.Dataset of a file; any fault of the file becomes a one-line ValueError.

    checked : whether to read the whole file and refuse it if its content does not have the digest in it (io.digest)
    """
    with reading(path, "a whole NetCDF file is needed"), netCDF4.Dataset(path) as file:
        if checked:
            check_digest(file)
        yield file


def read(path: FilePath) -> Content:
    """Read a NetCDF file into memory as a Content; missing values are nan.

    Raises a one-line ValueError if the file is missing or damaged.
    """
    with opened(path) as file:
        variables = {}
        for name, variable in file.variables.items():
            # Not those of its storage, which reading undoes.
            attributes = {key: variable.getncattr(key) for key in variable.ncattrs() if key not in STORAGE}
            variables[name] = Variable(variable.dimensions, read_only(unpacked(variable)), attributes)
        return Content(variables, {name: file.getncattr(name) for name in file.ncattrs()}, path)
