"""Run Snakemake with one line of progress on the terminal; its output and that of its jobs goes to a file.

python -m viscorough_study.page.terminal -- snakemake --cores 2 -- all
"""

import contextlib
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd

from viscorough.io.netcdf import opened
from viscorough_study.run.paper_data import read_paper
from viscorough_study.run.rule_costs import duration_text
from viscorough_study.run.stale_locks import REMOVED
from viscorough_study.verdicts.claims import counted_verdicts

OUTPUT = Path("results/run.log")
PUBLISHED_COSTS = Path("resources/published/default_costs.csv")
OWN_SPEED = 20  # seconds of the published run after which measured and published speed have equal weight
SPARSE = 10  # lines of progress without a terminal
PASSED_ON = (REMOVED, "Compiling ")
CLEAR = "\r\x1b[K"  # clears the line of a terminal


class Progress:
    """Progress of a run, from the lines that Snakemake prints.

    seconds : {rule: share of the run time per job [s]}, of an earlier run; other rules are assigned the mean
    """

    def __init__(self, seconds):
        self.seconds, self.mean = seconds, sum(seconds.values()) / max(len(seconds), 1) or 1.0
        self.planned, self.done, self.total, self.ended = 0.0, 0, 0, 0.0
        self.running, self.failed_logs, self.began, self.changed = {}, [], None, None

    def read(self, line, now):
        """Update the progress by a line that was printed at time `now` [s]."""
        if match := re.fullmatch(r"(\w+) +(\d+)", line):
            if match[1] != "total" and self.began is None:
                self.planned += int(match[2]) * self._seconds_of(match[1])
                self.total += int(match[2])
        elif match := re.fullmatch(r"Job (\d+): (.*)", line):
            if self.began is None:
                self.began = self.changed = now
            self.running[match[1]] = match[2]
        elif match := re.fullmatch(r"Finished jobid: (\d+) \(Rule: (\w+)\)", line):
            self.running.pop(match[1], None)
            self.ended, self.changed = self.ended + self._seconds_of(match[2]), now
        elif match := re.fullmatch(r"(\d+) of (\d+) steps \(.*\) done", line):
            self.done, self.total = int(match[1]), int(match[2])
        elif match := re.fullmatch(r" +log: (\S+) \(check log file.*", line):
            self.failed_logs += [] if match[1] in self.failed_logs else [match[1]]

    def text(self, now):
        """The line of progress, such as "31 of 90, 2.1 minutes left: Figure 1, surfaces"; "" before the first job."""
        if self.began is None:
            return ""
        pace = (self.changed - self.began + OWN_SPEED) / (self.ended + OWN_SPEED)
        left = max(0.0, pace * (self.planned - self.ended) - (now - self.changed))
        what = next(reversed(self.running.values()), "")
        return f"{self.done} of {self.total}, {duration_text(left) if left >= 5 else 'seconds'} left: {what}"

    def _seconds_of(self, rule):
        return self.seconds.get(rule, 0.0 if rule == "all" else self.mean)


def run(command, output=OUTPUT):
    """Run a command of Snakemake with its progress on the terminal, report errors at the end; returns its exit code.

    Ctrl-C reaches the command itself, which then ends its jobs and unlocks its folder. SIGTERM, which reaches only this
    process, is passed on.
    """
    progress, drawn, pending = Progress(_published_seconds()), "", ""
    on_terminal = bool(sys.stderr) and sys.stderr.isatty()
    output.parent.mkdir(parents=True, exist_ok=True)
    with open(output, "w", encoding="utf-8") as file, open(output, encoding="utf-8", errors="replace") as printed:
        process = subprocess.Popen(command, stdout=file, stderr=subprocess.STDOUT)
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, lambda *_: process.terminate())
        ended = False
        while not ended:
            ended = process.poll() is not None
            *lines, pending = (pending + printed.read()).split("\n")
            for line in lines:
                progress.read(line, time.monotonic())
                if line.startswith(PASSED_ON):
                    _show(CLEAR * on_terminal + line + "\n")
            drawn = _draw(progress, drawn, on_terminal)
            time.sleep(0 if ended else 0.2)
    if on_terminal and drawn:
        _show(CLEAR)
    code = 128 - process.returncode if process.returncode < 0 else process.returncode
    if code:
        _show("".join(f"{line}\n" for line in _errors(progress.failed_logs, output)))
    return code


def _show(text):
    """Write to standard error; the run continues if that is closed."""
    with contextlib.suppress(OSError):
        print(text, end="", file=sys.stderr, flush=True)


def _draw(progress, drawn, on_terminal):
    """Show new progress: on a terminal over the last line, otherwise in `SPARSE` lines in all."""
    if on_terminal:
        text = progress.text(time.monotonic())[: shutil.get_terminal_size().columns - 1]
        if text != drawn:
            _show(CLEAR + text)
        return text
    part = str(SPARSE * progress.done // max(progress.total, 1)) if progress.began else ""
    if part != drawn:
        _show(progress.text(time.monotonic()) + "\n")
    return part


def _errors(logs, output):
    """Error messages of a run: error and log of every failed job, otherwise the message of Snakemake."""
    everything = f"Full output: {output}"
    if logs:
        return [*(f"Error: {_error_in(Path(log))} (log: {log})" for log in logs), everything]
    lines = output.read_text(encoding="utf-8", errors="replace").rstrip().splitlines()
    named = (lines[i:] for i, line in enumerate(lines) if re.match(r"\w*(Error|Exception)\b", line))
    return next(named, [*lines[-5:], everything])


def _error_in(log):
    """The first error in the log of a job."""
    if not log.is_file():
        return "a job failed before it wrote its log"
    text = log.read_text(encoding="utf-8", errors="replace")
    match = re.search(r"^\S+ \S+ ERROR (.*)$", text, re.M)
    return match[1] if match else "a job was ended"


def _published_seconds():
    if not PUBLISHED_COSTS.is_file():
        return {}
    table = pd.read_csv(PUBLISHED_COSTS)
    return dict(zip(table["rule"], table["share_s"] / table["jobs"], strict=True))


def summary(results=Path("results"), paper=Path("resources/paper")):
    """Last lines of a run: number of claims by verdict, run time and the paper's, and the page to open."""
    claims = counted_verdicts(pd.read_csv(results / "tables/claims.csv"))
    with opened(results / "tables/claims.nc") as file:
        trial = "; trial scale, on which verdicts mean nothing" * int(file.getncattr("trial"))
    seconds = pd.read_csv(results / "tables/rule_costs.csv")["share_s"].sum()
    theirs = read_paper(paper, "numbers")["boundary_elements"]["computing_time"]["value"]
    verdicts = ", ".join(f"{number} {verdict}" for verdict, number in claims)
    return [
        f"{sum(number for _, number in claims)} claims of the paper: {verdicts}{trial}",
        f"It took {duration_text(seconds)}; the paper: {theirs}",
        f"Open {results / 'index.html'} in a browser",
    ]


if __name__ == "__main__":
    code = run(sys.argv[sys.argv.index("--") + 1 :])
    if not code and Path("results/index.html").is_file():
        print("\n".join(summary()))
    sys.exit(code)
