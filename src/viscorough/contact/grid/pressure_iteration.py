"""Iterate for the pressure of a contact on a grid by preconditioned conjugate gradients on a shrinking contact set.

Elements under tension leave the set, and elements that overlap the surface join it. The half-space operator computes
the deflection K d by a search direction d on the whole grid, so the gap is known everywhere at no further cost. There
are two kinds of step:

1. Release step: the length of the step along d is fixed in advance, and elements that the step puts under tension
   leave the set. The operator is then applied once, to the whole change of pressure by the step and by the removal of
   elements.
2. Conjugate step: the step has the length that minimises the energy along d, and no element leaves. This is a step of
   the method of conjugate gradients.

A release step is taken if it would put any element under tension, otherwise a conjugate step. After both kinds of step,
the next direction is conjugate to the last change of pressure. If the bound on the rounding error nears the tolerance,
the gap is recomputed from the pressure. If possible, a release step does this, because it applies the operator anyway.

Symbols are defined in contact.state. M is the preconditioner.
"""

from dataclasses import dataclass

from viscorough.basics.types import Array, Mask
from viscorough.contact.grid.conjugate_gradients import ConjugateGradients, Direction
from viscorough.contact.grid.depth_adjustment import DepthAdjustment
from viscorough.contact.grid.workspace import GridWorkspace
from viscorough.contact.state import BoundedField, ContactSet, TargetForce

# Elements without pressure that the first step would put under tension do not belong in the contact set. If they are
# more than this share of the set, they are removed before the step, because the preconditioned residual on a far too
# large set gives a poor search direction.
_EXCLUDED = 0.05
# Share of the largest allowed residual. If the bound on the rounding error of the gap exceeds this share, and further
# steps add less than this share, the gap is recomputed from the pressure in a release step. The step then needs no
# other application of the operator.
_INEXACT = 0.25
# Length of the second and all later release steps of a contact. It is about the inverse of the mean eigenvalue of M K,
# with the preconditioner M. The first release step has length 1, because the contact set is still too large, so the
# residual overestimates the change of pressure.
_LATER_STEPS = 1.1
# The length of release steps is halved each time this number of release steps has been taken. After the first halving,
# conjugate gradients also start anew after every release step. This is a safeguard against endless cycles with a poor
# preconditioner.
_HALVE_STEP_EVERY = 20
# The iteration aims at this share of the tolerance, so that residual and rounding error together stay within the
# tolerance.
_SEARCH_SHARE = 0.999
# If fewer elements than this are in contact, the largest allowed residual is reduced in proportion to their number.
# Otherwise an element could be left out because its overlap is below the tolerance, although it carries a large part of
# the force of such a small contact.
_FEW = 100
# Smallest ratio of the residual to the depth that single precision can reach.
_LEAST_RESIDUAL = 1e-5


@dataclass
class TrialContact:
    """First guess of a contact, which PressureIteration changes in place until it is the solution.

    pressure : P, flat field
    change : change e − g of every gap since first contact, with a bound on its rounding error
    inside : True for places in contact, flat field
    depth : reduced depth u, which changes only if a force is given
    """

    pressure: Array
    change: BoundedField
    inside: Mask
    depth: float


