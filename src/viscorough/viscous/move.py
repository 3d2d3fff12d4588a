"""Motion of a row of unilateral viscoelastic springs, exact in time for media of springs and dashpots.

A row consists of independent springs with initial gaps g_i, in increasing order. Spring i has the stiffness W_i per
unit modulus. Its deflection y_i and its force divided by W_i, φ_i, are related by the law of the medium,

    φ = G∞ y + Σ_b G_b w_b + η y',    w_b' = y' − r_b w_b,    r_b = 1/τ_b,

with one internal variable w_b for each Maxwell branch b. A spring in contact has y_i = u − g_i at the depth u. A free
spring has φ_i = 0. The springs in contact are always the first springs of the row (docs/theory.md). So only two events
can come next: the last spring in contact is released, or the first free spring touches. The motion is computed from
event to event:

1. Between two events, all springs in contact move by the same distance. So their internal variables w_b differ only by
   offsets: w_b = D_b + offset, where D_b is the same for all springs in contact, and each offset decays by exp(−r_b t).
   The springs in contact form a stack. A spring that touches stores its offset, and the sum of W_i × offset for itself
   and all springs before it. When it is released, the sum that the spring before it has stored is used again. So no
   offset is ever subtracted from a sum, which would lose digits.
2. Under a prescribed depth, u is linear in time, and D_b and the force follow directly. Under a prescribed force F, the
   medium is regarded as a series of a spring J₀, a dashpot φ₀ and Kelvin-Voigt elements with compliance J_j and rate
   λ_j = 1/θ_j. Let R_j be the part of F that the dashpot of element j carries, summed over the springs in contact. Then
   R_j' = F' − λ_j R_j, and

       u' ΣW = J₀ F' + φ₀ F + Σ_j J_j λ_j R_j,    Σ_i W_i w_ib = φ₀ τ_b F + Σ_j J_j λ_j/(r_b − λ_j) R_j.

3. A spring that is released at deflection y recovers: y(t) = y + Σ_j J_j ρ_j (1 − exp(−λ_j t)). Its remainders are
   ρ_j = Σ_b G_b r_b/(r_b − λ_j) w_b: the R_j of this spring alone, divided by W_i. They decay by exp(−λ_j t), and are
   evaluated only when this spring can touch next.
4. The force of the last spring in contact is a sum of exponentials and a parabola in time, and so is the overlap of the
   indenter with the first free spring. The first time when such a function becomes positive is bracketed by bounds of
   its curvature, and then found by Halley's method.
5. At a step of the load, every spring responds elastically with the modulus G₀ = G∞ + Σ G_b. The events at this time
   are followed in their order. A dashpot parallel to the medium does not move at a step.

The cost of an event is a few evaluations of these sums. It does not depend on the number of springs in contact.
"""

from typing import NamedTuple

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Integers, Mask
from viscorough.media.creep_response import decay, exponential
from viscorough.media.spectra import Spectrum
from viscorough.viscous.crossing import INTERVALS, first_crossing, second_mean

# Rounding error of a force or an overlap, relative to the size of its terms. A spring is released only if its tension
# exceeds this error, and touches only if its overlap does.
_ROUNDING = 1e-14
# An event counts as simultaneous with the sample before it if it follows within this share of the time of the sample.
# In the first interval between samples, this is a share of the length of the interval.
_AT_ONCE = 1e-11
# The force of a spring is a sum of exponentials of the time since the last event or sample. Terms that have decayed
# leave their rounding errors in the sum. If the next release is more than _FORGOTTEN relaxation times of the fastest
# branch ahead, the springs first move by the share _APPROACH of the time until the release. Then a new sum begins. This
# time ends before the release, when the force of the spring is still at most _ROUGHLY times its force at the start.
_FORGOTTEN, _APPROACH, _ROUGHLY = 5.0, 0.999, 1e-4
# Events count as simultaneous if the time between them is at most this share of the time.
_SAME_TIME = 1e-13
# Limit for the number of events at one time, divided by the number of springs. Only rounding errors can lead to more
# events, since at one time a spring can be released once and touch once.
_MOST_AT_ONCE = 4
# If springs touch and are released at the same time without end, all springs move for a short time without touching or
# being released (a pause). The n-th pause between two samples, n ≤ _MOST_PAUSES, has the length _PAUSE · 2^n times the
# time of the second sample. So pauses last from the rounding error of a time to 1e-9 of the time.
_PAUSE, _MOST_PAUSES = 5e-16, 21

