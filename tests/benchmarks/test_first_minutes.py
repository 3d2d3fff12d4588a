"""Time from a clone to the page: parts of commands that take known times, and commands that fail."""

import sys

import click
import first_minutes
import pytest


def test_parts_have_the_times_of_their_commands(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", "elsewhere")
    busy = f'"{sys.executable}" -c "import time\nwhile time.process_time() < 0.3: pass"'
    commands = {"waits": "sleep 0.3", "computes": busy, "clean": 'test -z "$PYTHONPATH" && test -n "$NUMBA_CACHE_DIR"'}
    rows = first_minutes.measured(commands, tmp_path)
    assert [row["part"] for row in rows] == list(commands)
    assert rows[0]["wall_s"] >= 0.3
    assert rows[0]["processor_s"] < 0.3
    assert rows[1]["processor_s"] >= 0.3


def test_a_part_that_fails_ends_the_measurement(tmp_path):
    with pytest.raises(click.ClickException, match="environment: `exit 3` failed with exit code 3"):
        first_minutes.measured({"environment": "exit 3"}, tmp_path)


def test_clone_has_the_commit_that_is_asked_for(tmp_path, monkeypatch):
    (source := tmp_path / "source").mkdir()
    (clone := tmp_path / "clone").mkdir()
    monkeypatch.setattr(first_minutes, "ROOT", source)
    commit = "git add . && git -c user.name=A -c user.email=a@example.org commit --quiet --message"
    commands = {
        "first": f"git init --quiet && echo 1 > file && {commit} 1",
        "second": f"echo 2 > file && {commit} 2 -a",
    }
    first_minutes.measured(commands, source)
    first_minutes.measured({"clone": first_minutes.parts("HEAD~1", 2)["clone"]}, clone)
    assert (clone / "file").read_text() == "1\n"
