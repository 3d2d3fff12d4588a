"""What the commands of the command line share: types of options, and reading and writing of files."""

import contextlib
import os
import threading
from itertools import pairwise
from pathlib import Path
from signal import default_int_handler

import click

from viscorough.cli.messages import complain
from viscorough.interrupts import on_interrupt


class PositiveNumber(click.ParamType):
    """A finite number above 0, or another number, and not above `maximum`."""

    name = "number"

    def __init__(self, maximum=float("inf"), above=0):
        self.maximum, self.above = maximum, above

    def convert(self, value, param, ctx):
        try:
            number = float(value)
        except ValueError:
            number = float("nan")
        if not (self.above < number <= self.maximum and number < float("inf")):
            limit = "finite" if self.maximum == float("inf") else f"up to {self.maximum:g}"
            self.fail(f"{value!r} is not a number above {self.above} and {limit}", param, ctx)
        return number


class Quantity(click.ParamType):
    """A finite number above 0, plain or with a unit that measures the same as `unit`, such as "5 mN" for "N".

    Converted to a viscorough.units.Quantity; number_in gives the number that the solvers need.
    """

    name = "quantity"

    def __init__(self, unit):
        self.unit = unit

    def convert(self, value, param, ctx):
        from viscorough import units

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


def number_in(unit, quantity, length_unit, option):
    """The number of a Quantity in `unit`; a plain number is returned unchanged.

    Raises UsageError if the quantity has a unit although the unit of length is not known: numbers are then in
    consistent units of the user's choice.
    """
    if quantity.unit and length_unit == "1":
        text = f"{option} {quantity}: needs a plain number, since the unit of length is not known"
        raise click.UsageError(f"{text}; state it with --unit where the heights are read")
    return quantity.to(unit)


class Increasing(click.ParamType):
    """Numbers above 0 separated by commas, each larger than the one before.

    unit : what all of them, or none, may have; they are converted to viscorough.units.Quantity then, else to floats
    """

    name = "a,b,c"

    def __init__(self, unit=None):
        self.unit = unit

    def convert(self, value, param, ctx):
        entry_type = Quantity(self.unit) if self.unit else PositiveNumber()
        entries = [entry_type.convert(entry.strip(), param, ctx) for entry in value.split(",")]
        if self.unit and len({bool(entry.unit) for entry in entries}) == 2:
            self.fail(f"{value!r}: some numbers have a unit; all or none of them may have one", param, ctx)
        for last, entry in pairwise(entries):
            if (entry.to(self.unit) <= last.to(self.unit)) if self.unit else (entry <= last):
                self.fail(f"{entry} follows {last}; each number must be larger than the one before", param, ctx)
        return entries


FILE = click.Path(path_type=Path)


def output_option(metavar, table=True):
    """Decorator that adds -o/--output to a command; `table` says whether the results can also be written as CSV."""
    text = "File to write or replace" + ("; as a table if it ends in .csv." if table else ".")

    def check(context, parameter, path):
        if path.suffix.lower() == ".csv" and not table:
            raise click.BadParameter(f"{path}: maps are no table; a NetCDF file (.nc) is needed", context, parameter)
        return path

    return click.option("-o", "--output", type=FILE, required=True, metavar=metavar, help=text, callback=check)


threads_option = click.option(
    "--threads",
    type=click.IntRange(1, 1024),
    default=1,
    show_default=True,
    help="Threads of the processor; the result does not depend on them.",
)


def check_output(output, **inputs):
    """Raise ValueError unless the output can be written and would replace no file that is read.

    inputs : files that are read, or None, by what they hold
    """
    from viscorough.io import atomic

    atomic.check_output(output)
    for kind, file in inputs.items():
        if file and output.exists() and file.exists() and output.samefile(file):
            raise ValueError(f"{output}: would replace the {kind.replace('_', ' ')}; another name is needed")


def printable_name(file):
    """Name of a file, for an attribute: bytes that are not letters appear with backslashes."""
    return file.name.encode(errors="backslashreplace").decode()


@contextlib.contextmanager
def time_limit(path, seconds=60):
    """Context in which a NetCDF file is opened; if that takes too long, the process ends with one line and exit code 2.

    Damage can make the HDF5 library run without end, where Python cannot interrupt it. Opening takes milliseconds.
    """

    def end():
        text = f"{path}: not opened within {seconds:g} s, as can happen if it is damaged; a whole NetCDF file is needed"
        complain(command, text)
        os._exit(2)

    command = click.get_current_context().command_path
    timer = threading.Timer(seconds, end)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def check_opens(path):
    """Raise a one-line ValueError unless the NetCDF file can be opened, within a time limit."""
    from viscorough.io import netcdf

    with time_limit(path), netcdf.opened(path):
        pass


def read_content(path):
    """The io.netcdf.Content of a NetCDF file, or of a table (.csv) that a command wrote."""
    from viscorough.io import netcdf, tables

    if tables.is_table(path):
        return tables.read(path)
    check_opens(path)
    return netcdf.read(path)


def write_output(content, output, **attributes):
    """Write an io.netcdf.Content with attributes added, as NetCDF, or as a table if the name ends in .csv.

    The attribute `warnings` holds the warnings given so far.
    """
    from viscorough.io import netcdf, tables

    if texts := warning_texts(click.get_current_context().obj):
        attributes["warnings"] = "; ".join(texts)
    with on_interrupt(default_int_handler):  # raises KeyboardInterrupt, so that no temporary file is left
        write = tables.write if tables.is_table(output) else netcdf.write
        write(content.with_attributes(**attributes), output)


def warning_texts(caught):
    """The texts of the different warnings, each on one line."""
    return list(dict.fromkeys(" ".join(str(warning.message).split()) for warning in caught))