# Ways in which a motion ends: at the last sample (COMPLETE), when the depth reaches its limit (BEYOND_CURVE), at a step
# that needs an infinite force (INFINITE_FORCE), or when springs touch and are released at the same time without end
# (CHATTERING).
COMPLETE, BEYOND_CURVE, INFINITE_FORCE, CHATTERING = 0, 1, 2, 3


class RowMotion(NamedTuple):
    """Motion of a row of springs at given times; arrays of shape (times,) unless another shape is stated.

    The symbols are defined in the module docstring.

    depth, force, velocity : depth u, force F = Σ W φ, and velocity u' just after each time. At the last time, and at
        the first of two equal times (a step), they are the values just before it
    in_contact : number of springs in contact
    deflection : sum of stiffness × deflection, Σ W y, of the springs in contact
    largest : whether there are at least as many springs in contact as at any earlier time
    released_from : time of the first release of a spring; nan if no spring is released
    pressures : force divided by stiffness, φ, of every spring at the last time, shape (springs,)
    surface : initial gap plus deflection, g + y, of every spring at the last time, shape (springs,)
    ended : how the motion ended: COMPLETE, BEYOND_CURVE, INFINITE_FORCE or CHATTERING
    until : time at which it ended. After this time, depth, force and velocity are nan
    """

    depth: Array
    force: Array
    velocity: Array
    in_contact: Integers
    deflection: Array
    largest: Mask
    released_from: float
    pressures: Array
    surface: Array
    ended: int
    until: float


class _Row(NamedTuple):
    """Springs of a row, sums over its first n springs for all n, and the kind of the load. Nothing changes it.

    gaps, weights, limit, by_depth : arguments of `move_row`
    stiffness : sums of the stiffness for n = 0, 1, …, shape (springs + 1,)
    moment : sums of stiffness × gap for n = 0, 1, …, shape (springs + 1,)
    """

    gaps: Array
    weights: Array
    stiffness: Array
    moment: Array
    limit: float
    by_depth: bool


class _Springs(NamedTuple):
    """State of the springs, in arrays that are changed in place; the symbols are defined in the module docstring.

    `_move` changes the first two arrays between events, and `_jump` and `_balanced` change `common`. `_touch` writes
    the next three, and `_let_go` writes the three after them, for the spring that touches or is released.

    common : internal variables D_b that are common to the springs in contact, shape (branches,)
    carried : R_j of the springs in contact under a prescribed force, shape (elements,); `_observe` computes it anew
        in media without a parallel dashpot
    joined : time of the last touch of each spring, shape (springs,)
    offset : offset of the internal variables of each spring from the D_b at the time `joined`, shape (springs,
        branches)
    total : sum of W × offset of each spring and all springs before it at the time `joined` of the spring, shape
        (springs, branches)
    left : time of the last release of each spring, shape (springs,)
    rest : deflection y of each spring at the time `left`, shape (springs,)
    remainder : remainders ρ_j of each spring at the time `left`, shape (springs, elements)
    most : largest number of springs in contact so far, shape (1,); `_touch` increases it
    released : time of the first release of a spring, nan before it; shape (1,)
    """

    common: Array
    carried: Array
    joined: Array
    offset: Array
    total: Array
    left: Array
    rest: Array
    remainder: Array
    most: Integers
    released: Array


class _Scratch(NamedTuple):
    """Work arrays, which hold no state.

    since, kept : time since the last touch of a spring, shape (1,), and exp(−r_b · since), shape (branches,); see
        `_decay_since`
    tension : amplitudes of the exponentials in the tension of the last spring in contact, shape (branches,)
    overlap, drive : amplitudes and their growth in the overlap with the first free spring, shape (elements,)
    still : zeros, shape (branches,)
    stack : intervals of time that `first_crossing` has not searched yet, see there
    """

    since: Array
    kept: Array
    tension: Array
    overlap: Array
    drive: Array
    still: Array
    stack: Array


class _System(NamedTuple):
    """All that a step of the motion needs, except for the time."""

    row: _Row
    spectrum: Spectrum
    springs: _Springs
    scratch: _Scratch


class _Now(NamedTuple):
    """Moment of a motion. Each step returns a new moment.

    time : time since the first sample
    depth, force : depth u and prescribed force F; under a prescribed depth, `force` is not used
    rate : slope of the prescribed depth or force
    count : number of springs in contact
    """

    time: float
    depth: float
    force: float
    rate: float
    count: int  # type: ignore[assignment]  # hides a method of tuples


