"""Faults of files and disks under the command line: full disks, damaged files, places that cannot be written."""

import os
import shutil
import signal
import subprocess
import sys
import textwrap

import numpy as np
import pytest

from support.command_line import VISCOROUGH, sphere_heights
from support.faults import DAMAGES, NO_LARGE_FILES, contents, namespace, no_privileges
from viscorough.io import netcdf
from viscorough.io.curves import curve_from_content

INDENT = ["indent", "heights.npy", "--spacing", "1", "-o", "out.nc"]
KINETICS = ["kinetics", "curve.nc", "--force", "1", "--viscosity", "1", "-o", "out.nc"]

# Runs a command on a separate disk on which the given number of bytes is free.
FULL_DISK = """
mount -t tmpfs -o size=100k none disk && cp heights.npy curve.nc out.nc disk && cd disk || exit 77
head -c "$1" /dev/zero > room; head -c 1000000 /dev/zero > rest 2> /dev/null; rm room; shift
"$@"; code=$?
cmp out.nc ../out.nc && test "$(ls -A | tr '\\n' ' ')" = "curve.nc heights.npy out.nc rest " || exit 78
exit $code
"""


@pytest.fixture(scope="module")
def indented(tmp_path_factory):
    """Folder with heights.npy and curve.nc."""
    folder = tmp_path_factory.mktemp("indented")
    np.save(folder / "heights.npy", sphere_heights(9))
    subprocess.run([VISCOROUGH, *INDENT[:-1], "curve.nc"], cwd=folder, capture_output=True, check=True)
    return folder


@pytest.fixture
def here(indented, tmp_path):
    """A folder with these files and an older out.nc, which must not be changed."""
    for name in ("heights.npy", "curve.nc"):
        shutil.copy(indented / name, tmp_path)
    shutil.copy(indented / "curve.nc", tmp_path / "out.nc")
    return tmp_path


def complaint(folder, *arguments):
    """The one line on stderr of a command that fails and changes no file."""
    before = contents(folder)
    done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stdout) == (2, ""), done.stderr
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert contents(folder) == before
    return done.stderr


# ---- full disk


@pytest.mark.parametrize("size", [100, 8000])
def test_full_disk_leaves_the_older_file(here, size):
    line = complaint(here, sys.executable, "-c", NO_LARGE_FILES, str(size), VISCOROUGH, *INDENT)
    assert line == "viscorough indent: out.nc: not written (File too large); room on a writable disk is needed\n"


@pytest.mark.parametrize("arguments", [INDENT, KINETICS], ids=["indent", "kinetics"])
@pytest.mark.parametrize("room", [0, 4096, 8192])
def test_full_disk_in_a_namespace(here, arguments, room):
    unshare = namespace("--user", "--map-root-user", "--mount")
    (here / "disk").mkdir()
    line = complaint(here, *unshare, "sh", "-c", FULL_DISK, "sh", str(room), VISCOROUGH, *arguments)
    reason = "No space left on device"
    assert line == f"viscorough {arguments[0]}: out.nc: not written ({reason}); room on a writable disk is needed\n"


# ---- damaged files


@pytest.mark.parametrize("damage", DAMAGES)
def test_damaged_curve_is_named(here, damage):
    whole = (here / "curve.nc").read_bytes()
    (here / "curve.nc").write_bytes(DAMAGES[damage](whole))
    assert complaint(here, VISCOROUGH, *KINETICS).startswith("viscorough kinetics: curve.nc: not readable (")


REDUCE = """
import sys, numpy as np
from viscorough import Indenter, reduce
print(reduce(Indenter(np.load(sys.argv[1])[4], 1.0)).force[-1])
"""


@pytest.mark.parametrize("suffix", ["nbi", "nbc"])
def test_damaged_compiled_code_is_compiled_again(here, suffix):
    def run():
        options = {"capture_output": True, "text": True, "check": True, "timeout": 60}
        cache = os.environ | {"NUMBA_CACHE_DIR": str(here / "cache")}
        done = subprocess.run([sys.executable, "-c", REDUCE, "heights.npy"], cwd=here, env=cache, **options)
        return done.stdout, done.stderr.splitlines()

    expected, _ = run()
    (file,) = here.glob(f"cache/**/*.{suffix}")
    whole = file.read_bytes()
    for damage in DAMAGES.values():
        file.write_bytes(damage(whole))
        output, lines = run()
        assert output == expected
        assert len(lines) <= 1, "damage to the version stamp in the index means another version, without a message"
        assert all("is damaged" in line and "compiled again" in line for line in lines)
        assert run() == (expected, []), "the function that was compiled again is cached"
    file.write_bytes(b"")
    assert "is damaged" in run()[1][0]


