"""ContactMechanics: constrained conjugate gradients without restart, at given depth (Bugnicourt et al. 2018).

Called as: python contactmechanics_adapter.py request.npz answer.npz (see exchange.py).
"""

from contextlib import redirect_stdout

import numpy as np
from ContactMechanics import FreeFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from exchange import answer_request
from SurfaceTopography import Topography


class ContactMechanics:
    """Solve the dual problem, whose unknowns are the forces on elements of unit area, that is, the pressures."""

    def __init__(self, problem):
        self.problem = problem
        sizes = tuple(float(n) for n in problem.gap.shape)
        substrate = FreeFFTElasticHalfSpace(problem.gap.shape, 4.0, sizes)
        self.system = NonSmoothContactSystem(substrate, Topography(-problem.gap, sizes))

    def solve(self, level, tolerance, start):
        depth = self.problem.depths[level]
        with redirect_stdout(None):
            result = self.system.dual_minimize_proxy(
                depth,
                init_force=np.zeros(self.problem.gap.shape) if start is None else start,
                solver="ccg-without-restart",
                gtol=tolerance * depth,
                maxiter=20_000,
            )
        return result.x.reshape(self.problem.gap.shape), result.nit


answer_request("ContactMechanics", ContactMechanics)
