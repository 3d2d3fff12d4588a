"""Locks of killed runs are removed, those of living ones never."""

import os
import subprocess
import sys

import pytest

from viscorough_study.run.stale_locks import remove_stale_locks

REMOVE = "from viscorough_study.run.stale_locks import remove_stale_locks; alive = remove_stale_locks(); "


@pytest.fixture
def locks(tmp_path, monkeypatch):
    """The locks that a killed run has left in the current folder."""
    monkeypatch.chdir(tmp_path)
    paths = [tmp_path / ".snakemake/locks" / name for name in ("0.input.lock", "0.output.lock")]
    paths[0].parent.mkdir(parents=True)
    for path in paths:
        path.write_text("results/curve.nc\n")
    return paths


def test_locks_of_a_killed_run_are_removed_with_one_line(locks, capfd):
    os.close(remove_stale_locks())
    assert not any(path.exists() for path in locks)
    assert capfd.readouterr().err.count("\n") == 1
    os.close(remove_stale_locks())
    assert capfd.readouterr() == ("", ""), "nothing is said without locks"


def test_locks_are_kept_while_any_other_process_lives(locks, capfd):
    command = [sys.executable, "-c", REMOVE + "print(flush=True); input()"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as other:
        try:
            other.stdout.readline()
            for path in locks:
                path.write_text("results/curve.nc\n")
            for _ in range(2):
                os.close(remove_stale_locks())
                assert all(path.exists() for path in locks)
        finally:
            other.kill()
    assert capfd.readouterr().err == ""
    os.close(remove_stale_locks())
    assert not any(path.exists() for path in locks)


def test_folder_that_cannot_be_made(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".snakemake").touch()
    assert remove_stale_locks() is None
