"""Measure the cost and accuracy of curves, lines and operators, in one process on one thread.

    python benchmarks/curves.py --output results/benchmarks.json

The file has one key for each function below: operator_ms, parts, over_operators, line, rectangles, large_map, curve.
Times are medians of repeats in one run; the repeats of what is compared are interleaved. `make bench` runs it.
"""

import contextlib
import pkgutil
import time
from functools import partial
from unittest.mock import patch

import numpy as np
import pandas as pd
from ducc0 import fft
from measuring import command, medians

from viscorough import Indenter, contact_at, indent, self_affine_disc
from viscorough.contact.halfspace.operator import Halfspace
from viscorough.lines import SelfAffineLines
from viscorough.mdr import reduce_heights
from viscorough.surfaces import self_affine_square
from viscorough_study.performance import timing

ELEMENTS, UNTIL, UNTIL_X = 257, 0.9, 30.0
POINTS = 4_000_000  # of a line
# Functions whose share of the time is measured, by the part of the computation that they are.
PARTS_OF_CURVE = {
    "operator": ("viscorough.contact.halfspace.operator.Halfspace.apply",),
    "preconditioner": (
        "viscorough.contact.preconditioner.multilevel.Preconditioner.prepare",
        "viscorough.contact.preconditioner.multilevel.Preconditioner.apply",
    ),
    "dense": ("viscorough.contact.dense.solve", "viscorough.contact.dense.follow_events"),
    "setup": (
        "viscorough.contact.grid.solver.GridSolver.__init__",
        "viscorough.contact.solver.ContactSolver.__init__",
    ),
}
PARTS_OF_LINE = {
    "waves": ("viscorough.line_waves.fill_packed_spectrum",),
    "transform": ("ducc0.fft.c2c", "viscorough.line_waves.twiddle"),
    "bins": ("viscorough.mdr._bin_gaps",),
}


def curve(hurst, seed, repeats):
    """Loading curve of a disc: cost, and errors against many levels solved to 1e-6."""
    disc = self_affine_disc(hurst, ELEMENTS, seed=seed)
    compute = partial(indent, disc, until_fraction=UNTIL, until_force=4 * UNTIL_X)
    computed, (wall, processor) = compute(), medians({"curve": compute}, repeats)["curve"]
    several = computed.contact_count > 1
    at_levels = indent(disc, tolerance=1e-6, depths=computed.depth[several])
    fine = indent(disc, tolerance=1e-6, depths=np.geomspace(computed.depth[0], computed.depth[-1] * (1 - 1e-9), 300))
    inside = fine.force <= computed.force[-1]
    depth, _ = computed.at_force(fine.force[inside])
    force_error = computed.force[several] / at_levels.force - 1
    return {
        "hurst": hurst,
        "seed": seed,
        "wall_s": wall,
        "processor_s": processor,
        "operator_applications": computed.operator_applications,
        "force_error": float(np.abs(force_error).max()),
        "interpolation_error": float(np.abs(depth / fine.depth[inside] - 1).max()),
    }


def curve_of_line(lines):
    """Loading curve of one of the lines, as in the workflow."""
    return reduce_heights(lines.heights_in_any_order(1), lines.spacing, until_force=4 * UNTIL_X)


def lines(hursts, repeats, points=POINTS):
    """Loading curves of lines by the method of dimensionality reduction, generation of the lines included.

    `over_transform`: over the time of a real Fourier transform of as many points by ducc0, in single precision.
    """
    noise = np.random.default_rng(1).standard_normal(points, np.float32)
    options = {"real2hermitian": False, "forward": False, "out": np.empty_like(noise)}
    functions = {hurst: partial(curve_of_line, SelfAffineLines(hurst, points)) for hurst in hursts}
    functions["transform"] = partial(fft.r2r_fftpack, noise, [0], **options)
    measured = medians(functions, repeats)
    transform, _ = measured.pop("transform")
    return [
        {"hurst": hurst, "points": points, "wall_s": wall, "processor_s": processor, "over_transform": wall / transform}
        for hurst, (wall, processor) in measured.items()
    ]


def rectangles(aspects, repeats, elements=ELEMENTS):
    """{dy/dx: processor time over that on squares} of curves of the same heights on elements of the same area."""
    heights = self_affine_square(0.8, elements, seed=3)
    maps = {aspect: Indenter(heights, (aspect**-0.5, aspect**0.5)) for aspect in aspects}
    measured = medians({aspect: partial(indent, surface) for aspect, surface in maps.items()}, repeats)
    return {aspect: processor / measured[1.0][1] for aspect, (_, processor) in measured.items()}


