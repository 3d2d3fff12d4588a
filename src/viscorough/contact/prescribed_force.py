"""Find contacts at prescribed forces with as few solved depths as possible.

The force is a convex function F(u) of the depth, and the contact solver gives F and its exact tangent k at any depth.
The search therefore needs few contacts:

1. For a large map, estimate the depth on a map of the highest points of its blocks, solved in the same way.
2. If there is no estimate, follow contact events. While few elements touch, they end at the force, which is exact.
3. Otherwise guess the depth from a power law through the last contact. On a grid, the depth is then adjusted while the
   contact is solved (grid.depth_adjustment).
4. If the force is not met yet, bracket it. The next depth lies between the nearest contacts below and above the force:
   on the interpolant of a loading curve, or at the intersection with the tangents.
5. Extrapolate the last, small difference along the tangent.
"""

from dataclasses import replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Array, Progress
from viscorough.contact.dense import ROUNDING
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.state import ContactState, DenseContact, Elements, MemberLoads, TargetForce
from viscorough.contact.step_control import ContactsAhead, Level, interpolate
from viscorough.surfaces.indenter import Indenter

# Largest ratio of successive depths before the force is exceeded.
_MAX_DEPTH_RATIO = 4.0
# A guessed depth may be too small by its ratio to the last depth, raised to this power; boxes allow for no more.
_UNCERTAINTY = 0.2
# Follow contact events up to this number of elements in contact.
_EVENTS = 200
# From this number of elements in contact on, the power law is trusted over larger ratios of depths.
_REPRESENTATIVE = 100
# Avoids a division by zero for two contacts at one depth.
_TINY = 1e-300
# Side of a block in elements.
_SIDE = 4
# Tolerance on the map of blocks.
_COARSE_TOLERANCE = 1e-2
# Estimate the depth on a map of blocks only for at least this multiple of the last force.
_FAR = 4.0
# The depth of the map exceeds the depth of the blocks by a share of c over the square root of the number of blocks in
# contact. These are a small, likely and large excess c (self-affine maps had 0.6 to 3).
_EXCESS = 0.6, 1.2, 2.5
# If the excess c was measured on the next coarser map, the three values are these multiples of it (the c of the map was
# 0.9 to 1.6 times as large).
_GROWTH_OF_EXCESS = 0.8, 1.1, 1.6
# Replace a measured excess below this value by it.
_LEAST_EXCESS = 0.3
# Deflection of the centre of a square under a uniform pressure, over P.
_OWN_DEFLECTION = 4 * np.arcsinh(1.0)


def _highest_in_blocks(indenter: Indenter) -> Indenter:
    """Return the indenter of the highest points of blocks of elements, which is nowhere lower."""
    heights = _largest_in_blocks(np.ascontiguousarray(indenter.heights))
    return Indenter(heights, _SIDE * indenter.spacing, _SIDE * indenter.row_spacing)


