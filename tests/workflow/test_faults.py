"""Faults of files and disks under the workflow, and two runs in one folder."""

import re
import shutil
import signal
import subprocess
import sys
import time

import pytest

from support.faults import DAMAGES, NO_LARGE_FILES, contents
from support.workflow import HANGS, TEST, command, copy_project, environment, made_once, settings_file, snakemake
from viscorough.io import netcdf

SETTINGS = (*TEST, "faults.yaml")
TARGET = "results/ensembles/lines.nc"
CURVES = "results/curves/lines/h04000/0000-0001.nc"
NEW = "results/curves/lines/sizes/0000-0001.nc"  # not needed for the target


@pytest.fixture
def lines(tmp_path_factory, tmp_path):
    """A project in which one pool of lines has been made."""

    def make(folder):
        copy_project(folder)
        grid = {"points": 4096, "realizations": 2}
        settings_file(folder, "faults", discs={"hurst": [0.4]}, lines={"hurst": [0.4]}, sizes={"lines": [grid]})
        snakemake(folder, *SETTINGS, "--", TARGET)

    return shutil.copytree(made_once(tmp_path_factory, "lines", make), tmp_path / "lines")


# ---- full disk


def test_workflow_on_a_full_disk_goes_on_when_there_is_room(lines):
    """The sources, which Snakemake copies, are small enough, curves are not."""
    before = contents(lines / "results")
    arguments = [sys.executable, "-c", NO_LARGE_FILES, "40000", *command(*SETTINGS, "--", NEW)]
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "timeout": HANGS}
    done = subprocess.run(arguments, cwd=lines, env=environment(lines), check=False, **options)
    assert done.returncode == 1
    assert f"ERROR OSError: {NEW}: not written (" in done.stdout
    assert contents(lines / "results") == before
    snakemake(lines, *SETTINGS, "--", NEW)
    assert netcdf.read(lines / NEW).variables["levels"].values.size == 2


# ---- damaged files


def test_damaged_input_of_a_rule_is_named_and_can_be_made_again(lines):
    before = contents(lines)
    (lines / CURVES).write_bytes(DAMAGES["second half zeros"](before[CURVES]))
    damaged = contents(lines / "results/curves")
    output = snakemake(lines, *SETTINGS, "--forcerun", "aggregate_curves", "--", TARGET, fails=True)
    assert re.search("ERROR (.*)", output)[1].startswith(f"ValueError: {CURVES}: not readable (")
    assert contents(lines / "results/curves") == damaged
    assert not (lines / TARGET).exists()
    (lines / CURVES).unlink()
    snakemake(lines, *SETTINGS, "--", TARGET)
    assert contents(lines / "results") == {
        name.removeprefix("results/"): content for name, content in before.items() if name.startswith("results/")
    }


# ---- two runs


def test_second_run_in_a_folder_ends_and_the_first_is_not_disturbed(lines):
    before = contents(lines / "results")
    arguments = command(*SETTINGS, "--forceall", "--", TARGET)
    options = {"cwd": lines, "env": environment(lines), "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    with subprocess.Popen(arguments, text=True, **options) as first:
        try:
            deadline = time.monotonic() + HANGS
            while not list((lines / ".snakemake/locks").glob("*")):
                assert time.monotonic() < deadline, "the first run does not lock its folder"
                time.sleep(0.01)
            first.send_signal(signal.SIGSTOP)  # it holds its lock while the second run starts, however long that takes
            output = snakemake(lines, *SETTINGS, "--forceall", "--", TARGET, fails=True)
            first.send_signal(signal.SIGCONT)
            assert first.poll() is None, "else it had not been a second run"
            finished, _ = first.communicate(timeout=HANGS)
        finally:
            first.terminate()
            first.send_signal(signal.SIGCONT)
    assert "Error: Directory cannot be locked." in output
    assert "Traceback" not in output
    assert first.returncode == 0, finished
    assert contents(lines / "results") == before


# ---- settings


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("# nothing\n", "Config file must be given as JSON or YAML with keys at top level."),
        ("discs: {hurst: [0.4\n", "Config file is not valid JSON or YAML."),
        ("discs: {elemnts: 33}\n", "unknown key 'elemnts' in discs; did you mean elements?"),
    ],
    ids=["empty", "broken", "misspelt"],
)
def test_wrong_settings_are_one_line_without_a_traceback(unmade, tmp_path, content, message):
    (tmp_path / "mine.yaml").write_text(content)
    output = snakemake(unmade, "--dry-run", "--configfile", tmp_path / "mine.yaml", fails=True)
    assert message in output.rstrip().splitlines()[-1]
    assert "Traceback" not in output
    assert (
        len(output.splitlines()) <= 3
    )  # besides it: which profile is in use, and "WorkflowError:" by Snakemake itself
