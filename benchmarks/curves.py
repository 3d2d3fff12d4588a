"""Measure the cost and accuracy of curves and lines, in one process on one thread.

    python benchmarks/curves.py --output results/benchmarks.json

The file has the keys over_operator, line, rectangles, large_map and curve.
Times are medians of repeats in one run. Repeats of compared computations are interleaved. `make bench` runs it.
"""

from functools import partial
from unittest.mock import patch

import click
import numpy as np
from ducc0 import fft
from measuring import output_option, run_timed, save

from viscorough import Indenter, contact_at, indent, self_affine_disc
from viscorough.contact.halfspace.operator import Convolution
from viscorough.mdr import reduce_heights
from viscorough.surfaces.lines import SelfAffineLines
from viscorough.surfaces.self_affine import self_affine_square
from viscorough_study.performance import timing

ELEMENTS, UNTIL, UNTIL_X = 257, 0.9, 30.0
POINTS = 4_000_000  # points of a line


def whole_curve(disc):
    """Return a function that computes the loading curve of a disc."""
    return partial(indent, disc, until_fraction=UNTIL, until_force=4 * UNTIL_X)


def curve(hurst, seed, repeats):
    """Measure a loading curve of a disc: cost, and the error of the force against levels solved to 1e-6."""
    disc = self_affine_disc(hurst, ELEMENTS, seed=seed)
    computed, (wall, _) = whole_curve(disc)(), medians({"curve": whole_curve(disc)}, repeats)["curve"]
    several = computed.contact_count > 1
    exact = indent(disc, tolerance=1e-6, depths=computed.depth[several]).force
    return {
        "hurst": hurst,
        "seed": seed,
        "wall_s": wall,
        "operator_applications": computed.operator_applications,
        "force_error": float(np.abs(computed.force[several] / exact - 1).max()),
    }


def curve_of_line(lines):
    """Compute the loading curve of a line as the workflow does."""
    return reduce_heights(lines.heights_in_any_order(1), lines.spacing, until_force=4 * UNTIL_X)


def lines(hursts, repeats, points=POINTS):
    """Measure loading curves of lines by dimensionality reduction, including the generation of the lines.

    `over_transform`: time over the time of a single-precision real Fourier transform of equal length by ducc0.
    """
    noise = np.random.default_rng(1).standard_normal(points, np.float32)
    options = {"real2hermitian": False, "forward": False, "out": np.empty_like(noise)}
    functions = {hurst: partial(curve_of_line, SelfAffineLines(hurst, points)) for hurst in hursts}
    functions["transform"] = partial(fft.r2r_fftpack, noise, [0], **options)
    measured = medians(functions, repeats)
    transform, _ = measured.pop("transform")
    return [
        {"hurst": hurst, "points": points, "wall_s": wall, "over_transform": wall / transform}
        for hurst, (wall, _) in measured.items()
    ]


def rectangles(aspects, repeats, elements=ELEMENTS):
    """Return {dy/dx: processor time over squares} of curves with the same heights on elements of the same area."""
    heights = self_affine_square(0.8, elements, seed=3)
    maps = {aspect: Indenter(heights, (aspect**-0.5, aspect**0.5)) for aspect in aspects}
    measured = medians({aspect: partial(indent, surface) for aspect, surface in maps.items()}, repeats)
    return {aspect: processor / measured[1.0][1] for aspect, (_, processor) in measured.items()}


def large_map(points):
    """Measure the curve of a map like measured ones up to 50 % contact, and the contact at the force of about 10 %."""
    surface = Indenter(self_affine_square(0.8, points, seed=1), 1 / points)
    questions = {"curve": partial(indent, surface, until_fraction=0.5)}
    questions["contact"] = partial(contact_at, surface, force=9)
    return {question: {"wall_s": wall} for question, (wall, _) in medians(questions, 1).items()}


def medians(functions, repeats):
    """Return {name: (wall, processor) seconds}, medians over interleaved repeats after a first call of each."""
    for function in functions.values():
        function()
    return timing.interleaved(functions, repeats)


def over_operator(hursts, repeats, elements=ELEMENTS):
    """Return {Hurst exponent: processor time of a curve over that of its applications of the operator}, medians."""
    result, apply = {}, Convolution.apply
    for hurst in hursts:
        compute, ratios = whole_curve(self_affine_disc(hurst, elements, seed=1)), []
        compute()
        for _ in range(repeats):
            spent = []

            def measured(*arguments, spent=spent, **options):
                result, _, processor = timing.timed(partial(apply, *arguments, **options))
                spent.append(processor)
                return result

            with patch.object(Convolution, "apply", measured):
                _, _, whole = timing.timed(compute)
            ratios.append(whole / sum(spent))
        result[hurst] = round(float(np.median(ratios)), 2)
    return result


@click.command(help=__doc__.splitlines()[0])
@click.option("--repeats", type=click.IntRange(1), default=5, show_default=True)
@output_option
def main(repeats, output):
    content = {
        "over_operator": over_operator((0.1, 0.4, 0.6, 0.9), 3 * repeats),
        "line": lines((0.1, 0.6, 0.9), 3 * repeats),
        "rectangles": rectangles((1.0, 2.0, 0.5, 5.0, 0.2), repeats),
        "large_map": large_map(2049),
        "curve": [curve(hurst, seed, repeats) for hurst in (0.1, 0.4, 0.6, 0.9) for seed in (1, 2)],
    }
    save({"repeats": repeats, **content}, output)


if __name__ == "__main__":
    run_timed(main)
