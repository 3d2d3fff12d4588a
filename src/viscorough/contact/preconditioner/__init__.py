"""Precondition the iterations on a grid by a sparse approximate inverse with a multilevel coarse correction.

A preconditioner M of the influence matrix K has the methods `prepare` (for a set of elements in contact) and `apply`.
The iterations rely on three properties: the eigenvalues of M K are near 1, so that steps of length 1 converge; none of
them is below `LEAST_EIGENVALUE`, which bounds errors; and M applied to 1 is about the pressure of a flat punch. The
rest of the solver imports only the names below. Another preconditioner therefore changes only this package and its
tests.
"""

from viscorough.contact.preconditioner.multilevel import BYTES_PER_PLACE, LEAST_EIGENVALUE, Preconditioner

__all__ = ["BYTES_PER_PLACE", "LEAST_EIGENVALUE", "Preconditioner"]
