"""Preconditioned conjugate gradients on the contact sets of a grid, one after the other."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops, joined
from viscorough.contact.halfspace.operator import Halfspace
from viscorough.contact.halfspace.tiles import TiledHalfspace
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.preconditioner.multilevel import Preconditioner
from viscorough.contact.state import ContactSet
from viscorough.types import Array, Integers

# Largest share of the last change of pressure in the next direction: a safeguard if many elements left the set.
_LARGEST_SHARE = 1.0


class ConjugateGradients:
    """Conjugate gradients for x with K x given on a contact set; x is P or q, the residual −e or −e_q.

    halfspace : Halfspace; preconditioner : Preconditioner; contact_set : ContactSet; loops : GridLoops

    The search direction d is the load array of the half-space operator itself: applying the operator gives K d without
    a copy. Therefore only one search at a time can use a half-space.
    """

    def __init__(
        self,
        halfspace: Halfspace | TiledHalfspace,
        preconditioner: Preconditioner,
        contact_set: ContactSet,
        loops: GridLoops,
    ) -> None:
        self._halfspace, self._preconditioner, self._loops = halfspace, preconditioner, loops
        self._direction = halfspace.load.ravel()  # a view: the direction is the operator's load
        loops.fill(self._direction, 0)
        self._deflection: Array | None = None
        self._limit, self._released = np.inf, np.empty(0, dtype=int)
        self.change_set(contact_set)

    def change_set(self, contact_set: ContactSet) -> None:
        """Continue with another contact set; the direction is zero on elements that have joined or left."""
        self._direction[self._released] = 0
        self._set, self._released = contact_set, self._released[:0]
        self._preconditioner.prepare(contact_set.inside, contact_set.places.size)

    def precondition(self, gap: Array) -> None:
        """Compute the preconditioned gap z = M e on the set."""
        self._preconditioned, self._gap = self._preconditioner.apply(gap), gap

    def uniform_response(self, ones: Array) -> Array:
        """Return M 1 on the set, in the order of its places; it approximates the tangent. Call it before
        `precondition`.

        ones : flat field
        """
        return self._preconditioner.apply(ones)[self._set.places]

    def total_preconditioned(self) -> float:
        """Return Σz over the set."""
        return self._loops.total(self._preconditioned, self._set.places)

    def shift(self, depth_step: float, response: Array) -> None:
        """Change e and z = M e on the set, in place, for a step of the depth.

        response : M 1, from `uniform_response`
        """
        fixed = np.float32(depth_step), self._gap, self._preconditioned
        self._loops.each(kernels.shift_on_set, fixed, self._set.places, response)

    def norm(self) -> float:
        """Return zᵀe, the square of the norm of the residual."""
        return self._loops.inner_product(self._preconditioned, self._gap, self._set.places)

    def update_direction(self) -> None:
        """Update the search direction from the preconditioned residual, conjugate to the last direction.

        A release step does not minimise the energy along its direction, so its conjugacy factor is corrected. The
        coming step is assumed to have length 1.
        """
        factor = 0.0
        if self._deflection is not None:
            of_preconditioned, of_gap, of_direction = self._sums()
            if of_direction > 0:
                factor = max(-self._limit, min((of_preconditioned - of_gap) / of_direction, self._limit))
        self._over_set(kernels.update_search_direction, self._direction, self._preconditioned, factor)

    def step(self, pressure: Array, gap: Array) -> bool:
        """Take a step of conjugate gradients, which changes pressure and gap in place.

        gap : e − g, or e_q, flat field

        Returns True if any pressure is negative.
        """
        deflection = self._deflect()
        _, of_gap, of_direction = self._sums()
        # Fields must keep their precision in the loops. If the guess was exact, there is no direction.
        length = gap.dtype.type(-of_gap / of_direction if of_direction > 0 else 0.0)
        self._loops.update_gap(length, deflection, gap)
        self._limit = np.inf
        return any(self._over_set(kernels.update_pressure, length, self._direction, pressure))

    def unloaded_under_tension(self, pressure: Array) -> Integers:
        """Return places of elements without pressure that a step along the direction would put under tension."""
        return joined(self._over_set(kernels.unloaded_under_tension, self._direction, pressure))

    def step_causes_tension(self, length: float, pressure: Array) -> bool:
        """Return True if a step of that length along the direction puts any element under tension."""
        return any(self._over_set(kernels.step_causes_tension, length, self._direction, pressure))

    def step_and_release(self, length: float, pressure: Array, width: int) -> None:
        """Take a step of given length, then remove elements under tension from the set; changes both in place.

        width : length of a row of flat fields

        The direction becomes the change of pressure; the gap is changed by `update_gap`, or computed from the pressure.
        """
        direction, (inside, places, slots) = self._direction, self._set
        neighbours = self._preconditioner.stencil, width, self._halfspace.load.shape[1]

        def step(i: int, j: int) -> Integers:
            return kernels.step_and_find_tension(length, direction, pressure, inside, places[i:j], slots[i:j], i)

        released = joined(self._loops.over(places, step))
        # Elements of a band of rows leave one after the other, since neighbours share their loads. Bands have at least
        # two rows, so every other band can be processed at the same time.
        band = max(BLOCK // width, 2) * width
        bands = np.split(released, np.searchsorted(places[released], np.arange(band, pressure.size, band)))

        def release(of_bands: list[Integers], first: int, last: int) -> None:
            for of_band in of_bands[first:last]:
                kernels.release(direction, pressure, inside, places, slots, of_band, *neighbours)

        for of_bands in filter(None, (bands[::2], bands[1::2])):
            run_blocks(partial(release, of_bands), len(of_bands), self._loops.threads, 1)
        self._released = slots[released]
        self._deflection, self._limit = None, _LARGEST_SHARE

    def update_gap(self, gap: Array) -> None:
        """Change the gap, e − g, by the deflection of the direction, in place."""
        self._loops.update_gap(gap.dtype.type(1), self._deflect(), gap)

    def _deflect(self) -> Array:
        """Return K d in rows and columns; valid until the next call."""
        deflection = self._halfspace.apply()
        self._deflection = deflection.ravel()
        return deflection[:, : self._halfspace.shape[1]]

    def _sums(self) -> Array:
        """Return z·Kd, d·e and d·Kd over the set."""
        fields = self._direction, self._deflection, self._preconditioned, self._gap
        return sum(self._over_set(kernels.direction_sums, *fields))

    def _over_set(self, kernel: Callable[..., Any], *fixed: Any) -> Any:
        """Return results of kernel(*fixed, places, slots) for the blocks of the set."""
        return self._loops.each(kernel, fixed, self._set.places, self._set.slots)
