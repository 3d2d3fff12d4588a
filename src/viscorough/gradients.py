"""Contact on the grid by preconditioned steps on a contact set that shrinks to its solution.

The set to start from is the last contact set with everything that the predictor P + Δu q makes penetrate. It
contains the solution's: between the two depths the true rate of deflection is that of a larger punch, so the
surface sinks further than predicted. Elements that come under tension leave it. Along a search direction d the
deflection K d is known on the whole grid, so the gap is, too, everywhere and at no further cost.

While elements leave, steps have the preconditioner's own length, so that one operator serves the step and the loads
of those that leave; once none does, steps are those of conjugate gradients.

Arrays of the grid are flat, with a border as wide as the preconditioner reaches, so that neighbours need no special
cases.
"""

from dataclasses import dataclass

import numpy as np

from viscorough import preconditioner
from viscorough.compilation import njit
from viscorough.curve import ConvergenceError
from viscorough.halfspace import Halfspace
from viscorough.preconditioner import REACH

# Length of the steps in which elements leave (measured: 0.9 to 1.2 are alike), halved every so many of them, which
# ends what a set that the preconditioner suits badly might begin. Usually there are about ten.
_LENGTH, _PATIENCE = 1.0, 20
# Relative residual of q. Force and stiffness are corrected to second order, so its square is what counts.
_RATE_TOLERANCE = 1e-2
# The search, and the residual, relative to the depth or to 1 for q, down to which its rounding is far below.
_PRECISION, _SINGLE = np.float32, 1e-4
_ITERATIONS = 2000
# Gap where there is no element; finite, since differences of gaps are taken.
_OUTSIDE = 1e300


@dataclass(frozen=True)
class Fields:
    """Contact on the grid, flat with border: P, gap e = w − u + g, q, and e_q = K q − 1; `place` of ranks."""

    pressure: np.ndarray
    gap: np.ndarray
    rate: np.ndarray
    rate_gap: np.ndarray
    place: np.ndarray

    def gap_at(self, ranks):
        """Gap e between the surfaces at the elements of given rank."""
        return self.gap[self.place[ranks]]


@njit(fastmath=True)
def _product(left, right, slots):
    """Σ left·right over the contact set, for arrays laid out as the operator's load."""
    total = 0.0
    for t in range(slots.size):
        total += np.float64(left[slots[t]]) * np.float64(right[slots[t]])
    return total


@njit(fastmath=True)
def _step(length, direction, deflection, pressure, gap, places, slots, rows, columns, stride):
    """P += α d on the set, e += α K d everywhere; returns largest |e| on the set and whether any P is negative."""
    for i in range(rows):
        a, b = (i + REACH) * (columns + 2 * REACH) + REACH, i * stride
        for j in range(columns):
            gap[a + j] += length * deflection[b + j]
    largest, lowest = 0.0, 0.0
    for t in range(places.size):
        i = places[t]
        pressure[i] += length * direction[slots[t]]
        largest = max(largest, abs(gap[i]))
        lowest = min(lowest, pressure[i])
    return largest, lowest < 0


@njit(fastmath=True)
def _turn(direction, result, factor, slots):
    """d = β d − z on the set."""
    for t in range(slots.size):
        direction[slots[t]] = factor * direction[slots[t]] - result[t]


@njit
def _state(pressure, gap, places):
    """Largest |e| on the set, and whether any pressure is negative."""
    largest, lowest = 0.0, 0.0
    for t in range(places.size):
        largest = max(largest, abs(gap[places[t]]))
        lowest = min(lowest, pressure[places[t]])
    return largest, lowest < 0


@njit
def _pulls(length, direction, pressure, places, slots):
    """Whether a step of that length would put any element under tension."""
    lowest = 0.0
    for t in range(places.size):
        lowest = min(lowest, pressure[places[t]] + length * direction[slots[t]])
    return lowest < 0


