"""Other public contact solvers, run on the same levels as the elastic loading path, in separate environments.

Each solver is driven by an adapter (workflow/peers), a script for the Python of the solver's environment, which lacks
this package. Request and answer are .npz files, whose names are arguments of the adapter. Lengths are in element sides
and pressures in shear moduli G; the half-space is incompressible, so that E = 3, ν = 1/2 and E* = E/(1 − ν²) = 4.

The request holds
    gap : initial gap of the indenter's elements to its highest point, nan outside it, shape (rows, columns)
    depths, forces : u and F/G of the levels, increasing, shape (levels,); a solver uses one or the other
    tolerance : the solver's own
    padding : side of the square grid to solve on (see padded_size)
    threads, maximum_seconds : threads; time limit

The answer holds
    version : of the solver
    pressures : p/G, shape (levels, rows, columns)
    depth : mean of deflection + initial gap over the contact, by the solver's own operator, shape (levels,)
    iterations : -1 if not reported, shape (levels,)
    wall, cpu : seconds without set-up, nan beyond the time limit
    memory_mb : peak memory of the process in MB

Convergence is judged here, by the residual of the pressures, in the same way for every solver.
"""

import subprocess
import tempfile
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.fft import next_fast_len

from viscorough.contact.halfspace.operator import Halfspace


@dataclass(frozen=True)
class OtherSolver:
    """A solver: its name, the Python of its environment, and its adapter."""

    name: str
    python: Path
    adapter: Path

    @property
    def installed(self):
        """Whether its environment exists."""
        return self.python.is_file()


@dataclass(frozen=True)
class Solution:
    """Levels solved by another solver; arrays of shape (levels,), lengths in the user's unit.

    depth, force : u and F/G of its pressures
    residual : largest |gap| in contact or overlap outside it, over the depth, computed from its pressures
    iterations : -1 if not reported
    wall_s, processor_s : for all levels, without set-up; memory : peak memory of its process [bytes]
    version : of the solver
    """

    version: str
    depth: np.ndarray
    force: np.ndarray
    residual: np.ndarray
    iterations: np.ndarray
    wall_s: float
    processor_s: float
    memory: float

    @property
    def total_iterations(self):
        """Iterations of all levels, -1 if not reported."""
        return int(self.iterations.sum()) if (self.iterations >= 0).all() else -1


def solve(solver, indenter, depths, forces, tolerance, *, threads=1, time_limit=60.0):
    """Solution by another solver at the given levels, each started from the level before.

    depths, forces : u and F/G of the levels, in the indenter's unit of length; a solver uses one or the other
    tolerance : the solver's own; time_limit : seconds after which the run is abandoned

    Returns None where there is no solution. If the solver's process fails, warns with the last line of its standard
    error.
    """
    gap = indenter.initial_gap / indenter.spacing
    request = {
        "gap": gap,
        "depths": np.asarray(depths) / indenter.spacing,
        "forces": np.asarray(forces) / indenter.spacing**2,
        "tolerance": tolerance,
        "padding": padded_size(max(gap.shape)),
        "threads": threads,
        "maximum_seconds": time_limit,
    }
    answer = _run_adapter(solver, request, time_limit + 60)
    return _solution(answer, gap, indenter.spacing) if answer and np.isfinite(answer["wall"]) else None


def _run_adapter(solver, request, seconds):
    """The answer of the solver's adapter to a request, as a dictionary; None, with a warning, if there is none."""
    with tempfile.TemporaryDirectory() as folder:
        paths = Path(folder) / "request.npz", Path(folder) / "answer.npz"
        np.savez(paths[0], **request)
        command = [solver.python, solver.adapter, *paths]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
        except subprocess.TimeoutExpired:
            warnings.warn(f"{solver.name}: no answer within {seconds:g} s", stacklevel=3)
            return None
        if done.returncode or not paths[1].is_file():
            reason = (done.stderr.strip() or "no answer").splitlines()[-1]
            warnings.warn(f"{solver.name}: {reason}", stacklevel=3)
            return None
        with np.load(paths[1]) as answer:
            return {name: answer[name] for name in answer.files}


def _solution(answer, gap, spacing):
    """Solution in the unit of the spacing."""
    # The answer holds the depth, which solvers at given force determine and solvers at given depth keep.
    pressures, depths = answer["pressures"], answer["depth"]
    residual = [contact_residual(gap, pressure, depth) for pressure, depth in zip(pressures, depths, strict=True)]
    return Solution(
        version=str(answer["version"]),
        depth=depths * spacing,
        force=pressures.sum(axis=(1, 2)) * spacing**2,
        residual=np.array(residual),
        iterations=answer["iterations"],
        wall_s=float(answer["wall"]),
        processor_s=float(answer["cpu"]),
        memory=float(answer["memory_mb"]) * 1e6,
    )


def contact_residual(gap, pressure, depth):
    """Largest |gap of the deformed surfaces| under pressure, or overlap elsewhere, over the depth.

    gap : initial gap to the highest point, nan outside the indenter; pressure : p/G; lengths in element sides

    Returns infinity for pressure outside the indenter, and if there is no pressure.
    """
    rows, columns = gap.shape
    halfspace = Halfspace(rows, columns)
    halfspace.load[:, :columns] = pressure / (4 * np.pi)
    deformed_gap = halfspace.apply()[:, :columns] - depth + gap
    inside = np.isfinite(gap)
    contact = inside & (pressure > 0)
    pressed_outside = np.abs(pressure[~inside]).max(initial=0.0) > 0
    if pressed_outside or not contact.any():
        return np.inf
    return max(np.abs(deformed_gap[contact]).max(), -deformed_gap[inside].min(), 0.0) / depth


def padded_size(elements):
    """Smallest size of a grid with a factor of 8 and no prime factor above 11, for fast transforms."""
    return 8 * next_fast_len(-(-elements // 8))
