"""Solve a contact on the grid, starting from a contact at a smaller depth.

The pressure starts from the predictor P + Δu q. The contact set starts from the last set and the elements that overlap
the surface after the prediction, except for elements that would touch late in the step. With the late elements it would
contain the set of the solution: between the two depths the contact grows, so the surface outside it deflects further
than predicted. Then pressure_iteration solves for the pressure, and tangent_iteration for the tangent from the start
that tangent_start gives.

Symbols and reduced units are defined in contact.state.
"""

from dataclasses import replace

import numpy as np

from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import field_to_fill
from viscorough.contact.grid.pressure_iteration import PressureIteration, TrialContact
from viscorough.contact.grid.tangent_iteration import solve_tangent
from viscorough.contact.grid.tangent_start import initial_tangent
from viscorough.contact.grid.workspace import GridWorkspace
from viscorough.contact.halfspace.tiles import are_few, is_suitable, tiles_with
from viscorough.contact.options import LATE, SolverOptions
from viscorough.contact.preconditioner.multilevel import REACH
from viscorough.contact.state import (
    BoundedField,
    ContactSet,
    ContactState,
    Elements,
    GridContact,
    GridFields,
    MemberLoads,
    TargetForce,
)

# A box with more than this ratio of rows to columns is transposed: the operator works on blocks of columns, which few
# columns do not fill.
_TALL = 4


