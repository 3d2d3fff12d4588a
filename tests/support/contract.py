"""The contract for a user's mistake: one line; of the command line on stderr, with exit code 2 and no file."""

import contextlib
import shlex

import pytest

from viscorough.cli import COMMANDS, main


def complaint(line, capsys, folder):
    """The one line that refuses a line of arguments; no file of the folder is made or changed."""
    arguments, before = shlex.split(line), _contents(folder)
    capsys.readouterr()
    code = main(arguments)
    captured = capsys.readouterr()
    assert (code, captured.out) == (2, ""), captured
    command = [argument for argument in arguments[:1] if argument in COMMANDS]
    assert captured.err.startswith(f"{' '.join(['viscorough', *command])}: ")
    assert len(captured.err.splitlines()) == 1
    assert captured.err.endswith("\n")
    assert len(captured.err) < 400
    assert "Traceback" not in captured.err
    assert _contents(folder) == before
    return captured.err


def _contents(folder):
    return {path: path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


@contextlib.contextmanager
def refused(what):
    """Context in which a ValueError of one line that matches `what` must be raised."""
    with pytest.raises(ValueError, match=what) as error:
        yield error
    assert len(str(error.value).splitlines()) == 1
