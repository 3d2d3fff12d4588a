"""Run compiled loops of the grid solver over whole flat fields, or over the elements of a contact set.

Flat fields are the arrays of the grid with a border. `places` are indices of elements in flat fields. `slots` are
indices of the same elements in the flattened load array of the half-space operator, which has no border. Symbols are
defined in contact.state.

The functions have many arguments, since compiled code accepts neither keyword-only arguments nor the types of
contact.state. Call them by keyword: most arguments are arrays of the same type, so swapped arrays raise no error. An
argument is changed in place only if the docstring says so.
"""

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.contact.border import BORDER

# Smallest divisor, to avoid a division by zero.
_TINY = 1e-30


@njit(fastmath=True)
def inner_product(left, right, slots):
    """Return Σ left·right over the contact set, in double precision.

    left, right : two arrays
    slots : indices of the elements of the contact set in both arrays
    """
    total = 0.0
    for t in range(slots.size):
        total += np.float64(left[slots[t]]) * np.float64(right[slots[t]])
    return total


@njit
def total(field, places):
    """Return the sum of a flat field over the elements at `places`, in double precision."""
    result = 0.0
    for t in range(places.size):
        result += np.float64(field[places[t]])
    return result


@njit
def gap_on_set(gap_change, initial_gap, gap, places):
    """Compute the gap e = (e − g) + g at `places` and store it in the flat field `gap`; return the largest |e|.

    gap_change, initial_gap : e − g and g, flat fields
    """
    largest = 0.0
    for t in range(places.size):
        i = places[t]
        value = gap_change[i] + initial_gap[i]
        gap[i] = value
        largest = max(largest, abs(value))
    return largest


@njit
def gather_on_set(field, gathered, places):
    """Copy a flat field at `places` to the flat field `gathered`; return the largest magnitude of the copied values."""
    largest = 0.0
    for t in range(places.size):
        gathered[places[t]] = field[places[t]]
        largest = max(largest, abs(field[places[t]]))
    return largest


@njit
def shift_on_set(depth_step, gap, preconditioned, places, response):
    """Update the gap e and the preconditioned residual z = M e at `places` after the depth has grown by Δu, in place.

    Δu is subtracted from e, and Δu M 1 from z. M 1 is the product of the preconditioner M with a vector of ones.

    depth_step : Δu
    gap, preconditioned : e and z, flat fields
    response : M 1 at `places`
    """
    for t in range(places.size):
        gap[places[t]] -= depth_step
        preconditioned[places[t]] -= depth_step * response[t]


