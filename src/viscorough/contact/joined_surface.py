"""Find the depth of complete contact, where all elements touch, from two linear problems.

First let all elements be joined to the surface, so that they also transmit tension. Their pressures are then

    P = u q − s,    K q = 1,    K s = g

Here P is a pressure expressed as a length, u the depth, g the initial gap of an element, and K the matrix of influence
coefficients (see contact.state).
At the depth u = max(s/q) the last tension vanishes. From this depth on, the frictionless contact is therefore complete,
and its loading curve is straight: ΣP = Σq (u − ⟨g⟩_q), where ⟨g⟩_q = Σs/Σq is the mean of g with the weights q.
"""

from typing import NamedTuple

import numpy as np

from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Array
from viscorough.contact.border import BORDER
from viscorough.contact.halfspace.operator import Halfspace
from viscorough.contact.preconditioner import Preconditioner
from viscorough.contact.state import DenseContact, Elements, MemberLoads, Units

# K q = 1 and K s = g are solved at best to this relative residual: the norm of the residual divided by the norm of the
# right-hand side.
EXACT = 1e-12
# Largest number of iterations. ConvergenceError is raised if these do not suffice.
_MAX_ITERATIONS = 500


class JoinedSurface(NamedTuple):
    """Solutions of K q = 1 and K s = g, if all elements of an indenter are joined to the surface (see the module).

    Lengths are in the reduced units of contact.state. Arrays are in the order of increasing initial gap.

    tangent : q, the increase of the pressures P with the depth, shape (elements,)
    load : s, the tensions at depth 0, shape (elements,)
    initial_gap : g, shape (elements,)
    residual : bound on the norm of the residual divided by the norm of the right-hand side, for both problems
    """

    tangent: Array
    load: Array
    initial_gap: Array
    residual: float

    @property
    def depth(self) -> float:
        """Return the smallest depth u of complete contact."""
        return float((self.load / self.tangent).max())

    @property
    def mean_gap(self) -> float:
        """Return the mean ⟨g⟩_q of the initial gap with the weights q."""
        return float(self.load.sum() / self.tangent.sum())

    def first_contact_of_all(self, units: Units) -> DenseContact:
        """Return the contact at the depth where contact becomes complete, with pressures P and tangents q.

        units : Units of the reduced quantities
        """
        depth, stiffness = self.depth, float(self.tangent.sum())
        # Without this limit, the element that touches last could have a negative pressure due to rounding.
        pressure = np.maximum(depth * self.tangent - self.load, 0.0)
        # The residual of K P = u − g has at most the norm self.residual * size. The residual at a single element does
        # not exceed this norm.
        size = depth * self.tangent.size**0.5 + float(np.linalg.norm(self.initial_gap))
        return DenseContact(
            units,
            depth,
            self.tangent.size,
            pressure_sum=stiffness * (depth - self.mean_gap),
            tangent_sum=stiffness,
            residual=self.residual * size / depth,
            loads=MemberLoads(np.arange(self.tangent.size), pressure, self.tangent),
        )


def joined_surface(
    elements: Elements, *, residual: float = EXACT, padding: bool = True, threads: int = 1
) -> JoinedSurface:
    """Solve K q = 1 and K s = g for all elements by preconditioned conjugate gradients, in double precision.

    elements : Elements, all of which must be ranked
    residual : the iterations stop when the norm of the residual falls below this share of the norm of the right-hand
        side
    padding : see SolverOptions
    threads : number of threads

    Raises ConvergenceError if a residual does not fall below this limit.
    """
    from scipy.sparse.linalg import LinearOperator, cg  # imported here, because this import takes long

    rows, columns = elements.shape
    height, width = rows + 2 * BORDER, columns + 2 * BORDER
    halfspace = Halfspace(rows, columns, aspect=elements.aspect, padding=padding, threads=threads)
    preconditioner = Preconditioner(height, width, aspect=elements.aspect, threads=threads)
    on_map, stride = halfspace.load.ravel(), halfspace.load.shape[1]
    slot = elements.row.astype(np.int64) * stride + elements.column
    place = (elements.row.astype(np.int64) + BORDER) * width + elements.column + BORDER
    inside, field = np.zeros(height * width, dtype=bool), np.zeros(height * width, dtype=np.float32)
    inside[place] = True
    preconditioner.prepare(inside, place.size)

    def deflection(load: Array) -> Array:
        on_map[slot] = load
        return halfspace.apply().ravel()[slot]

    def precondition(gap: Array) -> Array:
        # Divide by the largest value, so that small values do not underflow in single precision.
        scale = np.abs(gap).max() or 1.0
        field[place] = gap / scale
        return scale * preconditioner.apply(field)[place].astype(float)

    shape = place.size, place.size
    influence, inverse = (LinearOperator(shape, function, dtype=float) for function in (deflection, precondition))
    solutions = []
    for right in (np.ones(place.size), elements.initial_gap):
        solution, failed = cg(influence, right, rtol=residual, maxiter=_MAX_ITERATIONS, M=inverse)
        if failed:
            raise ConvergenceError(
                f"complete contact: the residual does not fall below {residual:.0e} in {_MAX_ITERATIONS} steps"
            )
        solutions.append(solution)
    tangent, load = solutions
    return JoinedSurface(tangent, load, elements.initial_gap, residual)
