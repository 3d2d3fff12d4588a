"""Solve the frictionless contact of a rigid indenter at a given depth, started from a smaller depth.

The half-space is elastic. Deflections are written w = K P with P = p d/(4πG), a length, so F/G = 4π d ΣP for elements
of area d² (symbols: contact.state). At depth u the contact satisfies P ≥ 0, e = w − u + g ≥ 0 and P e = 0, with g the
initial gap. With the tangent q, the solution of K q = 1 on the contact set (a flat punch of its shape), k/G = 4π d Σq
is the exact tangent stiffness and P + Δu q the predictor for the depth u + Δu.
"""

import sys
import warnings
from dataclasses import replace
from typing import Any

import numpy as np

from viscorough import units
from viscorough.argument_names import argument, caller
from viscorough.arrays import real_number
from viscorough.contact import dense
from viscorough.contact.complete_contact import EXACT, joined_surface
from viscorough.contact.dense import ContactEvents
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.grid.memory_demand import require_for_box, require_for_complete_contact, require_for_contact
from viscorough.contact.grid.solver import GridSolver
from viscorough.contact.halfspace import tiles
from viscorough.contact.halfspace.operator import Halfspace
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.parallel import BLOCK, require_threads, run_blocks
from viscorough.contact.ranking import Ranking
from viscorough.contact.state import ContactState, MemberLoads
from viscorough.errors import AccuracyWarning, ConvergenceError
from viscorough.indenter import Indenter, check_indenter
from viscorough.summaries import with_unit
from viscorough.types import Array

# Allow for this multiple of the requested depth when a new box is set up: a smaller margin means more boxes, each of
# which costs two applications of the operator. Use the whole grid if the box would cover more than this share of it.
_BOX_DEPTH_MARGIN, _LARGEST_BOX = 2.0, 0.8
# Largest growth of the area of a box by this allowance.
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


def check_solvable(
    name: str, indenter: Indenter, tolerance: float, threads: int = 1, options: SolverOptions = DEFAULT
) -> float:
    """Return the tolerance as a float.

    Raises ValueError, which starts with the name, unless an indenter is a map, and tolerance and threads are in range,
    and TypeError for other options than SolverOptions.
    """
    check_indenter(name, indenter, 2)
    if indenter.spacing * indenter.row_spacing < sys.float_info.min:
        text = f"a spacing of {indenter.spacing:g} is too small to represent areas"
        raise ValueError(f"{caller(name)}{text}; a smaller unit of length is needed")
    tolerance = real_number(argument("tolerance", of=name), tolerance)
    if not 1e-12 <= tolerance <= 0.1:
        raise ValueError(f"{argument('tolerance', of=name)} must be between 1e-12 and 0.1, not {tolerance!r}")
    require_threads(name, threads)
    if not isinstance(options, SolverOptions):
        raise TypeError(f"{name}: options: {type(options).__name__}; viscorough.SolverOptions(...) is needed")
    return tolerance


def warn_beyond_theory(name: str, indenter: Indenter, depth: float) -> None:
    """Give an AccuracyWarning, which starts with the name, for a depth larger than the map is wide.

    No warning is given if the unit of length is unknown: the theory is linear in the heights, which may then be in any
    unit.
    """
    rows, columns = indenter.heights.shape
    extent = max(rows * indenter.row_spacing, columns * indenter.spacing)
    if indenter.length_unit != units.UNKNOWN and depth > extent * (1 + 1e-9):
        reached, width = (with_unit(length, indenter.length_unit) for length in (depth, extent))
        text = f"{caller(name)}the depth u, {reached}, is larger than the map is wide, {width}"
        warnings.warn(f"{text}; the theory ends far below: check the units of force and heights", AccuracyWarning, 3)


