"""Progress on standard error: after a second, on terminals or where it is asked for, and erased at the end."""

import time

import pytest

from viscorough.cli import progress
from viscorough.cli.progress import progress_bar


def shown(capsys, wanted, wait):
    with progress_bar("viscorough indent", wanted) as report:
        report(0.25)
        time.sleep(wait)
        report(0.5)
        middle = capsys.readouterr().err
    return middle, capsys.readouterr().err


def test_after_a_second_share_and_time_left_are_shown_and_erased_at_the_end(capsys):
    middle, end = shown(capsys, True, 1.05)
    assert "viscorough indent:  50 % |" in middle
    assert " left" in middle
    assert "\n" not in middle + end
    assert end.replace("\r", "").strip() == ""


def test_what_is_quick_shows_nothing(capsys):
    assert "50 %" not in shown(capsys, True, 0.0)[0]


def test_without_a_terminal_only_what_is_asked_for_is_shown(capsys):
    for wanted in (None, False):
        assert shown(capsys, wanted, 1.05) == ("", "")


@pytest.mark.parametrize("wanted", [None, True])
def test_where_standard_error_is_closed_slow_work_goes_on(monkeypatch, wanted):
    monkeypatch.setattr(progress, "_DELAY", 0.0)
    monkeypatch.setattr("sys.stderr", None)
    with progress_bar("viscorough indent", wanted) as report:
        time.sleep(0.2)  # longer than the shortest time between two updates
        report(0.5)
