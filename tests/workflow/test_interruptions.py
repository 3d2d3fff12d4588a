"""A run that is killed, and goes on."""

import os
import signal
import subprocess
import time

import xarray as xr

from support.workflow import TEST, command, copy_project, environment, settings_file, snakemake


def test_a_killed_run_leaves_no_incomplete_file_and_goes_on(tmp_path):
    folder = copy_project(tmp_path)
    long = settings_file(
        folder,
        "long",
        discs={"hurst": [0.9]},
        lines={"hurst": [0.9], "points": 65536, "realizations": 300, "batch": 100},
    )
    target = "results/ensembles/lines.nc"
    finished = [folder / f"results/curves/lines/h09000/{batch}.nc" for batch in ("0000-0099", "0100-0199", "0200-0299")]
    run = subprocess.Popen(
        command(*TEST, long, "--cores", "1", "--", target),
        cwd=folder,
        env=environment(folder),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    deadline = time.monotonic() + 120
    while sum(path.exists() for path in finished) < 1 or not running(folder):
        assert time.monotonic() < deadline
        assert run.poll() is None
        time.sleep(0.02)
    os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    done = [path for path in finished if path.exists()]
    assert 1 <= len(done) < 3
    assert not (folder / target).exists()
    before = {path: path.read_bytes() for path in done}
    for path in done:
        with xr.open_dataset(path) as curves:
            assert curves.sizes["realization"] == 100

    snakemake(folder, *TEST, long, "--unlock")
    snakemake(folder, *TEST, long, "--", target)
    with xr.open_dataset(folder / target) as pool:
        assert pool.sizes["realization"] == 300
    for path, content in before.items():
        assert path.read_bytes() == content
    assert not list((folder / "results").rglob("*.part"))


def running(folder):
    """Whether a job is under way that has logged its start but is not known to be finished."""
    logs = set((folder / "results/logs/indent_lines").rglob("*.log"))
    return len(logs) > len(list((folder / "results/curves/lines").rglob("*.nc")))
