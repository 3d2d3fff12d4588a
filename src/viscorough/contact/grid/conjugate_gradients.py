"""Search for the pressure or the tangent on a contact set by preconditioned conjugate gradients.

The contact set may change between the steps. An iteration has three parts:

1. `ConjugateGradients.precondition` computes the preconditioned residual z = M e from the gap e, with the
   preconditioner M.
2. `ConjugateGradients.next_direction` computes the search direction d from z.
3. `Direction.step` takes the step along d that minimises the energy. Alternatively, `Direction.step_and_release` takes
   a release step: a step of given length, after which elements under tension leave the contact set.

Symbols are defined in contact.state. The formulas of this module are for the pressure P and the gap e. For a tangent,
replace P by q and e by e_q.
"""

from collections.abc import Iterator
from functools import partial

import numpy as np

from viscorough.basics.types import Array, Integers
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops, joined
from viscorough.contact.halfspace.operator import Convolution
from viscorough.contact.halfspace.tiles import TiledHalfspace
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.preconditioner import Preconditioner
from viscorough.contact.state import ContactSet

# Largest magnitude of the conjugacy factor (`Direction.conjugacy_factor`) after a step that has removed elements from
# the contact set. The limit is a safeguard in case many elements were removed.
_LARGEST_SHARE = 1.0


class PreconditionedResidual:
    """Gap e on a contact set, and the preconditioned residual z = M e with the preconditioner M.

    gap : e (or the tangent gap e_q) on the contact set, flat field that the next iteration overwrites
    preconditioned : z on the contact set, flat field that the next iteration overwrites
    contact_set : ContactSet on which e and z are defined
    loops : GridLoops that run the loops over the contact set
    """

    def __init__(self, gap: Array, preconditioned: Array, contact_set: ContactSet, loops: GridLoops) -> None:
        self.gap, self.preconditioned, self.contact_set, self._loops = gap, preconditioned, contact_set, loops

    def total_preconditioned(self) -> float:
        """Return the sum of the preconditioned residual z over the contact set."""
        return self._loops.total(self.preconditioned, self.contact_set.places)

    def energy(self) -> float:
        """Return zᵀe = eᵀ M e, from the gap e and the preconditioned residual z = M e on the contact set.

        The pressure P has the error K⁻¹ e, with the influence matrix K ≈ M⁻¹. The square of this error in the energy
        norm is eᵀ K⁻¹ e, so the result is an estimate of this square. For the tangent, replace e by e_q and P by q.
        """
        return self._loops.inner_product(self.preconditioned, self.gap, self.contact_set.places)

    def shift(self, depth_step: float, response: Array) -> None:
        """Update e and z in place after the depth has grown by Δu: subtract Δu from e, and Δu M 1 from z.

        depth_step : Δu
        response : M 1 on the contact set, from `ConjugateGradients.uniform_response`
        """
        places, step = self.contact_set.places, np.float32(depth_step)

        def shift(i: int, j: int) -> None:
            kernels.shift_on_set(
                depth_step=step,
                gap=self.gap,
                preconditioned=self.preconditioned,
                places=places[i:j],
                response=response[i:j],
            )

        self._loops.over(places, shift)


