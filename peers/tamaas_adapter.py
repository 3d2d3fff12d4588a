"""Tamaas: conjugate gradients of Polonsky & Keer (1999) as reworked by Rey et al. (2017), at given force.

Called as: python tamaas_adapter.py request.npz answer.npz (see exchange.py).
"""

import numpy as np
import tamaas
from exchange import answer_request

tamaas.set_log_level(tamaas.LogLevel.error)


class Tamaas:
    """Solve for the pressures: solving for the gaps needs the inverse operator, which only periodic models have."""

    def __init__(self, problem):
        self.problem = problem
        tamaas.initialize(problem.threads)
        shape = list(problem.gap.shape)
        self.model = tamaas.Model(tamaas.model_type.basic_2d, [float(n) for n in shape], shape)
        self.model.E, self.model.nu = 3.0, 0.5  # set before the operator is registered, which stores them
        tamaas.ModelFactory.registerNonPeriodic(self.model, "dcfft")

    def solve(self, level, tolerance, start):
        gap, depth = self.problem.gap, self.problem.depths[level]
        tolerance = tolerance * depth / np.ptp(gap)  # Tamaas's tolerance is relative to the range of the surface
        solver = tamaas.PolonskyKeerRey(self.model, -gap, tolerance)
        solver.setIntegralOperator("dcfft")
        solver.max_iter, solver.dump_freq = 20_000, 100_000
        if start is None:
            start = np.maximum(depth - gap, 0)
        self.model.traction[...] = start
        solver.solve(self.problem.forces[level] / start.size)
        return np.array(self.model.traction), -1


answer_request("tamaas", Tamaas)
