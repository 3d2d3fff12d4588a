"""Faults of files under the command line: damaged files, places and streams that cannot be written.

Full disks are tested where files are written, in tests/viscorough/io/test_netcdf.py.
"""

import logging
import os
import runpy
import shlex
import shutil
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest

from support.command_line import VISCOROUGH, python, run, sphere_heights
from support.curves import random_curve
from support.faults import DAMAGES, contents, no_privileges
from viscorough import load_curve
from viscorough.io import netcdf

INDENT = "indent heights.npy --spacing 1 -o out.nc"
KINETICS = "kinetics curve.nc --force 1 --viscosity 1 -o out.nc"


@pytest.fixture(autouse=True)
def here(here):
    """Folder with heights.npy, curve.nc and an older out.nc, which must not be changed."""
    np.save("heights.npy", sphere_heights(9))
    for name in ("curve.nc", "out.nc"):
        random_curve(length_unit="1").save(name)
    return here


# ---- damaged files


@pytest.mark.parametrize("damage", DAMAGES)
def test_damaged_curve_is_named(here, complaint, damage):
    whole = (here / "curve.nc").read_bytes()
    (here / "curve.nc").write_bytes(DAMAGES[damage](whole))
    assert "viscorough kinetics: curve.nc: not readable (" in complaint(KINETICS)


@pytest.mark.parametrize("suffix", ["nbi", "nbc"])
def test_damaged_compiled_code_is_compiled_again(here, caplog, monkeypatch, suffix):
    monkeypatch.setattr("numba.core.config.CACHE_DIR", str(here / "cache"))
    (here / "ours.py").write_text("from viscorough.compilation import njit\n@njit\ndef double(x):\n    return 2 * x\n")

    def messages():
        """What is logged when the function is loaded, or compiled, and run."""
        caplog.clear()
        assert runpy.run_path("ours.py")["double"](2.0) == 4
        return [record.getMessage() for record in caplog.records if record.levelno >= logging.WARNING]

    assert messages() == []
    (file,) = here.glob(f"cache/**/*.{suffix}")
    whole = file.read_bytes()
    for damage in [*DAMAGES.values(), lambda whole: b""]:
        file.write_bytes(damage(whole))
        lines = messages()
        assert len(lines) <= 1, "damage to the version stamp in the index means another version, without a message"
        assert all("is damaged" in line and "compiled again" in line for line in lines)
        assert messages() == [], "the function that was compiled again is cached"
        assert file.stat().st_size > len(whole) // 2
    assert lines, "an empty file is damaged"


# ---- places that cannot be written


def test_folder_that_may_not_be_written(here):
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
    """(exit code, stderr, stdout) of a line of a shell that runs `viscorough`."""
    line = line.replace("viscorough", str(VISCOROUGH))
    options = {"capture_output": True, "text": True, "timeout": 60, "check": False, "env": os.environ | environment}
    done = subprocess.run(["bash", "-o", "pipefail", "-c", line], **options)
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    return done.returncode, done.stderr, done.stdout


WRITING = "viscorough indent heights.npy --spacing 1 -o new.nc"
FULL = "standard output cannot be written (No space left on device)\n"
UNREAD = f"viscorough indent: warning: new.nc is complete, but {FULL}"


@pytest.mark.parametrize(
    ("redirection", "warning"),
    [(">&- 2>&- <&-", ""), ("| true", ""), (">/dev/full 2>/dev/full", ""), (">/dev/full", UNREAD)],
)
def test_complete_output_is_success_whoever_reads_the_closing_line(redirection, warning):
    assert shell(f"{WRITING} {redirection}")[:2] == (0, warning)
    assert load_curve("new.nc").depth.size


def test_names_that_the_encoding_of_standard_output_lacks(here):
    shutil.copy("heights.npy", "ψ.npy")
    code, error, output = shell("viscorough indent ψ.npy --spacing 1 -o ω.nc", PYTHONIOENCODING="latin-1")
    assert (code, error) == (0, "")
    assert output.startswith("\\u03c9.nc: ")
    assert netcdf.read("ω.nc").attributes["heights"] == "ψ.npy"


def test_names_of_files_that_are_no_text(here):
    name = os.fsdecode(b"caf\xe9")
    shutil.copy("heights.npy", f"{name}.npy")
    shutil.copy("curve.nc", f"{name}.nc")
    assert run(f"indent '{name}.npy' --spacing 1 -o new.nc") == 0
    assert netcdf.read("new.nc").attributes["heights"] == r"caf\udce9.npy"
    code, error, output = shell(f"viscorough {KINETICS.replace('curve', name)}")
    assert (code, output, len(error.splitlines())) == (2, "", 1)
    assert error.startswith(r"viscorough kinetics: caf\udce9.nc: not readable (")


