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

from viscorough.compilation import njit
from viscorough.contact import preconditioner
from viscorough.contact.halfspace import Halfspace
from viscorough.contact.preconditioner import REACH
from viscorough.errors import ConvergenceError

# Length of the steps in which elements leave (measured: 0.9 to 1.2 are alike), halved every so many of them, which
# ends what a set that the preconditioner suits badly might begin. Usually there are about ten.
_LENGTH, _PATIENCE = 1.0, 20
# Largest relative error of q in energy, the square of which is that of the stiffness. No eigenvalue of the
# preconditioned operator is smaller than the second number (tests/test_preconditioner.py).
_RATE_TOLERANCE, _LEAST_EIGENVALUE = 1e-2, 0.35
# Rounding of K q − 1 that is allowed, over the tolerance. Of it the stiffness has the mean, a tenth or less (measured).
_RATE_ROUNDING = 5.0
# Numbers of the search; the largest error of an operator by rounding, over the largest deflection, in units of theirs
# (measured: up to 3.4 on 1025 × 1025); the tolerance below which gaps are computed anew in double precision.
_PRECISION, _ROUNDING, _SINGLE = np.float32, 5.0, 1e-4
_ITERATIONS = 2000
# Gap where there is no element; finite, since differences of gaps are taken.
_OUTSIDE = 1e300


@dataclass(frozen=True)
class Fields:
    """Contact on the grid, flat with border: P, gap e = w − u + g, q, and e_q = K q − 1; `place` of ranks.

    rounding, rate_rounding : bounds of what rounding in single precision makes of errors of e and e_q
    """

    pressure: np.ndarray
    gap: np.ndarray
    rate: np.ndarray
    rate_gap: np.ndarray
    place: np.ndarray
    rounding: float
    rate_rounding: float

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


@njit
def _predict(advance, pressure, rate, gap, rate_gap):
    """P + Δu q and e + Δu e_q everywhere."""
    predicted, opening = np.empty_like(pressure), np.empty_like(gap)
    for i in range(gap.size):
        predicted[i], opening[i] = pressure[i] + advance * rate[i], gap[i] + advance * rate_gap[i]
    return predicted, opening


@njit
def _combine(now, last, steady, lift, pressure, gap, pressure_before, gap_before, rate_before, rate_gap_before, free):
    """A combination of two pressures and a rate as q, and K q − 1, everywhere; deflections are gaps without `free`."""
    rate, rate_gap = np.empty_like(pressure), np.empty_like(gap)
    for i in range(gap.size):
        rate[i] = now * pressure[i] + last * pressure_before[i] + steady * rate_before[i]
        deflection = now * (gap[i] - free[i]) + last * (gap_before[i] - free[i])
        rate_gap[i] = deflection + steady * rate_gap_before[i] + lift
    return rate, rate_gap


@njit(fastmath=True)
def _open(length, deflection, gap):
    """e += α K d everywhere."""
    rows, columns = deflection.shape
    for i in range(rows):
        start = (i + REACH) * (columns + 2 * REACH) + REACH
        for j in range(columns):
            gap[start + j] += length * deflection[i, j]


