"""Iterate for the contact on a grid by preconditioned conjugate gradients on a shrinking contact set.

Elements under tension leave the set, and elements that overlap the surface join it. The operator gives the deflection K
d of a search direction d on the whole grid, and so the gap everywhere at no further cost.

While elements leave, the length of a step is fixed in units of the preconditioned residual. So one application of the
operator serves both the step and the removal of these elements. Afterwards steps follow the method of conjugate
gradients. Directions are conjugate to the last change of pressure throughout.

Symbols and reduced units are defined in contact.state. Fields are flat arrays with a border as wide as the
preconditioner reaches, so elements at the edge need no special treatment.

The iterations run in single precision by default. Fields are in single precision, too, unless the tolerance is so small
that the gap must be known in double precision. The iterations compute ever smaller corrections, so the rounding error
is small, and a bound on it is tracked with every field. When the bound nears the tolerance, the gap is recomputed from
the pressure, in double precision if the tolerance needs it. If possible this happens in a step of fixed length, which
applies the operator anyway.
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

# If the first step would put unloaded elements under tension, and these are more than this share of the set, they leave
# the set before the step: the preconditioned residual of a far too large set is of little use.
_EXCLUDED = 0.05
# Recompute the gap in a step of fixed length if the bound on its rounding error exceeds this share of the limit, and a
# further step adds less than this share. This saves the operator application of the step.
_INEXACT = 0.25
# Release steps after the first step of a level are longer by this factor, about the inverse of the mean eigenvalue of M
# K. In the first step the set is too large, so the residual overestimates the change.
_LATER_STEPS = 1.1
# Halve the length of release steps after every so many of them. From the first halving on, each release step begins a
# new search: a safeguard against cycles if the preconditioner is poor.
_HALVE_STEP_EVERY = 20
# Largest relative error of q in the energy norm; its square is the relative error of the stiffness.
_TANGENT_TOLERANCE = 1e-2
# Accepted rounding error of e_q = K q − 1, over the tolerance. The stiffness depends on its mean over the set, not on
# its largest value, and therefore stays within the tolerance (tests/viscorough/contact/test_loading_path.py).
_TANGENT_ROUNDING = 5.0
# Share of the tolerance for the search, so that residual and rounding together stay within the tolerance.
_SEARCH_SHARE = 0.999
# For contacts of fewer elements than the first number, the residual is smaller in proportion to their number: an
# element that overlaps within the tolerance and does not join would carry a large part of the force. In single
# precision the residual over the depth cannot be below the second number.
_FEW, _LEAST_RESIDUAL = 100, 1e-5
# Initial gap of places without an element, far beyond the largest depth.
_OUTSIDE = 1e30


class ContactSearch:
    """The iterations for P and q on a grid, and the operator that they apply.

    tolerance : largest |e| in contact or overlap outside it, over the depth
    options : SolverOptions
    aspect : dy/dx of the elements
    threads : number of threads
    tiles : halfspace.tiles with elements that can touch; the operator is restricted to them

    initial_gap : flat field, to be set at the elements
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
        # A step rounds e − g, which is at most the depth, and the pressure, whose deflection is at most the depth, too.
        # If rounding is to be ignored, this is ignored, too.
        self.field_rounding = min(options.operator_rounding, 1.0) * np.finfo(self.precision).eps
        self._width = columns + 2 * REACH
        self.inner = slice(REACH * self._width, -REACH * self._width)
        self.initial_gap = np.empty((rows + 2 * REACH) * self._width, dtype=self.precision)
        self._loops.fill(self.initial_gap, _OUTSIDE)
        self.residual = np.zeros(self.initial_gap.size, dtype=np.float32)
        self._preconditioner = Preconditioner(rows + 2 * REACH, self._width, aspect=aspect, threads=threads)

    @property
    def operator_applications(self) -> int:
        """Return the number of applications of the half-space operator so far."""
        return sum(halfspace.count for halfspace in {self._halfspace, self._exact})

    def solve_pressure(
        self,
        pressure: Array,
        change: BoundedField,
        inside: Mask,
        depth: float,
        force: PrescribedForce | None = None,
    ) -> tuple[ContactSet, float]:
        """Solve for P ≥ 0 with |e| on the set below the limit and no overlap beyond it elsewhere.

        change : BoundedField of e − g
        force : PrescribedForce that the depth is adjusted to during the iteration; None keeps the depth

        Changes pressure, e − g and set in place. Returns the contact set and the depth.
        """
        changed, releases, tension = True, 0, self._loops.lowest(pressure) < 0
        search: ConjugateGradients | None = None
        for iteration in range(self._options.max_iterations):
            if changed:
                contact_set = self.contact_set(inside)
            limit = self._largest_residual(contact_set, depth)
            largest = self._loops.largest_gap(change.values, self.initial_gap, self.residual, contact_set.places)
            # Residual and rounding error together must not exceed the limit. If the rounding error is most of it, the
            # gap is recomputed as soon as the residual is no larger than the rounding error.
            close_enough = max(limit - change.rounding, change.rounding)
            is_close = largest <= close_enough and not tension
            if is_close and (not force or force.is_met(pressure, contact_set.places, depth, limit)):
                changed = self.add_penetrating_elements(change, inside, close_enough) > 0
                if not changed:
                    if change.rounding <= 0.5 * limit:
                        return contact_set, depth
                    self._deflect(pressure, depth, change)
                    self.add_penetrating_elements(change, inside, limit)
                    changed, search = True, None  # the load array now contains another load
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
            # The rounding error is too large, and recomputing the gap reduces it for the rest of this level.
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
        """Return the largest |e| on a set, and the largest overlap outside it, at the end of the search."""
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
        """Return the ContactSet of a flat field of flags."""
        return ContactSet(inside, *self._loops.contact_places(inside, self._width, self._halfspace.load.shape[1]))

    def gap_change(self, pressure: Array, depth: float) -> BoundedField:
        """Return e − g = K P − u of a pressure as a BoundedField; e_q = K q − 1 of a tangent with a depth of 1."""
        change = BoundedField(self.zeros(), self.field_rounding * depth)
        if pressure.any():
            self._deflect(pressure, depth, change)
        else:
            self._loops.fill(change.values, -depth)
        return change

    def zeros(self, dtype: DTypeLike | None = None) -> NDArray[Any]:
        """Return a flat field of zeros; the loop that fills it allocates its memory on its threads."""
        return np.zeros(self.initial_gap.size, dtype or self.precision)

    def _search(self, contact_set: ContactSet, last: ConjugateGradients | None = None) -> ConjugateGradients:
        """Return conjugate gradients on a set: the last search continued, or a new search."""
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
        """Compute e − g = K P − u from a pressure, in double precision if the tolerance needs it; in place.

        change : BoundedField of e − g, whose border is kept
        """
        load = self._exact.load[:, : self._width - 2 * REACH]
        self._loops.shifted(self.interior(pressure), 0, load)
        deflection = self._exact.apply()[:, : load.shape[1]]
        self._loops.shifted(deflection, depth, self.interior(change.values))
        change.rounding = (self._exact_rounding + self.field_rounding) * depth

    def add_penetrating_elements(self, change: BoundedField, inside: Mask, limit: float) -> int:
        """Add the elements that overlap the surface by more than the limit to a set; return their number."""
        fields = (field[self.inner] for field in (change.values, self.initial_gap, inside))
        return sum(self._loops.each(kernels.add_penetrating_elements, (limit,), *fields))

    def interior(self, field: Array) -> Array:
        """Return a view of a flat field without its border, in rows and columns."""
        return field.reshape(-1, self._width)[REACH:-REACH, REACH:-REACH]
