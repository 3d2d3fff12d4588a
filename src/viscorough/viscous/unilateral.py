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
   its curvature, and then found by Newton's method.
5. At a step of the load, every spring responds elastically with the modulus G₀ = G∞ + Σ G_b. The events at this time
   are followed in their order. A dashpot parallel to the medium does not move at a step.

The cost of an event is a few evaluations of these sums. It does not depend on the number of springs in contact.
"""

from typing import NamedTuple

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.interrupts import uninterrupted
from viscorough.basics.types import Array, Integers, Mask
from viscorough.media.creep_response import decay, exponential
from viscorough.media.spectra import Spectrum

# Rounding error of a force or an overlap, relative to the size of its terms. A spring is released only if its tension
# exceeds this error, and touches only if its overlap does.
_ROUNDING = 1e-14
# The time of an event is a zero of a function f. Newton's method ends when |f| is at most this multiple of the rounding
# error of f.
_CLOSE = 0.2
# An event counts as simultaneous with the sample before it if it follows within this share of the time of the sample.
# In the first interval between samples, this is a share of the length of the interval.
_AT_ONCE = 1e-11
# The force of a spring is a sum of exponentials of the time since the last event or sample. Terms that have decayed
# leave their rounding errors in the sum. If the next release is more than _FORGOTTEN relaxation times of the fastest
# branch ahead, the springs first move by the share _APPROACH of the time until the release. Then a new sum begins.
_FORGOTTEN, _APPROACH = 5.0, 0.999
# Largest number of halvings of the interval that contains the time of an event, and of Newton steps. Both numbers
# suffice to find the time to rounding.
_HALVINGS, _NEWTON_STEPS = 64, 60
# For x up to _SERIES_BELOW, `_second_mean` uses a series of _SERIES_TERMS terms.
_SERIES_BELOW, _SERIES_TERMS = 0.3, 12
# Limit for the number of events at one time, divided by the number of springs. Only rounding errors can lead to more
# events, since at one time a spring can be released once and touch once.
_MOST_AT_ONCE = 4
# If springs touch and are released at the same time without end, all springs move for a short time without touching or
# being released (a pause). The n-th pause between two samples, n ≤ _MOST_PAUSES, has the length _PAUSE · 2^n times the
# time of the second sample. So pauses last from the rounding error of a time to 1e-9 of the time.
_PAUSE, _MOST_PAUSES = 5e-16, 21

# Ways in which a motion ends: at the last sample (SETTLED), when the depth reaches its limit (BEYOND), at a step that
# needs an infinite force (INFINITE), or when springs touch and are released at the same time without end (RESTLESS).
SETTLED, BEYOND, INFINITE, RESTLESS = 0, 1, 2, 3


class RowMotion(NamedTuple):
    """Motion of a row of springs at given times; arrays of shape (times,) unless another shape is stated.

    The symbols are defined in the module docstring.

    depth, force, velocity : depth u, force F = Σ W φ, and velocity u' just after each time. At the last time, and at
        the first of two equal times (a step), they are the values just before it
    in_contact : number of springs in contact
    deflection : sum of stiffness × deflection, Σ W y, of the springs in contact
    largest : whether there are at least as many springs in contact as at any earlier time
    receding_from : time of the first release of a spring; nan if no spring is released
    pressures : force divided by stiffness, φ, of every spring at the last time, shape (springs,)
    surface : initial gap plus deflection, g + y, of every spring at the last time, shape (springs,)
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
    """Springs of a row, and sums over its first n springs for all n.

    gaps, weights, limit : arguments of `move_row`
    stiffness : sums of the stiffness for n = 0, 1, …, shape (springs + 1,)
    moment : sums of stiffness × gap for n = 0, 1, …, shape (springs + 1,)
    """

    gaps: Array
    weights: Array
    stiffness: Array
    moment: Array
    limit: float


