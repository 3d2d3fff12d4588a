"""One line of progress, from what Snakemake prints; what goes wrong is shown, and the exit code kept."""

import contextlib
import io
import os
import pty
import re
import signal
import sys

import pandas as pd
import pytest
import xarray as xr

from support.study import ROOT
from viscorough_study.page import terminal
from viscorough_study.page.terminal import CLEAR, SPARSE, Progress, summary
from viscorough_study.run.stale_locks import REMOVED

STARTED = """Building DAG of jobs...
Provided cores: 2
Job stats:
job           count
----------  -------
all               1
indent           30
plot             10
total            41

Select jobs to execute...
Job 3: Curves of discs
Reason: Missing output files: a.nc
Job 4: Figure 1
"""
FINISHED = """Finished jobid: 3 (Rule: indent)
1 of 41 steps (2%) done
"""
FAILED = """Error in rule indent:
    jobid: 3
    output: a.nc
    log: indent.log (check log file(s) for error details)
Exiting because a job execution failed. Look below for error messages
"""


def read(progress, text, now):
    for line in text.splitlines():
        progress.read(line, now)


def test_what_runs_how_many_of_how_many_and_the_time_left():
    progress = Progress({"indent": 10.0, "plot": 1.0})
    assert progress.text(0) == ""
    read(progress, STARTED, 100)
    assert progress.text(100) == "0 of 41, 5.2 minutes left: Figure 1"
    read(progress, FINISHED, 110)
    assert progress.text(110) == "1 of 41, 5.0 minutes left: Figure 1"
    assert progress.text(170) == "1 of 41, 4.0 minutes left: Figure 1"
    assert progress.text(1000) == "1 of 41, seconds left: Figure 1"
    read(progress, "Job 5: Curves of lines", 110)
    assert progress.text(110) == "1 of 41, 5.0 minutes left: Curves of lines", "the next job does not change the time"


def test_a_machine_of_half_the_speed_takes_twice_as_long():
    """After a while; at first, the published times count, and their mean for rules that were never timed."""
    for times, left in (({"indent": 10.0}, "6.7 minutes"), ({}, "40 seconds")):
        read(progress := Progress(times), STARTED, 0)
        assert progress.text(0).startswith(f"0 of 41, {left} left")
    read(progress := Progress({"indent": 10.0, "plot": 1.0}), STARTED, 0)
    for job in range(30):
        read(progress, f"Finished jobid: {job} (Rule: indent)", 20 * (job + 1))
    left = float(re.search(r", (.*) seconds left", progress.text(600))[1])
    assert left == pytest.approx(2 * 10, rel=0.1)


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Runs a Python script, in place of Snakemake, with its progress on a stream; the exit code."""
    monkeypatch.chdir(tmp_path)
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

    def run(script, number=2):
        with open(number, "wb", buffering=0, closefd=False) as stream:
            monkeypatch.setattr("sys.stderr", io.TextIOWrapper(stream, write_through=True))
            return terminal.run([sys.executable, "-c", script])

    yield run
    for number, handler in handlers.items():
        signal.signal(number, handler)


def test_without_a_terminal_there_are_a_few_lines(run, tmp_path, capfd):
    finished = "".join(f"Finished jobid: {i} (Rule: indent)\n{i} of 41 steps (2%) done\n" for i in range(42))
    printed = f"{REMOVED}\n{STARTED}{finished}"
    assert run(f"print({printed!r})") == 0
    shown = capfd.readouterr()
    first, *lines = shown.err.splitlines()
    assert first == REMOVED
    assert 1 <= len(lines) <= SPARSE + 1
    assert all(re.fullmatch(r"\d+ of 41, .* left: .*", line) for line in lines)
    assert shown.out == ""
    assert (tmp_path / "results/run.log").read_text() == printed + "\n"


def test_a_terminal_has_one_line_that_is_drawn_again(run):
    reader, screen = pty.openpty()
    assert run(f"print({STARTED + FINISHED!r})", screen) == 0
    os.close(screen)
    output = ""
    with contextlib.suppress(OSError):  # once everything is read
        while part := os.read(reader, 1000):
            output += part.decode()
    os.close(reader)
    assert "\n" not in output
    assert "1 of 41" in output
    assert output.endswith(CLEAR)


def test_the_run_goes_on_where_nobody_reads_its_progress(run, tmp_path):
    reader, writer = os.pipe()
    os.close(reader)
    run(f"print({STARTED!r}); open('made', 'w')", writer)
    os.close(writer)
    assert (tmp_path / "made").exists()


def test_the_error_of_a_job_is_shown_with_its_log_and_the_code_kept(run, tmp_path, capfd):
    lines = ("INFO 3 of 9", "ERROR ValueError: no contact", "ERROR Traceback (most recent")
    (tmp_path / "indent.log").write_text("".join(f"2026-01-01 10:00:00 {line}\n" for line in lines))
    assert run(f"print({STARTED + FAILED + FAILED!r}); raise SystemExit(3)") == 3
    last = ["Error: ValueError: no contact (log: indent.log)", "Full output: results/run.log"]
    assert capfd.readouterr().err.splitlines()[-2:] == last
    (tmp_path / "indent.log").unlink()
    run(f"exit({FAILED!r})")
    assert "before it wrote its log (log: indent.log)" in capfd.readouterr().err


def test_what_ends_snakemake_itself_is_shown(run, capfd):
    assert run("print('Building DAG of jobs...'); exit('Error in the settings: lines: 3')") == 1
    assert capfd.readouterr().err == "Error in the settings: lines: 3\n"
    assert run(r"import os; print('one\ntwo', flush=True); os.kill(os.getpid(), 9)") == 128 + 9
    assert capfd.readouterr().err.splitlines() == ["one", "two", "Full output: results/run.log"]


def test_the_end_is_three_lines(tmp_path):
    (tmp_path / "tables").mkdir()
    rows = [("a", "reproduced"), ("a", "undecided"), ("b", "reproduced"), ("c", "reproduced")]
    pd.DataFrame(rows, columns=["claim", "verdict"]).assign(kind="physics").to_csv(tmp_path / "tables/claims.csv")
    pd.DataFrame({"share_s": [200.0, 40.0]}).to_csv(tmp_path / "tables/rule_costs.csv", index=False)
    for trial, added in ((0, ""), (1, "; trial scale, on which verdicts mean nothing")):
        xr.Dataset(attrs={"trial": trial}).to_netcdf(tmp_path / "tables/claims.nc")
        assert summary(tmp_path, ROOT / "resources/paper") == [
            "3 claims of the paper: 2 reproduced, 1 undecided" + added,
            "It took 4.0 minutes; the paper: several weeks",
            f"Open {tmp_path}/index.html in a browser",
        ]