class _Samples(NamedTuple):
    """Results at the samples, arrays that are filled in place; see RowMotion."""

    depth: Array
    force: Array
    velocity: Array
    in_contact: Integers
    deflection: Array
    largest: Mask


class _Interval(NamedTuple):
    """Interval between two samples, in which the load is linear: its number, its ends and the load at its ends."""

    number: int
    start: float
    end: float
    before: float
    after: float


def move_row(
    gaps: Array, weights: Array, limit: float, spectrum: Spectrum, times: Array, load: Array, *, by_depth: bool
) -> RowMotion:
    """Return the motion of a row of springs.

    gaps : increasing initial gaps g of the springs, shape (springs,)
    weights : stiffnesses W > 0 of the springs per unit modulus, shape (springs,)
    limit : depth at which the motion ends early
    times, load : depth or force at increasing times, linear in between, shape (times,); a time given twice is a step
    by_depth : whether `load` is a depth instead of a force

    A motion up to the last time is COMPLETE. The motion ends early with BEYOND_CURVE if the depth reaches the limit,
    and with INFINITE_FORCE if a step of the depth presses on a parallel dashpot. It ends with CHATTERING if springs
    touch and are released at the same time without end, which should not happen.
    """
    motion = RowMotion(*_march(gaps, weights, limit, spectrum, times - times[0], load, by_depth))
    return motion._replace(released_from=motion.released_from + times[0], until=motion.until + times[0])


@njit(inner=True, counted=False)
def _add_multiple(sums, factor, values):
    """Add `factor` × `values` to the array `sums` of the same length, in place."""
    for i in range(sums.size):
        sums[i] += factor * values[i]


@njit(inner=True, counted=False)
def _sum_of_moduli(spectrum):
    """Return Σ G_b over the Maxwell branches."""
    total = 0.0
    for b in range(spectrum.moduli.size):
        total += spectrum.moduli[b]
    return total


@njit(inner=True, counted=False)
def _decay_since(system, time, i):
    """Set `kept` of the scratch to exp(−r_b (t − t_i)) for every branch b, where spring i touched last at time t_i.

    An event needs the same values several times, so they are computed only if the time since the touch has changed.
    """
    scratch, rates = system.scratch, system.spectrum.rates
    since = time - system.springs.joined[i]
    if since != scratch.since[0]:
        scratch.since[0] = since
        for b in range(rates.size):
            scratch.kept[b] = exponential(rates[b] * since)


@njit(inner=True, counted=False)
def _release(system, now):
    """Return value, slope and rounding error of −φ, the tension of the last spring in contact.

    The spring is released when −φ becomes positive. To find this time, `first_crossing` also needs the amplitudes of
    the exponentials in −φ; they are written to the scratch.
    """
    row, spectrum, springs, first = system.row, system.spectrum, system.springs, system.scratch.tension
    top, gap = now.count - 1, row.gaps[now.count - 1]
    kept = system.scratch.kept
    _decay_since(system, now.time, top)
    if row.by_depth:
        value = spectrum.relaxed * (now.depth - gap) + spectrum.viscosity * now.rate
        size = spectrum.relaxed * (abs(now.depth) + gap) + abs(spectrum.viscosity * now.rate)
        slope = spectrum.relaxed * now.rate
        for b in range(spectrum.rates.size):
            own = springs.common[b] + springs.offset[top, b] * kept[b]
            value += spectrum.moduli[b] * own
            size += spectrum.moduli[b] * (abs(own) + abs(springs.common[b]))
            first[b] = -spectrum.moduli[b] * (now.rate - spectrum.rates[b] * own)
    else:
        stiffness, centre = row.stiffness[now.count], row.moment[now.count] / row.stiffness[now.count]
        value = now.force / stiffness + spectrum.relaxed * (centre - gap)
        size = abs(now.force / stiffness) + spectrum.relaxed * (centre + gap)
        slope = now.rate / stiffness
        for b in range(spectrum.rates.size):
            own = (springs.offset[top, b] - springs.total[top, b] / stiffness) * kept[b]
            value += spectrum.moduli[b] * own
            size += spectrum.moduli[b] * abs(own)
            first[b] = spectrum.moduli[b] * spectrum.rates[b] * own
    return -value, -slope, _ROUNDING * size


