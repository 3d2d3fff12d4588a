"""Iterate for the tangent q, the solution of K q = 1 on a contact set, by preconditioned conjugate gradients."""

import numpy as np

from viscorough.basics.types import Array
from viscorough.contact.grid.workspace import GridWorkspace
from viscorough.contact.preconditioner import LEAST_EIGENVALUE
from viscorough.contact.state import BoundedField, ContactSet

# Largest relative error of the tangent q in the energy norm, where q = dP/du solves K q = 1 on the contact set. The
# square of this error is the relative error of the stiffness.
_TANGENT_TOLERANCE = 1e-2
# Largest accepted rounding error of the residual e_q = K q − 1, as a multiple of the tolerance of the contact. The
# error of the stiffness nevertheless stays within the tolerance, because it depends on the mean of e_q over the contact
# set, not on the largest e_q (tests/viscorough/contact/test_loading_path.py).
_TANGENT_ROUNDING = 5.0


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
    search = grid.conjugate_gradients(contact_set)
    for _ in range(grid.options.max_iterations):
        largest = grid.gather(tangent_gap.values, contact_set)
        residual = search.precondition(grid.residual)
        # If q solves K q = 1 only up to the residual e_q = K q − 1, the corrected sum Σq − qᵀ e_q has the error
        # e_qᵀ K⁻¹ e_q. With the preconditioner M ≈ K⁻¹, this is at most e_qᵀ M e_q / LEAST_EIGENVALUE.
        total = grid.loops.total(tangent, contact_set.places)
        error = np.sqrt(residual.energy() / (LEAST_EIGENVALUE * total)) if total > 0 else np.inf
        if error <= tolerance:
            if tangent_gap.rounding <= accepted:
                return
            grid.recompute_gap(tangent, 1, tangent_gap)
            search = grid.conjugate_gradients(contact_set)
            continue
        direction = search.next_direction(residual)
        tangent_gap.rounding += grid.step_rounding * largest + grid.field_rounding
        direction.step(tangent, tangent_gap.values)
    raise grid.not_converged(contact_set, error, tolerance)
