"""Define the options that several commands share, and the types of their values."""

import contextlib
import functools
import inspect
import itertools
import math
import re
import shlex
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from viscorough.basics import units
from viscorough.basics.elasticity import INCOMPRESSIBLE, young_over_shear
from viscorough.basics.units import Quantity
from viscorough.io import suffixes

# Word of a unit, such as mN or Pa·s.
_UNIT_WORD = re.compile(r"[^\W\d_][^\W_]*(?:[·*/^][^\W_]+)*")
# Largest number of times in an option of the form FIRST:LAST:COUNT.
_MOST_TIMES = 1_000_000


class Command(click.Command):
    """Command whose help shows the options after its first paragraph, and all further paragraphs after them."""

    def __init__(self, name: str | None, *, help: str, **settings: Any) -> None:
        first, _, others = inspect.cleandoc(help).partition("\n\n")
        super().__init__(name, help=first, epilog=others, **settings)


def require(condition: bool, text: str) -> None:
    """Raise UsageError with the text unless the condition holds."""
    if not condition:
        raise click.UsageError(text)


def refuse_split_quantity(arguments: Sequence[str]) -> None:
    """Raise UsageError if the shell has split a quantity with a unit, as in --force 1 mN, into several arguments.

    arguments : words of a command line
    """
    for place, (option, number) in enumerate(itertools.pairwise(arguments)):
        if not (option.startswith("--") and re.fullmatch(r"[\d.,eE+-]*\d", number)):
            continue
        unit = " ".join(itertools.takewhile(_UNIT_WORD.fullmatch, arguments[place + 2 :]))
        if unit and not Path(unit.split()[0]).exists() and _is_unit(unit):
            text = f'{option} {number} {unit}: the shell splits this value; write {option} "{number} {unit}"'
            raise click.UsageError(text)


def _is_unit(text: str) -> bool:
    with contextlib.suppress(ValueError):
        units.factor(text, text)
        return True
    return False


class PositiveNumber(click.FloatRange):
    """Type of options: a finite number larger than `above` and not larger than `maximum`, if there is a maximum."""

    name = "number"

    def __init__(self, maximum: float | None = None, above: float = 0) -> None:
        super().__init__(above, maximum, min_open=True)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        if isinstance(value, str) and re.fullmatch(r"\d+,\d+", value):
            self.fail(f"{value!r} has a comma in its number; write {value.replace(',', '.')!r}", param, ctx)
        number: float = super().convert(value, param, ctx)
        if not math.isfinite(number):
            self.fail(f"{value!r} is not a finite number", param, ctx)
        return number


class QuantityOption(click.ParamType):
    """Type of options: a finite number above 0, plain or with a unit, such as "5 mN" if "N" is allowed.

    The unit must have the same dimension as the unit `allowed`. The text is converted to a
    viscorough.basics.units.Quantity. Later, the commands convert this Quantity by units.in_si to a number in SI units.
    """

    name = "quantity"

    def __init__(self, allowed: str) -> None:
        self.unit = allowed

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Quantity:
        reason = ""
        try:
            stated = units.quantity(value)
            if 0 < stated.to(self.unit) < math.inf:
                return stated
        except ValueError as error:
            if " has a comma in its number" in str(error):
                raise click.BadParameter(str(error), ctx, param) from error
            reason = f" ({error})" if str(error).startswith("unit ") else ""
        text = f"{value!r} is not a number above 0 and finite, plain or with a unit such as {self.unit}"
        raise click.BadParameter(f"{text}{reason}", ctx, param)


class Increasing(click.ParamType):
    """Type of options: numbers above 0 separated by commas, each larger than the number before.

    unit : if given, numbers may have units of the same dimension as this unit, and each number is converted to a
        viscorough.basics.units.Quantity. If None, numbers are plain and converted to floats
    """

    name = "a,b,c"

    def __init__(self, unit: str | None = None) -> None:
        self.unit = unit
        self.entry: click.ParamType = QuantityOption(unit) if unit else PositiveNumber()

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[Any]:
        entries = [self.entry.convert(entry.strip(), param, ctx) for entry in value.split(",")]
        if len({bool(entry.unit) for entry in entries if isinstance(entry, Quantity)}) == 2:
            unit = next(entry.unit for entry in entries if entry.unit)
            each = ",".join(f"{entry.number:g} {unit}" for entry in entries)
            one = f", or {value.replace(',', '.')!r} for one number" if re.match(r"\d+,\d+\s*\D+$", value) else ""
            self.fail(f"{value!r}: some numbers have a unit; write {each!r}{one}", param, ctx)
        numbers = [entry.to(self.unit) if self.unit else entry for entry in entries]
        if any(later <= earlier for earlier, later in itertools.pairwise(numbers)):
            self.fail(f"{value!r}: needed are increasing numbers, each larger than the one before", param, ctx)
        return entries