@njit(inner=True, counted=False)
def _position(system, i, time):
    """Return the depth g + y at which an indenter would touch the free spring i at a time."""
    spectrum, springs, position = system.spectrum, system.springs, system.row.gaps[i]
    since = time - springs.left[i]
    for j in range(spectrum.decays.size):
        if springs.remainder[i, j] != 0:
            _, mean = decay(spectrum.decays[j] * since)
            position += spectrum.flows[j] * springs.remainder[i, j] * since * mean
    return position + springs.rest[i]


@njit(inner=True, counted=False)
def _position_of_next(system, now):
    """Return the depth at which an indenter would touch the first free spring; the limit of the row if none is free."""
    return _position(system, now.count, now.time) if now.count < system.row.gaps.size else system.row.limit


@njit(inner=True, counted=False)
def _carry(system, now):
    """Set R_j of the springs in contact, `carried`, from their internal variables, or from u and F with a dashpot."""
    row, spectrum, springs = system.row, system.spectrum, system.springs
    stiffness, top = row.stiffness[now.count], now.count - 1
    if spectrum.viscosity > 0:
        for j in range(spectrum.decays.size):
            springs.carried[j] = now.force - spectrum.relaxed * (stiffness * now.depth - row.moment[now.count])
        return
    springs.carried[:] = 0.0
    kept = system.scratch.kept
    _decay_since(system, now.time, top)
    for b in range(spectrum.rates.size):
        variable = stiffness * springs.common[b] + springs.total[top, b] * kept[b]
        _add_multiple(springs.carried, variable, spectrum.remainders[b])


@njit(inner=True, counted=False)
def _let_go(system, now):
    """Release the last spring in contact, and store its state."""
    row, spectrum, springs, top = system.row, system.spectrum, system.springs, now.count - 1
    if np.isnan(springs.released[0]):
        springs.released[0] = now.time
    springs.left[top], springs.rest[top] = now.time, now.depth - row.gaps[top]
    if spectrum.viscosity > 0:
        for j in range(spectrum.decays.size):
            springs.remainder[top, j] = -spectrum.relaxed * (now.depth - row.gaps[top])
    else:
        springs.remainder[top, :] = 0.0
        kept = system.scratch.kept
        _decay_since(system, now.time, top)
        for b in range(spectrum.rates.size):
            own = springs.common[b] + springs.offset[top, b] * kept[b]
            _add_multiple(springs.remainder[top], own, spectrum.remainders[b])
    return _Now(now.time, now.depth, now.force, now.rate, top)


@njit(inner=True, counted=False)
def _touch(system, now):
    """Add the first free spring to the springs in contact.

    The stored offset of the spring is chosen so that the formula of `_release` gives it a force of exactly zero.
    Otherwise rounding could release the spring again at once.
    """
    row, spectrum, springs = system.row, system.spectrum, system.springs
    i, gap, stiffness = now.count, row.gaps[now.count], row.stiffness[now.count]
    springs.joined[i], springs.most[0] = now.time, max(springs.most[0], now.count + 1)
    touched = _Now(now.time, now.depth, now.force, now.rate, now.count + 1)
    if spectrum.viscosity > 0:
        return touched
    if i == 0:
        springs.common[:] = 0.0  # no spring is in contact: the common variables may start from any value
    from_balance = not row.by_depth and i > 0
    excess = spectrum.relaxed * (now.depth - gap)
    if from_balance:
        excess = now.force / stiffness + spectrum.relaxed * (row.moment[i] / stiffness - gap)
    springs.offset[i, :] = 0.0
    for j in range(spectrum.decays.size):
        if springs.remainder[i, j] != 0:
            remainder = springs.remainder[i, j] * exponential(spectrum.decays[j] * (now.time - springs.left[i]))
            _add_multiple(springs.offset[i], remainder, spectrum.branches[j])
    kept = system.scratch.kept
    _decay_since(system, now.time, max(i - 1, 0))
    for b in range(spectrum.rates.size):
        own = springs.offset[i, b]
        springs.offset[i, b] = own - springs.common[b]
        before = springs.total[i - 1, b] * kept[b] if i > 0 else 0.0
        springs.total[i, b] = before
        excess += spectrum.moduli[b] * (springs.offset[i, b] - before / stiffness if from_balance else own)
    excess /= _sum_of_moduli(spectrum)
    for b in range(spectrum.rates.size):
        springs.offset[i, b] -= excess
        springs.total[i, b] += row.weights[i] * springs.offset[i, b]
    return touched


