"""Time stepping of the viscous problem, as in a simulation that solves one contact problem per time step.

Nothing here uses the correspondence with the elastic problem. As in events the clock is the impulse
∫F dt/η: for a given contact set the velocity per force does not depend on the force, so steps of impulse serve any
F(t) ≥ 0. The explicit schemes hold the contact set over a step, so that elements which should have come into contact
during the step overlap the surface; the implicit scheme demands contact without overlap at the end of the step.
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
from viscorough.basics.types import Progress
from viscorough.contact.gap_map import gap_map
from viscorough.contact.grid.solver import GridSolver
from viscorough.contact.options import DEFAULT
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.surfaces.indenter import Indenter
from viscorough.viscous.integration.elements import elements_of_map

# Overlap over the depth from which on a warning is given: the error of the depth is about as large.
_WARN_OVERLAP = 0.01
# Largest depth of explicit steps, over the largest number of the precision of their fields.
_LARGEST_SHARE = 1e-8
# Accuracy of the impulse of an implicit step, over the tolerance of its contact problem, which leaves the force that
# uncertain itself, and most iterations for it.
_IMPULSE_ACCURACY, _MAX_NEWTON_ITERATIONS = 0.1, 50


@dataclass(frozen=True)
class Steps(ReadOnlyArrays):
    """The penetration of an indenter at given impulses; read-only arrays of shape (impulses,).

    Attributes
    ----------
    impulse : array
        ∫F dt/η [length²].
    depth : array
        u [length].
    resistance : array
        F/(ηv) of the contact at that impulse [length].
    contact_count : array
        Elements in contact.
    overlap : array
        Largest overlap of indenter and surface, over the depth [1].
    length_unit : str
        Unit of the lengths, as UDUNITS spells it; "1" if it is not known.
    """

    impulse: np.ndarray
    depth: np.ndarray
    resistance: np.ndarray
    contact_count: np.ndarray
    overlap: np.ndarray
    length_unit: str = "1"


def march_steps(
    indenter: Indenter,
    impulses: ArrayLike,
    *,
    scheme: str = "explicit",
    tolerance: float = 1e-6,
    progress: Progress | None = None,
) -> Steps:
    """Penetration of a rigid indenter into a linearly viscous half-space by steps of impulse.

    "explicit" (forward Euler) advances with u' = 1/(4π d Σq) and w' = u' K q, where K q = 1 on the elements that touch
    or overlap the surface at the start of the step. It is of first order in the steps. "heun" takes the mean of the
    velocities before and after the step that they predict. It is more accurate than "explicit" at equal steps
    (measured: `make speed`, results/tables/methods.csv), yet of first order as well, since the velocity jumps at
    contact events within a step. "implicit" (backward Euler) solves, in every step, the contact problem of the surface
    in its current shape: ΔP ≥ 0, e + KΔP − Δu ≥ 0 and one of them zero, with 4π d ΣΔP the impulse of the step. It is
    exact for steps of any size, because contact only grows.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    impulses : array_like
        ∫F dt/η at the ends of the steps, positive and increasing [length²]; the first step starts at zero.
    scheme : str, optional
        One of SCHEMES.
    tolerance : float, optional
        Residual of the contact problems, as in indent.
    progress : Progress, optional
        Function that is called at each of the impulses with the share of them that is done.

    Returns
    -------
    Steps

    Raises
    ------
    ValueError
        For arguments out of range.
    ConvergenceError
        If a contact problem is not solved.

    Warns
    -----
    AccuracyWarning
        Where the indenter overlaps the surface by more than 1 % of the depth.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> steps = viscorough.march_steps(disc, [0.01, 0.02], scheme="implicit")
    >>> bool(steps.depth[0] < steps.depth[1])
    True
    """
    if scheme not in SCHEMES:
        raise ValueError(f"time steps: scheme must be one of {', '.join(SCHEMES)}, not {scheme!r}")
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
        if progress:
            progress(len(rows) / impulses.size)
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
    """Surface and indenter in the explicit scheme; impulses are over 4π d, fields are flat as those of GridSolver."""

    def __init__(self, indenter: Indenter, tolerance: float) -> None:
        elements = elements_of_map(indenter, "time steps")
        # The error of Σq is the square of that of q.
        self._grid = GridSolver((0, 0, *elements.shape), elements, tolerance**2, DEFAULT)
        self._tolerance = tolerance
        self._gap = np.full_like(self._grid.initial_gap, np.inf)  # where there is no element, at every depth
        self._gap[self._grid.place] = elements.initial_gap
        self._largest_depth = _LARGEST_SHARE * np.finfo(self._gap.dtype).max
        self._inside = self._gap <= 0
        self._tangent, self._tangent_gap = np.zeros_like(self._gap), np.full_like(self._gap, -1.0)
        self.depth = 0.0
        self._solve_flat_punch()

    def step(self, impulse: float) -> None:
        """Advance by an impulse."""
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
        """Elements in contact."""
        return int(np.count_nonzero(self._inside))

    @property
    def overlap(self) -> float:
        """Largest overlap of indenter and surface, over the depth."""
        return max(-self._gap.min(), 0.0) / self.depth

    def _check_depth(self, depth: float) -> None:
        if not depth <= self._largest_depth:
            raise ValueError(
                f"time steps: depth {depth:g} is above {self._largest_depth:g}, the largest that is allowed; smaller "
                "impulses are needed"
            )

    def _solve_flat_punch(self) -> None:
        """q, K q − 1 and Σq of the contact set. Without adhesion no element may pull, and none of a flat punch does."""
        self.resistance = self._grid.solve_flat_punch(self._inside, self._tangent, self._tangent_gap)
        if self._tangent.min() < -self._tolerance * self._tangent.max():
            raise ConvergenceError(f"time steps: tension at depth {self.depth:g}; contact would open")


class _Heun(_Explicit):
    """The explicit scheme with the mean of the velocities at the start of the step and at its predicted end."""

    def step(self, impulse: float) -> None:
        """Advance by an impulse."""
        self._check_depth(self.depth + impulse / self.resistance)
        start_velocity, start_gap = 1 / self.resistance, self._tangent_gap / self.resistance
        predicted = self._inside | (self._gap + impulse * start_gap <= 0)
        if np.array_equal(predicted, self._inside):
            super().step(impulse)
            return
        inside, start = self._inside, (self._tangent.copy(), self._tangent_gap.copy(), self.resistance)
        self._inside = predicted
        self._solve_flat_punch()
        self.depth += 0.5 * impulse * (start_velocity + 1 / self.resistance)
        self._gap += 0.5 * impulse * (start_gap + self._tangent_gap / self.resistance)
        touching = inside | (self._gap <= 0)
        if np.any(predicted & ~touching):  # too many were predicted: q carries load where there is no contact
            self._tangent, self._tangent_gap, self.resistance = start
        if not np.array_equal(touching, predicted):
            self._inside = touching
            self._solve_flat_punch()


class _Implicit:
    """Surface and indenter in the implicit scheme; impulses are over 4π d."""

    def __init__(self, indenter: Indenter, tolerance: float) -> None:
        self._gap, self._tolerance = indenter.initial_gap, tolerance
        self._spacings = indenter.spacing, indenter.row_spacing
        self.depth, self.resistance, self.count, self.overlap = 0.0, 0.0, 0, 0.0

    def step(self, impulse: float) -> None:
        """Advance by an impulse; the depth that belongs to it is found by Newton's method."""
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


_INTEGRATORS: dict[str, Any] = {"explicit": _Explicit, "heun": _Heun, "implicit": _Implicit}
SCHEMES = tuple(_INTEGRATORS)