@njit
def _step_and_release(length, direction, pressure, inside, places, slots, relief, width, stride):
    """P += α d; elements under tension leave the set. The direction becomes the whole change of pressure.

    Taking away a pull p < 0 lifts its neighbours off. They give away as much pressure as eliminating the element does,
    which saves iterations. None of it may make them pull.
    """
    for t in range(places.size):
        direction[slots[t]] *= length
        pressure[places[t]] += direction[slots[t]]
        inside[places[t]] = pressure[places[t]] >= 0
    for t in range(places.size):
        i = places[t]
        if inside[i]:
            continue
        pull = pressure[i]
        direction[slots[t]] -= pull
        pressure[i] = 0.0
        for row in range(-1, 2):
            for column in range(-1, 2):
                near = i + row * width + column
                if inside[near]:
                    change = max(pull * relief[row + 1, column + 1], -0.5 * pressure[near])
                    pressure[near] += change
                    direction[slots[t] + row * stride + column] += change


@njit
def _admit(gap, inside, limit):
    """Elements that penetrate by more than `limit` join the set; returns how many."""
    joined = 0
    for i in range(gap.size):
        if gap[i] < -limit and not inside[i]:
            inside[i] = True
            joined += 1
    return joined


class GridSolver:
    """Contact of the elements at (row, column), in the order of increasing gap, that lie in a box of the grid.

    box : (first row, first column, rows, columns)

    Searches in single precision. Since what is searched for are corrections, and shrinking ones, their rounding is
    small; once a level, where the tolerance needs it, gaps are computed anew from the pressures in double precision.
    """

    def __init__(self, box, row, column, gap, tolerance):
        self.tolerance = tolerance
        top, left, rows, columns = box
        self._halfspace = Halfspace(rows, columns, _PRECISION)
        self._exact = Halfspace(rows, columns) if tolerance < _SINGLE else self._halfspace
        self._width = columns + 2 * REACH
        in_box = (row >= top) & (row < top + rows) & (column >= left) & (column < left + columns)
        self._ranks = np.flatnonzero(in_box)
        self.place = np.where(in_box, (row - top + REACH) * self._width + column - left + REACH, 0)
        self.gap = np.full((rows + 2 * REACH) * self._width, _OUTSIDE)
        self.gap[self.place[self._ranks]] = gap[self._ranks]
        self._inverse = preconditioner.Preconditioner(rows + 2 * REACH, self._width)

    @property
    def operators(self):
        """Applications of the half-space operator so far."""
        return sum(each.count for each in {self._halfspace, self._exact})

    def fields(self, contact):
        """The grid's fields of a dense solution; costs two operators."""
        place = self.place[contact.members]
        pressure, rate = np.zeros_like(self.gap), np.zeros_like(self.gap)
        pressure[place], rate[place] = contact.pressure, contact.rate
        gap, rate_gap = self.gap - contact.depth, np.full_like(self.gap, -1.0)
        if contact.count:
            gap += self._deflection(pressure)
            rate_gap += self._deflection(rate)
        return Fields(pressure, gap, rate, rate_gap, self.place)

    def solve(self, contact, depth):
        """The contact at a larger depth; the entries of a contact.Contact. Raises ConvergenceError."""
        before, advance = contact.fields, depth - contact.depth
        pressure = before.pressure + advance * before.rate
        gap = before.gap + advance * before.rate_gap
        inside = pressure > 0
        limit, finest = max(self.tolerance, _SINGLE) * depth, self.tolerance * depth

        _admit(gap, inside, 0.0)
        places = self._search(pressure, gap, inside, limit, bounded=True)
        if limit > finest:
            gap = self._deflection(pressure) + self.gap - depth
            _admit(gap, inside, finest)
            places = self._search(pressure, gap, inside, finest, bounded=True)

        rate, rate_gap = self._rate(before, contact.depth, pressure, gap, depth, inside, places)
        left = gap[places]
        ranks = self._ranks[inside[self.place[self._ranks]]]
        on_set = self.place[ranks]
        return (
            depth,
            ranks,
            pressure[on_set],
            rate[on_set],
            pressure[places].sum() - rate[places] @ left,
            rate[places].sum() - rate[places] @ rate_gap[places],
            max(np.abs(left).max(), -gap.min()) / depth,
            Fields(pressure, gap, rate, rate_gap, self.place),
        )

    def _rate(self, before, depth_before, pressure, gap, depth, inside, places):
        """q with K q = 1 on the set, and K q − 1 everywhere.

        Starts from the combination of the last q and the two pressures that is nearest in energy.
        """
        deflections = [before.rate_gap + 1, gap - self.gap + depth, before.gap - self.gap + depth_before]
        loads = [before.rate, pressure, before.pressure]
        if np.any(before.rate[~inside]):  # an element was lost, within the tolerance: what loaded it is of no use
            loads, deflections = [pressure], deflections[1:2]
        on_set = np.array([load[places] for load in loads])
        energy = on_set @ np.array([w[places] for w in deflections]).T
        scale = 1 / np.sqrt(np.maximum(np.diag(energy), np.finfo(float).tiny))
        weights = scale * np.linalg.lstsq(scale[:, None] * energy * scale, scale * on_set.sum(axis=1), rcond=1e-10)[0]
        rate = sum(c * load for c, load in zip(weights, loads, strict=True))
        rate_gap = sum(c * w for c, w in zip(weights, deflections, strict=True)) - 1
        self.punch(inside, rate, rate_gap, min(_RATE_TOLERANCE, np.sqrt(self.tolerance)))
        return rate, rate_gap

    def punch(self, inside, rate, rate_gap, tolerance):
        """Solve K q = 1 on a set to the given residual, in place, from a start that vanishes outside the set.

        rate, rate_gap : q and K q − 1, flat with border. Returns Σq, corrected to second order by the residual.
        """
        places = self._search(rate, rate_gap, inside, max(tolerance, _SINGLE), bounded=False)
        if tolerance < _SINGLE:
            rate_gap[:] = self._deflection(rate) - 1
            self._search(rate, rate_gap, inside, tolerance, bounded=False)
        return rate[places].sum() - rate[places] @ rate_gap[places]

    def _search(self, pressure, gap, inside, limit, *, bounded):
        """Pressure on the set such that |e| on it is below the limit; the places of the set.

        bounded : P ≥ 0, and no penetration beyond the limit outside the set, which changes to that end.
        Changes pressure, gap and set in place.
        """
        rows, columns = self._halfspace.shape
        load = self._halfspace.load
        direction, stride = load.ravel(), load.shape[1]
        changed, releases = True, 0
        for _ in range(_ITERATIONS):
            if changed:
                places, slots = self._members(inside)
                largest, tension = _state(pressure, gap, places)
            if largest <= limit and not (bounded and tension):
                return places
            if changed:
                if not np.array_equal(places, self._inverse.places):
                    self._inverse.prepare(inside, places)
                load[:] = 0
                last = np.inf
            search = self._inverse.apply(gap)
            norm = search @ gap[places]  # both with the opposite sign: the residual is −e
            _turn(direction, search, norm / last, slots)
            length = _LENGTH * 0.5 ** (releases // _PATIENCE)
            if bounded and _pulls(length, direction, pressure, places, slots):
                of_set = inside, places, slots, preconditioner.relief(), self._width, stride
                _step_and_release(length, direction, pressure, *of_set)
                self._interior(gap)[:] += self._halfspace.apply()[:, :columns]
                changed, releases = True, releases + 1
            else:
                deflection = self._halfspace.apply().ravel()
                length = norm / _product(direction, deflection, slots)
                of_set = places, slots, rows, columns, stride
                largest, tension = _step(length, direction, deflection, pressure, gap, *of_set)
                changed, last = False, norm
            if bounded:
                changed = _admit(gap, inside, limit) > 0 or changed
        raise ConvergenceError(
            f"contact of {places.size} elements: the residual {largest:.1e} does not fall below {limit:.1e} "
            f"in {_ITERATIONS} steps; choose a larger tolerance"
        )

    def _members(self, inside):
        """Places in the bordered arrays, and in the operator's load, of the elements of the set."""
        places = np.flatnonzero(inside)
        row, column = np.divmod(places, self._width)
        return places, (row - REACH) * self._halfspace.load.shape[1] + column - REACH

    def _deflection(self, pressure):
        """K P on the flat grid, in double precision where the tolerance needs it; its border is zero."""
        self._exact.load[:] = 0
        self._exact.load[:, : self._width - 2 * REACH] = self._interior(pressure)
        deflection = np.zeros_like(pressure)
        self._interior(deflection)[:] = self._exact.apply()[:, : self._width - 2 * REACH]
        return deflection

    def _interior(self, field):
        """View of a flat field without its border, in rows and columns."""
        return field.reshape(-1, self._width)[REACH:-REACH, REACH:-REACH]
