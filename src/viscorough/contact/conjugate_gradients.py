"""Preconditioned conjugate gradients on one contact set of a grid."""

import numpy as np


class ConjugateGradients:
    """Conjugate gradients for x with K x given on a contact set; x is P or q, the residual −e or −e_q.

    halfspace : Halfspace; preconditioner : Preconditioner; contact_set : ContactSet; loops : GridLoops

    The search direction d is the load array of the half-space operator itself: applying the operator gives K d without
    a copy. Only one search can therefore be under way on a half-space.
    """

    def __init__(self, halfspace, preconditioner, contact_set, loops):
        self._halfspace, self._preconditioner, self._set, self._loops = halfspace, preconditioner, contact_set, loops
        preconditioner.prepare(contact_set.inside, contact_set.places.size)
        self._direction = halfspace.load.ravel()  # a view: the direction is the operator's load
        loops.fill(self._direction, 0)
        self._norm, self._last_norm = np.nan, np.inf

    def precondition(self, gap):
        """Compute the preconditioned gap z = M e on the set; returns zᵀe."""
        self._preconditioned = self._preconditioner.apply(gap)
        # Both factors have the opposite sign: the residual is −e.
        self._norm = self._loops.inner_product(self._preconditioned, gap, self._set.places)
        return self._norm

    def update_direction(self):
        """Update the search direction: conjugate to the last one, from the preconditioned residual."""
        factor = self._norm / self._last_norm
        of_set = self._set.places, self._set.slots
        self._loops.update_search_direction(self._direction, self._preconditioned, factor, *of_set)
        self._last_norm = self._norm

    def step(self, pressure, gap):
        """Take a step of conjugate gradients, which changes pressure and gap in place.

        gap : e − g, or e_q, flat field

        Returns whether any pressure is negative.
        """
        deflection, (_, columns) = self._halfspace.apply(), self._halfspace.shape
        length = self._norm / self._loops.inner_product(self._direction, deflection.ravel(), self._set.slots)
        length = gap.dtype.type(length)  # in the precision of the fields, which the compiled loops then keep to
        self._loops.update_gap(length, deflection[:, :columns], gap)
        return self._loops.update_pressure(length, self._direction, pressure, self._set.places, self._set.slots)

    def step_causes_tension(self, length, pressure):
        """Whether a step of that length along the direction puts any element under tension."""
        return self._loops.step_causes_tension(length, self._direction, pressure, self._set.places, self._set.slots)

    def step_and_release(self, length, pressure, gap, width):
        """Take a step of given length, after which elements under tension leave the set; all in place.

        gap : e − g, flat field
        width : of a row of flat fields
        """
        contact_set, stencil = self._set, self._preconditioner.stencil
        self._loops.step_and_release(
            length, self._direction, pressure, contact_set.inside, contact_set.places, contact_set.slots,
            stencil, width, self._halfspace.load.shape[1],
        )  # fmt: skip
        self._loops.update_gap(gap.dtype.type(1), self._halfspace.apply()[:, : self._halfspace.shape[1]], gap)
