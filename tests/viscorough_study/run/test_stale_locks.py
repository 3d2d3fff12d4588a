"""Locks of killed runs are removed; locks of living runs are kept."""

import os
import subprocess
import sys

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


def test_folder_that_cannot_be_made_is_no_error(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".snakemake").touch()
    assert remove_stale_locks() is None
