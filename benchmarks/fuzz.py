"""Run the command line on random files and options, most of them invalid, and check its contract.

    python benchmarks/fuzz.py --runs 10000 --output results/fuzz.json

The contract allows two ends of a run. Either the exit code is 0, the output file can be read and holds finite numbers,
and standard error holds only warnings of one line; or the exit code is 1 or 2, standard error holds one line, standard
output is empty, and no file was made or changed. The latter also shows that no code in a file was run. `make fuzz` runs
it. A failure is printed with the command that repeats it.
"""

import contextlib
import io
import multiprocessing
import os
import sys
import tempfile
import time
from collections import Counter
from importlib.metadata import version
from pathlib import Path

import click
import numpy as np
import pandas as pd
from fuzz_cases import COMMAND_LINES, STARTED, case, files_of, valid_arguments
from measuring import generators, save
from tqdm import tqdm

from viscorough import cli
from viscorough.io import netcdf
from viscorough.io.curves import OVER_LEVELS

FIGURES = {".png": b"\x89PNG", ".svg": b"<?xml"}  # first bytes
LONGEST = 120  # longest time of a run in seconds

# ---- the contract


def contents(folder):
    return {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def run(arguments):
    """Return exit code, stdout and stderr of the command line in a child process, which is a fork of this process."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        child = multiprocessing.get_context("fork").Process(target=_run_in_child, args=(arguments, out, err))
        child.start()
        child.join(LONGEST)
        child.kill()
        child.join()
        out.seek(0), err.seek(0)
        return child.exitcode, out.read().decode(), err.read().decode()


def _run_in_child(arguments, out, err):
    os.dup2(out.fileno(), 1)
    os.dup2(err.fileno(), 2)
    sys.stdout, sys.stderr = (
        io.TextIOWrapper(io.FileIO(number, "w"), "utf-8", "backslashreplace") for number in (1, 2)
    )
    raise SystemExit(cli.main(arguments))


def result_of(arguments, files):
    """Return the exit code of a run in a new folder with these files, and its breach of the contract, "" if none."""
    with new_folder({"older.nc": b"older"} | files) as folder:
        (folder / "folder").mkdir()
        os.mkfifo(folder / "pipe")
        (folder / "link.nc").symlink_to("older.nc")
        (folder / "dangling.nc").symlink_to("out.nc")
        before = contents(folder)
        code, out, err = run(arguments)
        return code, breach(arguments, (code, out, err), before, contents(folder))


@contextlib.contextmanager
def new_folder(files):
    """Work in a new folder that contains only these files."""
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for name, content in files.items():
            Path(name).write_bytes(content)
        yield Path(folder)


def breach(arguments, result, before, after):
    """Return the breach of the contract by a run, from the files before and after it; "" if there is none."""
    code, out, err = result
    changed = [path for path in sorted({*before, *after}) if before.get(path) != after.get(path)]
    if any(path.name == STARTED for path in after):
        return "code in a file was run"
    if code not in (0, 1, 2):
        return f"exit code {code}"
    lines = err.splitlines()
    if code:
        if changed:
            return f"exit code {code}, but {', '.join(path.name for path in changed)} changed"
        if len(lines) != 1 or not err.endswith("\n") or not lines[0].startswith("viscorough") or out:
            return f"exit code {code} with {len(lines)} lines on stderr: {err[:300]!r}, stdout {out[:100]!r}"
        return ""
    command = next((argument for argument in arguments if argument != "--"), "")
    if not all(line.startswith(f"viscorough {command}: warning: ") for line in lines):
        return f"success with other than warnings on stderr: {err[:300]!r}"
    if not changed and out.startswith(("Usage: viscorough", f"viscorough {version('viscorough')}", "vt/h = ")):
        return ""  # help, the version, or the table of an estimate
    paths = {os.path.realpath(path) for path in changed}
    return fault_of_output(changed[0]) if len(paths) == 1 else f"success, and {len(paths)} files changed"


def fault_of_output(path):
    """Return the fault of an output file; "" if there is none."""
    if path.suffix in FIGURES:
        return "" if path.read_bytes().startswith(FIGURES[path.suffix]) else "the figure is damaged"
    if path.suffix.lower() == ".csv":
        return "" if len(pd.read_csv(path, comment="#")) else "the table is empty"
    try:
        content = netcdf.read(path)
    except ValueError as error:
        return f"the output cannot be read: {error}"
    variables = content.variables
    if {"x", "velocity"} <= set(variables) or "levels" in variables:  # estimates and stacks of curves contain nan
        return ""
    # Depths before the curve's first level are missing, and velocities may be infinite; a warning says so.
    may_be_missing = {"depth", "velocity"} if "are missing" in str(content.attributes.get("warnings")) else set()
    for name in {*OVER_LEVELS, "time", "velocity", "overlap"} & set(variables):
        values = variables[name].values
        if name in may_be_missing:
            values = values[~np.isnan(values)]
        if not values.size or not np.isfinite(values).all():
            return f"the output has {name} = {values.tolist()}"
        if name in ("depth", "time") and not (np.diff(np.atleast_1d(values)) >= 0).all():
            return f"{name} does not increase in the output: {values.tolist()}"
    return ""


def breaches(seed, numbers):
    """Return the runs that break the contract, as in the file of results, and the number of runs by exit code."""
    failures, codes = [], Counter()
    for number, random in generators(seed, numbers):
        arguments, files = case(random)
        code, words = result_of(arguments, files)
        codes[str(code)] += 1
        if words:
            failures.append({"run": number, "arguments": arguments, "breach": words})
    return failures, codes


def load():
    """Load modules and compiled code, once for all runs."""
    for line, (_, random) in zip(COMMAND_LINES, generators(0, range(len(COMMAND_LINES))), strict=True):
        arguments = valid_arguments(random, line)
        files, printed = files_of(random, arguments, faults=0), io.StringIO()
        with new_folder(files), contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            cli.main(arguments)


@click.command()
@click.option("--runs", type=click.IntRange(1), default=10_000, show_default=True, help="Number of runs.")
@click.option("--seed", type=click.IntRange(0), default=2013, show_default=True, help="Seed of all runs.")
@click.option("--only", type=click.IntRange(0), help="Number of the one run to try.")
@click.option("--output", type=click.Path(path_type=Path), help="File to write, JSON.")
def main(runs, seed, only, output):
    """Count runs that break the contract; the exit code is 1 if there is any."""
    began, numbers = time.perf_counter(), range(runs) if only is None else [only]
    load()
    failures, codes = breaches(seed, tqdm(numbers, unit="run", mininterval=2))
    for number, arguments, words in map(dict.values, failures):
        repeat = f"python benchmarks/fuzz.py --seed {seed} --only {number}"
        click.echo(f"{repeat}: viscorough {' '.join(map(repr, arguments))}: {words}")
    seconds = round(time.perf_counter() - began, 1)
    click.echo(f"{len(failures)} of {len(numbers)} runs off the contract, exit codes {dict(codes)}, {seconds} s")
    if output:
        attributes = {"seed": seed, "runs": len(numbers), "seconds": seconds, "exit_codes": codes}
        save({**attributes, "off_contract": failures}, output)
    raise SystemExit(bool(failures))


if __name__ == "__main__":
    main()
