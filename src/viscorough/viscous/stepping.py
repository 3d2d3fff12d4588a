"""Time stepping of the viscous problem, as a simulation does that solves one contact problem per time step.

Nothing here uses the correspondence with the elastic problem. As in viscorough.viscous.events the clock is the impulse
∫F dt/η: for a given contact set, rates per impulse do not depend on the force, so steps of impulse serve any F(t) ≥ 0.
The explicit scheme holds the contact set over a step and lets elements that should have touched in between penetrate;
the implicit one demands contact without penetration at the end of the step.
"""

import warnings
from dataclasses import dataclass

import numpy as np

from viscorough.contact.grid_solver import GridSolver
from viscorough.contact.solver import ContactSolver
from viscorough.errors import AccuracyWarning, ConvergenceError
from viscorough.indenter import Indenter

SCHEMES = ("explicit", "heun", "implicit")
# Penetration over depth from which on users are warned: the error of the depth is about as large (measured).
_WARN = 0.01
_FAR = 1e290  # gaps where there is no element are larger


@dataclass(frozen=True)
class Steps:
    """The penetration of an indenter at given impulses; arrays of shape (impulses,).

    impulse : ∫F dt/η [length²]
    depth : u [length]
    resistance : F/(ηv) of the contact at that impulse [length]
    contact_count : elements in contact
    overlap : largest penetration of the surface by the indenter, over the depth [1]
    steps : contact problems solved in all
    """

    impulse: np.ndarray
    depth: np.ndarray
    resistance: np.ndarray
    contact_count: np.ndarray
    overlap: np.ndarray
    steps: int


def march_steps(indenter, impulses, *, scheme="explicit", overlap=np.inf, tolerance=1e-6):
    """Penetration of a rigid indenter into a linearly viscous half-space by steps of impulse.

    "explicit" (forward Euler) advances with u' = 1/(4π d Σq) and w' = u' K q, where K q = 1 on the elements that touch
    or penetrate at the start of the step. Its error is of first order in the steps. "heun" takes the mean of the rates
    before and after the step that they predict. Its error is two to five times smaller (measured on spheres and rough
    discs), yet of first order as well: rates jump within a step, at contact events. "implicit" (backward Euler) solves,
    in every step, the contact problem of the surface as it is: ΔP ≥ 0, e + KΔP − Δu ≥ 0 and one of them zero, with
    4π d ΣΔP the impulse of the step. It is exact for steps of any size, as contact only grows.

    indenter : Indenter with two-dimensional heights
    impulses : ends of the steps, positive and increasing [length²]; they start at zero impulse
    scheme : one of SCHEMES
    overlap : explicit steps are divided so that no element is predicted to go deeper than this beyond the surface,
        over the depth
    tolerance : residual of the contact problems, as in indent

    Returns Steps. Warns (AccuracyWarning) where steps let the indenter penetrate the surface by more than 1 % of the
    depth. Raises ValueError for arguments out of range, ConvergenceError if a contact problem is not solved.
    """
    impulses = np.atleast_1d(np.asarray(impulses, dtype=float))
    if indenter.heights.ndim != 2:
        raise ValueError("march_steps: the indenter's heights must be two-dimensional")
    if scheme not in SCHEMES:
        raise ValueError(f"march_steps: scheme must be one of {', '.join(SCHEMES)}, not {scheme!r}")
    if impulses.ndim != 1 or not impulses.size or not np.all(np.isfinite(impulses)):
        raise ValueError("march_steps: impulses must be a list of finite numbers")
    if impulses[0] <= 0 or np.any(np.diff(impulses) <= 0):
        raise ValueError("march_steps: impulses must be positive and strictly increasing")
    if not overlap > 0:
        raise ValueError(f"march_steps: overlap must be positive, not {overlap!r}")
    march = {"explicit": _Explicit, "heun": _Heun, "implicit": _Implicit}[scheme](indenter, tolerance)
    scale, rows = 4 * np.pi * indenter.spacing, []
    for left in np.diff(impulses / scale, prepend=0.0):
        while left > 0:
            step = min(left, march.longest_step(overlap))
            march.step(step)
            left -= step
        rows.append((march.depth, march.resistance, march.count, march.overlap))
    depth, resistance, count, deepest = np.array(rows).T
    if deepest.max() > _WARN:
        warnings.warn(
            f"march_steps: with these steps the indenter penetrates the surface by up to {deepest.max():.2g} of its "
            "depth, which is about the error of the depth; more steps, a smaller penetration per step or the implicit "
            "scheme help",
            AccuracyWarning,
            stacklevel=2,
        )
    return Steps(impulses, depth, scale * resistance, count.astype(int), deepest, march.steps)


