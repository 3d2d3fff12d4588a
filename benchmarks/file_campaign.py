"""Read text files of known maps of heights, with their ordinary variations, and find those misread.

    python benchmarks/file_campaign.py --files 10000 --seed 1 --output results/file_campaign.json

Each file is made from a known map, spacing and unit (text_files.py, point_files.py), and read with
viscorough.read_heights. It must be read exactly, with nan where points are missing, or be refused by a ValueError of
one line that names the file, and the line where the fault is in a line of text. Everything else is wrong: another
number, spacing or unit, a missing point that is dropped, another error, a warning other than AccuracyWarning, printed
text, a file that takes too long. Files that do not hold a single map, or are contradictory, must be refused.

A file is marked *unambiguous* if its variations are ordinary and a human reader would give it one meaning: numbers in
rows of equal length, one of the usual delimiters and decimal marks that cannot be confused with each other, the usual
marks of missing points, comments after #, %, // or as text, and headers that name one quantity per line with its unit,
as common programs write them. These must be read; their refusals are counted separately, and also are failures.

`--only I --keep FOLDER` repeats one file of a seed and leaves it in the folder; --keep alone keeps all failed files.
"""

import contextlib
import io
import re
import signal
import tempfile
import time
import traceback
import warnings
from collections import Counter
from pathlib import Path

import click
import numpy as np
import point_files
import text_files
from file_cases import generators
from measuring import save
from tqdm import tqdm

import viscorough
from viscorough.errors import AccuracyWarning

KINDS = {
    text_files.matrix: 50,
    point_files.points: 14,
    point_files.zygo: 2,
    point_files.esri: 8,
}
LONGEST, NO_END = 20, "no end after"  # seconds that a file may take
METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
READ, REFUSED, UNREAD, WRONG = "read", "refused", "refused though unambiguous", "wrong"


def cases(seed, numbers):
    """(number, case) of the cases with these numbers."""
    share = np.array(list(KINDS.values())) / sum(KINDS.values())
    for number, random in generators(seed, numbers):
        yield number, list(KINDS)[random.choice(len(KINDS), p=share)](random)


# ---- the judge


@contextlib.contextmanager
def time_limit(seconds):
    """Raise TimeoutError in the context when the time is over."""

    def stop(*_):
        raise TimeoutError(f"{NO_END} {seconds} s")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def outcome(case, folder):
    """(READ, REFUSED, UNREAD or WRONG, why) of a case, whose file is written to the folder."""
    path, printed = Path(folder) / case.name, io.StringIO()
    path.write_bytes(case.content)
    result, refusal = None, ""
    with warnings.catch_warnings(record=True) as caught, contextlib.redirect_stdout(printed):
        warnings.simplefilter("always")
        try:
            with contextlib.redirect_stderr(printed), time_limit(LONGEST):
                result = read(case, path)
        except ValueError as error:
            refusal = str(error)
        except Exception:
            return WRONG, traceback.format_exc().strip().splitlines()[-1]
    for warning in caught:
        if not issubclass(warning.category, AccuracyWarning):
            return WRONG, f"{warning.category.__name__}: {warning.message}"
    if printed.getvalue() or NO_END in refusal:
        return WRONG, printed.getvalue()[:200] or refusal
    if result is None:
        return judged_refusal(case, refusal, path)
    fault = difference(case, *result)
    return (WRONG, fault) if fault else (READ, "")


def read(case, path):
    """(heights, their unit in metres or None, spacing) as the package reads a file."""
    indenter = viscorough.read_heights(path, **case.options)
    unit, spacing = indenter.length_unit, (indenter.spacing, indenter.row_spacing)
    if unit != "1":
        unit = METRES[unit] if unit in METRES else float(unit.removesuffix(" m"))
    return indenter.heights, None if unit == "1" else unit, spacing


def judged_refusal(case, text, path):
    """The outcome of a refusal."""
    if "\n" in text or not text.startswith(str(path)):
        return WRONG, f"a refusal of more than one line, or without the file: {text[:200]!r}"
    reason = text.removeprefix(f"{path}: ")
    if case.faulty_line and not re.search(r"\blines? \d+", reason):
        return WRONG, f"a refusal that does not name the line: {reason}"
    return (UNREAD if case.unambiguous else REFUSED), reason


def difference(case, heights, unit, spacing):
    """Difference of the result from the truth of a case, as text; "" if there is none."""
    read_as = f"shape {heights.shape}, spacing {spacing}, unit {unit} m"
    if case.heights is None:
        return f"read, though it must be refused: {read_as}"
    if (unit is None) != (case.unit is None):
        return f"another unit: {read_as}, not {case.unit} m"
    if heights.shape != case.heights.shape:
        return f"another shape: {read_as}, not {case.heights.shape}"
    truth, unit = case.heights, unit or 1.0
    if unit != (case.unit or 1.0):
        heights, truth = heights * unit, truth * case.unit
    exact = np.where(np.isnan(truth), np.isnan(heights), np.abs(heights - truth) <= 1e-12 * np.abs(truth))
    if not exact.all():
        row, column = np.argwhere(~exact)[0]
        return f"another map: {heights[row, column]} in row {row}, column {column}, not {truth[row, column]}"
    if any(abs(d * unit / t - 1) > case.accuracy for d, t in zip(spacing, case.spacing, strict=True)):
        return f"another spacing: {read_as}, not {case.spacing}{' m' if case.unit else ''}"
    return ""


@click.command()
@click.option("--files", type=click.IntRange(1), default=10_000, show_default=True, help="Number of files.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Seed of all files.")
@click.option("--only", type=click.IntRange(0), help="Number of the one file to try.")
@click.option("--keep", type=click.Path(file_okay=False, path_type=Path), help="Folder for the files that failed.")
@click.option("--output", help="File to write, JSON.")
def main(files, seed, only, keep, output):
    """Count files that are read as another map; exit code 1 if there is any, or an unambiguous one is refused."""
    began, counts, failures = time.perf_counter(), {}, []
    numbers = range(files) if only is None else [only]
    with tempfile.TemporaryDirectory() as folder:
        progress = tqdm(numbers, unit="file", mininterval=2, disable=only is not None)
        for index, case in cases(seed, progress):
            word, why = outcome(case, folder)
            counts.setdefault(case.kind, Counter())[word] += 1
            if word in (UNREAD, WRONG):
                why = why.replace(f"{folder}/", "")
                failures.append({"file": index, "kind": case.kind, "traits": case.traits, "why": why, "is": word})
            if keep and (word in (UNREAD, WRONG) or only is not None):
                keep.mkdir(parents=True, exist_ok=True)
                (keep / f"{seed}-{index}-{case.name}").write_bytes(case.content)
            if only is not None:
                click.echo(f"{case.kind}, {', '.join(case.traits)}; arguments {case.options}\n{word}: {why}")
                click.echo(f"truth: {case.heights}, spacing {case.spacing}, unit {case.unit} m")
    summary = {"seed": seed, "files": len(numbers), "seconds": round(time.perf_counter() - began, 1), "counts": counts}
    if output:
        save({**summary, "failures": failures}, output)
    for failure in failures[:40]:
        text = f"{failure['is']}: {failure['kind']} ({', '.join(failure['traits'])}): {failure['why']}"
        click.echo(f"--seed {seed} --only {failure['file']}: {text}")
    for kind, words in sorted(counts.items()):
        click.echo(f"{kind}: {', '.join(f'{number} {word}' for word, number in words.items())}")
    raise SystemExit(bool(failures))


if __name__ == "__main__":
    main()
