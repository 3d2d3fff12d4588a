"""Solve for the tangent q, the solution of K q = 1 on a contact set, by preconditioned conjugate gradients.

The iteration starts from fields that are already known. A step of the depth leads from the last contact to the new
contact. Three fields and their deflections have been computed: the pressure and the tangent of the last contact, and
the pressure of the new contact. The tangent q of the new contact is almost a linear combination of these three fields.
The first guess is the combination that is closest to q in the energy norm.
"""

import numpy as np

from viscorough.basics.types import Array
from viscorough.contact.grid import kernels
from viscorough.contact.grid.iteration import (
    begin_search,
    conjugate_step,
    next_direction,
    precondition,
    residual_energy,
)
from viscorough.contact.grid.loops import GridLoops, field_to_fill
from viscorough.contact.grid.state import GridWorkspace, TrialContact
from viscorough.contact.preconditioner import LEAST_EIGENVALUE
from viscorough.contact.state import BoundedField, ContactSet, GridContact

# Largest relative error of the tangent q in the energy norm, where q = dP/du solves K q = 1 on the contact set. The
# square of this error is the relative error of the stiffness.
_TANGENT_TOLERANCE = 1e-2
# Largest accepted rounding error of the residual e_q = K q − 1, as a multiple of the tolerance of the contact. The
# error of the stiffness nevertheless stays within the tolerance, because it depends on the mean of e_q over the contact
# set, not on the largest e_q (tests/viscorough/contact/test_loading_path.py).
_TANGENT_ROUNDING = 5.0
# The energy matrix contains the inner products of the three fields with their deflections. Its eigenvalues below this
# share of the largest eigenvalue are rounding errors and count as zero.
_DEPENDENT = 1e-10


def initial_tangent(
    trial: TrialContact, last: GridContact | None, contact_set: ContactSet, inner: slice, loops: GridLoops
) -> tuple[Array, BoundedField]:
    """Return a first guess of the tangent q of a new contact, and its residual e_q = K q − 1 on the whole grid.

    e_q is a BoundedField: values with a bound on their rounding error.

    trial : the new contact, whose pressure is solved
    last : GridContact before the step; None if the new contact was solved from loads only
    contact_set : ContactSet of the new contact
    inner : slice of flat fields that leaves out the border rows at both ends
    loops : GridLoops that run the loops over the grid
    """
    pressure, change, depth = trial.pressure, trial.change, trial.depth
    last_depth, last_rounding, tangent_rounding = 0.0, 0.0, 0.0
    # Without a last contact, the pressure of the new contact takes the place of the other two fields.
    last_pressure = last_tangent = pressure
    last_change = last_tangent_gap = change.values
    if last:
        before, last_depth = last.fields, last.reduced_depth
        last_pressure, last_change = before.pressure, before.gap_change.values
        last_tangent, last_tangent_gap = before.tangent, before.tangent_gap.values
        last_rounding, tangent_rounding = before.gap_change.rounding, before.tangent_gap.rounding
    # q must be zero outside the new contact set. If an element has left the contact, which is possible within the
    # tolerance, the fields of the last contact are not zero on it. Then use only the pressure of the new contact.
    only_now = last is None or loops.difference(last.fields.inside, contact_set.inside).size > 0
    combined = slice(1) if only_now else slice(3)
    places = contact_set.places

    def energies(i: int, j: int) -> tuple[float, ...]:
        return kernels.energies(
            depths=(depth, last_depth),
            pressure=pressure,
            gap_change=change.values,
            last_pressure=last_pressure,
            last_gap_change=last_change,
            last_tangent=last_tangent,
            last_tangent_gap=last_tangent_gap,
            places=places[i:j],
        )

    products, sums = np.split(np.sum(loops.over(places, energies), axis=0), [9])
    energy, sums = products.reshape(3, 3)[combined, combined], sums[combined]
    scale = 1 / np.sqrt(np.maximum(np.diag(energy), np.finfo(float).tiny))
    # Compute a least-squares solution, since the three fields may be linearly dependent.
    eigenvalues, vectors = np.linalg.eigh(scale[:, None] * energy * scale)
    independent = eigenvalues > _DEPENDENT * eigenvalues[-1]
    vectors = vectors[:, independent]
    solution = scale * (vectors @ ((scale * sums) @ vectors / eigenvalues[independent]))
    # q ≈ a P + b P' + c q', with the pressure P' and the tangent q' of the last contact.
    a, b, c = weights = *solution, *[0.0] * (3 - solution.size)
    tangent, tangent_gap = (field_to_fill(pressure.size, pressure.dtype, inner) for _ in range(2))
    shift = a * depth + b * last_depth + c - 1

    def combine(i: int, j: int) -> None:
        kernels.combine(
            weights=weights,
            shift=shift,
            tangent=tangent[inner][i:j],
            tangent_gap=tangent_gap[inner][i:j],
            pressure=pressure[inner][i:j],
            gap_change=change.values[inner][i:j],
            last_pressure=last_pressure[inner][i:j],
            last_gap_change=last_change[inner][i:j],
            last_tangent=last_tangent[inner][i:j],
            last_tangent_gap=last_tangent_gap[inner][i:j],
        )

    loops.over(tangent[inner], combine)
    # Bound the rounding error of the combined e_q. If the new gap was predicted and not recomputed, its error contains
    # the errors of the last gap and of the last tangent gap, which partly cancel in the combination.
    depth_step = depth - last_depth
    added = change.rounding - last_rounding - depth_step * tangent_rounding
    if added >= 0:
        rounding = abs(a + b) * last_rounding + abs(a * depth_step + c) * tangent_rounding + abs(a) * added
    else:
        rounding = abs(a) * change.rounding + abs(b) * last_rounding + abs(c) * tangent_rounding
    return tangent, BoundedField(tangent_gap, rounding)


