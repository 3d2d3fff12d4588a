"""The contract of the command line: contents of files, mistakes, warnings, interrupts."""

import os
import signal
import subprocess
import sys
import textwrap
import time
import warnings

import click
import numpy as np
import pytest

import viscorough
from support.command_line import python
from viscorough import ConvergenceError, cli

INDENT = "indent heights.npy --spacing 1 -o out.nc"


def run_indent_as(function):
    """The exit code of the command line with one command, `indent`, which calls a function."""
    commands = click.Group()
    commands.command("indent")(function)
    return cli.main(["indent"], commands)


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
def test_errors_are_one_line(capsys, error, code, what):
    def fail():
        warnings.warn("overflow on the way", RuntimeWarning, stacklevel=1)
        raise error

    assert run_indent_as(fail) == code
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"viscorough indent: {what}")


def test_warnings_are_written_once_and_on_one_line(capsys):
    def warn():
        for _ in range(3):
            warnings.warn("the spacing\nis odd", UserWarning, stacklevel=1)

    assert run_indent_as(warn) == 0
    assert capsys.readouterr().err == "viscorough indent: warning: the spacing is odd\n"


def test_errors_in_the_code_are_not_hidden():
    with pytest.raises(ZeroDivisionError):
        run_indent_as(lambda: 1 / 0)


# ---- real processes


def test_interrupt_is_quiet_and_leaves_nothing(here):
    """The whole curve of this map takes minutes; the interrupt comes while modules load or in the solver."""
    np.save("heights.npy", np.random.default_rng(0).random((600, 600)))
    script = textwrap.dedent("""
        import sys
        from viscorough import cli
        from viscorough.io import heights
        read = heights.read_heights
        def announced(*arguments, **options):
            print("reading", flush=True)
            return read(*arguments, **options)
        heights.read_heights = announced
        sys.exit(cli.main(sys.argv[1:]))
    """)
    command = [sys.executable, "-c", script, *INDENT.split(), "--until-fraction", "1"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "reading\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (-signal.SIGINT, "", ""), "a shell reports 130"
    assert os.listdir(here) == ["heights.npy"]


def test_help_and_mistakes_do_not_wait_for_slow_imports():
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
