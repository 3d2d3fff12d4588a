"""Common part of the adapters of other contact solvers: request, timing of the levels, answer. Needs numpy only.

benchmarks/other_solvers.py describes the request, the answer and their units: lengths are in element sides and
pressures in shear moduli G; E = 3, ν = 1/2, E* = 4. A solver is a class that is called with a problem and has the
method `solve` (see answer_request).
"""

import re
import signal
import sys
import time
from importlib import metadata
from pathlib import Path
from types import SimpleNamespace

import numpy as np


def answer_request(distribution, solver_class):
    """Read the request, the last argument but one of the command line, and write the answer, the last argument.

    distribution : name under which the solver is installed, for its version
    solver_class : solver_class(problem) sets up everything that does not depend on the level. Problems have the fields
        `gap`, on the padded grid, finite everywhere; `depths` and `forces` (F/G), one per level; and `threads`. Its
        `solve(level, tolerance, start)` returns the pressure on the padded grid and the number of iterations (-1 if not
        reported); `start` is the pressure of the level before, None at the first level.

    At the time limit the operating system ends this process.
    """
    request = np.load(sys.argv[-2])
    rows, columns = request["gap"].shape
    levels, threads = {name: request[name] for name in ("depths", "forces")}, int(request["threads"])
    problem = SimpleNamespace(gap=_padded(request), threads=threads, **levels)
    solver, pressures, iterations, start = solver_class(problem), [], 0, None
    signal.setitimer(signal.ITIMER_REAL, float(request["maximum_seconds"]))
    wall, processor = time.perf_counter(), time.process_time()
    for level in range(len(problem.depths)):
        start, count = solver.solve(level, float(request["tolerance"]), start)
        pressures.append(start[:rows, :columns])
        iterations += count
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    signal.setitimer(signal.ITIMER_REAL, 0)
    np.savez(
        sys.argv[-1],
        version=metadata.version(distribution),
        pressures=pressures,
        wall_s=wall,
        processor_s=processor,
        iterations=max(iterations, -1),
        memory=_peak_memory(),
    )


def _peak_memory():
    """Return the peak memory of this program in bytes; getrusage would also count the process which started it."""
    peak = re.search(r"VmHWM:\s+(\d+) kB", Path("/proc/self/status").read_text())
    return 1024.0 * int(peak[1])


def _padded(request):
    """Return the initial gap on the padded grid; outside the indenter it is just too large for contact.

    Larger values slow some solvers down.
    """
    gap, side = request["gap"], int(request["padding"])
    inside = np.isfinite(gap)
    largest = max(gap[inside].max(), 1.1 * request["depths"][-1])
    padded = np.full((side, side), largest)
    padded[: gap.shape[0], : gap.shape[1]] = np.where(inside, gap, largest)
    return padded