@njit(inner=True, counted=False)
def _force_in_contact(system, now):
    """Return the force of the springs in contact, from their deflections and internal variables.

    The force of a parallel dashpot is not included.
    """
    row, spectrum, springs, count = system.row, system.spectrum, system.springs, now.count
    stiffness = row.stiffness[count]
    force = spectrum.relaxed * (stiffness * now.depth - row.moment[count])
    kept = system.scratch.kept
    _decay_since(system, now.time, count - 1)
    for b in range(spectrum.rates.size):
        variable = stiffness * springs.common[b] + springs.total[count - 1, b] * kept[b]
        force += spectrum.moduli[b] * variable
    return force


@njit(inner=True, counted=False)
def _balanced(system, now):
    """Change the depth slightly, so that the springs in contact carry exactly the prescribed force.

    The common variables change by the same step, in place. This correction is needed because the force of a released
    spring is zero only within rounding. Compared with the force of much softer springs in contact, this rounding error
    may be large.

    Nothing changes in two cases: in a fluid without a parallel spring, where the force does not depend on the depth
    itself, and with a parallel dashpot, where the depth follows from the force.
    """
    spectrum, springs = system.spectrum, system.springs
    if spectrum.viscosity > 0 or spectrum.relaxed == 0:
        return now
    modulus = system.row.stiffness[now.count] * (spectrum.relaxed + _sum_of_moduli(spectrum))
    step = (now.force - _force_in_contact(system, now)) / modulus
    for b in range(spectrum.rates.size):
        springs.common[b] += step
    return _Now(now.time, now.depth + step, now.force, now.rate, now.count)


@njit(inner=True, counted=False)
def _observe(system, now):
    """Return force and velocity.

    Under a prescribed force, `carried` is computed anew. In a medium with a parallel dashpot, it keeps the value that
    was advanced from event to event. Computed from u and F, this value would lose all digits when creep has almost
    ended.
    """
    spectrum, stiffness = system.spectrum, system.row.stiffness[now.count]
    if system.row.by_depth:
        if now.count == 0:
            return 0.0, now.rate
        force = _force_in_contact(system, now) + spectrum.viscosity * stiffness * now.rate
        return max(force, 0.0), now.rate
    if spectrum.viscosity == 0:
        _carry(system, now)
    flow = spectrum.instantaneous * now.rate + spectrum.fluidity * now.force
    for j in range(spectrum.decays.size):
        flow += spectrum.flows[j] * system.springs.carried[j]
    return now.force, flow / stiffness


@njit(inner=True, counted=False)
def _jump(system, now, target):
    """Change the load in a step: the depth or the force to `target`.

    Return the moment after the step, and how the step ended:

    - COMPLETE: the load is `target`.
    - BEYOND_CURVE: all springs touch and the depth reaches its limit before the load is `target`.
    - INFINITE_FORCE: the step of the depth needs an infinite force, because of a parallel dashpot.
    - CHATTERING: springs touch and are released again without end.
    """
    if system.spectrum.viscosity == 0:
        return _elastic_jump(system, now, target)
    if system.row.by_depth:
        # The dashpot keeps the surface in place. If the indenter steps up, all springs are released. If it steps down
        # into the surface, the force is infinite.
        rises = now.count > 0 and target > now.depth
        while now.count > 0 and target < now.depth:
            now = _let_go(system, now)
        overlap = target - _position_of_next(system, now)
        ended = INFINITE_FORCE if rises or overlap > _ROUNDING * abs(target) else COMPLETE
        return _Now(now.time, target, now.force, now.rate, now.count), ended
    # The dashpot keeps the indenter in place. Release the springs that the new force would pull.
    now = _Now(now.time, now.depth, target, 0.0, now.count)
    while now.count > 1:
        value, _, rounding = _release(system, now)
        if value <= rounding:
            break
        now = _let_go(system, now)
    _carry(system, now)
    return now, COMPLETE