class PressureIteration:
    """Iteration for the pressures P ≥ 0 of one contact.

    It ends when the residual |e| in contact, and the overlap of indenter and surface elsewhere, are below a limit.

    grid : GridWorkspace; no other iteration may use it at the same time
    trial : TrialContact, the first guess, which becomes the solution
    target : TargetForce; the depth is adjusted to this force during the iteration. None: the depth is kept
    """

    def __init__(self, grid: GridWorkspace, trial: TrialContact, target: TargetForce | None = None) -> None:
        self._grid, self._trial = grid, trial
        self._adjustment = DepthAdjustment(target, trial.pressure.size, grid.loops) if target else None
        self._search: ConjugateGradients | None = None
        self._contact_set = grid.contact_set(trial.inside)
        self._set_changed = False  # True if `trial.inside` has changed since `_contact_set` was made
        self._has_tension = grid.loops.lowest(trial.pressure) < 0
        self._releases = 0  # number of release steps so far
        # `_measure` sets these three numbers at the start of every iteration: the largest allowed |e|, the largest |e|
        # on the contact set, and the value of |e| below which the iteration may end.
        self._limit = self._largest = self._close_enough = 0.0

    def solve(self) -> ContactSet:
        """Iterate until the trial contact is solved; return its contact set.

        Raises ConvergenceError if the iteration takes more than max_iterations steps.
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
        """Compute the largest residual |e| on the current contact set, and the limits that it must not exceed."""
        grid, trial = self._grid, self._trial
        if self._set_changed:
            self._contact_set = grid.contact_set(trial.inside)
        self._limit = self._largest_residual()
        places = self._contact_set.places
        self._largest = grid.loops.largest_gap(trial.change.values, grid.initial_gap, grid.residual, places)
        # Residual and rounding error together must not exceed the limit. If the rounding error exceeds half of the
        # limit, `_try_to_finish` recomputes the gap when the residual has fallen to the rounding error.
        self._close_enough = max(self._limit - trial.change.rounding, trial.change.rounding)

    def _largest_residual(self) -> float:
        """Return the largest allowed gap |e| of an element in contact, and overlap of an element out of contact."""
        tolerance, share = self._grid.tolerance, min(self._contact_set.places.size / _FEW, 1.0)
        return _SEARCH_SHARE * max(share * tolerance, min(tolerance, _LEAST_RESIDUAL)) * self._trial.depth

    def _is_close(self) -> bool:
        """Return True if the residual is within its limit, no pressure is negative, and a given force is met."""
        if self._largest > self._close_enough or self._has_tension:
            return False
        trial, places = self._trial, self._contact_set.places
        return not self._adjustment or self._adjustment.is_met(trial.pressure, places, trial.depth, self._limit)

    def _try_to_finish(self) -> bool:
        """Return True if the contact set is complete and the gap is accurate; otherwise improve set or gap.

        If elements outside the set overlap the surface, add them to the set. If the rounding error of the gap is too
        large, recompute the gap from the pressure.
        """
        trial = self._trial
        self._set_changed = False
        self._add_penetrating_elements(self._close_enough)
        if self._set_changed:
            return False
        if trial.change.rounding <= 0.5 * self._limit:
            return True
        self._grid.recompute_gap(trial.pressure, trial.depth, trial.change)
        self._grid.add_penetrating_elements(trial.change, trial.inside, self._limit)
        # The recomputation may have overwritten the search direction, which is kept in the load array of the operator.
        # So conjugate gradients must begin anew.
        self._set_changed, self._search = True, None
        return False

    def _next_direction(self) -> Direction:
        """Return the next search direction; if a force is given, adjust the depth first."""
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
        """Remove elements without pressure from the contact set if a step would put many of them under tension.

        Returns True if elements were removed.
        """
        excluded = direction.unloaded_under_tension(self._trial.pressure)
        if excluded.size <= _EXCLUDED * self._contact_set.places.size:
            return False
        self._trial.inside[excluded] = False
        self._set_changed = True
        return True

    def _can_recompute(self) -> bool:
        """Return True if the rounding error of the gap is too large, and recomputing the gap is worthwhile now.

        It is worthwhile if later steps add so little rounding error that the gap need not be recomputed again.
        """
        grid, trial = self._grid, self._trial
        too_large = max(_INEXACT * self._limit, 2 * (grid.exact_rounding + grid.field_rounding) * trial.depth)
        return trial.change.rounding > too_large and grid.step_rounding * self._largest < _INEXACT * self._limit

    def _added_rounding(self) -> float:
        """Return a bound on the rounding error that a step adds to the gap."""
        return self._grid.step_rounding * self._largest + self._grid.field_rounding * self._trial.depth

    def _take_release_step(self, direction: Direction, length: float, recomputes: bool) -> None:
        """Take a step of given length, remove elements under tension, and update the gap.

        recomputes : True if the gap is recomputed from the pressure; False if the deflection by the step is added to it
        """
        trial = self._trial
        direction.step_and_release(length, trial.pressure, self._grid.width)
        self._releases += 1
        self._has_tension = False
        if recomputes:
            self._grid.recompute_gap(trial.pressure, trial.depth, trial.change)
        else:
            direction.update_gap(trial.change.values)

    def _add_penetrating_elements(self, limit: float) -> None:
        """Add elements that overlap the surface by more than `limit` to the contact set."""
        if self._grid.add_penetrating_elements(self._trial.change, self._trial.inside, limit):
            self._set_changed = True
