"""Hold the operators and fields of a grid that all iterations share, and the state of an iteration.

Symbols and reduced units are defined in contact.state. Fields are flat arrays with a border as wide as the
preconditioner reaches, so elements at the edge need no special treatment.

The iterations run in single precision by default. Fields are in single precision, too, unless the tolerance is so small
that the gap is needed in double precision. The corrections that the iterations compute become smaller and smaller, so
rounding errors remain small. A bound on the rounding error is stored with every field. When the bound nears the
tolerance, the gap is recomputed from the pressure, in double precision if the tolerance needs it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.border import BORDER
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.halfspace.operator import Convolution, spectrum_of_grid
from viscorough.contact.halfspace.tiles import TiledHalfspace
from viscorough.contact.options import SolverOptions
from viscorough.contact.preconditioner import Preconditioner
from viscorough.contact.state import BoundedField, ContactSet

# Initial gap at points of the grid without an element: a number far above the largest depth, so that they never touch.
_OUTSIDE = 1e30


@dataclass
class TrialContact:
    """First guess of a contact, which an iteration changes in place until it is the solution.

    pressure : P, flat field
    change : change e − g of every gap since first contact, with a bound on its rounding error
    inside : True for places in contact, flat field
    depth : reduced depth u, which changes only if a force is given
    """

    pressure: Array
    change: BoundedField
    inside: Mask
    depth: float


@dataclass
class Search:
    """State of conjugate gradients on a contact set: the search direction d, and the results of the last step along d.

    Each field names its owner, and the functions of module iteration that write it. The gap e on the contact set is in
    `GridWorkspace.residual`; every iteration computes it first. For a tangent, replace e by e_q.

    contact_set : ContactSet on which the other fields are defined. Written by `begin_search` and `_prepare_search`
    direction : d, the flattened load array of the half-space operator. Written by `next_direction`; a release step
        replaces d by the total change of pressure
    preconditioned : z = M e, a flat field of the preconditioner, which overwrites it when it is applied again. Written
        by `precondition`; `_adjust_depth` changes it for the new depth
    deflection : K d, the flattened result array of the half-space operator, which overwrites it when it is applied
        again; None if no step along d was taken. Written by both kinds of step, reset by `next_direction`
    released : indices in `direction` of the elements that the last step removed from the contact set. Written by
        `_take_release_step`, reset by `next_direction`
    largest_factor : largest magnitude of the next conjugacy factor. Written by `_take_release_step`, reset by
        `next_direction`
    """

    contact_set: ContactSet
    direction: Array
    preconditioned: Array = field(default_factory=lambda: np.empty(0, np.float32))
    deflection: Array | None = None
    released: Integers = field(default_factory=lambda: np.empty(0, dtype=int))
    largest_factor: float = np.inf


@dataclass
class PressureState:
    """State of the iteration for the pressure of a contact.

    Each field names the functions of module iteration that write it.

    trial : TrialContact. Both kinds of step write the pressure and the change of the gap; `_adjust_depth` writes the
        depth and the change of the gap; `_take_release_step`, `_exclude_unloaded` and `_add_penetrating_elements` write
        the field `inside`
    contact_set : ContactSet of the trial. Written by `_measure`
    has_tension : True if any pressure is negative. Written by both kinds of step
    ones : flat field of ones, to which the preconditioner is applied; empty if no force is given. Never changed
    stiffness : Σq, with q = dP/du. Written by `_prepare_search`
    response : estimate M 1 of q on the contact set; empty if no force is given. Written by `_prepare_search`
    set_changed : True if `trial.inside` has changed since `contact_set` was made. Written before a step, and whenever
        elements join the set
    releases : number of release steps so far. Written by `_take_release_step`
    search : Search; None before the first iteration, and if the load array of the operator was overwritten. Written by
        `_prepare_search` and `_try_to_finish`
    limit : largest allowed |e|. Written by `_measure`, and by `_adjust_depth` for the new depth
    largest : largest |e| on the contact set. Written by `_measure`
    close_enough : |e| below which the iteration may end. Written by `_measure`
    """

    trial: TrialContact
    contact_set: ContactSet
    has_tension: bool
    ones: Array
    stiffness: float
    response: Array = field(default_factory=lambda: np.empty(0, np.float32))
    set_changed: bool = False
    releases: int = 0
    search: Search | None = None
    limit: float = 0.0
    largest: float = 0.0
    close_enough: float = 0.0


class GridWorkspace:
    """Half-space operators and preconditioner of a grid, and the fields that all solutions on the grid share.

    shape : rows and columns of the grid
    tolerance : largest allowed |e| in contact, and overlap elsewhere, relative to the depth
    options : SolverOptions
    aspect : dy/dx of the elements
    threads : number of threads
    tiles : True for tiles with elements that can touch (see `halfspace.tiles.tiles_with`). The operator then computes
        deflections only in these tiles. None: it computes deflections on the whole grid

    tolerance, options, aspect : the arguments of the same names
    loops : GridLoops that run the loops over the grid
    halfspace : half-space operator K of the iterations. Its load array holds the search direction, so only one
        iteration can use the grid at a time
    preconditioner : Preconditioner M
    width : length of a row of flat fields
    inner : slice of flat fields that leaves out the border rows at both ends. This saves work on a narrow strip, where
        most rows are border rows
    initial_gap : initial gap g, flat field; the grid solver sets the values at places with elements
    residual : e or e_q on the contact set, flat field that every iteration overwrites
    precision : floating-point type of all flat fields except `residual`
    field_rounding : bound on the rounding error that a step adds to a field, relative to the depth
    step_rounding : rounding error of the operator of the iterations, relative to the largest deflection
    exact_rounding : rounding error of the operator that recomputes gaps, relative to the largest deflection
    """

    def __init__(
        self,
        shape: tuple[int, int],
        tolerance: float,
        options: SolverOptions,
        *,
        aspect: float,
        threads: int,
        tiles: Mask | None,
    ) -> None:
        self.tolerance, self.options, self.aspect, self.loops = tolerance, options, aspect, GridLoops(threads)
        rows, columns = shape
        make_operator: Callable[[DTypeLike], Convolution | TiledHalfspace]
        if tiles is None:
            spectrum = spectrum_of_grid(rows, columns, aspect=aspect, padding=options.padding, threads=threads)
            make_operator = partial(Convolution, shape, spectrum, threads=threads)
        else:
            make_operator = partial(TiledHalfspace, rows, columns, tiles, aspect=aspect, threads=threads)
        self.halfspace = make_operator(np.dtype(options.precision))
        is_exact = tolerance < options.exact_gap_below
        self._exact = make_operator(np.float64) if is_exact else self.halfspace
        self.step_rounding, self.exact_rounding = (
            options.operator_rounding * np.finfo(halfspace.load.dtype).eps + halfspace.accuracy
            for halfspace in (self.halfspace, self._exact)
        )
        self.precision = self._exact.load.dtype.type
        # A step of the iteration rounds e − g and the pressure. Both errors are relative to the depth, because neither
        # e − g nor the deflection by the pressure exceeds the depth. If the option operator_rounding is 0, all rounding
        # errors are ignored.
        self.field_rounding = min(options.operator_rounding, 1.0) * np.finfo(self.precision).eps
        self.width = columns + 2 * BORDER
        self.inner = slice(BORDER * self.width, -BORDER * self.width)
        self.initial_gap = np.empty((rows + 2 * BORDER) * self.width, dtype=self.precision)
        self.loops.fill(self.initial_gap, _OUTSIDE)
        self.residual = np.zeros(self.initial_gap.size, dtype=np.float32)
        self.preconditioner = Preconditioner(rows + 2 * BORDER, self.width, aspect=aspect, threads=threads)

    @property
    def operator_applications(self) -> int:
        """Return the number of applications of the half-space operator so far."""
        return sum(halfspace.count for halfspace in {self.halfspace, self._exact})

    def contact_set(self, inside: Mask) -> ContactSet:
        """Return the ContactSet of the elements for which the flat field `inside` is True."""
        return ContactSet(inside, *self.loops.contact_places(inside, self.width, self.halfspace.load.shape[1]))

    def gather(self, field: Array, contact_set: ContactSet) -> float:
        """Copy a flat field on a contact set to `residual`; return the largest magnitude of the copied values."""
        places = contact_set.places

        def copy(i: int, j: int) -> float:
            return kernels.gather_on_set(field=field, gathered=self.residual, places=places[i:j])

        return max(self.loops.over(places, copy))

    def zeros(self, dtype: DTypeLike | None = None) -> NDArray[Any]:
        """Return a flat field of zeros.

        Its memory is allocated later, by the threads of the first loop that writes to the field.
        """
        return np.zeros(self.initial_gap.size, dtype or self.precision)

    def interior(self, field: Array) -> Array:
        """Return a view of a flat field without its border, as an array in rows and columns."""
        return field.reshape(-1, self.width)[BORDER:-BORDER, BORDER:-BORDER]

    def gap_change(self, pressure: Array, depth: float) -> BoundedField:
        """Return the change e − g = K P − u of all gaps since first contact, for a pressure P and a depth u.

        The result is a BoundedField: values with a bound on their rounding error. For a tangent q = dP/du instead of P,
        and the depth 1, the result is e_q = K q − 1.
        """
        change = BoundedField(self.zeros(), self.field_rounding * depth)
        if pressure.any():
            self.recompute_gap(pressure, depth, change)
        else:
            self.loops.fill(change.values, -depth)
        return change

    def recompute_gap(self, pressure: Array, depth: float, change: BoundedField) -> None:
        """Recompute e − g = K P − u from a pressure P and a depth u, in double precision if the tolerance needs it.

        change : result e − g; the values are changed in place, except in the border, and the bound on their rounding
            error is renewed
        """
        load = self._exact.load[:, : self.width - 2 * BORDER]
        self.loops.shifted(self.interior(pressure), 0, load)
        deflection = self._exact.apply()[:, : load.shape[1]]
        self.loops.shifted(deflection, depth, self.interior(change.values))
        change.rounding = (self.exact_rounding + self.field_rounding) * depth

    def add_penetrating_elements(self, change: BoundedField, inside: Mask, limit: float) -> int:
        """Add elements that overlap the surface by more than `limit` to a contact set; return how many were added.

        change : change e − g of every gap since first contact
        inside : True for elements in the set, flat field, changed in place
        """
        gap_change, initial_gap, inside = change.values[self.inner], self.initial_gap[self.inner], inside[self.inner]

        def add(i: int, j: int) -> int:
            return kernels.add_penetrating_elements(
                limit=limit, gap_change=gap_change[i:j], initial_gap=initial_gap[i:j], inside=inside[i:j]
            )

        return sum(self.loops.over(inside, add))

    def not_converged(self, contact_set: ContactSet, residual: float, limit: float) -> ConvergenceError:
        """Return the ConvergenceError of an iteration whose residual has not fallen below its limit."""
        return ConvergenceError(
            f"contact of {contact_set.places.size} elements: the residual {residual:.1e} does not fall below "
            f"{limit:.1e} in {self.options.max_iterations} steps; choose a larger argument tolerance"
        )
