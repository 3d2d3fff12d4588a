"""Time stepping of the viscous problem, like a simulation that solves one contact problem per time step.

This module does not use the correspondence with the elastic problem. Here and in the module `events`, the impulse ∫F
dt/η replaces the time. For a given contact set, the ratio of velocity and force does not depend on the force. Therefore
steps of the impulse are valid for every force F(t) ≥ 0.

The explicit scheme keeps the contact set during a step. So elements that should come into contact in this step overlap
the surface at its end. The implicit scheme requires a contact without overlap at the end of the step.
"""

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics import units
from viscorough.basics.arrays import ReadOnlyArrays, increasing, real_number
from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough.basics.summaries import unit_power
from viscorough.contact.gap_map import gap_map
from viscorough.contact.grid.solver import GridSolver
from viscorough.contact.options import DEFAULT
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.surfaces.indenter import Indenter
from viscorough.viscous.integration.elements import elements_of_map

# If the ratio of overlap and depth exceeds this number, a warning is given. The relative error of the depth is about as
# large as this ratio.
_WARN_OVERLAP = 0.01
# Largest depth that the explicit scheme allows, as a share of the largest floating-point number in the precision of its
# arrays.
_LARGEST_SHARE = 1e-8
# Newton's method finds the depth of an implicit step. It ends when the relative error of the impulse is at most
# _IMPULSE_ACCURACY times the tolerance of the contact problem, or after _MAX_NEWTON_ITERATIONS iterations.
_IMPULSE_ACCURACY, _MAX_NEWTON_ITERATIONS = 0.1, 50


@dataclass(frozen=True)
class Steps(ReadOnlyArrays):
    """Penetration of an indenter into a viscous half-space at given impulses; read-only arrays of shape (impulses,).

    Attributes
    ----------
    impulse : array
        Impulse ∫F dt/η [length²].
    depth : array
        Depth u at each impulse [length].
    resistance : array
        Ratio F/(ηv) of the contact at each impulse [length].
    contact_count : array
        Number of elements in contact.
    overlap : array
        Largest overlap of indenter and surface, divided by the depth.
    length_unit : str
        Unit of the lengths, as UDUNITS spells it; "1" if it is not known.
    """

    impulse: np.ndarray
    depth: np.ndarray
    resistance: np.ndarray
    contact_count: np.ndarray
    overlap: np.ndarray
    length_unit: str = "1"


def newtonian_steps(
    indenter: Indenter,
    impulses: ArrayLike,
    *,
    scheme: str = "explicit",
    tolerance: float = 1e-6,
) -> Steps:
    """Compute the penetration of a rigid indenter into a linearly viscous half-space by steps of the impulse ∫F dt/η.

    The surface has the deflection w, K is the matrix of influence coefficients of elements of side d, and ′ is the
    derivative with respect to the impulse. There are two schemes:

    - "explicit" (forward Euler) advances with u′ = 1/(4π d Σq) and w′ = u′ K q, where K q = 1 on the elements that
      touch or overlap the surface at the start of the step. Its error is of first order in the steps.
    - "implicit" (backward Euler) solves a contact problem in every step, for the surface in its current shape with the
      gaps e: ΔP ≥ 0, e + KΔP − Δu ≥ 0, and ΔP (e + KΔP − Δu) = 0 at every element, where 4π d ΣΔP is the impulse of the
      step. This is exact for steps of any size, because the contact only grows.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    impulses : array_like
        Impulses ∫F dt/η at the ends of the steps, positive and increasing [length²]. The first step starts at zero.
    scheme : str, optional
        "explicit" or "implicit".
    tolerance : float, optional
        Tolerance of the contact problems, like the tolerance of `indent`.

    Returns
    -------
    Steps
        Depth, resistance and contact at `impulses`.

    Raises
    ------
    ValueError
        For arguments out of range.
    ConvergenceError
        If a contact problem is not solved.

    Warns
    -----
    AccuracyWarning
        If the indenter overlaps the surface by more than 1 % of the depth.

    Examples
    --------
    >>> import viscorough
    >>> from viscorough.viscous.integration.stepping import newtonian_steps
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> steps = newtonian_steps(disc, [0.01, 0.02], scheme="implicit")
    >>> bool(steps.depth[0] < steps.depth[1])
    True
    """
    if scheme not in _INTEGRATORS:
        raise ValueError(f"time steps: scheme must be one of {', '.join(_INTEGRATORS)}, not {scheme!r}")
    scale, unit = elements_of_map(indenter, "time steps").units.stiffness, indenter.length_unit
    tolerance = real_number("time steps: tolerance", tolerance)
    if not 1e-12 <= tolerance <= 0.1:
        raise ValueError(f"time steps: tolerance must be between 1e-12 and 0.1, not {tolerance!r}")
    impulses = np.atleast_1d(units.numbers(impulses, unit_power(unit, 2), unit, "time steps: impulses"))
    impulses = increasing("time steps: impulses", impulses, above_zero=True)
    integrator = _INTEGRATORS[scheme](indenter, tolerance)
    rows = []
    for step in np.diff(impulses / scale, prepend=0.0):
        integrator.step(step)
        rows.append((integrator.depth, integrator.resistance, integrator.count, integrator.overlap))
    depth, resistance, count, overlaps = np.array(rows).T
    if overlaps.max() > _WARN_OVERLAP:
        warnings.warn(
            f"time steps: with these steps the indenter overlaps the surface by up to {overlaps.max():.2g} of its "
            "depth, which is about the error of the depth; more steps or the implicit scheme help",
            AccuracyWarning,
            stacklevel=2,
        )
    return Steps(impulses, depth, scale * resistance, count.astype(int), overlaps, indenter.length_unit)


