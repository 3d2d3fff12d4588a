"""Frictionless contact of a rigid indenter with the elastic half-space at a given depth, started from a shallower one.

Displacements are written w = K P with P = p d/(4πG), a length, so that F/G = 4π d ΣP for element side d.
At depth u the contact satisfies P ≥ 0, e = w − u + g ≥ 0 and P e = 0, with g the gaps to the highest point.
With q the solution of K q = 1 on the contact set (a flat punch of its shape), k/G = 4π d Σq is the exact
tangent stiffness and P + Δu q the predictor for the depth u + Δu.
"""

from dataclasses import dataclass, replace

import numpy as np

from viscorough import memory
from viscorough.contact import dense, grid_solver
from viscorough.contact.halfspace import influence_coefficient
from viscorough.errors import ConvergenceError

# A dense factorisation is cheaper than a few dozen grid operators up to about these sizes (measured).
_DENSE_MEMBERS = 400
_DENSE_INTERACTIONS = 2_000_000

# Memory that a contact takes at most per point of the map (measured).
_BYTES = 400
# Room in depth that the box of a grid has beyond the depth asked for; part of the whole grid above which it is taken.
_ROOM, _LARGE_BOX = 1.3, 0.8


@dataclass(frozen=True)
class Contact:
    """State of the contact at one depth.

    members : elements in contact, as ranks in the order of increasing gap, shape (count,)
    pressure, rate : P and q = dP/du on the members, shape (count,)
    force, stiffness : ΣP and Σq, corrected to second order by the residuals that were left
    residual : largest |e| on the contact set or penetration outside it, over the depth
    fields : the same on the grid (see grid_solver.Fields), None where the dense solution never needed it
    """

    depth: float
    members: np.ndarray
    pressure: np.ndarray
    rate: np.ndarray
    force: float
    stiffness: float
    residual: float
    fields: grid_solver.Fields | None = None

    @property
    def count(self):
        return self.members.size


class ContactSolver:
    """Solves the contact of one indenter, depth after depth, to a residual of `tolerance` times the depth.

    Its lengths (depths, gaps, P) are in `unit`, the largest gap of the indenter; q has none. `place` are the rows and
    columns in the indenter's heights of the elements by rank.
    """

    def __init__(self, indenter, tolerance):
        memory.require(_BYTES * indenter.heights.size, f"contact of a map of {indenter.heights.shape} heights")
        rows, columns = np.nonzero(np.isfinite(indenter.heights))
        gap = indenter.initial_gap[rows, columns].astype(float)
        order = np.argsort(gap, kind="stable")
        # The largest gap is the unit of length, so that results do not depend on the user's.
        self.unit = gap.max() or 1.0
        self.gap = gap[order] / self.unit
        self.place = rows[order], columns[order]
        self.row, self.column = ((i[order] - i.min()).astype(np.int32) for i in (rows, columns))
        self.shape = (int(self.row.max()) + 1, int(self.column.max()) + 1)
        self.tolerance = tolerance
        distance = [np.arange(n, dtype=float) for n in self.shape]
        self.influence = influence_coefficient(distance[0][:, None], distance[1][None, :])
        self._grid, self._spent = None, 0

    @property
    def elements(self):
        return self.gap.size

    @property
    def operator_applications(self):
        """Applications of the half-space operator on the grid so far."""
        return self._spent + (self._grid.operator_applications if self._grid else 0)

    def gaps(self, contact):
        """Gap e between the surfaces at every element, by rank."""
        if contact.count * self.elements <= _DENSE_INTERACTIONS:
            return dense.gaps(self, contact)
        grid = self._grid_to(self.elements)
        fields = contact.fields if _belongs(contact, grid) else grid.fields(contact)
        return fields.gap_at(slice(None))

    def touch(self):
        """First touch: depth zero, no pressure, and no element in contact yet."""
        nothing = np.empty(0)
        return Contact(0.0, nothing.astype(int), nothing, nothing, 0.0, 0.0, 0.0)

    def follow_events(self, contact, most, force):
        """Depths, ΣP, Σq and elements in contact at the events that follow, and the contact at the last one.

        An event is the depth at which the next elements touch. Until then pressures grow at the constant rate q, so
        that depths are exact. Ends with `most` elements in contact or beyond the force.
        """
        *levels, members = dense.follow_events(self, contact, most, force)
        depth, count = levels[0], levels[-1]
        if depth.size:
            members = np.sort(members[: count[-1]])
            contact = _dense_contact(depth[-1], members, *dense.pressures(self, members, depth[-1]))
        return levels, contact

    def advance(self, contact, depth):
        """The contact at a larger depth. Raises ConvergenceError if it cannot be found to the tolerance."""
        candidates = int(np.searchsorted(self.gap, depth))
        if contact.fields is None and candidates * contact.count <= _DENSE_INTERACTIONS:
            found = dense.solve(self, contact, depth, candidates, _DENSE_MEMBERS)
            if found is not None:
                return self._checked(contact, _dense_contact(depth, *found))
        grid = self._grid_to(max(candidates, 1))
        if not _belongs(contact, grid):
            contact = replace(contact, fields=grid.fields(contact))
        return self._checked(contact, Contact(*grid.solve(contact, depth)))

    def _grid_to(self, rank):
        """The grid solver of a box around the elements up to a rank: the last one, or else a larger one.

        Only elements whose gap is below the depth can touch.
        """
        if self._grid is None or rank > self._reach:
            # With room for some depths to come, or the whole grid where little is saved.
            reach = max(rank, int(np.searchsorted(self.gap, _ROOM * self.gap[rank - 1])))
            first, last = ([pick(each[:reach]) for each in (self.row, self.column)] for pick in (np.min, np.max))
            box = [int(n) for n in (*first, *np.subtract(last, first) + 1)]
            if box[2] * box[3] > _LARGE_BOX * self.shape[0] * self.shape[1]:
                reach, box = self.elements, (0, 0, *self.shape)
            self._spent, self._reach = self.operator_applications, reach
            self._grid = grid_solver.GridSolver(box, self.row, self.column, self.gap, self.tolerance)
        return self._grid

    def _checked(self, before, after):
        """Complementarity: no tension and no penetration beyond the tolerance, and contact only grew."""
        if after.residual > self.tolerance or after.pressure.min() < 0:
            raise ConvergenceError(
                f"contact at depth {after.depth:g}: residual {after.residual:.1e} of the depth is above "
                f"the tolerance {self.tolerance:g}; choose a larger tolerance"
            )
        kept = np.zeros(self.elements, dtype=bool)
        kept[after.members] = True
        lost = before.members[~kept[before.members]]
        if lost.size:
            opened = after.fields.gap_at(lost).max() if after.fields is not None else np.inf
            if opened > 3 * self.tolerance * after.depth:
                raise ConvergenceError(
                    f"contact at depth {after.depth:g}: {lost.size} elements lost contact by up to {opened:g} "
                    "although contact can only grow; choose a smaller tolerance"
                )
        return after


def _dense_contact(depth, members, pressure, rate):
    pressure = np.maximum(pressure, 0.0)  # exact zeros of elements that just touch, to rounding
    return Contact(depth, members, pressure, rate, pressure.sum(), rate.sum(), 0.0)


def _belongs(contact, grid):
    """Whether a contact has fields, and on this grid."""
    return contact.fields is not None and contact.fields.place is grid.place