class Times(Increasing):
    """Type of options: increasing times above 0 separated by commas, or FIRST:LAST:COUNT for equally spaced times.

    COUNT is the number of times; FIRST may be 0.
    """

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[Any]:
        if ":" not in value:
            return super().convert(value, param, ctx)
        try:
            first, last, count = (float(entry) for entry in value.split(":"))
        except ValueError:
            first, last, count = math.nan, math.nan, math.nan
        if not (0 <= first < last < math.inf and 2 <= count <= _MOST_TIMES and count.is_integer()):
            text = f"{value!r}: FIRST:LAST:COUNT, as 0:4:201, needs 0 <= FIRST < LAST and 2 to {_MOST_TIMES} times"
            self.fail(text, param, ctx)
        steps = int(count) - 1
        return [first + (last - first) * step / steps for step in range(steps)] + [last]


class ColumnChoice(click.ParamType):
    """Type of options: numbers of columns, such as time=1,force=3, converted to {quantity: number}."""

    name = "columns"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> dict[str, int]:
        entries = re.findall(r"(time|depth|force)=([1-9]\d{0,5})", value, re.ASCII)
        if ",".join(map("=".join, entries)) != value.replace(" ", "") or len(dict(entries)) < len(entries):
            self.fail(f"{value!r} is not like time=1,force=3, with numbers of columns from 1", param, ctx)
        return {name: int(number) for name, number in entries}


FILE = click.Path(path_type=Path)