def test_help_for_a_reader_who_has_read_enough():
    assert shell("viscorough indent --help | true")[:2] == (0, "")
    code, error, _ = shell("viscorough indent --help >/dev/full")
    assert code == 2
    assert error.endswith(FULL)
    assert len(error.splitlines()) == 1


@pytest.mark.parametrize("redirection", ["2>/dev/full", "2>&-", "2>&1 | true"])
def test_mistakes_that_nobody_reads_keep_their_exit_code(redirection):
    assert shell(f"viscorough indent {redirection}")[0] == 2


# ---- interrupts and warnings


INTERRUPTED = "import os, signal; os.kill(os.getpid(), signal.SIGINT)"


@pytest.mark.parametrize(
    ("command", "module"), [([VISCOROUGH], "click"), ([sys.executable, "-m", "viscorough"], "numpy")]
)
def test_interrupt_during_the_imports_is_quiet(here, tmp_path_factory, command, module):
    """The first import of the command line, and one of a command."""
    folder = tmp_path_factory.mktemp("interrupted")
    (folder / f"{module}.py").write_text(INTERRUPTED)
    environment = os.environ | {"PYTHONPATH": str(folder)}
    options = {"env": environment, "capture_output": True, "check": False, "preexec_fn": interrupts_arrive}
    done = subprocess.run([*command, *INDENT.split()], **options)
    assert (done.stdout, done.stderr) == (b"", b"")
    assert done.returncode == -signal.SIGINT, "a shell reports 130"


def interrupts_arrive():
    """A process started in the background would ignore them."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.mark.parametrize(
    ("heights", "code", "line"),
    [(sphere_heights(9), 0, ""), (100 * sphere_heights(9), 2, "viscorough indent: heights.npy: the rms slope is ")],
    ids=["gentle", "steep"],
)
def test_warnings_that_are_errors_are_one_line(here, heights, code, line):
    np.save("heights.npy", heights)
    done = shell(WRITING, PYTHONWARNINGS="error")
    assert done[0] == code
    assert done[1].startswith(line)
    assert len(done[1].splitlines()) == bool(line)
    assert (here / "new.nc").exists() == (code == 0)


def test_file_that_cannot_be_opened_in_time_is_one_line():
    """Damage can make the HDF5 library run without end; here nothing happens in a context that stands for it."""
    script = textwrap.dedent("""
        import time
        import click
        from viscorough.cli import files
        with click.Context(click.Command("kinetics"), info_name="viscorough kinetics"):
            with files.time_limit("a.nc"):
                pass
            files.LONGEST = 0.1
            with files.time_limit("b.nc"):
                time.sleep(30)
    """)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=20, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("viscorough kinetics: b.nc: not opened within 0.1 s")
    assert len(done.stderr.splitlines()) == 1


# Commands that read FILE, by its suffix.
MEDIUM = "kinetics curve.nc --force 1 -o out.nc --medium"
HISTORY = "kinetics curve.nc --viscosity 1 -o out.nc --force-history FILE"
READING = {
    ".nc": [KINETICS.replace("curve.nc", "FILE"), "indent FILE -o out.nc", "plot FILE -o out.png"],
    ".csv": [HISTORY, f"{MEDIUM} of_FILE.yaml"],
    ".npy": ["indent FILE -o out.nc", "reduce FILE -o out.nc", HISTORY, f"{MEDIUM} of_FILE.yaml"],
    ".yaml": [f"{MEDIUM} FILE"],
}


def test_what_is_no_regular_file_is_refused(here):
    """Opening a pipe would wait for somebody to write into it, and a device may have no end."""
    commands, wanted = [], []
    for suffix, lines in READING.items():
        os.mkfifo(f"pipe{suffix}")
        Path(f"device{suffix}").symlink_to("/dev/zero")
        Path(f"folder{suffix}").mkdir()
        for kind in ("pipe", "device", "folder"):
            name = f"{kind}{suffix}"
            Path(f"of_{name}.yaml").write_text(f"{{kind: creep_table, file: {name}}}")
            commands += [line.replace("FILE", name).split() for line in lines]
            wanted += [f"{name}: not readable (it is a {kind}); a regular file is needed"] * len(lines)
    done = python("-c", f"from viscorough.cli import main; assert {{main(line) for line in {commands}}} == {{2}}")
    assert done.stdout == ""
    for line, text in zip(done.stderr.splitlines(), wanted, strict=True):
        assert text in line
