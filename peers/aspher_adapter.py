"""ASPHER at given force: conjugate gradients from the level before, or a cascade from coarse grids at every level.

Called as: python aspher_adapter.py MODE request.npz answer.npz (see exchange.py), with one of these modes:
    levels : projected conjugate gradients (Polonsky & Keer 1999), preconditioned by transforms of the whole grid
    nested : a cascade in single and then double precision; it starts from zero pressure at every level
"""

import sys

import aspher
import numpy as np
from exchange import answer_request

COARSEST = 32  # least number of points along a side of the coarsest grid
CASCADE = {"backend": "fft", "precision": "float_then_double"}
MODE = sys.argv[1]


class Aspher:
    """Solver by exact convolution ("fft")."""

    def __init__(self, problem):
        self.problem = problem
        self.side = self.coarsest = problem.gap.shape[0]
        while self.coarsest % 2 == 0 and self.coarsest // 2 >= COARSEST:
            self.coarsest //= 2
        self.domain = {"domain_size": float(self.side), "E_star": 4.0}
        self.solver = aspher.ContactSolver(grid_size=self.side, **self.domain, backend="fft")

    def solve(self, level, tolerance, start):
        gap, depth = self.problem.gap, self.problem.depths[level]
        load = {"p_nominal": self.problem.forces[level] / gap.size}
        load["tol"] = tolerance * depth / np.ptp(gap)  # ASPHER's tolerance is relative to the range of the gap
        if MODE == "levels":
            start = np.maximum(depth - gap, 0) if start is None else start
            result = self.solver.solve(gap.ravel(), **load, precond="fourier-fft", p_init=start.ravel())
        else:
            cascade = {"coarsest": self.coarsest} | CASCADE
            result = aspher.solve_nested(self.side, gap.ravel(), **self.domain, **load, **cascade)
        return np.reshape(result.pressure, gap.shape), result.iterations


answer_request("aspher", Aspher)
