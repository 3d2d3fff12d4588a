"""Iterate for the pressure of a contact on a grid by preconditioned conjugate gradients on a shrinking contact set.

Elements under tension leave the set, and elements that overlap the surface join it. The operator gives the deflection
K d of a search direction d on the whole grid, and so the gap everywhere at no further cost. There are two phases:

1. Release phase: while elements leave, the length of a step is fixed in units of the preconditioned residual. So one
   application of the operator serves both the step and the removal of these elements.
2. Conjugate phase: if no element leaves, a step has the length that minimises the energy, like a step of conjugate
   gradients.

The phase is chosen before every step. Directions are conjugate to the last change of pressure in both. If the bound on
the rounding error nears the tolerance, the gap is recomputed from the pressure. If possible this happens in a release
step, which applies the operator anyway.
"""

from dataclasses import dataclass

from viscorough.basics.types import Array, Mask
from viscorough.contact.grid.conjugate_gradients import ConjugateGradients, Direction
from viscorough.contact.grid.depth_adjustment import DepthAdjustment
from viscorough.contact.grid.workspace import GridWorkspace
from viscorough.contact.state import BoundedField, ContactSet, TargetForce

# Remove unloaded elements that the first step would put under tension before this step, if they exceed this share of
# the set: the preconditioned residual of a far too large set is of little use.
_EXCLUDED = 0.05
# Recompute the gap in a release step if the bound on its rounding error exceeds this share of the limit, and a further
# step adds less than this share. This saves the operator application of the step.
_INEXACT = 0.25
# Release steps after the first step of a level are longer by this factor, about the inverse of the mean eigenvalue of M
# K. In the first step the set is too large, so the residual overestimates the change.
_LATER_STEPS = 1.1
# Halve the length of release steps after every so many of them. From the first halving on, each release step begins a
# new search: a safeguard against cycles if the preconditioner is poor.
_HALVE_STEP_EVERY = 20
# Share of the tolerance for the search, so that residual and rounding together stay within the tolerance.
_SEARCH_SHARE = 0.999
# For contacts of fewer elements than this, the residual is smaller in proportion to their number: an element that
# overlaps within the tolerance and does not join would carry a large part of the force.
_FEW = 100
# Smallest residual over the depth that single precision can reach.
_LEAST_RESIDUAL = 1e-5


@dataclass
class TrialContact:
    """A contact while PressureIteration solves it; the iteration changes all of it, the arrays in place.

    pressure : P, flat field
    change : BoundedField of e − g
    inside : True for places in contact, flat field
    depth : reduced depth u; it changes only if a force is given
    """

    pressure: Array
    change: BoundedField
    inside: Mask
    depth: float


