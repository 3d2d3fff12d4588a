"""Start the tangent of a new contact from the combination of computed fields that is closest to it in energy.

The deflections of both pressures of a step and of the last tangent have been computed, and the new tangent q is almost
a combination of these three fields.
"""

import numpy as np

from viscorough.basics.types import Array
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops, field_to_fill
from viscorough.contact.grid.pressure_iteration import TrialContact
from viscorough.contact.state import BoundedField, ContactSet, GridContact

# Eigenvalues of the energies of the loads, over the largest, that are zero but for rounding.
_DEPENDENT = 1e-10


def initial_tangent(
    trial: TrialContact, last: GridContact | None, contact_set: ContactSet, inner: slice, loops: GridLoops
) -> tuple[Array, BoundedField]:
    """Return the combination as initial q, and e_q = K q − 1 everywhere as a BoundedField.

    trial : the contact after the step, solved
    last : GridContact before the step; None if the solution started without it
    contact_set : the ContactSet after the step
    inner : slice of flat fields without the first and last rows of their border
    loops : GridLoops
    """
    pressure, change, depth = trial.pressure, trial.change, trial.depth
    last_depth, last_rounding, tangent_rounding = 0.0, 0.0, 0.0
    computed = 3 * (pressure, change.values)
    if last:
        before, last_depth = last.fields, last.reduced_depth
        last_fields = before.pressure, before.gap_change.values, before.tangent, before.tangent_gap.values
        computed = pressure, change.values, *last_fields
        last_rounding, tangent_rounding = before.gap_change.rounding, before.tangent_gap.rounding
    # An element that left the contact, within the tolerance, was loaded by fields that cannot be part of q.
    only_now = last is None or loops.difference(last.fields.inside, contact_set.inside).size > 0
    combined = slice(1) if only_now else slice(3)
    parts = loops.each(kernels.energies, ((depth, last_depth), *computed), contact_set.places)
    energy, sums = (sum(part) for part in zip(*parts, strict=True))
    energy, sums = energy[combined, combined], sums[combined]
    scale = 1 / np.sqrt(np.maximum(np.diag(energy), np.finfo(float).tiny))
    # Least squares, since the loads may be multiples of each other.
    eigenvalues, vectors = np.linalg.eigh(scale[:, None] * energy * scale)
    independent = eigenvalues > _DEPENDENT * eigenvalues[-1]
    vectors = vectors[:, independent]
    solution = scale * (vectors @ ((scale * sums) @ vectors / eigenvalues[independent]))
    # q ≈ a P + b P' + c q', with P' and q' before the step.
    a, b, c = weights = *solution, *[0.0] * (3 - solution.size)
    tangent, tangent_gap = (field_to_fill(pressure.size, pressure.dtype, inner) for _ in range(2))
    fields = (field[inner] for field in (tangent, tangent_gap, *computed))
    loops.each(kernels.combine, (weights, a * depth + b * last_depth + c - 1), *fields)
    # Bound on the rounding error of the combined e_q. Unless it was recomputed, the gap has the errors of the last gap
    # and tangent gap, which partly cancel here.
    depth_step = depth - last_depth
    added = change.rounding - last_rounding - depth_step * tangent_rounding
    if added >= 0:
        rounding = abs(a + b) * last_rounding + abs(a * depth_step + c) * tangent_rounding + abs(a) * added
    else:
        rounding = abs(a) * change.rounding + abs(b) * last_rounding + abs(c) * tangent_rounding
    return tangent, BoundedField(tangent_gap, rounding)
