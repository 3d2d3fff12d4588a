"""Find contacts at prescribed forces with as few solved depths as possible.

The force is a convex function F(u) of the depth u, and the contact solver gives F and its exact slope k at any depth.
The search for the depth therefore needs few contacts:

1. On a large map, estimate the depth from a coarser map that consists of the highest point of every block of 4 x 4
   elements. The contact of this coarser map is found by the same search.
2. Without an estimate, compute contact events, the depths where the next elements touch, as long as few elements touch.
   If the force is reached between two events, the contact is exact.
3. Otherwise guess the depth from a power law through the last contact. On a grid, the depth is then adjusted while the
   contact is solved (grid.iteration).
4. If the force is not met yet, bracket the force. The next depth lies between the nearest contacts below and above the
   force. It is found from the interpolated loading curve between these contacts, or from their tangents.
5. Extrapolate the small remaining difference in force along the tangent.
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

# As long as few elements touch and no solved contact has reached the force, the next depth is at most this multiple of
# the last depth.
_MAX_DEPTH_RATIO = 4.0
# The depth for a force may turn out larger than the guessed depth u. Depths up to u (u/u₀)^_UNCERTAINTY are allowed,
# where u₀ is the last depth. The box of the grid contains only elements that can touch up to the largest allowed depth.
_UNCERTAINTY = 0.2
# Contact events (the depths where elements touch) are computed up to this number of elements in contact.
_EVENTS = 200
# With at least this number of elements in contact, the depth for a force is extrapolated by a power law even beyond
# _MAX_DEPTH_RATIO times the last depth.
_REPRESENTATIVE = 100
# This number avoids a division by zero if two contacts have the same depth.
_TINY = 1e-300
# Number of elements along each side of a block. The coarser map contains only the highest element of each block.
_SIDE = 4
# Tolerance of contacts on the coarser map, in which a single element replaces each block of elements.
_COARSE_TOLERANCE = 1e-2
# A coarser map (with one element per block) is used to estimate the depth only if the force is at least this multiple
# of the force of the last contact.
_FAR = 4.0
# Let u be the depth at a force on the coarser map of blocks, and n the number of blocks in contact. The depth on the
# full map at the same force is u (1 + c/√n), with an unknown "excess" c. The constants are a small, a likely and a
# large value of c. On self-affine maps, c was 0.6 to 3.
_EXCESS = 0.6, 1.2, 2.5
# If the excess c has been measured between the coarser map and a still coarser map, the small, the likely and the large
# value of c are these multiples of the measured value. On self-affine maps, c was 0.9 to 1.6 times the measured value.
_GROWTH_OF_EXCESS = 0.8, 1.1, 1.6
# Lower limit of a measured excess c (see _EXCESS). Smaller values are replaced by the limit.
_LEAST_EXCESS = 0.3
# Deflection w/P at the centre of a square element under its own uniform pressure P, in reduced units.
_OWN_DEFLECTION = 4 * np.arcsinh(1.0)


def _highest_in_blocks(indenter: Indenter) -> Indenter:
    """Return an indenter with a single element for each block of elements, at the largest height in the block.

    The new indenter is nowhere lower than the given indenter.
    """
    heights = _largest_in_blocks(np.ascontiguousarray(indenter.heights))
    return Indenter(heights, _SIDE * indenter.spacing, _SIDE * indenter.row_spacing)


@njit
def _largest_in_blocks(heights):
    """Return the largest height in each block of _SIDE x _SIDE points, nan if all heights in the block are nan."""
    rows, columns = heights.shape
    largest = np.empty((-(-rows // _SIDE), -(-columns // _SIDE)), heights.dtype)
    in_columns = np.empty(_SIDE * largest.shape[1], heights.dtype)
    for i in range(largest.shape[0]):
        in_columns[:] = -np.inf
        for row in heights[_SIDE * i : _SIDE * (i + 1)]:
            for j in range(columns):  # nan is skipped, because a comparison with nan is false
                in_columns[j] = row[j] if row[j] > in_columns[j] else in_columns[j]
        for k in range(largest.shape[1]):
            value = in_columns[_SIDE * k]
            for j in range(1, _SIDE):
                value = max(value, in_columns[_SIDE * k + j])
            largest[i, k] = value if value > -np.inf else np.nan
    return largest


def _loads_in_blocks(elements: Elements, pressure: Array) -> MemberLoads:
    """Divide the load of every block among the elements of the block.

    Let w be the deflection of a block under its own pressure, and z the distance of an element below the highest
    element of the block. The element is loaded if z < w, in proportion to √(w − z), as in a Hertzian contact.

    elements : Elements; all elements that can be loaded must be ranked
    pressure : pressures P of the blocks in the reduced units of `elements`, in the shape of the coarser map of blocks
    """
    row, column = elements.places_on_map()
    block = row // _SIDE * pressure.shape[1] + column // _SIDE
    members = np.flatnonzero(pressure.ravel()[block])
    block, gap = block[members], elements.initial_gap[members]
    highest = np.empty(pressure.size)
    # Find the smallest gap in each block. Elements are sorted by increasing gap, and are written to `highest` in
    # reverse order, so the smallest gap of a block is written last and replaces the others.
    highest[block[::-1]] = gap[::-1]
    pressure = pressure.ravel()[block]
    share = np.sqrt(np.maximum(highest[block] + _OWN_DEFLECTION * pressure - gap, 0))
    loads = _SIDE * pressure * share / np.bincount(block, share)[block]
    is_loaded = share > 0
    return MemberLoads(members[is_loaded], loads[is_loaded], np.zeros(np.count_nonzero(is_loaded)))


class _Guess(NamedTuple):
    """Guess of the contact at a force, from which the next contact is solved.

    depth : likely reduced depth
    target : TargetForce if the depth is to be adjusted to the force while the contact is solved; None to solve the
        contact at exactly `depth`
    loads : likely loads of the contact; None if the iteration should start from a contact that was solved before
    """

    depth: float
    target: TargetForce | None
    loads: MemberLoads | None = None


class _BlockDepth(NamedTuple):
    """Depth at a force on the coarser map of blocks, from which the depth on the full map is estimated.

    depth : depth on the coarser map, in the reduced units of the full map
    share : 1/√n with the number n of blocks in contact. The estimated depth on the full map is depth · (1 + c share),
        with the excess c (see _EXCESS)
    """

    depth: float
    share: float


class ForceSearch:
    """Search for the contacts at increasing forces. A ContactSolver solves the contact at each trial depth.

    The class works in the reduced units of contact.state.

    The contacts solved so far bracket the requested force. `_below` is the solved contact with the largest force that
    does not exceed the requested force; at first it is the contact without load. `_above` contains solved contacts with
    larger forces.
    """

    def __init__(self, solver: ContactSolver) -> None:
        self._solver = solver
        self._below: ContactState = solver.unloaded_state()
        self._above = ContactsAhead()
        # Contact events are computed up to this number of elements in contact. It is below the number of all elements,
        # because the depth where the very last element touches may lie beyond the depth of the requested force.
        dense = solver.options.dense_contacts, solver.options.dense_interactions
        self._events = int(min(_EVENTS, *dense, solver.elements.count - 1))
        self._block_depth: _BlockDepth | None = None  # depth on the coarser map of blocks, from the last estimate

    @cached_property
    def _first(self) -> ContactState:
        """Return the contact at the end of the straight first part of the loading curve.

        The contact is computed only when needed, because it requires a table of influence coefficients for the whole
        map.
        """
        return self._solver.first_contact()

    def contact_at(self, force: float, progress: Progress = lambda share: None) -> ContactState:
        """Solve the contact at the force F/G [length²], which must be larger than in the previous call.

        The pressures of the contact add up to exactly this force. The contact is extrapolated along the tangent from
        the nearest solved contact, over such a small distance that the stiffness changes by less than the tolerance.

        progress : function that is called after each solved contact with the share of the force reached so far, up to 1

        Raises ConvergenceError if a contact cannot be solved to the tolerance, and ValueError for a force that is too
        large to represent.
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
                extrapolated = self._solver.extrapolate(contact, depth, target)
                if extrapolated.residual <= 2 * self._solver.tolerance:
                    return extrapolated
        most = self._solver.options.max_depths
        raise ConvergenceError(
            f"contact at F/G = {force:g}: the force is not met within {most} depths; choose a larger tolerance"
        )

    def _tighten_bracket(self, contact: ContactState, target: float) -> None:
        """Store a solved contact as the nearest contact below the force, or as the nearest contact above the force."""
        if contact.pressure_sum <= target:
            self._below = contact
        else:
            self._above.keep(contact)

    def _exact_contact(self, target: float, attempt: int) -> ContactState | None:
        """Return the contact at a force if it can be computed exactly, otherwise None.

        An exact contact can be computed on the straight first part of the loading curve, and between contact events.

        target : the force as the sum ΣP of reduced pressures
        attempt : number of depths that were already solved in the search for this force
        """
        is_start = attempt == 0 or not self._below.count
        if is_start and (target <= self._first.pressure_sum or self._solver.is_flat):
            # Only the highest elements are in contact: the curve is straight.
            depth = self._first.reduced_depth * (target / self._first.pressure_sum)
            contact = self._solver.advance_reduced(self._solver.unloaded_state(), depth)
            return self._solver.extrapolate(contact, depth, target)
        if self._below.count and self._above:
            return None
        return self._follow_events(target)

    def _estimate(self, target: float) -> _Guess | None:
        """Guess the contact at a force from the contact of a coarser map; return None if the guess would not help.

        The coarser map contains only the highest element of every block of elements. It is nowhere lower than the full
        map, so it carries the same force at a smaller depth, which is a lower bound.

        target : the force as the sum ΣP of reduced pressures
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
        except (ConvergenceError, ValueError):
            return None  # there is no estimate, for example, if all blocks have the same height within rounding
        unit = coarse.units.length / solver.units.length
        measured = _BlockDepth(unit * contact.reduced_depth, contact.count**-0.5)
        least, likely, largest = (measured.depth * (1 + c * measured.share) for c in search._excess_bounds(contact))
        solver.ranking.rank_up_to(largest)  # sort all elements that may touch, so that no sorting is needed later
        if contact.count < solver.options.blocks_in_contact or least <= below.reduced_depth:
            return None
        self._block_depth = measured
        block_loads, pressure = contact.member_loads(), np.zeros(blocks.heights.shape)
        pressure[coarse.elements.places_on_map(block_loads.members)] = unit * block_loads.pressure
        largest = solver.depth_of_box(least, largest)
        loads = _loads_in_blocks(solver.elements, pressure)
        return _Guess(min(likely, largest), TargetForce(target, largest), loads)

    def _excess_bounds(self, contact: ContactState) -> tuple[float, ...]:
        """Return a small, a likely and a large value of the excess c (see `_EXCESS`).

        Here `self` is the search for contacts on the coarser map of blocks. The returned values of c relate depths on
        this map to depths on the full map. If `self` has made an estimate on a still coarser map, the values follow
        from the error of the estimate. Otherwise they are `_EXCESS`.

        contact : last contact that the search has found
        """
        if self._block_depth is None:
            return _EXCESS
        measured = (contact.reduced_depth / self._block_depth.depth - 1) / self._block_depth.share
        excess = max(measured, _LEAST_EXCESS)
        return tuple(growth * excess for growth in _GROWTH_OF_EXCESS)

    def _follow_events(self, target: float) -> ContactState | None:
        """Compute contact events up to a force, while few elements are in contact.

        Returns the contact at the force, or None if the events end before the force. From the last event to the force
        the pressures P grow linearly with the depth, at the rate q = dP/du.

        target : the force as the sum ΣP of reduced pressures
        """
        start = self._below = self._below if self._below.count else self._first
        if not isinstance(start, DenseContact) or start.count >= self._events:
            return None
        _, below, ends_at_force = self._solver.follow_events(start, self._events, target)
        self._below, loads = below, below.loads
        depth = below.reduced_depth + (target - below.pressure_sum) / below.tangent_sum
        if not ends_at_force or depth > self._solver.elements.ranked_depth:
            return None
        # An element that begins to touch at exactly this force has no pressure. Rounding must not make its pressure
        # negative.
        pressure = np.maximum(loads.pressure + (depth - below.reduced_depth) * loads.tangent, 0.0)
        return replace(below, reduced_depth=depth, pressure_sum=target, loads=loads._replace(pressure=pressure))

    def _guess(self, target: float, attempt: int) -> _Guess:
        """Guess the depth at a force from the contacts solved before, and how the contact is to be solved next.

        If contacts with smaller and with larger forces have been solved, the next contact is solved at exactly the
        guessed depth. Otherwise the depth is adjusted to the force while the contact is solved.

        target : the force as the sum ΣP of reduced pressures
        attempt : number of depths that were already solved in the search for this force
        """
        depth = self._next_depth(target, attempt)
        if self._above:
            return _Guess(depth, None)
        largest = depth * (depth / self._below.reduced_depth) ** _UNCERTAINTY
        self._solver.ranking.rank_up_to(largest)
        return _Guess(depth, TargetForce(target, self._solver.depth_of_box(depth, largest)))

    def _next_depth(self, target: float, attempt: int) -> float:
        """Return the depth to solve next, between the nearest solved contacts below and above the force.

        If no contact above the force has been solved, the depth is extrapolated from the contact below the force.

        target : the force as the sum ΣP of reduced pressures
        attempt : number of depths that were already solved in the search for this force
        """
        below = Level.of(self._below)
        by_tangent = below.depth + (target - below.pressure_sum) / below.tangent_sum
        if below.count == self._solver.elements.count:
            return by_tangent
        if not self._above:
            # Assume u ∝ F^m for depth u and force F, with m = F/(k u) from the stiffness k of the last contact. The
            # exponent m grows as the contact grows.
            exponent = below.pressure_sum / (below.tangent_sum * below.depth)
            ratio = (target / below.pressure_sum) ** exponent
            return below.depth * (ratio if below.count >= _REPRESENTATIVE else min(ratio, _MAX_DEPTH_RATIO))
        above = Level.of(self._above[-1])
        if attempt % 2:  # use the tangents in every second attempt: this method converges for any convex curve
            depth = min(by_tangent, above.depth - (above.pressure_sum - target) / above.tangent_sum)
        else:
            depth = interpolate(below, above, np.array([target]))[0]
        # The contacts below and above the force are only as accurate as the tolerance. If they are so close together
        # that no depth lies between them, follow the tangent of the contact below to the force.
        return float(min(depth, above.depth) if depth > below.depth else by_tangent)

    def _is_near(self, contact: ContactState, other: ContactState, target: float) -> bool:
        """Return True if a contact is so near to the force that it can be extrapolated along its tangent.

        Between the contact and the force, the stiffness must change relatively by less than the tolerance.

        other : second contact, used to estimate the change of the stiffness with depth
        """
        distance = abs(target - contact.pressure_sum) / contact.tangent_sum
        if isinstance(contact, DenseContact):  # `extrapolate` moves no DenseContact to another depth
            return distance <= ROUNDING * contact.reduced_depth
        width = max(abs(contact.reduced_depth - other.reduced_depth), _TINY)
        change = abs(contact.tangent_sum - other.tangent_sum) / width * distance
        return change <= self._solver.tolerance * contact.tangent_sum
