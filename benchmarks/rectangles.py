"""Measure the cost of a curve on rectangular elements, over that of one of the same heights on squares.

    python benchmarks/rectangles.py --output results/rectangles.json

Curves of rough maps of 257 x 257 elements at a tolerance of 1e-3, on one thread. Elements of every aspect dy/dx have
the same area, so that contact is spread over the same depths. Repeats alternate between the aspects; the file has the
medians of processor seconds and their ratio to those of squares.
`make bench` runs it.
"""

from functools import partial

from measuring import command, medians

from viscorough import Indenter, indent
from viscorough.surfaces import cut_disc, self_affine_square

ELEMENTS, TOLERANCE, SEED = 257, 1e-3, 3
ASPECTS = (1.0, 2.0, 0.5, 5.0, 0.2)
HURST = (0.3, 0.8)


def maps():
    """{name: heights} of whole squares and of discs."""
    squares = {hurst: self_affine_square(hurst, ELEMENTS, seed=SEED) for hurst in HURST}
    discs = {f"disc, H = {hurst:g}": cut_disc(square, ELEMENTS) for hurst, square in squares.items()}
    return {f"square, H = {hurst:g}": square for hurst, square in squares.items()} | discs


def costs(heights, repeats):
    """{aspect: costs} of the curve of one map."""
    curves = {
        aspect: partial(indent, Indenter(heights, (aspect**-0.5, aspect**0.5)), tolerance=TOLERANCE)
        for aspect in ASPECTS
    }
    processor = {aspect: seconds for aspect, (_, seconds) in medians(curves, repeats).items()}
    return {
        f"{aspect:g}": {"processor_s": seconds, "over_squares": seconds / processor[1.0]}
        for aspect, seconds in processor.items()
    }


def measured(repeats):
    """{map: {aspect: costs}}"""
    return {name: costs(heights, repeats) for name, heights in maps().items()}


main = command(measured, repeats=9)

if __name__ == "__main__":
    main()
