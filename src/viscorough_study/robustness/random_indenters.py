"""Random small indenters for detecting silent failures: solutions reported as converged that are wrong."""

from dataclasses import dataclass

import numpy as np

from viscorough.contact.options import DEFAULT
from viscorough.contact.solver import ContactSolver
from viscorough.errors import ConvergenceError
from viscorough.indenter import Indenter
from viscorough.viscous.integration.events import march_events
from viscorough_study.robustness.random_heights import random_heights, with_random_aspect
from viscorough_study.robustness.stress_solutions import GRID_ONLY


@dataclass(frozen=True)
class RandomCase:
    """An indenter, increasing depths, a tolerance, and whether the grid solver is used from the first element on."""

    indenter: Indenter
    depths: np.ndarray
    tolerance: float
    on_grid: bool


def random_case(generator):
    """A RandomCase from a numpy Generator: a small indenter of random kind and scale, random depths and tolerance."""
    heights = random_heights(generator)
    height, length = 10.0 ** generator.uniform(-12, 12, 2) if generator.random() < 0.3 else (1.0, 1.0)
    indenter = Indenter(height * heights, length)
    span = np.nanmax(indenter.initial_gap) or length
    depths = np.sort(span * 10.0 ** generator.uniform(-3, 1.5, 3))
    tolerance, on_grid = 10.0 ** -generator.uniform(1, 11), bool(generator.random() < 0.6)
    return RandomCase(with_random_aspect(indenter, generator), depths, tolerance, on_grid)


def silent_failure(case, solver_type=ContactSolver):
    """Error message on a converged solution of a RandomCase; "" if it is right.

    The solution is checked, by the dense influence matrix, for tension, and for a gap in contact or an overlap outside
    it of more than ten times the tolerance. The force is compared with that of the direct integration in time, which
    shares only the influence coefficients with the path. The rounding of the heights at small depths is allowed for.
    A ConvergenceError is not a silent failure; a level solved before it can be one.
    """
    options = GRID_ONLY if case.on_grid else DEFAULT
    solver, events = solver_type(case.indenter, case.tolerance, options), march_events(case.indenter)
    row, column = solver.elements.row, solver.elements.column
    influence = solver.elements.influence[abs(row[:, None] - row), abs(column[:, None] - column)]
    contact, wrong = solver.unloaded_state(), ""
    for depth in case.depths:
        try:
            contact = solver.advance(contact, depth)
        except ConvergenceError:
            return wrong
        reduced = contact.reduced_depth
        allowed = 10 * case.tolerance + 1e-13 / min(reduced, 1.0)
        gap = influence[:, contact.members] @ contact.reduced_pressure - reduced + solver.elements.initial_gap
        exact = np.interp(depth, events.depth, events.impulse)
        exact += max(depth - events.depth[-1], 0.0) * events.resistance[-1]
        if contact.pressure.min() < 0:
            wrong = f"tension {contact.pressure.min():.2g}"
        elif max(-gap.min(), np.abs(gap[contact.members]).max()) > allowed * reduced:
            wrong = f"overlap {-gap.min():.2g}, gap {gap[contact.members].max():.2g} at depth {reduced:.2g}"
        elif abs(contact.force / exact - 1) > allowed:
            wrong = f"force off by {contact.force / exact - 1:.2g}, tolerance {case.tolerance:.2g}, depth {reduced:.2g}"
    return wrong
