"""The compilation of the solvers before a run."""

import shutil
import subprocess

from viscorough_study.run import kernels
from viscorough_study.run.kernels import compile_once


def test_solvers_are_compiled_again_for_another_digest_and_without_their_code(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".snakemake").mkdir()
    code = tmp_path / "code"
    monkeypatch.setattr(kernels, "code_folder", lambda: code)
    commands = []

    def run(command, check):
        commands.append(command[1:])
        code.mkdir(exist_ok=True)
        (code / "function.nbi").touch()

    monkeypatch.setattr(subprocess, "run", run)
    for digest in ("first", "first", "second"):
        compile_once(digest)
    shutil.rmtree(code)
    compile_once("second")
    assert commands == 3 * [["-m", "viscorough_study.run.kernels"]]
    assert capfd.readouterr().err.count("Compiling the solvers") == 3
