"""The options of all commands that read a map of heights: spacing, unit, channel and preparation."""

import functools
import re
import warnings
from dataclasses import dataclass, field
from pathlib import Path

import click

from viscorough.cli.files import check_opens, check_output, printable_name
from viscorough.cli.options import FILE
from viscorough.errors import AccuracyWarning

_STEEP_SLOPE = 0.3  # rms slope above which the theory of small slopes is doubtful, so that users are warned


@dataclass(frozen=True)
class Surface:
    """A file of heights and how to read it.

    spacing : (dx, dy) as viscorough.units.Quantity, or None
    preparation : keyword arguments of viscorough.prepare that were given
    """

    path: Path
    spacing: tuple | None = None
    unit: str | None = None
    channel: str | None = None
    preparation: dict = field(default_factory=dict)

    def attributes(self, indenter):
        """What an output file says about the surface and how it was read and prepared."""
        attributes = {"heights": printable_name(self.path), "spacing": indenter.spacing}
        attributes |= {"row_spacing": indenter.row_spacing, "length_unit": indenter.length_unit}
        if self.channel is not None:
            attributes["channel"] = self.channel
        return attributes | {"preparation": _in_words(self.preparation)}


class _Spacing(click.ParamType):
    """One or two positive distances separated by a comma, plain or with a unit of length."""

    name = "DX[,DY]"

    def convert(self, value, param, ctx):
        from viscorough.cli.options import Quantity

        entries = value.split(",")
        if len(entries) > 2:
            self.fail(f"{value!r} has {len(entries)} distances; DX or DX,DY is allowed", param, ctx)
        distances = [Quantity("m").convert(entry.strip(), param, ctx) for entry in entries]
        return distances[0], distances[-1]


class _LengthUnit(click.ParamType):
    name = "unit"

    def convert(self, value, param, ctx):
        from viscorough import units

        try:
            return units.length_unit(value)
        except ValueError as error:
            self.fail(str(error), param, ctx)


class _Numbers(click.ParamType):
    """Numbers separated by commas, of any sign."""

    name = "value"

    def convert(self, value, param, ctx):
        try:
            numbers = [float(entry) for entry in value.split(",")]
        except ValueError:
            numbers = [float("nan")]
        if not all(abs(number) < float("inf") for number in numbers):
            self.fail(f"{value!r} is not a finite number, or several separated by commas", param, ctx)
        return numbers


class _Crop(click.ParamType):
    """Columns and rows to keep, FIRST:END each."""

    name = "X0:X1,Y0:Y1"

    def convert(self, value, param, ctx):
        match = re.fullmatch(r"(\d{1,9}):(\d{1,9}),(\d{1,9}):(\d{1,9})", value, re.ASCII)
        if match is None:
            self.fail(f"{value!r} is not X0:X1,Y0:Y1, numbers of points from 0", param, ctx)
        left, right, top, bottom = map(int, match.groups())
        return (left, right), (top, bottom)


_OPTIONS = (
    click.option(
        "--spacing",
        type=_Spacing(),
        help="Distance between neighbouring points, from column to column and from row to row if they differ; plain "
        "numbers are in the unit of the heights. Needed where the file states none.",
    ),
    click.option(
        "--unit", type=_LengthUnit(), help="Unit of length of heights, such as um, where the file states none."
    ),
    click.option("--channel", help="Name or number of the map to read from a file that holds several."),
    click.option("--nodata", type=_Numbers(), help="Values, such as -9999, that mark points that were not measured."),
    click.option("--crop", type=_Crop(), help="Part to keep: columns and rows, numbered from 0, ends not included."),
    click.option("--flip", is_flag=True, help="Change the sign, for data in which larger is lower."),
    click.option(
        "--detrend",
        type=click.Choice(["none", "mean", "plane", "sphere"]),
        default="none",
        show_default=True,
        help="Form to subtract, fitted by least squares; a sphere includes a plane.",
    ),
    click.option(
        "--fill",
        type=click.Choice(["none", "harmonic"]),
        default="none",
        show_default=True,
        help="Heights for enclosed holes, from the Laplace equation.",
    ),
)


def heights_input(argument="heights"):
    """Decorator that adds the argument HEIGHTS and the options to read it, which reach the command as `surface`."""

    def decorate(command):
        @functools.wraps(command)
        def packed(*arguments, **values):
            path, spacing, unit, channel = (values.pop(name) for name in (argument, "spacing", "unit", "channel"))
            preparation = {name: values.pop(name) for name in ("nodata", "crop", "flip", "detrend", "fill")}
            given = {name: value for name, value in preparation.items() if value and value != "none"}
            surface = Surface(path, spacing, unit, channel, given)
            return command(*arguments, surface=surface, **values)

        for option in reversed(_OPTIONS):
            packed = option(packed)
        return click.argument(argument, type=FILE)(packed)

    return decorate


def read_indenter(surface, output):
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


def _in_words(preparation):
    """The steps of a preparation, as options."""
    steps = []
    for name, value in preparation.items():
        if name == "crop":
            value = ",".join(f"{first}:{end}" for first, end in value)
        elif name == "nodata":
            value = ",".join(f"{number:g}" for number in value)
        steps.append(f"--{name}" if value is True else f"--{name} {value}")
    return " ".join(steps) or "none"
