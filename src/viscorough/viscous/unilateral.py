"""Motion of a row of unilateral viscoelastic springs, exact in time for media of springs and dashpots.

Every spring i has an initial gap g_i and a stiffness w_i (over a modulus) and follows the medium by itself: its
deflection y_i and its force φ_i, over w_i, are related by

    φ = G∞ y + Σ G_b w_b + η y',    w_b' = y' − r_b w_b,    r_b = 1/τ_b,

with one internal variable w_b for each Maxwell branch. A pressed spring has y_i = u − g_i, a free one φ_i = 0. The
springs in contact are always the first m of the row (docs/theory.md), so that only two events can come next: the last
spring in contact lets go, or the first free one touches. The kernel moves from event to event:

1. Between events all springs in contact move alike. Their internal variables differ from a common variable D_b by
   offsets that decay by exp(−r_b t). The contact is a stack: a spring that touches stores its offset and the sum of the
   offsets up to it, and a spring that lets go restores the sum before it, so that nothing is subtracted.
2. Under a prescribed depth u is linear in time, and D_b and the force follow at once. Under a prescribed force the
   remainders R_j = ΣF − Z_j of the Kelvin-Voigt elements of the medium have R_j' = F' − λ_j R_j, and

       u' Σw = J₀ F' + φ₀ F + Σ J_j λ_j R_j,    Σ w_i w_ib = φ₀ τ_b F + Σ_j J_j λ_j/(r_b − λ_j) R_j.

3. A free spring recovers by y(t) = y + Σ J_j r_j (1 − exp(−λ_j t)), with its own remainders
   r_j = Σ_b G_b r_b/(r_b − λ_j) w_b, which decay by exp(−λ_j t). It is evaluated only when it can touch next.
4. The force of the last spring and the overlap of the next one are sums of exponentials and a parabola. The first time
   at which such a function becomes positive is bracketed by bounds of its curvature, then found by Newton's method.
5. At a step of the load every spring responds with G₀ = G∞ + Σ G_b, and events follow in their order at this time. A
   parallel dashpot does not move at a step.

Every event costs a few evaluations of these sums. The cost does not depend on the number of springs in contact.
"""

from typing import NamedTuple

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.interrupts import uninterrupted
from viscorough.basics.types import Array, Integers, Mask
from viscorough.media.medium import RelaxationSpectrum, RetardationSpectrum

# Rounding error of a force or of an overlap, relative to its terms: events within it do not happen.
_ROUNDING = 1e-14
# A time of an event is found if the function is this close to zero, over its rounding.
_CLOSE = 0.2
# Events within this share of the time, or of the first interval, belong to the sample before them.
_AT_ONCE = 1e-11
# The force of a spring is a sum of exponentials from the start of an interval. Branches that have relaxed since then
# were large, and their rounding errors remain. If a release lies more relaxation times of the fastest branch ahead than
# the first number, the row first moves by this share of the time, from where the sum is taken again.
_FORGOTTEN, _APPROACH = 5.0, 0.999
# Halvings of an interval in search of an event, and Newton steps: enough to reach the rounding of a number.
_HALVINGS, _NEWTON_STEPS = 64, 60
# Below this x the functions of exp(−x) are computed by series with this many terms.
_SERIES_BELOW, _SERIES_TERMS = 0.3, 12
# Events at one time, over the number of springs, that cannot happen: every spring can let go and touch once.
_MOST_AT_ONCE = 4
# Length of the first pause without events in an interval, over the time since the beginning, and largest number of
# pauses. Their length doubles from the rounding of a time to 1e-9 of it.
_PAUSE, _MOST_PAUSES = 5e-16, 21

SETTLED, BEYOND, INFINITE, RESTLESS = 0, 1, 2, 3  # how a motion ended


class Law(NamedTuple):
    """Both spectra of a medium and the matrices between their internal variables.

    viscosity, relaxed, moduli, rates : η, G∞, G_b and r_b
    instantaneous, fluidity, flows, decays : J₀, φ₀, J_j λ_j and λ_j
    remainders : G_b r_b/(r_b − λ_j), shape (decays, rates); branches : J_j λ_j/(r_b − λ_j), shape (rates, decays)
    """

    viscosity: float
    relaxed: float
    moduli: Array
    rates: Array
    instantaneous: float
    fluidity: float
    flows: Array
    decays: Array
    remainders: Array
    branches: Array


