"""The requirements of the CF conventions that files of this project can break.

The checkers that exist need UDUNITS, a compiled library, and the table of standard names from the network. These files
use neither standard names nor calendars, so that what can be wrong with them is a page of rules.
"""

import re

import netCDF4
import numpy as np

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
# Units of UDUNITS in these files, with integer powers, separated by spaces; files may hold any unit of length.
UNIT = re.compile(r"(1|m|mm|um|nm|s|N|Pa|byte|Mbyte|element|decade)(-?\d)?( (m|s|N|Pa)(-?\d)?)*")
NUMBERS = set("bhilqBHILQfd")  # the types of CF-1.11 besides characters and strings


def violations(path):
    """One line for every requirement that a file does not meet."""
    with netCDF4.Dataset(path) as file:
        lines = _file_violations(file)
        for group in (file, *file.groups.values()):
            lines += _name_violations(group)
            for name, variable in group.variables.items():
                lines += [f"{name}: {line}" for line in _variable_violations(name, variable, group)]
    return lines


def _file_violations(file):
    lines = [f"no {name}" for name in ("title", "source", "history") if not getattr(file, name, "")]
    if getattr(file, "Conventions", "") != "CF-1.11":
        lines.append("Conventions is not CF-1.11")
    return lines


def _name_violations(file):
    names = [*file.dimensions, *file.variables]
    lines = [f"name {name}" for name in [*names, *file.ncattrs()] if not NAME.fullmatch(name)]
    if len({name.lower() for name in file.variables}) < len(file.variables):
        lines.append("names of variables differ only in case")
    return lines


def _variable_violations(name, variable, file):
    text = variable.dtype is str
    attributes = {key: variable.getncattr(key) for key in variable.ncattrs()}
    if not text and variable.dtype.char not in NUMBERS:
        yield f"type {variable.dtype}"
    if len(set(variable.dimensions)) < len(variable.dimensions):
        yield "a dimension twice"
    if not attributes.get("long_name"):
        yield "no long_name"
    if not text and not UNIT.fullmatch(str(attributes.get("units", ""))):
        yield f"units {attributes.get('units')!r}"
    for key in ("_FillValue", "missing_value", "valid_min", "valid_max", "valid_range", "actual_range"):
        if key in attributes and np.asarray(attributes[key]).dtype != variable.dtype:
            yield f"{key} of another type"
    for other in str(attributes.get("coordinates", "")).split():
        if other not in file.variables:
            yield f"coordinate {other} is missing"
        elif not set(file[other].dimensions) <= set(variable.dimensions):
            yield f"coordinate {other} has other dimensions"
    if np.size(attributes.get("flag_values", [])) != len(str(attributes.get("flag_meanings", "")).split()):
        yield "flag_values without flag_meanings"
    if name in file.dimensions:
        yield from _coordinate_violations(name, variable, attributes, text)


def _coordinate_violations(name, variable, attributes, text):
    """A variable with the name of a dimension: one-dimensional, complete, numeric and monotonic."""
    if variable.dimensions != (name,):
        yield "a coordinate of other dimensions"
        return
    if "_FillValue" in attributes:
        yield "a coordinate with a fill value"
    values = np.asarray(variable[...])
    if text:
        yield "a coordinate of text"
    elif not np.isfinite(values).all() or not (np.all(np.diff(values) > 0) or np.all(np.diff(values) < 0)):
        yield "a coordinate that is not monotonic"