@njit(inner=True, counted=False)
def _elastic_jump(system, now, target):
    """Change the load in a step, in a medium without a parallel dashpot; see `_jump`.

    The springs move elastically from the old load to the new load. On the way, they touch or are released, one after
    another.
    """
    row, spectrum, springs = system.row, system.spectrum, system.springs
    modulus = spectrum.relaxed + _sum_of_moduli(spectrum)
    for _ in range(_MOST_AT_ONCE * row.gaps.size + 8):
        stiffness = row.stiffness[now.count] * modulus
        rises = target > (now.depth if row.by_depth else now.force)
        step, reaches = 0.0, True
        if rises:
            step = max(_position_of_next(system, now) - now.depth, 0.0)
            reaches = step >= target - now.depth if row.by_depth else stiffness * step >= target - now.force
        elif now.count > (0 if row.by_depth else 1):
            value, _, _ = _release(system, now)
            step = min(value, 0.0) / modulus
            reaches = step <= target - now.depth if row.by_depth else stiffness * step <= target - now.force
        if reaches:
            step = target - now.depth if row.by_depth else (target - now.force) / stiffness
        for b in range(spectrum.rates.size):
            springs.common[b] += step
        depth = target if row.by_depth and reaches else now.depth + step
        force = target if reaches else now.force + stiffness * step
        now = _Now(now.time, depth, force, now.rate, now.count)
        if reaches:
            return now if row.by_depth else _balanced(system, now), COMPLETE
        if rises and now.count == row.gaps.size:
            return now, BEYOND_CURVE
        now = _touch(system, now) if rises else _let_go(system, now)
    return now, CHATTERING


@njit(inner=True, counted=False)
def _next_touch(system, now, until):
    """Return the time from now until the indenter touches the first free spring; inf if it is longer than `until`."""
    row, spectrum, springs = system.row, system.spectrum, system.springs
    overlap, drive, count = system.scratch.overlap, system.scratch.drive, now.count
    if count == row.gaps.size and not np.isfinite(row.limit):
        return np.inf
    slope, bend = now.rate, 0.0
    overlap[:] = 0.0
    drive[:] = 0.0
    if not row.by_depth:
        stiffness = row.stiffness[count]
        slope = (spectrum.instantaneous * now.rate + spectrum.fluidity * now.force) / stiffness
        bend = 0.5 * spectrum.fluidity * now.rate / stiffness
        for j in range(spectrum.decays.size):
            overlap[j] = spectrum.flows[j] * springs.carried[j] / stiffness
            drive[j] = spectrum.flows[j] * now.rate / stiffness
    reached = row.limit
    if count < row.gaps.size:
        # `_position` has the same sum, which needs the same exponential functions.
        since, reached = now.time - springs.left[count], row.gaps[count]
        for j in range(spectrum.decays.size):
            if springs.remainder[count, j] != 0:
                kept, mean = decay(spectrum.decays[j] * since)
                flow = spectrum.flows[j] * springs.remainder[count, j]
                reached += flow * since * mean
                overlap[j] -= flow * kept
        reached += springs.rest[count]
    rounding = _ROUNDING * (abs(now.depth) + (row.gaps[count] if count < row.gaps.size else 0.0))
    value, stack = now.depth - reached, system.scratch.stack
    return first_crossing(until, rounding, 0.0, value, slope, bend, overlap, drive, spectrum.decays, stack)


@njit(inner=True, counted=False)
def _next_release(system, now, until, early):
    """Return the time from now until the last spring in contact is released; inf if it is longer than `until`.

    Under a prescribed force, the first spring stays in contact.

    early : the search may end before the release, when the force of the spring is at most this share of its force now
    """
    if now.count <= (0 if system.row.by_depth else 1):
        return np.inf
    value, slope, rounding = _release(system, now)
    first, second, rates = system.scratch.tension, system.scratch.still, system.spectrum.rates
    early *= abs(value)
    return first_crossing(until, rounding, early, value, slope, 0.0, first, second, rates, system.scratch.stack)


@njit(inner=True, counted=False)
def _move(system, now, s, end):
    """Move all springs by a time s without events, and return the depth at its end.

    The common variables and the R_j are changed in place.

    end : time at the end of the move, after rounding. It is passed instead of computed from s, because the offset of a
        spring that touches at this time decays from the same rounded time
    """
    row, spectrum, springs, rate = system.row, system.spectrum, system.springs, now.rate
    if row.by_depth:
        for b in range(spectrum.rates.size):
            x = spectrum.rates[b] * s
            kept, mean = decay(x)
            springs.common[b] = springs.common[b] * kept + rate * s * mean
        return now.depth + rate * s
    stiffness = row.stiffness[now.count]
    rise = s * (spectrum.instantaneous * rate + spectrum.fluidity * (now.force + 0.5 * rate * s))
    for j in range(spectrum.decays.size):
        x = spectrum.decays[j] * s
        kept, mean = decay(x)
        rise += spectrum.flows[j] * (springs.carried[j] * s * mean + rate * s * s * second_mean(x, mean))
        springs.carried[j] = springs.carried[j] * kept + rate * s * mean
    for b in range(spectrum.rates.size):
        springs.common[b] = spectrum.fluidity * (now.force + rate * s) / spectrum.rates[b]
    for j in range(spectrum.decays.size):
        _add_multiple(springs.common, springs.carried[j], spectrum.branches[j])
    kept = system.scratch.kept
    _decay_since(system, end, now.count - 1)
    for b in range(spectrum.rates.size):
        springs.common[b] = (springs.common[b] - springs.total[now.count - 1, b] * kept[b]) / stiffness
    return now.depth + rise / stiffness