class RowMotion(NamedTuple):
    """Motion of a row of springs; arrays of shape (times,) unless stated.

    depth, force, velocity : u, ΣφW and u'; the limit after each time, except before a step and at the last time
    in_contact : number of springs in contact
    deflection : Σ w y of the springs in contact
    largest : whether the contact is larger than, or as large as, ever before
    receding_from : the time at which the first spring lets go; nan if none does
    pressures, surface : φ and g + y of every spring at the last time, shape (springs,)
    """

    depth: Array
    force: Array
    velocity: Array
    in_contact: Integers
    deflection: Array
    largest: Mask
    receding_from: float
    pressures: Array
    surface: Array


class _Row(NamedTuple):
    """Springs, and Σw and Σwg of the first ones of them, shape (springs + 1,); see move_row."""

    gaps: Array
    weights: Array
    stiffness: Array
    moment: Array
    limit: float


class _State(NamedTuple):
    """Internal variables of the row; arrays that the kernel changes in place.

    common : D_b
    joined : time at which each spring touched; offset, total : its offset, and the sum of offsets, at that time
    left : time at which each spring let go; rest, remainder : its y and r_j at that time
    most : largest number of springs in contact so far; receding : time at which the first one let go; shape (1,)
    """

    common: Array
    joined: Array
    offset: Array
    total: Array
    left: Array
    rest: Array
    remainder: Array
    most: Integers
    receding: Array


def law_of(relaxation: RelaxationSpectrum, retardation: RetardationSpectrum) -> Law:
    """Return the Law of a medium with these spectra."""
    rates, decays = 1 / relaxation.times, 1 / retardation.times
    flows = retardation.compliances * decays
    if relaxation.viscosity:
        remainders, branches = np.zeros((decays.size, 0)), np.zeros((0, decays.size))
    else:
        apart = rates - decays[:, None]
        # A branch whose rate is a retardation rate to rounding has no strength.
        inverse = np.divide(1.0, apart, out=np.zeros_like(apart), where=apart != 0)
        remainders, branches = relaxation.moduli * rates * inverse, np.ascontiguousarray((flows[:, None] * inverse).T)
    return Law(
        float(relaxation.viscosity), float(relaxation.relaxed_modulus), np.ascontiguousarray(relaxation.moduli), rates,
        float(retardation.instantaneous_compliance), float(retardation.fluidity), flows, decays, remainders, branches,
    )  # fmt: skip


def move_row(
    gaps: Array, weights: Array, limit: float, law: Law, times: Array, load: Array, *, by_depth: bool
) -> tuple[RowMotion, int, float]:
    """Return the motion of a row of springs, how it ended, and when.

    gaps : increasing initial gaps, shape (springs,); weights : stiffnesses > 0; limit : depth that may not be reached
    times, load : depth or force at increasing times, linear in between; a time given twice is a step; shape (times,)

    The motion ends early, with BEYOND, where u reaches the limit; with INFINITE, where a step of the depth presses on a
    parallel dashpot; and with RESTLESS if events do not end, which would be a fault.
    """
    with uninterrupted():
        *motion, ended, until = _march(gaps, weights, limit, law, times - times[0], load, by_depth)
    motion = RowMotion(*motion)
    return motion._replace(receding_from=motion.receding_from + times[0]), ended, until + times[0]


@njit(inner=True)
def _mean_decay(x):
    """(1 − exp(−x))/x."""
    return -np.expm1(-x) / x if x > 0 else 1.0


@njit(inner=True)
def _second_mean(x):
    """(x − 1 + exp(−x))/x²."""
    if x > _SERIES_BELOW:
        return (x + np.expm1(-x)) / (x * x)
    value = 0.0
    for n in range(_SERIES_TERMS, 0, -1):
        value = (1 - value * x) / (n + 1)
    return value


