"""Contact on the grid by preconditioned conjugate gradients on a contact set that shrinks to its solution.

The set to start from is the last contact set with everything that the predictor P + Δu q makes penetrate. It
contains the solution's: between the two depths the true rate of deflection is that of a larger punch, so the
surface sinks further than predicted. Elements that come under tension leave it. Along a search direction d the
deflection K d is known on the whole grid, so the gap is, too, everywhere and at no further cost.

Arrays of the grid are flat, with a border of one element, so that neighbours need no special cases.
"""

from dataclasses import dataclass

import numba
import numpy as np

from viscorough.curve import ConvergenceError

# The residual is lowered by this factor between revisions of the contact set (measured: 0.1 to 0.3 are alike).
_REVISE = 0.2
# Relative residual of q. Force and stiffness are corrected to second order, so its square is what counts.
_RATE_TOLERANCE = 1e-2
_ITERATIONS, _REVISIONS = 2000, 200
# Gap where there is no element; finite, since differences of gaps are taken.
_OUTSIDE = 1e300


@dataclass(frozen=True)
class Fields:
    """Contact on the grid, flat with border: P, gap e = w − u + g, q, and e_q = K q − 1; `place` of every rank."""

    pressure: np.ndarray
    gap: np.ndarray
    rate: np.ndarray
    rate_gap: np.ndarray
    place: np.ndarray

    def gap_at(self, ranks):
        """Gap e between the surfaces at the elements of given rank."""
        return self.gap[self.place[ranks]]


@numba.njit(cache=True, fastmath=True)
def _product(left, right, slots):
    """Σ left·right over the contact set, for arrays laid out as the operator's load."""
    total = 0.0
    for t in range(slots.size):
        total += left[slots[t]] * right[slots[t]]
    return total


@numba.njit(cache=True, fastmath=True)
def _step(length, direction, deflection, pressure, gap, places, slots, rows, columns, stride):
    """P += α d on the set, e += α K d everywhere; returns largest |e| on the set and whether any P is negative."""
    for i in range(rows):
        a, b = (i + 1) * (columns + 2) + 1, i * stride
        for j in range(columns):
            gap[a + j] += length * deflection[b + j]
    largest, lowest = 0.0, 0.0
    for t in range(places.size):
        i = places[t]
        pressure[i] += length * direction[slots[t]]
        largest = max(largest, abs(gap[i]))
        lowest = min(lowest, pressure[i])
    return largest, lowest < 0


@numba.njit(cache=True, fastmath=True)
def _precondition(gap, inside, places, stencil, width, result):
    """z = M r with r = −e on the set and M the 3 × 3 centre of K⁻¹, cut to the set; returns r·z."""
    centre, edge, corner = stencil[1, 1], stencil[0, 1], stencil[0, 0]
    total = 0.0
    for t in range(places.size):
        i = places[t]
        n, s = i - width, i + width
        value = centre * gap[i]
        near = 0.0
        if inside[i - 1]:
            near += gap[i - 1]
        if inside[i + 1]:
            near += gap[i + 1]
        if inside[n]:
            near += gap[n]
        if inside[s]:
            near += gap[s]
        far = 0.0
        if inside[n - 1]:
            far += gap[n - 1]
        if inside[n + 1]:
            far += gap[n + 1]
        if inside[s - 1]:
            far += gap[s - 1]
        if inside[s + 1]:
            far += gap[s + 1]
        value += edge * near + corner * far
        result[t] = -value
        total += gap[i] * value
    return total


@numba.njit(cache=True, fastmath=True)
def _turn(direction, result, factor, slots):
    """d = z + β d on the set."""
    for t in range(slots.size):
        direction[slots[t]] = result[t] + factor * direction[slots[t]]


@numba.njit(cache=True)
def _release(pressure, load, inside, places, slots, stencil, width, stride):
    """Elements under tension leave the set; the change of pressure is added to the load.

    Taking away a pull p < 0 lifts its neighbours off. That takes as much pressure from them as eliminating the element
    from the stencil does: P += −p M_near/M_centre, which saves iterations. None of it may make them pull.
    """
    for t in range(places.size):
        if pressure[places[t]] < 0:
            inside[places[t]] = False
    for t in range(places.size):
        i = places[t]
        if inside[i]:
            continue
        pull = pressure[i]
        load[slots[t]] -= pull
        pressure[i] = 0.0
        for row in range(-1, 2):
            for column in range(-1, 2):
                near = i + row * width + column
                if inside[near]:
                    change = -pull * stencil[row + 1, column + 1] / stencil[1, 1]
                    change = max(change, -0.5 * pressure[near])
                    pressure[near] += change
                    load[slots[t] + row * stride + column] += change


@numba.njit(cache=True)
def _admit(gap, inside, limit):
    """Elements that penetrate by more than `limit` join the set; returns how many."""
    joined = 0
    for i in range(gap.size):
        if gap[i] < -limit and not inside[i]:
            inside[i] = True
            joined += 1
    return joined


