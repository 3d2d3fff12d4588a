"""The compilation of the solvers before a run."""

import subprocess

from viscorough_study.run.kernels import compile_once


def test_solvers_are_compiled_again_only_for_another_digest(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".snakemake").mkdir()
    commands = []
    monkeypatch.setattr(subprocess, "run", lambda command, check: commands.append(command[1:]))
    for digest in ("first", "first", "second"):
        compile_once(digest)
    assert commands == 2 * [["-m", "viscorough_study.run.kernels"]]
    assert capfd.readouterr().err.count("Compiling the solvers") == 2
