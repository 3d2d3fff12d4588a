"""The options of all commands that read a map of heights: spacing, unit, channel and preparation."""

from __future__ import annotations

import functools
import re
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscorough import units
from viscorough.cli.files import check_opens, check_output, printable_name
from viscorough.cli.options import FILE, QuantityOption
from viscorough.errors import AccuracyWarning
from viscorough.units import Quantity

if TYPE_CHECKING:
    from viscorough.indenter import Indenter

_STEEP_SLOPE = 0.3  # rms slope above which the theory of small slopes is doubtful, so that users are warned


@dataclass(frozen=True)
class Surface:
    """A file of heights and how to read it.

    spacing : (dx, dy) as viscorough.units.Quantity, or None
    preparation : scale and keyword arguments of viscorough.prepare that were given
    """

    path: Path
    spacing: tuple | None = None
    unit: str | None = None
    channel: str | None = None
    preparation: dict = field(default_factory=dict)

    def attributes(self, indenter: Indenter) -> dict[str, object]:
        """What an output file says about the surface and how it was read and prepared."""
        attributes = {"heights": printable_name(self.path), "spacing": indenter.spacing}
        attributes |= {"row_spacing": indenter.row_spacing, "length_unit": indenter.length_unit}
        if self.channel is not None:
            attributes["channel"] = self.channel
        return attributes | {"preparation": _in_words(self.preparation)}


def _spacing(value: str) -> tuple[Quantity, Quantity]:
    """One or two positive distances separated by a comma, plain or with a unit of length."""
    entries = value.split(",")
    if len(entries) > 2:
        raise click.BadParameter(f"{value!r} has {len(entries)} distances; DX or DX,DY is allowed")
    distances = [QuantityOption("m").convert(entry.strip(), None, None) for entry in entries]
    return distances[0], distances[-1]


def _length_unit(value: str) -> str:
    try:
        return units.length_unit(value)
    except ValueError as error:
        raise click.BadParameter(str(error)) from error


def _numbers(value: str) -> list[float]:
    """Numbers separated by commas, of any sign."""
    try:
        numbers = [float(entry) for entry in value.split(",")]
    except ValueError:
        numbers = [float("nan")]
    if not all(abs(number) < float("inf") for number in numbers):
        raise click.BadParameter(f"{value!r} is not a finite number, or several separated by commas")
    return numbers


def _crop(value: str) -> tuple[tuple[int, int], tuple[int, int]]:
    """Columns and rows to keep, FIRST:END each."""
    match = re.fullmatch(r"(\d{1,9}):(\d{1,9}),(\d{1,9}):(\d{1,9})", value, re.ASCII)
    if match is None:
        raise click.BadParameter(f"{value!r} is not X0:X1,Y0:Y1, numbers of points from 0")
    left, right, top, bottom = map(int, match.groups())
    return (left, right), (top, bottom)


_OPTIONS = (
    click.option(
        "--spacing",
        type=_spacing,
        metavar="DX[,DY]",
        help="Distance between neighbouring points, from column to column and from row to row if they differ; plain "
        "numbers are in the unit of the heights. Needed where the file states none.",
    ),
    click.option(
        "--unit", type=_length_unit, metavar="UNIT", help="Unit of heights, such as um, if the file has none."
    ),
    click.option("--scale", type=QuantityOption("m"), help="Factor of the heights, such as 0.053 nm per count."),
    click.option("--channel", help="Name or number of the map to read from a file that holds several."),
    click.option("--nodata", type=_numbers, metavar="VALUE", help="Values, such as -9999, of points not measured."),
    click.option("--crop", type=_crop, metavar="X0:X1,Y0:Y1", help="Columns and rows to keep, from 0, ends excluded."),
    click.option("--flip", is_flag=True, help="Change the sign, for data in which larger is lower."),
    click.option(
        "--detrend",
        type=click.Choice(["none", "mean", "plane", "sphere"]),
        default="none",
        help="Form to subtract, fitted by least squares; a sphere includes a plane.",
    ),
    click.option(
        "--fill",
        type=click.Choice(["none", "harmonic"]),
        default="none",
        help="Heights for enclosed holes, from the Laplace equation.",
    ),
)


def heights_input(argument: str = "heights") -> Callable[..., Any]:
    """Decorator that adds the argument HEIGHTS and the options to read it, which reach the command as `surface`."""

    def decorate(command: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(command)
        def packed(*arguments: Any, **values: Any) -> Any:
            path, spacing, unit, channel = (values.pop(name) for name in (argument, "spacing", "unit", "channel"))
            preparation = {name: values.pop(name) for name in ("scale", "nodata", "crop", "flip", "detrend", "fill")}
            given = {name: value for name, value in preparation.items() if value and value != "none"}
            surface = Surface(path, spacing, unit, channel, given)
            return command(*arguments, surface=surface, **values)

        for option in reversed(_OPTIONS):
            packed = option(packed)
        return click.argument(argument, type=FILE)(packed)

    return decorate


def read_indenter(surface: Surface, output: Path) -> Indenter:
    """The indenter that a Surface describes, read after a check that the output can be written.

    Raises ValueError for an output that cannot be written and for invalid heights; steep ones give an AccuracyWarning.
    """
    from viscorough.io.heights import read_heights

    path = surface.path
    check_output(output, heights=path)
    if path.suffix == ".nc":
        check_opens(path)
    indenter = read_heights(path, surface.spacing, unit=surface.unit, channel=surface.channel, **surface.preparation)
    if (slope := indenter.rms_slope) > _STEEP_SLOPE:
        text = f"{path}: the rms slope is {slope:.2g}; the theory holds for small slopes, below about {_STEEP_SLOPE}"
        warnings.warn(text, AccuracyWarning, stacklevel=2)
    return indenter


def _in_words(preparation: dict[str, Any]) -> str:
    """The steps of a preparation, as options."""
    steps = []
    for name, value in preparation.items():
        if name == "crop":
            value = ",".join(f"{first}:{end}" for first, end in value)
        elif name == "nodata":
            value = ",".join(f"{number:g}" for number in value)
        steps.append(f"--{name}" if value is True else f"--{name} {value}")
    return " ".join(steps) or "none"