@njit(inner=True)
def _evaluate(s, value, slope, bend, first, second, rates):
    """f, f' and upper bounds of f'' and −f'' from here on, of f = value + slope s + bend s² + Σ∫x_k.

    x_k' = second_k − rates_k x_k, with x_k(0) = first_k.
    """
    f, rate = value + s * (slope + s * bend), slope + 2 * bend * s
    up, down = max(2 * bend, 0.0), max(-2 * bend, 0.0)
    for k in range(rates.size):
        x = rates[k] * s
        kept = np.exp(-x)
        gone = s * _mean_decay(x)
        f += first[k] * gone
        rate += first[k] * kept + second[k] * gone
        if second[k] != 0:
            f += second[k] * s * s * _second_mean(x)
        curvature = (second[k] - rates[k] * first[k]) * kept
        up += max(curvature, 0.0)
        down += max(-curvature, 0.0)
    return f, rate, up, down


@njit(inner=True)
def _first_crossing(end, rounding, value, slope, bend, first, second, rates):
    """The first s in [0, end] at which f (see _evaluate) exceeds the rounding; infinite if there is none.

    An event waits until f is above its rounding: a spring that has just let go would otherwise touch again at once.
    """
    value -= rounding
    if value > 0:
        return 0.0
    stack = np.empty((_HALVINGS + 2, 5))
    a = 0.0
    fa, da, up, down = _evaluate(a, value, slope, bend, first, second, rates)
    stack[0, 0] = end
    stack[0, 1], stack[0, 2], stack[0, 3], stack[0, 4] = _evaluate(end, value, slope, bend, first, second, rates)
    if not np.isfinite(end * end * (up + down) + abs(fa) + end * abs(da) + abs(stack[0, 1])):
        return np.inf  # the motion overflows
    top = 0
    while top >= 0:
        b, fb, db = stack[top, 0], stack[top, 1], stack[top, 2]
        h = b - a
        curved = 0.5 * up * h * h
        # f lies below parabolas through both ends, and below their chord by at most the curvature.
        if (
            max(fa, fa + da * h + curved) <= 0
            or max(fb, fb - db * h + curved) <= 0
            or max(fa, fb) + 0.125 * down * h * h <= 0
        ):
            a, fa, da, up, down = b, fb, db, stack[top, 3], stack[top, 4]
            top -= 1
            continue
        if fb > 0 and (da - down * h > 0 or db - up * h > 0):
            return _increasing_zero(a, b, _CLOSE * rounding, value, slope, bend, first, second, rates)
        middle = a + 0.5 * h
        if top > _HALVINGS or middle <= a or middle >= b:
            if fb > 0:
                return b
            a, fa, da, up, down = b, fb, db, stack[top, 3], stack[top, 4]
            top -= 1
            continue
        top += 1
        stack[top, 0] = middle
        fm, dm, um, wm = _evaluate(middle, value, slope, bend, first, second, rates)
        stack[top, 1], stack[top, 2], stack[top, 3], stack[top, 4] = fm, dm, um, wm
    return np.inf


@njit(inner=True)
def _increasing_zero(a, b, close, value, slope, bend, first, second, rates):
    """The zero of f, up to a value of `close`, where f increases from a to b and is positive at b."""
    s = a
    for _ in range(_NEWTON_STEPS):
        f, rate, _, _ = _evaluate(s, value, slope, bend, first, second, rates)
        if f > 0:
            b = s
        else:
            a = s
        if abs(f) <= close:
            return s
        step = s - f / rate if rate > 0 else 0.5 * (a + b)
        if not a < step < b:
            step = a + 0.5 * (b - a)
        if not a < step < b:
            return b
        s = step
    return b


@njit(inner=True)
def _release(row, law, state, t, u, force, rate, count, by_depth, first):
    """Value, slope and rounding of −φ of the last spring in contact; its terms `first` are set in place."""
    top, gap = count - 1, row.gaps[count - 1]
    since = t - state.joined[top]
    if by_depth:
        value = law.relaxed * (u - gap) + law.viscosity * rate
        size = law.relaxed * (abs(u) + gap) + abs(law.viscosity * rate)
        slope = law.relaxed * rate
        for b in range(law.rates.size):
            own = state.common[b] + state.offset[top, b] * np.exp(-law.rates[b] * since)
            value += law.moduli[b] * own
            size += law.moduli[b] * (abs(own) + abs(state.common[b]))
            first[b] = -law.moduli[b] * (rate - law.rates[b] * own)
    else:
        stiffness, centre = row.stiffness[count], row.moment[count] / row.stiffness[count]
        value = force / stiffness + law.relaxed * (centre - gap)
        size = abs(force / stiffness) + law.relaxed * (centre + gap)
        slope = rate / stiffness
        for b in range(law.rates.size):
            own = (state.offset[top, b] - state.total[top, b] / stiffness) * np.exp(-law.rates[b] * since)
            value += law.moduli[b] * own
            size += law.moduli[b] * abs(own)
            first[b] = law.moduli[b] * law.rates[b] * own
    return -value, -slope, _ROUNDING * size


