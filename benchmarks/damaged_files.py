"""Damage files of results at random, and count damaged files that load with different content.

    python benchmarks/damaged_files.py --curves 400 --others 200 --seed 1 --output results/damaged_files.json

The files are a loading curve, a batch of curves, a pool of ensembles, a file of surfaces, and a table of a run as CSV
and NetCDF. A damage changes 1 to 8 random bytes, sets a block of bytes to zero, or cuts the file short. A damaged file
must be refused by a ValueError of one line that names it, or must load with the same content, if the damage is in an
unused part of the file. Damage can also crash the HDF5 library or make it run without end. Therefore a separate process
reads the files, and is ended if it takes too long. The exit code is 1 if a file loads with different content or raises
a different error.
"""

import contextlib
import multiprocessing
import pickle
import shutil
import tempfile
import time
from collections import Counter
from pathlib import Path

import click
import numpy as np
import pandas as pd
from file_cases import generators
from measuring import output_option, save
from tqdm import tqdm

import viscorough
from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset, write_dataset
from viscorough.mdr import reduce_heights
from viscorough.surfaces.lines import SelfAffineLines
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.batches import Realization, batch_of_curves
from viscorough_study.ensembles.pool import pool_batches
from viscorough_study.ensembles.surface_files import read_surfaces, write_surfaces
from viscorough_study.run.tables import read_table, write_table

TIME_LIMIT = 20  # seconds; an undamaged file is read in milliseconds
SAME, REFUSED, ANOTHER, WRONG = "same content", "refused", "another content", "another error"
CRASHED, UNENDING = "crashed", "not read in time"
_WAYS = multiprocessing.get_context("fork")  # a fork of this process has everything imported


# ---- the files


def write_files(folder):
    """Write one file of each kind, and return {kind: (reading function, names)}.

    The function reads from a folder. The last of the names is the file to damage.
    """
    disc = viscorough.self_affine_disc(0.7, 33, rms=0.01, seed=1)
    viscorough.save(viscorough.indent(disc), folder / "curve.nc")
    members, settings = [], {"ensembles": [{"name": "h05000"}]}
    lines = SelfAffineLines(hurst=0.5, points=512, rms=1e-6, length=1e-3)
    for number in range(24):
        curve = reduce_heights(lines.heights_in_any_order(number), lines.spacing, length_unit="m")
        members.append((curve, Realization("h05000", number, 0.5, 1e-3, lines.spacing, {"line": 1e-6}), 30.0))
    batch = batch_of_curves(members, settings)
    netcdf.write(batch, folder / "batch.nc")
    pool = pool_batches([("base", batch)], ["line"], abscissa(1e-5, 30, 20))
    write_dataset(pool, folder / "pool.nc")
    surface = Realization("h07000", 0, 0.7, 1.0, disc.spacing, {"disc": 0.01})
    write_surfaces([({}, 1, [(surface, disc)])], folder / "surfaces.nc")
    table = pd.DataFrame({"source": "lines", "x": pool["x"].values, "stiffness": pool["stiffness"].values[0, 0]})
    columns = {"source": ("source", None), "x": ("X", "1"), "stiffness": ("κ", "1")}
    write_table(table, folder / "table.csv", folder / "table.nc", columns=columns, dimension="row", title="Stiffness")
    return {
        "curve": (lambda folder: viscorough.load_curve(folder / "curve.nc"), ["curve.nc"]),
        "batch": (lambda folder: netcdf.read(folder / "batch.nc")[:2], ["batch.nc"]),
        "pool": (lambda folder: read_dataset(folder / "pool.nc").to_dict(data="array"), ["pool.nc"]),
        "surfaces": (lambda folder: list(read_surfaces(folder / "surfaces.nc")), ["surfaces.nc"]),
        "table": (lambda folder: read_table(folder / "table.csv"), ["table.nc", "table.csv"]),
        "NetCDF of the table": (lambda folder: read_table(folder / "table.csv"), ["table.csv", "table.nc"]),
    }


def damaged(whole, random):
    """Return (kind of damage, bytes) of a damaged file; the bytes differ from the original."""
    kind, content = random.choice(["bytes", "block", "cut"], p=[0.6, 0.2, 0.2]), bytearray(whole)
    if kind == "cut":
        return kind, bytes(whole[: random.integers(len(whole))])
    if kind == "bytes":
        for place in random.integers(len(whole), size=random.integers(1, 9)):
            content[place] ^= random.integers(1, 256)
    else:
        size = int(np.exp(random.uniform(0, np.log(len(whole)))))
        first = random.integers(len(whole) - size + 1)
        content[first : first + size] = bytes(size)
    return (kind, bytes(content)) if content != whole else damaged(whole, random)