class _State(NamedTuple):
    """State of the springs, in arrays that are changed in place; the symbols are defined in the module docstring.

    common : internal variables D_b that are common to the springs in contact, shape (branches,)
    joined : time of the last touch of each spring, shape (springs,)
    offset : offset of the internal variables of each spring from the D_b at the time `joined`, shape (springs,
        branches)
    total : sum of W × offset of each spring and all springs before it at the time `joined` of the spring, shape
        (springs, branches)
    left : time of the last release of each spring, shape (springs,)
    rest : deflection y of each spring at the time `left`, shape (springs,)
    remainder : remainders ρ_j of each spring at the time `left`, shape (springs, elements)
    since, kept : time since the last touch of a spring, shape (1,), and exp(−r_b · since), shape (branches,); see
        `_kept_since`
    most : largest number of springs in contact so far, shape (1,)
    receding : time of the first release of a spring, nan before it; shape (1,)
    """

    common: Array
    joined: Array
    offset: Array
    total: Array
    left: Array
    rest: Array
    remainder: Array
    since: Array
    kept: Array
    most: Integers
    receding: Array


def move_row(
    gaps: Array, weights: Array, limit: float, spectrum: Spectrum, times: Array, load: Array, *, by_depth: bool
) -> tuple[RowMotion, int, float]:
    """Return the motion of a row of springs, how it ended (SETTLED, BEYOND, INFINITE or RESTLESS), and its end time.

    gaps : increasing initial gaps g of the springs, shape (springs,)
    weights : stiffnesses W > 0 of the springs per unit modulus, shape (springs,)
    limit : depth at which the motion ends early
    times, load : depth or force at increasing times, linear in between, shape (times,); a time given twice is a step
    by_depth : whether `load` is a depth instead of a force

    A motion up to the last time is SETTLED. The motion ends early with BEYOND if the depth reaches the limit, and with
    INFINITE if a step of the depth presses on a parallel dashpot. It ends with RESTLESS if springs touch and are
    released at the same time without end, which should not happen.
    """
    with uninterrupted():
        *motion, ended, until = _march(gaps, weights, limit, spectrum, times - times[0], load, by_depth)
    motion = RowMotion(*motion)
    return motion._replace(receding_from=motion.receding_from + times[0]), ended, until + times[0]


@njit(inner=True)
def _second_mean(x, mean):
    """Return (x − 1 + exp(−x))/x², which is the double integral ∫₀ˣ ∫₀ˢ exp(−r) dr ds, divided by x².

    mean : (1 − exp(−x))/x
    """
    if x > _SERIES_BELOW:
        return (1 - mean) / x
    value = 0.0
    for n in range(_SERIES_TERMS, 0, -1):
        value = (1 - value * x) / (n + 1)
    return value


@njit(inner=True)
def _evaluate(s, value, slope, bend, first, second, rates):
    """Return f(s), f'(s), and upper bounds of f'' and −f'' that hold at all times after s.

    f is the tension of a spring, or the overlap of the indenter with a spring, after the time s:

        f(s) = value + slope s + bend s² + Σ_k ∫₀ˢ x_k(r) dr,    x_k(0) = first_k,    x_k' = second_k − rates_k x_k
    """
    f, rate = value + s * (slope + s * bend), slope + 2 * bend * s
    up, down = max(2 * bend, 0.0), max(-2 * bend, 0.0)
    for k in range(rates.size):
        if first[k] == 0 and second[k] == 0:
            continue
        x = rates[k] * s
        kept, mean = decay(x)
        gone = s * mean
        f += first[k] * gone
        rate += first[k] * kept + second[k] * gone
        if second[k] != 0:
            f += second[k] * s * s * _second_mean(x, mean)
        curvature = (second[k] - rates[k] * first[k]) * kept
        up += max(curvature, 0.0)
        down += max(-curvature, 0.0)
    return f, rate, up, down


