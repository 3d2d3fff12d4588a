"""How `make test-slurm` compares runs and ends its cluster, with a stand-in for the workflow."""

import subprocess

import slurm


def test_only_measured_times_may_differ(tmp_path):
    results = tmp_path / "results"
    same = ["tables/claims.csv", "figures/fig1.pdf"]
    measured = ["tables/methods.csv", "index.html", "logs/a/b.log", "benchmarks/a.tsv"]
    for name in same + measured:
        (results / name).parent.mkdir(parents=True, exist_ok=True)
        (results / name).write_text("1.0")
    expected = slurm.contents(tmp_path)
    assert len(expected) == 6
    for name in measured:
        (results / name).write_text("2.0")
    assert slurm.compare(tmp_path, expected) == []
    (results / "tables/claims.csv").rename(results / "tables/claims.csv.part")
    (results / "figures/fig1.pdf").write_text("else")
    missing, left_over = (f"tables/claims.csv{suffix}: is missing or left over" for suffix in ("", ".part"))
    assert slurm.compare(tmp_path, expected) == [missing, left_over, "figures/fig1.pdf: differs"]


def test_processes_of_a_cluster_are_ended():
    """Only processes with the settings of the cluster in their environment are ended."""
    with subprocess.Popen(["sleep", "600"], env={"SLURM_CONF": "/of/this/test", "PATH": "/usr/bin:/bin"}):
        slurm.wait_for(lambda: list(slurm.processes("/of/this/test")), "start of a process")
        slurm.stop("/of/this/test")
        assert list(slurm.processes("/of/this/test")) == []
