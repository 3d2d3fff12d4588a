"""Small indenters of every kind, generated at random, and what their solutions must not be wrong about in silence."""

import numpy as np

from viscorough.contact.options import DEFAULT
from viscorough.contact.solver import ContactSolver
from viscorough.errors import ConvergenceError
from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_disc
from viscorough.viscous.events import march_events
from viscorough_study.performance.ablations import GRID_ONLY

KINDS = ("uniform", "normal", "whole numbers", "hill", "rough disc", "steps", "strip", "ridge", "one spike", "flat")


def random_case(generator):
    """A small indenter of a random kind and scale, three depths, a tolerance, and whether to use the grid."""
    kind, rows, columns = generator.choice(KINDS), *generator.integers(1, 13, 2)
    row, column = np.mgrid[:rows, :columns] - np.array([rows, columns])[:, None, None] * generator.random((2, 1, 1))
    if kind == "normal":
        heights = generator.standard_normal((rows, columns))
    elif kind == "whole numbers":
        heights = generator.integers(0, generator.integers(2, 6), (rows, columns)).astype(float)
    elif kind == "hill":
        heights = -(np.hypot(row, column) ** generator.uniform(0.5, 4))
    elif kind == "rough disc":
        heights = self_affine_disc(
            generator.random(), int(generator.integers(3, 13)), seed=int(generator.integers(2**32))
        ).heights
    elif kind == "steps":
        heights = np.floor(generator.uniform(0.1, 2) * row + generator.uniform(0.1, 2) * column)
    elif kind == "strip":
        heights = generator.random((1, int(generator.integers(1, 100))))
    elif kind == "ridge":
        heights = -abs(row + generator.normal() * column) + 1e-3 * generator.random((rows, columns))
    elif kind == "one spike":
        heights = 1e-6 * generator.random((rows, columns))
        heights[rows // 2, columns // 2] = 1.0
    else:
        heights = np.zeros((rows, columns)) if kind == "flat" else generator.random((rows, columns))
    if generator.random() < 0.3 and heights.size > 3:
        heights = np.where(generator.random(heights.shape) < generator.random() * 0.8, np.nan, heights)
        heights.flat[generator.integers(heights.size)] = 0.5
    height, length = 10.0 ** generator.uniform(-12, 12, 2) if generator.random() < 0.3 else (1.0, 1.0)
    indenter = Indenter(height * heights, length)
    span = np.nanmax(indenter.initial_gap) or length
    depths = np.sort(span * 10.0 ** generator.uniform(-3, 1.5, 3))
    return indenter, depths, 10.0 ** -generator.uniform(1, 11), bool(generator.random() < 0.6)


def silent_failure(indenter, depths, tolerance, on_grid, solver_type=ContactSolver):
    """What is wrong, in words, with a solution that claims to have converged; "" if nothing is.

    Tension, and gap in contact or penetration outside over ten times the tolerance, are looked for with the dense
    influence matrix; the force is compared with events, which share no code with the path but influence coefficients.
    A ConvergenceError is no silent failure. Heights are known to rounding, which is allowed for at small depths.
    """
    solver, wrong = solver_type(indenter, tolerance, GRID_ONLY["single"] if on_grid else DEFAULT), ""
    row, column = solver.elements.row, solver.elements.column
    influence = solver.elements.influence[abs(row[:, None] - row), abs(column[:, None] - column)]
    events = march_events(indenter)
    contact = solver.unloaded_state()
    for depth in depths:
        try:
            contact = solver.advance(contact, depth)
        except ConvergenceError:
            return ""
        reduced = contact.reduced_depth
        allowed = 10 * tolerance + 1e-13 / min(reduced, 1.0)
        gap = influence[:, contact.members] @ contact.reduced_pressure - reduced + solver.elements.initial_gap
        exact = np.interp(depth, events.depth, events.impulse)
        exact += max(depth - events.depth[-1], 0.0) * events.resistance[-1]
        if contact.pressure.min() < 0:
            wrong = f"tension {contact.pressure.min():.2g}"
        elif max(-gap.min(), np.abs(gap[contact.members]).max()) > allowed * reduced:
            wrong = f"overlap {-gap.min():.2g}, gap {gap[contact.members].max():.2g} at depth {reduced:.2g}"
        elif abs(contact.force / exact - 1) > allowed:
            wrong = f"force off by {contact.force / exact - 1:.2g}, tolerance {tolerance:.2g}, depth {reduced:.2g}"
    return wrong
