"""Solve the frictionless contact of a rigid indenter at a prescribed depth, from the contact at a smaller depth.

A contact of few elements is solved densely, a larger contact on the grid of a box around the elements that can touch.

The half-space is elastic. Deflections are written w = K P with P = p d/(4πG), a length, so F/G = 4π d ΣP for elements
of area d² (symbols: contact.state). At depth u the contact satisfies P ≥ 0, e = w − u + g ≥ 0 and P e = 0, with g the
initial gap. With the tangent q, the solution of K q = 1 on the contact set (a flat punch of its shape), k/G = 4π d Σq
is the exact tangent stiffness and P + Δu q the predictor for the depth u + Δu.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from viscorough.basics.errors import ConvergenceError
from viscorough.contact import dense
from viscorough.contact.complete_contact import EXACT, joined_surface
from viscorough.contact.dense import ContactEvents
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.grid.memory_demand import require_for_box, require_for_complete_contact, require_for_contact
from viscorough.contact.grid.solver import GridSolver
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.ranking import Ranking
from viscorough.contact.state import (
    ContactState,
    DenseContact,
    Elements,
    GridContact,
    MemberLoads,
    TargetForce,
    Units,
    unloaded_contact,
)
from viscorough.surfaces.indenter import Indenter

# Allow for this multiple of the requested depth when a new box is set up: a smaller margin means more boxes, each of
# which costs two applications of the operator.
_BOX_DEPTH_MARGIN = 2.0
# Use the whole grid if the box would cover more than this share of it.
_LARGEST_BOX = 0.8
# Largest growth of the area of a box by an allowance for a larger depth.
_GROWTH_OF_BOX = 1.3
# Contact only grows with depth. Within the accuracy of the solution an element may leave it, with a gap up to this
# multiple of the tolerance times the depth; a larger gap is an error.
_LOST_CONTACT = 3
# Largest reduced depth: single precision has a range of at least a thousand times as much.
_LARGEST_DEPTH = 1e25
# Residual of the linear problems of complete contact, over the tolerance. The relative error of the depth is a few
# times this residual. The largest residual of an element is below it times the root of the number of elements.
_JOINED_SHARE = 1e-4
# A gap counts as open if it exceeds the residual by this factor, a margin for rounding.
_OPEN_GAP = 1.1
# Largest ratio of depths for a contact to be transferred to another grid as a start.
_LARGEST_RATIO_OF_START = 2.0


class ContactSolver:
    """Solver for the contact of one indenter at increasing depths, to a residual of `tolerance` times the depth.

    indenter : Indenter with two-dimensional heights
    tolerance : largest |e| in contact or overlap outside it, over the depth
    options : SolverOptions
    threads : number of threads for contacts on the grid
    largest_depth : the largest depth that will be requested; no grid allows for more [length]
    whole : True if the whole map will be in contact, so memory is checked for the whole map; otherwise it is checked
        for each box around the elements that can touch

    indenter, tolerance, options, threads : as they were given
    ranking : Ranking of the elements, which solutions extend as far as they need
    units : state.Units

    Raises MemoryError if the available memory does not suffice for the map.
    """

    def __init__(
        self,
        indenter: Indenter,
        tolerance: float,
        options: SolverOptions = DEFAULT,
        threads: int = 1,
        *,
        largest_depth: float = np.inf,
        whole: bool = True,
    ) -> None:
        self._memory_options: dict[str, Any] = {"exact": tolerance < options.exact_gap_below, "threads": threads}
        if whole:
            require_for_contact(indenter.heights, **self._memory_options)
        self.indenter, self.tolerance, self.options, self.threads = indenter, tolerance, options, threads
        self.ranking = Ranking(indenter, threads, options, largest_depth=largest_depth, whole=whole)
        self.units: Units = self.ranking.elements.units
        self._largest_depth = largest_depth / self.units.length
        self._loops = GridLoops(threads)
        self._grid: GridSolver | None = None  # of the current box; only `_grid_up_to` replaces it
        self._reach = 0  # elements, by rank, that the current box allows for
        self._former_applications = 0  # of the operators of former boxes

    @property
    def elements(self) -> Elements:
        """Return the Elements ranked so far."""
        return self.ranking.elements

    @property
    def is_flat(self) -> bool:
        """Return True if all elements have one height, so all touch at once."""
        return self.ranking.is_flat

    @property
    def operator_applications(self) -> int:
        """Return the number of applications of the half-space operator on the grid so far."""
        return self._former_applications + (self._grid.operator_applications if self._grid else 0)

    def unloaded_state(self) -> ContactState:
        """Return the contact at depth zero: no pressure, and no element in contact yet."""
        return unloaded_contact(self.units)

    def first_contact(self) -> ContactState:
        """Return the contact where the straight start of the curve ends: only the highest elements touch.

        Its depth is the smallest positive initial gap, or the side of an element for an indenter of one height.
        """
        self.ranking.rank_highest()
        gap = self.elements.initial_gap
        highest = np.searchsorted(gap, 0, side="right")
        depth = 1.0 if self.is_flat else gap[highest]
        if highest == 1 and self.options.dense_contacts:  # takes a tenth of the time of a solution
            return dense.solve_highest_element(self.elements, depth)
        return self.advance_reduced(self.unloaded_state(), depth)

    def settled(self, contact: ContactState, depth: float, pressure_sum: float) -> ContactState:
        """Extrapolate the contact along its tangent to a nearby depth, and rescale its pressures to the given sum.

        contact : the contact solved last
        depth, pressure_sum : u and ΣP, reduced; for a dense contact, the values of the contact

        Its residual may be up to twice the tolerance. It includes a bound on the overlap of elements outside the box of
        the grid: the depth beyond the initial gap.
        """
        if not isinstance(contact, GridContact) or self._grid is None:
            return replace(contact, reduced_depth=depth, pressure_sum=pressure_sum)
        settled = self._grid.settled(contact, depth, pressure_sum)
        return replace(settled, residual=max(settled.residual, 1 - self.elements.next_gap(self._reach) / depth))

    def advance(self, contact: ContactState, depth: float) -> ContactState:
        """Solve the contact at a depth [length] larger than the depth of `contact`.

        Raises ConvergenceError if it is not solved to the tolerance, ValueError for a depth too large to represent.
        """
        return self.advance_reduced(contact, depth / self.units.length)

    def advance_reduced(
        self,
        contact: ContactState,
        depth: float,
        target: TargetForce | None = None,
        guess: MemberLoads | None = None,
    ) -> ContactState:
        """Solve the contact at a larger depth in units of the largest initial gap. Raises errors like `advance`.

        target : TargetForce if the depth is a first guess for it. On the grid the contact is then solved at this force,
            within the tolerance, or at the largest depth; a dense solution is at the guess
        guess : loads similar to the loads at the larger depth. The iteration on a grid starts from them if the contact
            is far from the larger depth
        """
        if depth > _LARGEST_DEPTH:
            text = f"contact at depth {depth * self.units.length:g}: larger than {_LARGEST_DEPTH:g} times the largest"
            raise ValueError(f"{text} initial gap, up to which depths are allowed")
        deepest = max(min(_BOX_DEPTH_MARGIN * depth, self._largest_depth), depth)
        if target:
            deepest = target.largest_depth
        self.ranking.require(depth, up_to=deepest)
        candidates = self.elements.count_below(depth)
        # A dense evaluation of few interactions is cheaper than the grid.
        if isinstance(contact, DenseContact) and candidates * contact.count <= self.options.dense_interactions:
            solution = dense.solve(self.elements, contact, depth, candidates, self.options.dense_contacts)
            if solution is not None:
                return self._checked(contact, solution)
        grid = self._grid_up_to(max(candidates, 1), deepest)
        if target:
            target = target._replace(largest_depth=min(target.largest_depth, self.elements.next_gap(self._reach)))
        return self._checked(contact, grid.solve(self._start(grid, contact, depth, guess), depth, target))

    def follow_events(
        self, contact: DenseContact, most: int, pressure_sum: float
    ) -> tuple[ContactEvents, DenseContact, bool]:
        """Follow the touches of the next elements; return them and the last contact; see dense.follow_events."""
        while True:
            events, last, ends_at_force = dense.follow_events(self.elements, contact, most, pressure_sum)
            if last.reduced_depth < self.elements.ranked_depth:
                return events, last, ends_at_force
            self.ranking.rank_up_to(_BOX_DEPTH_MARGIN * last.reduced_depth)

    def may_be_complete(self, contact: ContactState) -> bool:
        """Return True if a contact may lie at or beyond the depth of complete contact.

        An element that overlaps the surface by less than the tolerance need not join the contact, so the number of
        elements in contact does not decide. At and beyond the depth of complete contact no exact gap is open, and no
        computed gap exceeds the residual.
        """
        if not isinstance(contact, GridContact):
            return contact.count == self.elements.count  # a dense solution is exact
        if contact.reduced_depth < 1:
            return False  # the lowest element cannot touch
        fields, limit = contact.fields, _OPEN_GAP * contact.residual * contact.reduced_depth
        fixed = limit, fields.gap_change.values, fields.initial_gap
        return not any(self._loops.each(kernels.has_open_gap, fixed, fields.place))

    def complete_contact(self) -> ContactState:
        """Return the contact at the smallest depth of complete contact, from two linear problems.

        Raises ConvergenceError if these cannot be solved.
        """
        self.ranking.rank_up_to(np.inf)
        require_for_complete_contact(self.elements, self.threads)
        residual = max(_JOINED_SHARE * self.tolerance, EXACT)
        joined = joined_surface(self.elements, residual=residual, padding=self.options.padding, threads=self.threads)
        contact = joined.first_complete_contact(self.units)
        if self._grid is None:
            return contact
        return self._grid_up_to(contact.count, contact.reduced_depth).transferred(contact)

    def grid_of(self, contact: ContactState) -> GridSolver | None:
        """Return the grid solver of the current box if a contact is on its grid."""
        grid = self._grid
        return grid if grid and _is_on(grid, contact) else None

    def depth_of_box(self, depth: float, deepest: float) -> float:
        """Return the largest reduced depth, up to a deepest one, whose box is at most slightly larger than for a depth.

        All elements up to the deepest one must be ranked. A single element far from all others can make the box many
        times as large, although it does not touch.
        """
        rank, reach = (max(self.elements.count_below(u), 1) for u in (depth, deepest))
        area = np.ones(reach - rank + 1)
        for place in (self.elements.row, self.elements.column):
            least, most = (find.accumulate(place[:reach])[rank - 1 :] for find in (np.minimum, np.maximum))
            area *= most - least + 1
        reach = rank + int(np.count_nonzero(area <= _GROWTH_OF_BOX * area[0])) - 1
        return min(deepest, self.elements.next_gap(reach))

    def _start(
        self, grid: GridSolver, contact: ContactState, depth: float, guess: MemberLoads | None
    ) -> GridContact | MemberLoads:
        """Return the start of the iteration on the grid for a larger depth: a contact on this grid, or loads."""
        if isinstance(contact, GridContact) and _is_on(grid, contact):
            return contact
        # The fields of a much smaller contact cost more than they save.
        if depth < _LARGEST_RATIO_OF_START * contact.reduced_depth:
            return grid.transferred(contact)
        return unloaded_contact(self.units).loads if guess is None else guess

    def _grid_up_to(self, rank: int, deepest: float) -> GridSolver:
        """Return the grid solver of a box around the elements up to a rank: the current one, or one of a larger box.

        Only elements whose initial gap is below the depth can touch.

        deepest : depth that a larger box allows for
        """
        if self._grid and rank <= self._reach:
            return self._grid
        # The box allows for larger depths to come, or is the whole grid if a box would save little.
        self.ranking.rank_up_to(deepest)
        reach = max(rank, self.elements.count_below(deepest))
        places = self.elements.row[:reach], self.elements.column[:reach]
        first, last = ([pick(place) for place in places] for pick in (np.min, np.max))
        box = tuple(int(n) for n in (*first, *np.subtract(last, first) + 1))
        rows, columns = self.elements.shape
        if box[2] * box[3] > _LARGEST_BOX * rows * columns:
            reach, box = self.elements.initial_gap.size, (0, 0, rows, columns)
        self._reach = reach
        if self._grid and self._grid.box == box and not self._grid.is_restricted:
            self._grid.place_elements(self.elements)
            return self._grid
        self._former_applications = self.operator_applications
        self._grid = None  # frees its memory for the larger grid
        require_for_box(self.indenter.heights, box, **self._memory_options)
        if reach == self.elements.count:
            self.ranking.free_influence()  # contacts on the whole grid need no dense solutions
        self._grid = GridSolver(box, self.elements, self.tolerance, self.options, threads=self.threads, reach=reach)
        return self._grid

    def _checked(self, before: ContactState, after: ContactState) -> ContactState:
        """Return the contact after a step, if it is valid: no tension, a small residual, and only growth."""
        pressure = after.fields.pressure if isinstance(after, GridContact) else after.member_loads().pressure
        if after.residual > self.tolerance or self._loops.lowest(pressure) < 0:
            raise ConvergenceError(
                f"contact at depth {after.depth:g}: residual {after.residual:.1e} of the depth is above "
                f"the tolerance {self.tolerance:g}; choose a larger tolerance"
            )
        lost, opening = self._lost_contact(before, after)
        if lost and opening > _LOST_CONTACT * self.tolerance * after.reduced_depth:
            raise ConvergenceError(
                f"contact at depth {after.depth:g}: {lost} elements lost contact by up to "
                f"{opening * self.units.length:g} although contact can only grow; choose a smaller tolerance"
            )
        if self.elements.initial_gap[after.count - 1] == 0 and self.elements.initial_gap[after.members[-1]] == 0:
            # All elements touch at once: the curve is straight up to here, as LoadingCurve.at_force recognizes.
            return replace(after, pressure_sum=after.reduced_depth * after.tangent_sum)
        return after

    def _lost_contact(self, before: ContactState, after: ContactState) -> tuple[int, float]:
        """Return the number of elements that left the contact in a step, and their largest gap, reduced."""
        if isinstance(after, GridContact) and isinstance(before, GridContact):
            _, places = self._loops.new_places(before.fields, after.fields)
        else:
            lost = np.setdiff1d(before.members, after.members, assume_unique=True)
            if not isinstance(after, GridContact):
                return lost.size, np.inf
            places = after.fields.place[lost]
        return places.size, after.fields.gap(places).max(initial=0)


def _is_on(grid: GridSolver, contact: ContactState) -> bool:
    """Return True if a contact is on the grid of this grid solver."""
    return isinstance(contact, GridContact) and contact.fields.initial_gap is grid.initial_gap