@njit(fastmath=True)
def energies(
    depths, pressure, gap_change, last_pressure, last_gap_change, last_tangent, last_tangent_gap, places
):  # fmt: skip
    """Return the inner products of three loads with the three deflections by these loads, and the sum of each load.

    The loads are the pressure P of a contact, and the pressure P' and the tangent q' of the last contact before it. The
    deflections are K P = (e − g) + u, K P' = (e' − g) + u' and K q' = e_q' + 1. All sums are over the elements at
    `places`.

    depths : depths u and u' of the two contacts
    pressure, gap_change : P and e − g, flat fields
    last_pressure, last_gap_change, last_tangent, last_tangent_gap : P', e' − g, q' and e_q', flat fields

    Returns twelve numbers: the products of load i and deflection j in the order 11, 12, 13, 21, ..., 33, and the sums
    of the three loads.
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
    return aa, ab, ac, ba, bb, bc, ca, cb, cc, a, b, c


@njit
def predict(
    depth_step, early_step, predicted, predicted_change, inside, pressure, tangent, gap_change, tangent_gap, initial_gap
):  # fmt: skip
    """Predict pressure, gap and contact set after the depth has grown by Δu, by extrapolation along the tangent.

    The contact set is only a first guess: all elements with a predicted pressure, and all elements that touch within a
    shorter step of the depth. Elements with a negative predicted pressure (tension) are included; they leave the
    contact set during the iteration.

    depth_step : Δu
    early_step : the shorter step, which excludes elements that touch late in the step Δu
    predicted, predicted_change : P + Δu q and e − g + Δu e_q are stored here, flat fields
    inside : set to True for the elements of the predicted contact set, to False for others, flat field
    pressure, tangent, gap_change, tangent_gap, initial_gap : P, q, e − g, e_q and g before the step, flat fields
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
    """Compute a linear combination of two pressures and a tangent as a new tangent q = a P + b P' + c q'.

    P is the pressure of a contact at the depth u. P' and q' are the pressure and the tangent of the last contact before
    it, at the depth u'.

    weights : a, b and c
    shift : a u + b u' + c − 1, the constant part of e_q = K q − 1, since K P = (e − g) + u and K q' = e_q' + 1
    tangent, tangent_gap : q and e_q are stored here, flat fields
    pressure, gap_change : P and e − g, flat fields
    last_pressure, last_gap_change, last_tangent, last_tangent_gap : P', e' − g, q' and e_q', flat fields
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
    """Add length · deflection to the flat field `gap` at all elements of the grid, in place.

    length : length of a step along the search direction d
    deflection : K d, in rows and columns
    gap : gap change e − g, or tangent gap e_q = de/du, flat field
    """
    rows, columns = deflection.shape
    for i in range(rows):
        start = (i + BORDER) * (columns + 2 * BORDER) + BORDER
        for j in range(columns):
            gap[start + j] += length * deflection[i, j]


@njit(fastmath=True)
def update_pressure(length, direction, pressure, places, slots):
    """Add length · direction to `pressure` on the contact set, in place; return True if any pressure becomes negative.

    direction : search direction, laid out like the load array of the operator
    pressure : flat field
    """
    lowest = 0.0
    for t in range(places.size):
        i = places[t]
        pressure[i] += length * direction[slots[t]]
        lowest = min(lowest, pressure[i])
    return lowest < 0


@njit(fastmath=True)
def update_search_direction(direction, preconditioned, factor, places, slots):
    """Replace the search direction d on the contact set by β d − z, in place.

    direction : d, laid out like the load array of the operator
    preconditioned : preconditioned residual z, flat field
    factor : β
    """
    for t in range(slots.size):
        direction[slots[t]] = factor * direction[slots[t]] - preconditioned[places[t]]


@njit(fastmath=True)
def direction_sums(direction, deflection, preconditioned, gap, places, slots):
    """Return the inner products z·Kd, d·e and d·Kd over the contact set.

    direction, deflection : search direction d and its deflection K d, laid out like the load array of the operator
    preconditioned, gap : preconditioned residual z and gap e, flat fields
    """
    by_preconditioned = by_gap = by_direction = 0.0
    for t in range(slots.size):
        change, by_change = np.float64(direction[slots[t]]), np.float64(deflection[slots[t]])
        by_preconditioned += preconditioned[places[t]] * by_change
        by_gap += change * gap[places[t]]
        by_direction += change * by_change
    return by_preconditioned, by_gap, by_direction


@njit
def unloaded_under_tension(direction, pressure, places, slots, found):
    """Find the elements without pressure that any step along the direction would put under tension.

    found : the indices of these elements in flat fields are stored at the beginning of this array

    Returns the number of these elements.
    """
    count = 0
    for t in range(places.size):
        # Write every place to the array, but count it only if the step puts the element under tension. The next place
        # overwrites a place that is not counted. This is faster than an if statement.
        found[count] = places[t]
        count += (pressure[places[t]] == 0) & (direction[slots[t]] < 0)
    return count


@njit
def step_causes_tension(length, direction, pressure, places, slots):
    """Return True if a step of the given length along the direction would put any element under tension."""
    for t in range(places.size):
        stepped = pressure[places[t]] + length * direction[slots[t]]
        if stepped < 0:
            return True
    return False


@njit
def step_and_find_tension(length, direction, pressure, inside, places, slots, first, released):
    """Add length · direction to the pressure, and mark elements under tension as outside the contact set, in place.

    The array `direction` is overwritten with the change of pressure, length · direction.

    inside : True for elements in contact, flat field; set to False for elements under tension
    places, slots : indices of some elements of the contact set
    first : position of the first of these elements in the list of all elements of the contact set
    released : the positions of the elements under tension in this list are stored at the beginning of this array

    Returns the number of elements under tension.
    """
    count = 0
    for t in range(places.size):
        i, change = places[t], direction[slots[t]] * length
        direction[slots[t]] = change
        pressure[i] += change
        inside[i] = pressure[i] >= 0
        # Write every position to the array, but count it only if the element is released. The next position overwrites
        # a position that is not counted. This is faster than an if statement.
        released[count] = first + t
        count += not inside[i]
    return count


@njit
def release(direction, pressure, inside, places, slots, released, stencil, width, stride):
    """Set the pressure of elements under tension to zero, and change the pressure of their neighbours, in place.

    The pressure of a neighbour changes as if the element under tension were eliminated from the influence matrix. This
    saves iterations. No neighbour loses more than half of its pressure. All changes are also added to `direction`,
    which thereby becomes the total change of pressure in the step.

    inside : True for elements in contact, flat field; already False for elements under tension
    released : positions of the elements under tension in `places` and in `slots`
    stencil : shares of its load that an element passes to its neighbours, from `load_redistribution_stencil`
    width : length of a row of flat fields
    stride : length of a row of the operator's load array
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
    """Add elements that overlap the surface by more than `limit` to the contact set, in place.

    inside : True for elements in the contact set, flat field

    Returns the number of elements that were added.
    """
    joined = 0
    for i in range(gap_change.size):
        if gap_change[i] + initial_gap[i] < -limit and not inside[i]:
            inside[i] = True
            joined += 1
    return joined


@njit
def has_open_gap(limit, gap_change, initial_gap, places):
    """Return True if the gap e at any of the `places` exceeds `limit`; the places are searched from last to first."""
    for t in range(places.size - 1, -1, -1):
        i = places[t]
        if gap_change[i] + initial_gap[i] > limit:
            return True
    return False


@njit
def touch_sums(gap_change, initial_gap, tangent_gap, width, share, sums, places, pressure, tangent):
    """Compute weighted sums over the elements that join the contact while the depth grows by Δu.

    For each element, let t be the share of the step Δu after which the element touches the surface. The estimate is
    t = max(−e/e_q, Δu − P/q)/Δu, clipped to the range from 0 to 1. Here e and e_q = de/du are the gap and the tangent
    gap before the step, P and q = dP/du the pressure and the tangent after the step.

    gap_change, initial_gap, tangent_gap : e − g, g and e_q before the step, flat fields
    width : Δu
    share : shares s of the step, from 0 to 1, shape (n,)
    sums : Σe_q², Σe_q² (1 − t) and, for every s, Σe_q² max(s − t, 0) are added to these numbers, shape (2 + n,)
    places : indices in the flat fields of the elements that join the contact
    pressure, tangent : P and q of the same elements after the step
    """
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
