"""Loop over flat fields with a border, or over the places of a contact set, for the grid solver.

Compiled functions take plain arrays, hence their many arguments: they accept neither keyword-only arguments nor the
types of `state`, whose symbols are used here. Arrays that are divided into blocks come last (loops.GridLoops.each).
Fields are changed in place only where the docstring says so.
"""

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.contact.preconditioner.multilevel import REACH

# Avoids a division by zero.
_TINY = 1e-30


@njit(fastmath=True)
def inner_product(left, right, slots):
    """Return Σ left·right over the contact set in double precision, for arrays laid out as the operator's load."""
    total = 0.0
    for t in range(slots.size):
        total += np.float64(left[slots[t]]) * np.float64(right[slots[t]])
    return total


@njit
def total(field, places):
    """Return the sum of a field over places, in double precision."""
    result = 0.0
    for t in range(places.size):
        result += np.float64(field[places[t]])
    return result


@njit
def gap_on_set(gap_change, initial_gap, gap, places):
    """Store e on the set in the flat field `gap`; return the largest |e| there."""
    largest = 0.0
    for t in range(places.size):
        i = places[t]
        value = gap_change[i] + initial_gap[i]
        gap[i] = value
        largest = max(largest, abs(value))
    return largest


@njit
def gather_on_set(field, gathered, places):
    """Store a field on the set in the flat field `gathered`; return its largest magnitude there."""
    largest = 0.0
    for t in range(places.size):
        gathered[places[t]] = field[places[t]]
        largest = max(largest, abs(field[places[t]]))
    return largest


@njit
def shift_on_set(depth_step, gap, preconditioned, places, response):
    """Compute e −= Δu and z −= Δu M 1 on the set, in place."""
    for t in range(places.size):
        gap[places[t]] -= depth_step
        preconditioned[places[t]] -= depth_step * response[t]


@njit(fastmath=True)
def energies(
    depths, pressure, gap_change, last_pressure, last_gap_change, last_tangent, last_tangent_gap, places
):  # fmt: skip
    """Return inner products over a contact set: P, last P and last q with the deflections of each, and with 1.

    depths : of the two pressures, the last one second

    The deflections are K P = (e − g) + u and K q = e_q + 1. Returns arrays of shapes (3, 3) and (3,).
    """
    a = b = c = aa = ab = ac = ba = bb = bc = ca = cb = cc = 0.0
    for t in range(places.size):
        i = places[t]
        load, last, tangent = np.float64(pressure[i]), np.float64(last_pressure[i]), np.float64(last_tangent[i])
        by_load, by_last = gap_change[i] + depths[0], last_gap_change[i] + depths[1]
        by_tangent = last_tangent_gap[i] + 1.0
        a, b, c = a + load, b + last, c + tangent
        aa, ab, ac = aa + load * by_load, ab + load * by_last, ac + load * by_tangent
        ba, bb, bc = ba + last * by_load, bb + last * by_last, bc + last * by_tangent
        ca, cb, cc = ca + tangent * by_load, cb + tangent * by_last, cc + tangent * by_tangent
    return np.array([[aa, ab, ac], [ba, bb, bc], [ca, cb, cc]]), np.array([a, b, c])


@njit
def predict(
    depth_step, early_step, predicted, predicted_change, inside, pressure, tangent, gap_change, tangent_gap, initial_gap
):  # fmt: skip
    """Store P + Δu q in `predicted`, e − g + Δu e_q in `predicted_change`, and the first contact set in `inside`.

    early_step : step of the depth within which elements that are in the first set touch

    Elements under tension are inside, too; they leave later.
    """
    for i in range(pressure.size):
        predicted[i] = pressure[i] + depth_step * tangent[i]
        touches = gap_change[i] + early_step * tangent_gap[i] + initial_gap[i] < 0
        inside[i] = touches | (predicted[i] != 0)
        predicted_change[i] = gap_change[i] + depth_step * tangent_gap[i]


@njit
def combine(
    weights, shift, tangent, tangent_gap,
    pressure, gap_change, last_pressure, last_gap_change, last_tangent, last_tangent_gap,
):  # fmt: skip
    """Store q as a combination of two pressures and a tangent in `tangent`, and K q − 1 in `tangent_gap`.

    weights : of the pressure, of the last pressure and of the last tangent
    shift : constant part of K q − 1, from K P = (e − g) + u for both pressures and K q = e_q + 1 for the last tangent
    """
    pressure_weight, last_pressure_weight, tangent_weight = weights
    for i in range(pressure.size):
        tangent[i] = (
            pressure_weight * pressure[i] + last_pressure_weight * last_pressure[i] + tangent_weight * last_tangent[i]
        )
        deflection = pressure_weight * gap_change[i] + last_pressure_weight * last_gap_change[i]
        tangent_gap[i] = deflection + tangent_weight * last_tangent_gap[i] + shift


@njit(fastmath=True)
def update_gap(length, deflection, gap):
    """Add α K d to e − g, or to e_q, everywhere, in place."""
    rows, columns = deflection.shape
    for i in range(rows):
        start = (i + REACH) * (columns + 2 * REACH) + REACH
        for j in range(columns):
            gap[start + j] += length * deflection[i, j]


