"""The log of a job: messages, warnings, tracebacks and progress in one file."""

import subprocess
import sys

import pytest


def test_an_interrupt_is_one_line(tmp_path):
    script = "from viscorough_study.run.job_log import log_to; log_to('job.log'); raise KeyboardInterrupt"
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert (tmp_path / "job.log").read_text() == done.stderr
    assert done.stderr.endswith("ERROR interrupted\n")
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("error", "on_stderr"),
    [
        ("ValueError('rms: must be\\n positive')", False),
        ("ConvergenceError('level')", False),
        ("KeyError('h')", True),
    ],
)
def test_log_gets_messages_warnings_and_the_traceback(tmp_path, error, on_stderr):
    script = f"""
import logging, sys, warnings
from viscorough.errors import ConvergenceError
from viscorough_study.run.job_log import log_to
log_to(sys.argv[1])
logging.info("100 %s of it", "%")
warnings.warn("odd spacing")
raise {error}
"""
    path = tmp_path / "job.log"
    path.write_text("of an earlier run\n")
    done = subprocess.run([sys.executable, "-c", script, path], capture_output=True, text=True, check=False)
    log = path.read_text()
    assert done.returncode == 1
    assert "earlier run" not in log
    assert all(part in text for part in ("INFO 100 % of it", "odd spacing") for text in (log, done.stderr))
    assert log.count("Traceback") == 1
    assert done.stderr.count("Traceback") == on_stderr
    kind = error.split("(")[0]
    (line,) = (line for line in done.stderr.splitlines() if f"ERROR {kind}: " in line)
    assert kind != "ValueError" or line.endswith("ERROR ValueError: rms: must be positive")


def test_progress_logs_an_estimate_now_and_then(tmp_path):
    """With a clock that gains 1 s per step, 60 steps are logged every 5 s, with the time that is left."""
    script = """
from viscorough_study.run import job_log
job_log.log_to("job.log")
assert list(job_log.progress(iter("abc"), 3, "short")) == ["a", "b", "c"]
bar, now = job_log.progress(range(60), 60, "levels"), 0.0
bar._time, bar.start_t, bar.last_print_t = lambda: now, 0.0, 0.0
for step in bar:
    now = step + 1.0
"""
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, check=True)
    lines = (tmp_path / "job.log").read_text().splitlines()
    assert 10 <= len(lines) <= 13
    assert "30 of 60, 00:30 passed, 00:30 to go" in "\n".join(lines)
    assert all("INFO levels: " in line and " of 60, " in line for line in lines)
