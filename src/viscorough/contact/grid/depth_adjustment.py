"""Adjust the depth of a contact to a given force while its pressures are iterated.

With the preconditioner M ≈ K⁻¹, a step of length 1 changes the pressures to P − M e. If the depth also grows by Δu, the
product Δu M 1, with a vector 1 of ones, is added to these pressures. Before every step Δu is chosen so that the
pressures after the step sum to the force. The residual and the depth then converge together, and a contact at a given
force takes few more iterations than a contact at a given depth. Symbols are defined in contact.state.
"""

import numpy as np

from viscorough.basics.types import Array, Integers
from viscorough.contact.grid.conjugate_gradients import ConjugateGradients, PreconditionedResidual
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.state import BoundedField, TargetForce

# Largest factor by which the depth grows or shrinks in one iteration.
_LARGEST_RATIO = 2.0
# The target force counts as met if the depth is wrong by at most this share of the largest gap |e| that is allowed at
# elements in contact. The remaining error is corrected along the tangent.
_ACCURACY = 0.2
# Reduced stiffness, the sum of q = dP/du, of a single square element in contact. This smallest possible value is used
# until `prepare` computes an estimate for the contact set.
_LEAST_STIFFNESS = 0.28


class DepthAdjustment:
    """Adjustment of the depth of a contact to a given force.

    target : TargetForce with the force and the largest allowed depth
    size : number of entries of a flat field
    loops : GridLoops that run the loops over the contact set
    """

    def __init__(self, target: TargetForce, size: int, loops: GridLoops) -> None:
        self._target, self._loops = target, loops
        self._ones = np.ones(size, np.float32)
        self._stiffness = _LEAST_STIFFNESS

    def prepare(self, search: ConjugateGradients, places: Integers) -> None:
        """Estimate the tangents q = dP/du and the stiffness Σq for a new contact set, with the preconditioner M.

        search : ConjugateGradients with M, on the new contact set
        places : indices of the elements of the contact set in flat fields
        """
        self._places, self._response = places, search.uniform_response(self._ones)
        self._stiffness = float(self._response.sum(dtype=float))

    def is_met(self, pressure: Array, places: Integers, depth: float, limit: float) -> bool:
        """Return True if the pressures sum to the target force, or to less at the largest allowed depth.

        pressure : P, flat field
        places : indices of the elements in contact in flat fields
        depth : reduced depth u
        limit : largest gap |e| that is allowed at elements in contact. The force counts as met if a change of the
            depth by at most _ACCURACY · limit would correct the sum
        """
        missing = self._target.pressure_sum - self._loops.total(pressure, places)
        return abs(missing) <= _ACCURACY * limit * self._stiffness or (
            missing > 0 and depth >= self._target.largest_depth
        )

    def adjust_depth(
        self, residual: PreconditionedResidual, pressure: Array, change: BoundedField, depth: float
    ) -> float:
        """Change the depth so that the pressures after a step of length 1 sum to the force; return the new depth.

        residual : PreconditionedResidual, which is changed in place for the new depth
        pressure : P, flat field
        change : change e − g of every gap since first contact, changed in place for the new depth
        depth : reduced depth u before the change
        """
        largest_depth = self._target.largest_depth
        predicted = self._loops.total(pressure, self._places) - residual.total_preconditioned()
        next_depth = depth + (self._target.pressure_sum - predicted) / self._stiffness
        next_depth = min(max(next_depth, depth / _LARGEST_RATIO), depth * _LARGEST_RATIO, largest_depth)
        step = change.values.dtype.type(next_depth - depth)
        change.values -= step
        residual.shift(step, self._response)
        return min(depth + float(step), largest_depth)
