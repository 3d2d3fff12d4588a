"""The working folder of a test of the command line, and the contract for a user's mistake in it."""

import re
import shlex

import pytest

from support.command_line import run
from support.faults import contents
from viscorough.cli import cli

# Arguments of Python whose options are spelled otherwise; those of media are keys of files as well.
_OF_PYTHON = {option.name for command in cli.commands.values() for option in command.params if "_" in option.name}
_OF_PYTHON |= {"contact_at", "read_heights", "read_line", "roll_off_wavelength"}
_OF_PYTHON -= {"shear_modulus"}


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Run the commands in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def complaint(here, capsys):
    """Return a function that requires a line of arguments to be refused, and returns the line on stderr.

    The exit code is 2, no file of the folder is made or changed, and the line names options, not arguments of Python.
    """

    def refusal(line):
        arguments, before = shlex.split(line), contents(here)
        capsys.readouterr()
        code = run(line)
        captured = capsys.readouterr()
        assert (code, captured.out) == (2, ""), captured
        command = [argument for argument in arguments[:1] if argument in cli.commands]
        assert captured.err.startswith(f"{' '.join(['viscorough', *command])}: ")
        assert len(captured.err.splitlines()) == 1
        assert captured.err.endswith("\n")
        assert len(captured.err) < 400
        words = set(re.findall(r"\w+=?", captured.err))
        assert not any(word in _OF_PYTHON or word.endswith("=") for word in words), captured.err
        assert contents(here) == before
        return captured.err

    return refusal
