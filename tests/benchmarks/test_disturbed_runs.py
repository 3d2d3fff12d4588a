"""How `make chaos` and `make test-slurm` disturb runs and compare them, with a stand-in for the workflow."""

import subprocess
from functools import partial

import chaos
import numpy as np
import psutil
import pytest
import slurm


def test_only_measured_times_may_differ(tmp_path):
    results = tmp_path / "results"
    same = ["tables/claims.csv", "figures/fig1.pdf"]
    measured = ["tables/methods.csv", "index.html", "logs/a/b.log", "benchmarks/a.tsv", "methods/rough.csv"]
    for name in same + measured:
        (results / name).parent.mkdir(parents=True, exist_ok=True)
        (results / name).write_text("1.0")
    expected = chaos.contents(tmp_path)
    assert len(expected) == 7
    for name in measured:
        (results / name).write_text("2.0")
    assert chaos.compare(tmp_path, expected) == []
    (results / "tables/claims.csv").rename(results / "tables/claims.csv.part")
    (results / "figures/fig1.pdf").write_text("else")
    missing, left_over = (f"tables/claims.csv{suffix}: is missing or left over" for suffix in ("", ".part"))
    assert chaos.compare(tmp_path, expected) == [missing, left_over, "figures/fig1.pdf: differs"]


def run_of(seconds):
    """Return the command of a run of one job."""
    return ["sh", "-c", f"sleep {seconds} || exit 1; mkdir -p results; echo done > part && mv part results/done.txt"]


def test_killed_runs_recover(tmp_path, monkeypatch):
    monkeypatch.setattr(chaos, "SNAKEMAKE", run_of(seconds=0.5))
    outcome = chaos.chaos(tmp_path, kills=2, seed=1)
    assert (outcome["differences"], outcome["files_compared"], len(outcome["log"])) == ([], 1, 2)
    assert 1 <= outcome["runs"] <= 3


@pytest.mark.parametrize(("seed", "what"), [(1, "whole run"), (3, "interrupt"), (2, "job")])
def test_a_run_or_a_job_is_killed_or_interrupted(tmp_path, monkeypatch, seed, what):
    monkeypatch.setattr(chaos, "SNAKEMAKE", run_of(seconds=60))
    with chaos.started(tmp_path) as run:
        children = partial(psutil.Process(run.pid).children, recursive=True)
        chaos.wait_for(lambda: "sleep" in [process.name() for process in children()], "start of the job")
        assert chaos.disturb(run, np.random.default_rng(seed)) == what
        assert run.wait(60) != 0


def test_processes_of_a_cluster_are_ended():
    """Only processes with the settings of the cluster in their environment are ended."""
    with subprocess.Popen(["sleep", "600"], env={"SLURM_CONF": "/of/this/test", "PATH": "/usr/bin:/bin"}):
        slurm.wait_for(lambda: list(slurm.processes("/of/this/test")), "start of a process")
        slurm.stop("/of/this/test")
        assert list(slurm.processes("/of/this/test")) == []
