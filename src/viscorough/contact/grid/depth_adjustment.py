"""Find the depth of a contact under a given force while its pressures are iterated.

With the preconditioner M ≈ K⁻¹ a full step leads to the pressures P − M e, and a change Δu of the depth adds Δu M 1 to
them. Before every step the depth is changed so that these pressures sum to the force: residual and depth converge
together, so a contact at a force takes few more iterations than a contact at a depth.
"""

import numpy as np

from viscorough.contact.grid.conjugate_gradients import ConjugateGradients
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.state import BoundedField
from viscorough.types import Array, Integers

# Largest ratio of depths in one iteration.
_LARGEST_RATIO = 2.0
# Distance of the depth, over the largest residual, at which the force counts as met: the tangent corrects the rest.
_ACCURACY = 0.2
# Σq of a single square element, used before a set is known: no contact has a smaller Σq.
_LEAST_STIFFNESS = 0.28


class PrescribedForce:
    """ΣP to be reached at a reduced depth up to the largest; at the largest depth a smaller sum is accepted.

    size : size of flat fields; loops : GridLoops
    """

    def __init__(self, pressure_sum: float, largest_depth: float, size: int, loops: GridLoops) -> None:
        self._pressure_sum, self._largest_depth, self._loops = pressure_sum, largest_depth, loops
        self._ones = np.ones(size, np.float32)
        self._stiffness = _LEAST_STIFFNESS

    def prepare(self, search: ConjugateGradients, places: Integers) -> None:
        """Prepare for another contact set, the set of the ConjugateGradients.

        places : places of its elements in flat fields
        """
        self._places, self._response = places, search.uniform_response(self._ones)
        self._stiffness = float(self._response.sum(dtype=float))

    def is_met(self, pressure: Array, places: Integers, depth: float, limit: float) -> bool:
        """Return True if the pressures at these places sum to the force, or would do so only above the largest depth.

        limit : largest residual
        """
        missing = self._pressure_sum - self._loops.total(pressure, places)
        return abs(missing) <= _ACCURACY * limit * self._stiffness or (missing > 0 and depth >= self._largest_depth)

    def adjust_depth(self, search: ConjugateGradients, pressure: Array, change: BoundedField, depth: float) -> float:
        """Change the depth, and the residuals in place; return the depth.

        search : ConjugateGradients, with the residual preconditioned; change : BoundedField of e − g
        """
        predicted = self._loops.total(pressure, self._places) - search.total_preconditioned()
        wanted = depth + (self._pressure_sum - predicted) / self._stiffness
        wanted = min(max(wanted, depth / _LARGEST_RATIO), depth * _LARGEST_RATIO, self._largest_depth)
        step = change.values.dtype.type(wanted - depth)
        change.values -= step
        search.shift(step, self._response)
        return min(depth + float(step), self._largest_depth)