def output(
    metavar: str, *, allowed: dict[str, str] = suffixes.RESULTS, required: bool = True
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds the option -o/--output to a command.

    The option raises BadParameter for a file name with a suffix that is not allowed.

    metavar : name of the output file in the help
    allowed : {suffix: kind of file}
    required : False if the command needs no output file
    """
    kinds = ", ".join(f"{suffix} ({kind})" for suffix, kind in allowed.items())
    text = f"File to write or replace: {kinds}{'' if required else '  [default: none]'}"

    def check(context: click.Context, parameter: click.Parameter, path: Path | None) -> Path | None:
        try:
            if path is not None:
                suffixes.check_suffix(path, allowed)
        except ValueError as error:
            raise click.BadParameter(str(error), context, parameter) from error
        return path

    return click.option("-o", "--output", type=FILE, required=required, metavar=metavar, help=text, callback=check)


force_history = click.option(
    "--force-history",
    type=FILE,
    metavar="FORCE.csv",
    help="Columns time (s) and force (N), instead of --force: F >= 0, linear in between; a time given twice is a step.",
)
columns = click.option(
    "--columns",
    type=ColumnChoice(),
    metavar="time=1,force=3",
    help="Numbers of the columns, from 1, in files of times and forces or depths without headings.",
)
viscosity = click.option("--viscosity", type=QuantityOption("Pa s"), help="Shear viscosity of a Newtonian half-space.")


def _refuse_viscosity(context: click.Context, parameter: click.Parameter, path: Path | None) -> Path | None:
    """Raise BadParameter for --medium 1e6, where a viscosity is meant."""
    with contextlib.suppress(ValueError):
        if path is not None and not path.exists() and units.quantity(str(path)):
            text = f"{path} is no file; for a viscosity, --viscosity {shlex.quote(str(path))} is needed"
            raise click.BadParameter(text, context, parameter)
    return path


medium = click.option(
    "--medium",
    type=FILE,
    metavar="MEDIUM.yaml",
    callback=_refuse_viscosity,
    help="Medium of the half-space, instead of --viscosity.",
)
tolerance = click.option(
    "--tolerance", type=PositiveNumber(0.1), default=1e-3, help="Relative accuracy, 1e-12 or more."
)
threads = click.option(
    "--threads",
    type=click.IntRange(1, 1024),
    default=1,
    metavar="N",
    help="Threads; results do not depend on their number.",
)
_PROGRESS = "Show progress on standard error  [default: if it is a terminal]"
progress = click.option("--progress/--no-progress", default=None, help=_PROGRESS)


def until(default: str) -> Callable[..., Any]:
    """Return a decorator that adds the option --until-fraction to a command.

    default : default contact fraction, which only appears in the help. If the user does not give the option, the
        command receives None, and must replace None by this default
    """
    text = f"Contact fraction at which to stop  [default: {default}]"
    return click.option("--until-fraction", type=PositiveNumber(1), help=text)


@dataclass(frozen=True)
class ElasticConstants:
    """Moduli and Poisson ratio of the half-space, as the user gave them.

    Raises UsageError if they contradict each other.
    """

    shear_modulus: Quantity | None
    young: Quantity | None
    poisson: float | None

    def __post_init__(self) -> None:
        exclusive = "--shear-modulus and --young exclude each other; one of them is allowed"
        require(self.shear_modulus is None or self.young is None, exclusive)
        require(self.poisson is None or self.young is not None, "--poisson is for use with --young")

    def converted(self, length_unit: str) -> tuple[float | None, dict[str, float]]:
        """Return the shear modulus G that follows from the options, and {attribute of the output file: value}.

        G belongs to the incompressible half-space with the same E* = E/(1 − ν²) = 4G [Pa, or consistent units]. G is
        None if no modulus is given. Raises the errors of units.in_si.
        """
        if self.young is not None:
            modulus = units.in_si(self.young, "Pa", length_unit, "--young")
            ratio = INCOMPRESSIBLE if self.poisson is None else self.poisson
            return modulus / young_over_shear(ratio), {"young_modulus": modulus, "poisson_ratio": ratio}
        if self.shear_modulus is None:
            return None, {}
        modulus = units.in_si(self.shear_modulus, "Pa", length_unit, "--shear-modulus")
        return modulus, {"shear_modulus": modulus}


def elastic_constants(command: Callable[..., Any]) -> Callable[..., Any]:
    """Decorate a command with --shear-modulus, --young and --poisson, which it receives as `elastic`."""

    @click.option("--shear-modulus", type=QuantityOption("Pa"), help="Shear modulus G of the half-space.")
    @click.option("--young", type=QuantityOption("Pa"), help="Young's modulus, instead of G.")
    @click.option("--poisson", type=PositiveNumber(0.5, above=-1), help="Poisson ratio, with --young  [default: 0.5]")
    @functools.wraps(command)
    def packed(*, shear_modulus: Any, young: Any, poisson: Any, **values: Any) -> Any:
        return command(elastic=ElasticConstants(shear_modulus, young, poisson), **values)

    return packed


def lengths(quantities: Sequence[Quantity] | None, length_unit: str, name: str) -> list[float] | None:
    """Convert lengths to metres; plain numbers are in `length_unit`, and stay in consistent units if it is "1"."""
    return None if quantities is None else [units.in_si(each, "m", length_unit, name) for each in quantities]


def forces(
    quantities: Sequence[Quantity] | None, modulus: float | None, length_unit: str, name: str
) -> list[float] | None:
    """Convert forces F to F/G [m²], or in consistent units if `length_unit` is "1".

    modulus : shear modulus G; None if plain numbers are F/G, in the square of `length_unit`

    Raises UsageError for a force with a unit if G is not given.
    """
    if quantities is None:
        return None
    if modulus is not None:
        too_small = f"{name}: the shear modulus {modulus:g} is too small; a larger one is needed"
        require(modulus * 1e300 > 1, too_small)
        return [units.in_si(each, "N", length_unit, name) / modulus for each in quantities]
    for each in quantities:
        require(not each.unit, f"{name} {each}: a force needs --shear-modulus or --young; a plain number is F/G")
    area = 1.0 if length_unit == units.UNKNOWN else units.metres(length_unit) ** 2
    return [each.number * area for each in quantities]
