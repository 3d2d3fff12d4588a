"""Define the options of all commands that read a map of heights: spacing, unit, channel and preparation."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import viscorough
from viscorough.basics import units
from viscorough.basics.units import Quantity
from viscorough.cli import files, options

if TYPE_CHECKING:
    from viscorough.io.scan import Scan

# Options that state how to read a file.
_READING = ("spacing", "unit", "channel")
# Options that change the heights.
_PREPARATION = ("scale", "nodata", "crop", "flip", "detrend", "fill")


@dataclass(frozen=True)
class HeightsFile:
    """File of heights, with the options that the user gave for reading and preparing it.

    options : {name of an option: its text, or True for a flag}
    arguments : the options as arguments of viscorough.read_heights
    """

    path: Path
    options: dict[str, Any]
    arguments: dict[str, Any]

    def read(self, output: Path, **inputs: Path | None) -> tuple[viscorough.Indenter, str]:
        """Check that the output can be written, then read and prepare the heights.

        Returns the indenter in metres, and the unit of the user's heights. Raises ValueError for an output that cannot
        be written, and for invalid heights.

        inputs : other input files of the command, which the output must not replace; see files.check_output
        """
        files.check_output(output, heights=self.path, **inputs)
        return self.indenter(self.scan(self.content(), dimensions=2))

    def content(self) -> bytes:
        """Return the content of the file. Raises ValueError for a file that cannot be read or opened."""
        from viscorough.io import heights, netcdf

        content = heights.content_of(self.path)
        if netcdf.is_netcdf(content):
            files.check_opens(self.path, content)
        return content

    def scan(self, content: bytes, dimensions: int | None) -> Scan:
        """Return the Scan in the content of the file.

        dimensions : 2 for a map, None for a map or a line

        Raises ValueError if neither the file nor the user states the unit of length.
        """
        from viscorough.io import heights
        from viscorough.io.scan import NOT_STATED

        channel, flip = self.arguments.get("channel"), self.arguments.get("flip", False)
        scan = heights.scan_of(self.path, content, channel=channel, dimensions=dimensions, flip=flip)
        scale = self.arguments.get("scale")
        if scan.unit == NOT_STATED and "unit" not in self.arguments and not (scale and scale.unit):
            text = "the file states no unit of length; --unit, as --unit um, is needed"
            spacing = "" if scan.spacing is not None or "spacing" in self.arguments else ", and --spacing"
            raise ValueError(f"{self.path}: {text}{spacing}, or --unit {units.UNKNOWN} for consistent units")
        return scan

    def indenter(self, scan: Scan) -> tuple[viscorough.Indenter, str]:
        """Convert the Scan of a map to an indenter in metres, prepare its heights, and return it with their unit."""
        from viscorough.io import heights
        from viscorough.io.scan import in_metres

        how = {name: value for name, value in self.arguments.items() if name != "channel"}
        indenter, unit = heights.map_of(self.path, scan, **how)
        return in_metres(indenter, unit), unit

    def attributes(self, indenter: viscorough.Indenter, unit: str) -> dict[str, object]:
        """Return attributes for an output file: name of the file of heights, spacings, unit, channel, preparation."""
        attributes: dict[str, object] = {"heights": files.printable_name(self.path)}
        attributes["spacing"] = files.in_unit(indenter.spacing, unit)
        attributes |= {"row_spacing": files.in_unit(indenter.row_spacing, unit), "length_unit": unit}
        if "channel" in self.options:
            attributes["channel"] = self.options["channel"]
        steps = {name: value for name, value in self.options.items() if name in _PREPARATION}
        words = [f"--{name}" if value is True else f"--{name} {value}" for name, value in steps.items()]
        return attributes | {"preparation": " ".join(words) or "none"}


def _spacing(text: str) -> Quantity | tuple[Quantity, ...]:
    """Convert "DX" to one distance, or "DX,DY" to the distances between columns and between rows.

    Raises ValueError for a comma that may be a decimal mark, as in "1,5" and "1,5 um".
    """
    entries = [entry.strip() for entry in text.split(",")]
    if len(entries) > 2:
        raise ValueError("is not DX or DX,DY")
    if len(entries) == 2 and entries[0].isdecimal() and entries[1][:1].isdecimal():
        number, unit = re.fullmatch(r"(\d+\.?\d*)\s*(.*)", entries[1]).groups()  # type: ignore[union-attr]
        if "." not in number or unit:
            unit = unit or "um"
            both = f"{entries[0]} {unit},{number} {unit}"
            raise ValueError(f"write {text.replace(',', '.')!r} for one distance, or {both!r} for two")
    distances = tuple(map(units.quantity, entries))
    return distances if len(distances) == 2 else distances[0]


def _crop(text: str) -> tuple[tuple[int, int], tuple[int, int]]:
    """Convert "X0:X1,Y0:Y1" to ((X0, X1), (Y0, Y1)), the columns and rows to keep, without column X1 and row Y1."""
    match = re.fullmatch(r"(\d{1,9}):(\d{1,9}),(\d{1,9}):(\d{1,9})", text, re.ASCII)
    if match is None:
        raise ValueError("is not X0:X1,Y0:Y1, numbers of points from 0")
    left, right, top, bottom = map(int, match.groups())
    return (left, right), (top, bottom)


_VALUES: dict[str, Callable[[str], Any]] = {
    "spacing": _spacing,
    "scale": units.quantity,
    "nodata": lambda text: [float(entry) for entry in text.split(",")],
    "crop": _crop,
}


def _converted(texts: dict[str, Any]) -> dict[str, Any]:
    """Convert the options of a HeightsFile to arguments of read_heights. Raises ValueError, with the option's name."""
    from viscorough.io.refusals import path_named

    arguments = dict(texts)
    for name in texts.keys() & _VALUES.keys():
        with path_named(f"--{name} {texts[name]}"):
            arguments[name] = _VALUES[name](texts[name])
    return arguments


