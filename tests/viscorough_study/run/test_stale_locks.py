"""Locks of killed runs are removed; locks of living runs are kept."""

import os
import subprocess
import sys

import pytest

from support.contract import refused
from viscorough_study.run.stale_locks import remove_stale_locks

REMOVE = "from viscorough_study.run.stale_locks import remove_stale_locks; alive = remove_stale_locks(); "


def test_locks_are_kept_while_any_other_process_lives(tmp_path, monkeypatch, capfd):
    """After the other process is killed, its lock is removed with one line."""
    monkeypatch.chdir(tmp_path)
    lock = tmp_path / ".snakemake/locks/0.input.lock"
    command = [sys.executable, "-c", REMOVE + "print(flush=True); input()"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as other:
        try:
            other.stdout.readline()
            lock.parent.mkdir()
            lock.touch()
            for _ in range(2):
                os.close(remove_stale_locks())
                assert lock.exists()
        finally:
            other.kill()
    assert capfd.readouterr().err == ""
    os.close(remove_stale_locks())
    assert not lock.exists()
    assert capfd.readouterr().err.count("\n") == 1


JOB = """
from types import SimpleNamespace
from viscorough_study.run.job_log import run_job
files = {"log": ["job.log"], "input": {}, "output": {"curves": "a.nc"}}
job = SimpleNamespace(**files, rule="reduce_lines", params={}, resources={})
run_job({"snakemake": job}, lambda curves: (print(flush=True), input()))
"""


@pytest.mark.parametrize("has_imported", [True, False])
def test_locks_are_kept_while_a_job_of_a_killed_run_lives(tmp_path, monkeypatch, capfd, has_imported):
    """Otherwise the job would overwrite the results of the next run."""
    monkeypatch.chdir(tmp_path)
    lock, script = tmp_path / ".snakemake/locks/0.input.lock", tmp_path / ".snakemake/scripts/a.reduce_lines.py"
    for path, text in ((lock, ""), (script, JOB if has_imported else "print(flush=True); input()")):
        path.parent.mkdir(parents=True)
        path.write_text(text)
    os.close(os.open(".snakemake/alive", os.O_CREAT))
    with subprocess.Popen([sys.executable, str(script)], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as job:
        try:
            job.stdout.readline()
            os.close(remove_stale_locks())
            assert lock.exists()
            with refused(
                rf"a job \(process {job.pid}\) still runs in this folder; wait until it has ended, or stop it"
            ):
                remove_stale_locks(unlock=True)
        finally:
            job.kill()
    assert capfd.readouterr().err == ""
    os.close(remove_stale_locks(unlock=True))
    assert not lock.exists()
