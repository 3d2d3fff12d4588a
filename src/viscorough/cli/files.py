"""Read the input files of the commands, and write their output files."""

from __future__ import annotations

import os
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import viscorough
from viscorough.basics import units
from viscorough.basics.summaries import LENGTH_POWERS
from viscorough.basics.units import Quantity
from viscorough.cli import messages

if TYPE_CHECKING:
    from viscorough.io.netcdf import Content, Variables


def check_output(output: Path, **inputs: Path | None) -> None:
    """Raise ValueError unless the output can be written and would replace no input file.

    inputs : input files; None is ignored. The keyword of a file describes its content in the message, for example
        force_history
    """
    from viscorough.io import atomic

    atomic.check_output(output)
    for kind, file in inputs.items():
        if file and output.exists() and file.exists() and output.samefile(file):
            raise ValueError(f"{output}: would replace the {kind.replace('_', ' ')}; another name is needed")


def printable_name(file: Path) -> str:
    """Return the name of a file as text; bytes of the name that are no valid text are written with backslashes."""
    return file.name.encode(errors="backslashreplace").decode()


LONGEST = 60  # longest time allowed for opening a file, in seconds


def check_opens(path: Path, content: bytes | None = None) -> None:
    """Raise a one-line ValueError unless the NetCDF file can be opened.

    content : content of the file, if it was read before

    A damaged file can make the HDF5 library run without end, and Python cannot interrupt the library. Opening normally
    takes milliseconds. If it takes more than LONGEST seconds, the process writes one line and ends with exit code 2.
    """
    from viscorough.io import netcdf

    def end() -> None:
        text = f"{path}: not opened within {LONGEST:g} s, as can happen if it is damaged; a whole NetCDF file is needed"
        messages.complain(command, text)
        os._exit(2)

    command = click.get_current_context().command_path
    timer = threading.Timer(LONGEST, end)
    timer.daemon = True
    timer.start()
    try:
        with netcdf.opened(path, content, checked=False):
            pass
    finally:
        timer.cancel()


def read_curve(path: Path) -> tuple[viscorough.LoadingCurve, str]:
    """Return the loading curve in a file, and the unit of its lengths in the file.

    Raises ValueError for a file without a loading curve, and for the curve of a compressible half-space: the kinetics
    of a viscous half-space follow only from the elastic curve of an incompressible half-space.
    """
    from viscorough.io import netcdf
    from viscorough.io.curves import curve_from_content, length_unit_of
    from viscorough.io.refusals import path_named

    check_opens(path)
    content = netcdf.read(path)
    if (ratio := content[1].get("poisson_ratio", 0.5)) != 0.5:
        text = f"{path}: the curve is that of a half-space with Poisson ratio {ratio}"
        raise ValueError(f"{text}; kinetics need one of an incompressible half-space, 0.5")
    with path_named(path):
        return curve_from_content(content), length_unit_of(content)


def load_from_options(
    force: Quantity | None,
    force_history: Path | None,
    length_unit: str,
    depth_history: Path | None = None,
    columns: dict[str, int] | None = None,
) -> tuple[Any, dict[str, Any]]:
    """Return (load, attributes for the output file) from --force, --force-history or --depth-history.

    length_unit : unit of length of the surface
    columns : {quantity: number of its column in the history}

    A history replaces the force. The load is a number for --force, and a Load for a history.
    """
    for kind, history in (("force", force_history), ("depth", depth_history)):
        if history is not None:
            load = viscorough.read_load(history, kind, length_unit, columns)
            return load, {kind: printable_name(history)}
    assert force is not None  # one of the three options is given
    number = units.in_si(force, "N", length_unit, "--force")
    return number, {"force": number}


def read_half_space(viscosity: Quantity | None, medium: Path | None, length_unit: str) -> tuple[Any, dict[str, Any]]:
    """Return (viscosity or Medium, attributes for the output file) from --viscosity or --medium.

    A medium replaces the viscosity.
    """
    if medium is not None:
        half_space = viscorough.read_medium(medium, length_unit)
        text = medium.read_bytes().decode("utf-8-sig", errors="replace").strip()
        return half_space, {"medium": printable_name(medium), "medium_text": text}
    assert viscosity is not None  # one of the two options is given
    number = units.in_si(viscosity, "Pa s", length_unit, "--viscosity")
    return number, {"viscosity": number}


def write_output(content: Content, output: Path, unit: str, /, **attributes: Any) -> None:
    """Write variables and attributes as a table if the name ends in .csv, otherwise as a NetCDF file.

    unit : unit of the lengths in the file, which is the unit of the user's surface

    The attribute `warnings` of the file holds the warnings that the command has given so far.
    """
    from viscorough.io.saving import write_content

    if texts := messages.warning_texts(click.get_current_context().obj):
        attributes["warnings"] = "; ".join(texts)
    variables, about = content
    write_content((with_lengths_in(variables, unit), about | attributes), output)


def with_lengths_in(variables: Variables, length_unit: str) -> dict[str, Any]:
    """Return variables in SI units with their lengths in another unit of length."""
    if length_unit in ("m", units.UNKNOWN):
        return dict(variables)
    converted = {}
    for name, (dimensions, values, about) in variables.items():
        unit = about.get("units")
        if unit in LENGTH_POWERS:
            values = in_unit(values, length_unit, LENGTH_POWERS[unit])
            about = about | {"units": units.with_length(unit, length_unit)}
        converted[name] = dimensions, values, about
    return converted


def in_unit(metres: Any, length_unit: str, power: int = 1) -> Any:
    """Convert lengths, or powers of lengths, from metres to another unit; keep them if the unit is not known.

    Numbers are rounded to 15 digits, so that a depth that the user has given in this unit is found again exactly. Maps
    are not rounded.
    """
    if length_unit in ("m", units.UNKNOWN):
        return metres
    import numpy as np

    values = np.asarray(metres) / units.metres(length_unit) ** power
    if values.ndim < 2:
        values = np.array([float(f"{value:.15g}") for value in values.flat]).reshape(values.shape)
    return values if values.ndim else float(values)
