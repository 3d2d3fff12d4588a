"""Stand-in for ASPHER: the part of its interface that the adapter uses, solved exactly by a dense matrix."""

from types import SimpleNamespace

import dense_contact
import numpy as np


class ContactSolver:
    def __init__(self, grid_size, domain_size=1.0, E_star=1.0, *, backend=""):
        assert backend == "fft"
        self.shape, self.side, self.modulus = (grid_size, grid_size), domain_size / grid_size, E_star
        self.last = None

    def solve(self, gap, p_nominal, tol=1e-8, *, precond="none", p_init=None):
        """Solve one grid; `p_nominal` is the mean pressure over the grid, `tol` a share of the range of the gaps.

        `p_init` is the solution of the level before, from the second level on.
        """
        assert self.last is None or np.shares_memory(p_init, self.last)
        assert gap.shape == p_init.shape == (self.shape[0] * self.shape[1],)
        assert (p_init >= 0).all()
        assert p_init.any()
        force, square = p_nominal * gap.size * self.side**2, gap.reshape(self.shape)
        pressure = dense_contact.pressure_at_force(square, force, self.modulus, self.side)
        self.last = dense_contact.disturbed(pressure, tol * np.ptp(gap), self.modulus, self.side)
        return SimpleNamespace(pressure=self.last, iterations=5)


def solve_nested(grid_size, gap, p_nominal, *, domain_size, E_star, coarsest, tol, backend, precision):
    """Return the solution on the finest of the grids, whose numbers of points along a side are coarsest * 2^k."""
    assert (grid_size % coarsest, (grid_size // coarsest).bit_count()) == (0, 1)
    assert (backend, precision) == ("fft", "float_then_double")
    start = np.ones(gap.size)
    result = ContactSolver(grid_size, domain_size, E_star, backend="fft").solve(gap, p_nominal, tol, p_init=start)
    return SimpleNamespace(pressure=result.pressure.ravel(), iterations=result.iterations)
