"""Adjust the depth of a contact to a given force while its pressures are iterated.

With the preconditioner M ≈ K⁻¹ a full step leads to the pressures P − M e, and a change Δu of the depth adds Δu M 1 to
them. Before every step the depth is changed so that these pressures sum to the force: residual and depth converge
together, so a contact at a force takes few more iterations than a contact at a depth.
"""

import numpy as np

from viscorough.basics.types import Array, Integers
from viscorough.contact.grid.conjugate_gradients import ConjugateGradients, PreconditionedResidual
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.state import BoundedField, TargetForce

# Largest ratio of depths in one iteration.
_LARGEST_RATIO = 2.0
# The force counts as met within this distance of the depth, over the largest residual: the tangent corrects the rest.
_ACCURACY = 0.2
# Σq of a single square element, used until a set is prepared: no contact has a smaller Σq.
_LEAST_STIFFNESS = 0.28


class DepthAdjustment:
    """Adjusts the depth of a contact to a TargetForce.

    size : size of flat fields
    loops : GridLoops
    """

    def __init__(self, target: TargetForce, size: int, loops: GridLoops) -> None:
        self._target, self._loops = target, loops
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
        missing = self._target.pressure_sum - self._loops.total(pressure, places)
        return abs(missing) <= _ACCURACY * limit * self._stiffness or (
            missing > 0 and depth >= self._target.largest_depth
        )

    def adjust_depth(
        self, residual: PreconditionedResidual, pressure: Array, change: BoundedField, depth: float
    ) -> float:
        """Change the depth, and the residual and e − g in place; return the depth.

        change : BoundedField of e − g
        """
        largest_depth = self._target.largest_depth
        predicted = self._loops.total(pressure, self._places) - residual.total_preconditioned()
        next_depth = depth + (self._target.pressure_sum - predicted) / self._stiffness
        next_depth = min(max(next_depth, depth / _LARGEST_RATIO), depth * _LARGEST_RATIO, largest_depth)
        step = change.values.dtype.type(next_depth - depth)
        change.values -= step
        residual.shift(step, self._response)
        return min(depth + float(step), largest_depth)
