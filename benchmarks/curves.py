"""Measure what curves, lines and operators cost and how accurate they are, in one process on one thread.

    python benchmarks/curves.py --output results/benchmarks.json [--reproduction]

The file has the name of the machine and one key for each function below: operator_ms, column_ms, operator_rounding,
memory_bytes, parts, over_operators, line, curve; with `--only KEY`, that one. Times are medians of repeats in one run;
the repeats of what is compared are interleaved. `--reproduction` also times the default workflow from nothing, in a
temporary folder.
"""

import argparse
import contextlib
import csv
import os
import pkgutil
import resource
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

import ducc0
import numpy as np
import pandas as pd
import scipy.fft

import viscorough
from viscorough import indent, self_affine_disc, self_affine_line
from viscorough.contact.column_fft import ColumnConvolution, good_length
from viscorough.contact.halfspace import Halfspace
from viscorough.lines import SelfAffineLines
from viscorough.mdr import reduce_heights
from viscorough_study.performance import timing
from viscorough_study.tables import write_json

ROOT = Path(__file__).resolve().parents[1]
ELEMENTS, UNTIL, UNTIL_X = 257, 0.9, 30.0
# One thread, and an allocator that keeps its pages as in the workflow: both are read when a process starts.
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
    "MALLOC_MMAP_THRESHOLD_": str(2**25),
    "MALLOC_TRIM_THRESHOLD_": str(10**9),
}
# Functions whose share of the time is measured, by the part of the computation that they are.
PARTS_OF_CURVE = {
    "operator": ("viscorough.contact.halfspace.Halfspace.apply",),
    "preconditioner": (
        "viscorough.contact.preconditioner.Preconditioner.prepare",
        "viscorough.contact.preconditioner.Preconditioner.apply",
    ),
    "dense": ("viscorough.contact.dense.solve", "viscorough.contact.dense.follow_events"),
    "setup": (
        "viscorough.contact.grid_solver.GridSolver.__init__",
        "viscorough.contact.solver.ContactSolver.__init__",
    ),
}
PARTS_OF_LINE = {
    "waves": ("viscorough.line_waves.fill_packed_spectrum",),
    "transform": ("ducc0.fft.c2c", "viscorough.line_waves.twiddle"),
    "bins": ("viscorough.mdr._bin_gaps",),
}


def interleaved(functions, repeats):
    """Wall and processor seconds of every function, medians over interleaved repeats after one warm-up."""
    for function in functions.values():
        function()
    return {
        name: {"wall_s": wall, "processor_s": processor}
        for name, (wall, processor) in timing.interleaved(functions, repeats).items()
    }


def curves(hursts, seeds, repeats):
    """Loading curves of discs: cost, and errors against many levels solved to 1e-6."""
    rows = []
    for hurst in hursts:
        for seed in seeds:
            disc = self_affine_disc(hurst, ELEMENTS, seed=seed)
            arguments = {"until_fraction": UNTIL, "until_force": 4 * UNTIL_X}
            curve = indent(disc, **arguments)
            cost = interleaved({"curve": partial(indent, disc, **arguments)}, repeats)["curve"]
            at_levels = indent(disc, tolerance=1e-6, depths=curve.depth[curve.contact_count > 1])
            between = np.geomspace(curve.depth[0], curve.depth[-1] * (1 - 1e-9), 300)
            fine = indent(disc, tolerance=1e-6, depths=between)
            inside = fine.force <= curve.force[-1]
            depth, stiffness = curve.at_force(fine.force[inside])
            force_error = curve.force[curve.contact_count > 1] / at_levels.force - 1
            rows.append(
                {
                    "hurst": hurst,
                    "seed": seed,
                    **cost,
                    "levels": len(curve.depth),
                    "operator_applications": curve.operator_applications,
                    "last_contact_fraction": float(curve.contact_fraction[-1]),
                    "last_x": float(curve.force[-1] / 4),
                    "force_error": float(np.abs(force_error).max()),
                    "interpolation_error": float(np.abs(depth / fine.depth[inside] - 1).max()),
                    "velocity_error_median": float(np.median(np.abs(stiffness / fine.stiffness[inside] - 1))),
                    "velocity_error_largest": float(np.abs(stiffness / fine.stiffness[inside] - 1).max()),
                }
            )
            print(
                "disc of {e} at H = {hurst}: {wall_s:.2f} s, {levels} levels, {operator_applications} operators, "
                "force {force_error:.1e}, interpolation {interpolation_error:.1e}".format(e=ELEMENTS, **rows[-1])
            )
    return rows