class PressureIteration:
    """One solution for P ≥ 0 with |e| on the set below a limit, and no overlap beyond the limit elsewhere.

    grid : GridWorkspace; no other iteration may use it at the same time
    trial : TrialContact to start from; it becomes the solution
    target : TargetForce that the depth is adjusted to during the iteration; None keeps the depth
    """

    def __init__(self, grid: GridWorkspace, trial: TrialContact, target: TargetForce | None = None) -> None:
        self._grid, self._trial = grid, trial
        self._adjustment = DepthAdjustment(target, trial.pressure.size, grid.loops) if target else None
        self._search: ConjugateGradients | None = None
        self._contact_set = grid.contact_set(trial.inside)
        self._set_changed = False  # since `_contact_set` was made
        self._has_tension = grid.loops.lowest(trial.pressure) < 0
        self._releases = 0  # release steps so far
        # Measured at the start of every iteration: the largest |e| allowed, the largest |e| reached, and the largest
        # |e| that ends the iteration.
        self._limit = self._largest = self._close_enough = 0.0

    def solve(self) -> ContactSet:
        """Iterate until the trial contact is solved; return its set.

        Raises ConvergenceError if this takes more than max_iterations.
        """
        for iteration in range(self._grid.options.max_iterations):
            self._measure()
            if self._is_close():
                if self._try_to_finish():
                    return self._contact_set
                continue
            direction = self._next_direction()
            if iteration == 0 and self._exclude_unloaded(direction):
                continue
            length = (_LATER_STEPS if self._releases else 1.0) * 0.5 ** (self._releases // _HALVE_STEP_EVERY)
            self._set_changed = direction.causes_tension(length, self._trial.pressure)
            recomputes = self._can_recompute()
            self._trial.change.rounding += self._added_rounding()
            if self._set_changed or recomputes:
                self._take_release_step(direction, length, recomputes)
            else:
                self._has_tension = direction.step(self._trial.pressure, self._trial.change.values)
            self._add_penetrating_elements(self._close_enough)
        raise self._grid.not_converged(self._contact_set, self._largest, self._limit)

    def _measure(self) -> None:
        """Measure the residual on the current set."""
        grid, trial = self._grid, self._trial
        if self._set_changed:
            self._contact_set = grid.contact_set(trial.inside)
        self._limit = self._largest_residual()
        places = self._contact_set.places
        self._largest = grid.loops.largest_gap(trial.change.values, grid.initial_gap, grid.residual, places)
        # Residual and rounding error together must not exceed the limit. If the rounding error is most of it, the gap
        # is recomputed as soon as the residual is no larger than the rounding error.
        self._close_enough = max(self._limit - trial.change.rounding, trial.change.rounding)

    def _largest_residual(self) -> float:
        """Return the largest |e| on the set, and the largest overlap outside it, at the end of the search."""
        tolerance, share = self._grid.tolerance, min(self._contact_set.places.size / _FEW, 1.0)
        return _SEARCH_SHARE * max(share * tolerance, min(tolerance, _LEAST_RESIDUAL)) * self._trial.depth

    def _is_close(self) -> bool:
        """Return True if the residual, and the force if one is given, are within their limits on the current set."""
        if self._largest > self._close_enough or self._has_tension:
            return False
        trial, places = self._trial, self._contact_set.places
        return not self._adjustment or self._adjustment.is_met(trial.pressure, places, trial.depth, self._limit)

    def _try_to_finish(self) -> bool:
        """Return True if no element joins the set and the gap is accurate; otherwise improve the set or the gap."""
        trial = self._trial
        self._set_changed = False
        self._add_penetrating_elements(self._close_enough)
        if self._set_changed:
            return False
        if trial.change.rounding <= 0.5 * self._limit:
            return True
        self._grid.recompute_gap(trial.pressure, trial.depth, trial.change)
        self._grid.add_penetrating_elements(trial.change, trial.inside, self._limit)
        self._set_changed, self._search = True, None  # the load array now contains another load
        return False

    def _next_direction(self) -> Direction:
        """Return the next search direction, after an adjustment of the depth if a force is given."""
        trial = self._trial
        if self._search is None or self._set_changed:
            if self._search is None or not 0 < self._releases < _HALVE_STEP_EVERY:
                self._search = self._grid.conjugate_gradients(self._contact_set)
            else:
                self._search.change_set(self._contact_set)
            if self._adjustment:
                self._adjustment.prepare(self._search, self._contact_set.places)
        residual = self._search.precondition(self._grid.residual)
        if self._adjustment:
            trial.depth = self._adjustment.adjust_depth(residual, trial.pressure, trial.change, trial.depth)
            self._limit = self._largest_residual()
        return self._search.next_direction(residual)

    def _exclude_unloaded(self, direction: Direction) -> bool:
        """Exclude unloaded elements that a step would put under tension, if they are many; return True if so."""
        excluded = direction.unloaded_under_tension(self._trial.pressure)
        if excluded.size <= _EXCLUDED * self._contact_set.places.size:
            return False
        self._trial.inside[excluded] = False
        self._set_changed = True
        return True

    def _can_recompute(self) -> bool:
        """Return True if the rounding error is too large, and recomputing the gap reduces it for the rest of the level.

        The error of the next step must not make the recomputed gap too inexact again.
        """
        grid, trial = self._grid, self._trial
        too_large = max(_INEXACT * self._limit, 2 * (grid.exact_rounding + grid.field_rounding) * trial.depth)
        return trial.change.rounding > too_large and grid.step_rounding * self._largest < _INEXACT * self._limit

    def _added_rounding(self) -> float:
        """Return the bound on the rounding error that a step adds to the gap."""
        return self._grid.step_rounding * self._largest + self._grid.field_rounding * self._trial.depth

    def _take_release_step(self, direction: Direction, length: float, recomputes: bool) -> None:
        """Take a step of given length, remove the elements under tension, and update or recompute the gap."""
        trial = self._trial
        direction.step_and_release(length, trial.pressure, self._grid.width)
        self._releases += 1
        self._has_tension = False
        if recomputes:
            self._grid.recompute_gap(trial.pressure, trial.depth, trial.change)
        else:
            direction.update_gap(trial.change.values)

    def _add_penetrating_elements(self, limit: float) -> None:
        """Add elements that overlap the surface by more than the limit to the set."""
        if self._grid.add_penetrating_elements(self._trial.change, self._trial.inside, limit):
            self._set_changed = True