@njit(inner=True)
def _gap_now(state, law, gap, t, i):
    """The gap g + y of a free spring from the undeformed surface."""
    since = t - state.left[i]
    for j in range(law.decays.size):
        if state.remainder[i, j] != 0:
            gap += law.flows[j] * state.remainder[i, j] * since * _mean_decay(law.decays[j] * since)
    return gap + state.rest[i]


@njit(inner=True)
def _remainders_in_contact(row, law, state, t, u, force, count, remainders):
    """R_j of the springs in contact, in place."""
    stiffness, top = row.stiffness[count], count - 1
    if law.viscosity > 0:
        remainders[:] = force - law.relaxed * (stiffness * u - row.moment[count])
        return
    remainders[:] = 0.0
    for b in range(law.rates.size):
        variable = stiffness * state.common[b]
        variable += state.total[top, b] * np.exp(-law.rates[b] * (t - state.joined[top]))
        for j in range(law.decays.size):
            remainders[j] += law.remainders[j, b] * variable


@njit(inner=True)
def _let_go(row, law, state, t, u, count):
    """Store the state of the last of `count` springs in contact, which lets go, and return how many are left."""
    top = count - 1
    if np.isnan(state.receding[0]):
        state.receding[0] = t
    state.left[top], state.rest[top] = t, u - row.gaps[top]
    if law.viscosity > 0:
        for j in range(law.decays.size):
            state.remainder[top, j] = -law.relaxed * (u - row.gaps[top])
        return top
    state.remainder[top, :] = 0.0
    for b in range(law.rates.size):
        own = state.common[b] + state.offset[top, b] * np.exp(-law.rates[b] * (t - state.joined[top]))
        for j in range(law.decays.size):
            state.remainder[top, j] += law.remainders[j, b] * own
    return top


@njit(inner=True)
def _touch(row, law, state, t, u, force, count, by_depth):
    """Add the first free spring to the `count` springs in contact, and return how many there are.

    Its force is then zero by the formula of `_release`, so that rounding does not make it let go at once.
    """
    i, gap, stiffness = count, row.gaps[count], row.stiffness[count]
    state.joined[i], state.most[0] = t, max(state.most[0], count + 1)
    if law.viscosity > 0:
        return count + 1
    if i == 0:
        state.common[:] = 0.0  # no spring refers to it
    from_balance = not by_depth and i > 0
    excess = law.relaxed * (u - gap)
    if from_balance:
        excess = force / stiffness + law.relaxed * (row.moment[count] / stiffness - gap)
    for b in range(law.rates.size):
        own = 0.0
        for j in range(law.decays.size):
            if state.remainder[i, j] != 0:
                kept = np.exp(-law.decays[j] * (t - state.left[i]))
                own += law.branches[b, j] * state.remainder[i, j] * kept
        state.offset[i, b] = own - state.common[b]
        before = 0.0
        if i > 0:
            before = state.total[i - 1, b] * np.exp(-law.rates[b] * (t - state.joined[i - 1]))
        state.total[i, b] = before
        excess += law.moduli[b] * (state.offset[i, b] - before / stiffness if from_balance else own)
    excess /= law.moduli.sum()
    for b in range(law.rates.size):
        state.offset[i, b] -= excess
        state.total[i, b] += row.weights[i] * state.offset[i, b]
    return count + 1


@njit(inner=True)
def _carried(row, law, state, t, u, count):
    """Force of the springs in contact from their deflections and internal variables, without a parallel dashpot."""
    stiffness, moment = row.stiffness[count], row.moment[count]
    force = law.relaxed * (stiffness * u - moment)
    for b in range(law.rates.size):
        variable = stiffness * state.common[b]
        variable += state.total[count - 1, b] * np.exp(-law.rates[b] * (t - state.joined[count - 1]))
        force += law.moduli[b] * variable
    return force


