"""ASPHER's nested solution: every level by a cascade from coarse grids, in single and then in double precision.

Called as: python aspher_nested_adapter.py request.npz answer.npz (see exchange.py).
"""

import aspher
import numpy as np
from exchange import answer_request

COARSEST = 32  # least number of points along a side of the coarsest grid


class AspherNested:
    """Exact convolution ("fft"); the cascade starts from zero pressure, independent of the previous level."""

    def __init__(self, problem):
        self.problem = problem
        self.side = self.coarsest = problem.gap.shape[0]
        while self.coarsest % 2 == 0 and self.coarsest // 2 >= COARSEST:
            self.coarsest //= 2
        self.operator = aspher.ContactSolver(self.side, domain_size=float(self.side), E_star=4.0, backend="fft")

    def solve(self, level, tolerance, start):
        return self.nested(level, tolerance, backend="fft", precision="float_then_double")

    def nested(self, level, tolerance, **mode):
        gap, depth = self.problem.gap, self.problem.depths[level]
        result = aspher.solve_nested(
            self.side,
            gap.ravel(),
            p_nominal=self.problem.forces[level] / gap.size,
            domain_size=float(self.side),
            E_star=4.0,
            coarsest=self.coarsest,
            tol=tolerance * depth / np.ptp(gap),  # ASPHER's is relative to the range of the gap
            **mode,
        )
        return np.reshape(result.pressure, gap.shape), result.iterations

    def displacement(self, pressure):
        return np.asarray(self.operator.matvec(pressure.ravel())).reshape(pressure.shape)


if __name__ == "__main__":
    answer_request("aspher", AspherNested)
