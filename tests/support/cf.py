"""The requirements of the CF conventions that files of this project can break.

The checkers that exist need UDUNITS, a compiled library, and the table of standard names from the network. These files
use neither standard names nor calendars, so a page of rules covers all that can be wrong.
"""

import re

import netCDF4
import numpy as np

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
# Units of UDUNITS in these files, with integer powers, separated by spaces; files may hold any unit of length.
UNIT = re.compile(r"(1|m|mm|um|nm|s|N|N/m|Pa|MPa|byte|Mbyte|element|decade)(-?\d)?( (m|s|N|Pa)(-?\d)?)*")


def violations(path):
    """Return one line for every requirement that a file does not meet."""
    with netCDF4.Dataset(path) as file:
        lines = [f"no {name}" for name in ("title", "source", "history") if not getattr(file, name, "")]
        if getattr(file, "Conventions", "") != "CF-1.11":
            lines.append("Conventions is not CF-1.11")
        for group in (file, *file.groups.values()):
            names = (*group.dimensions, *group.variables, *group.ncattrs())
            lines += [f"name {name}" for name in names if not NAME.fullmatch(name)]
            for variable in group.variables.values():
                lines += [f"{variable.name}: {line}" for line in _variable_violations(variable, group)]
    return lines


def _variable_violations(variable, group):
    attributes, is_text = {key: variable.getncattr(key) for key in variable.ncattrs()}, variable.dtype is str
    if not attributes.get("long_name"):
        yield "no long_name"
    if not is_text and not UNIT.fullmatch(str(attributes.get("units", ""))):
        yield f"units {attributes.get('units')!r}"
    if missing := set(str(attributes.get("coordinates", "")).split()) - set(group.variables):
        yield f"coordinates {missing} are missing"
    if np.size(attributes.get("flag_values", [])) != len(str(attributes.get("flag_meanings", "")).split()):
        yield "flag_values without flag_meanings"
    if variable.name in group.dimensions:
        steps = [] if is_text else np.diff(variable[...])
        if is_text or "_FillValue" in attributes or not (np.all(steps > 0) or np.all(steps < 0)):
            yield "a coordinate that is no complete, monotonic sequence of numbers"
