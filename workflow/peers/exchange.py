"""Common part of the adapters of other contact solvers: request, timing of the levels, answer. Needs numpy only.

viscorough_study.performance.other_solvers describes the request, the answer and their units: lengths are in element
sides and pressures in shear moduli G; E = 3, ν = 1/2, E* = 4. A solver is a class that is called with a Problem and has
the methods `solve` and `displacement` (see answer_request).
"""

import os
import resource
import signal
import sys
import time
from dataclasses import dataclass
from importlib import metadata

import numpy as np


@dataclass
class Problem:
    """Initial gap on the padded grid, finite everywhere; levels given by depths and by forces F/G."""

    gap: np.ndarray
    depths: np.ndarray
    forces: np.ndarray
    threads: int


def answer_request(distribution, solver_class):
    """Read the request, the first argument of the command line, solve it and write the answer, the second argument.

    distribution : name under which the solver is installed, for its version
    solver_class : solver_class(problem) sets up everything that does not depend on the level. Its
        `solve(level, tolerance, start)` returns the pressure on the padded grid and the number of iterations (-1 if not
        reported); `start` is the pressure of the level before, None at the first level. Its `displacement(pressure)`
        uses the solver's own operator.
    """
    request = np.load(sys.argv[1])
    _limit_threads(int(request["threads"]))
    rows, columns = request["gap"].shape
    problem = Problem(_padded(request), request["depths"], request["forces"], int(request["threads"]))
    solver = solver_class(problem)
    levels = len(problem.depths)
    pressures, depth = np.full((levels, rows, columns), np.nan), np.full(levels, np.nan)
    iterations, wall, cpu = np.full(levels, -1), np.nan, np.nan
    signal.signal(signal.SIGALRM, _give_up)
    clocks = time.perf_counter(), time.process_time()
    signal.setitimer(signal.ITIMER_REAL, float(request["maximum_seconds"]))
    try:
        solved = _all_levels(solver, levels, float(request["tolerance"]))
        wall, cpu = time.perf_counter() - clocks[0], time.process_time() - clocks[1]
        signal.setitimer(signal.ITIMER_REAL, 0)
    except TimeoutError:
        pass
    else:
        for level, (pressure, count) in enumerate(solved):
            pressures[level], iterations[level] = pressure[:rows, :columns], count
            depth[level] = np.mean((solver.displacement(pressure) + problem.gap)[pressure > 0])
    np.savez(
        sys.argv[2],
        version=metadata.version(distribution),
        pressures=pressures,
        wall=wall,
        cpu=cpu,
        iterations=iterations,
        depth=depth,
        memory_mb=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6,
    )


def _all_levels(solver, levels, tolerance):
    """Solve level after level, each from the pressure of the one before."""
    solved, start = [], None
    for level in range(levels):
        solved.append(solver.solve(level, tolerance, start))
        start = solved[-1][0]
    return solved


def _padded(request):
    """Initial gap on the padded grid; outside the indenter just too large for contact: more slows some solvers."""
    gap, side = request["gap"], int(request["padding"])
    inside = np.isfinite(gap)
    largest = max(gap[inside].max(), 1.1 * request["depths"][-1])
    padded = np.full((max(side, gap.shape[0]), max(side, gap.shape[1])), largest)
    padded[: gap.shape[0], : gap.shape[1]] = np.where(inside, gap, largest)
    return padded


def _limit_threads(threads):
    """Restart this script with the number of threads in its environment, which libraries read on loading."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    if any(os.environ.get(name) != str(threads) for name in names):
        os.environ.update(dict.fromkeys(names, str(threads)))
        os.execv(sys.executable, [sys.executable, *sys.argv])


def _give_up(*_):
    raise TimeoutError
