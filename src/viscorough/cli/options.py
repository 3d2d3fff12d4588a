"""Types of options, and options, that the commands of the command line share."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import click

from viscorough import units
from viscorough.units import Quantity


class PositiveNumber(click.ParamType):
    """A finite number above 0, or another number, and not above `maximum`."""

    name = "number"

    def __init__(self, maximum: float = float("inf"), above: float = 0) -> None:
        self.maximum, self.above = maximum, above

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        try:
            number = float(value)
        except ValueError:
            number = float("nan")
        if not (self.above < number <= self.maximum and number < float("inf")):
            limit = "finite" if self.maximum == float("inf") else f"up to {self.maximum:g}"
            self.fail(f"{value!r} is not a number above {self.above} and {limit}", param, ctx)
        return number


class QuantityOption(click.ParamType):
    """A finite number above 0, plain or with a unit that measures the same as `unit`, such as "5 mN" for "N".

    Converted to a viscorough.units.Quantity; number_in gives the number that the solvers need.
    """

    name = "quantity"

    def __init__(self, unit: str) -> None:
        self.unit = unit

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        number, reason = 0, ""
        try:
            stated = units.quantity(value)
            number = stated.to(self.unit)
        except ValueError as error:
            reason = f" ({error})" if str(error).startswith("unit ") else ""
        if not 0 < number < float("inf"):
            text = f"{value!r} is not a number above 0 and finite, plain or with a unit such as {self.unit}"
            self.fail(f"{text}{reason}", param, ctx)
        return stated


def number_in(unit: str, quantity: Quantity, length_unit: str, option: str) -> float:
    """The number of a Quantity in `unit`; a plain number is returned unchanged.

    Raises UsageError if the quantity has a unit although the unit of length is not known: numbers are then in
    consistent units of the user's choice.
    """
    try:
        return units.number(quantity, unit, length_unit, option)
    except ValueError as error:
        raise click.UsageError(str(error)) from error


class Increasing(click.ParamType):
    """Numbers above 0 separated by commas, each larger than the one before.

    unit : what all of them, or none, may have; they are converted to viscorough.units.Quantity then, else to floats
    """

    name = "a,b,c"

    def __init__(self, unit: str | None = None) -> None:
        self.unit = unit

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        entry_type: click.ParamType = QuantityOption(self.unit) if self.unit else PositiveNumber()
        entries: list[Any] = [entry_type.convert(entry.strip(), param, ctx) for entry in value.split(",")]
        if self.unit and len({bool(entry.unit) for entry in entries}) == 2:
            self.fail(f"{value!r}: some numbers have a unit; all or none of them may have one", param, ctx)
        for last, entry in pairwise(entries):
            if (entry.to(self.unit) <= last.to(self.unit)) if self.unit else (entry <= last):
                self.fail(f"{entry} follows {last}; each number must be larger than the one before", param, ctx)
        return entries


FILE = click.Path(path_type=Path)


def output_option(metavar: str, table: bool = True) -> Callable[..., Any]:
    """Decorator that adds -o/--output to a command; `table` says whether the results can also be written as CSV."""
    text = "File to write or replace" + ("; as a table if it ends in .csv." if table else ".")

    def check(context: click.Context, parameter: click.Parameter, path: Path) -> Path:
        if path.suffix.lower() == ".csv" and not table:
            raise click.BadParameter(f"{path}: maps are no table; a NetCDF file (.nc) is needed", context, parameter)
        return path

    return click.option("-o", "--output", type=FILE, required=True, metavar=metavar, help=text, callback=check)


force_history_option = click.option(
    "--force-history",
    type=FILE,
    metavar="FORCE.csv",
    help="Two columns, times and forces, instead of --force: F >= 0, linear in between; a time given twice is a step.",
)
_THREADS = "Threads of the processor; the result does not depend on them."
threads_option = click.option("--threads", type=click.IntRange(1, 1024), default=1, help=_THREADS)