class _Explicit:
    """Surface and indenter of the explicit scheme; impulses are in units of 4π d η, fields as those of GridSolver."""

    def __init__(self, indenter, tolerance):
        row, column = np.nonzero(np.isfinite(indenter.heights))
        gap = indenter.initial_gap[row, column].astype(float)
        # The error of the sum of rates is the square of theirs.
        self._grid = GridSolver((0, 0, *indenter.heights.shape), row, column, gap, tolerance**2)
        self._tolerance = tolerance
        self._gap = self._grid.gap.copy()
        self._inside = self._gap <= 0
        self._rate, self._rate_gap = np.zeros_like(self._gap), np.full_like(self._gap, -1.0)
        self.depth, self.steps = 0.0, 0
        self._punch()

    def longest_step(self, overlap):
        """Impulse until some element penetrates by the given share of the depth."""
        if np.isinf(overlap):
            return np.inf
        # Beyond the step some element, now outside, would be deeper than allowed.
        closing = -self._rate_gap - overlap
        ahead = (closing > 0) & ~self._inside & (self._gap < _FAR)
        if not ahead.any():
            return np.inf
        wait = (np.maximum(self._gap[ahead], 0) + overlap * self.depth) / closing[ahead]
        # At first touch the depth is zero: start with the first event.
        return self.resistance * max(wait.min(), np.finfo(float).tiny)

    def step(self, impulse):
        """Advance by an impulse."""
        advance = impulse / self.resistance
        self._gap += advance * self._rate_gap
        self.depth += advance
        self.steps += 1
        touching = self._gap <= 0
        if np.any(touching & ~self._inside):
            self._inside |= touching
            self._punch()

    @property
    def count(self):
        return np.count_nonzero(self._inside)

    @property
    def overlap(self):
        return max(-self._gap.min(), 0.0) / self.depth

    def _punch(self):
        """Rates of the contact set: q, K q − 1, and Σq. Without adhesion none may pull, and of a punch none does."""
        self.resistance = self._grid.punch(self._inside, self._rate, self._rate_gap)
        if self._rate.min() < -self._tolerance * self._rate.max():
            raise ConvergenceError(f"march_steps: tension at depth {self.depth:g}; contact would open")


class _Heun(_Explicit):
    """The same with the mean of the rates at the start of the step and at its predicted end."""

    def step(self, impulse):
        """Advance by an impulse."""
        at_start, start_gap = 1 / self.resistance, self._rate_gap / self.resistance
        predicted = self._inside | (self._gap + impulse * start_gap <= 0)
        if np.array_equal(predicted, self._inside):
            super().step(impulse)
            return
        inside, rate, rate_gap, resistance = self._inside, self._rate.copy(), self._rate_gap.copy(), self.resistance
        self._inside = predicted
        self._punch()
        self.depth += 0.5 * impulse * (at_start + 1 / self.resistance)
        self._gap += 0.5 * impulse * (start_gap + self._rate_gap / self.resistance)
        self.steps += 1
        touching = inside | (self._gap <= 0)
        if np.any(predicted & ~touching):  # it predicted too many: its rates carry load where there is no contact
            self._rate, self._rate_gap, self.resistance = rate, rate_gap, resistance
        if not np.array_equal(touching, predicted):
            self._inside = touching
            self._punch()


class _Implicit:
    """Surface and indenter of the implicit scheme; impulses are in units of 4π d η."""

    def __init__(self, indenter, tolerance):
        self._gap, self._spacing, self._tolerance = indenter.initial_gap.astype(float), indenter.spacing, tolerance
        self.depth, self.resistance, self.count, self.overlap, self.steps = 0.0, None, 0, 0.0, 0

    def longest_step(self, _overlap):
        return np.inf

    def step(self, impulse):
        """Advance by an impulse, found by Newton's method in the depth."""
        solver = ContactSolver(Indenter(-self._gap, self._spacing), self._tolerance)
        advance = impulse / (self.resistance or 1.0)
        for _ in range(50):
            contact = solver.advance(solver.touch(), advance / solver.unit)
            missing = impulse - contact.force * solver.unit
            if abs(missing) <= 1e-2 * self._tolerance * impulse:
                break
            advance += missing / contact.stiffness
        else:
            raise ConvergenceError(f"march_steps: no depth found for an impulse of {impulse:g} in 50 iterations")
        self.depth += advance
        self._gap[solver.place] = np.maximum(solver.gaps(contact) * solver.unit, 0.0)
        self.resistance, self.count = contact.stiffness, contact.count
        self.overlap = contact.residual * advance / self.depth
        self.steps += 1