@njit(inner=True, counted=False)
def _released(system, now):
    """Release the last spring in contact between two samples.

    Under a prescribed depth, further springs may be released at the same time, as when the motion of a parallel dashpot
    turns. No spring can touch before them.
    """
    now = _let_go(system, now)
    while system.row.by_depth and now.count > 0:
        value, _, rounding = _release(system, now)
        if value <= rounding:
            break
        now = _let_go(system, now)
    if now.count > 0 and not system.row.by_depth:
        now = _balanced(system, now)
        if system.spectrum.viscosity > 0:
            _carry(system, now)
    return now


@njit(inner=True, counted=False)
def _touched(system, now):
    """Bring the first free spring into contact between two samples."""
    row, spectrum, springs, i = system.row, system.spectrum, system.springs, now.count
    if not row.by_depth:
        now = _balanced(system, now)
        if spectrum.viscosity > 0:
            for j in range(spectrum.decays.size):
                kept = np.exp(-spectrum.decays[j] * (now.time - springs.left[i]))
                springs.carried[j] += row.weights[i] * springs.remainder[i, j] * kept
    return _touch(system, now)


@njit(inner=True, counted=False)
def _ramp(system, now, interval, samples):
    """Move the springs from one sample to the next; return the moment at its end, and how the motion goes on.

    It goes on (COMPLETE), or ends with BEYOND_CURVE or CHATTERING, see `move_row`. The first events after the first
    sample count as simultaneous with it, and `samples` then gets the values just after this sample.
    """
    spectrum, by_depth = system.spectrum, system.row.by_depth
    length = interval.end - interval.start
    now = _Now(now.time, now.depth, interval.before, (interval.after - interval.before) / length, now.count)
    fastest = 0.0
    for b in range(spectrum.rates.size):
        fastest = max(fastest, spectrum.rates[b])
    at_once = _AT_ONCE * (interval.start if interval.start > 0 else length)
    # `passed` is the time since the start of the interval. Soon after the start it distinguishes times that are equal
    # in `time` within rounding. `events` counts the events at the time `at`.
    passed, started, events, at, pauses = 0.0, False, 0, 0.0, 0
    force, velocity, touch, s, approaches = 0.0, 0.0, 0.0, 0.0, False
    while True:
        if not started or not by_depth:
            force, velocity = _observe(system, now)
        left = length - passed
        touch = touch - s if approaches else _next_touch(system, now, left)
        paused = events > _MOST_AT_ONCE * system.row.gaps.size + 8
        # After an approach, the next is needed only if the release is further ahead than the approach was long.
        early = 0.0 if approaches else _ROUGHLY
        release = _next_release(system, now, min(left, touch), early)
        far = release > s if approaches else release * fastest > _FORGOTTEN
        approaches = not paused and release < touch and far and passed + _APPROACH * release > passed
        if np.isfinite(release) and not approaches and early > 0:
            release = _next_release(system, now, min(left, touch), 0.0)
        if paused:
            # A spring whose force is zero within rounding touches and is released again and again. Move on for a short
            # time without events.
            events, pauses = 0, pauses + 1
            s = min(_PAUSE * interval.end * 2.0**pauses, left)
            arrives = s == left
        elif approaches:
            s, arrives = _APPROACH * release, False
        else:
            event = min(touch, release)
            arrives = event > left
            s = left if arrives else event
        if not started and (arrives or passed + s > at_once):
            started = True
            _record_start(system, now, force, velocity, samples, interval.number - 1)
        passed = length if arrives else passed + s
        time = interval.end if arrives else interval.start + passed
        depth = _move(system, now, s, time)
        # Interpolate from the end of the interval with the smaller load. So a load that approaches zero keeps its
        # digits.
        if abs(interval.before) < abs(interval.after):
            load = interval.before + now.rate * passed
        else:
            load = interval.after - now.rate * (length - passed)
        now = _Now(time, depth, load, now.rate, now.count)
        if arrives:
            if by_depth:
                now = _Now(time, interval.after, load, now.rate, now.count)
            return now, COMPLETE
        if pauses > _MOST_PAUSES:
            return now, CHATTERING
        if approaches or paused:
            continue
        events = events + 1 if passed - at <= _SAME_TIME * time else 1
        at = passed
        if release < touch:
            now = _released(system, now)
        elif now.count == system.row.gaps.size:
            return now, BEYOND_CURVE
        else:
            now = _touched(system, now)


