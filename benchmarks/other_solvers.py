"""Other public contact solvers, run on the same levels as the elastic loading path, in separate environments.

Each solver is driven by an adapter in peers/, a script for the Python of the solver's environment, which does not
contain this package. Request and answer are .npz files, whose names are arguments of the adapter. Lengths are in
element sides and pressures in shear moduli G; the half-space is incompressible, so that E = 3, ν = 1/2 and E* = E/(1 −
ν²) = 4.

The request holds
    gap : initial gap of the indenter's elements to its highest point, nan outside it, shape (rows, columns)
    depths, forces : u and F/G of the levels, increasing, shape (levels,); a solver uses one or the other
    tolerance : as the solver defines it
    padding : side of the square grid to solve on (see padded_size)
    threads, maximum_seconds : threads; time limit

The answer holds
    version : version of the solver
    pressures : p/G, shape (levels, rows, columns)
    iterations : sum over all levels, -1 if not reported
    wall_s, processor_s : for all levels, without set-up
    memory : peak memory of the process in bytes

Convergence is judged here, by the residual of the pressures, in the same way for every solver.
"""

import os
import signal
import subprocess
import tempfile
import warnings
from pathlib import Path
from types import SimpleNamespace

import click
import numpy as np
from scipy.fft import next_fast_len

from viscorough.contact.halfspace.operator import Halfspace

ROOT = Path(__file__).resolve().parents[1]
# {solver: command that runs its adapter from ROOT}, also for solvers that `make peers` has not installed
ADAPTERS = {
    "ASPHER": (".venv-peers/bin/python", "peers/aspher_adapter.py", "levels"),
    "ASPHER nested": (".venv-peers/bin/python", "peers/aspher_adapter.py", "nested"),
    "ContactMechanics": (".venv-peers/bin/python", "peers/contactmechanics_adapter.py"),
    "SlipPY": (".venv-slippy/bin/python", "peers/slippy_adapter.py"),
    "Tamaas": (".venv-peers/bin/python", "peers/tamaas_adapter.py"),
}
# Environment variables for the number of threads, which libraries read on loading.
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def installed(names):
    """Return {solver: command that runs its adapter} of installed solvers; a message names the others."""
    missing = [name for name in names if not (ROOT / ADAPTERS[name][0]).is_file()]
    for name in missing:
        click.echo(f"{name} is not installed and is omitted (make peers installs it)", err=True)
    return {name: ADAPTERS[name] for name in names if name not in missing}


def solve(solver, indenter, depths, forces, tolerance, *, time_limit, threads=1):
    """Solve the given levels with another solver, each level started from the level before.

    solver : its name, and the command that runs its adapter
    depths, forces : u and F/G of the levels, in the indenter's unit of length; a solver uses one or the other
    tolerance : as the solver defines it; time_limit : seconds after which the run is abandoned

    Returns None if there is no solution, otherwise version, iterations, wall_s, processor_s and memory of the
    answer and, of shape (levels,), from its pressures
        force : F/G, in the user's unit of length
        residual : largest |gap| in contact or overlap outside it, over the depth
    If the solver's process fails, warns with the last line of its standard error.
    """
    name, command = solver
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
    with tempfile.TemporaryDirectory() as folder:
        paths = Path(folder) / "request.npz", Path(folder) / "answer.npz"
        np.savez(paths[0], **request)
        variables = os.environ | dict.fromkeys(THREADS, str(threads))
        done = subprocess.run([*command, *paths], cwd=ROOT, env=variables, capture_output=True, text=True)
        if done.returncode == -signal.SIGALRM:  # the time limit was reached
            return None
        if not paths[1].is_file():
            warnings.warn(f"{name}: {(done.stderr.strip() or 'no answer').splitlines()[-1]}", stacklevel=2)
            return None
        with np.load(paths[1]) as answer:
            pressures = answer["pressures"]
            told = {name: answer[name].item() for name in ("version", "iterations", "wall_s", "processor_s", "memory")}
            residual = np.array([contact_residual(gap, pressure) for pressure in pressures])
            return SimpleNamespace(force=pressures.sum(axis=(1, 2)) * indenter.spacing**2, residual=residual, **told)


def contact_residual(gap, pressure):
    """Return the largest |gap of the deformed surfaces| under pressure, or overlap elsewhere, over the depth.

    gap : initial gap to the highest point, nan outside the indenter; pressure : p/G; lengths in element sides

    The depth is the mean of deflection and initial gap under pressure. Returns infinity for pressure outside the
    indenter, and if there is no pressure.
    """
    rows, columns = gap.shape
    halfspace = Halfspace(rows, columns)
    halfspace.load[:, :columns] = pressure / (4 * np.pi)
    position = halfspace.apply()[:, :columns] + gap
    inside, contact = np.isfinite(gap), pressure > 0
    if not contact.any() or pressure[~inside].any():
        return np.inf
    depth = position[contact].mean()
    return max(np.abs(position[contact] - depth).max(), depth - position[inside].min()) / depth


def padded_size(elements):
    """Return the smallest size of a grid with a factor of 8 and no prime factor above 11, for fast transforms."""
    return 8 * next_fast_len(-(-elements // 8))
