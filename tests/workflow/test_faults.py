"""Real faults, with real files and processes: full disks, damaged files, places that cannot be written, two runs."""

import os
import re
import shutil
import subprocess
import sys
import time

import numpy as np
import pytest

from support.command_line import VISCOROUGH, sphere_heights
from support.workflow import TEST, command, copy_project, environment, snakemake
from viscorough.io.datasets import read_dataset

TARGET = "results/ensembles/lines/h04000.nc"
CURVES = "results/curves/lines/h04000/0000-0001.nc"
INDENT = ["indent", "heights.npy", "--spacing", "1", "-o", "out.nc"]
KINETICS = ["kinetics", "curve.nc", "--force", "1", "--viscosity", "1", "-o", "out.nc"]
NEW_FOLDER = "results/curves/lines/h09000"  # that `CURVES` of another exponent would need

# Fails in the middle of writing a file, as a full disk does.
NO_LARGE_FILES = "import os, resource, sys; size = int(sys.argv[1]); "
NO_LARGE_FILES += "resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)); os.execv(sys.argv[2], sys.argv[2:])"
# A disk of its own, with so many bytes left on it.
FULL_DISK = """
mount -t tmpfs -o size=100k none disk && cp heights.npy curve.nc out.nc disk && cd disk || exit 77
head -c "$1" /dev/zero > room; head -c 1000000 /dev/zero > rest 2> /dev/null; rm room; shift
"$@"; code=$?
cmp out.nc ../out.nc && test "$(ls -A | tr '\\n' ' ')" = "curve.nc heights.npy out.nc rest " || exit 78
exit $code
"""
DAMAGES = {
    "truncated": lambda whole: whole[: len(whole) // 2],
    "bit in the header": lambda whole: whole[:36] + bytes([whole[36] ^ 1]) + whole[37:],
    "half of it zeros": lambda whole: whole[: len(whole) // 2] + bytes(len(whole) - len(whole) // 2),
}


# ---- helpers


@pytest.fixture(scope="module")
def indented(tmp_path_factory):
    """Folder with heights.npy and curve.nc."""
    folder = tmp_path_factory.mktemp("indented")
    np.save(folder / "heights.npy", sphere_heights(9))
    subprocess.run([VISCOROUGH, *INDENT[:-1], "curve.nc"], cwd=folder, capture_output=True, check=True)
    return folder


@pytest.fixture
def here(indented, tmp_path):
    """A folder of the same, and an older out.nc that nothing may harm."""
    for name in ("heights.npy", "curve.nc"):
        shutil.copy(indented / name, tmp_path)
    shutil.copy(indented / "curve.nc", tmp_path / "out.nc")
    return tmp_path


@pytest.fixture(scope="module")
def lines(tmp_path_factory):
    """A project in which one ensemble of lines has been made. Tests must leave it as it was."""
    folder = copy_project(tmp_path_factory.mktemp("lines"))
    snakemake(folder, *TEST, "--", TARGET)
    return folder


@pytest.fixture
def no_privileges():
    """What to put before a command so that permissions hold for it, which they do not for root."""
    return [] if os.geteuid() else namespace("--user")


def namespace(*options):
    """What to put before a command for namespaces of its own; skips where the system has none."""
    unshare = ["unshare", *options]
    if not shutil.which("unshare") or subprocess.run([*unshare, "true"], capture_output=True, check=False).returncode:
        pytest.skip("needs user namespaces")
    return unshare


def contents(folder):
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and not {"logs", "benchmarks"} & set(path.parts)
    }


def complaint(folder, *arguments):
    """The one line of a command that fails and changes no file."""
    before = contents(folder)
    done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stdout) == (2, ""), done.stderr
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert contents(folder) == before
    return done.stderr


def failure(folder, *arguments, before=()):
    """What a workflow shows that fails."""
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "timeout": 120}
    arguments = [*before, *command(*TEST, *arguments)]
    done = subprocess.run(arguments, cwd=folder, env=environment(folder), check=False, **options)
    assert done.returncode == 1, done.stdout
    return done.stdout.rstrip()


# ---- full disk


@pytest.mark.parametrize("size", [100, 8000])
def test_full_disk_leaves_the_older_file(here, size):
    line = complaint(here, sys.executable, "-c", NO_LARGE_FILES, str(size), VISCOROUGH, *INDENT)
    assert line.startswith("viscorough indent: out.nc: not written (")


@pytest.mark.parametrize("arguments", [INDENT, KINETICS], ids=["indent", "kinetics"])
@pytest.mark.parametrize("room", [0, 8192])
def test_disk_that_is_really_full(here, arguments, room):
    unshare = namespace("--user", "--map-root-user", "--mount")
    (here / "disk").mkdir()
    line = complaint(here, *unshare, "sh", "-c", FULL_DISK, "sh", str(room), VISCOROUGH, *arguments)
    assert line.startswith(f"viscorough {arguments[0]}: out.nc: not written (")
    assert "room on a writable disk is needed" in line


