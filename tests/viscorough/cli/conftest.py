"""The working folder of a test of the command line, and the contract for a user's mistake in it."""

import shlex

import pytest

from viscorough.cli import COMMANDS, main


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

    def contents():
        return {path: path.read_bytes() if path.is_file() else None for path in here.rglob("*")}

    def refusal(line):
        arguments, before = shlex.split(line), contents()
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
        assert contents() == before
        return captured.err

    return refusal
