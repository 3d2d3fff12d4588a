"""First time at which a sum of exponentials and a parabola in time becomes positive.

The tension of a spring and the overlap of the indenter with a spring are such sums. Their curvature has simple bounds,
which exclude a crossing in a part of the time or enclose it. Halley's method then finds it to rounding.
"""

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.media.creep_response import decay

# The time of a crossing is a zero of a function f. Halley's method ends when |f| is at most this multiple of the
# rounding error of f.
_CLOSE = 0.2
# Largest number of halvings of the interval that contains the crossing, and of Halley steps. Both numbers suffice to
# find the time to rounding.
_HALVINGS, _HALLEY_STEPS = 64, 120
# Number of times at which a crossing is expected that are tried before intervals are halved.
_GUESSES = 6
# Shape of the work array of `first_crossing`.
INTERVALS = _HALVINGS + 3 + _GUESSES, 5
# For x up to _SERIES_BELOW, `second_mean` uses a series of _SERIES_TERMS terms.
_SERIES_BELOW, _SERIES_TERMS = 0.3, 12
# Rounding error of the rate of a creep response, divided by the sum of the absolute values of its terms.
_RATE_ROUNDING = 1e-12


@njit(inner=True, counted=False)
def second_mean(x, mean):
    """Return (x − 1 + exp(−x))/x², which is the double integral ∫₀ˣ ∫₀ˢ exp(−r) dr ds, divided by x².

    mean : (1 − exp(−x))/x
    """
    if x > _SERIES_BELOW:
        return (1 - mean) / x
    value = 0.0
    for n in range(_SERIES_TERMS, 0, -1):
        value = (1 - value * x) / (n + 1)
    return value


@njit(inner=True, counted=False)
def _evaluate(s, value, slope, bend, first, second, rates):
    """Return f(s), f'(s), and upper bounds of f'' and −f'' that hold at all times after s; their difference is f''(s).

    f is the tension of a spring, or the overlap of the indenter with a spring, after the time s:

        f(s) = value + slope s + bend s² + Σ_k ∫₀ˢ x_k(r) dr,    x_k(0) = first_k,    x_k' = second_k − rates_k x_k
    """
    f, rate = value + s * (slope + s * bend), slope + 2 * bend * s
    bending, size = 2 * bend, abs(2 * bend)
    for k in range(rates.size):
        if first[k] == 0 and second[k] == 0:
            continue
        x = rates[k] * s
        kept, mean = decay(x)
        gone = s * mean
        f += first[k] * gone
        rate += first[k] * kept + second[k] * gone
        if second[k] != 0:
            f += second[k] * s * s * second_mean(x, mean)
        curvature = (second[k] - rates[k] * first[k]) * kept
        bending += curvature
        size += abs(curvature)
    return f, rate, 0.5 * (size + bending), 0.5 * (size - bending)


@njit(inner=True, counted=False)
def first_crossing(end, rounding, early, value, slope, bend, first, second, rates, stack):
    """Return the first s in [0, end] at which the function f of `_evaluate` exceeds `rounding`; inf if there is none.

    rounding : rounding error of f. If a smaller f counted as an event, a spring that was just released would touch
        again at once
    early : the search may end before the crossing, when −f is at most this
    value, slope, bend, first, second, rates : coefficients of f, see `_evaluate`
    stack : work array of shape INTERVALS for the ends of the intervals that are still to be searched: time, and results
        of `_evaluate` at this time. They are computed when they are needed; until then, the first of them is nan
    """
    value -= rounding
    if value > 0:
        return 0.0
    close = _CLOSE * rounding
    early = max(early, close)
    a, fa, da, bending, size = 0.0, value, slope, 2 * bend, abs(2 * bend)
    for k in range(rates.size):
        da += first[k]
        curvature = second[k] - rates[k] * first[k]
        bending += curvature
        size += abs(curvature)
    up, down = 0.5 * (size + bending), 0.5 * (size - bending)
    if not np.isfinite(end * end * size + abs(fa) + end * abs(da)):
        return np.inf  # the motion overflows
    top, stack[0, 0], stack[0, 1], guesses = 0, end, np.nan, 0
    while top >= 0:
        # Search first until the time at which a Halley step expects the crossing.
        soon = a + _halley_step(fa, da, up - down)
        if a < soon < stack[top, 0] and guesses < _GUESSES and np.isnan(stack[top, 1]):
            top, guesses = top + 1, guesses + 1
            stack[top, 0], stack[top, 1] = soon, np.nan
        b = stack[top, 0]
        h = b - a
        curved = 0.5 * up * h * h
        # In the interval from a to b, of length h, f has three upper bounds: a parabola through each end, and the chord
        # plus max(−f'') h²/8. If one of them is nowhere positive, there is no event in the interval.
        excluded = max(fa, fa + da * h + curved) <= 0
        if excluded and top == 0:
            return np.inf
        if np.isnan(stack[top, 1]):
            fb, db, ub, wb = _evaluate(b, value, slope, bend, first, second, rates)
            if not np.isfinite(fb):
                return np.inf  # the motion overflows
            stack[top, 1], stack[top, 2], stack[top, 3], stack[top, 4] = fb, db, ub, wb
        fb, db = stack[top, 1], stack[top, 2]
        increases = da - down * h > 0 or db - up * h > 0
        if increases and -early <= fb <= close and (fb > 0 or top > 0):
            return b
        excluded = excluded or (fb <= 0 and increases) or max(fb, fb - db * h + curved) <= 0
        if excluded or max(fa, fb) + 0.125 * down * h * h <= 0:
            a, fa, da, up, down = b, fb, db, stack[top, 3], stack[top, 4]
            top -= 1
            continue
        if fb > 0 and increases:
            if fb < -fa:
                fa, da, up, down = fb, db, stack[top, 3], stack[top, 4]
            return _increasing_zero(a, b, fa, da, up - down, early, close, value, slope, bend, first, second, rates)
        middle = a + 0.5 * h
        if top > _HALVINGS or middle <= a or middle >= b:
            if fb > 0:
                return b
            a, fa, da, up, down = b, fb, db, stack[top, 3], stack[top, 4]
            top -= 1
            continue
        top += 1
        stack[top, 0], stack[top, 1] = middle, np.nan
    return np.inf


