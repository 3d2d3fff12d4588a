"""Hold the operators and fields that all iterations on a grid share.

Symbols and reduced units are defined in contact.state. Fields are flat arrays with a border as wide as the
preconditioner reaches, so elements at the edge need no special treatment.

The iterations run in single precision by default. Fields are in single precision, too, unless the tolerance is so small
that the gap is needed in double precision. The iterations compute ever smaller corrections, so the rounding error
is small, and a bound on it is tracked with every field. When the bound nears the tolerance, the gap is recomputed from
the pressure, in double precision if the tolerance needs it.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from viscorough.basics.argument_names import argument
from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Array, Mask
from viscorough.contact.grid import kernels
from viscorough.contact.grid.conjugate_gradients import ConjugateGradients
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.halfspace.operator import Convolution, spectrum_of_grid
from viscorough.contact.halfspace.tiles import TiledHalfspace
from viscorough.contact.options import SolverOptions
from viscorough.contact.preconditioner.multilevel import REACH, Preconditioner
from viscorough.contact.state import BoundedField, ContactSet

# Initial gap of places without an element, far beyond the largest depth.
_OUTSIDE = 1e30


class GridWorkspace:
    """Half-space operators and preconditioner of a grid, and the fields that all solutions on it share.

    shape : rows and columns of the grid
    tolerance : largest |e| in contact or overlap outside it, over the depth
    options : SolverOptions
    aspect : dy/dx of the elements
    threads : number of threads
    tiles : halfspace.tiles with elements that can touch; the operator is restricted to them

    tolerance, options : as they were given
    loops : GridLoops
    width : length of a row of flat fields
    inner : slice of flat fields without the first and last rows of their border, which for a strip are most of its rows
    initial_gap : flat field; the grid solver sets it at the elements
    residual : e or e_q on the set, as the running iteration last computed it, flat field
    precision : floating-point type of the other fields
    field_rounding : rounding error of a step in the fields, over the depth
    step_rounding : rounding error of the operator of the iterations, over the largest deflection
    exact_rounding : rounding error of the operator that recomputes gaps, over the largest deflection
    """

    def __init__(
        self,
        shape: tuple[int, int],
        tolerance: float,
        options: SolverOptions,
        *,
        aspect: float = 1.0,
        threads: int = 1,
        tiles: Mask | None = None,
    ) -> None:
        self.tolerance, self.options, self.loops = tolerance, options, GridLoops(threads)
        rows, columns = shape
        make_operator: Callable[[DTypeLike], Convolution | TiledHalfspace]
        if tiles is None:
            spectrum = spectrum_of_grid(rows, columns, aspect=aspect, padding=options.padding, threads=threads)
            make_operator = partial(Convolution, shape, spectrum, threads=threads)
        else:
            make_operator = partial(TiledHalfspace, rows, columns, tiles, aspect=aspect, threads=threads)
        self._halfspace = make_operator(np.dtype(options.precision))
        is_exact = tolerance < options.exact_gap_below
        self._exact = make_operator(np.float64) if is_exact else self._halfspace
        self.step_rounding, self.exact_rounding = (
            options.operator_rounding * np.finfo(halfspace.load.dtype).eps + halfspace.accuracy
            for halfspace in (self._halfspace, self._exact)
        )
        self.precision = self._exact.load.dtype.type
        # A step rounds e − g, which is at most the depth, and the pressure, whose deflection is at most the depth, too.
        # If rounding is to be ignored, this is ignored, too.
        self.field_rounding = min(options.operator_rounding, 1.0) * np.finfo(self.precision).eps
        self.width = columns + 2 * REACH
        self.inner = slice(REACH * self.width, -REACH * self.width)
        self.initial_gap = np.empty((rows + 2 * REACH) * self.width, dtype=self.precision)
        self.loops.fill(self.initial_gap, _OUTSIDE)
        self.residual = np.zeros(self.initial_gap.size, dtype=np.float32)
        self._preconditioner = Preconditioner(rows + 2 * REACH, self.width, aspect=aspect, threads=threads)

    @property
    def operator_applications(self) -> int:
        """Return the number of applications of the half-space operator so far."""
        return sum(halfspace.count for halfspace in {self._halfspace, self._exact})

    def contact_set(self, inside: Mask) -> ContactSet:
        """Return the ContactSet of a flat field of flags."""
        return ContactSet(inside, *self.loops.contact_places(inside, self.width, self._halfspace.load.shape[1]))

    def conjugate_gradients(self, contact_set: ContactSet) -> ConjugateGradients:
        """Begin conjugate gradients on a set; they end when the operator is applied to anything else."""
        return ConjugateGradients(self._halfspace, self._preconditioner, contact_set, self.loops)

    def zeros(self, dtype: DTypeLike | None = None) -> NDArray[Any]:
        """Return a flat field of zeros; the loop that fills it allocates its memory on its threads."""
        return np.zeros(self.initial_gap.size, dtype or self.precision)

    def interior(self, field: Array) -> Array:
        """Return a view of a flat field without its border, in rows and columns."""
        return field.reshape(-1, self.width)[REACH:-REACH, REACH:-REACH]

    def gap_change(self, pressure: Array, depth: float) -> BoundedField:
        """Return e − g = K P − u of a pressure as a BoundedField; e_q = K q − 1 of a tangent with a depth of 1."""
        change = BoundedField(self.zeros(), self.field_rounding * depth)
        if pressure.any():
            self.recompute_gap(pressure, depth, change)
        else:
            self.loops.fill(change.values, -depth)
        return change

    def recompute_gap(self, pressure: Array, depth: float, change: BoundedField) -> None:
        """Compute e − g = K P − u from a pressure, in double precision if the tolerance needs it; in place.

        change : BoundedField of e − g, whose border is kept
        """
        load = self._exact.load[:, : self.width - 2 * REACH]
        self.loops.shifted(self.interior(pressure), 0, load)
        deflection = self._exact.apply()[:, : load.shape[1]]
        self.loops.shifted(deflection, depth, self.interior(change.values))
        change.rounding = (self.exact_rounding + self.field_rounding) * depth

    def add_penetrating_elements(self, change: BoundedField, inside: Mask, limit: float) -> int:
        """Add the elements that overlap the surface by more than the limit to a set; return their number."""
        fields = (field[self.inner] for field in (change.values, self.initial_gap, inside))
        return sum(self.loops.each(kernels.add_penetrating_elements, (limit,), *fields))

    def not_converged(self, contact_set: ContactSet, residual: float, limit: float) -> ConvergenceError:
        """Return the error for an iteration that has not reached its limit."""
        return ConvergenceError(
            f"contact of {contact_set.places.size} elements: the residual {residual:.1e} does not fall below "
            f"{limit:.1e} in {self.options.max_iterations} steps; choose a larger {argument('tolerance')}"
        )
