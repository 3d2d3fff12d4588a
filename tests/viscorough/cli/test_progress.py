"""Progress on standard error: after a delay, on terminals or on request, and erased at the end."""

import time

import pytest

from viscorough.cli import messages


def written(capsys, shown):
    """Return the output in the middle and at the end of work that reports twice, further apart than the delay."""
    with messages.progress_bar("viscorough indent", shown) as report:
        report(0.25)
        time.sleep(0.25)
        report(0.5)
        middle = capsys.readouterr().err
    return middle, capsys.readouterr().err


@pytest.fixture(autouse=True)
def short_delay(monkeypatch):
    monkeypatch.setattr(messages, "_DELAY", 0.1)


def test_progress_shows_share_and_time_left_and_is_erased(capsys):
    middle, end = written(capsys, True)
    assert "viscorough indent:  50 % |" in middle
    assert " elapsed, about " in middle
    assert " left" in middle
    assert "\n" not in middle + end
    assert end.replace("\r", "").strip() == ""


@pytest.mark.parametrize(("shown", "closed"), [(None, False), (False, False), (None, True), (True, True)])
def test_no_progress_without_a_terminal_or_an_open_stream(capsys, monkeypatch, shown, closed):
    if closed:
        monkeypatch.setattr("sys.stderr", None)
    assert written(capsys, shown) == ("", "")
