"""The working folder of a test of the command line, and the contract for a user's mistake in it."""

import shlex

import pytest

from support.faults import contents
from viscorough.cli import cli, main


@pytest.fixture
def here(tmp_path, monkeypatch):
    """An empty folder, in which the commands run."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def complaint(here, capsys):
    """Function that returns the one line on stderr that refuses a line of arguments.

    The exit code is 2, and no file of the folder is made or changed.
    """

    def refusal(line):
        arguments, before = shlex.split(line), contents(here)
        capsys.readouterr()
        code = main(arguments)
        captured = capsys.readouterr()
        assert (code, captured.out) == (2, ""), captured
        command = [argument for argument in arguments[:1] if argument in cli.commands]
        assert captured.err.startswith(f"{' '.join(['viscorough', *command])}: ")
        assert len(captured.err.splitlines()) == 1
        assert captured.err.endswith("\n")
        assert len(captured.err) < 400
        assert contents(here) == before
        return captured.err

    return refusal
