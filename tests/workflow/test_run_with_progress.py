"""One line of progress from Snakemake's output; errors are shown, and the exit code is kept."""

import io
import signal
import sys

import pytest
import run_with_progress

from support.study import ROOT
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


class Terminal(io.StringIO):
    """Standard error that is a terminal."""

    def isatty(self):
        return True


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Run a Python script instead of Snakemake, with its progress, and return the exit code."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    return lambda script: run_with_progress.run([sys.executable, "-c", script])


def test_without_a_terminal_messages_and_one_line_are_shown(run, tmp_path, capfd):
    printed = f"{REMOVED}\n{STARTED}{FINISHED}"
    assert run(f"print({printed!r})") == 0
    assert capfd.readouterr() == ("", f"{REMOVED}\n41 steps; progress in results/run.log\n")
    assert (tmp_path / "results/run.log").read_text() == printed + "\n"


def test_error_of_a_job_is_shown_with_its_log_and_exit_code(run, tmp_path, capfd):
    lines = ("INFO 3 of 9", "ERROR ValueError: no contact", "ERROR Traceback (most recent")
    (tmp_path / "indent.log").write_text("".join(f"2026-01-01 10:00:00 {line}\n" for line in lines))
    assert run(f"print({STARTED + FAILED + FAILED!r}); raise SystemExit(3)") == 3
    last = ["Error: ValueError: no contact (log: indent.log)", "Full output: results/run.log"]
    assert capfd.readouterr().err.splitlines()[-2:] == last
    (tmp_path / "indent.log").unlink()
    run(f"exit({FAILED!r})")
    assert "before it wrote its log (log: indent.log)" in capfd.readouterr().err


def test_errors_of_snakemake_itself_are_shown(run, capfd):
    assert run("print('Building DAG of jobs...'); exit('Error in the settings: lines: 3')") == 1
    assert capfd.readouterr().err == "Error in the settings: lines: 3\n"
    assert run(r"import os; print('one\ntwo', flush=True); os.kill(os.getpid(), 9)") == 128 + 9
    assert capfd.readouterr().err.splitlines() == ["one", "two", "Full output: results/run.log"]


def test_a_second_run_is_refused_and_keeps_the_output_of_the_first(run):
    second = "import run_with_progress; raise SystemExit(run_with_progress.run(['true']))"
    script = (
        f"import sys, subprocess; sys.path.append({str(ROOT / 'workflow')!r}); print('first', flush=True); {second}"
    )
    assert run(script) == 1
    assert "another run writes it; wait until that run has ended, or stop it" in run_with_progress.OUTPUT.read_text()
    assert run_with_progress.OUTPUT.read_text().startswith("first\n")


def test_interrupted_run_states_that_the_same_command_continues(run, capfd, monkeypatch):
    def interrupt(number, handler):
        if number == signal.SIGTERM:
            handler(number, None)

    monkeypatch.setattr(signal, "signal", interrupt)
    assert run("import time; time.sleep(100)") == 128 + signal.SIGTERM
    assert capfd.readouterr().err == "Stopped after no steps; the same command continues\n"
