"""Faults under the command line: folders and streams that cannot be written, interrupts.

Full disks are tested together with the writing of files, in tests/viscorough/io/test_netcdf.py.
"""

import contextlib
import os
import shlex
import shutil
import signal
import subprocess
import sys
import time

import click
import numpy as np
import pytest

import viscorough
from support.command_line import VISCOROUGH, run, sphere_heights
from support.curves import random_curve
from support.faults import contents, no_privileges
from viscorough.cli import files
from viscorough.io import netcdf

INDENT = "indent heights.npy --spacing 1 --unit 1 -o out.nc"
KINETICS = "kinetics curve.nc --force 1 --viscosity 1 -o out.nc"


@pytest.fixture(autouse=True)
def here(here):
    """Make a folder with heights.npy, curve.nc and an older out.nc, which must not be changed."""
    np.save("heights.npy", sphere_heights(9))
    for name in ("curve.nc", "out.nc"):
        viscorough.save(random_curve(length_unit="1"), name)
    return here


# ---- places that cannot be written


def test_folder_without_permission_to_write_is_one_line(here):
    before = contents(here)
    here.chmod(0o555)
    try:
        done = shell(f"{shlex.join(no_privileges())} viscorough {INDENT}")
    finally:
        here.chmod(0o755)
    line = "viscorough indent: out.nc: the folder . is not writable; a writable folder is needed\n"
    assert done == (2, line, "")
    assert contents(here) == before


# ---- standard output and standard error that cannot be written


def shell(line, **environment):
    """Return (exit code, stderr, stdout) of a shell line that runs `viscorough`."""
    line = line.replace("viscorough", str(VISCOROUGH))
    options = {"capture_output": True, "text": True, "timeout": 60, "check": False, "env": os.environ | environment}
    done = subprocess.run(["bash", "-o", "pipefail", "-c", line], **options)
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    return done.returncode, done.stderr, done.stdout


FULL = "standard output cannot be written (No space left on device)\n"


@pytest.mark.parametrize("redirection", [">&- 2>&- <&-", ">/dev/full"])
def test_complete_output_is_success_with_a_closed_output_stream(redirection):
    assert shell(f"viscorough {KINETICS} {redirection}")[:2] == (0, "")
    assert "time" in netcdf.read("out.nc").variables, "not the older one"


def test_names_outside_the_encoding_of_standard_output_are_printed(here):
    shutil.copy("heights.npy", "ψ.npy")
    code, error, output = shell("viscorough indent ψ.npy --spacing 1 --unit 1 -o ω.nc", PYTHONIOENCODING="latin-1")
    assert (code, error) == (0, "")
    assert output.startswith("\\u03c9.nc: ")
    assert netcdf.read("ω.nc").attributes["heights"] == "ψ.npy"


def test_names_of_files_that_are_not_valid_text_are_printed(here):
    name = os.fsdecode(b"caf\xe9")
    shutil.copy("heights.npy", f"{name}.npy")
    shutil.copy("curve.nc", f"{name}.nc")
    assert run(f"indent '{name}.npy' --spacing 1 --unit 1 -o new.nc") == 0
    assert netcdf.read("new.nc").attributes["heights"] == r"caf\udce9.npy"
    code, error, output = shell(f"viscorough {KINETICS.replace('curve', name)}")
    assert (code, output, len(error.splitlines())) == (2, "", 1)
    assert error.startswith(r"viscorough kinetics: caf\udce9.nc: not readable (")


def test_help_ends_quietly_if_the_reader_closes_the_pipe():
    assert shell("viscorough indent --help | true")[:2] == (0, "")
    code, error, _ = shell("viscorough indent --help >/dev/full")
    assert code == 2
    assert error.endswith(FULL)
    assert len(error.splitlines()) == 1


@pytest.mark.parametrize("redirection", ["2>/dev/full", "2>&1 | true"])
def test_errors_on_a_closed_stream_keep_their_exit_code(redirection):
    assert shell(f"viscorough indent {redirection}")[0] == 2


# ---- interrupts and warnings


INTERRUPTED = "import os, signal; os.kill(os.getpid(), signal.SIGINT)"


@pytest.mark.parametrize(
    ("command", "module"), [([VISCOROUGH], "click"), ([sys.executable, "-m", "viscorough"], "numpy")]
)
def test_interrupt_during_the_imports_is_quiet(here, tmp_path_factory, command, module):
    """The interrupt comes during the first import of the command line, and during the first import of a command."""
    folder = tmp_path_factory.mktemp("interrupted")
    (folder / f"{module}.py").write_text(INTERRUPTED)
    environment = os.environ | {"PYTHONPATH": str(folder)}
    options = {"env": environment, "capture_output": True, "check": False, "preexec_fn": interrupts_arrive}
    done = subprocess.run([*command, *INDENT.split()], **options)
    assert (done.stdout, done.stderr) == (b"", b"")
    assert done.returncode == -signal.SIGINT, "a shell reports 130"


def interrupts_arrive():
    """Let SIGINT raise KeyboardInterrupt; processes started in the background would ignore it."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.mark.parametrize(
    ("heights", "code", "line"),
    [(sphere_heights(9), 0, ""), (100 * sphere_heights(9), 2, "viscorough indent: heights.npy: the rms slope is ")],
    ids=["gentle", "steep"],
)
def test_warnings_that_are_errors_are_one_line(here, heights, code, line):
    np.save("heights.npy", heights)
    done = shell(f"viscorough {INDENT}", PYTHONWARNINGS="error")
    assert done[0] == code
    assert done[1].startswith(line)
    assert len(done[1].splitlines()) == bool(line)
    assert (netcdf.read("out.nc").attributes.get("heights") == "heights.npy") == (code == 0)


def test_file_that_cannot_be_opened_in_time_is_one_line(capsys, monkeypatch):
    """The HDF5 library can run without end on a damaged file."""
    codes = []
    monkeypatch.setattr(os, "_exit", codes.append)
    monkeypatch.setattr(files, "LONGEST", 0.05)
    monkeypatch.setattr(netcdf, "opened", lambda path, content, checked: contextlib.nullcontext(time.sleep(0.5)))
    with click.Context(click.Command("kinetics"), info_name="viscorough kinetics"):
        files.check_opens("a.nc")
    assert codes == [2]
    assert capsys.readouterr().err.startswith("viscorough kinetics: a.nc: not opened within 0.05 s")