@njit
def _largest_in_blocks(heights):
    """Return the largest height in each block of _SIDE x _SIDE elements, nan for a block without elements."""
    rows, columns = heights.shape
    largest = np.empty((-(-rows // _SIDE), -(-columns // _SIDE)), heights.dtype)
    in_columns = np.empty(_SIDE * largest.shape[1], heights.dtype)
    for i in range(largest.shape[0]):
        in_columns[:] = -np.inf
        for row in heights[_SIDE * i : _SIDE * (i + 1)]:
            for j in range(columns):  # nan is larger than nothing
                in_columns[j] = row[j] if row[j] > in_columns[j] else in_columns[j]
        for k in range(largest.shape[1]):
            value = in_columns[_SIDE * k]
            for j in range(1, _SIDE):
                value = max(value, in_columns[_SIDE * k + j])
            largest[i, k] = value if value > -np.inf else np.nan
    return largest


def _loads_in_blocks(elements: Elements, pressure: Array) -> MemberLoads:
    """Divide the loads of blocks among their elements.

    pressure : P of blocks, in reduced units of the elements, shape of the map of blocks

    An element is loaded if its distance below the highest element of its block is at most the block's own deflection.
    The loads follow the ellipse of pressures of a Hertzian contact.
    """
    row, column = elements.places_on_map()
    block = row // _SIDE * pressure.shape[1] + column // _SIDE
    members = np.flatnonzero(pressure.ravel()[block])
    block, gap = block[members], elements.initial_gap[members]
    highest = np.empty(pressure.size)
    highest[block[::-1]] = gap[::-1]  # the highest element of a block, the first by rank, is written last
    pressure = pressure.ravel()[block]
    share = np.sqrt(np.maximum(highest[block] + _OWN_DEFLECTION * pressure - gap, 0))
    loads = _SIDE * pressure * share / np.bincount(block, share)[block]
    is_loaded = share > 0
    return MemberLoads(members[is_loaded], loads[is_loaded], np.zeros(np.count_nonzero(is_loaded)))


class _Guess(NamedTuple):
    """The contact to solve next in the search for a force.

    depth : reduced depth, likely for the force
    target : TargetForce with the largest likely depth; None solves the contact at `depth` exactly
    loads : MemberLoads of the likely contact; None if only the contacts solved before are available
    """

    depth: float
    target: TargetForce | None
    loads: MemberLoads | None = None


class _BlockDepth(NamedTuple):
    """Depth of a contact of blocks at a force; it gives an estimate of the depth of the elements.

    depth : in reduced units of the elements
    share : number of blocks in contact to the power −1/2; the excess of the depth is proportional to it
    """

    depth: float
    share: float


class ForceSearch:
    """Contacts of one ContactSolver at increasing forces; works in reduced units.

    Its contacts bracket the force: `_below` is the nearest contact solved at most at the force, or the unloaded one,
    and `_above` holds contacts beyond the force.
    """

    def __init__(self, solver: ContactSolver) -> None:
        self._solver = solver
        self._below: ContactState = solver.unloaded_state()
        self._above = ContactsAhead()
        # Follow contact events up to this number of elements; the event of the last element may lie beyond the force.
        dense = solver.options.dense_contacts, solver.options.dense_interactions
        self._events = int(min(_EVENTS, *dense, solver.elements.count - 1))
        self._block_depth: _BlockDepth | None = None  # of the last estimate

    @cached_property
    def _first(self) -> ContactState:
        """Return the first contact, for which dense solutions tabulate influence coefficients for the whole map."""
        return self._solver.first_contact()

    def contact_at(self, force: float, progress: Progress = lambda share: None) -> ContactState:
        """Solve the contact at F/G [length²], a larger force than at the last call.

        ΣP belongs to the force, and the pressures sum to it. At the depth, the tangent from the nearest solved contact
        reaches the force; over this distance the stiffness changes by less than the tolerance.
        progress : function called after each contact with the reached share of the force, up to 1
        Raises ConvergenceError if a contact cannot be solved to the tolerance, ValueError for a force too large
        to represent.
        """
        target = force / self._solver.units.force
        while self._above and self._above[-1].pressure_sum <= target:
            self._below = self._above.pop()
        guess = self._estimate(target)
        for attempt in range(self._solver.options.max_depths):
            if guess is None:
                if contact := self._exact_contact(target, attempt):
                    return contact
                guess = self._guess(target, attempt)
            contact = self._solver.advance_reduced(self._below, guess.depth, guess.target, guess.loads)
            guess = None
            progress(1.0 if self._above else min(1.0, contact.pressure_sum / target))
            other = self._above[-1] if self._above else self._below
            self._tighten_bracket(contact, target)
            if self._is_near(contact, other, target):
                depth = contact.reduced_depth + (target - contact.pressure_sum) / contact.tangent_sum
                settled = self._solver.settled(contact, depth, target)
                if settled.residual <= 2 * self._solver.tolerance:
                    return settled
        most = self._solver.options.max_depths
        raise ConvergenceError(
            f"contact at F/G = {force:g}: the force is not met within {most} depths; choose a larger tolerance"
        )

    def _tighten_bracket(self, contact: ContactState, target: float) -> None:
        """Let a contact replace the contact below the force, or add it to the contacts above."""
        if contact.pressure_sum <= target:
            self._below = contact
        else:
            self._above.keep(contact)

    def _exact_contact(self, target: float, attempt: int) -> ContactState | None:
        """Return the contact at a force if the straight start of the curve or the contact events lead to it."""
        is_start = attempt == 0 or not self._below.count
        if is_start and (target <= self._first.pressure_sum or self._solver.is_flat):
            # Only the highest elements are in contact: the curve is straight.
            depth = self._first.reduced_depth * (target / self._first.pressure_sum)
            contact = self._solver.advance_reduced(self._solver.unloaded_state(), depth)
            return self._solver.settled(contact, depth, target)
        if self._below.count and self._above:
            return None
        return self._follow_events(target)

    def _estimate(self, target: float) -> _Guess | None:
        """Guess the contact at a force from a map of blocks, if that helps.

        An indenter that is nowhere lower carries the same force at a smaller depth. The map of blocks therefore
        estimates the depth from below.
        """
        solver, below = self._solver, self._below
        is_near = bool(self._above) or target < _FAR * below.pressure_sum or below.count == solver.elements.count
        if solver.elements.count <= solver.options.blocks_from or is_near or solver.is_flat:
            return None
        blocks = _highest_in_blocks(solver.indenter)
        coarse = ContactSolver(blocks, _COARSE_TOLERANCE, solver.options, solver.threads, whole=False)
        try:
            search = ForceSearch(coarse)
            contact = search.contact_at(target * solver.units.force)
        except (ConvergenceError, ValueError):  # the highest points may have one height to rounding
            return None
        unit = coarse.units.length / solver.units.length
        measured = _BlockDepth(unit * contact.reduced_depth, contact.count**-0.5)
        least, likely, largest = (measured.depth * (1 + c * measured.share) for c in search._excess_bounds(contact))
        solver.ranking.rank_up_to(largest)  # the first contact then ranks no further elements
        if contact.count < solver.options.blocks_in_contact or least <= below.reduced_depth:
            return None
        self._block_depth = measured
        block_loads, pressure = contact.member_loads(), np.zeros(blocks.heights.shape)
        pressure[coarse.elements.places_on_map(block_loads.members)] = unit * block_loads.pressure
        largest = solver.depth_of_box(least, largest)
        loads = _loads_in_blocks(solver.elements, pressure)
        return _Guess(min(likely, largest), TargetForce(target, largest), loads)

    def _excess_bounds(self, contact: ContactState) -> tuple[float, ...]:
        """Return a small, likely and large excess c for the indenter whose blocks this search solves.

        contact : contact that this search has found last
        """
        if self._block_depth is None:
            return _EXCESS
        measured = (contact.reduced_depth / self._block_depth.depth - 1) / self._block_depth.share
        excess = max(measured, _LEAST_EXCESS)
        return tuple(growth * excess for growth in _GROWTH_OF_EXCESS)

    def _follow_events(self, target: float) -> ContactState | None:
        """Follow the contact events up to a force, while few elements are in contact.

        Returns the contact at the force if no further element touches before it: the pressures grow at their tangent.
        """
        start = self._below = self._below if self._below.count else self._first
        if not isinstance(start, DenseContact) or start.count >= self._events:
            return None
        _, below, ends_at_force = self._solver.follow_events(start, self._events, target)
        self._below, loads = below, below.loads
        depth = below.reduced_depth + (target - below.pressure_sum) / below.tangent_sum
        if not ends_at_force or depth > self._solver.elements.ranked_depth:
            return None
        # An element that touches at this force has no pressure: rounding must not put it under tension.
        pressure = np.maximum(loads.pressure + (depth - below.reduced_depth) * loads.tangent, 0.0)
        return replace(below, reduced_depth=depth, pressure_sum=target, loads=loads._replace(pressure=pressure))

    def _guess(self, target: float, attempt: int) -> _Guess:
        """Guess the contact at a force from the contacts solved; within a bracket, its depth is solved as it is."""
        depth = self._next_depth(target, attempt)
        if self._above:
            return _Guess(depth, None)
        largest = depth * (depth / self._below.reduced_depth) ** _UNCERTAINTY
        self._solver.ranking.rank_up_to(largest)
        return _Guess(depth, TargetForce(target, self._solver.depth_of_box(depth, largest)))

    def _next_depth(self, target: float, attempt: int) -> float:
        """Return the depth to solve next, between the nearest contacts below and above the force."""
        below = Level.of(self._below)
        by_tangent = below.depth + (target - below.pressure_sum) / below.tangent_sum
        if below.count == self._solver.elements.count:
            return by_tangent
        if not self._above:
            # Use the power law through the last contact; its exponent grows as the contact grows.
            exponent = below.pressure_sum / (below.tangent_sum * below.depth)
            ratio = (target / below.pressure_sum) ** exponent
            return below.depth * (ratio if below.count >= _REPRESENTATIVE else min(ratio, _MAX_DEPTH_RATIO))
        above = Level.of(self._above[-1])
        if attempt % 2:  # converges for any convex curve
            depth = min(by_tangent, above.depth - (above.pressure_sum - target) / above.tangent_sum)
        else:
            depth = interpolate(below, above, np.array([target]))[0]
        # Both contacts are only as exact as the tolerance. If they are too close, the tangent gives the next depth.
        return float(min(depth, above.depth) if depth > below.depth else by_tangent)

    def _is_near(self, contact: ContactState, other: ContactState, target: float) -> bool:
        """Return True if the tangent of a contact leads to the force: the stiffness changes by less than the tolerance.

        other : a second contact, which gives the change of the stiffness with depth
        """
        distance = abs(target - contact.pressure_sum) / contact.tangent_sum
        if isinstance(contact, DenseContact):  # exact only at its own depth
            return distance <= ROUNDING * contact.reduced_depth
        width = max(abs(contact.reduced_depth - other.reduced_depth), _TINY)
        change = abs(contact.tangent_sum - other.tangent_sum) / width * distance
        return change <= self._solver.tolerance * contact.tangent_sum
