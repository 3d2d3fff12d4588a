"""Ways of the elastic path that users cannot choose: with a part left out, or another one in its place.

What a part brings is measured by the path without it, and where a part fails by the path with nothing else. Each is a
context: within it every indentation goes that way.
"""

from contextlib import ExitStack, contextmanager
from dataclasses import replace
from unittest.mock import patch

import numpy as np

from viscorough.contact import grid_solver, halfspace, preconditioner
from viscorough.contact import solver as contact_solver


@contextmanager
def double_precision():
    """Double precision throughout."""
    with patch.multiple(grid_solver, _PRECISION=np.float64, _SINGLE=0.0):
        yield


@contextmanager
def single_precision_only():
    """Gaps are never computed anew, as if the rounding of single precision did not count."""
    with patch.multiple(grid_solver, _SINGLE=0.0, _ROUNDING=0.0):
        yield


@contextmanager
def no_preconditioner():
    """Conjugate gradients as they are; steps of the preconditioner's own length are for the whole of it only."""
    itself = patch.object(preconditioner.Preconditioner, "apply", lambda level, residual: residual[level.places])
    with itself, patch.object(grid_solver, "_LENGTH", 0.0):
        yield


@contextmanager
def no_blocks():
    """The preconditioner's sparse part alone."""
    itself = {"apply": lambda level, residual: residual[level.places]}
    few, many = (patch.multiple(each, **itself) for each in (preconditioner._FewBlocks, preconditioner._ManyBlocks))
    with few, many, patch.object(grid_solver, "_LENGTH", 0.0):
        yield


@contextmanager
def no_tangent():
    """Every level starts from the pressure of the one before."""
    solve = grid_solver.GridSolver.solve

    def from_last_pressure(grid, contact, depth):
        fields = contact.fields
        still = replace(fields, rate=np.zeros_like(fields.rate), rate_gap=np.full_like(fields.rate_gap, -1.0))
        return solve(grid, replace(contact, fields=still), depth)

    with patch.object(grid_solver.GridSolver, "solve", from_last_pressure):
        yield


@contextmanager
def dense_only():
    """Dense solutions whatever their size."""
    with patch.multiple(contact_solver, _DENSE_MEMBERS=10**9, _DENSE_INTERACTIONS=10**12):
        yield


@contextmanager
def grid_only(precision):
    """Transforms on the grid, in "single" or "double" precision, even for one element in contact."""
    with ExitStack() as changes:
        changes.enter_context(patch.multiple(contact_solver, _DENSE_MEMBERS=0, _DENSE_INTERACTIONS=0))
        if precision == "double":
            changes.enter_context(patch.multiple(grid_solver, _PRECISION=np.float64, _SINGLE=1e-13))
        yield


@contextmanager
def no_padding():
    """No padding: the indenter has images at its own distance."""

    def spectrum(rows, columns):
        lengths = padded(rows, columns)[0]
        distance = (np.arange(m // 2 + 1.0) for m in lengths)
        row, column = (np.minimum(d, abs(n - d)) for d, n in zip(distance, (rows, columns), strict=True))
        kernel = halfspace.influence_coefficient(row[:, None], column)
        return lengths, halfspace.ducc0.fft.dct(kernel, type=1) / np.prod(lengths)

    padded = halfspace._spectrum
    with patch.object(halfspace, "_spectrum", spectrum):
        yield
