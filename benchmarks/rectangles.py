"""Measure what a curve on rectangular elements costs beside one of the same heights on squares.

    python benchmarks/rectangles.py --output results/rectangles.json

Curves of rough maps of 257 x 257 elements at a tolerance of 1e-3, on one thread. Elements of every aspect dy/dx have
the same area, so that contact is spread over the same depths. Repeats alternate between the aspects; the file has the
medians of processor seconds, their ratio to those of squares of the same repeat, and operator applications and levels.
`make bench` runs it.
"""

import os
import time

os.environ |= dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")

import click
import numpy as np

import viscorough
from viscorough import Indenter, indent
from viscorough.surfaces import cut_disc, self_affine_square
from viscorough_study.performance import timing
from viscorough_study.tables import write_json

ELEMENTS, TOLERANCE, SEED = 257, 1e-3, 3
ASPECTS = (1.0, 2.0, 0.5, 5.0, 0.2)
HURST = (0.3, 0.8)


def maps():
    """{name: heights} of whole squares and of discs."""
    squares = {hurst: self_affine_square(hurst, ELEMENTS, seed=SEED) for hurst in HURST}
    discs = {f"disc, H = {hurst:g}": cut_disc(square, ELEMENTS) for hurst, square in squares.items()}
    return {f"square, H = {hurst:g}": square for hurst, square in squares.items()} | discs


def measure(heights, repeats):
    """{aspect: costs} of the curve of one map."""
    indenters = [Indenter(heights, (aspect**-0.5, aspect**0.5)) for aspect in ASPECTS]
    curves = [indent(indenter, tolerance=TOLERANCE) for indenter in indenters]  # also loads compiled code and tables
    seconds = np.empty((repeats, len(ASPECTS)))
    for repeat in range(repeats):
        for i in np.roll(np.arange(len(ASPECTS)), repeat):
            began = time.process_time()
            indent(indenters[i], tolerance=TOLERANCE)
            seconds[repeat, i] = time.process_time() - began
    ratios = np.median(seconds / seconds[:, :1], axis=0)
    return {
        f"{aspect:g}": {
            "processor_s": float(median),
            "over_squares": float(ratio),
            "operator_applications": curve.operator_applications,
            "levels": curve.depth.size,
        }
        for aspect, median, ratio, curve in zip(ASPECTS, np.median(seconds, axis=0), ratios, curves, strict=True)
    }


@click.command()
@click.option("--repeats", type=click.IntRange(1), default=9, show_default=True, help="Of which the median is taken.")
@click.option("--output", help="File to write, JSON.")
def main(repeats, output):
    """Time of loading curves on rectangular elements, over that on squares."""
    result = {"machine": timing.machine(), "viscorough": viscorough.__version__, "repeats": repeats}
    for name, heights in maps().items():
        result[name] = measure(heights, repeats)
        ratios = ", ".join(f"{cost['over_squares']:.2f} at {aspect}" for aspect, cost in result[name].items())
        click.echo(f"{name}: time over squares {ratios}")
    if output:
        write_json(result, output)


if __name__ == "__main__":
    main()
