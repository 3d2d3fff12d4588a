"""Integrate the viscous problem in explicit steps, as the paper proposes: solve it in every time step.

The impulse ∫F dt/η replaces the time, because the ratio of velocity and force of a given contact set does not depend on
the force. A step keeps the contact set of its start (forward Euler): with the deflection w of the surface and the
matrix K of influence coefficients of elements of side d,

    u′ = 1/(4π d Σq),    w′ = u′ K q,    K q = 1 on the contact set.

Elements that should come into contact in the step overlap the surface at its end, and are added then. So the error is
of first order in the length of the steps.
"""

import warnings
from typing import NamedTuple

import numpy as np

from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough.contact.grid.solver import GridSolver
from viscorough.contact.options import DEFAULT
from viscorough.viscous.integration.elements import elements_of_map

TOLERANCE = 1e-6  # relative error of q
# A larger ratio of overlap and depth gives a warning. The relative error of the depth is about as large as this ratio.
LARGEST_OVERLAP = 0.01


class Steps(NamedTuple):
    """Penetration at the ends of the steps; arrays of shape (steps,).

    impulse : ∫F dt/η [length²]; depth : u [length]; resistance : F/(ηv) [length]
    overlap : largest overlap of indenter and surface, relative to the depth
    """

    impulse: np.ndarray
    depth: np.ndarray
    resistance: np.ndarray
    overlap: np.ndarray


def explicit_steps(indenter, impulses):
    """Return the Steps that end at increasing impulses > 0 [length²]; the first step starts at zero.

    Raises ConvergenceError if q is negative, which is impossible for the exact q. Warns of an overlap of more than 1 %
    of the depth.
    """
    elements = elements_of_map(indenter, "explicit steps")
    # GridSolver applies its tolerance to Σq, whose relative error is about the square of the relative error of q.
    grid = GridSolver((0, 0, *elements.shape), elements, TOLERANCE**2, DEFAULT)
    gap = np.full_like(grid.initial_gap, np.inf)  # stays infinite at grid points without an element
    gap[grid.place] = elements.initial_gap
    inside = np.zeros(gap.shape, bool)
    pressure, gap_rate = np.zeros_like(gap), np.full_like(gap, -1.0)  # q and K q − 1
    depth, sum_of_pressures, rows = 0.0, 0.0, []
    lengths = np.diff(impulses / elements.units.stiffness, prepend=0.0)
    # Before the first step, only the first contact is solved. The ends of a step may be equal up to rounding.
    for step, length in enumerate([0.0, *lengths]):
        if length > 0:
            depth += length / sum_of_pressures
            gap += length / sum_of_pressures * gap_rate
        touching = gap <= 0
        if (touching & ~inside).any():
            inside |= touching
            sum_of_pressures = grid.solve_flat_punch(inside, pressure, gap_rate)
            if pressure.min() < -TOLERANCE * pressure.max():
                raise ConvergenceError(f"explicit steps: tension at depth {depth:g}; contact would open")
        if step > 0:
            rows.append((depth, elements.units.stiffness * sum_of_pressures, max(-gap.min(), 0.0) / depth))
    steps = Steps(np.asarray(impulses), *np.array(rows).T)
    if steps.overlap.max() > LARGEST_OVERLAP:
        warnings.warn(
            f"explicit steps: the indenter overlaps the surface by up to {steps.overlap.max():.2g} of its depth, which "
            "is about the error of the depth; more steps help",
            AccuracyWarning,
            stacklevel=2,
        )
    return steps