def solve_tangent(grid: GridWorkspace, contact_set: ContactSet, tangent: Array, tangent_gap: BoundedField) -> None:
    """Solve K q = 1 for the elements in contact, starting from a given q; change q and e_q = K q − 1 in place.

    K is the matrix of influence coefficients, q = dP/du the tangent of the pressures P, and e_q the residual.

    grid : GridWorkspace; no other iteration may use it at the same time
    contact_set : ContactSet
    tangent : q, flat field
    tangent_gap : values of e_q, and a bound on their rounding error, which is updated

    Raises ConvergenceError if the iteration takes more than max_iterations steps.
    """
    tolerance = min(_TANGENT_TOLERANCE, np.sqrt(grid.tolerance))
    accepted = max(_TANGENT_ROUNDING * grid.tolerance, grid.exact_rounding + grid.field_rounding)
    search = begin_search(grid, contact_set)
    for _ in range(grid.options.max_iterations):
        largest = grid.gather(tangent_gap.values, contact_set)
        precondition(grid, search)
        # If q solves K q = 1 only up to the residual e_q = K q − 1, the corrected sum Σq − qᵀ e_q has the error
        # e_qᵀ K⁻¹ e_q. With the preconditioner M ≈ K⁻¹, this is at most e_qᵀ M e_q / LEAST_EIGENVALUE.
        total = grid.loops.total(tangent, contact_set.places)
        error = np.sqrt(residual_energy(grid, search) / (LEAST_EIGENVALUE * total)) if total > 0 else np.inf
        if error <= tolerance:
            if tangent_gap.rounding <= accepted:
                return
            grid.recompute_gap(tangent, 1, tangent_gap)
            search = begin_search(grid, contact_set)
            continue
        next_direction(grid, search)
        tangent_gap.rounding += grid.step_rounding * largest + grid.field_rounding
        conjugate_step(grid, search, tangent, tangent_gap.values)
    raise grid.not_converged(contact_set, error, tolerance)
