"""Precondition the iterations on a grid by a sparse approximate inverse with a multilevel coarse correction.

A preconditioner M of the influence matrix K has the methods `prepare` (for a set of elements in contact) and `apply`.
The iterations rely on three properties of M:

1. The eigenvalues of M K are near 1, so steps of length 1 converge.
2. No eigenvalue of M K is below `LEAST_EIGENVALUE`. This gives bounds on errors.
3. The product of M with a vector of ones is approximately the pressure of a flat punch at unit depth.

M is symmetric, and does not depend on the number of threads. Finite values of a residual outside the contact set have
no effect. A result may be overwritten by the next call. Release steps are slightly longer than 1, so no eigenvalue of
M K may exceed 1.8.

The rest of the solver imports only the names below. Another preconditioner therefore changes only this package, its
tests, its layers in pyproject.toml, and docs/solver.md.
"""

from viscorough.contact.preconditioner.multilevel import LEAST_EIGENVALUE, Preconditioner

__all__ = ["LEAST_EIGENVALUE", "Preconditioner"]