class _Explicit:
    """State of surface and indenter in the explicit scheme.

    Impulses are divided by 4π d, with elements of side d. Fields such as the gap are flat arrays on the grid, like
    the fields of GridSolver.
    """

    def __init__(self, indenter: Indenter, tolerance: float) -> None:
        elements = elements_of_map(indenter, "time steps")
        # Pass the square of the tolerance, so that q is accurate to `tolerance`. GridSolver applies its tolerance to
        # Σq, and the relative error of Σq is about the square of the relative error of q.
        self._grid = GridSolver((0, 0, *elements.shape), elements, tolerance**2, DEFAULT)
        self._tolerance = tolerance
        # The gap stays infinite at grid points without an element.
        self._gap = np.full_like(self._grid.initial_gap, np.inf)
        self._gap[self._grid.place] = elements.initial_gap
        self._largest_depth = _LARGEST_SHARE * np.finfo(self._gap.dtype).max
        self._inside = self._gap <= 0
        self._tangent, self._tangent_gap = np.zeros_like(self._gap), np.full_like(self._gap, -1.0)
        self.depth = 0.0
        self._solve_flat_punch()

    def step(self, impulse: float) -> None:
        """Advance by one step; `impulse` is the impulse of the step divided by 4π d."""
        depth_step = impulse / self.resistance
        self._check_depth(self.depth + depth_step)
        self._gap += depth_step * self._tangent_gap
        self.depth += depth_step
        touching = self._gap <= 0
        if np.any(touching & ~self._inside):
            self._inside |= touching
            self._solve_flat_punch()

    @property
    def count(self) -> int:
        """Return the number of elements in contact."""
        return int(np.count_nonzero(self._inside))

    @property
    def overlap(self) -> float:
        """Return the largest overlap of indenter and surface, relative to the depth."""
        return max(-self._gap.min(), 0.0) / self.depth

    def _check_depth(self, depth: float) -> None:
        if not depth <= self._largest_depth:
            raise ValueError(
                f"time steps: depth {depth:g} is above {self._largest_depth:g}, the largest that is allowed; smaller "
                "impulses are needed"
            )

    def _solve_flat_punch(self) -> None:
        """Solve K q = 1 on the contact set; store q, K q − 1 on the whole grid, and the sum Σq.

        q is the pressure of a flat punch with the shape of the contact set. Raises ConvergenceError if q is negative at
        an element, which is impossible for the exact q.
        """
        self.resistance = self._grid.solve_flat_punch(self._inside, self._tangent, self._tangent_gap)
        if self._tangent.min() < -self._tolerance * self._tangent.max():
            raise ConvergenceError(f"time steps: tension at depth {self.depth:g}; contact would open")


class _Implicit:
    """State of surface and indenter in the implicit scheme; impulses are divided by 4π d, with elements of side d."""

    def __init__(self, indenter: Indenter, tolerance: float) -> None:
        self._gap, self._tolerance = indenter.initial_gap, tolerance
        self._spacings = indenter.spacing, indenter.row_spacing
        self.depth, self.resistance, self.count, self.overlap = 0.0, 0.0, 0, 0.0

    def step(self, impulse: float) -> None:
        """Advance by one step; `impulse` is the impulse of the step divided by 4π d.

        Newton's method finds the change of depth in the step.
        """
        solver = ContactSolver(Indenter(-self._gap, *self._spacings), self._tolerance)
        depth_step = impulse / (self.resistance or 1.0)
        for _ in range(_MAX_NEWTON_ITERATIONS):
            contact = solver.advance(solver.unloaded_state(), depth_step)
            missing = impulse - contact.pressure_sum * solver.units.length
            if abs(missing) <= _IMPULSE_ACCURACY * self._tolerance * impulse:
                break
            depth_step += missing / contact.tangent_sum
        else:
            raise ConvergenceError(
                f"time steps: no depth found for an impulse of {impulse:g} in {_MAX_NEWTON_ITERATIONS} iterations"
            )
        self.depth += depth_step
        self._gap = np.maximum(gap_map(solver, contact), 0.0)
        self.resistance, self.count = contact.tangent_sum, contact.count
        self.overlap = contact.residual * depth_step / self.depth


_INTEGRATORS: dict[str, Any] = {"explicit": _Explicit, "implicit": _Implicit}
