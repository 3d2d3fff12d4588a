"""Kill the workflow repeatedly, and compare its final results with those of an undisturbed run.

    python benchmarks/chaos.py --kills 60 --seed 1 --output results/chaos.json

A run of the small settings, which starts without results, is disturbed after a random time: in half of the cases the
whole run is killed (SIGKILL), in a quarter one of its jobs, and in a quarter the run is interrupted (SIGINT to its
group, as by Ctrl-C). The same command alone is then repeated (config/README.md, Interrupted runs) until it finishes.
Its figures, tables, ensembles and curves must then equal those of an undisturbed run to the last byte. Of files with
measured times, such as logs and the page, only names must agree.
"""

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import click
import numpy as np
import psutil
from measured_times import holds_times
from measuring import output_option, save

from viscorough.io import netcdf

ROOT = Path(__file__).resolve().parents[1]
SNAKEMAKE = [sys.executable, "-m", "snakemake", "--cores", "2", "--nocolor", "--configfile", "config/test.yaml"]
# The longest wait for a kill, as a share of the time of an undisturbed run: most runs are killed several times, and
# their ends as often as their beginnings.
LONGEST_WAIT = 1 / 3
HANGS = 3600  # seconds after which a run is taken to hang, even on a busy machine


def copy_project(folder):
    """Copy the files that git tracks or would track, and numba's caches: compiling would take most of the time."""
    list_files = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    tracked = subprocess.run(list_files, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout
    for name in tracked.rstrip("\0").split("\0"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, folder / name)
    for caches in (ROOT / "src").rglob("__pycache__"):
        shutil.copytree(caches, folder / caches.relative_to(ROOT))


def remove_results(folder):
    for name in ("results", ".snakemake"):
        shutil.rmtree(folder / name, ignore_errors=True)


def wait_for(condition, what, seconds=120):
    """Wait until the condition is true; return its value."""
    end = time.monotonic() + seconds
    while not (value := condition()):
        if time.monotonic() > end:
            raise click.ClickException(f"{what} does not happen within {seconds} s")
        time.sleep(0.2)
    return value


@contextlib.contextmanager
def started(folder, *arguments, log="chaos.log", mode="w"):
    """Snakemake in its own session, all of whose processes are killed afterwards; it writes to a log in the folder."""
    environment = os.environ | {"PYTHONPATH": str(folder / "src")}  # before the installed package
    with (folder / log).open(mode) as log:
        run = subprocess.Popen(
            [*SNAKEMAKE, *arguments],
            cwd=folder,
            env=environment,
            stdout=log,
            stderr=log,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # ignored in what runs in the background
        )
    try:
        yield run
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(run.pid, signal.SIGKILL)
        run.wait()


def verdict(folder, run):
    """Wait for the end of a run that is no longer disturbed; an error message, or None."""
    try:
        code = run.wait(HANGS)
    except subprocess.TimeoutExpired:
        return f"does not end within {HANGS} s"
    if code:
        return f"ends with {code}: " + " | ".join((folder / "chaos.log").read_text().splitlines()[-20:])
    return None


def job_processes(run):
    """{process: rule} of the running jobs: the processes that run a script, not the shells around them."""
    jobs = {}
    for process in psutil.Process(run.pid).children(recursive=True):
        with contextlib.suppress(psutil.Error):
            script = Path([*process.cmdline(), "", ""][1])
            if script.parent.name == "scripts" and script.suffix == ".py":
                jobs[process] = script.stem.split(".")[-1]  # tmpabcdefgh.indent_surfaces.py
    return jobs


def disturb(run, random):
    """Kill the whole run, kill one of its jobs (if it has none, the whole run) or interrupt it; return which."""
    jobs = list(job_processes(run).items())
    draw = random.random()
    if draw < 0.25:
        os.killpg(run.pid, signal.SIGINT)
        return "interrupt"
    if draw < 0.5 and jobs:
        process, rule = jobs[random.integers(len(jobs))]
        with contextlib.suppress(psutil.NoSuchProcess):
            process.kill()
        return rule
    everything = psutil.Process(run.pid).children(recursive=True)
    os.killpg(run.pid, signal.SIGKILL)
    psutil.wait_procs(everything, timeout=10)
    return "whole run"


def jobs_done(folder):
    return len(list((folder / "results/benchmarks").rglob("*.tsv")))


def killed_run(folder, random, longest_wait, kills, report):
    """A run without results until its end, killed up to `kills` times; an error message on other faults, or None."""
    remove_results(folder)
    killed = 0
    while True:
        with started(folder) as run:
            if killed == kills:
                return verdict(folder, run)
            wait = random.uniform(0, longest_wait)
            try:
                run.wait(wait)
            except subprocess.TimeoutExpired:
                killed += 1
                report(disturb(run, random), wait, jobs_done(folder))
                with contextlib.suppress(subprocess.TimeoutExpired):
                    run.wait(HANGS)  # a run that has lost a job finishes its other one and ends with an error
                if run.poll() is None:
                    return f"does not end within {HANGS} s after this"
            else:
                return verdict(folder, run)


def contents(folder):
    """{name: bytes} of all files in results/, without the bytes of files that hold times."""
    results = folder / "results"
    names = sorted(path.relative_to(results) for path in results.rglob("*") if path.is_file())
    return {str(name): b"" if holds_times(name) else (results / name).read_bytes() for name in names}


def compare(actual, expected):
    """One line per file that differs from the expected contents."""
    lines = [f"{name}: is missing" for name in expected if name not in actual]
    lines += [f"{name}: is left over" for name in actual if name not in expected]
    return lines + [f"{name}: differs" for name in expected if actual.get(name, expected[name]) != expected[name]]


def undisturbed(folder):
    """Contents after a run that starts without results, and its seconds."""
    remove_results(folder)
    start = time.perf_counter()
    with started(folder) as run:
        if wrong := verdict(folder, run):
            raise click.ClickException(f"the undisturbed run {wrong}")
    seconds = time.perf_counter() - start
    for path in (folder / "results").rglob("*.nc"):
        netcdf.read(path)  # so that every file with the same bytes can be read, too
    return contents(folder), seconds


def chaos(folder, kills, seed):
    """Runs with `kills` kills in total, as a dictionary for the file."""
    copy_project(folder)
    wanted, seconds = undisturbed(folder)  # compiles what is not in numba's caches
    again, seconds = undisturbed(folder)
    differences = [f"undisturbed: {line}" for line in compare(again, wanted)]
    jobs = jobs_done(folder)
    click.echo(f"undisturbed: {seconds:.0f} s, {jobs} jobs, {len(wanted)} files")
    random, log, lives, recovered, start = np.random.default_rng(seed), [], 0, 0, time.perf_counter()

    def report(what, wait, done):
        log.append({"killed": what, "after_s": round(wait, 2), "jobs_done": done})
        left = (time.perf_counter() - start) / len(log) * (kills - len(log)) + seconds * (1 - done / jobs)
        event = f"{what} after {wait:.1f} s, {done} of {jobs} jobs done"
        click.echo(f"kill {len(log)} of {kills}: {event}; about {left / 60:.1f} min to go")

    while len(log) < kills:
        lives += 1
        wrong = killed_run(folder, random, seconds * LONGEST_WAIT, kills - len(log), report)
        lines = [wrong] if wrong else compare(contents(folder), wanted)
        differences += [f"run {lives}: {line}" for line in lines]
        recovered += not lines
        click.echo("\n".join([f"run {lives} {'differs' if lines else 'has recovered'}", *lines]))
    return {
        "kills": len(log),
        "runs": lives,
        "recovered": recovered,
        "differences": differences,
        "seconds": round(time.perf_counter() - start, 1),
        "files_compared": len(wanted),
        "jobs": jobs,
        "log": log,
    }


@click.command(help=__doc__.splitlines()[0])
@click.option("--kills", type=click.IntRange(1), default=60, show_default=True, help="Total number of disturbances.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of times and of what is killed.")
@output_option
def main(kills, seed, output):
    with tempfile.TemporaryDirectory() as folder:
        result = chaos(Path(folder).resolve(), kills, seed)
    click.echo("{recovered} of {runs} runs recovered from {kills} kills in {seconds:.0f} s".format(**result))
    save({"seed": seed, **result}, output)
    sys.exit(bool(result["differences"]))


if __name__ == "__main__":
    main()
