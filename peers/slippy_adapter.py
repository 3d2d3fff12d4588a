"""SlipPY: bound-constrained conjugate gradients at given depth (Vollebregt 2014).

Called as: python slippy_adapter.py request.npz answer.npz (see exchange.py).
"""

import warnings

import numpy as np
import slippy
from exchange import answer_request

slippy.CUDA = False

from slippy.core import bccg, elastic_influence_matrix_spatial, plan_convolve  # noqa: E402


class Slippy:
    """Take as unknowns the elements at which the undeformed surfaces overlap, as SlipPY's own static step does."""

    def __init__(self, problem):
        self.problem = problem
        slippy.CORES = problem.threads
        span = tuple(2 * n for n in problem.gap.shape)
        influence = elastic_influence_matrix_spatial("zz", span, (1.0, 1.0), shear_mod=1.0, v=0.5)
        self.convolve = plan_convolve(problem.gap, influence, problem.gap < problem.depths[-1], False, fft_im=False)

    def solve(self, level, tolerance, start):
        gap, depth = self.problem.gap, self.problem.depths[level]
        candidates = gap < depth
        self.convolve.change_domain(candidates)
        pressure = np.zeros(gap.shape)
        start = pressure if start is None else start
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pressure[candidates], _ = bccg(
                self.convolve, (depth - gap)[candidates], tolerance, 20_000, start[candidates]
            )
        return pressure, -1


answer_request("slippy", Slippy)
