"""Messages of the command line on standard output and error, which may be closed, full, or limited in encoding."""

import contextlib
import io
import os
import sys
from pathlib import Path

import click


def announce(output: Path, text: str) -> None:
    """Write the closing line of a command, which names its output file, to standard output.

    The file is complete by then. If the line cannot be written, a line on standard error says so, unless the
    reader has closed the pipe.
    """
    try:
        click.echo(f"{output}: {text}")
    except BrokenPipeError:
        pass
    except OSError as error:
        text = f"warning: {output} is complete, but standard output cannot be written ({error.strerror})"
        complain(click.get_current_context().command_path, text)


def complain(command: str, text: str) -> None:
    """Write one line about an error or a warning to standard error, if it can be written."""
    with contextlib.suppress(OSError):
        click.echo(f"{command}: {' '.join(text.split())}", err=True)


def report(command: str, error: BaseException) -> None:
    """Write one line about an error to stderr."""
    hint = ""
    if isinstance(error, click.ClickException):
        text = error.format_message()
        if isinstance(error, click.UsageError):
            command = error.ctx.command_path if error.ctx else command
            hint = f"; see {command} --help"
    elif isinstance(error, MemoryError):
        text = f"not enough memory{f' ({error})' if str(error) else ''}; a smaller map of heights is needed"
    elif isinstance(error, OSError) and error.errno and error.filename is None:  # those of files are named
        text = f"standard output cannot be written ({error.strerror})"
    else:
        text = str(error)
    complain(command, f"{text.strip().removesuffix('.')}{hint}")


def escape_unencodable_characters() -> None:
    """Write characters that the encoding of standard output lacks, as in names of files, with backslashes."""
    if isinstance(sys.stdout, io.TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")


def discard_what_cannot_be_written() -> None:
    """Discard output that cannot be written: the interpreter would try again at exit, and change the exit code."""
    for stream in (sys.stdout, sys.stderr):
        try:
            if stream:
                stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
