"""The log of a job: messages, warnings and tracebacks in one file."""

import subprocess
import sys

import pytest

SCRIPT = """
import logging, warnings
from viscorough.basics.errors import ConvergenceError
from viscorough_study.run.job_log import log_to
log_to("job.log")
logging.info("100 %s of it", "%")
warnings.warn("odd spacing")
raise {error}
"""


@pytest.mark.parametrize(
    ("error", "last_line", "tracebacks"),
    [
        ("ValueError('rms: must be\\n positive')", "ERROR ValueError: rms: must be positive", (1, 0)),
        ("ConvergenceError('level')", "ERROR ConvergenceError: level", (1, 0)),
        ("KeyError('h')", "KeyError: 'h'", (1, 1)),
        ("KeyboardInterrupt", "ERROR interrupted", (0, 0)),
    ],
)
def test_log_gets_messages_warnings_and_the_traceback(tmp_path, error, last_line, tracebacks):
    (tmp_path / "job.log").write_text("of an earlier run\n")
    command = [sys.executable, "-c", SCRIPT.format(error=error)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    log = (tmp_path / "job.log").read_text()
    assert done.returncode != 0
    assert "earlier run" not in log
    assert all(part in text for part in ("INFO 100 % of it", "odd spacing") for text in (log, done.stderr))
    assert done.stderr.endswith(f"{last_line}\n")
    assert (log.count("Traceback"), done.stderr.count("Traceback")) == tracebacks