@njit(inner=True, counted=False)
def _halley_step(f, rate, bending):
    """Return the distance to the zero of a function by Halley's method, from f, f' and f''; by Newton's if it fails."""
    divisor = 2 * rate * rate - f * bending
    return -2 * f * rate / divisor if divisor > 0 else -f / rate


@njit(inner=True, counted=False)
def _increasing_zero(a, b, f, rate, bending, early, close, value, slope, bend, first, second, rates):
    """Return a time s between a and b with f(s) = 0, found by Halley's method; `_evaluate` defines the function f.

    f increases from a to b and is positive at b.

    f, rate, bending : f, f' and f'' at the end with the smaller |f|: at a if f ≤ 0, otherwise at b
    early, close : the search ends when −f is at most `early` and f at most `close`
    value, slope, bend, first, second, rates : coefficients of f, see `_evaluate`
    """
    s, slow = b if f > 0 else a, False
    for _ in range(_HALLEY_STEPS):
        if f > 0:
            b = s
        else:
            a = s
        if -early <= f <= close:
            return s
        # Far from the zero, Halley steps can be far too short. Halve the interval if a step has not halved |f|.
        step = s + _halley_step(f, rate, bending) if rate > 0 and not slow else 0.5 * (a + b)
        if not a < step < b:
            step = a + 0.5 * (b - a)
        if not a < step < b:
            return b
        s, before = step, abs(f)
        f, rate, up, down = _evaluate(s, value, slope, bend, first, second, rates)
        bending, slow = up - down, not slow and abs(f) > 0.5 * before
    return b


@njit
def first_decrease(spectrum, times, force):
    """Return the first time at which the creep response Φ of a medium decreases; nan if it never does.

    With the parts R_j of the force that the dashpots of the Kelvin-Voigt elements carry, dΦ/dt is
    J₀ F' + φ F + Σ J_j λ_j R_j, where R_j' = F' − λ_j R_j. Between two samples this is a sum of exponentials. In a
    medium with J₀ > 0, Φ also decreases at a step of the force to a lower value.

    spectrum : Spectrum of the medium
    times, force : samples of the force, which is 0 before the first; a time that is given twice is a step
    """
    flows, decays = spectrum.flows, spectrum.decays
    carried, first, still = np.zeros(decays.size), np.zeros(decays.size), np.zeros(decays.size)
    stack = np.zeros(INTERVALS)
    carried[:] = force[0]
    for k in range(1, times.size):
        length, before, change = times[k] - times[k - 1], force[k - 1], force[k] - force[k - 1]
        if length == 0:
            if change < -_RATE_ROUNDING * before and spectrum.instantaneous > 0:
                return times[k]
            carried += change
            continue
        slope = change / length
        rate = spectrum.instantaneous * slope + spectrum.fluidity * before
        size = spectrum.instantaneous * abs(slope) + spectrum.fluidity * before
        for j in range(decays.size):
            rate += flows[j] * carried[j]
            size += flows[j] * abs(carried[j])
            first[j] = -flows[j] * (slope - decays[j] * carried[j])
        bend = -spectrum.fluidity * slope
        s = first_crossing(length, _RATE_ROUNDING * size, 0.0, -rate, bend, 0.0, first, still, decays, stack)
        if s <= length:
            return times[k - 1] + s
        for j in range(decays.size):
            kept, mean = decay(decays[j] * length)
            carried[j] = carried[j] * kept + mean * change
    return np.nan
