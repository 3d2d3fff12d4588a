"""Compute and check digests of the content of NetCDF files, so that a damaged file is refused when it is read.

The HDF5 library, which stores NetCDF files, adds checksums of the structure of a file, but not of the numbers. The
digest of a file covers groups, dimensions, variables and attributes, with their names, types and stored values.
"""

import hashlib
import json
from collections.abc import Iterator
from typing import Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

# Name of the global attribute that holds the digest. The digest covers everything else in the file.
ATTRIBUTE = "content_sha256"
# At most this many values are read at a time, 32 MiB in double precision. Large maps are thus not copied as a whole.
_VALUES_AT_A_TIME = 2**22


def add_digest(file: netCDF4.Dataset) -> None:
    """Add the digest, as the attribute `ATTRIBUTE`, to an open file that is otherwise complete.

    A note about the digest is added to the attribute `history`. check_digest refuses a file that has the note but has
    lost its digest.
    """
    file.setncattr("history", f"{file.getncattr('history')}, with {ATTRIBUTE}")
    file.setncattr(ATTRIBUTE, content_digest(file))


def check_digest(file: netCDF4.Dataset) -> None:
    """Raise ValueError if the content of an open file does not match its digest.

    Files of other programs, and of versions of viscorough without digests, have no digest and are not checked.
    """
    names = file.ncattrs()
    if ATTRIBUTE in names:
        if file.getncattr(ATTRIBUTE) != content_digest(file):
            raise ValueError(
                f"its content does not match its attribute {ATTRIBUTE}: it is damaged, or another program changed it, "
                "which must then remove this attribute and history"
            )
    elif "history" in names and ATTRIBUTE in str(file.getncattr("history")):
        raise ValueError(
            f"it has lost its attribute {ATTRIBUTE}: it is damaged, or another program removed it, which must then "
            "remove history, too"
        )


def content_digest(file: netCDF4.Dataset) -> str:
    """Return the SHA-256 of the content of an open file without `ATTRIBUTE`, as 64 hexadecimal digits.

    The digest depends neither on the order of names in the file nor on the byte order of the machine. SHA-256 is
    computed from the following input, for each group, sorted by path:

    - a line of JSON with path, dimensions and attributes of the group,
    - for each variable of the group, sorted by name: a line of JSON with its name, type, dimensions, shape and
      attributes, followed by its stored values as little-endian numbers, or as one line of JSON for each text.
    """
    digest = hashlib.sha256()

    def add_line(*content: Any) -> None:
        digest.update(json.dumps(content).encode() + b"\n")

    for group in sorted(_groups(file), key=lambda group: group.path):
        sizes = {name: dimension.size for name, dimension in group.dimensions.items()}
        add_line("group", group.path, sorted(sizes.items()), _attributes(group))
        for name, variable in sorted(group.variables.items()):
            kind = _little_endian(np.dtype(variable.dtype))
            text = kind.kind == "U"
            add_line(name, "text" if text else kind.str, variable.dimensions, variable.shape, _attributes(variable))
            for values in _parts(variable):
                if text:
                    for value in values.flat:
                        add_line(value)
                else:
                    digest.update(np.ascontiguousarray(values, dtype=kind).data)
    return digest.hexdigest()


def _groups(group: netCDF4.Dataset) -> Iterator[netCDF4.Dataset]:
    yield group
    for member in group.groups.values():
        yield from _groups(member)


def _attributes(owner: netCDF4.Dataset | netCDF4.Variable) -> list[Any]:
    """Return [name, type, shape, value] for each attribute of a group or variable, except for the digest.

    The value is a text or a list of texts. Numbers are given as the hexadecimal digits of their bytes.
    """
    listed: list[Any] = []
    for name in sorted(set(owner.ncattrs()) - {ATTRIBUTE}):
        value = np.asarray(owner.getncattr(name))
        kind = _little_endian(value.dtype)
        text = kind.kind == "U"
        data = value.tolist() if text else value.astype(kind).tobytes().hex()
        listed.append([name, "text" if text else kind.str, value.shape, data])
    return listed


def _parts(variable: netCDF4.Variable) -> Iterator[NDArray[Any]]:
    """Yield the stored values of a variable, some rows at a time: at most _VALUES_AT_A_TIME values, or a single row."""
    variable.set_auto_maskandscale(False)
    rows = variable.shape[0] if variable.ndim else 1
    step = max(1, _VALUES_AT_A_TIME * rows // max(1, variable.size))
    for first in range(0, rows, step):
        yield np.asarray(variable[first : first + step] if step < rows else variable[...])
    variable.set_auto_maskandscale(True)


def _little_endian(kind: np.dtype[Any]) -> np.dtype[Any]:
    return kind.newbyteorder("<")