# ---- the judge


class ReadingProcess:
    """Process that reads files from folders; if it crashes or takes too long, a new process is started."""

    def __init__(self, read):
        self.read, self.child = read, None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._end()

    def answer(self, folder):
        """Return (SAME, pickled result), (REFUSED, error), (WRONG, error), (CRASHED, exit code) or (UNENDING, "")."""
        if self.child is None:
            self.pipe, theirs = _WAYS.Pipe()
            self.child = _WAYS.Process(target=_answer_requests, args=(self.read, theirs), daemon=True)
            self.child.start()
            theirs.close()
        self.pipe.send(folder)
        with contextlib.suppress(EOFError, ConnectionResetError):
            if self.pipe.poll(TIME_LIMIT):
                return self.pipe.recv()
            self._end()
            return UNENDING, ""
        return CRASHED, f"exit code {self._end()}"

    def _end(self):
        child, self.child = self.child, None
        if child is not None:
            self.pipe.close()
            child.join(1)  # wait, so that a crashed process keeps its exit code
            child.kill()
            child.join()
        return child and child.exitcode


def _answer_requests(read, pipe):
    with contextlib.suppress(EOFError):
        while folder := pipe.recv():
            try:
                answer = SAME, pickle.dumps(read(folder))
            except ValueError as error:
                text = str(error)
                answer = REFUSED if str(folder) in text and len(text.splitlines()) == 1 else WRONG, text
            except Exception as error:
                answer = WRONG, f"{type(error).__name__}: {error}"
            pipe.send(answer)


def outcome(process, files, content, expected):
    """Return (outcome, detail) of reading copies of files, the last with this content; expected : pickled result"""
    with tempfile.TemporaryDirectory(dir=files[0].parent) as folder:  # HDF5 may keep a damaged file open
        *_, damaged_file = (Path(shutil.copy(file, folder)) for file in files)
        damaged_file.write_bytes(content)
        word, detail = process.answer(Path(folder))
    if word == SAME:
        return (SAME if detail == expected else ANOTHER), ""
    return (WRONG if word == REFUSED and damaged_file.name not in detail else word), detail


def outcomes(read, files, seed, numbers):
    """Yield (number, outcome, kind of damage, detail) for numbered damages to the last of the files."""
    whole = files[-1].read_bytes()
    with ReadingProcess(read) as process:
        _, expected = process.answer(files[-1].parent)
        if (word := outcome(process, files, whole, expected)[0]) != SAME:
            raise click.ClickException(f"{files[-1].name}: without damage the outcome is: {word}")
        for number, random in generators(seed, numbers):
            damage, content = damaged(whole, random)
            word, detail = outcome(process, files, content, expected)
            yield number, word, damage, detail


@click.command(help=__doc__.splitlines()[0])
@output_option
@click.option("--curves", type=click.IntRange(1), default=400, show_default=True, help="Number of damaged curves.")
@click.option("--others", type=click.IntRange(1), default=200, show_default=True, help="Number of each other kind.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Seed of all damages.")
def main(output, curves, others, seed):
    began, counts, failures = time.perf_counter(), {}, []
    with tempfile.TemporaryDirectory() as folder:
        for position, (kind, (read, names)) in enumerate(write_files(Path(folder)).items()):
            files = [Path(folder) / name for name in names]
            number, counts[kind] = curves if kind == "curve" else others, Counter()
            for index, word, damage, detail in outcomes(read, files, (seed, position), tqdm(range(number), desc=kind)):
                counts[kind][word] += 1
                if word not in (SAME, REFUSED):
                    failures.append({"kind": kind, "damage": index, "by": damage, "is": word, "why": detail[:300]})
    seconds = round(time.perf_counter() - began, 1)
    save({"seed": seed, "seconds": seconds, "counts": counts, "failures": failures}, output)
    for kind, words in counts.items():
        click.echo(f"{kind}: {', '.join(f'{number} {word}' for word, number in words.items())}")
    raise SystemExit(any(failure["is"] in (ANOTHER, WRONG) for failure in failures))


if __name__ == "__main__":
    main()
