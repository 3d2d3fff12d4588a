"""Measure what the curve of a strip costs beside that of a square of as many elements.

    python benchmarks/strips.py --output results/strips.json

Levels of both are at the same contact fractions, up to one half: where a curve needs its levels is a property of the
heights, not of the solver. Each shape is computed in a separate process, on one thread and after a first small one;
repeats alternate. The file has medians of wall and processor seconds and of the peak memory of the process, of which
the interpreter, libraries and compiled code take the part named `before_bytes`. `make bench` runs it.
"""

import numpy as np
import pandas as pd
from measuring import command, in_a_process, peak_bytes

from viscorough import Indenter, indent, self_affine_line
from viscorough.surfaces import self_affine_square
from viscorough_study.performance import timing

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


def cost(kind, shape):
    """Cost of the levels of one indenter, in this process."""
    indent(Indenter(white_noise((40, 40)), 1.0))  # loads compiled code
    indenter, before = Indenter(KINDS[kind](shape), 1.0), peak_bytes()
    curve = indent(indenter, until_fraction=FRACTIONS[-1])
    depths = np.interp(FRACTIONS, curve.contact_fraction, curve.depth)
    curve, wall, processor = timing.timed(lambda: indent(indenter, depths=depths))
    return {
        "wall_s": wall,
        "processor_s": processor,
        "peak_bytes": peak_bytes(),
        "before_bytes": before,
        "operator_applications": curve.operator_applications,
        "last_contact_fraction": float(curve.contact_fraction[-1]),
    }


def measured(repeats):
    """{kind: {shape: medians, and those of strips over those of the square}}"""
    result = {}
    for kind in KINDS:
        runs = [
            {"shape": f"{shape[0]} x {shape[1]}"} | in_a_process("strips", "cost", kind, shape)
            for _ in range(repeats)
            for shape in SHAPES
        ]
        medians = pd.DataFrame(runs).groupby("shape", sort=False).median()
        over_square = medians[["processor_s", "peak_bytes"]] / medians[["processor_s", "peak_bytes"]].iloc[0]
        result[kind] = medians.join(over_square.add_suffix("_over_square")).to_dict("index")
    return result


main = command(measured, repeats=7)

if __name__ == "__main__":
    main()
