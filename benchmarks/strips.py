"""Measure what the curve of a strip costs beside that of a square of as many elements.

    python benchmarks/strips.py --output results/strips.json

Levels of both are at the same contact fractions, up to one half: where a curve needs its levels is a property of the
heights, not of the solver. Each shape is computed in a separate process, on one thread and after a first small one;
repeats alternate. The file has medians of wall and processor seconds, and of the peak resident memory of the process
[MB], of which the interpreter and compiled code take the part named `before`. `make bench` runs it.
"""

import json
import os
import resource
import subprocess
import sys

import click
import numpy as np
import pandas as pd

import viscorough
from viscorough import Indenter, indent, self_affine_line
from viscorough.surfaces import self_affine_square
from viscorough_study.performance import timing
from viscorough_study.tables import write_json

ENVIRONMENT = {"OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
FRACTIONS = np.geomspace(0.01, 0.5, 15)
SQUARE, *STRIPS = SHAPES = ((316, 316), (1, 100_000), (100_000, 1), (2, 50_000))


def white_noise(shape):
    """Independent heights, the same for every shape."""
    return np.random.default_rng(1).random(shape)


def self_affine(shape):
    """Heights with H = 0.6; rows of a strip follow each other on one line."""
    if shape[0] == shape[1]:
        return self_affine_square(0.6, shape[0], seed=1)
    return self_affine_line(0.6, shape[0] * shape[1], seed=1, dtype=float).heights.reshape(shape)


def paraboloid(shape):
    """A smooth indenter as long as the map."""
    row, column = np.ogrid[: shape[0], : shape[1]]
    return -sum(((place - (n - 1) / 2) / max(shape)) ** 2 for place, n in zip((row, column), shape, strict=True))


KINDS = {function.__name__: function for function in (white_noise, self_affine, paraboloid)}


def resident_mb():
    """Peak resident memory of this process."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def measure(kind, shape):
    """Cost of the levels of one indenter, in this process."""
    indent(Indenter(white_noise((40, 40)), 1.0))  # loads compiled code
    indenter, before = Indenter(KINDS[kind](shape), 1.0), resident_mb()
    curve = indent(indenter, until_fraction=FRACTIONS[-1])
    depths = np.interp(FRACTIONS, curve.contact_fraction, curve.depth)
    curve, wall, processor = timing.timed(lambda: indent(indenter, depths=depths))
    return {
        "wall_s": wall,
        "processor_s": processor,
        "peak_mb": resident_mb(),
        "before_mb": before,
        "operator_applications": curve.operator_applications,
        "last_contact_fraction": float(curve.contact_fraction[-1]),
    }


def in_a_process(kind, shape):
    """The same, in a separate process."""
    command = [sys.executable, __file__, "--one", kind, *map(str, shape)]
    result = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env=os.environ | ENVIRONMENT)
    return json.loads(result.stdout)


@click.command()
@click.option("--repeats", type=click.IntRange(1), default=7, show_default=True, help="Of which the median is taken.")
@click.option("--output", help="File to write, JSON.")
@click.option("--one", type=(click.Choice(KINDS), int, int), help="Print the cost of one: kind, rows, columns.")
def main(repeats, output, one):
    """Time and memory of strips, over those of a square of as many elements."""
    if one:
        kind, *shape = one
        click.echo(json.dumps(measure(kind, tuple(shape))))
        return
    result = {"machine": timing.machine(), "viscorough": viscorough.__version__, "repeats": repeats}
    for kind in KINDS:
        runs = [{"shape": shape} | in_a_process(kind, shape) for _ in range(repeats) for shape in SHAPES]
        medians = pd.DataFrame(runs).groupby("shape", sort=False).median()
        ratios = (
            medians.loc[STRIPS, ["processor_s", "peak_mb"]] / medians.loc[[SQUARE], ["processor_s", "peak_mb"]].values
        )
        result[kind] = {f"{rows} x {columns}": row.to_dict() for (rows, columns), row in medians.iterrows()}
        for (rows, columns), ratio in ratios.iterrows():
            result[kind][f"{rows} x {columns}"]["over_square"] = ratio.to_dict()
            click.echo(
                f"{kind}, {rows} x {columns}: {ratio.processor_s:.2f} of the time, {ratio.peak_mb:.2f} of the memory"
            )
    if output:
        write_json(result, output)


if __name__ == "__main__":
    main()