class ContactSolver:
    """Solver for the contact of one indenter at increasing depths, to a residual of `tolerance` times the depth.

    indenter : Indenter with two-dimensional heights
    tolerance : largest |e| in contact or overlap outside it, over the depth
    options : SolverOptions
    threads : number of threads for contacts on the grid
    largest_depth : the largest depth that will be requested, if it is known: no grid allows for more [length]
    whole : True if the whole map will be in contact, so memory is checked for the whole map; otherwise it is checked
        for each box around the elements that can touch

    indenter : as it was given
    elements, units : its state.Elements and state.Units
    is_flat : True if all elements have one height, so all touch at once

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
        self._of_memory: dict[str, Any] = {"exact": tolerance < options.exact_gap_below, "threads": threads}
        if whole:
            require_for_contact(indenter.heights, **self._of_memory)
        self.indenter, self._ranking = indenter, Ranking(indenter, threads)
        self.units, self.is_flat = self._ranking.units, self._ranking.is_flat
        self.tolerance, self.options, self.threads, self._loops = tolerance, options, threads, GridLoops(threads)
        self._grid: GridSolver | None = None
        self._reach, self._former_applications = 0, 0
        self._largest_depth = largest_depth / self.units.length
        self.elements = self._ranking.first(self._largest_depth, whole)

    @property
    def operator_applications(self) -> int:
        """Return the number of applications of the half-space operator on the grid so far."""
        return self._former_applications + (self._grid.operator_applications if self._grid else 0)

    def unloaded_state(self) -> ContactState:
        """Return the ContactState at depth zero: no pressure, and no element in contact yet."""
        nothing = np.empty(0)
        return ContactState(self.units, 0.0, 0, 0.0, 0.0, loads=MemberLoads(nothing.astype(int), nothing, nothing))

    def first_contact(self) -> ContactState:
        """Return the ContactState where the straight start of the curve ends: only the highest elements touch.

        Its depth is the smallest positive initial gap, or the side of an element for an indenter of one height.
        """
        if self.elements.initial_gap.size == 0:
            self.elements = self._ranking.up_to(self.elements, self._ranking.small_depth())
        gap = self.elements.initial_gap
        highest = np.searchsorted(gap, 0, side="right")
        depth = 1.0 if self.is_flat else gap[highest]
        if highest == 1 and self.options.dense_contacts:  # takes a tenth of the time of a solution
            return dense.of_highest_element(self.elements, self.units, depth)
        return self.advance_reduced(self.unloaded_state(), depth)

    def settled(self, contact: ContactState, depth: float, pressure_sum: float) -> ContactState:
        """Extrapolate the contact along its tangent to a nearby depth, and rescale its pressures to the given sum.

        contact : the contact solved last
        depth, pressure_sum : u and ΣP, reduced; for a dense solution, the values of the contact

        Its residual may be up to twice the tolerance. It includes a bound on the overlap of elements outside the box of
        the grid: the depth beyond the initial gap.
        """
        if contact.fields is None or self._grid is None:
            return replace(contact, reduced_depth=depth, pressure_sum=pressure_sum)
        settled = self._grid.settled(contact, depth, pressure_sum)
        return replace(settled, residual=max(settled.residual, 1 - self.elements.next_gap(self._reach) / depth))

    def advance(self, contact: ContactState, depth: float) -> ContactState:
        """Solve the ContactState at a depth [length] larger than the depth of `contact`.

        Raises ConvergenceError if it is not solved to the tolerance, ValueError for a depth too large to represent.
        """
        return self.advance_reduced(contact, depth / self.units.length)

    def advance_reduced(
        self,
        contact: ContactState,
        depth: float,
        force: tuple[float, float] | None = None,
        guess: ContactState | None = None,
    ) -> ContactState:
        """Solve the ContactState at a larger depth in units of the largest initial gap. Raises errors like `advance`.

        force : (ΣP, largest depth) if the depth is a first guess for this ΣP. On the grid the contact is then solved at
            this force, within the tolerance, or at the largest depth; a dense solution is at the guess
        guess : contact with loads similar to the loads at the larger depth; the iteration on a grid starts from it
            instead
        """
        if depth > _LARGEST_DEPTH:
            text = f"contact at depth {depth * self.units.length:g}: larger than {_LARGEST_DEPTH:g} times the largest"
            raise ValueError(f"{text} initial gap, up to which depths are allowed")
        deepest = force[1] if force else max(min(_BOX_DEPTH_MARGIN * depth, self._largest_depth), depth)
        candidates = self.candidates(depth, deepest)
        # A dense evaluation of few interactions is cheaper than the grid.
        if contact.fields is None and candidates * contact.count <= self.options.dense_interactions:
            solution = dense.solve(self.elements, contact, depth, candidates, self.options.dense_contacts)
            if solution is not None:
                return self._checked(contact, solution)
        grid, start = self._grid_up_to(max(candidates, 1), deepest), contact
        if not _has_fields_on(grid, contact):
            # The fields of a much smaller contact cost more than they save.
            is_start = depth < _LARGEST_RATIO_OF_START * contact.reduced_depth
            start = replace(contact, fields=grid.fields(contact)) if is_start else guess or self.unloaded_state()
        if force:
            force = force[0], min(force[1], self.elements.next_gap(self._reach))
        return self._checked(contact, grid.solve(start, depth, force))

    def follow_events(
        self, contact: ContactState, most: int, pressure_sum: float
    ) -> tuple[ContactEvents, ContactState, bool]:
        """Follow events at which the next elements touch; return them and the last contact; see dense.follow_events."""
        while True:
            events, last, ends_at_force = dense.follow_events(self.elements, contact, most, pressure_sum)
            if last.reduced_depth < self.elements.ranked_depth:
                return events, last, ends_at_force
            self.elements = self._ranking.up_to(self.elements, _BOX_DEPTH_MARGIN * last.reduced_depth)

    def may_be_complete(self, contact: ContactState) -> bool:
        """Return True if a contact may lie at or beyond the depth of complete contact.

        An element that overlaps the surface by less than the tolerance need not join the contact, so the number of
        elements in contact does not decide. At and beyond the depth of complete contact no exact gap is open, and no
        computed gap exceeds the residual.
        """
        if contact.fields is None:
            return contact.count == self.elements.count  # a dense solution is exact
        if contact.reduced_depth < 1:
            return False  # the lowest element cannot touch
        fields, limit = contact.fields, _OPEN_GAP * contact.residual * contact.reduced_depth
        fixed = limit, fields.gap_change.values, fields.initial_gap
        return not any(self._loops.each(kernels.has_open_gap, fixed, fields.place))

    def complete_contact(self) -> ContactState:
        """Return the contact at the depth from which all elements touch, from two linear problems.

        Raises ConvergenceError if these cannot be solved.
        """
        self.elements = self._ranking.up_to(self.elements, np.inf)
        require_for_complete_contact(self.elements, self.threads)
        residual = max(_JOINED_SHARE * self.tolerance, EXACT)
        how: dict[str, Any] = {"residual": residual, "padding": self.options.padding, "threads": self.threads}
        joined = joined_surface(self.elements, **how)
        contact = joined.first_complete_contact(self.units)
        if self._grid is None:
            return contact
        grid = self._grid_up_to(contact.count, contact.reduced_depth)
        return replace(contact, loads=None, fields=grid.fields(contact))

    def gap_map(self, contact: ContactState) -> Array:
        """Return the gap e between the deformed surfaces [length], shape of the heights; nan outside the indenter.

        Raises ConvergenceError if any element overlaps the surface by more than the residual of the contact.
        """
        heights, (top, left), (rows, columns) = self.indenter.heights, self.elements.origin, self.elements.shape
        own = slice(top, top + rows), slice(left, left + columns)
        gap, highest = np.empty(heights.shape), self._ranking.highest

        def undeformed(i: int, j: int) -> None:
            np.subtract(highest, heights[i:j], out=gap[i:j], dtype=float)
            gap[i:j] -= contact.depth

        run_blocks(undeformed, len(gap), self.threads, -(-BLOCK // heights.shape[1]))
        part, grid = gap[own], self._grid
        # A grid without restrictions knows the gap in its box to the residual.
        known = grid if grid and _has_fields_on(grid, contact) and not grid.is_restricted else None
        if not known or known.box != (0, 0, rows, columns):
            loads, elements = contact.member_loads(), self.elements
            place, load = (elements.row[loads.members], elements.column[loads.members]), loads.pressure
            of_map: dict[str, Any] = {"aspect": elements.aspect, "threads": self.threads}
            if self.options.padding and tiles.is_suitable(elements.shape, elements.aspect, self.tolerance):
                restricted = tiles.TiledHalfspace(rows, columns, tiles.tiles_with(*place, elements.shape), **of_map)
                restricted.load[place] = load * self.units.length
                restricted.add_to(part, tiles.tiles_beyond(known.box if known else (0, 0, 0, 0), elements.shape))
            else:
                # Dense solutions are exact to the rounding of double precision.
                exact = contact.fields is None or self.tolerance < self.options.exact_gap_below
                precision = np.float64 if exact else np.float32
                halfspace = Halfspace(rows, columns, precision, padding=self.options.padding, once=True, **of_map)
                halfspace.load[place] = load * self.units.length
                part += halfspace.apply()[:, :columns]
            if contact.fields is None:
                part[place] = 0.0
        if known:
            first_row, first_column, rows, columns = known.box
            in_box = slice(first_row, first_row + rows), slice(first_column, first_column + columns)
            np.subtract(highest, heights[own][in_box], out=part[in_box], dtype=float)
            part[in_box] += known.in_box(contact.grid_fields.gap_change.values) * self.units.length
        overlap = -np.fmin.reduce(gap, axis=None) / contact.depth
        if overlap > contact.residual + self.tolerance:
            raise ConvergenceError(
                f"contact at depth {contact.depth:g}: elements overlap the surface by {overlap:.1e} of the depth"
            )
        return gap

    def candidates(self, depth: float, deepest: float) -> int:
        """Return the number of elements with initial gaps below a reduced depth: only these can touch at it.

        deepest : rank elements up to this depth if they are not ranked up to the first depth
        """
        if depth > self.elements.ranked_depth:
            self.elements = self._ranking.up_to(self.elements, deepest)
        return int(np.searchsorted(self.elements.initial_gap, depth))

    def depth_of_box(self, depth: float, deepest: float) -> float:
        """Return the largest reduced depth, up to a deepest one, whose box is hardly larger than that of a depth.

        Elements are ranked up to the deepest one. A single element far from all others can make the box many times
        as large, although it will hardly touch.
        """
        rank, reach = (max(self.candidates(u, deepest), 1) for u in (depth, deepest))
        area = np.ones(reach - rank + 1)
        for place in (self.elements.row, self.elements.column):
            least, most = (find.accumulate(place[:reach])[rank - 1 :] for find in (np.minimum, np.maximum))
            area *= most - least + 1
        reach = rank + int(np.count_nonzero(area <= _GROWTH_OF_BOX * area[0])) - 1
        return min(deepest, self.elements.next_gap(reach))

    def _grid_up_to(self, rank: int, deepest: float) -> GridSolver:
        """Return the grid solver of a box around the elements up to a rank: the current one, or one of a larger box.

        Only elements whose initial gap is below the depth can touch.

        deepest : depth that a larger box allows for
        """
        if self._grid is None or rank > self._reach:
            # The box allows for larger depths to come, or is the whole grid if a box would save little.
            reach = max(rank, self.candidates(deepest, deepest))
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
            require_for_box(self.indenter.heights, box, **self._of_memory)
            if reach == self.elements.count:
                self.elements.free_influence()  # contacts on the whole grid need no dense solutions
            self._grid = GridSolver(box, self.elements, self.tolerance, self.options, threads=self.threads, reach=reach)
        return self._grid

    def _checked(self, before: ContactState, after: ContactState) -> ContactState:
        """Return the contact after a step, if it is valid: no tension, a small residual, and only growth."""
        pressure = after.fields.pressure if after.fields else after.member_loads().pressure
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
        if after.fields and before.fields:
            _, places = self._loops.new_places(before.fields, after.fields)
        else:
            lost = np.setdiff1d(before.members, after.members, assume_unique=True)
            if not after.fields:
                return lost.size, np.inf
            places = after.fields.place[lost]
        return places.size, after.fields.gap(places).max(initial=0)


def _has_fields_on(grid: GridSolver, contact: ContactState) -> bool:
    """Return True if a contact has fields of this grid."""
    return contact.fields is not None and contact.fields.initial_gap is grid.initial_gap