@njit(inner=True)
def _balanced(row, law, state, t, u, force, count):
    """Return u after a step at which the springs in contact carry the force; the common variables step with it.

    A spring lets go with a force of zero to rounding only. Springs of much less stiffness would have to carry the rest.
    In a fluid the force does not depend on u itself, and with a parallel dashpot u follows from the force.
    """
    if law.viscosity > 0 or law.relaxed == 0:
        return u
    step = (force - _carried(row, law, state, t, u, count)) / (row.stiffness[count] * (law.relaxed + law.moduli.sum()))
    state.common[:] += step
    return u + step


@njit(inner=True)
def _observe(row, law, state, t, u, force, rate, count, by_depth, remainders):
    """Force and velocity at a time; `remainders` is set in place, but that of a parallel dashpot is kept.

    From u and F it would lose all digits when creep has nearly ended.
    """
    stiffness = row.stiffness[count]
    if by_depth:
        if count == 0:
            return 0.0, rate
        force = _carried(row, law, state, t, u, count) + law.viscosity * stiffness * rate
        return max(force, 0.0), rate
    if law.viscosity == 0:
        _remainders_in_contact(row, law, state, t, u, force, count, remainders)
    flow = law.instantaneous * rate + law.fluidity * force
    for j in range(law.decays.size):
        flow += law.flows[j] * remainders[j]
    return force, flow / stiffness


@njit(inner=True)
def _gap_of_next(row, law, state, t, count):
    """The gap of the first free spring from the undeformed surface; the limit of the depth if there is none."""
    return _gap_now(state, law, row.gaps[count], t, count) if count < row.gaps.size else row.limit


@njit(inner=True)
def _jump(row, law, state, t, u, force, count, target, by_depth, release_amounts):
    """Step of the load to `target` at a time; returns u, F, the number of springs in contact, and how it ended."""
    if law.viscosity > 0 and not by_depth:
        # The surface stays, and springs that would be pulled let go.
        while count > 1:
            value, _, rounding = _release(row, law, state, t, u, target, 0.0, count, by_depth, release_amounts)
            if value <= rounding:
                break
            count = _let_go(row, law, state, t, u, count)
        return u, target, count, SETTLED
    if law.viscosity > 0:
        # The surface stays: all springs let go at once, or none is touched.
        rises = count > 0 and target > u
        while count > 0 and target < u:
            count = _let_go(row, law, state, t, u, count)
        overlap = target - _gap_of_next(row, law, state, t, count)
        return target, force, count, INFINITE if rises or overlap > _ROUNDING * abs(target) else SETTLED
    modulus = law.relaxed + law.moduli.sum()
    # The path from one load to the other, along which springs touch or let go in their order.
    for _ in range(_MOST_AT_ONCE * row.gaps.size + 8):
        rises = target > (u if by_depth else force)
        step, reaches = 0.0, True
        if rises:
            step = max(_gap_of_next(row, law, state, t, count) - u, 0.0)
            reaches = step >= target - u if by_depth else row.stiffness[count] * modulus * step >= target - force
        elif count > (0 if by_depth else 1):
            value, _, _ = _release(row, law, state, t, u, force, 0.0, count, by_depth, release_amounts)
            step = min(value, 0.0) / modulus
            reaches = step <= target - u if by_depth else row.stiffness[count] * modulus * step <= target - force
        if reaches:
            step = target - u if by_depth else (target - force) / (row.stiffness[count] * modulus)
        state.common[:] += step
        u = target if by_depth and reaches else u + step
        force = target if reaches else force + row.stiffness[count] * modulus * step
        if reaches and not by_depth:
            u = _balanced(row, law, state, t, u, force, count)
        if reaches:
            return u, force, count, SETTLED
        if rises and count == row.gaps.size:
            return u, force, count, BEYOND
        if rises:
            count = _touch(row, law, state, t, u, force, count, by_depth)
        else:
            count = _let_go(row, law, state, t, u, count)
    return u, force, count, RESTLESS