class GridSolver:
    """Contact of the elements at (row, column), in the order of increasing gap, on the grid of a Halfspace."""

    def __init__(self, halfspace, row, column, gap, tolerance):
        self.halfspace = halfspace
        self.tolerance = tolerance
        rows, columns = halfspace.shape
        self._width = columns + 2
        self._place = (row + 1) * self._width + column + 1
        self.gap = np.full((rows + 2) * self._width, _OUTSIDE)
        self.gap[self._place] = gap
        self._stencil = halfspace.inverse_stencil()
        self._result = np.empty(gap.size)

    def fields(self, contact):
        """The grid's fields of a dense solution; costs two operators."""
        place = self._place[contact.members]
        pressure, rate = np.zeros_like(self.gap), np.zeros_like(self.gap)
        pressure[place], rate[place] = contact.pressure, contact.rate
        gap = self.gap - contact.depth
        rate_gap = np.full_like(gap, -1.0)
        if contact.count:
            self._add_deflection(pressure, gap)
            self._add_deflection(rate, rate_gap)
        return Fields(pressure, gap, rate, rate_gap, self._place)

    def solve(self, contact, depth):
        """The contact at a larger depth; the entries of a contact.Contact. Raises ConvergenceError."""
        before, advance = contact.fields, depth - contact.depth
        pressure = before.pressure + advance * before.rate
        gap = before.gap + advance * before.rate_gap
        inside = pressure > 0
        limit = self.tolerance * depth

        _admit(gap, inside, 0.0)
        for _ in range(_REVISIONS):
            places, slots = self._members(inside)
            tension = self._descend(pressure, gap, inside, places, slots, limit, _REVISE)
            if tension:
                self.halfspace.load[:] = 0
                load = self.halfspace.load
                _release(pressure, load.ravel(), inside, places, slots, self._stencil, self._width, load.shape[1])
                self._add(self.halfspace.apply(), gap)
                places = places[inside[places]]
            joined = _admit(gap, inside, limit)
            if joined == 0 and np.abs(gap[places]).max() <= limit:
                break
        else:
            raise ConvergenceError(
                f"contact at depth {depth:g}: the set of {places.size} elements does not settle in {_REVISIONS} "
                "revisions; choose another tolerance"
            )

        rate, rate_gap = self._rate(before, contact.depth, pressure, gap, depth, inside, places, slots)
        left = gap[places]
        ranks = np.flatnonzero(inside[self._place])
        on_set = self._place[ranks]
        return (
            depth,
            ranks,
            pressure[on_set],
            rate[on_set],
            pressure[places].sum() - rate[places] @ left,
            rate[places].sum() - rate[places] @ rate_gap[places],
            max(np.abs(left).max(), -gap.min()) / depth,
            Fields(pressure, gap, rate, rate_gap, self._place),
        )

    def _rate(self, before, depth_before, pressure, gap, depth, inside, places, slots):
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
        self.punch(inside, rate, rate_gap, _RATE_TOLERANCE)
        return rate, rate_gap

    def punch(self, inside, rate, rate_gap, tolerance):
        """Solve K q = 1 on a set to the given residual, in place, from a start that vanishes outside the set.

        rate, rate_gap : q and K q − 1, flat with border. Returns Σq, corrected to second order by the residual.
        """
        places, slots = self._members(inside)
        self._descend(rate, rate_gap, inside, places, slots, tolerance, 0.0)
        return rate[places].sum() - rate[places] @ rate_gap[places]

    def _descend(self, pressure, gap, inside, places, slots, limit, factor):
        """Conjugate gradients until max |e| on the set is below `limit`, or `factor` of its start.

        Changes pressure on the set and gap everywhere; returns whether any pressure is negative.
        """
        largest = np.abs(gap[places]).max()
        tension = bool((pressure[places] < 0).any())
        goal = max(limit, factor * largest)
        if largest <= limit:
            return tension
        rows, columns = self.halfspace.shape
        load = self.halfspace.load
        load[:] = 0
        direction, stride = load.ravel(), load.shape[1]
        norm = _precondition(gap, inside, places, self._stencil, self._width, self._result)
        change = 0.0
        for _ in range(_ITERATIONS):
            _turn(direction, self._result, change, slots)
            deflection = self.halfspace.apply().ravel()
            length = norm / _product(direction, deflection, slots)
            largest, tension = _step(length, direction, deflection, pressure, gap, places, slots, rows, columns, stride)
            if largest <= goal:
                return tension
            last, norm = norm, _precondition(gap, inside, places, self._stencil, self._width, self._result)
            change = norm / last
        raise ConvergenceError(
            f"contact of {places.size} elements: the residual {largest:.1e} does not fall below {goal:.1e} "
            f"in {_ITERATIONS} iterations; choose a larger tolerance"
        )

    def _members(self, inside):
        """Places in the bordered arrays, and in the operator's load, of the elements of the set."""
        places = np.flatnonzero(inside)
        row, column = np.divmod(places, self._width)
        return places, (row - 1) * self.halfspace.load.shape[1] + column - 1

    def _add_deflection(self, pressure, gap):
        rows, columns = self.halfspace.shape
        self.halfspace.load[:] = 0
        self.halfspace.load[:, :columns] = pressure.reshape(rows + 2, columns + 2)[1:-1, 1:-1]
        self._add(self.halfspace.apply(), gap)

    def _add(self, deflection, gap):
        rows, columns = self.halfspace.shape
        gap.reshape(rows + 2, columns + 2)[1:-1, 1:-1] += deflection[:, :columns]