def curve_of_line(lines):
    """Loading curve of one of the lines, as in the workflow."""
    return reduce_heights(lines.heights_in_any_order(1), lines.spacing, until_force=4 * UNTIL_X)


def lines(hursts, points, repeats):
    """Loading curves of lines by the reduction of dimensionality, generation of the lines included."""
    rows = []
    for hurst in hursts:
        one = partial(curve_of_line, SelfAffineLines(hurst, points))
        rows.append({"hurst": hurst, "points": points, **interleaved({"line": one}, repeats)["line"]})
        print("line of {points} points at H = {hurst}: {wall_s:.3f} s".format(**rows[-1]))
    return rows


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
    of_parts = {part: round(spent / whole, 3) for part, spent in seconds.items()}
    return {"processor_s": round(whole, 4), **of_parts, "rest": round(1 - sum(of_parts.values()), 3)}


def parts(points):
    """Shares of the parts of curves and of a line: medians over five repeats, after a first run."""
    rows = {}
    for across in (ELEMENTS, 1025):
        disc = self_affine_disc(0.6, across, seed=1)
        curve = partial(indent, disc, until_fraction=UNTIL, until_force=4 * UNTIL_X)
        rows[f"curve of a {across} disc"] = curve, PARTS_OF_CURVE
    rows[f"line of {points} points"] = partial(curve_of_line, SelfAffineLines(0.6, points)), PARTS_OF_LINE
    result = {}
    for name, (function, of_function) in rows.items():
        function()
        repeats = pd.DataFrame([shares(function, of_function) for _ in range(5)])
        result[name] = repeats.median().to_dict()
        print(f"{name}: " + ", ".join(f"{part} {share:.3g}" for part, share in result[name].items()))
    heights, copy = np.zeros(points, np.float32), np.zeros(points, np.float32)
    copying = interleaved({"copy": lambda: np.copyto(copy, heights)}, 20)["copy"]["processor_s"]
    result["copy of the line's heights"] = {"processor_s": copying}
    print(f"copy of the line's heights: {1e3 * copying:.2f} ms")
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
        row = {"hurst": hurst, "processor_s": float(seconds), "ratio": float(1 / share), "operators": applications}
        rows.append(row)
        print("disc of {e} at H = {hurst}: {ratio:.2f} times its {operators} operators".format(e=across, **row))
    return rows


def scipy_operator(load, kernel):
    """The same convolution with full padding."""
    shape = kernel.shape[:1] * 2
    return scipy.fft.irfft2(scipy.fft.rfft2(load, shape) * kernel, shape)


def operators(repeats):
    """One application of the half-space operator [ms], and the same with scipy's transforms."""
    functions = {}
    for n in (257, 1025):
        load = np.random.default_rng(1).random((n, n))
        kernel = np.random.default_rng(2).random((2 * (n - 1), n))
        for name, precision in (("double", np.float64), ("single", np.float32)):
            halfspace = Halfspace(n, n, precision)
            halfspace.load[:, :n] = load
            functions[f"{n} {name}"] = halfspace.apply
            functions[f"{n} scipy {name}"] = partial(scipy_operator, load.astype(precision), kernel.astype(precision))
    rows = {name: cost["wall_s"] * 1e3 for name, cost in interleaved(functions, repeats).items()}
    for name, milliseconds in rows.items():
        print(f"operator {name}: {milliseconds:.2f} ms")
    return rows


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
    milliseconds = {name: cost["wall_s"] * 1e3 for name, cost in interleaved(functions, repeats).items()}
    print("columns [ms]: " + ", ".join(f"{name} {value:.2f}" for name, value in milliseconds.items()))
    return milliseconds


def ducc0_columns(data, spectrum):
    """The convolution of columns with rows of zeros below the data."""
    padded = np.zeros((len(spectrum), data.shape[1]), data.dtype)
    padded[: len(data)] = data
    transformed = ducc0.fft.c2c(padded, axes=[0])
    transformed *= spectrum
    return ducc0.fft.c2c(transformed, axes=[0], forward=False, inorm=2, out=transformed)[: len(data)]


