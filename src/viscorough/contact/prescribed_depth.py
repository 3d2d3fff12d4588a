"""Solve the frictionless contact of a rigid indenter at a prescribed depth, from the contact at a smaller depth.

A contact of few elements is solved directly, with a dense matrix. A larger contact is solved by iteration on the grid
of a box around the elements that can touch.

The half-space is elastic with the shear modulus G. The pressures p of elements of area d² are written as lengths
P = p d/(4πG). The deflections are then w = K P with the influence coefficients K, and the force is F/G = 4π d ΣP
(symbols: contact.state). At the depth u the contact satisfies P ≥ 0, e = w − u + g ≥ 0 and P e = 0, where g is the
initial gap.

The tangent q solves K q = 1 for the elements in contact, as if they were a flat punch. It gives the exact tangent
stiffness k/G = 4π d Σq, and P + Δu q predicts the pressures at the depth u + Δu.
"""

from dataclasses import replace

import numpy as np

from viscorough.basics import memory
from viscorough.basics.errors import ConvergenceError
from viscorough.contact import dense
from viscorough.contact.dense import ContactEvents
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.grid.solver import GridSolver
from viscorough.contact.joined_surface import EXACT, joined_surface
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

# Contacts are solved in a box, the part of the grid around the elements that can touch. A new box contains all elements
# that can touch up to this multiple of the requested depth. With a smaller margin more boxes are needed, and each new
# box costs two applications of the half-space operator.
_BOX_DEPTH_MARGIN = 2.0
# The whole grid is used if the box around the elements that can touch would cover more than this share of the grid.
_LARGEST_BOX = 0.8
# A box (the part of the grid where contacts are solved) is enlarged for larger depths only as long as its area grows at
# most by this factor.
_GROWTH_OF_BOX = 1.3
# Contact grows with depth, but within the accuracy of the solution an element may leave the contact. ConvergenceError
# is raised if the gap of such an element exceeds this number times the tolerance times the depth.
_LOST_CONTACT = 3
# Bytes that contacts on a grid take per point, in single precision and if gaps need double precision: the fields of the
# contacts in memory, the operators and the preconditioner. On maps of 400 points across, 170 to 185 were measured, and
# up to 370 in double precision. The linear problems of complete contact take about as much in addition.
_BYTES_PER_POINT, _BYTES_PER_POINT_IF_EXACT = 250, 450
# Largest reduced depth that a contact may have. It is far below the largest number of single precision, 3e38.
_LARGEST_DEPTH = 1e25
# The two linear problems of complete contact are solved until the norm of the residual, divided by the norm of the
# right-hand side, is this share of the tolerance. The relative error of the depth is a few times this ratio. With n
# elements, the residual at a single element may be √n times as large relative to the right-hand side.
_JOINED_SHARE = 1e-4
# An element counts as out of contact if its gap exceeds the residual of the contact times this factor, which is a
# margin for rounding.
_OPEN_GAP = 1.1
# On a new grid, the iteration starts from the last contact only if the new depth is less than this multiple of the last
# depth.
_LARGEST_RATIO_OF_START = 2.0


