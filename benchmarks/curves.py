"""Measure what the package costs and how accurate it is; write it to a file with the name of the machine.

    python benchmarks/curves.py --output results/benchmarks.json [--reproduction]

Times are medians of repeats in one run; the repeats of what is compared are interleaved. `--reproduction` also times
the default workflow from nothing, in a folder of its own.
"""

import argparse
import contextlib
import csv
import json
import os
import pkgutil
import resource
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path
from unittest import mock

os.environ.update(OMP_NUM_THREADS="1", NUMBA_NUM_THREADS="1")  # before numpy: everything on one core
if (
    "MALLOC_TRIM_THRESHOLD_" not in os.environ
):  # as in the workflow, see workflow/rules/common.smk; read at the start only
    os.environ.update(MALLOC_MMAP_THRESHOLD_=str(2**25), MALLOC_TRIM_THRESHOLD_=str(10**9))
    os.execv(sys.executable, [sys.executable, *sys.argv])

import numpy as np
import pandas as pd
import scipy.fft

import viscorough
from viscorough import indent, reduce, self_affine_disc, self_affine_line
from viscorough.contact.halfspace import Halfspace
from viscorough_study.performance import timing

ROOT = Path(__file__).resolve().parents[1]
ELEMENTS, UNTIL, UNTIL_X = 257, 0.9, 30.0


def interleaved(functions, repeats):
    """Wall and processor seconds of every function, medians over interleaved repeats after one warm-up."""
    for function in functions.values():
        function()
    return {
        name: {"wall_s": wall, "processor_s": processor}
        for name, (wall, processor) in timing.interleaved(functions, repeats).items()
    }


def curves(hursts, seeds, repeats):
    """A loading curve of a disc: cost, and errors against levels that are many and solved to 1e-6."""
    rows = []
    for hurst in hursts:
        for seed in seeds:
            disc = self_affine_disc(hurst, ELEMENTS, seed=seed)
            arguments = {"until_fraction": UNTIL, "until_force": 4 * UNTIL_X}
            curve = indent(disc, **arguments)
            cost = interleaved({"curve": lambda d=disc, a=arguments: indent(d, **a)}, repeats)["curve"]
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


def lines(hursts, points, repeats):
    """An MDR line, generation included."""
    rows = []
    for hurst in hursts:

        def one(hurst=hurst):
            reduce(self_affine_line(hurst, points, seed=1), until_force=4 * UNTIL_X)

        rows.append({"hurst": hurst, "points": points, **interleaved({"line": one}, repeats)["line"]})
        print("line of {points} points at H = {hurst}: {wall_s:.3f} s".format(**rows[-1]))
    return rows


class Stopwatch:
    """Seconds spent in the functions that are watched, given as "module.function" or "module.Class.method"."""

    def __init__(self, **watched):
        self.seconds, self._patches = dict.fromkeys(watched, 0.0), []
        for part, names in watched.items():
            for name in names:
                function = pkgutil.resolve_name(name)
                self._patches.append(mock.patch(name, self._watch(part, function)))

    def _watch(self, part, function):
        def watched(*arguments, **options):
            start = time.process_time()
            try:
                return function(*arguments, **options)
            finally:
                self.seconds[part] += time.process_time() - start

        return watched

    def shares(self, function):
        """Processor seconds of the function, and the share of every part in them."""
        self.seconds = dict.fromkeys(self.seconds, 0.0)
        with contextlib.ExitStack() as stack:
            for patch in self._patches:
                stack.enter_context(patch)
            start = time.process_time()
            function()
            whole = time.process_time() - start
        shares = {part: round(seconds / whole, 3) for part, seconds in self.seconds.items()}
        return {"processor_s": round(whole, 4), **shares, "rest": round(1 - sum(shares.values()), 3)}