class GridSolver:
    """Solver for the contact of elements in a box of the grid, starting from a contact at a smaller depth.

    box : (first row, first column, rows, columns)
    elements : state.Elements, in any order; the rank of an element is its position in their arrays
    tolerance : largest |e| in contact or overlap outside it, over the depth
    options : SolverOptions
    threads : number of threads
    reach : number of elements, by rank, that can touch; all in the box by default

    box : as it was given
    is_restricted : True if the operator is restricted to tiles with elements, because these are a small part of the box
    place : index of every element in flat fields, by rank (0: not in the box)
    initial_gap : flat field
    """

    def __init__(
        self,
        box: tuple[int, ...],
        elements: Elements,
        tolerance: float,
        options: SolverOptions,
        *,
        threads: int = 1,
        reach: int | None = None,
    ) -> None:
        self.box, self._is_transposed = box, box[2] > _TALL * box[3]
        aspect = 1 / elements.aspect if self._is_transposed else elements.aspect
        (top, left, rows, columns), row, column = self._oriented(elements, reach)
        tiles = tiles_with(row - top, column - left, (rows, columns))
        suits = are_few(tiles, options) and is_suitable((rows, columns), aspect, tolerance, options)
        self.is_restricted = options.padding and suits
        used = tiles if self.is_restricted else None
        self._workspace = GridWorkspace((rows, columns), tolerance, options, aspect=aspect, threads=threads, tiles=used)
        self._loops, self._units = self._workspace.loops, elements.units
        self.initial_gap = self._workspace.initial_gap
        # Places without elements have no deflection in a restricted operator.
        self.place_elements(elements, reach if self.is_restricted else None)

    def place_elements(self, elements: Elements, reach: int | None = None) -> None:
        """Place elements up to the rank `reach`, and store their initial gaps.

        The elements begin with the elements placed before. An element outside the box has the place 0, whose entry is
        kept.
        """
        (top, left, rows, columns), row, column = self._oriented(elements, reach)
        field, width = self.initial_gap, columns + 2 * REACH
        outside = field[0]
        place: Integers = np.empty(row.size, np.int32 if field.size < 2**31 else np.int64)

        def store(i: int, j: int) -> None:
            in_rows, in_columns = row[i:j].astype(place.dtype) - top, column[i:j] - left
            inside = (in_rows >= 0) & (in_rows < rows) & (in_columns >= 0) & (in_columns < columns)
            place[i:j] = inside * ((in_rows + REACH) * width + in_columns + REACH)
            field[place[i:j]] = elements.initial_gap[i:j]

        self._loops.over(row, store)
        field[0] = outside
        self.place = place

    def _oriented(self, elements: Elements, reach: int | None) -> tuple[tuple[int, ...], Integers, Integers]:
        """Return the box, and rows and columns of the elements up to a rank, exchanged in a transposed grid."""
        box, row, column = self.box, elements.row[:reach], elements.column[:reach]
        return ((*box[1::-1], *box[:1:-1]), column, row) if self._is_transposed else (box, row, column)

    def in_box(self, field: Array) -> Array:
        """Return a view of a flat field in the rows and columns of the box."""
        interior = self._workspace.interior(field)
        return interior.T if self._is_transposed else interior

    @property
    def operator_applications(self) -> int:
        """Return the number of applications of the half-space operator so far."""
        return self._workspace.operator_applications

    def transferred(self, contact: ContactState) -> GridContact:
        """Return a contact from another solver as a contact on this grid; costs two applications of the operator."""
        grid, loads = self._workspace, contact.member_loads()
        inside, pressure, tangent = grid.zeros(bool), grid.zeros(), grid.zeros()
        place = self.place[loads.members]
        inside[place], pressure[place], tangent[place] = True, loads.pressure, loads.tangent
        change, tangent_gap = grid.gap_change(pressure, contact.reduced_depth), grid.gap_change(tangent, 1)
        return GridContact(
            units=self._units,
            reduced_depth=contact.reduced_depth,
            count=contact.count,
            pressure_sum=contact.pressure_sum,
            tangent_sum=contact.tangent_sum,
            residual=contact.residual,
            fields=GridFields(inside, pressure, change, tangent, tangent_gap, self.initial_gap, self.place),
        )

    def solve(self, start: GridContact | MemberLoads, depth: float, target: TargetForce | None = None) -> GridContact:
        """Solve the contact at a reduced depth.

        start : contact on this grid at a smaller depth, or loads as a first guess
        target : TargetForce, if the depth is only a first guess for it; the contact is then solved at this force

        Raises ConvergenceError if the tolerance is not reached in max_iterations.
        """
        grid, last = self._workspace, start if isinstance(start, GridContact) else None
        trial = self._predicted(start, depth) if isinstance(start, GridContact) else self._guessed(start, depth)
        contact_set = PressureIteration(grid, trial, target).solve()
        tangent, tangent_gap = initial_tangent(trial, last, contact_set, grid.inner, self._loops)
        solve_tangent(grid, contact_set, tangent, tangent_gap)
        solution = contact_set.inside, trial.pressure, trial.change, tangent, tangent_gap
        return self._contact(trial.depth, GridFields(*solution, self.initial_gap, self.place), contact_set)

    def _predicted(self, contact: GridContact, depth: float) -> TrialContact:
        """Predict pressure, e − g and contact set at a depth from a contact at a smaller depth."""
        before, depth_step = contact.fields, depth - contact.reduced_depth
        inner, precision = self._workspace.inner, self._workspace.precision
        predicted = [field_to_fill(self.initial_gap.size, dtype, inner) for dtype in (precision, precision, bool)]
        steps = [precision(step) for step in (depth_step, depth_step * (1 - LATE * depth_step / depth))]
        fields = before.pressure, before.tangent, before.gap_change.values, before.tangent_gap.values, self.initial_gap
        self._loops.each(kernels.predict, steps, *(field[inner] for field in (*predicted, *fields)))
        rounding = before.gap_change.rounding + depth_step * before.tangent_gap.rounding
        pressure, change, inside = predicted
        rounding += self._workspace.field_rounding * depth
        return TrialContact(pressure, BoundedField(change, rounding), inside, depth)

    def _guessed(self, loads: MemberLoads, depth: float) -> TrialContact:
        """Build a first guess of the contact at a depth from loads only."""
        grid = self._workspace
        pressure, inside, place = grid.zeros(), grid.zeros(bool), self.place[loads.members]
        pressure[place] = loads.pressure
        change = grid.gap_change(pressure, depth)
        grid.add_penetrating_elements(change, inside, LATE * depth)
        inside[place] = True
        return TrialContact(pressure, change, inside, depth)

    def settled(self, contact: GridContact, depth: float, pressure_sum: float) -> GridContact:
        """Extrapolate the contact along its tangent to a nearby depth, and rescale its pressures to the given sum.

        Changing the pressures by a multiple of q shifts the gap in contact by the same multiple. So the residual grows
        by at most the q-weighted mean gap left in contact plus the distance of the depths. The gap is recomputed.
        """
        fields, grid, precision = contact.fields, self._workspace, self._workspace.precision
        places = np.flatnonzero(fields.inside)
        share = (pressure_sum - self._loops.total(fields.pressure, places)) / self._loops.total(fields.tangent, places)
        loads = np.maximum(fields.pressure[places] + precision(share) * fields.tangent[places], precision(0))
        pressure, inside = grid.zeros(), grid.zeros(bool)
        pressure[places] = loads * precision(pressure_sum / loads.sum(dtype=float))
        inside[places] = loads > 0
        change = grid.gap_change(pressure, depth)
        fields = replace(fields, inside=inside, pressure=pressure, gap_change=change)
        settled = self._contact(depth, fields, grid.contact_set(inside))
        return replace(settled, pressure_sum=pressure_sum, tangent_sum=contact.tangent_sum)

    def solve_flat_punch(self, inside: Mask, tangent: Array, tangent_gap: Array) -> float:
        """Solve K q = 1 on a set by iteration from the given q, which must be zero outside the set; changes q in place.

        inside : True for elements in the set, flat field
        tangent, tangent_gap : q and e_q = K q − 1, flat fields

        Returns Σq; its relative error is the square of the error of q in the energy norm.
        Raises ConvergenceError if the tolerance is not reached in max_iterations.
        """
        contact_set = self._workspace.contact_set(inside)
        # The caller reuses the tangent gap from set to set, so its rounding error has no bound.
        solve_tangent(self._workspace, contact_set, tangent, BoundedField(tangent_gap, np.inf))
        places = contact_set.places
        return self._loops.total(tangent, places) - self._loops.inner_product(tangent, tangent_gap, places)

    def _contact(self, depth: float, fields: GridFields, contact_set: ContactSet) -> GridContact:
        """Return the contact with these fields at a reduced depth, with its sums and its residual."""
        places, change, tangent = contact_set.places, fields.gap_change, fields.tangent
        inner, residual = self._workspace.inner, self._workspace.residual
        largest = self._loops.largest_gap(change.values, self.initial_gap, residual, places)
        overlap = self._loops.largest_overlap(change.values[inner], self.initial_gap[inner])
        correction = self._loops.inner_product(tangent, residual, places)
        tangent_correction = self._loops.inner_product(tangent, fields.tangent_gap.values, places)
        return GridContact(
            units=self._units,
            reduced_depth=depth,
            count=places.size,
            pressure_sum=self._loops.total(fields.pressure, places) - correction,
            tangent_sum=self._loops.total(tangent, places) - tangent_correction,
            residual=(max(largest, overlap) + change.rounding) / depth,
            fields=fields,
        )
