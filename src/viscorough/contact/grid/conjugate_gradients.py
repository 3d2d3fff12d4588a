"""Preconditioned conjugate gradients on the contact sets of a grid, one after the other.

One iteration: `ConjugateGradients.precondition` makes a PreconditionedResidual from the gap, `next_direction` makes a
Direction from it, and one of the two kinds of step of the Direction changes pressure and gap.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from viscorough.basics.types import Array, Integers
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops, joined
from viscorough.contact.halfspace.operator import Convolution
from viscorough.contact.halfspace.tiles import TiledHalfspace
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.preconditioner.multilevel import Preconditioner
from viscorough.contact.state import ContactSet

# Largest share of the last change of pressure in the next direction: a safeguard if many elements left the set.
_LARGEST_SHARE = 1.0


class PreconditionedResidual:
    """The gap e on a contact set, or e_q, and z = M e with the preconditioner M.

    gap, preconditioned : e and z on the set, flat fields that the next residual overwrites
    contact_set : ContactSet
    loops : GridLoops
    """

    def __init__(self, gap: Array, preconditioned: Array, contact_set: ContactSet, loops: GridLoops) -> None:
        self.gap, self.preconditioned, self.contact_set, self._loops = gap, preconditioned, contact_set, loops

    def total_preconditioned(self) -> float:
        """Return Σz over the set."""
        return self._loops.total(self.preconditioned, self.contact_set.places)

    def energy(self) -> float:
        """Return zᵀe, the square of the norm of the residual."""
        return self._loops.inner_product(self.preconditioned, self.gap, self.contact_set.places)

    def shift(self, depth_step: float, response: Array) -> None:
        """Change e and z on the set, in place, for a step of the depth.

        response : M 1, from `ConjugateGradients.uniform_response`
        """
        fixed = np.float32(depth_step), self.gap, self.preconditioned
        self._loops.each(kernels.shift_on_set, fixed, self.contact_set.places, response)


class Direction:
    """A search direction d on a contact set, and the steps along it; take one of the two kinds of step.

    d is the load array of the half-space operator itself: applying the operator gives K d without a copy. The next
    direction overwrites d.

    halfspace : Halfspace with d as its load
    residual : PreconditionedResidual that d follows from
    stencil : preconditioner.load_redistribution_stencil
    loops : GridLoops

    released : indices in d of the elements that a step has released
    """

    def __init__(
        self,
        halfspace: Convolution | TiledHalfspace,
        residual: PreconditionedResidual,
        stencil: Array,
        loops: GridLoops,
    ) -> None:
        self._halfspace, self._values, self._residual = halfspace, halfspace.load.ravel(), residual
        self._stencil, self._loops = stencil, loops
        self._deflection: Array | None = None  # K d of the last step, as a flat array
        self._limit = np.inf
        self.released: Integers = np.empty(0, dtype=int)

    def conjugacy_factor(self, residual: PreconditionedResidual) -> float:
        """Return the share of this direction in the next one, which makes them conjugate.

        A release step does not minimise the energy along its direction, so its conjugacy factor is corrected. The
        coming step is assumed to have length 1.

        residual : PreconditionedResidual after the step
        """
        if self._deflection is None:
            return 0.0
        by_preconditioned, by_gap, by_direction = self._sums(residual)
        if not by_direction > 0:
            return 0.0
        return max(-self._limit, min((by_preconditioned - by_gap) / by_direction, self._limit))

    def step(self, pressure: Array, gap: Array) -> bool:
        """Take a step of conjugate gradients, which changes pressure and gap in place.

        gap : e − g, or e_q, flat field

        Returns True if any pressure is negative.
        """
        deflection = self._deflect()
        _, by_gap, by_direction = self._sums(self._residual)
        # Fields must keep their precision in the loops. If the guess was exact, there is no direction.
        length = gap.dtype.type(-by_gap / by_direction if by_direction > 0 else 0.0)
        self._loops.update_gap(length, deflection, gap)
        return any(self._over_set(kernels.update_pressure, length, self._values, pressure))

    def unloaded_under_tension(self, pressure: Array) -> Integers:
        """Return places of elements without pressure that a step along the direction would put under tension."""
        return joined(self._over_set(kernels.unloaded_under_tension, self._values, pressure))

    def causes_tension(self, length: float, pressure: Array) -> bool:
        """Return True if a step of that length along the direction puts any element under tension."""
        return any(self._over_set(kernels.step_causes_tension, length, self._values, pressure))

    def step_and_release(self, length: float, pressure: Array, width: int) -> None:
        """Take a step of given length, then remove elements under tension from the set; changes both in place.

        width : length of a row of flat fields

        The direction becomes the change of pressure. The gap is not changed: update or recompute it.
        """
        direction, (inside, places, slots) = self._values, self._residual.contact_set
        neighbours = self._stencil, width, self._halfspace.load.shape[1]

        def step(i: int, j: int) -> Integers:
            return kernels.step_and_find_tension(length, direction, pressure, inside, places[i:j], slots[i:j], i)

        released = joined(self._loops.over(places, step))
        # Elements of a band of rows leave one after the other, since neighbours share their loads. Bands have at least
        # two rows, so every other band can be processed at the same time.
        band = max(BLOCK // width, 2) * width
        bands = np.split(released, np.searchsorted(places[released], np.arange(band, pressure.size, band)))

        def release(some_bands: list[Integers], first: int, last: int) -> None:
            for members in some_bands[first:last]:
                kernels.release(direction, pressure, inside, places, slots, members, *neighbours)

        for some_bands in filter(None, (bands[::2], bands[1::2])):
            run_blocks(partial(release, some_bands), len(some_bands), self._loops.threads, 1)
        self.released, self._limit = slots[released], _LARGEST_SHARE

    def update_gap(self, gap: Array) -> None:
        """Change the gap, e − g, by the deflection of the direction, in place."""
        self._loops.update_gap(gap.dtype.type(1), self._deflect(), gap)

    def _deflect(self) -> Array:
        """Return K d in rows and columns; valid until the next call."""
        deflection = self._halfspace.apply()
        self._deflection = deflection.ravel()
        return deflection[:, : self._halfspace.shape[1]]

    def _sums(self, residual: PreconditionedResidual) -> Array:
        """Return z·Kd, d·e and d·Kd over the set of a residual."""
        fields = self._values, self._deflection, residual.preconditioned, residual.gap
        members = residual.contact_set
        return sum(self._loops.each(kernels.direction_sums, fields, members.places, members.slots))

    def _over_set(self, kernel: Callable[..., Any], *fixed: Any) -> Any:
        """Return results of kernel(*fixed, places, slots) for the blocks of the set."""
        members = self._residual.contact_set
        return self._loops.each(kernel, fixed, members.places, members.slots)


class ConjugateGradients:
    """Search directions for x with K x given on a contact set; x is P or q, the residual −e or −e_q.

    halfspace : Halfspace or TiledHalfspace; its load is the current direction, so that it can serve one search only
    preconditioner : Preconditioner
    contact_set : ContactSet
    loops : GridLoops
    """

    def __init__(
        self,
        halfspace: Convolution | TiledHalfspace,
        preconditioner: Preconditioner,
        contact_set: ContactSet,
        loops: GridLoops,
    ) -> None:
        self._halfspace, self._preconditioner, self._loops = halfspace, preconditioner, loops
        self._values = halfspace.load.ravel()  # a view: the direction is the operator's load
        loops.fill(self._values, 0)
        self._last: Direction | None = None
        self.change_set(contact_set)

    def change_set(self, contact_set: ContactSet) -> None:
        """Continue with another contact set; the direction is zero on elements that have joined or left."""
        if self._last:
            self._values[self._last.released] = 0
        self._set = contact_set
        self._preconditioner.prepare(contact_set.inside, contact_set.places.size)

    def uniform_response(self, ones: Array) -> Array:
        """Return M 1 on the set, in the order of its places; it approximates the tangent.

        ones : flat field
        """
        return self._preconditioner.apply(ones)[self._set.places]

    def precondition(self, gap: Array) -> PreconditionedResidual:
        """Compute z = M e on the set.

        gap : e or e_q on the set, flat field
        """
        return PreconditionedResidual(gap, self._preconditioner.apply(gap), self._set, self._loops)

    def next_direction(self, residual: PreconditionedResidual) -> Direction:
        """Return the search direction that follows from a residual, conjugate to the last direction.

        It overwrites the last direction.
        """
        factor = self._last.conjugacy_factor(residual) if self._last else 0.0
        fixed = self._values, residual.preconditioned, factor
        self._loops.each(kernels.update_search_direction, fixed, self._set.places, self._set.slots)
        self._last = Direction(self._halfspace, residual, self._preconditioner.stencil, self._loops)
        return self._last