def test_workflow_on_a_full_disk_goes_on_when_there_is_room(lines):
    """The sources, which Snakemake copies, are small enough, curves are not."""
    before = contents(lines / "results")
    target = CURVES.replace("h04000", "h09000")
    shown = failure(lines, "--", target, before=[sys.executable, "-c", NO_LARGE_FILES, "40000"])
    assert f"ERROR OSError: {target}: not written (" in shown
    assert contents(lines / "results") == before
    snakemake(lines, *TEST, "--", target)
    assert read_dataset(lines / target).sizes["realization"] == 2
    shutil.rmtree(lines / NEW_FOLDER)
    assert contents(lines / "results") == before


# ---- damaged files


@pytest.mark.parametrize("damage", DAMAGES)
def test_damaged_curve_is_named(here, damage):
    whole = (here / "curve.nc").read_bytes()
    (here / "curve.nc").write_bytes(DAMAGES[damage](whole))
    assert complaint(here, VISCOROUGH, *KINETICS).startswith("viscorough kinetics: curve.nc: not readable (")


def test_damaged_input_of_a_rule_is_named_and_can_be_made_again(lines):
    before = contents(lines)
    for damage in DAMAGES.values():
        (lines / CURVES).write_bytes(damage(before[CURVES]))
        damaged = contents(lines / "results/curves")
        shown = failure(lines, "--forcerun", "aggregate_lines", "--", TARGET)
        assert re.search("ERROR (.*)", shown)[1].startswith(f"ValueError: {CURVES}: not readable (")
        assert contents(lines / "results/curves") == damaged
        assert not (lines / TARGET).exists()
    (lines / CURVES).unlink()
    snakemake(lines, *TEST, "--", TARGET)
    assert contents(lines / "results") == {
        name.removeprefix("results/"): content for name, content in before.items() if name.startswith("results/")
    }


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
        found, lines = run()
        assert found == expected
        assert len(lines) <= 1, "a bit of the stamp in the index is that of another version"
        assert all("is damaged" in line and "compiled again" in line for line in lines)
        assert run() == (expected, []), "what was compiled again is kept"
    file.write_bytes(b"")
    assert "is damaged" in run()[1][0]


# ---- two runs


def test_second_run_in_a_folder_ends_and_the_first_is_not_disturbed(lines):
    before = contents(lines / "results")
    arguments = command(*TEST, "--forceall", "--", TARGET)
    options = {"cwd": lines, "env": environment(lines), "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    with subprocess.Popen(arguments, text=True, **options) as first:
        try:
            deadline = time.monotonic() + 60
            while not list((lines / ".snakemake/locks").glob("*")):
                assert time.monotonic() < deadline
                time.sleep(0.01)
            shown = failure(lines, "--forceall", "--", TARGET)
            assert first.poll() is None, "else it had not been a second run"
            finished, _ = first.communicate(timeout=120)
        finally:
            first.terminate()
    assert "Error: Directory cannot be locked." in shown
    assert "Traceback" not in shown
    assert first.returncode == 0, finished
    assert contents(lines / "results") == before


# ---- places that cannot be written


def test_folder_that_may_not_be_written(here, no_privileges):
    here.chmod(0o555)
    try:
        line = complaint(here, *no_privileges, VISCOROUGH, *INDENT)
    finally:
        here.chmod(0o755)
    assert line == "viscorough indent: out.nc: the folder . is not writable; a writable folder is needed\n"


def test_file_in_the_place_of_a_folder(here):
    line = complaint(here, VISCOROUGH, *INDENT[:-1], "curve.nc/out.nc")
    assert "curve.nc/out.nc: there is no folder curve.nc" in line


def test_results_that_may_not_be_written(lines, no_privileges):
    before = contents(lines / "results")
    (lines / NEW_FOLDER).parent.chmod(0o555)
    try:
        shown = failure(lines, "--", f"{NEW_FOLDER}/0000-0001.nc", before=no_privileges)
    finally:
        (lines / NEW_FOLDER).parent.chmod(0o755)
    assert shown.endswith(f"Permission denied: '{NEW_FOLDER}'")
    assert "Traceback" not in shown
    assert contents(lines / "results") == before


def test_file_in_the_place_of_a_folder_of_results(lines):
    """Snakemake's own error, before the workflow is asked: its last line says where."""
    (lines / NEW_FOLDER).write_text("something else\n")
    before = contents(lines / "results")
    shown = failure(lines, "--", f"{NEW_FOLDER}/0000-0001.nc")
    assert f"Not a directory: '{NEW_FOLDER}" in shown.splitlines()[-1]
    assert contents(lines / "results") == before
    (lines / NEW_FOLDER).unlink()


# ---- settings that are none; what is wrong inside settings is in test_workflow.py


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "No such file or directory: 'mine.yaml'"),
        ("- discs\n- lines\n", "Config file must be given as JSON or YAML with keys at top level."),
        ("discs: {hurst: [0.4\n", "Config file is not valid JSON or YAML."),
    ],
    ids=["missing", "list", "broken"],
)
def test_settings_that_are_none(lines, content, message):
    before = contents(lines / "results")
    if content:
        (lines / "mine.yaml").write_text(content)
    shown = failure(lines, "--configfile", "mine.yaml")
    assert message in shown.splitlines()[-1]
    assert contents(lines / "results") == before
    (lines / "mine.yaml").unlink(missing_ok=True)
