"""Write text files of given maps of heights with ordinary variations, and find files that are misread.

    python benchmarks/file_campaign.py --files 10000 --seed 1 --output results/file_campaign.json

Each file is made from a given map, spacing and unit (text_files.py), and read with viscorough.read_heights. It must be
read exactly, with nan at missing points, or be refused by a ValueError of one line that names the file.
A profile must be read exactly by viscorough.read_line, or be refused, and viscorough.read_heights must refuse it.
Everything else counts as wrong: a different number, spacing or unit, a dropped missing point, a different error, a
warning other than AccuracyWarning, or printed text. Files that do not hold a single map, or are contradictory, must be
refused.

A file is marked *unambiguous* if its variations are ordinary and a human reader would give it one meaning: numbers in
rows of equal length, one of the usual delimiters and decimal marks that cannot be confused with each other, the usual
marks of missing points, comments after #, %, // or as text, and headers that name one quantity per line with its unit,
as common programs write them. Such files must be read; refusals of them are counted separately, as failures.

`--only I` repeats one file of a seed and prints it.
"""

import contextlib
import io
import tempfile
import time
import warnings
from collections import Counter
from pathlib import Path

import click
import numpy as np
import text_files
from file_cases import generators
from measuring import save
from tqdm import tqdm

import viscorough
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.units import metres

KINDS = (text_files.matrix, text_files.points, text_files.esri, text_files.profile)
SHARES = (0.6, 0.2, 0.05, 0.15)
READ, REFUSED, UNREAD, WRONG = "read", "refused", "refused though unambiguous", "wrong"


def cases(seed, numbers):
    """Yield (number, case) of the cases with these numbers."""
    for number, random in generators(seed, numbers):
        yield number, KINDS[random.choice(len(KINDS), p=SHARES)](random)


# ---- the judge


def outcome(case, folder):
    """Return (READ, REFUSED, UNREAD or WRONG, why) of a case, whose file is written to the folder."""
    path, printed = Path(folder) / case.name, io.StringIO()
    path.write_bytes(case.content)
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed), warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", AccuracyWarning)
        try:
            if case.is_line and read_as_map(path, case.options):
                return WRONG, "a profile, read as a map"
            read = viscorough.read_line if case.is_line else viscorough.read_heights
            fault, refusal = difference(case, read(path, **case.options)), ""
        except ValueError as error:
            fault, refusal = "", str(error)
        except Exception as error:
            fault = f"{type(error).__name__}: {error}"
    if fault or printed.getvalue():
        return WRONG, fault or f"printed: {printed.getvalue()[:200]}"
    if not refusal:
        return READ, ""
    if "\n" in refusal or not refusal.startswith(str(path)):
        return WRONG, f"a refusal of more than one line, or without the file: {refusal[:200]!r}"
    return (UNREAD if case.draft.clear else REFUSED), refusal.removeprefix(f"{path}: ")


def read_as_map(path, options):
    """Return True if read_heights reads the file."""
    try:
        viscorough.read_heights(path, **options)
    except ValueError:
        return False
    return True


def difference(case, indenter):
    """Return the difference between the result and the truth of a case as text; "" if there is none."""
    unit = None if indenter.length_unit == "1" else metres(indenter.length_unit)
    if case.draft.bad:
        return f"read, though it must be refused: shape {indenter.heights.shape}, unit {unit} m"
    if (unit is None) != (case.unit is None):
        return f"another unit: {unit} m, not {case.unit} m"
    heights, spacing = indenter.heights * (unit or 1), np.multiply([indenter.spacing, indenter.row_spacing], unit or 1)
    try:
        np.testing.assert_allclose(heights, case.heights * (case.unit or 1), 1e-12, err_msg="another map")
        np.testing.assert_allclose(spacing, case.spacing, case.accuracy, err_msg="another spacing")
    except AssertionError as error:
        return " ".join(str(error).split())
    return ""


@click.command()
@click.option("--files", type=click.IntRange(1), default=10_000, show_default=True, help="Number of files.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Seed of all files.")
@click.option("--only", type=click.IntRange(0), help="Number of the one file to try.")
@click.option("--output", type=click.Path(path_type=Path), help="File to write, JSON.")
def main(files, seed, only, output):
    """Count files that are read as a different map; exit code 1 if there is any, or an unambiguous file is refused."""
    began, counts, failures = time.perf_counter(), {}, []
    numbers = range(files) if only is None else [only]
    with tempfile.TemporaryDirectory() as folder:
        for index, case in cases(seed, tqdm(numbers, unit="file", mininterval=2, disable=only is not None)):
            word, why = outcome(case, folder)
            counts.setdefault(case.kind, Counter())[word] += 1
            if word in (UNREAD, WRONG):
                failures.append({"file": index, "kind": case.kind, "traits": case.draft.traits, "why": why, "is": word})
            if only is not None:
                click.echo(f"{case.name}: {case.content!r}\n{', '.join(case.draft.traits)}; arguments {case.options}")
                click.echo(f"truth: {case.heights}, spacing {case.spacing}, unit {case.unit} m\n{word}: {why}")
    summary = {"seed": seed, "files": len(numbers), "seconds": round(time.perf_counter() - began, 1), "counts": counts}
    if output:
        save({**summary, "failures": failures}, output)
    for failure in failures[:40]:
        click.echo(f"--seed {seed} --only {failure['file']}: {failure['is']}: {failure['why']}")
    for kind, words in sorted(counts.items()):
        click.echo(f"{kind}: {', '.join(f'{number} {word}' for word, number in words.items())}")
    raise SystemExit(bool(failures))


if __name__ == "__main__":
    main()