@njit(inner=True)
def _next_touch(row, law, state, t, u, force, rate, count, by_depth, remainders, until, touch_amounts, drive):
    """Time from now on at which the first free spring is touched; infinite if it is not, until then."""
    reached = _gap_of_next(row, law, state, t, count)
    if not np.isfinite(reached):
        return np.inf
    slope, bend = rate, 0.0
    touch_amounts[:] = 0.0
    drive[:] = 0.0
    if not by_depth:
        stiffness = row.stiffness[count]
        slope = (law.instantaneous * rate + law.fluidity * force) / stiffness
        bend = 0.5 * law.fluidity * rate / stiffness
        for j in range(law.decays.size):
            touch_amounts[j] = law.flows[j] * remainders[j] / stiffness
            drive[j] = law.flows[j] * rate / stiffness
    if count < row.gaps.size:
        for j in range(law.decays.size):
            if state.remainder[count, j] != 0:
                kept = np.exp(-law.decays[j] * (t - state.left[count]))
                touch_amounts[j] -= law.flows[j] * state.remainder[count, j] * kept
    rounding = _ROUNDING * (abs(u) + (row.gaps[count] if count < row.gaps.size else 0.0))
    return _first_crossing(until, rounding, u - reached, slope, bend, touch_amounts, drive, law.decays)


@njit(inner=True)
def _move(row, law, state, end, u, force, rate, count, by_depth, remainders, s):
    """Move by a time s without events, to the time `end`, and return u; common variables and remainders are changed.

    The end is passed because it is rounded: offsets of springs that touch there must decay from the same time.
    """
    if by_depth:
        for b in range(law.rates.size):
            x = law.rates[b] * s
            state.common[b] = state.common[b] * np.exp(-x) + rate * s * _mean_decay(x)
        return u + rate * s
    stiffness = row.stiffness[count]
    rise = s * (law.instantaneous * rate + law.fluidity * (force + 0.5 * rate * s))
    for j in range(law.decays.size):
        x = law.decays[j] * s
        mean = s * _mean_decay(x)
        rise += law.flows[j] * (remainders[j] * mean + rate * s * s * _second_mean(x))
        remainders[j] = remainders[j] * np.exp(-x) + rate * mean
    for b in range(law.rates.size):
        variable = law.fluidity * (force + rate * s) / law.rates[b]
        for j in range(law.decays.size):
            variable += law.branches[b, j] * remainders[j]
        variable -= state.total[count - 1, b] * np.exp(-law.rates[b] * (end - state.joined[count - 1]))
        state.common[b] = variable / stiffness
    return u + rise / stiffness


