"""Solve a contact on the grid, starting from a contact at a smaller depth.

A solution has three steps:

1. Predict the pressure P + Δu q from the tangent q at the smaller depth. Guess the contact set: all elements in contact
   at the smaller depth, and all elements that are predicted to touch early in the step. Elements that are predicted to
   touch late are left out, because the growing contact bends the surface away from them further than predicted. (With
   the late elements, the guess would contain all elements of the solution, and further elements.)
2. Solve for the pressure (module iteration).
3. Solve for the tangent (module tangent).

Symbols and reduced units are defined in contact.state.
"""

from dataclasses import replace

import numpy as np

from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.border import BORDER
from viscorough.contact.grid import kernels
from viscorough.contact.grid.iteration import solve_pressure
from viscorough.contact.grid.loops import field_to_fill
from viscorough.contact.grid.state import GridWorkspace, TrialContact
from viscorough.contact.grid.tangent import initial_tangent, solve_tangent
from viscorough.contact.halfspace.tiles import are_few, is_suitable, tiles_with
from viscorough.contact.options import LATE, SolverOptions
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

# If the ratio of rows to columns of a box exceeds this number, rows and columns are exchanged. The operator works on
# blocks of columns, and the few columns of such a box would not fill a block.
_TALL = 4


class GridSolver:
    """Solver for the contact of the elements in a box of the grid, starting from a contact at a smaller depth.

    box : rectangle of the grid, (first row, first column, rows, columns)
    elements : state.Elements in any order; the rank of an element is its position in the arrays of `elements`
    tolerance : largest allowed |e| in contact, and overlap elsewhere, relative to the depth
    options : SolverOptions
    threads : number of threads
    reach : only the first `reach` elements can touch; by default all elements in the box can

    box : the argument of the same name
    is_restricted : True if the operator computes deflections only in tiles that contain elements, because these tiles
        are a small part of the box
    place : for every element, in the order of ranks, its index in flat fields; 0 for elements outside the box
    initial_gap : initial gap g, flat field
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
        # A restricted operator computes deflections only in tiles with elements that can touch, so only these elements
        # get an index in flat fields.
        self.place_elements(elements, reach if self.is_restricted else None)

    def place_elements(self, elements: Elements, reach: int | None = None) -> None:
        """Compute the indices in flat fields of the first `reach` elements, and store their initial gaps.

        An element outside the box gets the index 0; the initial gap stored at this index is not changed.

        elements : Elements; since the last call, elements may only have been appended
        reach : number of elements; by default all
        """
        (top, left, rows, columns), row, column = self._oriented(elements, reach)
        field, width = self.initial_gap, columns + 2 * BORDER
        outside = field[0]
        place: Integers = np.empty(row.size, np.int32 if field.size < 2**31 else np.int64)

        def store(i: int, j: int) -> None:
            in_rows, in_columns = row[i:j].astype(place.dtype) - top, column[i:j] - left
            inside = (in_rows >= 0) & (in_rows < rows) & (in_columns >= 0) & (in_columns < columns)
            place[i:j] = inside * ((in_rows + BORDER) * width + in_columns + BORDER)
            field[place[i:j]] = elements.initial_gap[i:j]

        self._loops.over(row, store)
        field[0] = outside
        self.place = place

    def _oriented(self, elements: Elements, reach: int | None) -> tuple[tuple[int, ...], Integers, Integers]:
        """Return the box, and the rows and columns of the first `reach` elements.

        Rows and columns are exchanged if the solver works on a transposed box.
        """
        box, row, column = self.box, elements.row[:reach], elements.column[:reach]
        return ((*box[1::-1], *box[:1:-1]), column, row) if self._is_transposed else (box, row, column)

    def in_box(self, field: Array) -> Array:
        """Return a view of a flat field as an array with the rows and columns of the box."""
        interior = self._workspace.interior(field)
        return interior.T if self._is_transposed else interior

    @property
    def operator_applications(self) -> int:
        """Return the number of applications of the half-space operator so far."""
        return self._workspace.operator_applications

    def transferred(self, contact: ContactState) -> GridContact:
        """Convert a contact from another solver to a contact on this grid.

        The conversion takes two applications of the half-space operator.
        """
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

        start : contact on this grid at a smaller depth, or MemberLoads of a similar contact as a first guess
        depth : reduced depth u
        target : if given, the contact is solved at this TargetForce, and `depth` is only a first guess

        Raises ConvergenceError if the tolerance is not reached in max_iterations.
        """
        grid, last = self._workspace, start if isinstance(start, GridContact) else None
        trial = self._predicted(start, depth) if isinstance(start, GridContact) else self._guessed(start, depth)
        contact_set = solve_pressure(grid, trial, target)
        tangent, tangent_gap = initial_tangent(trial, last, contact_set, grid.inner, self._loops)
        solve_tangent(grid, contact_set, tangent, tangent_gap)
        solution = contact_set.inside, trial.pressure, trial.change, tangent, tangent_gap
        return self._contact(trial.depth, GridFields(*solution, self.initial_gap, self.place), contact_set)

    def _predicted(self, contact: GridContact, depth: float) -> TrialContact:
        """Predict pressure, gap and contact set at a depth, by extrapolation from a contact at a smaller depth."""
        before, depth_step = contact.fields, depth - contact.reduced_depth
        inner, precision = self._workspace.inner, self._workspace.precision
        pressure, change, inside = (
            field_to_fill(self.initial_gap.size, dtype, inner) for dtype in (precision, precision, bool)
        )
        early_step = depth_step * (1 - LATE * depth_step / depth)

        def predict(i: int, j: int) -> None:
            kernels.predict(
                depth_step=precision(depth_step),
                early_step=precision(early_step),
                predicted=pressure[inner][i:j],
                predicted_change=change[inner][i:j],
                inside=inside[inner][i:j],
                pressure=before.pressure[inner][i:j],
                tangent=before.tangent[inner][i:j],
                gap_change=before.gap_change.values[inner][i:j],
                tangent_gap=before.tangent_gap.values[inner][i:j],
                initial_gap=self.initial_gap[inner][i:j],
            )

        self._loops.over(pressure[inner], predict)
        rounding = before.gap_change.rounding + depth_step * before.tangent_gap.rounding
        rounding += self._workspace.field_rounding * depth
        return TrialContact(pressure, BoundedField(change, rounding), inside, depth)

    def _guessed(self, loads: MemberLoads, depth: float) -> TrialContact:
        """Build a first guess of the contact at a depth from the pressures of a similar contact.

        loads : MemberLoads of the similar contact, which need not be on this grid
        """
        grid = self._workspace
        pressure, inside, place = grid.zeros(), grid.zeros(bool), self.place[loads.members]
        pressure[place] = loads.pressure
        change = grid.gap_change(pressure, depth)
        grid.add_penetrating_elements(change, inside, LATE * depth)
        inside[place] = True
        return TrialContact(pressure, change, inside, depth)

    def extrapolate(self, contact: GridContact, depth: float, pressure_sum: float) -> GridContact:
        """Extrapolate the contact along its tangent to a nearby depth, and rescale its pressures to the given sum.

        The extrapolation adds c q to the pressures, with a number c. This adds c to the gap in contact, since K q = 1.
        The residual grows at most by the difference between the two depths, plus the mean of the remaining gap in
        contact, weighted with q. The gap is recomputed from the new pressures.

        contact : solved contact on this grid
        depth : new reduced depth
        pressure_sum : reduced sum ΣP of the new pressures
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
        extrapolated = self._contact(depth, fields, grid.contact_set(inside))
        return replace(extrapolated, pressure_sum=pressure_sum, tangent_sum=contact.tangent_sum)

    def solve_flat_punch(self, inside: Mask, tangent: Array, tangent_gap: Array) -> float:
        """Solve K q = 1 on a contact set by iteration, starting from a given q; return the sum Σq.

        q is the tangent dP/du, or the pressure of a flat punch with the shape of the contact set at the depth 1.

        inside : True for elements in the set, flat field
        tangent : q, flat field; zero outside the set, changed in place to the solution
        tangent_gap : e_q = K q − 1, flat field, changed in place

        Returns Σq; the relative error of Σq is the square of the relative error of q in the energy norm.
        Raises ConvergenceError if the tolerance is not reached in max_iterations.
        """
        contact_set = self._workspace.contact_set(inside)
        # The caller uses the same array of e_q for different contact sets, so no bound on its rounding error is known.
        solve_tangent(self._workspace, contact_set, tangent, BoundedField(tangent_gap, np.inf))
        places = contact_set.places
        return self._loops.total(tangent, places) - self._loops.inner_product(tangent, tangent_gap, places)

    def _contact(self, depth: float, fields: GridFields, contact_set: ContactSet) -> GridContact:
        """Build a GridContact from solved fields at a reduced depth; compute its residual, and the sums of P and q."""
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