class Direction:
    """Search direction d on a contact set, along which one step is taken by `step` or by `step_and_release`.

    d is stored in the load array of the half-space operator, so the operator can compute K d without a copy of d. The
    next direction overwrites d.

    halfspace : half-space operator whose load array contains d
    residual : PreconditionedResidual from which d was computed
    stencil : shares of its load that a removed element passes to its neighbours, from `load_redistribution_stencil`
    loops : GridLoops that run the loops over the contact set

    released : indices in the flattened load array of the elements that `step_and_release` removed from the contact set
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
        self._deflection: Array | None = None  # flattened K d; None until `_deflect` computes it
        self._limit = np.inf
        self.released: Integers = np.empty(0, dtype=int)

    def conjugacy_factor(self, residual: PreconditionedResidual) -> float:
        """Return the factor β that makes the next search direction β d − z conjugate to this direction d.

        β = (z·Kd − d·e)/(d·Kd), with e and z after the step along d. The term d·e is zero after a step that minimises
        the energy along d. After a release step the term corrects β, on the assumption that the next step has length 1.
        β is 0 if K d was not computed. After a release step, β is limited to ±_LARGEST_SHARE.

        residual : PreconditionedResidual (e and z) after the step along d
        """
        if self._deflection is None:
            return 0.0
        by_preconditioned, by_gap, by_direction = self._sums(residual)
        if not by_direction > 0:
            return 0.0
        return max(-self._limit, min((by_preconditioned - by_gap) / by_direction, self._limit))

    def step(self, pressure: Array, gap: Array) -> bool:
        """Take the step along d that minimises the energy; change pressure and gap in place.

        pressure : P (or the tangent q), flat field
        gap : e − g (or the tangent gap e_q), flat field

        Returns True if any pressure is negative.
        """
        deflection = self._deflect()
        _, by_gap, by_direction = self._sums(self._residual)
        # The length has the precision of the gap, so that the loops compute in this precision. If the first guess was
        # exact, the direction d is zero, and the length of the step is 0.
        length = gap.dtype.type(-by_gap / by_direction if by_direction > 0 else 0.0)
        self._loops.update_gap(length, deflection, gap)
        _, places, slots = self._residual.contact_set

        def update(i: int, j: int) -> bool:
            return kernels.update_pressure(
                length=length, direction=self._values, pressure=pressure, places=places[i:j], slots=slots[i:j]
            )

        return any(self._loops.over(places, update))

    def unloaded_under_tension(self, pressure: Array) -> Integers:
        """Return the indices of elements without pressure that any step along d would put under tension.

        The indices refer to flat fields.
        """
        _, places, slots = self._residual.contact_set

        def find(i: int, j: int) -> Integers:
            found = np.empty(j - i, places.dtype)
            count = kernels.unloaded_under_tension(
                direction=self._values, pressure=pressure, places=places[i:j], slots=slots[i:j], found=found
            )
            return found[:count]

        return joined(self._loops.over(places, find))

    def causes_tension(self, length: float, pressure: Array) -> bool:
        """Return True if a step of the given length along d would put any element under tension."""
        _, places, slots = self._residual.contact_set

        def causes_tension(i: int, j: int) -> bool:
            return kernels.step_causes_tension(
                length=length, direction=self._values, pressure=pressure, places=places[i:j], slots=slots[i:j]
            )

        return any(self._loops.over(places, causes_tension))

    def step_and_release(self, length: float, pressure: Array, width: int) -> None:
        """Take a step of given length along d, then remove elements under tension from the contact set.

        Pressure and contact set are changed in place. Neighbours of a removed element take over parts of its load (see
        `kernels.release`). The array that held d then holds the total change of pressure. The gap is not changed: call
        `update_gap`, or recompute the gap from the pressure.

        length : factor of d in the change of pressure
        pressure : P, flat field
        width : length of a row of flat fields
        """
        inside, places, slots = self._residual.contact_set

        def step(i: int, j: int) -> Integers:
            found = np.empty(j - i, np.int64)
            count = kernels.step_and_find_tension(
                length=length,
                direction=self._values,
                pressure=pressure,
                inside=inside,
                places=places[i:j],
                slots=slots[i:j],
                first=i,
                released=found,
            )
            return found[:count]

        released = joined(self._loops.over(places, step))
        # An element that leaves changes the loads of its neighbours, so two threads must not release elements close to
        # each other. Divide the rows of the grid into bands of at least two rows. A single thread processes a band. All
        # even bands are processed at the same time, then all odd bands: no element has neighbours in two even bands or
        # in two odd bands.
        band = max(BLOCK // width, 2) * width
        bands = np.split(released, np.searchsorted(places[released], np.arange(band, pressure.size, band)))

        def release(some_bands: list[Integers], first: int, last: int) -> None:
            for members in some_bands[first:last]:
                kernels.release(
                    direction=self._values,
                    pressure=pressure,
                    inside=inside,
                    places=places,
                    slots=slots,
                    released=members,
                    stencil=self._stencil,
                    width=width,
                    stride=self._halfspace.load.shape[1],
                )

        for some_bands in filter(None, (bands[::2], bands[1::2])):
            run_blocks(partial(release, some_bands), len(some_bands), self._loops.threads, 1)
        self.released, self._limit = slots[released], _LARGEST_SHARE

    def update_gap(self, gap: Array) -> None:
        """Add the deflection by the step to e − g, in place; call this method after `step_and_release`.

        gap : e − g, flat field
        """
        self._loops.update_gap(gap.dtype.type(1), self._deflect(), gap)

    def _deflect(self) -> Array:
        """Return the deflection K d in rows and columns; the next application of the operator overwrites the array."""
        deflection = self._halfspace.apply()
        self._deflection = deflection.ravel()
        return deflection[:, : self._halfspace.shape[1]]

    def _sums(self, residual: PreconditionedResidual) -> Iterator[float]:
        """Return the inner products z·Kd, d·e and d·Kd over the contact set; `residual` contains e and z."""
        _, places, slots = residual.contact_set

        def sums(i: int, j: int) -> tuple[float, float, float]:
            return kernels.direction_sums(
                direction=self._values,
                deflection=self._deflection,
                preconditioned=residual.preconditioned,
                gap=residual.gap,
                places=places[i:j],
                slots=slots[i:j],
            )

        return map(sum, zip(*self._loops.over(places, sums), strict=True))


class ConjugateGradients:
    """Conjugate gradients for the pressure P with the residual e, or for the tangent q with the residual e_q.

    The equations on the contact set are e = K P − (u − g) = 0 and e_q = K q − 1 = 0.

    halfspace : half-space operator; its load array holds the current direction, so only one search can use it at a time
    preconditioner : Preconditioner M
    contact_set : ContactSet to start with
    stencil : shares of its load that a removed element passes to its neighbours, from `load_redistribution_stencil`
    loops : GridLoops that run the loops over the contact set
    """

    def __init__(
        self,
        halfspace: Convolution | TiledHalfspace,
        preconditioner: Preconditioner,
        contact_set: ContactSet,
        stencil: Array,
        loops: GridLoops,
    ) -> None:
        self._halfspace, self._preconditioner, self._loops = halfspace, preconditioner, loops
        self._stencil = stencil
        self._values = halfspace.load.ravel()  # view of the operator's load array, which holds the search direction
        loops.fill(self._values, 0)
        self._last: Direction | None = None
        self.change_set(contact_set)

    def change_set(self, contact_set: ContactSet) -> None:
        """Continue on another contact set.

        The last direction is set to zero on removed elements. It is already zero on new elements.
        """
        if self._last:
            self._values[self._last.released] = 0
        self._set = contact_set
        self._preconditioner.prepare(contact_set.inside, contact_set.places.size)

    def uniform_response(self, ones: Array) -> Array:
        """Return M 1 ≈ K⁻¹ 1, the product of the preconditioner M with a vector of ones; it approximates the tangent q.

        ones : flat field of ones

        Returns an array with an entry for every element of the contact set.
        """
        return self._preconditioner.apply(ones)[self._set.places]

    def precondition(self, gap: Array) -> PreconditionedResidual:
        """Compute the preconditioned residual z = M e on the contact set.

        gap : e (or the tangent gap e_q) on the contact set, flat field
        """
        return PreconditionedResidual(gap, self._preconditioner.apply(gap), self._set, self._loops)

    def next_direction(self, residual: PreconditionedResidual) -> Direction:
        """Compute the next search direction, conjugate to the last direction, from a residual.

        The last direction is overwritten.
        """
        factor = self._last.conjugacy_factor(residual) if self._last else 0.0
        _, places, slots = self._set

        def update(i: int, j: int) -> None:
            kernels.update_search_direction(
                direction=self._values,
                preconditioned=residual.preconditioned,
                factor=factor,
                places=places[i:j],
                slots=slots[i:j],
            )

        self._loops.over(places, update)
        self._last = Direction(self._halfspace, residual, self._stencil, self._loops)
        return self._last