@njit
def _march(gaps, weights, limit, law, times, load, by_depth):
    """See move_row; times start at 0."""
    springs, samples = gaps.size, times.size
    branches, elements = law.rates.size, law.decays.size
    row = _Row(gaps, weights, np.zeros(springs + 1), np.zeros(springs + 1), limit)
    for i in range(springs):
        row.stiffness[i + 1], row.moment[i + 1] = row.stiffness[i] + weights[i], row.moment[i] + weights[i] * gaps[i]
    state = _State(
        np.zeros(branches), np.zeros(springs), np.zeros((springs, branches)), np.zeros((springs, branches)),
        np.zeros(springs), np.zeros(springs), np.zeros((springs, elements)), np.zeros(1, np.int64), np.full(1, np.nan),
    )  # fmt: skip
    depth, force, velocity = np.full(samples, np.nan), np.full(samples, np.nan), np.full(samples, np.nan)
    in_contact, deflection, largest = np.zeros(samples, np.int64), np.zeros(samples), np.ones(samples, np.bool_)
    fastest = law.rates.max() if branches else 0.0
    release_amounts, none = np.zeros(branches), np.zeros(branches)
    touch_amounts, drive, remainders = np.zeros(elements), np.zeros(elements), np.zeros(elements)
    t, u, f, rate, count, ended, until = 0.0, 0.0, 0.0, 0.0, 0, SETTLED, times[-1]
    if not by_depth:
        u, count = gaps[0], _touch(row, law, state, t, gaps[0], f, 0, by_depth)

    for k in range(samples):
        last, before = (times[k - 1], load[k - 1]) if k else (times[0], 0.0)
        length, rate = times[k] - last, 0.0
        if length == 0:
            remainders += load[k] - f
            u, f, count, ended = _jump(row, law, state, t, u, f, count, load[k], by_depth, release_amounts)
            if law.viscosity > 0 and not by_depth:
                _remainders_in_contact(row, law, state, t, u, f, count, remainders)
        else:
            rate, f = (load[k] - before) / length, before
            # The time since the start of the interval has more digits than the time itself: first springs may be soft.
            passed, started, events, at, pauses = 0.0, False, 0, 0.0, 0
            while True:
                now, speed = _observe(row, law, state, t, u, f, rate, count, by_depth, remainders)
                touch = _next_touch(
                    row, law, state, t, u, f, rate, count, by_depth, remainders, length - passed, touch_amounts, drive
                )
                release = np.inf
                if count > (0 if by_depth else 1):
                    value, slope, rounding = _release(row, law, state, t, u, f, rate, count, by_depth, release_amounts)
                    end = min(length - passed, touch)
                    release = _first_crossing(end, rounding, value, slope, 0.0, release_amounts, none, law.rates)
                event = min(touch, release)
                if events > _MOST_AT_ONCE * springs + 8:
                    # Equal contacts alternate within rounding, where a force vanishes: move on without an event.
                    events, event, pauses = 0, np.inf, pauses + 1
                    s = min(_PAUSE * times[k] * 2.0**pauses, length - passed)
                    paused, arrives = True, s == length - passed
                else:
                    paused, arrives = False, event > length - passed
                    s = length - passed if arrives else event
                approaches = release < touch and not arrives and not paused
                approaches = approaches and s * fastest > _FORGOTTEN and passed + _APPROACH * s > passed
                if approaches:
                    s *= _APPROACH
                if k and not started and passed + s > _AT_ONCE * (last if last > 0 else length):
                    started = True
                    velocity[k - 1] = speed
                    # At a prescribed depth a force changes at once with the rate only in a parallel dashpot. The fast
                    # branches of a springpot release springs soon after the sample, but not at it.
                    if law.viscosity > 0 or not by_depth:
                        force[k - 1], in_contact[k - 1] = now, count
                        largest[k - 1] = count >= state.most[0]
                passed = length if arrives else passed + s
                t = times[k] if arrives else last + passed
                u = _move(row, law, state, t, u, f, rate, count, by_depth, remainders, s)
                # From the end of the interval with the smaller load, so that a load that vanishes keeps its digits.
                f = before + rate * passed if abs(before) < abs(load[k]) else load[k] - rate * (length - passed)
                if arrives:
                    break
                if pauses > _MOST_PAUSES:
                    ended = RESTLESS
                    break
                if approaches or paused:
                    continue
                events = events + 1 if passed == at else 1
                at = passed
                if release < touch:
                    count = _let_go(row, law, state, t, u, count)
                    if count > 0 and not by_depth:
                        u = _balanced(row, law, state, t, u, f, count)
                    if count > 0:
                        _remainders_in_contact(row, law, state, t, u, f, count, remainders)
                elif count == springs:
                    ended = BEYOND
                else:
                    if not by_depth:
                        u = _balanced(row, law, state, t, u, f, count)
                    kept = np.exp(-law.decays * (t - state.left[count]))
                    remainders += weights[count] * state.remainder[count] * kept
                    count = _touch(row, law, state, t, u, f, count, by_depth)
                if ended != SETTLED:
                    break
            if by_depth and ended == SETTLED:
                u = load[k]
        if ended != SETTLED:
            until = t
            break
        # The state at this sample, or just before it. The next interval replaces what changes at its start.
        force[k], velocity[k] = _observe(row, law, state, t, u, f, rate, count, by_depth, remainders)
        depth[k], in_contact[k], largest[k] = u, count, count >= state.most[0]
        deflection[k] = row.stiffness[count] * u - row.moment[count]

    pressures, surface = np.zeros(springs), np.full(springs, u)
    for i in range(count, springs):
        surface[i] = _gap_now(state, law, gaps[i], t, i)
    for i in range(count):
        pressures[i] = law.relaxed * (u - gaps[i]) + law.viscosity * velocity[-1]
        for b in range(branches):
            own = state.common[b] + state.offset[i, b] * np.exp(-law.rates[b] * (t - state.joined[i]))
            pressures[i] += law.moduli[b] * own
    pressures = np.maximum(pressures, 0.0)
    return depth, force, velocity, in_contact, deflection, largest, state.receding[0], pressures, surface, ended, until