@njit(inner=True, counted=False)
def _record(system, now, samples, k):
    """Write the state at sample k. If the load has a kink or a step here, this is the state just before it."""
    force, velocity = _observe(system, now)
    samples.force[k], samples.velocity[k] = force, velocity
    samples.depth[k], samples.in_contact[k] = now.depth, now.count
    samples.largest[k] = now.count >= system.springs.most[0]
    samples.deflection[k] = system.row.stiffness[now.count] * now.depth - system.row.moment[now.count]


@njit(inner=True, counted=False)
def _record_start(system, now, force, velocity, samples, k):
    """Replace the velocity at sample k, and force and contact if they change there, by their values just after it.

    Under a prescribed depth, force and contact are replaced only in media with a parallel dashpot, whose force jumps
    with the velocity. In other media the fast branches that replace a springpot may release springs soon after the
    sample, although not at the sample.
    """
    samples.velocity[k] = velocity
    if system.spectrum.viscosity > 0 or not system.row.by_depth:
        samples.force[k], samples.in_contact[k] = force, now.count
        samples.largest[k] = now.count >= system.springs.most[0]
        row = system.row
        samples.deflection[k] = row.stiffness[now.count] * samples.depth[k] - row.moment[now.count]


@njit
def _march(gaps, weights, limit, spectrum, times, load, by_depth):
    """Return the fields of a RowMotion, see `move_row`. The first time is 0."""
    count, size = gaps.size, times.size
    branches, elements = spectrum.rates.size, spectrum.decays.size
    row = _Row(gaps, weights, np.zeros(count + 1), np.zeros(count + 1), limit, by_depth)
    for i in range(count):
        row.stiffness[i + 1], row.moment[i + 1] = row.stiffness[i] + weights[i], row.moment[i] + weights[i] * gaps[i]
    springs = _Springs(
        np.zeros(branches), np.zeros(elements), np.zeros(count), np.zeros((count, branches)),
        np.zeros((count, branches)), np.zeros(count), np.zeros(count), np.zeros((count, elements)),
        np.zeros(1, np.int64), np.full(1, np.nan),
    )  # fmt: skip
    scratch = _Scratch(
        np.zeros(1),
        np.ones(branches),
        np.zeros(branches),
        np.zeros(elements),
        np.zeros(elements),
        np.zeros(branches),
        np.zeros(INTERVALS),
    )
    system = _System(row, spectrum, springs, scratch)
    samples = _Samples(
        np.full(size, np.nan), np.full(size, np.nan), np.full(size, np.nan), np.zeros(size, np.int64), np.zeros(size),
        np.ones(size, np.bool_),
    )  # fmt: skip
    now, ended = _Now(0.0, 0.0, 0.0, 0.0, 0), COMPLETE
    if not by_depth:  # without a force the indenter rests on the first spring
        now = _touch(system, _Now(0.0, gaps[0], 0.0, 0.0, 0))
    for k in range(size):
        if k == 0 or times[k] == times[k - 1]:
            now, ended = _jump(system, _Now(now.time, now.depth, now.force, 0.0, now.count), load[k])
        else:
            interval = _Interval(k, times[k - 1], times[k], load[k - 1], load[k])
            now, ended = _ramp(system, now, interval, samples)
        if ended != COMPLETE:
            break
        _record(system, now, samples, k)

    pressures, surface = np.zeros(count), np.full(count, now.depth)
    for i in range(now.count, count):
        surface[i] = _position(system, i, now.time)
    for i in range(now.count):
        pressures[i] = spectrum.relaxed * (now.depth - gaps[i]) + spectrum.viscosity * samples.velocity[-1]
        for b in range(branches):
            own = springs.common[b] + springs.offset[i, b] * np.exp(-spectrum.rates[b] * (now.time - springs.joined[i]))
            pressures[i] += spectrum.moduli[b] * own
    pressures = np.maximum(pressures, 0.0)
    until = times[-1] if ended == COMPLETE else now.time
    return (
        samples.depth, samples.force, samples.velocity, samples.in_contact, samples.deflection, samples.largest,
        springs.released[0], pressures, surface, ended, until,
    )  # fmt: skip
