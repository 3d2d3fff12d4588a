"""Progress on standard error: after a while, on terminals or where it is asked for, and erased at the end."""

import time

import pytest

from viscorough.cli import messages


def shown(capsys, wanted, wait):
    """What is shown in the middle and at the end of work that reports twice, `wait` seconds apart."""
    with messages.progress_bar("viscorough indent", wanted) as report:
        report(0.25)
        time.sleep(wait)
        report(0.5)
        middle = capsys.readouterr().err
    return middle, capsys.readouterr().err


@pytest.fixture(autouse=True)
def short_delay(monkeypatch):
    monkeypatch.setattr(messages, "_DELAY", 0.1)


def test_after_a_while_share_and_time_left_are_shown_and_erased_at_the_end(capsys):
    middle, end = shown(capsys, True, 0.25)
    assert "viscorough indent:  50 % |" in middle
    assert " left" in middle
    assert "\n" not in middle + end
    assert end.replace("\r", "").strip() == ""


@pytest.mark.parametrize("wanted", [None, False])
def test_without_a_terminal_only_what_is_asked_for_is_shown(capsys, wanted):
    assert shown(capsys, wanted, 0.25) == ("", "")


@pytest.mark.parametrize("wanted", [None, True])
def test_where_standard_error_is_closed_slow_work_goes_on(monkeypatch, wanted):
    monkeypatch.setattr("sys.stderr", None)
    with messages.progress_bar("viscorough indent", wanted) as report:
        time.sleep(0.2)  # longer than the delay and than the shortest time between two updates
        report(0.5)