class ContactSolver:
    """Solver for the contact of one indenter at increasing depths.

    Arguments (the first four are also attributes):

    indenter : Indenter with two-dimensional heights
    tolerance : largest allowed gap |e| in contact, or overlap outside the contact, divided by the depth
    options : SolverOptions
    threads : number of threads for contacts on the grid
    largest_depth : largest depth that will be requested [length]. No grid is made for larger depths
    whole : True if the whole map may come into contact. Memory is then checked for the whole map at once, otherwise for
        each new box around the elements that can touch

    Further attributes:

    ranking : Ranking of the elements by height; further elements are ranked when a contact needs them
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
        self.indenter, self.tolerance, self.options, self.threads = indenter, tolerance, options, threads
        self.ranking = Ranking(indenter, threads, options, largest_depth=largest_depth, whole=whole)
        if whole:
            self._require_memory(*self.elements.shape)
        self.units: Units = self.ranking.elements.units
        self._largest_depth = largest_depth / self.units.length
        self._loops = GridLoops(threads)
        self._grid: GridSolver | None = None  # solver for the current box; only `_grid_up_to` replaces it
        self._reach = 0  # the current box contains all elements with a rank below this number
        self._former_applications = 0  # number of times that the operators of earlier boxes were applied

    @property
    def elements(self) -> Elements:
        """Return the Elements object with all elements that are ranked by height so far."""
        return self.ranking.elements

    @property
    def is_flat(self) -> bool:
        """Return True if all elements have the same height, so that all touch at once."""
        return self.ranking.is_flat

    @property
    def operator_applications(self) -> int:
        """Return the number of applications of the half-space operator on the grid so far."""
        return self._former_applications + (self._grid.operator_applications if self._grid else 0)

    def unloaded_state(self) -> ContactState:
        """Return the contact at depth zero: no pressure, and no element in contact yet."""
        return unloaded_contact(self.units)

    def first_contact(self) -> ContactState:
        """Return the contact at the end of the straight first part of the curve, where only the highest elements touch.

        Its depth is the smallest positive initial gap, or the side of an element if all elements have the same height.
        """
        self.ranking.rank_highest()
        gap = self.elements.initial_gap
        highest = np.searchsorted(gap, 0, side="right")
        depth = 1.0 if self.is_flat else gap[highest]
        if highest == 1 and self.options.dense_contacts:
            # This function takes a tenth of the time of the general solution below.
            return dense.solve_highest_element(self.elements, depth)
        return self.advance_reduced(self.unloaded_state(), depth)

    def extrapolate(self, contact: ContactState, depth: float, pressure_sum: float) -> ContactState:
        """Extrapolate the contact along its tangent to a nearby depth, and rescale its pressures to the given sum.

        The residual of the returned contact may be up to twice the tolerance. It includes a bound on the overlap of
        elements outside the box of the grid: 1 − g/u, where g is the smallest initial gap of these elements.

        contact : the contact solved last
        depth, pressure_sum : reduced depth u and sum ΣP of the returned contact. For a `contact` that was solved with a
            dense matrix, they must equal the depth and the sum of `contact`
        """
        if not isinstance(contact, GridContact) or self._grid is None:
            return replace(contact, reduced_depth=depth, pressure_sum=pressure_sum)
        extrapolated = self._grid.extrapolate(contact, depth, pressure_sum)
        overlap = 1 - self.elements.next_gap(self._reach) / depth
        return replace(extrapolated, residual=max(extrapolated.residual, overlap))

    def advance(self, contact: ContactState, depth: float) -> ContactState:
        """Solve the contact at a depth [length] larger than the depth of `contact`.

        Raises ConvergenceError if the contact is not solved to the tolerance, and ValueError for a depth that is too
        large to represent.
        """
        return self.advance_reduced(contact, depth / self.units.length)

    def advance_reduced(
        self,
        contact: ContactState,
        depth: float,
        target: TargetForce | None = None,
        guess: MemberLoads | None = None,
    ) -> ContactState:
        """Solve the contact at a larger depth in units of the largest initial gap; raise the same errors as `advance`.

        contact : contact at a smaller depth
        depth : depth at which the contact is solved, or a first guess of the depth if there is a target
        target : force to reach. A contact on the grid is solved at this force within the tolerance, or at the largest
            depth that the target allows. A contact solved with a dense matrix is solved at `depth`, not at the target
        guess : expected loads. If the depth of `contact` is much smaller than `depth`, the iteration on the grid starts
            from the expected loads instead of `contact`
        """
        if depth > _LARGEST_DEPTH:
            text = f"contact at depth {depth * self.units.length:g}: larger than {_LARGEST_DEPTH:g} times the largest"
            raise ValueError(f"{text} initial gap, up to which depths are allowed")
        deepest = max(min(_BOX_DEPTH_MARGIN * depth, self._largest_depth), depth)
        if target:
            deepest = target.largest_depth
        self.ranking.require(depth, up_to=deepest)
        candidates = self.elements.count_below(depth)
        # Computing few interactions between elements directly is cheaper than computing all interactions on the grid.
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
        """Compute the next contact events, the depths where elements touch, and rank further elements as needed.

        See `dense.follow_events` for arguments and results.
        """
        while True:
            events, last, ends_at_force = dense.follow_events(self.elements, contact, most, pressure_sum)
            if last.reduced_depth < self.elements.ranked_depth:
                return events, last, ends_at_force
            self.ranking.rank_up_to(_BOX_DEPTH_MARGIN * last.reduced_depth)

    def may_be_complete(self, contact: ContactState) -> bool:
        """Return True if the depth of a contact may be at or beyond the depth of complete contact.

        From the depth of complete contact on, all exact gaps are zero, so no computed gap exceeds the residual. The
        method therefore returns True if no computed gap exceeds the residual. It does not compare the number of
        elements in contact with the number of all elements, because an element that overlaps the surface by less than
        the tolerance need not join the contact.
        """
        if not isinstance(contact, GridContact):
            # This contact was solved directly, with a dense matrix, so the number of elements in contact is exact.
            return contact.count == self.elements.count
        if contact.reduced_depth < 1:
            return False  # the depth is less than the initial gap of the lowest element, which therefore cannot touch
        fields, limit = contact.fields, _OPEN_GAP * contact.residual * contact.reduced_depth
        gap_change, initial_gap = fields.gap_change.values, fields.initial_gap

        def has_open_gap(i: int, j: int) -> bool:
            places = fields.place[i:j]
            return kernels.has_open_gap(limit=limit, gap_change=gap_change, initial_gap=initial_gap, places=places)

        return not any(self._loops.over(fields.place, has_open_gap))

    def solve_complete_contact(self) -> ContactState:
        """Compute the contact at the depth where contact becomes complete, from two linear problems.

        Raises ConvergenceError if the linear problems cannot be solved.
        """
        self.ranking.rank_up_to(np.inf)
        self._require_memory(*self.elements.shape)
        residual = max(_JOINED_SHARE * self.tolerance, EXACT)
        joined = joined_surface(self.elements, residual=residual, padding=self.options.padding, threads=self.threads)
        contact = joined.first_contact_of_all(self.units)
        if self._grid is None:
            return contact
        return self._grid_up_to(contact.count, contact.reduced_depth).transferred(contact)

    def grid_of(self, contact: ContactState) -> GridSolver | None:
        """Return the grid solver of the current box if the contact is stored on its grid, otherwise None."""
        grid = self._grid
        return grid if grid and _is_on(grid, contact) else None

    def depth_of_box(self, depth: float, deepest: float) -> float:
        """Return the largest reduced depth for which the box of the grid is only slightly larger than at `depth`.

        The box at a depth surrounds all elements that can touch at this depth. A single element far from all others can
        make the box many times as large, even if this element does not come into contact.

        depth : reduced depth. Compared with the box at this depth, the area may be larger by the factor _GROWTH_OF_BOX
        deepest : largest reduced depth to return; all elements up to this depth must be ranked
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
        """Return what the iteration at a larger depth starts from: a GridContact on `grid`, or loads (MemberLoads).

        If `contact` is already on `grid`, or if its depth is not much smaller than `depth`, the result is this contact
        on `grid`. Otherwise the result is `guess`, or MemberLoads without loads if `guess` is None.

        contact : contact solved last, on any grid or with a dense matrix
        """
        if isinstance(contact, GridContact) and _is_on(grid, contact):
            return contact
        # Transfer the contact to `grid` unless its depth is much smaller than `depth`. A transfer from a much smaller
        # depth takes more time than it saves.
        if depth < _LARGEST_RATIO_OF_START * contact.reduced_depth:
            return grid.transferred(contact)
        return unloaded_contact(self.units).loads if guess is None else guess

    def _grid_up_to(self, rank: int, deepest: float) -> GridSolver:
        """Return the grid solver of the current box, or of a new box if the current box is too small.

        Only elements whose initial gap is below the depth can touch, so a box need not contain lower elements.

        rank : number of elements, from the highest element on, that the box must contain
        deepest : reduced depth; a new box contains all elements that can touch up to this depth
        """
        if self._grid and rank <= self._reach:
            return self._grid
        # The new box also contains elements that touch only at larger depths. The whole grid is used if a smaller box
        # would save little.
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
        self._grid = None  # frees the memory of the current grid before the next grid needs memory
        self._require_memory(*box[2:])
        if reach == self.elements.count:
            # Only contacts that are solved with a dense matrix need the influence coefficients. From now on, contacts
            # are solved on the whole grid.
            self.ranking.free_influence()
        self._grid = GridSolver(box, self.elements, self.tolerance, self.options, threads=self.threads, reach=reach)
        return self._grid

    def _require_memory(self, rows: int, columns: int) -> None:
        """Raise MemoryError unless a contact on a grid of this size fits into the available memory."""
        is_exact = self.tolerance < self.options.exact_gap_below
        needed = (_BYTES_PER_POINT_IF_EXACT if is_exact else _BYTES_PER_POINT) * rows * columns
        memory.require(needed, f"contact of a map of {self.indenter.heights.shape} heights")

    def _checked(self, before: ContactState, after: ContactState) -> ContactState:
        """Return the contact after a step. Raises ConvergenceError unless it is valid.

        A valid contact has no tension, and a residual within the tolerance. If elements left the contact in the step,
        their gaps are so small that the limited accuracy explains them (see _LOST_CONTACT).
        """
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
            # All elements in contact have the same, largest height, so the curve is straight up to this depth. Make the
            # sum of pressures exactly proportional to the depth, so that LoadingCurve.at_force finds a straight line.
            return replace(after, pressure_sum=after.reduced_depth * after.tangent_sum)
        return after

    def _lost_contact(self, before: ContactState, after: ContactState) -> tuple[int, float]:
        """Return the number of elements that left the contact in a step, and the largest reduced gap among them."""
        if isinstance(after, GridContact) and isinstance(before, GridContact):
            _, places = self._loops.new_places(before.fields, after.fields)
        else:
            lost = np.setdiff1d(before.members, after.members, assume_unique=True)
            if not isinstance(after, GridContact):
                return lost.size, np.inf
            places = after.fields.place[lost]
        return places.size, after.fields.gap(places).max(initial=0)


def _is_on(grid: GridSolver, contact: ContactState) -> bool:
    """Return True if a contact is stored on the grid of this grid solver."""
    return isinstance(contact, GridContact) and contact.fields.initial_gap is grid.initial_gap
