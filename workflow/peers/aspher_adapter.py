"""ASPHER: projected conjugate gradients with a spectral preconditioner, at given force (Polonsky & Keer 1999).

Called as: python aspher_adapter.py request.npz answer.npz (see exchange.py).
"""

import aspher
import numpy as np
from exchange import answer_request


class Aspher:
    """Exact convolution ("fft"), with the preconditioner by transforms of the whole grid."""

    def __init__(self, problem):
        self.problem = problem
        side = problem.gap.shape[0]
        self.solver = aspher.ContactSolver(grid_size=side, domain_size=float(side), E_star=4.0, backend="fft")

    def solve(self, level, tolerance, start):
        gap, depth = self.problem.gap, self.problem.depths[level]
        if start is None:
            start = np.maximum(depth - gap, 0)
        result = self.solver.solve(
            gap.ravel(),
            p_nominal=self.problem.forces[level] / gap.size,
            tol=tolerance * depth / np.ptp(gap),  # ASPHER's is relative to the range of the gap
            precond="fourier-fft",
            p_init=start.ravel(),
        )
        return np.array(result.pressure), result.iterations

    def displacement(self, pressure):
        return np.asarray(self.solver.matvec(pressure.ravel())).reshape(pressure.shape)


answer_request("aspher", Aspher)