@njit(inner=True)
def _first_crossing(end, rounding, value, slope, bend, first, second, rates):
    """Return the first s in [0, end] at which the function f of `_evaluate` exceeds `rounding`; inf if there is none.

    rounding : rounding error of f. If a smaller f counted as an event, a spring that was just released would touch
        again at once
    value, slope, bend, first, second, rates : coefficients of f, see `_evaluate`
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
        # In the interval from a to b, of length h, f has three upper bounds: a parabola through each end, and the chord
        # plus max(−f'') h²/8. If one of them is nowhere positive, there is no event in the interval.
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
    """Return a time s between a and b with f(s) = 0, found by Newton's method; `_evaluate` defines the function f.

    f increases from a to b and is positive at b.

    close : the search ends when |f| is at most this
    value, slope, bend, first, second, rates : coefficients of f, see `_evaluate`
    """
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
def _kept_since(spectrum, state, t, i):
    """Return exp(−r_b (t − t_i)) for every branch b, where t_i is the time when spring i touched last.

    The result is the array state.kept. An event needs the same values several times, so they are computed only if the
    time since the touch has changed.
    """
    since = t - state.joined[i]
    if since != state.since[0]:
        state.since[0] = since
        for b in range(spectrum.rates.size):
            state.kept[b] = exponential(spectrum.rates[b] * since)
    return state.kept


@njit(inner=True)
def _release(row, spectrum, state, t, u, force, rate, count, by_depth, first):
    """Return value, slope and rounding error of −φ, the tension of the last spring in contact.

    The spring is released when −φ becomes positive. To find this time, `_first_crossing` also needs the amplitudes of
    the exponentials in −φ; they are written to `first`.
    """
    top, gap = count - 1, row.gaps[count - 1]
    kept = _kept_since(spectrum, state, t, top)
    if by_depth:
        value = spectrum.relaxed * (u - gap) + spectrum.viscosity * rate
        size = spectrum.relaxed * (abs(u) + gap) + abs(spectrum.viscosity * rate)
        slope = spectrum.relaxed * rate
        for b in range(spectrum.rates.size):
            own = state.common[b] + state.offset[top, b] * kept[b]
            value += spectrum.moduli[b] * own
            size += spectrum.moduli[b] * (abs(own) + abs(state.common[b]))
            first[b] = -spectrum.moduli[b] * (rate - spectrum.rates[b] * own)
    else:
        stiffness, centre = row.stiffness[count], row.moment[count] / row.stiffness[count]
        value = force / stiffness + spectrum.relaxed * (centre - gap)
        size = abs(force / stiffness) + spectrum.relaxed * (centre + gap)
        slope = rate / stiffness
        for b in range(spectrum.rates.size):
            own = (state.offset[top, b] - state.total[top, b] / stiffness) * kept[b]
            value += spectrum.moduli[b] * own
            size += spectrum.moduli[b] * abs(own)
            first[b] = spectrum.moduli[b] * spectrum.rates[b] * own
    return -value, -slope, _ROUNDING * size


@njit(inner=True)
def _gap_now(state, spectrum, gap, t, i):
    """Return the depth g + y at which an indenter would touch the free spring i at time t."""
    since = t - state.left[i]
    for j in range(spectrum.decays.size):
        if state.remainder[i, j] != 0:
            _, mean = decay(spectrum.decays[j] * since)
            gap += spectrum.flows[j] * state.remainder[i, j] * since * mean
    return gap + state.rest[i]


@njit(inner=True)
def _remainders_in_contact(row, spectrum, state, t, u, force, count, remainders):
    """Set `remainders` in place to the R_j of the springs in contact; the R_j are defined in the module docstring."""
    stiffness, top = row.stiffness[count], count - 1
    if spectrum.viscosity > 0:
        remainders[:] = force - spectrum.relaxed * (stiffness * u - row.moment[count])
        return
    remainders[:] = 0.0
    kept = _kept_since(spectrum, state, t, top)
    for b in range(spectrum.rates.size):
        variable = stiffness * state.common[b] + state.total[top, b] * kept[b]
        for j in range(spectrum.decays.size):
            remainders[j] += spectrum.remainders[b, j] * variable


@njit(inner=True)
def _let_go(row, spectrum, state, t, u, count):
    """Release the last of `count` springs in contact and store its state.

    Return the new number of springs in contact.
    """
    top = count - 1
    if np.isnan(state.receding[0]):
        state.receding[0] = t
    state.left[top], state.rest[top] = t, u - row.gaps[top]
    if spectrum.viscosity > 0:
        for j in range(spectrum.decays.size):
            state.remainder[top, j] = -spectrum.relaxed * (u - row.gaps[top])
        return top
    state.remainder[top, :] = 0.0
    kept = _kept_since(spectrum, state, t, top)
    for b in range(spectrum.rates.size):
        own = state.common[b] + state.offset[top, b] * kept[b]
        for j in range(spectrum.decays.size):
            state.remainder[top, j] += spectrum.remainders[b, j] * own
    return top


@njit(inner=True)
def _touch(row, spectrum, state, t, u, force, count, by_depth):
    """Add the first free spring to the `count` springs in contact, and return the new number of springs in contact.

    The stored offset of the spring is chosen so that the formula of `_release` gives it a force of exactly zero.
    Otherwise rounding could release the spring again at once.
    """
    i, gap, stiffness = count, row.gaps[count], row.stiffness[count]
    state.joined[i], state.most[0] = t, max(state.most[0], count + 1)
    if spectrum.viscosity > 0:
        return count + 1
    if i == 0:
        state.common[:] = 0.0  # no spring is in contact: the common variables may start from any value
    from_balance = not by_depth and i > 0
    excess = spectrum.relaxed * (u - gap)
    if from_balance:
        excess = force / stiffness + spectrum.relaxed * (row.moment[count] / stiffness - gap)
    state.offset[i, :] = 0.0
    for j in range(spectrum.decays.size):
        if state.remainder[i, j] != 0:
            remainder = state.remainder[i, j] * exponential(spectrum.decays[j] * (t - state.left[i]))
            for b in range(spectrum.rates.size):
                state.offset[i, b] += spectrum.branches[j, b] * remainder
    kept = _kept_since(spectrum, state, t, max(i - 1, 0))
    for b in range(spectrum.rates.size):
        own = state.offset[i, b]
        state.offset[i, b] = own - state.common[b]
        before = state.total[i - 1, b] * kept[b] if i > 0 else 0.0
        state.total[i, b] = before
        excess += spectrum.moduli[b] * (state.offset[i, b] - before / stiffness if from_balance else own)
    excess /= spectrum.moduli.sum()
    for b in range(spectrum.rates.size):
        state.offset[i, b] -= excess
        state.total[i, b] += row.weights[i] * state.offset[i, b]
    return count + 1


@njit(inner=True)
def _carried(row, spectrum, state, t, u, count):
    """Return the force of the springs in contact, computed from their deflections and internal variables.

    The force of a parallel dashpot is not included.
    """
    stiffness, moment = row.stiffness[count], row.moment[count]
    force = spectrum.relaxed * (stiffness * u - moment)
    kept = _kept_since(spectrum, state, t, count - 1)
    for b in range(spectrum.rates.size):
        variable = stiffness * state.common[b] + state.total[count - 1, b] * kept[b]
        force += spectrum.moduli[b] * variable
    return force


@njit(inner=True)
def _balanced(row, spectrum, state, t, u, force, count):
    """Change the depth slightly, so that the springs in contact carry exactly the force, and return the new depth.

    The common variables change by the same step, in place. This correction is needed because the force of a released
    spring is zero only within rounding. Compared with the force of much softer springs in contact, this rounding error
    may be large.

    The depth is returned unchanged in two cases: in a fluid without a parallel spring, where the force does not depend
    on the depth itself, and with a parallel dashpot, where the depth follows from the force.
    """
    if spectrum.viscosity > 0 or spectrum.relaxed == 0:
        return u
    step = (force - _carried(row, spectrum, state, t, u, count)) / (
        row.stiffness[count] * (spectrum.relaxed + spectrum.moduli.sum())
    )
    state.common[:] += step
    return u + step


@njit(inner=True)
def _observe(row, spectrum, state, t, u, force, rate, count, by_depth, remainders):
    """Return force and velocity at time t.

    Under a prescribed force, `remainders` is set to the R_j in place. In a medium with a parallel dashpot, it keeps the
    value that was advanced from event to event. Computed from u and F, this value would lose all digits when creep has
    almost ended.
    """
    stiffness = row.stiffness[count]
    if by_depth:
        if count == 0:
            return 0.0, rate
        force = _carried(row, spectrum, state, t, u, count) + spectrum.viscosity * stiffness * rate
        return max(force, 0.0), rate
    if spectrum.viscosity == 0:
        _remainders_in_contact(row, spectrum, state, t, u, force, count, remainders)
    flow = spectrum.instantaneous * rate + spectrum.fluidity * force
    for j in range(spectrum.decays.size):
        flow += spectrum.flows[j] * remainders[j]
    return force, flow / stiffness


@njit(inner=True)
def _gap_of_next(row, spectrum, state, t, count):
    """Return the depth at which an indenter would touch the first free spring at time t; row.limit if none is free."""
    return _gap_now(state, spectrum, row.gaps[count], t, count) if count < row.gaps.size else row.limit


@njit(inner=True)
def _jump(row, spectrum, state, t, u, force, count, target, by_depth, release_amounts):
    """Change the load in a step at time t: the depth to `target` if `by_depth`, otherwise the force to `target`.

    Return the depth and the force after the step, the number of springs in contact, and how the step ended:

    - SETTLED: the load is `target`.
    - BEYOND: all springs touch and the depth reaches its limit before the load is `target`.
    - INFINITE: the step of the depth needs an infinite force, because of a parallel dashpot.
    - RESTLESS: springs touch and are released again without end.

    u, force, count : depth, force and number of springs in contact before the step
    release_amounts : work array for the argument `first` of `_first_crossing`, changed in place
    """
    if spectrum.viscosity > 0 and not by_depth:
        # The dashpot keeps the indenter in place. Release the springs that the new force would pull.
        while count > 1:
            value, _, rounding = _release(row, spectrum, state, t, u, target, 0.0, count, by_depth, release_amounts)
            if value <= rounding:
                break
            count = _let_go(row, spectrum, state, t, u, count)
        return u, target, count, SETTLED
    if spectrum.viscosity > 0:
        # The dashpot keeps the surface in place. If the indenter steps up, all springs are released. If it steps down
        # into the surface, the force is infinite.
        rises = count > 0 and target > u
        while count > 0 and target < u:
            count = _let_go(row, spectrum, state, t, u, count)
        overlap = target - _gap_of_next(row, spectrum, state, t, count)
        return target, force, count, INFINITE if rises or overlap > _ROUNDING * abs(target) else SETTLED
    modulus = spectrum.relaxed + spectrum.moduli.sum()
    # Move elastically from the old load to the new load. On the way, springs touch or are released, one after another.
    for _ in range(_MOST_AT_ONCE * row.gaps.size + 8):
        rises = target > (u if by_depth else force)
        step, reaches = 0.0, True
        if rises:
            step = max(_gap_of_next(row, spectrum, state, t, count) - u, 0.0)
            reaches = step >= target - u if by_depth else row.stiffness[count] * modulus * step >= target - force
        elif count > (0 if by_depth else 1):
            value, _, _ = _release(row, spectrum, state, t, u, force, 0.0, count, by_depth, release_amounts)
            step = min(value, 0.0) / modulus
            reaches = step <= target - u if by_depth else row.stiffness[count] * modulus * step <= target - force
        if reaches:
            step = target - u if by_depth else (target - force) / (row.stiffness[count] * modulus)
        state.common[:] += step
        u = target if by_depth and reaches else u + step
        force = target if reaches else force + row.stiffness[count] * modulus * step
        if reaches and not by_depth:
            u = _balanced(row, spectrum, state, t, u, force, count)
        if reaches:
            return u, force, count, SETTLED
        if rises and count == row.gaps.size:
            return u, force, count, BEYOND
        if rises:
            count = _touch(row, spectrum, state, t, u, force, count, by_depth)
        else:
            count = _let_go(row, spectrum, state, t, u, count)
    return u, force, count, RESTLESS


@njit(inner=True)
def _next_touch(row, spectrum, state, t, u, force, rate, count, by_depth, remainders, until, touch_amounts, drive):
    """Return the time from now until the indenter touches the first free spring; inf if it is longer than `until`.

    touch_amounts, drive : work arrays for the arguments `first` and `second` of `_first_crossing`, changed in place
    """
    reached = _gap_of_next(row, spectrum, state, t, count)
    if not np.isfinite(reached):
        return np.inf
    slope, bend = rate, 0.0
    touch_amounts[:] = 0.0
    drive[:] = 0.0
    if not by_depth:
        stiffness = row.stiffness[count]
        slope = (spectrum.instantaneous * rate + spectrum.fluidity * force) / stiffness
        bend = 0.5 * spectrum.fluidity * rate / stiffness
        for j in range(spectrum.decays.size):
            touch_amounts[j] = spectrum.flows[j] * remainders[j] / stiffness
            drive[j] = spectrum.flows[j] * rate / stiffness
    if count < row.gaps.size:
        for j in range(spectrum.decays.size):
            if state.remainder[count, j] != 0:
                kept = exponential(spectrum.decays[j] * (t - state.left[count]))
                touch_amounts[j] -= spectrum.flows[j] * state.remainder[count, j] * kept
    rounding = _ROUNDING * (abs(u) + (row.gaps[count] if count < row.gaps.size else 0.0))
    return _first_crossing(until, rounding, u - reached, slope, bend, touch_amounts, drive, spectrum.decays)


@njit(inner=True)
def _move(row, spectrum, state, end, u, force, rate, count, by_depth, remainders, s):
    """Advance the motion of all springs by a time s without events, and return the new depth.

    The common variables and the R_j (`remainders`) are changed in place.

    end : time at the end of the move, after rounding. It is passed instead of computed from s, because the offset of a
        spring that touches at this time decays from the same rounded time
    """
    if by_depth:
        for b in range(spectrum.rates.size):
            x = spectrum.rates[b] * s
            kept, mean = decay(x)
            state.common[b] = state.common[b] * kept + rate * s * mean
        return u + rate * s
    stiffness = row.stiffness[count]
    rise = s * (spectrum.instantaneous * rate + spectrum.fluidity * (force + 0.5 * rate * s))
    for j in range(spectrum.decays.size):
        x = spectrum.decays[j] * s
        kept, mean = decay(x)
        rise += spectrum.flows[j] * (remainders[j] * s * mean + rate * s * s * _second_mean(x, mean))
        remainders[j] = remainders[j] * kept + rate * s * mean
    for b in range(spectrum.rates.size):
        state.common[b] = spectrum.fluidity * (force + rate * s) / spectrum.rates[b]
    for j in range(spectrum.decays.size):
        for b in range(spectrum.rates.size):
            state.common[b] += spectrum.branches[j, b] * remainders[j]
    kept = _kept_since(spectrum, state, end, count - 1)
    for b in range(spectrum.rates.size):
        state.common[b] = (state.common[b] - state.total[count - 1, b] * kept[b]) / stiffness
    return u + rise / stiffness


@njit
def _march(gaps, weights, limit, spectrum, times, load, by_depth):
    """Return the fields of a RowMotion, how the motion ended, and when; see `move_row`. The first time is 0."""
    springs, samples = gaps.size, times.size
    branches, elements = spectrum.rates.size, spectrum.decays.size
    row = _Row(gaps, weights, np.zeros(springs + 1), np.zeros(springs + 1), limit)
    for i in range(springs):
        row.stiffness[i + 1], row.moment[i + 1] = row.stiffness[i] + weights[i], row.moment[i] + weights[i] * gaps[i]
    state = _State(
        np.zeros(branches), np.zeros(springs), np.zeros((springs, branches)), np.zeros((springs, branches)),
        np.zeros(springs), np.zeros(springs), np.zeros((springs, elements)), np.zeros(1), np.ones(branches),
        np.zeros(1, np.int64), np.full(1, np.nan),
    )  # fmt: skip
    depth, force, velocity = np.full(samples, np.nan), np.full(samples, np.nan), np.full(samples, np.nan)
    in_contact, deflection, largest = np.zeros(samples, np.int64), np.zeros(samples), np.ones(samples, np.bool_)
    fastest = spectrum.rates.max() if branches else 0.0
    release_amounts, none = np.zeros(branches), np.zeros(branches)
    touch_amounts, drive, remainders = np.zeros(elements), np.zeros(elements), np.zeros(elements)
    t, u, f, rate, count, ended, until = 0.0, 0.0, 0.0, 0.0, 0, SETTLED, times[-1]
    if not by_depth:
        u, count = gaps[0], _touch(row, spectrum, state, t, gaps[0], f, 0, by_depth)

    for k in range(samples):
        last, before = (times[k - 1], load[k - 1]) if k else (times[0], 0.0)
        length, rate = times[k] - last, 0.0
        if length == 0:
            remainders += load[k] - f
            u, f, count, ended = _jump(row, spectrum, state, t, u, f, count, load[k], by_depth, release_amounts)
            if spectrum.viscosity > 0 and not by_depth:
                _remainders_in_contact(row, spectrum, state, t, u, f, count, remainders)
        else:
            rate, f = (load[k] - before) / length, before
            # `passed` is the time since the start of the interval. Soon after the start it distinguishes times that are
            # equal in t within rounding.
            passed, started, events, at, pauses = 0.0, False, 0, 0.0, 0
            while True:
                now, speed = _observe(row, spectrum, state, t, u, f, rate, count, by_depth, remainders)
                touch = _next_touch(
                    row,
                    spectrum,
                    state,
                    t,
                    u,
                    f,
                    rate,
                    count,
                    by_depth,
                    remainders,
                    length - passed,
                    touch_amounts,
                    drive,
                )
                release = np.inf
                if count > (0 if by_depth else 1):
                    value, slope, rounding = _release(
                        row, spectrum, state, t, u, f, rate, count, by_depth, release_amounts
                    )
                    end = min(length - passed, touch)
                    release = _first_crossing(end, rounding, value, slope, 0.0, release_amounts, none, spectrum.rates)
                event = min(touch, release)
                if events > _MOST_AT_ONCE * springs + 8:
                    # A spring whose force is zero within rounding touches and is released again and again. Move on for
                    # a short time without events.
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
                    # Replace force and contact at the last sample by their values just after it. Under a prescribed
                    # depth this is done only in media with a parallel dashpot, whose force jumps with the velocity. In
                    # other media the fast branches that replace a springpot may release springs soon after the sample,
                    # although not at the sample.
                    if spectrum.viscosity > 0 or not by_depth:
                        force[k - 1], in_contact[k - 1] = now, count
                        deflection[k - 1] = row.stiffness[count] * depth[k - 1] - row.moment[count]
                        largest[k - 1] = count >= state.most[0]
                passed = length if arrives else passed + s
                t = times[k] if arrives else last + passed
                u = _move(row, spectrum, state, t, u, f, rate, count, by_depth, remainders, s)
                # Interpolate from the end of the interval with the smaller load. So a load that approaches zero keeps
                # its digits.
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
                    count = _let_go(row, spectrum, state, t, u, count)
                    if count > 0 and not by_depth:
                        u = _balanced(row, spectrum, state, t, u, f, count)
                    if count > 0 and spectrum.viscosity > 0 and not by_depth:
                        _remainders_in_contact(row, spectrum, state, t, u, f, count, remainders)
                elif count == springs:
                    ended = BEYOND
                else:
                    if not by_depth:
                        u = _balanced(row, spectrum, state, t, u, f, count)
                    if spectrum.viscosity > 0 and not by_depth:
                        remainders += (
                            weights[count] * state.remainder[count] * np.exp(-spectrum.decays * (t - state.left[count]))
                        )
                    count = _touch(row, spectrum, state, t, u, f, count, by_depth)
                if ended != SETTLED:
                    break
            if by_depth and ended == SETTLED:
                u = load[k]
        if ended != SETTLED:
            until = t
            break
        # Record the state at this sample. If the load has a kink or a step here, this is the state just before it. The
        # start of the next interval overwrites the velocity, and also force and contact if they change there.
        force[k], velocity[k] = _observe(row, spectrum, state, t, u, f, rate, count, by_depth, remainders)
        depth[k], in_contact[k], largest[k] = u, count, count >= state.most[0]
        deflection[k] = row.stiffness[count] * u - row.moment[count]

    pressures, surface = np.zeros(springs), np.full(springs, u)
    for i in range(count, springs):
        surface[i] = _gap_now(state, spectrum, gaps[i], t, i)
    for i in range(count):
        pressures[i] = spectrum.relaxed * (u - gaps[i]) + spectrum.viscosity * velocity[-1]
        for b in range(branches):
            own = state.common[b] + state.offset[i, b] * np.exp(-spectrum.rates[b] * (t - state.joined[i]))
            pressures[i] += spectrum.moduli[b] * own
    pressures = np.maximum(pressures, 0.0)
    return depth, force, velocity, in_contact, deflection, largest, state.receding[0], pressures, surface, ended, until
