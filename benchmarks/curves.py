"""Measure the cost and accuracy of curves, lines and operators, in one process on one thread.

    python benchmarks/curves.py --output results/benchmarks.json

The file has one key for each function below: operator_ms, column_ms, parts, over_operators, line, curve. Times are
medians of repeats in one run; the repeats of what is compared are interleaved. `make bench` runs it.
"""

import contextlib
import pkgutil
import time
from functools import partial

import ducc0
import numpy as np
import pandas as pd
from measuring import command, medians

from viscorough import indent, self_affine_disc
from viscorough.contact.halfspace.column_fft import ColumnConvolution, good_length
from viscorough.contact.halfspace.operator import Halfspace
from viscorough.lines import SelfAffineLines
from viscorough.mdr import reduce_heights
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


def curves(hursts, seeds, repeats):
    """Loading curves of discs: cost, and errors against many levels solved to 1e-6."""
    return [_curve(hurst, seed, repeats) for hurst in hursts for seed in seeds]


def _curve(hurst, seed, repeats):
    disc = self_affine_disc(hurst, ELEMENTS, seed=seed)
    compute = partial(indent, disc, until_fraction=UNTIL, until_force=4 * UNTIL_X)
    curve, (wall, processor) = compute(), medians({"curve": compute}, repeats)["curve"]
    at_levels = indent(disc, tolerance=1e-6, depths=curve.depth[curve.contact_count > 1])
    fine = indent(disc, tolerance=1e-6, depths=np.geomspace(curve.depth[0], curve.depth[-1] * (1 - 1e-9), 300))
    inside = fine.force <= curve.force[-1]
    depth, _ = curve.at_force(fine.force[inside])
    force_error = curve.force[curve.contact_count > 1] / at_levels.force - 1
    return {
        "hurst": hurst,
        "seed": seed,
        "wall_s": wall,
        "processor_s": processor,
        "operator_applications": curve.operator_applications,
        "force_error": float(np.abs(force_error).max()),
        "interpolation_error": float(np.abs(depth / fine.depth[inside] - 1).max()),
    }


def curve_of_line(lines):
    """Loading curve of one of the lines, as in the workflow."""
    return reduce_heights(lines.heights_in_any_order(1), lines.spacing, until_force=4 * UNTIL_X)


def lines(hursts, repeats):
    """Loading curves of lines by the method of dimensionality reduction, generation of the lines included."""
    functions = {hurst: partial(curve_of_line, SelfAffineLines(hurst, POINTS)) for hurst in hursts}
    return [
        {"hurst": hurst, "points": POINTS, "wall_s": wall, "processor_s": processor}
        for hurst, (wall, processor) in medians(functions, repeats).items()
    ]


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

    with contextlib.ExitStack() as restore:
        for part, names in parts.items():
            for name in names:
                owner, function = pkgutil.resolve_name(name.rpartition(".")[0]), pkgutil.resolve_name(name)
                restore.callback(setattr, owner, name.rpartition(".")[2], function)
                setattr(owner, name.rpartition(".")[2], timed(part, function))
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
        curve = partial(indent, disc, until_fraction=UNTIL, until_force=4 * UNTIL_X)
        rows[f"curve of a {across} disc"] = curve, PARTS_OF_CURVE
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
        curve = partial(indent, self_affine_disc(hurst, across, seed=3), until_fraction=UNTIL)
        applications = curve().operator_applications
        measured = [shares(curve, {"operator": PARTS_OF_CURVE["operator"]}) for _ in range(repeats)]
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


def columns(repeats):
    """Convolution of the columns alone [ms], and by ducc0's transforms with the product between them."""
    functions = {}
    for rows in (257, 1025):
        length = good_length(2 * (rows - 1))
        spectrum = np.random.default_rng(1).random((length // 2 + 1, rows))
        whole = spectrum[np.minimum(np.arange(length), length - np.arange(length))]
        for name, precision in (("double", np.complex128), ("single", np.complex64)):
            data = np.random.default_rng(2).random((rows, rows)).astype(precision)
            convolution = ColumnConvolution(rows, spectrum / length, data.real.dtype)
            functions[f"{rows} {name}"] = partial(lambda c, d: c.apply(d.copy()), convolution, data)
            functions[f"{rows} ducc0 {name}"] = partial(ducc0_columns, data, whole.astype(data.real.dtype))
    return {name: 1e3 * wall for name, (wall, _) in medians(functions, repeats).items()}


def ducc0_columns(data, spectrum):
    """The convolution of columns with rows of zeros below the data."""
    padded = np.zeros((len(spectrum), data.shape[1]), data.dtype)
    padded[: len(data)] = data
    transformed = ducc0.fft.c2c(padded, axes=[0])
    transformed *= spectrum
    return ducc0.fft.c2c(transformed, axes=[0], forward=False, inorm=2, out=transformed)[: len(data)]


def measured(repeats):
    """The content of the file."""
    return {
        "operator_ms": operators(10 * repeats),
        "column_ms": columns(10 * repeats),
        "parts": parts(),
        "over_operators": over_operators((0.1, 0.4, 0.9), ELEMENTS, 3 * repeats),
        "line": lines((0.1, 0.6, 0.9), 3 * repeats),
        "curve": curves((0.1, 0.4, 0.6, 0.9), (1, 2), repeats),
    }


main = command(measured, repeats=5)

if __name__ == "__main__":
    main()