# ---- places that cannot be written


def test_folder_that_may_not_be_written(here):
    here.chmod(0o555)
    try:
        line = complaint(here, *no_privileges(), VISCOROUGH, *INDENT)
    finally:
        here.chmod(0o755)
    assert line == "viscorough indent: out.nc: the folder . is not writable; a writable folder is needed\n"


def test_file_in_the_place_of_a_folder(here):
    line = complaint(here, VISCOROUGH, *INDENT[:-1], "curve.nc/out.nc")
    assert "curve.nc/out.nc: there is no folder curve.nc" in line


# ---- standard output and standard error that cannot be written


def shell(folder, command, **environment):
    """Exit code and stderr of `viscorough` with the arguments and redirections of a line of a shell."""
    line = command.replace("viscorough", str(VISCOROUGH))
    options = {"capture_output": True, "text": True, "timeout": 60, "check": False, "env": os.environ | environment}
    done = subprocess.run(["bash", "-o", "pipefail", "-c", line], cwd=folder, **options)
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    return done.returncode, done.stderr, done.stdout


WRITING = "viscorough indent heights.npy --spacing 1 -o new.nc"


@pytest.mark.parametrize("redirection", ["", ">&-", "2>&-", ">&- 2>&- <&-", "| true", ">/dev/full 2>/dev/full"])
def test_complete_output_is_success_whoever_reads_the_closing_line(here, redirection):
    code, error, _ = shell(here, f"{WRITING} {redirection}")
    assert (code, error) == (0, "")
    assert curve_from_content(netcdf.read(here / "new.nc")).depth.size


def test_full_standard_output_is_a_warning(here):
    code, error, _ = shell(here, f"{WRITING} >/dev/full")
    assert code == 0
    assert error == (
        "viscorough indent: warning: new.nc is complete, but standard output cannot be written "
        "(No space left on device)\n"
    )
    assert curve_from_content(netcdf.read(here / "new.nc")).depth.size


def test_names_that_the_encoding_of_standard_output_lacks(here):
    shutil.copy(here / "heights.npy", here / "ψ.npy")
    command = "viscorough indent ψ.npy --spacing 1 -o ω.nc"
    code, error, output = shell(here, command, PYTHONIOENCODING="latin-1")
    assert (code, error) == (0, "")
    assert output.startswith("\\u03c9.nc: ")
    assert netcdf.read(here / "ω.nc").attributes["heights"] == "ψ.npy"
    code, error, _ = shell(here, f"{command}/new.nc", PYTHONIOENCODING="latin-1")
    assert code == 2
    assert error.startswith("viscorough indent: \\u03c9.nc/new.nc: there is no folder")


