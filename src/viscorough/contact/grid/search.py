"""Iterations for the contact on a grid: preconditioned conjugate gradients, on a contact set that shrinks.

Elements under tension leave the set, and elements that overlap the surface join it. The operator gives the deflection
K d of a search direction d on the whole grid, and thus the gap everywhere at no further cost.

While elements leave, the length of a step is fixed in units of the preconditioned residual, so that one application of
the operator serves both the step and the removal of these elements; afterwards steps are those of conjugate gradients.
Directions are conjugate to the last change of pressure throughout.

Symbols and reduced units are those of contact.state. Fields are flat arrays with a border as wide as the preconditioner
reaches, so that elements at the edge need no special treatment.

The iterations run in single precision by default, and fields are kept in it unless the tolerance is so small that the
gap must be known in double precision. The iterations compute corrections that become ever smaller, so that the rounding
error is small; a bound on it is tracked with every field, and the gap is recomputed from the pressure, in double
precision where the tolerance needs it, when the bound nears the tolerance: if possible in a step of fixed length, for
which the operator is applied anyway.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from viscorough.argument_names import argument
from viscorough.contact.grid import kernels
from viscorough.contact.grid.conjugate_gradients import ConjugateGradients
from viscorough.contact.grid.depth_adjustment import PrescribedForce
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.halfspace.operator import Halfspace, spectrum_of_grid
from viscorough.contact.halfspace.tiles import TiledHalfspace
from viscorough.contact.options import SolverOptions
from viscorough.contact.preconditioner.multilevel import LEAST_EIGENVALUE, REACH, Preconditioner
from viscorough.contact.state import BoundedField, ContactSet
from viscorough.errors import ConvergenceError
from viscorough.types import Array, Mask

# Elements without pressure that the first step would put under tension leave the first set before it if they are more
# than this share of it: the preconditioned residual of a set far too large is of little use.
_EXCLUDED = 0.05
# The gap is recomputed in a step, whose length is then fixed, if the bound on its rounding error exceeds this share of
# the limit and what the coming steps add stays below it: this saves the application of the operator for the step.
_INEXACT = 0.25
# Release steps after the first one of a level are longer by this factor, about the inverse of the mean eigenvalue of
# M K. In the first one the set is too large, so that the residual overestimates the change.
_LATER_STEPS = 1.1
# The release step is halved after every so many of them, and each of them begins a new search: a safeguard against
# cycles where the preconditioner is poor.
_HALVE_STEP_EVERY = 20
# Largest relative error of q in the energy norm; its square is the relative error of the stiffness.
_TANGENT_TOLERANCE = 1e-2
# Rounding error of e_q = K q − 1 that is accepted, over the tolerance. The stiffness depends on its mean over the set,
# not on its largest value, and therefore stays within the tolerance (tests/viscorough/contact/test_loading_path.py).
_TANGENT_ROUNDING = 5.0
# Share of the tolerance that the search may use, so that residual and rounding together are within the tolerance.
_SEARCH_SHARE = 0.999
# The residual of a contact of fewer elements than the first number is smaller in proportion to their number: an element
# that overlaps within the tolerance and does not join would carry a large part of the force. Single precision allows no
# residual below the second number, over the depth.
_FEW, _LEAST_RESIDUAL = 100, 1e-5
# Initial gap where there is no element, far beyond the largest depth.
_OUTSIDE = 1e30


class ContactSearch:
    """The iterations for P and q on a grid of so many rows and columns, and the operator that they apply.

    tolerance : largest |e| in contact or overlap outside it, over the depth
    options : SolverOptions
    aspect : dy/dx of the elements
    threads : on which it computes
    tiles : halfspace.tiles with elements that can touch, on which the operator is then restricted

    initial_gap : flat field, to be set where there are elements
    residual : e or e_q on the set, as last computed, flat field
    precision : floating-point type of the other fields
    field_rounding : rounding error of a step in the fields, over the depth
    inner : slice of flat fields without the first and last rows of their border, which are most of those of a strip
    """

    def __init__(
        self,
        rows: int,
        columns: int,
        tolerance: float,
        options: SolverOptions,
        *,
        aspect: float = 1.0,
        threads: int = 1,
        tiles: Mask | None = None,
    ) -> None:
        self._tolerance, self._options, self._loops = tolerance, options, GridLoops(threads)
        of_grid: dict[str, Any] = {"aspect": aspect, "threads": threads}
        operator: Callable[..., Halfspace | TiledHalfspace]
        if tiles is None:
            of_grid["padding"] = options.padding
            operator = partial(Halfspace, spectrum=spectrum_of_grid(rows, columns, **of_grid))
        else:
            operator = partial(TiledHalfspace, tiles=tiles)
        self._halfspace = operator(rows, columns, precision=np.dtype(options.precision), **of_grid)
        exact = tolerance < options.exact_gap_below
        self._exact = operator(rows, columns, **of_grid) if exact else self._halfspace
        self._rounding, self._exact_rounding = (
            options.operator_rounding * np.finfo(halfspace.load.dtype).eps + halfspace.accuracy
            for halfspace in (self._halfspace, self._exact)
        )
        self.precision = self._exact.load.dtype.type
        # A step rounds e − g, which does not exceed the depth, and the pressure, whose deflection does not either.
        # Where rounding is to be ignored, this is ignored, too.
        self.field_rounding = min(options.operator_rounding, 1.0) * np.finfo(self.precision).eps
        self._width = columns + 2 * REACH
        self.inner = slice(REACH * self._width, -REACH * self._width)
        self.initial_gap = np.empty((rows + 2 * REACH) * self._width, dtype=self.precision)
        self._loops.fill(self.initial_gap, _OUTSIDE)
        self.residual = np.zeros(self.initial_gap.size, dtype=np.float32)
        self._preconditioner = Preconditioner(rows + 2 * REACH, self._width, aspect=aspect, threads=threads)

    @property
    def operator_applications(self) -> int:
        """Applications of the half-space operator so far."""
        return sum(halfspace.count for halfspace in {self._halfspace, self._exact})

    def solve_pressure(
        self,
        pressure: Array,
        change: BoundedField,
        inside: Mask,
        depth: float,
        force: PrescribedForce | None = None,
    ) -> tuple[ContactSet, float]:
        """Pressure P ≥ 0 with |e| on the set below the limit and no overlap beyond it elsewhere.

        change : BoundedField of e − g
        force : PrescribedForce, to which the depth is brought while it is iterated; None: the depth is kept

        Changes pressure, e − g and set in place. Returns the contact set and the depth.
        """
        changed, releases, tension = True, 0, self._loops.lowest(pressure) < 0
        search: ConjugateGradients | None = None
        for iteration in range(self._options.max_iterations):
            if changed:
                contact_set = self.contact_set(inside)
            limit = self._largest_residual(contact_set, depth)
            largest = self._loops.largest_gap(change.values, self.initial_gap, self.residual, contact_set.places)
            # Residual and rounding error together must not exceed the limit. Where the rounding error is most of it,
            # the gap is recomputed as soon as the residual is no larger than the rounding error.
            close_enough = max(limit - change.rounding, change.rounding)
            is_close = largest <= close_enough and not tension
            if is_close and (not force or force.is_met(pressure, contact_set.places, depth, limit)):
                changed = self.add_penetrating_elements(change, inside, close_enough) > 0
                if not changed:
                    if change.rounding <= 0.5 * limit:
                        return contact_set, depth
                    self._deflect(pressure, depth, change)
                    self.add_penetrating_elements(change, inside, limit)
                    changed, search = True, None  # the load array holds another load now
                continue
            if changed or search is None:
                search = self._search(contact_set, search if 0 < releases < _HALVE_STEP_EVERY else None)
                if force:
                    force.prepare(search, contact_set.places)
            search.precondition(self.residual)
            if force:
                depth = force.adjust_depth(search, pressure, change, depth)
                limit = self._largest_residual(contact_set, depth)
            search.update_direction()
            if iteration == 0:
                excluded = search.unloaded_under_tension(pressure)
                if excluded.size > _EXCLUDED * contact_set.places.size:
                    inside[excluded] = False
                    continue
            release_step = (_LATER_STEPS if releases else 1.0) * 0.5 ** (releases // _HALVE_STEP_EVERY)
            changed = search.step_causes_tension(release_step, pressure)
            # If the rounding error is too large, and recomputing the gap reduces it for the rest of this level.
            too_large = max(_INEXACT * limit, 2 * (self._exact_rounding + self.field_rounding) * depth)
            recomputes = change.rounding > too_large and self._rounding * largest < _INEXACT * limit
            change.rounding += self._rounding * largest + self.field_rounding * depth
            if changed or recomputes:
                search.step_and_release(release_step, pressure, self._width)
                releases, tension = releases + 1, False
                if recomputes:
                    self._deflect(pressure, depth, change)
                else:
                    search.update_gap(change.values)
            else:
                tension = search.step(pressure, change.values)
            changed = self.add_penetrating_elements(change, inside, close_enough) > 0 or changed
        raise self._not_converged(contact_set, largest, limit)

    def _largest_residual(self, contact_set: ContactSet, depth: float) -> float:
        """Return the largest |e| on a set, and overlap outside it, that the search leaves."""
        share = min(contact_set.places.size / _FEW, 1.0)
        return _SEARCH_SHARE * max(share * self._tolerance, min(self._tolerance, _LEAST_RESIDUAL)) * depth

    def solve_tangent(self, contact_set: ContactSet, tangent: Array, tangent_gap: BoundedField) -> None:
        """Solve K q = 1 on a set by conjugate gradients; changes q and e_q, with its rounding bound, in place."""
        tolerance = min(_TANGENT_TOLERANCE, np.sqrt(self._tolerance))
        accepted = max(_TANGENT_ROUNDING * self._tolerance, self._exact_rounding + self.field_rounding)
        search = self._search(contact_set)
        for _ in range(self._options.max_iterations):
            fields = tangent_gap.values, self.residual
            largest = max(self._loops.each(kernels.gather_on_set, fields, contact_set.places))
            search.precondition(self.residual)
            # The error of Σq is e_qᵀ K⁻¹ e_q, which is at most e_qᵀ M e_q / LEAST_EIGENVALUE.
            total = self._loops.total(tangent, contact_set.places)
            error = np.sqrt(search.norm() / (LEAST_EIGENVALUE * total)) if total > 0 else np.inf
            if error <= tolerance:
                if tangent_gap.rounding <= accepted:
                    return
                self._deflect(tangent, 1, tangent_gap)
                search = self._search(contact_set)
                continue
            search.update_direction()
            tangent_gap.rounding += self._rounding * largest + self.field_rounding
            search.step(tangent, tangent_gap.values)
        raise self._not_converged(contact_set, error, tolerance)

    def contact_set(self, inside: Mask) -> ContactSet:
        """The ContactSet of a flat field that says whether an element is in it."""
        return ContactSet(inside, *self._loops.contact_places(inside, self._width, self._halfspace.load.shape[1]))

    def gap_change(self, pressure: Array, depth: float) -> BoundedField:
        """e − g = K P − u of a pressure as a BoundedField; e_q = K q − 1 of a tangent with a depth of 1."""
        change = BoundedField(self.zeros(), self.field_rounding * depth)
        if pressure.any():
            self._deflect(pressure, depth, change)
        else:
            self._loops.fill(change.values, -depth)
        return change

    def zeros(self, dtype: DTypeLike | None = None) -> NDArray[Any]:
        """A flat field of zeros; its memory is allocated by the loop that fills it, on the threads of that loop."""
        return np.zeros(self.initial_gap.size, dtype or self.precision)

    def _search(self, contact_set: ContactSet, last: ConjugateGradients | None = None) -> ConjugateGradients:
        """Conjugate gradients on a set: the last search continued, or a new one."""
        if last is None:
            return ConjugateGradients(self._halfspace, self._preconditioner, contact_set, self._loops)
        last.change_set(contact_set)
        return last

    def _not_converged(self, contact_set: ContactSet, residual: float, limit: float) -> ConvergenceError:
        return ConvergenceError(
            f"contact of {contact_set.places.size} elements: the residual {residual:.1e} does not fall below "
            f"{limit:.1e} in {self._options.max_iterations} steps; choose a larger {argument('tolerance')}"
        )

    def _deflect(self, pressure: Array, depth: float, change: BoundedField) -> None:
        """Compute e − g = K P − u from a pressure, in double precision where the tolerance needs it; in place.

        change : BoundedField of e − g, whose border is kept
        """
        load = self._exact.load[:, : self._width - 2 * REACH]
        self._loops.shifted(self.interior(pressure), 0, load)
        deflection = self._exact.apply()[:, : load.shape[1]]
        self._loops.shifted(deflection, depth, self.interior(change.values))
        change.rounding = (self._exact_rounding + self.field_rounding) * depth

    def add_penetrating_elements(self, change: BoundedField, inside: Mask, limit: float) -> int:
        """Add the elements that overlap the surface by more than the limit to a set; returns their number."""
        fields = (field[self.inner] for field in (change.values, self.initial_gap, inside))
        return sum(self._loops.each(kernels.add_penetrating_elements, (limit,), *fields))

    def interior(self, field: Array) -> Array:
        """View of a flat field without its border, in rows and columns."""
        return field.reshape(-1, self._width)[REACH:-REACH, REACH:-REACH]
