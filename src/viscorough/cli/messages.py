"""Write messages and progress of the command line, also to streams that are closed, full, or limited in encoding."""

import contextlib
import io
import os
import re
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import click

from viscorough.basics.errors import REPORTED, AccuracyWarning, message

_DELAY = 1.0  # time until progress is shown, in seconds
ERRORS = (click.ClickException, *REPORTED)  # errors that the command line reports in one line
# Name of an argument in a message of the library, with or without a value: "argument detrend='plane'".
_ARGUMENT = re.compile(r"\bargument (\w+)(?:=([^\s;,:)]+))?")
# Options that have another name than the argument of the library.
_OPTIONS = {"roll_off_wavelength": "--roll-off", "young_modulus": "--young", "medium": "--viscosity"}


def announce(output: Path, text: str) -> None:
    """Write the closing line of a command, which starts with the name of the output file, to standard output."""
    with contextlib.suppress(OSError):  # the output file is complete, so a failure to write this line is no error
        click.echo(f"{output}: {text}")


def warn(text: str) -> None:
    """Issue an AccuracyWarning; `main` prints it after the closing line, and the output file records it."""
    warnings.warn(text, AccuracyWarning, stacklevel=3)


def warning_texts(caught: Sequence[warnings.WarningMessage]) -> list[str]:
    """Return the texts of warnings without repetitions, each on one line, with the names of options."""
    return list(dict.fromkeys(" ".join(with_options(str(warning.message)).split()) for warning in caught))


def with_options(text: str) -> str:
    """Return a message of the library with options of the command line instead of the names of arguments."""

    def option(match: re.Match[str]) -> str:
        name, value = match.groups()
        value = "" if value is None else " " + value.strip("'")
        return _OPTIONS.get(name, f"--{name.replace('_', '-')}") + value

    return _ARGUMENT.sub(option, text)


def complain(command: str, text: str) -> None:
    """Write one line about an error or a warning to standard error; do nothing if standard error cannot be written."""
    with contextlib.suppress(OSError):
        click.echo(f"{command}: {' '.join(text.split())}", err=True)


def report(command: str, error: BaseException) -> None:
    """Write the one-line message of an error to standard error; a wrong option adds the command for the help."""
    hint = ""
    if isinstance(error, click.UsageError):
        command = error.ctx.command_path if error.ctx else command
        hint = f"; see {command} --help"
    # An error about a file has a file name. So an error without a file name concerns standard output.
    if isinstance(error, OSError) and error.errno and error.filename is None:
        error = OSError(f"standard output cannot be written ({error.strerror})")
    complain(command, f"{error_text(error)}{hint}")


def error_text(error: BaseException) -> str:
    """Return the message of an error without the full stop at its end."""
    if isinstance(error, click.ClickException):
        return error.format_message().strip().removesuffix(".")
    return with_options(message(error))


def escape_unencodable_characters() -> None:
    """Let standard output write characters outside its encoding, for example in names of files, with backslashes."""
    if isinstance(sys.stdout, io.TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")


def discard_what_cannot_be_written() -> None:
    """Discard output that cannot be written; otherwise Python would try again at exit, and change the exit code."""
    for stream in (sys.stdout, sys.stderr):
        try:
            if stream:
                stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


@contextlib.contextmanager
def progress_bar(label: str, shown: bool | None) -> Iterator[Callable[[float], object]]:
    """Yield a function that shows the finished share of the work, 0 to 1, as a bar on standard error.

    label : text in front of the bar
    shown : True to show the bar, False to hide it, None to show it if standard error is a terminal

    The bar appears after a second, and is erased at the end, so that only warnings and messages remain.
    """
    from tqdm import tqdm

    with tqdm(
        total=1.0,
        desc=label,
        delay=_DELAY,
        disable=sys.stderr is None or (None if shown is None else not shown),  # standard error is None if it was closed
        leave=False,
        bar_format="{desc}: {percentage:3.0f} % |{bar:30}| {elapsed} elapsed, about {remaining} left",
    ) as bar:
        yield lambda done: bar.update(done - bar.n)