def test_names_of_files_that_are_no_text(here):
    name = os.fsdecode(b"caf\xe9")
    shutil.copy(here / "heights.npy", here / f"{name}.npy")
    shutil.copy(here / "curve.nc", here / f"{name}.nc")
    heights = ["indent", f"{name}.npy", "--spacing", "1", "-o"]
    done = subprocess.run([VISCOROUGH, *heights, "new.nc"], cwd=here, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    assert netcdf.read(here / "new.nc").attributes["heights"] == r"caf\udce9.npy"
    assert "the name is no text" in complaint(here, VISCOROUGH, *heights, f"{name}.nc")
    kinetics = ["kinetics", f"{name}.nc", *KINETICS[2:]]
    assert complaint(here, VISCOROUGH, *kinetics).startswith(r"viscorough kinetics: caf\udce9.nc: not readable (")


@pytest.mark.parametrize("arguments", ["--help", "indent --help", "--version"])
def test_help_for_a_reader_who_has_read_enough(here, arguments):
    assert shell(here, f"viscorough {arguments} | true")[:2] == (0, "")
    code, error, _ = shell(here, f"viscorough {arguments} >/dev/full")
    assert code == 2
    assert error.endswith("standard output cannot be written (No space left on device)\n")
    assert len(error.splitlines()) == 1


@pytest.mark.parametrize("redirection", ["2>/dev/full", "2>&-", "2>&1 | true"])
def test_mistakes_that_nobody_reads_keep_their_exit_code(here, redirection):
    assert shell(here, f"viscorough indent {redirection}")[0] == 2


# ---- interrupts and warnings


INTERRUPTED = "import os, signal; os.kill(os.getpid(), signal.SIGINT)"


@pytest.mark.parametrize("command", [[VISCOROUGH], [sys.executable, "-m", "viscorough"]], ids=["script", "module"])
@pytest.mark.parametrize("module", ["click", "numpy", "psutil"])
def test_interrupt_during_the_imports_is_quiet(here, tmp_path_factory, command, module):
    """The first import of the command line, and one of a command."""
    folder = tmp_path_factory.mktemp("interrupted")
    (folder / f"{module}.py").write_text(INTERRUPTED)
    environment = os.environ | {"PYTHONPATH": str(folder)}
    done = subprocess.run(
        [*command, *INDENT], cwd=here, env=environment, capture_output=True, check=False, preexec_fn=interrupts_arrive
    )
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
    np.save(here / "heights.npy", heights)
    done = shell(here, WRITING, PYTHONWARNINGS="error")
    assert done[0] == code
    assert done[1].startswith(line)
    assert len(done[1].splitlines()) == bool(line)
    assert (here / "new.nc").exists() == (code == 0)


def test_file_that_cannot_be_opened_in_time_is_one_line():
    """Damage can make the HDF5 library run without end; here nothing happens in a context that stands for it."""
    script = textwrap.dedent("""
        import time
        import click
        from viscorough.cli.files import time_limit
        with click.Context(click.Command("kinetics"), info_name="viscorough kinetics"):
            with time_limit("a.nc", 5):
                pass
            with time_limit("b.nc", 0.1):
                time.sleep(30)
    """)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=20, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("viscorough kinetics: b.nc: not opened within 0.1 s")
    assert len(done.stderr.splitlines()) == 1


# Commands that read FILE, by its suffix.
READING = {
    ".nc": [["kinetics", "FILE", *KINETICS[2:]], ["indent", "FILE", *INDENT[2:]], ["plot", "FILE", "-o", "out.png"]],
    ".csv": [
        ["kinetics", "FILE", *KINETICS[2:]],
        ["kinetics", "curve.nc", "--force-history", "FILE", *KINETICS[4:]],
        ["kinetics", "curve.nc", "--force", "1", "--medium", "of.csv.yaml", "-o", "out.nc"],
    ],
    ".npy": [
        ["indent", "FILE", *INDENT[2:]],
        ["reduce", "FILE", *INDENT[2:]],
        ["kinetics", "curve.nc", "--force-history", "FILE", *KINETICS[4:]],
        ["kinetics", "curve.nc", "--force", "1", "--medium", "of.npy.yaml", "-o", "out.nc"],
    ],
    ".yaml": [["kinetics", "curve.nc", "--force", "1", "--medium", "FILE", "-o", "out.nc"]],
}


@pytest.mark.parametrize("suffix", READING)
def test_what_is_no_regular_file_is_refused(here, suffix):
    """Opening a pipe would wait for somebody to write into it, and a device may have no end."""
    os.mkfifo(here / f"pipe{suffix}")
    (here / f"device{suffix}").symlink_to("/dev/zero")
    (here / f"folder{suffix}").mkdir()
    for kind in ("pipe", "device", "folder"):
        name, script = f"{kind}{suffix}", "import sys; from viscorough.cli import main"
        (here / f"of{suffix}.yaml").write_text(f"{{kind: creep_table, file: {name}}}")
        commands = [[word.replace("FILE", name) for word in command] for command in READING[suffix]]
        script += "".join(f"; assert main({command}) == 2" for command in commands)
        command = [sys.executable, "-c", script]
        done = subprocess.run(command, cwd=here, capture_output=True, text=True, timeout=60, check=False)
        assert (done.returncode, done.stdout) == (0, ""), done.stderr
        lines = done.stderr.splitlines()
        assert len(lines) == len(commands)
        assert all(f"{name}: not readable (it is a {kind}); a regular file is needed" in line for line in lines), lines