def rounding(repeats):
    """Largest error of the operator in single precision over the largest deflection, in units of its rounding."""
    result = {}
    for n in (257, 1025):
        double, single = Halfspace(n, n), Halfspace(n, n, np.float32)
        errors = []
        for seed in range(repeats):
            load = np.random.default_rng(seed).random((n, n)).astype(np.float32)
            double.load[:, :n], single.load[:, :n] = load, load
            exact = double.apply()[:, :n]
            errors.append(np.abs(single.apply()[:, :n] - exact).max() / np.abs(exact).max())
        result[str(n)] = float(max(errors) / np.finfo(np.float32).eps)
    print("rounding of the operator: " + ", ".join(f"{n} across {error:.2g}" for n, error in result.items()))
    return result


def memory(points):
    """Peak memory of the arrays: bytes per point of the map of a disc, and over the heights of a line."""
    across = 513
    disc, disc_bytes = timing.with_memory(lambda: self_affine_disc(0.6, across, seed=1))
    _, curve_bytes = timing.with_memory(partial(indent, disc, until_fraction=UNTIL))
    line, line_bytes = timing.with_memory(lambda: self_affine_line(0.6, points, seed=1))
    result = {
        "curve, per point of the map": curve_bytes / across**2,
        "disc, per point of its square": disc_bytes / across**2,
        "line, over its heights": line_bytes / line.heights.nbytes,
    }
    print("memory: " + ", ".join(f"{name} {value:.3g}" for name, value in result.items()))
    return result


def reproduction(cores):
    """The default workflow from nothing: wall seconds, jobs, and the peak memory of a job in MB."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "snakemake", "--snakefile", str(ROOT / "Snakefile"), "--cores", str(cores)]
        start = time.perf_counter()
        subprocess.run([*command, "--directory", folder, "--quiet", "all"], check=True)
        wall = time.perf_counter() - start
        tables = list(Path(folder).glob("results/benchmarks/**/*.tsv"))
        rss = [float(next(csv.DictReader(table.open(), delimiter="\t"))["max_rss"] or 0) for table in tables]
    result = {"cores": cores, "wall_s": wall, "jobs": len(tables), "largest_job_mb": max(rss)}
    about = "default reproduction on {cores} cores: {wall_s:.0f} s, {jobs} jobs of at most {largest_job_mb:.0f} MB"
    print(about.format(**result))
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True, help="file to write, JSON")
    parser.add_argument("--reproduction", action="store_true", help="time the default workflow, too")
    parser.add_argument("--only", metavar="KEY", help="only this key")
    parser.add_argument("--cores", type=int, default=2, help="cores of the workflow")
    parser.add_argument("--repeats", type=int, default=5, help="repeats of which the median is taken")
    arguments = parser.parse_args()
    if any(os.environ.get(name) != value for name, value in ENVIRONMENT.items()):
        os.environ.update(ENVIRONMENT)
        os.execv(sys.executable, [sys.executable, *sys.argv])
    repeats = arguments.repeats
    measurements = {
        "operator_ms": lambda: operators(10 * repeats),
        "column_ms": lambda: columns(10 * repeats),
        "operator_rounding": lambda: rounding(repeats),
        "memory_bytes": lambda: memory(4_000_000),
        "parts": lambda: parts(4_000_000),
        "over_operators": lambda: over_operators((0.1, 0.4, 0.9), ELEMENTS, 3 * repeats),
        "line": lambda: lines((0.1, 0.6, 0.9), 4_000_000, 3 * repeats),
        "curve": lambda: curves((0.1, 0.4, 0.6, 0.9), (1, 2), repeats),
    }
    keys = [arguments.only] if arguments.only else measurements
    result = {"machine": timing.machine(), "viscorough": viscorough.__version__}
    result |= {key: measurements[key]() for key in keys}
    result["memory_mb"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    if arguments.reproduction:
        result["reproduction"] = reproduction(arguments.cores)
    write_json(result, arguments.output)
    print(f"written to {arguments.output}")


if __name__ == "__main__":
    main()