@njit(fastmath=True)
def update_pressure(length, direction, pressure, places, slots):
    """Add α d to P on the set, in place; return True if any pressure is negative."""
    lowest = 0.0
    for t in range(places.size):
        i = places[t]
        pressure[i] += length * direction[slots[t]]
        lowest = min(lowest, pressure[i])
    return lowest < 0


@njit(fastmath=True)
def update_search_direction(direction, preconditioned, factor, places, slots):
    """Compute d = β d − z on the set, in place, with z the preconditioned residual, a flat field."""
    for t in range(slots.size):
        direction[slots[t]] = factor * direction[slots[t]] - preconditioned[places[t]]


@njit(fastmath=True)
def direction_sums(direction, deflection, preconditioned, gap, places, slots):
    """Return z·Kd, d·e and d·Kd over the set.

    direction, deflection : d and K d, laid out like the load of the operator
    preconditioned, gap : z and e, flat fields
    """
    by_preconditioned = by_gap = by_direction = 0.0
    for t in range(slots.size):
        change, by_change = np.float64(direction[slots[t]]), np.float64(deflection[slots[t]])
        by_preconditioned += preconditioned[places[t]] * by_change
        by_gap += change * gap[places[t]]
        by_direction += change * by_change
    return np.array([by_preconditioned, by_gap, by_direction])


@njit
def unloaded_under_tension(direction, pressure, places, slots):
    """Return places of elements without pressure that a step along the direction would put under tension."""
    found, count = np.empty(places.size, places.dtype), 0
    for t in range(places.size):
        found[count] = places[t]  # overwritten unless it is one, which takes less time than a branch
        count += (pressure[places[t]] == 0) & (direction[slots[t]] < 0)
    return found[:count]


@njit
def step_causes_tension(length, direction, pressure, places, slots):
    """Return True if a step of that length would put any element under tension."""
    for t in range(places.size):
        stepped = pressure[places[t]] + length * direction[slots[t]]
        if stepped < 0:
            return True
    return False


@njit
def step_and_find_tension(length, direction, pressure, inside, places, slots, first):
    """Add α d to P, replace d by α d, and mark elements under tension as outside; all in place.

    first : index of the first of these places in the set

    Returns the indices in the set of the elements under tension.
    """
    released, count = np.empty(places.size, np.int64), 0
    for t in range(places.size):
        i, change = places[t], direction[slots[t]] * length
        direction[slots[t]] = change
        pressure[i] += change
        inside[i] = pressure[i] >= 0
        released[count] = first + t  # overwritten unless under tension, which takes less time than a branch
        count += not inside[i]
    return released[:count]


@njit
def release(direction, pressure, inside, places, slots, released, stencil, width, stride):
    """Let elements under tension leave the set; the direction becomes the total change of pressure; all in place.

    When an element under tension leaves, the load of its neighbours changes. They take the change that eliminating the
    element from the influence matrix would give, which saves iterations, but lose at most half of their pressure.

    released : indices of these elements in the set
    stencil : preconditioner.load_redistribution_stencil
    width : length of a row of flat fields
    stride : length of a row of the load array
    """
    for t in released:
        i = places[t]
        tension = pressure[i]
        direction[slots[t]] -= tension
        pressure[i] = 0.0
        for row in range(-1, 2):
            for column in range(-1, 2):
                near = i + row * width + column
                if inside[near]:
                    change = max(tension * stencil[row + 1, column + 1], -0.5 * pressure[near])
                    pressure[near] += change
                    direction[slots[t] + row * stride + column] += change


@njit
def add_penetrating_elements(limit, gap_change, initial_gap, inside):
    """Let elements that overlap the surface by more than `limit` join the set, in place; return their number."""
    joined = 0
    for i in range(gap_change.size):
        if gap_change[i] + initial_gap[i] < -limit and not inside[i]:
            inside[i] = True
            joined += 1
    return joined


@njit
def has_open_gap(limit, gap_change, initial_gap, places):
    """Return True if the gap at any of the places is larger than `limit`; the last places are searched first."""
    for t in range(places.size - 1, -1, -1):
        i = places[t]
        if gap_change[i] + initial_gap[i] > limit:
            return True
    return False


@njit
def touch_sums(gap_change, initial_gap, tangent_gap, width, share, places, pressure, tangent):
    """Return sums over elements that join the contact in a step of the depth, of functions of their touch.

    An element touches at the share t = max(−e/e_q, Δu − P/q)/Δu of the step, limited to 0 to 1, with e and e_q before
    the step and P and q after it.

    gap_change, initial_gap, tangent_gap : flat fields before the step; places : of the elements in them
    pressure, tangent : of the elements after the step
    width : Δu
    share : shares s of the step

    Returns Σe_q², Σe_q² (1 − t) and, for every s, Σe_q² max(s − t, 0).
    """
    sums = np.zeros(2 + share.size)
    for n in range(places.size):
        i = places[n]
        slope = min(np.float64(tangent_gap[i]), -_TINY)
        gap = max(gap_change[i] + initial_gap[i], 0.0)
        touch = max(-gap / slope, width - pressure[n] / max(tangent[n], _TINY)) / width
        touch = min(max(touch, 0.0), 1.0)
        sums[0] += slope * slope
        sums[1] += slope * slope * (1.0 - touch)
        for k in range(share.size):
            sums[2 + k] += slope * slope * max(share[k] - touch, 0.0)
    return sums
