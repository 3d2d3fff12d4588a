"""Faults under the command line: folders and streams that cannot be written, interrupts.

Full disks are tested together with the writing of files, in tests/viscorough/io/test_netcdf.py.
"""

import contextlib
import os
import shlex
import subprocess
import time

import click
import numpy as np
import pytest

import viscorough
from support.command_line import VISCOROUGH, sphere_heights
from support.curves import random_curve
from support.faults import contents, no_privileges
from viscorough.cli import files
from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset

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


@pytest.mark.parametrize("redirection", [">&- 2>&- <&-", ">/dev/full"])
def test_complete_output_is_success_with_a_closed_output_stream(redirection):
    assert shell(f"viscorough {KINETICS} {redirection}")[:2] == (0, "")
    assert "time" in read_dataset("out.nc").variables, "not the older one"


# ---- interrupts and warnings


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
