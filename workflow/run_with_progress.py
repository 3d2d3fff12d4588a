"""Run Snakemake with one line of progress on the terminal; all output of Snakemake and its jobs goes to a file.

python workflow/run_with_progress.py -- snakemake --cores 2 -- all
"""

import contextlib
import fcntl
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

from tqdm import tqdm

from viscorough.io.atomic import check_output
from viscorough.io.refusals import reason
from viscorough_study.run.stale_locks import REMOVED
from viscorough_study.run.tables import read_table, split_table
from viscorough_study.verdicts.claims import counted_verdicts

OUTPUT = Path("results/run.log")
PASSED_ON = (REMOVED, "Compiling ")
ASSUMED = {"ncols": 100, "nrows": 24}  # size of a terminal that states no width
LOOK = {"bar_format": "{desc} |{bar}| {elapsed}", "leave": False}


class Progress:
    """Read the lines that Snakemake prints, and show the number of jobs on standard error if it is a terminal."""

    def __init__(self):
        self.done, self.bar = "", None

    def read(self, line):
        """Update the progress from one line that Snakemake prints."""
        if self.bar is None:
            if match := re.fullmatch(r"total +(\d+)", line):
                self.done = f"0 of {match[1]}"
                silent = True if sys.stderr is None else None  # with None, tqdm shows progress on terminals only
                self.bar = tqdm(total=int(match[1]), file=sys.stderr, disable=silent, **LOOK, **_width())
        elif match := re.fullmatch(r"Job \d+: (.*)", line):
            self.bar.set_description_str(f"{self.done}: {match[1]}")
        elif re.match(r"Finished jobid: ", line):
            self.bar.update()
        elif match := re.match(r"\d+ of \d+(?= steps )", line):
            self.done = match[0]


def run(command, output=OUTPUT):
    """Run a command of Snakemake with its progress on the terminal, report errors at the end, and return the exit code.

    Ctrl-C also reaches Snakemake, which then ends its jobs and unlocks its folder. SIGTERM reaches only this process,
    which passes the signal on to Snakemake. Without a terminal, a single line is printed: the number of steps, and the
    name of the file that shows their progress.

    command : list of the words of the command
    output : file for the output of Snakemake and its jobs
    """
    progress = Progress()
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        check_output(output)
        file = _opened(output)
    except (OSError, ValueError) as error:
        _show(f"Error: {output.resolve()}: not written ({reason(error)}); a folder that can be written is needed\n")
        return 1
    if file is None:
        _show(f"Error: {output.resolve()}: another run writes it; wait until that run has ended, or stop it\n")
        return 1
    piped = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "encoding": "utf-8", "errors": "replace"}
    with file, subprocess.Popen(command, **piped) as process:
        stopped = []

        def stop(number, _frame):
            stopped.append(number)
            if number == signal.SIGTERM:
                process.terminate()

        signal.signal(signal.SIGINT, stop)
        signal.signal(signal.SIGTERM, stop)
        for line in process.stdout:
            print(line, end="", file=file, flush=True)
            planned = progress.bar is not None
            progress.read(line.rstrip("\n"))
            if progress.bar is not None and progress.bar.disable and not planned:
                _show(f"{progress.done.removeprefix('0 of ')} steps; progress in {output}\n")
            if line.startswith(PASSED_ON):
                _show(line)
    if progress.bar is not None:
        progress.bar.close()  # this erases the line of progress
    code = 128 - process.returncode if process.returncode < 0 else process.returncode
    if code and stopped:
        _show(f"Stopped after {progress.done or 'no'} steps; the same command continues\n")
    elif code:
        _show("".join(f"{line}\n" for line in _errors(output)))
    return code


def _opened(output):
    """Return the output file, open and empty; return None if another run is writing it."""
    file = output.open("a", encoding="utf-8")  # this mode keeps what the other run has written
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        file.close()
        return None
    except OSError:
        pass  # some network file systems have no locks
    file.truncate(0)
    return file


def _width():
    """Return the arguments of tqdm for a line as wide as the terminal; some terminals state the width 0."""
    with contextlib.suppress(OSError, AttributeError):
        if os.get_terminal_size(sys.stderr.fileno()).columns == 0:
            return ASSUMED
    return {"dynamic_ncols": True}


def _show(text):
    """Write a text to standard error, above the line of progress; do nothing if standard error is closed."""
    with contextlib.suppress(OSError):
        tqdm.write(text, file=sys.stderr, end="")


def _errors(output):
    """Return the lines that report the errors of a run.

    Each failed job that has a log gets one line: its first error and the path of the log. If there is no such job, the
    lines are the message of Snakemake itself.

    output : file with the output of the run
    """
    text, everything = output.read_text(encoding="utf-8"), f"Full output: {output}"
    if logs := dict.fromkeys(re.findall(r"^ +log: (\S+) \(check log file", text, re.MULTILINE)):
        return [*(f"Error: {_error_in(Path(log))} (log: {log})" for log in logs), everything]
    lines = text.rstrip().splitlines()
    named = (lines[i:] for i, line in enumerate(lines) if re.match(r"\w*(Error|Exception)\b", line))
    return next(named, [*lines[-5:], everything])


def _error_in(log):
    """Return the first error message in the log of a job."""
    text = log.read_text(encoding="utf-8", errors="replace") if log.is_file() else ""
    match = re.search(r"^\S+ \S+ ERROR (.*)$", text, re.MULTILINE)
    return match[1] if match else "a job was ended, or failed before it wrote its log"


def summary(seconds, command, results=Path("results")):
    """Return the last lines of a run: verdicts on the paper's own claims, its time [s], and its page.

    command : list of the words of the command, the last of which are targets; verdicts belong to `all` only
    """
    time_taken = f"It took {seconds:.0f} seconds" if seconds < 100 else f"It took {seconds / 60:.1f} minutes"
    if "all" not in command:
        return [time_taken, *(f"Open {results / 'beyond.html'} in a browser" for word in command if word == "beyond")]
    table = results / "tables/claims.csv"
    claims = counted_verdicts(read_table(table), "own")
    trial = "; trial scale, on which verdicts mean nothing" * split_table(table)[0]["trial"]
    verdicts = ", ".join(f"{number} {verdict}" for verdict, number in claims)
    counted = f"{sum(number for _, number in claims)} claims of the paper: {verdicts}{trial}"
    return [counted, time_taken, f"Open {results / 'index.html'} in a browser"]


if __name__ == "__main__":
    start = time.monotonic()
    words = sys.argv[sys.argv.index("--") + 1 :]
    code = run(words)
    if not code:
        print("\n".join(summary(time.monotonic() - start, words)))
    sys.exit(code)