@njit(fastmath=True)
def _step(length, direction, pressure, gap, places, slots):
    """P += α d on the set; returns largest |e| on the set and whether any P is negative."""
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
    small; where it is not small beside the tolerance, gaps are computed anew from the pressures in double precision.
    """

    def __init__(self, box, row, column, gap, tolerance):
        self.tolerance = tolerance
        top, left, rows, columns = box
        self._halfspace = Halfspace(rows, columns, _PRECISION)
        self._exact = Halfspace(rows, columns) if tolerance < _SINGLE else self._halfspace
        self._rounding, self._exact_rounding = (
            _ROUNDING * np.finfo(each.load.dtype).eps for each in (self._halfspace, self._exact)
        )
        self._width = columns + 2 * REACH
        in_box = (row >= top) & (row < top + rows) & (column >= left) & (column < left + columns)
        self._ranks = np.flatnonzero(in_box)
        self.place = np.where(in_box, (row - top + REACH) * self._width + column - left + REACH, 0).astype(int)
        self.gap = np.full((rows + 2 * REACH) * self._width, _OUTSIDE)
        self.gap[self.place[self._ranks]] = gap[self._ranks]
        # Where each place of the flat grid is in the operator's load.
        starts = np.arange(-REACH, rows + REACH, dtype=np.int32) * self._halfspace.load.shape[1]
        self._slot = np.add.outer(starts, np.arange(-REACH, columns + REACH, dtype=np.int32)).ravel()
        self._inverse = preconditioner.Preconditioner(rows + 2 * REACH, self._width)

    @property
    def operator_applications(self):
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
        rounding = self._exact_rounding
        return Fields(pressure, gap, rate, rate_gap, self.place, rounding * contact.depth, rounding)

    def solve(self, contact, depth):
        """The contact at a larger depth; the entries of a contact.Contact. Raises ConvergenceError."""
        before, advance = contact.fields, depth - contact.depth
        pressure, gap = _predict(advance, before.pressure, before.rate, before.gap, before.rate_gap)
        inside = pressure > 0
        rounding = before.rounding + advance * before.rate_rounding

        def anew():
            return self._deflection(pressure) + self.gap - depth, self._exact_rounding * depth

        limit = 0.999 * self.tolerance * depth  # so that the sum of residual and rounding is within the tolerance
        _admit(gap, inside, 0.0)
        places, rounding = self._search(pressure, gap, inside, limit, rounding, anew)
        rate, rate_gap, rate_rounding = self._rate(
            before, contact.depth, pressure, gap, rounding, depth, inside, places
        )
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
            (max(np.abs(left).max(), -gap.min()) + rounding) / depth,
            Fields(pressure, gap, rate, rate_gap, self.place, rounding, rate_rounding),
        )

    def _rate(self, before, depth_before, pressure, gap, rounding, depth, inside, places):
        """q with K q = 1 on the set, K q − 1 everywhere, and the bound of its rounding; `rounding` is that of the gaps.

        Starts from the combination of the last q and the two pressures that is nearest in energy.
        """
        free = self.gap[places]
        loads = np.array([pressure[places], before.pressure[places], before.rate[places]])
        gaps = np.array(
            [gap[places] - free + depth, before.gap[places] - free + depth_before, before.rate_gap[places] + 1]
        )
        if np.count_nonzero(loads[2]) < np.count_nonzero(before.rate):
            loads, gaps = loads[:1], gaps[:1]  # an element was lost, within the tolerance: what loaded it is of no use
        energy = loads @ gaps.T
        scale = 1 / np.sqrt(np.maximum(np.diag(energy), np.finfo(float).tiny))
        weights = scale * np.linalg.lstsq(scale[:, None] * energy * scale, scale * loads.sum(axis=1), rcond=1e-10)[0]
        now, last, steady = *weights, *[0.0] * (3 - weights.size)
        lift = now * depth + last * depth_before + steady - 1
        of_before = before.pressure, before.gap, before.rate, before.rate_gap
        rate, rate_gap = _combine(now, last, steady, lift, pressure, gap, *of_before, self.gap)
        # These gaps have the errors of the last gaps and rates, too, which cancel in part; but not if computed anew.
        advance = depth - depth_before
        added = rounding - before.rounding - advance * before.rate_rounding
        if added >= 0:
            rounding = abs(now + last) * before.rounding + abs(now * advance + steady) * before.rate_rounding
            rounding += abs(now) * added
        else:
            rounding = abs(now) * rounding + abs(last) * before.rounding + abs(steady) * before.rate_rounding
        return rate, rate_gap, self._punch(inside, places, rate, rate_gap, rounding)

    def punch(self, inside, rate, rate_gap):
        """Solve K q = 1 on a set, in place, from a start that vanishes outside the set; Σq is exact to the tolerance.

        rate, rate_gap : q and K q − 1, flat with border. Returns Σq.
        """
        places, _ = self._members(inside)
        self._punch(inside, places, rate, rate_gap, np.inf)  # how often the start was carried on is not known here
        return rate[places].sum() - rate[places] @ rate_gap[places]

    def _punch(self, inside, places, rate, rate_gap, rounding):
        """The same by conjugate gradients, from a start with this bound for its rounding; returns that of the end."""
        tolerance = min(_RATE_TOLERANCE, np.sqrt(self.tolerance))
        slots = self._slot[places]
        direction, last = self._restart(inside, places), np.inf
        largest, _ = _state(rate, rate_gap, places)
        for _ in range(_ITERATIONS):
            search = self._inverse.apply(rate_gap)
            norm = search @ rate_gap[places]
            # The error of Σq is eᵀK⁻¹e, of which the preconditioner gives nearly as much or more.
            total = rate[places].sum()
            error = np.sqrt(norm / (_LEAST_EIGENVALUE * total)) if total > 0 else np.inf
            if error <= tolerance:
                if rounding <= max(_RATE_ROUNDING * self.tolerance, self._exact_rounding):
                    return rounding
                rate_gap[:], rounding = self._deflection(rate) - 1, self._exact_rounding
                direction, last = self._restart(inside, places), np.inf
                continue
            _turn(direction, search, norm / last, slots)
            rounding, last = rounding + self._rounding * largest, norm
            largest, _ = self._step(norm, rate, rate_gap, places, slots)
        raise self._diverged(places, error, tolerance)

    def _search(self, pressure, gap, inside, limit, rounding, anew):
        """Pressure P ≥ 0 with |e| on the set below the limit, and no penetration beyond it elsewhere.

        Changes pressure, gap and set in place. rounding : bound for that of e; anew : function that computes e anew and
        returns it with its rounding. Returns the places of the set, and the rounding of e.
        """
        columns, stride = self._halfspace.shape[1], self._halfspace.load.shape[1]
        changed, releases = True, 0
        for _ in range(_ITERATIONS):
            if changed:
                places, slots = self._members(inside)
                largest, tension = _state(pressure, gap, places)
            # Rounding takes its part of the limit. Where that is most of it, gaps are computed anew as soon as they are
            # no larger than it.
            close_enough = max(limit - rounding, rounding)
            if largest <= close_enough and not tension:
                if rounding <= 0.5 * limit:
                    return places, rounding
                gap[:], rounding = anew()
                _admit(gap, inside, limit)
                changed = True
                continue
            if changed:
                direction, last = self._restart(inside, places), np.inf
            search = self._inverse.apply(gap)
            norm = search @ gap[places]  # both with the opposite sign: the residual is −e
            _turn(direction, search, norm / last, slots)
            rounding, last = rounding + self._rounding * largest, norm
            length = _LENGTH * 0.5 ** (releases // _PATIENCE)
            changed = _pulls(length, direction, pressure, places, slots)
            if changed:
                of_set = inside, places, slots, preconditioner.relief(), self._width, stride
                _step_and_release(length, direction, pressure, *of_set)
                _open(1.0, self._halfspace.apply()[:, :columns], gap)
                releases += 1
            else:
                largest, tension = self._step(norm, pressure, gap, places, slots)
            changed = _admit(gap, inside, close_enough) > 0 or changed
        raise self._diverged(places, largest, limit)

    def _restart(self, inside, places):
        """Direction of conjugate gradients, to begin with none, with the preconditioner of the set."""
        if not np.array_equal(places, self._inverse.places):
            self._inverse.prepare(inside, places)
        self._halfspace.load[:] = 0
        return self._halfspace.load.ravel()

    def _step(self, norm, pressure, gap, places, slots):
        """A step of conjugate gradients; returns largest |e| on the set and whether any P is negative."""
        direction, deflection = self._halfspace.load.ravel(), self._halfspace.apply()
        length = norm / _product(direction, deflection.ravel(), slots)
        _open(length, deflection[:, : self._halfspace.shape[1]], gap)
        return _step(length, direction, pressure, gap, places, slots)

    def _diverged(self, places, residual, limit):
        return ConvergenceError(
            f"contact of {places.size} elements: the residual {residual:.1e} does not fall below {limit:.1e} "
            f"in {_ITERATIONS} steps; choose a larger tolerance"
        )

    def _members(self, inside):
        """Places in the bordered arrays, and in the operator's load, of the elements of the set."""
        places = np.flatnonzero(inside)
        return places, self._slot[places]

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
