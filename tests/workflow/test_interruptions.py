"""Runs that are interrupted or killed, through make as its users do, and go on when the same command is typed again."""

import os
import shutil
import signal
import subprocess
import sys
import time

import pytest
import xarray as xr

from support.workflow import HANGS, ROOT, copy_project, environment, merged, read_settings, settings_file

LONG = {
    "discs": {"hurst": [0.9], "realizations": 2, "combinations": read_settings("config")["discs"]["combinations"][:1]},
    "lines": {"hurst": [0.9], "points": 16384, "realizations": 40, "batch": 20},
    "variants": {"cases": []},
}
LINES = [f"results/curves/lines/h09000/{batch}.nc" for batch in ("0000-0019", "0020-0039")]
POOL = "results/ensembles/lines.nc"
GOES_ON = "The last run in this folder was killed: its lock is removed, its results are kept."


@pytest.fixture
def folder(tmp_path):
    """A project whose `make reproduce` and `make paper` make one small ensemble."""
    folder = copy_project(tmp_path)
    for name in ("benchmarks", "peers"):
        shutil.copytree(ROOT / name, folder / name)
    makefile = (ROOT / "Makefile").read_text()
    assert makefile.count(" all\n") == 2
    (folder / "Makefile").write_text(makefile.replace(" all\n", f" {POOL}\n"))
    small = merged(merged(read_settings("config"), read_settings("test")), LONG)
    for name in ("config", "paper"):
        settings_file(folder / "config", name, **small)
    return folder


def make(folder, target):
    """Start `make <target>` in its own group of processes, as a terminal does."""
    runner = f"{sys.executable} -m snakemake --cores 1 --nocolor"
    options = {"cwd": folder, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    return subprocess.Popen(
        ["make", "-o", "environment", f"BIN={os.path.dirname(sys.executable)}", f"SNAKEMAKE={runner}", target],
        env=environment(folder),
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # the tests may run where it is ignored
        **options,
    )


def wait_until(reached, run):
    deadline = time.monotonic() + HANGS
    while not reached():
        assert time.monotonic() < deadline, "the run does not begin its second batch"
        assert run.poll() is None, run.communicate()[0]
        time.sleep(0.02)


def interrupted(folder, target, signal_number):
    """Outputs of `make <target>` that is sent a signal while it makes its second batch, and that is typed again."""
    with make(folder, target) as run:
        wait_until(lambda: len(list((folder / "results/logs/reduce_lines/h09000").glob("*.log"))) == 2, run)
        os.killpg(run.pid, signal_number)
        first, _ = run.communicate(timeout=HANGS)
    assert run.returncode != 0
    done = {path: (folder / path).stat().st_mtime_ns for path in LINES if (folder / path).exists()}
    assert done
    assert not (folder / POOL).exists()
    locked = list((folder / ".snakemake/locks").glob("*"))
    assert bool(locked) == (signal_number == signal.SIGKILL), first
    with make(folder, target) as run:
        second, _ = run.communicate(timeout=HANGS)
    assert run.returncode == 0, second
    assert {path: (folder / path).stat().st_mtime_ns for path in done} == done, "what was made is kept"
    with xr.open_dataset(folder / POOL) as pool:
        assert pool.sizes["realization"] == 40
    assert not list((folder / "results").rglob("*.part"))
    return first, second


def test_killed_reproduction_goes_on(folder):
    _, second = interrupted(folder, "reproduce", signal.SIGKILL)
    assert second.count(GOES_ON) == 1


def test_interrupted_run_at_the_papers_scale_goes_on(folder):
    """Its cost is measured by a process around Snakemake, which must not end before Snakemake has."""
    first, second = interrupted(folder, "paper", signal.SIGINT)
    assert "Traceback" not in first
    assert GOES_ON not in second
    assert (folder / "results/costs.json").exists()
