"""Measure the cost and accuracy of curves and lines, in one process on one thread.

    python benchmarks/curves.py --output results/benchmarks.json

The file has one key for each function below: over_operator, columns, line, rectangles, large_map, curve.
Times are medians of repeats in one run. Repeats of compared computations are interleaved. `make bench` runs it.
"""

import contextlib
import itertools
import pkgutil
from functools import partial
from unittest.mock import patch

import click
import numpy as np
import pandas as pd
from ducc0 import fft
from measuring import output_option, run_timed, save

from viscorough import Indenter, contact_at, indent, self_affine_disc
from viscorough.contact.halfspace.operator import Convolution, spectrum_of_grid
from viscorough.mdr import reduce_heights
from viscorough.surfaces.lines import SelfAffineLines
from viscorough.surfaces.self_affine import self_affine_square
from viscorough_study.performance import timing

ELEMENTS, UNTIL, UNTIL_X = 257, 0.9, 30.0
POINTS = 4_000_000  # points of a line
# {function: name of the step of the solution that it does}; the steps do not contain each other.
STEPS_OF_CURVE = {
    "viscorough.contact.halfspace.operator.Convolution.apply": "operator",
    "viscorough.contact.preconditioner.Preconditioner.prepare": "preparation of the preconditioner",
    "viscorough.contact.preconditioner.Preconditioner.apply": "preconditioner",
    "viscorough.contact.grid.state.GridWorkspace.contact_set": "indices of the contact set",
    "viscorough.contact.grid.state.GridWorkspace.add_penetrating_elements": "growth of the contact set",
    "viscorough.contact.grid.loops.GridLoops.update_gap": "update of the gap",
    "viscorough.contact.grid.solver.initial_tangent": "start of the tangent",
    "viscorough.contact.step_control.StepControl.excess": "error of the interpolation",
}


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


def columns(sizes, repeats):
    """Half-space operators of both precisions: processor time with convolutions by ducc0 over that with our own."""
    ratios = []
    for elements, precision in itertools.product(sizes, ("single", "double")):
        dtype = {"single": np.float32, "double": np.float64}[precision]
        with patch("viscorough.contact.halfspace.operator._COMPILED_FROM", 0):
            shape, spectrum = (elements, elements), spectrum_of_grid(elements, elements)
            operators = {once: Convolution(shape, spectrum, dtype, once=once) for once in (False, True)}
        calls = {once: partial(repeated, operator.apply, 1 + 2000 // elements) for once, operator in operators.items()}
        measured = medians(calls, repeats)
        ratio = measured[True][1] / measured[False][1]
        ratios.append({"elements": elements, "precision": precision, "library_over_own": round(ratio, 3)})
    return ratios


def repeated(function, times):
    """Call a function several times."""
    for _ in range(times):
        function()


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
    """Return the cost of the steps of a curve relative to its half-space operator, for each Hurst exponent.

    `whole` is the processor time of the curve, relative to that of all applications of the operator. A step has the
    number of its calls, and the processor time of a call relative to that of an application. Values are medians.
    """
    result = {}
    for hurst in hursts:
        compute = whole_curve(self_affine_disc(hurst, elements, seed=1))
        compute()
        wholes, costs = [], []
        for _ in range(repeats):
            whole, calls = timed_calls(compute, STEPS_OF_CURVE)
            applications, operator = calls["operator"]
            wholes.append(whole / operator)
            costs.append({step: spent / number * applications / operator for step, (number, spent) in calls.items()})
        steps = {
            step: {"calls": calls[step][0], "cost": round(cost, 2)}
            for step, cost in pd.DataFrame(costs).median().items()
        }
        result[hurst] = {"whole": round(float(np.median(wholes)), 2), **steps}
    return result


def timed_calls(compute, names):
    """Call a function; return its processor seconds, and {step: (number of calls, processor seconds in all)}.

    names : {dotted name of a function that is counted: name of its step}
    """
    calls = dict.fromkeys(names.values(), (0, 0.0))

    def measured(step, function):
        def call(*arguments, **options):
            result, _, processor = timing.timed(partial(function, *arguments, **options))
            number, seconds = calls[step]
            calls[step] = number + 1, seconds + processor
            return result

        return call

    with contextlib.ExitStack() as patches:
        for name, step in names.items():
            patches.enter_context(patch(name, measured(step, pkgutil.resolve_name(name))))
        _, _, whole = timing.timed(compute)
    return whole, calls


@click.command(help=__doc__.splitlines()[0])
@click.option("--repeats", type=click.IntRange(1), default=5, show_default=True)
@output_option
def main(repeats, output):
    content = {
        "over_operator": over_operator((0.1, 0.4, 0.6, 0.9), 3 * repeats),
        "columns": columns((17, 33, 65, 129, 257, 513, 1025), 3 * repeats),
        "line": lines((0.1, 0.6, 0.9), 3 * repeats),
        "rectangles": rectangles((1.0, 2.0, 0.5, 5.0, 0.2), repeats),
        "large_map": large_map(2049),
        "curve": [curve(hurst, seed, repeats) for hurst in (0.1, 0.4, 0.6, 0.9) for seed in (1, 2)],
    }
    save({"repeats": repeats, **content}, output)


if __name__ == "__main__":
    run_timed(main)