def heights_input(argument: str = "heights") -> Callable[..., Any]:
    """Return a decorator that adds an argument for a file of heights, and the options for reading it, to a command.

    The command receives the file and its options as the argument `heights`, a HeightsFile.

    argument : name of the argument in the help
    """

    def decorate(command: Callable[..., Any]) -> Callable[..., Any]:
        @click.argument(argument, type=options.FILE, required=True)
        @click.option(
            "--spacing",
            metavar="DX[,DY]",
            help="Distance between columns, and rows if it differs.",
        )
        @click.option("--unit", metavar="UNIT", help="Unit of heights, such as um.")
        @click.option("--scale", metavar="QUANTITY", help='Factor of the heights, such as "0.053 nm".')
        @click.option("--channel", metavar="NAME", help="Map to read, by name or number, of several.")
        @click.option("--nodata", metavar="VALUE", help="Values, such as -9999, of points not measured.")
        @click.option("--crop", metavar="X0:X1,Y0:Y1", help="Columns and rows to keep, from 0, ends excluded.")
        @click.option("--flip", is_flag=True, help="Change the sign: in the data, larger is lower.")
        @click.option(
            "--detrend",
            type=click.Choice(["none", "mean", "plane", "sphere"]),
            metavar="FORM",
            help="Subtract the mean, plane or sphere  [default: none]",
        )
        @click.option(
            "--fill",
            type=click.Choice(["none", "harmonic"]),
            metavar="HOW",
            help="Fill enclosed holes: harmonic  [default: none]",
        )
        @functools.wraps(command)
        def packed(**values: Any) -> Any:
            path, stated = values.pop(argument), {name: values.pop(name) for name in _READING + _PREPARATION}
            given = {name: value for name, value in stated.items() if value not in (None, False, "none")}
            return command(heights=HeightsFile(path, given, _converted(given)), **values)

        return packed

    return decorate
