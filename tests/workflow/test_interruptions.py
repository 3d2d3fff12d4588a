"""Runs that are interrupted or killed continue when the user repeats the same make command."""

import os
import shutil
import signal
import subprocess
import sys
import time

import pytest
import xarray as xr

from support.workflow import HANGS, ROOT, copy_project, environment, merged, read_settings, settings_file

pytestmark = pytest.mark.long

LONG = {
    "hurst": [0.9],
    "discs": {
        "realizations": 2,
        "combinations": read_settings("config")["discs"]["combinations"][:1],
        "variants": {"surfaces": []},
    },
    "lines": {"points": 16384, "realizations": 60, "batch": 15},
}
POOL = "results/ensembles/lines.nc"
GOES_ON = "The last run in this folder was killed: its lock is removed, its results are kept."


@pytest.fixture
def folder(tmp_path):
    """Make a project whose `make reproduce` makes one small ensemble."""
    folder = copy_project(tmp_path)
    shutil.copytree(ROOT / "peers", folder / "peers")
    (folder / "Makefile").write_text((ROOT / "Makefile").read_text().replace(" all\n", f" {POOL}\n"))
    settings_file(folder / "config", "config", **merged(merged(read_settings("config"), read_settings("test")), LONG))
    return folder


def make(folder):
    """Start `make reproduce` in its own group of processes, as a terminal does."""
    runner = f"{sys.executable} -m snakemake --cores 1 --nocolor"
    return subprocess.Popen(
        ["make", "-o", "environment", f"BIN={os.path.dirname(sys.executable)}", f"SNAKEMAKE={runner}", "reproduce"],
        cwd=folder,
        env=environment(folder),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # tests may run where it is ignored
    )


def batches(folder):
    """Return {batch: time when its curves were made}."""
    return {path.stem: path.stat().st_mtime_ns for path in (folder / "results/curves/lines/h09000").glob("*.nc")}


def finish(folder):
    """Return the output of a run that ends by itself."""
    with make(folder) as run:
        output, _ = run.communicate(timeout=HANGS)
    assert run.returncode == 0, output
    return output


def contents(folder):
    """Return {file: its bytes} of all curves and pools."""
    return {path.relative_to(folder): path.read_bytes() for path in (folder / "results").rglob("*.nc")}


def make_until(folder, signal_number):
    """Return the output of a run that gets a signal while it makes a batch, after it has made another batch.

    Snakemake takes the batches in any order.
    """
    before, logs = batches(folder), folder / "results/logs/reduce_lines/h09000"
    shutil.rmtree(logs, ignore_errors=True)
    with make(folder) as run:
        deadline = time.monotonic() + HANGS
        while not before.keys() < batches(folder).keys() < {log.stem for log in logs.glob("*.log")} | before.keys():
            assert time.monotonic() < deadline, "the run does not begin a second batch"
            assert run.poll() is None, run.communicate()[0]
            time.sleep(0.02)
        os.killpg(run.pid, signal_number)
        output, _ = run.communicate(timeout=HANGS)
    assert run.returncode != 0
    assert not (folder / POOL).exists()
    return output


def test_run_continues_after_an_interrupt_and_a_kill(folder):
    locks = folder / ".snakemake/locks"
    first = make_until(folder, signal.SIGINT)
    assert "Traceback" not in first
    assert not list(locks.glob("*")), first
    interrupted = batches(folder)
    assert interrupted
    second = make_until(folder, signal.SIGKILL)
    assert GOES_ON not in second
    assert list(locks.glob("*")), second
    killed = batches(folder)
    assert interrupted.items() < killed.items(), "what was made is kept, and one more was made"
    assert finish(folder).count(GOES_ON) == 1
    assert killed.items() <= batches(folder).items(), "what was made is kept"
    with xr.open_dataset(folder / POOL) as pool:
        assert pool.sizes["realization"] == 60
    interrupted = contents(folder)
    shutil.rmtree(folder / "results")
    finish(folder)
    assert contents(folder) == interrupted, "results of a run without interruptions"
