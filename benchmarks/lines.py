"""Measure what a line costs, from random numbers to its loading curve, against one Fourier transform of its length.

    python benchmarks/lines.py --output results/lines.json

The transform is ducc0's: real, in place, in single precision, on one thread, of as many points as the line. It takes
turns with lines, which are made and reduced as in the workflow. Keys: `points`; the medians `line_wall_s` and
`transform_wall_s`; the `ratio` of both within a turn, as its `median` and quartiles `low` and `high`; and of the time
of a line the shares of its `waves` (random numbers and spectrum), of its `transform` and of the `bins` of its gaps.
"""

import argparse
import time
from pathlib import Path

import numpy as np
from ducc0 import fft

import viscorough
from viscorough import line_waves
from viscorough.lines import SelfAffineLines
from viscorough.mdr import reduce_heights
from viscorough_study.performance import timing
from viscorough_study.tables import write_json

HURST, UNTIL_X = 0.6, 30.0


def seconds(function, *arguments, **options):
    """Wall seconds of a call, and its result."""
    start = time.perf_counter()
    result = function(*arguments, **options)
    return time.perf_counter() - start, result


def measured(points, repeats):
    """The content of the file; `points` is even."""
    lines = SelfAffineLines(HURST, points)
    noise = np.random.default_rng(1).standard_normal(points, np.float32)
    spectrum, amplitude = np.empty(points // 2, np.complex64), np.ones(points // 2 + 1, np.float32)
    walls = []
    for turn in range(repeats + 1):
        values = noise.copy()  # transformed in place: again and again, they would overflow
        key = line_waves.key_of(np.random.SeedSequence(turn))
        transform, _ = seconds(fft.r2r_fftpack, values, [0], real2hermitian=False, forward=False, out=values)
        made, heights = seconds(lines.heights_in_any_order, turn)
        bins, _ = seconds(reduce_heights, heights, lines.spacing, until_force=4 * UNTIL_X)
        waves, _ = seconds(line_waves.fill_packed_spectrum, spectrum, key, amplitude, fixed=False)
        walls.append((transform, made + bins, waves, made - waves, bins))
    walls = np.array(walls[1:])  # the first turn loads the compiled code
    transform, line, *parts = np.median(walls, axis=0)
    low, median, high = np.percentile(walls[:, 1] / walls[:, 0], [25, 50, 75])
    return {
        "machine": timing.machine(),
        "viscorough": viscorough.__version__,
        "points": points,
        "line_wall_s": line,
        "transform_wall_s": transform,
        "ratio": {"median": median, "low": low, "high": high},
        **{name: part / line for name, part in zip(("waves", "transform", "bins"), parts, strict=True)},
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True, help="file to write, JSON")
    parser.add_argument("--points", type=int, default=4_000_000, help="number of points of a line")
    parser.add_argument("--repeats", type=int, default=25, help="turns of which medians are taken")
    arguments = parser.parse_args()
    result = measured(arguments.points, arguments.repeats)
    print("line of {points} points: {line_wall_s:.4f} s; its transform: {transform_wall_s:.4f} s".format(**result))
    print("ratio {median:.2f}, quartiles {low:.2f} and {high:.2f}".format(**result["ratio"]))
    print("waves {waves:.2f}, transform {transform:.2f}, bins {bins:.2f} of a line".format(**result))
    write_json(result, arguments.output)


if __name__ == "__main__":
    main()