def parts(points):
    """What the time of curves and of a line goes into: medians of shares over repeats, after a warm-up."""
    of_curve = Stopwatch(
        operator=["viscorough.contact.halfspace.Halfspace.apply"],
        preconditioner=[f"viscorough.contact.preconditioner.Preconditioner.{name}" for name in ("prepare", "apply")],
        dense=[f"viscorough.contact.dense.{name}" for name in ("solve", "follow_events")],
        setup=[
            "viscorough.contact.grid_solver.GridSolver.__init__",
            "viscorough.contact.solver.ContactSolver.__init__",
        ],
    )
    of_line = Stopwatch(transform=["ducc0.fft.r2r_fftpack"], bins=["viscorough.mdr._bin_gaps"])
    rows = {}
    for across in (ELEMENTS, 1025):
        disc = self_affine_disc(0.6, across, seed=1)
        arguments = {"until_fraction": UNTIL, "until_force": 4 * UNTIL_X}
        rows[f"curve of a {across} disc"] = of_curve, lambda d=disc, a=arguments: indent(d, **a)
    rows[f"line of {points} points"] = of_line, lambda: reduce(self_affine_line(0.6, points, seed=1))
    result = {}
    for name, (stopwatch, function) in rows.items():
        function()
        repeats = pd.DataFrame([stopwatch.shares(function) for _ in range(5)])
        result[name] = repeats.median().to_dict()
        print(f"{name}: " + ", ".join(f"{part} {share:.3g}" for part, share in result[name].items()))
    heights, copy = np.zeros(points, np.float32), np.zeros(points, np.float32)
    copying = interleaved({"copy": lambda: np.copyto(copy, heights)}, 20)["copy"]["processor_s"]
    result["copy of the line's heights"] = {"processor_s": copying}
    print(f"copy of the line's heights: {1e3 * copying:.2f} ms")
    return result


def scipy_operator(load, kernel):
    """The same convolution, padded in full."""
    shape = kernel.shape[:1] * 2
    return scipy.fft.irfft2(scipy.fft.rfft2(load, shape) * kernel, shape)


def operators(repeats):
    """One application of the half-space operator, and what it would take with scipy's transforms."""
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


def reproduction(cores):
    """The default workflow from nothing: wall seconds, jobs, and the largest memory of a job in MB."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "snakemake", "--snakefile", str(ROOT / "Snakefile"), "--cores", str(cores)]
        start = time.perf_counter()
        subprocess.run([*command, "--directory", folder, "--quiet", "all"], check=True)
        wall = time.perf_counter() - start
        tables = list(Path(folder).glob("results/benchmarks/**/*.tsv"))
        rss = [float(next(csv.DictReader(table.open(), delimiter="\t"))["max_rss"] or 0) for table in tables]
    result = {"cores": cores, "wall_s": wall, "jobs": len(tables), "largest_job_mb": max(rss)}
    print(
        "default reproduction on {cores} cores: {wall_s:.0f} s, {jobs} jobs of at most {largest_job_mb:.0f} MB".format(
            **result
        )
    )
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True, help="file to write, JSON")
    parser.add_argument("--reproduction", action="store_true", help="time the default workflow, too")
    parser.add_argument("--cores", type=int, default=2, help="cores of the workflow")
    parser.add_argument("--repeats", type=int, default=5, help="repeats of which the median is taken")
    arguments = parser.parse_args()
    result = {
        "machine": timing.machine(),
        "viscorough": viscorough.__version__,
        "operator_ms": operators(10 * arguments.repeats),
        "parts": parts(4_000_000),
        "line": lines((0.1, 0.6, 0.9), 4_000_000, 3 * arguments.repeats),
        "curve": curves((0.1, 0.4, 0.6, 0.9), (1, 2), arguments.repeats),
    }
    result["memory_mb"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    if arguments.reproduction:
        result["reproduction"] = reproduction(arguments.cores)
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    arguments.output.write_text(json.dumps(result, indent=1) + "\n")
    print(f"written to {arguments.output}")


if __name__ == "__main__":
    main()
