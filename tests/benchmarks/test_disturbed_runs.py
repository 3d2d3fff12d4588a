"""What `make chaos` and `make test-slurm` compare, and how they disturb runs, without a whole run."""

import subprocess
import sys

import chaos
import numpy as np
import pytest
import slurm


def test_measured_times_may_differ_and_nothing_else(tmp_path):
    """Two folders with equal results, whose measured times differ."""
    same = ["tables/claims.csv", "figures/fig1.pdf"]
    measured = ["tables/methods.csv", "index.html", "logs/a/b.log", "benchmarks/a.tsv", "methods/rough.csv"]
    first, second = tmp_path / "one", tmp_path / "two"
    for folder, seconds in ((first, "1.0"), (second, "2.0")):
        for name in same + measured:
            path = folder / "results" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(name if name in same else seconds)
    expected = chaos.contents(first)
    assert len(expected) == 7
    assert chaos.compare(chaos.contents(second), expected) == []
    (second / "results/tables/claims.csv").write_text("else")
    (second / "results/index.html").unlink()
    (second / "results/tables/claims.csv.part").touch()
    lines = ["index.html: is missing", "tables/claims.csv.part: is left over", "tables/claims.csv: differs"]
    assert chaos.compare(chaos.contents(second), expected) == lines


@pytest.mark.parametrize(("seed", "what"), [(1, "whole run"), (3, "interrupt")])
def test_a_run_is_killed_or_interrupted(tmp_path, monkeypatch, seed, what):
    """Snakemake in a folder whose only rule waits, for ever."""
    (tmp_path / "Snakefile").write_text('rule wait:\n    output: "never"\n    shell: "sleep 600"\n')
    (tmp_path / "src").mkdir()
    monkeypatch.setattr(chaos, "SNAKEMAKE", [sys.executable, "-m", "snakemake", "--cores", "1"])
    with chaos.started(tmp_path) as run:
        chaos.wait_for(lambda: "rule wait" in (tmp_path / "chaos.log").read_text(), "start of the job")
        assert chaos.disturb(run, np.random.default_rng(seed)) == what
        assert run.wait(60) != 0
        assert "ends with" in chaos.verdict(tmp_path, run)


def test_processes_of_a_cluster_are_ended():
    """Those with its settings in their environment."""
    with subprocess.Popen(["sleep", "600"], env={"SLURM_CONF": "/of/this/test", "PATH": "/usr/bin:/bin"}):
        slurm.wait_for(lambda: list(slurm.processes("/of/this/test")), "start of a process")
        slurm.stop("/of/this/test")
        assert list(slurm.processes("/of/this/test")) == []
