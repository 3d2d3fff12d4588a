"""Measure the cost of a line, from random numbers to its loading curve, over that of a Fourier transform of its length.

    python benchmarks/lines.py --output results/lines.json

The transform is ducc0's: real, in place, in single precision, on one thread, of as many points as the line. It
alternates with lines, which are generated and reduced as in the workflow. Keys: `points`; the medians `line_wall_s` and
`transform_wall_s`; the `ratio` of both within a turn, as its `median` and quartiles `low` and `high`; and of the time
of a line the shares of its `waves` (random numbers and spectrum), of its `transform` and of the `bins` of its gaps.
"""

from functools import partial

import numpy as np
from ducc0 import fft
from measuring import command

from viscorough import line_waves
from viscorough.lines import SelfAffineLines
from viscorough.mdr import reduce_heights
from viscorough_study.performance.timing import timed

HURST, UNTIL_X, POINTS = 0.6, 30.0, 4_000_000


def measured(repeats, points=POINTS):
    """The content of the file; `points` is even."""
    lines = SelfAffineLines(HURST, points)
    noise = np.random.default_rng(1).standard_normal(points, np.float32)
    spectrum, amplitude = np.empty(points // 2, np.complex64), np.ones(points // 2 + 1, np.float32)
    walls = []
    for turn in range(repeats + 1):
        values = noise.copy()  # repeated transforms in place would overflow
        key = line_waves.key_of(np.random.SeedSequence(turn))
        transformed = partial(fft.r2r_fftpack, values, [0], real2hermitian=False, forward=False, out=values)
        _, transform, _ = timed(transformed)
        heights, made, _ = timed(partial(lines.heights_in_any_order, turn))
        _, bins, _ = timed(partial(reduce_heights, heights, lines.spacing, until_force=4 * UNTIL_X))
        _, waves, _ = timed(partial(line_waves.fill_packed_spectrum, spectrum, key, amplitude, fixed=False))
        walls.append((transform, made + bins, waves, made - waves, bins))
    walls = np.array(walls[1:])  # the first turn loads the compiled code
    transform, line, *parts = np.median(walls, axis=0).tolist()
    low, median, high = np.percentile(walls[:, 1] / walls[:, 0], [25, 50, 75]).tolist()
    return {
        "points": points,
        "line_wall_s": line,
        "transform_wall_s": transform,
        "ratio": {"median": median, "low": low, "high": high},
        **{name: part / line for name, part in zip(("waves", "transform", "bins"), parts, strict=True)},
    }


main = command(measured, repeats=25)

if __name__ == "__main__":
    main()