def large_map(points):
    """The curve of a map similar to measured ones up to 50 % contact, and the contact at the force of about 10 %."""
    surface = Indenter(self_affine_square(0.8, points, seed=1), 1 / points)
    questions = {"curve": partial(indent, surface, until_fraction=0.5)}
    questions["contact"] = partial(contact_at, surface, force=9)
    return {question: {"points": points, "wall_s": wall} for question, (wall, _) in medians(questions, 1).items()}


@contextlib.contextmanager
def stopwatch(parts):
    """{part: processor seconds} spent within the context in the functions of each part, given by dotted names."""
    seconds = dict.fromkeys(parts, 0.0)

    def timed(part, function):
        def call(*arguments, **options):
            start = time.process_time()
            try:
                return function(*arguments, **options)
            finally:
                seconds[part] += time.process_time() - start

        return call

    with contextlib.ExitStack() as patches:
        for part, names in parts.items():
            for name in names:
                patches.enter_context(patch(name, timed(part, pkgutil.resolve_name(name))))
        yield seconds


def shares(function, parts):
    """Processor seconds of a function, and the share of each part in them."""
    with stopwatch(parts) as seconds:
        _, _, whole = timing.timed(function)
    shares_of_parts = {part: round(spent / whole, 3) for part, spent in seconds.items()}
    return {"processor_s": round(whole, 4), **shares_of_parts, "rest": round(1 - sum(shares_of_parts.values()), 3)}


def parts():
    """Shares of the parts of curves and of a line: medians over five repeats, after a first run."""
    rows = {}
    for across in (ELEMENTS, 1025):
        disc = self_affine_disc(0.6, across, seed=1)
        compute = partial(indent, disc, until_fraction=UNTIL, until_force=4 * UNTIL_X)
        rows[f"curve of a {across} disc"] = compute, PARTS_OF_CURVE
    rows[f"line of {POINTS} points"] = partial(curve_of_line, SelfAffineLines(0.6, POINTS)), PARTS_OF_LINE
    result = {}
    for name, (function, timed_parts) in rows.items():
        function()
        result[name] = pd.DataFrame([shares(function, timed_parts) for _ in range(5)]).median().to_dict()
    return result


def over_operators(hursts, across, repeats):
    """Time of whole curves to 1e-3 over that of the half-space operators that they apply.

    Returns rows of hurst, processor_s of the curve, ratio, and the number of operators; medians over the repeats.
    """
    rows = []
    for hurst in hursts:
        compute = partial(indent, self_affine_disc(hurst, across, seed=3), until_fraction=UNTIL)
        applications = compute().operator_applications
        measured = [shares(compute, {"operator": PARTS_OF_CURVE["operator"]}) for _ in range(repeats)]
        seconds, share = (np.median([row[name] for row in measured]) for name in ("processor_s", "operator"))
        rows.append({"hurst": hurst, "processor_s": seconds, "ratio": 1 / share, "operators": applications})
    return rows


def operators(repeats):
    """One application of the half-space operator [ms]."""
    functions = {}
    for n in (257, 1025):
        for name, precision in (("double", np.float64), ("single", np.float32)):
            halfspace = Halfspace(n, n, precision)
            halfspace.load[:, :n] = np.random.default_rng(1).random((n, n))
            functions[f"{n} {name}"] = halfspace.apply
    return {name: 1e3 * wall for name, (wall, _) in medians(functions, repeats).items()}


def measured(repeats):
    """The content of the file."""
    return {
        "operator_ms": operators(10 * repeats),
        "parts": parts(),
        "over_operators": over_operators((0.1, 0.4, 0.9), ELEMENTS, 3 * repeats),
        "line": lines((0.1, 0.6, 0.9), 3 * repeats),
        "rectangles": rectangles((1.0, 2.0, 0.5, 5.0, 0.2), repeats),
        "large_map": large_map(2049),
        "curve": [curve(hurst, seed, repeats) for hurst in (0.1, 0.4, 0.6, 0.9) for seed in (1, 2)],
    }


main = command(measured, repeats=5)

if __name__ == "__main__":
    main()
