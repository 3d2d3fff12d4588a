"""The contract of the command line: contents of files, mistakes, warnings, interrupts."""

import textwrap
import warnings

import click
import pytest

import viscorough
from support.command_line import python
from viscorough import ConvergenceError, cli


@pytest.fixture
def run_indent_as(monkeypatch):
    """Return a function that runs the command `indent` as a call of its argument, and returns the exit code."""

    def run(function):
        monkeypatch.setitem(cli.cli.commands, "indent", click.Command("indent", callback=function))
        with warnings.catch_warnings(action="default"):
            return cli.main(["indent"])

    return run


@pytest.mark.parametrize(
    ("error", "code", "what"),
    [
        (ConvergenceError("level 3 did not\nconverge"), 1, "level 3 did not converge"),
        (MemoryError("Unable to allocate 8 TiB"), 2, "not enough memory (Unable to allocate 8 TiB)"),
        (MemoryError(), 2, "not enough memory; a smaller map"),
        (ValueError("depth: too deep"), 2, "depth: too deep"),
        (OSError("a.nc: not written"), 2, "a.nc: not written"),
    ],
)
def test_errors_are_one_line(capsys, error, code, what, run_indent_as):
    def fail():
        warnings.warn("overflow on the way", RuntimeWarning, stacklevel=1)
        raise error

    assert run_indent_as(fail) == code
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"viscorough indent: {what}")


def test_warnings_are_written_once_and_on_one_line(capsys, run_indent_as):
    def warn():
        for _ in range(3):
            warnings.warn("the spacing\nis odd", UserWarning, stacklevel=1)

    assert run_indent_as(warn) == 0
    assert capsys.readouterr().err == "viscorough indent: warning: the spacing is odd\n"


def test_errors_in_the_code_are_not_hidden(run_indent_as):
    with pytest.raises(ZeroDivisionError):
        run_indent_as(lambda: 1 / 0)


@pytest.mark.parametrize("name", cli.cli.commands)
def test_help_shows_all_options_on_the_first_screen(capsys, monkeypatch, name):
    monkeypatch.setenv("COLUMNS", "80")
    assert cli.main([name, "--help"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert next(place for place, line in enumerate(lines) if "--help" in line) < 40


# ---- real processes


def test_help_and_errors_need_no_slow_imports():
    script = textwrap.dedent("""
        import sys
        from viscorough.cli import main
        assert main(["--help"]) == main(["indent", "--help"]) == main(["kinetics", "--help"]) == 0
        assert main(["--version"]) == 0
        assert main(["indent", "--spacing", "x"]) == 2
        print(sorted({"numpy", "numba", "scipy", "xarray", "netCDF4"} & set(sys.modules)))
    """)
    done = python("-c", script)
    assert done.stdout.splitlines()[-1] == "[]"
    assert f"viscorough {viscorough.__version__}\n" in done.stdout
    assert done.stdout.count("Example") == 3
