"""The compilation of the solvers before a run."""

import subprocess

import pandas as pd

from viscorough_study.run.kernels import KERNELS_BENCHMARK, compile_once
from viscorough_study.run.rule_costs import rule_costs


def test_solvers_are_compiled_again_only_for_another_digest(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".snakemake").mkdir()
    commands = []
    monkeypatch.setattr(subprocess, "run", lambda command, check: commands.append(command[1:]))
    for digest in ("first", "first", "second"):
        compile_once(digest)
    assert commands == 2 * [["-m", "viscorough_study.run.kernels"]]
    assert capfd.readouterr().err.count("Compiling the solvers") == 2
    costs = rule_costs({"compile_kernels": [KERNELS_BENCHMARK]})
    assert costs[["rule", "jobs", "memory_mb"]].to_numpy().tolist() == [["compile_kernels", 1, 0.0]]
    assert pd.read_csv(KERNELS_BENCHMARK, sep="\t")["s"].item() >= 0
