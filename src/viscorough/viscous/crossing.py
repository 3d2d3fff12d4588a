"""First time at which a sum of exponentials and a parabola in time becomes positive.

The tension of a spring and the overlap of the indenter with a spring are such sums. Their curvature has simple bounds,
which exclude a crossing in a part of the time or enclose it. Newton's method then finds it to rounding.
"""

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.media.creep_response import decay

# The time of a crossing is a zero of a function f. Newton's method ends when |f| is at most this multiple of the
# rounding error of f.
_CLOSE = 0.2
# Largest number of halvings of the interval that contains the crossing, and of Newton steps. Both numbers suffice to
# find the time to rounding.
_HALVINGS, _NEWTON_STEPS = 64, 60
# For x up to _SERIES_BELOW, `second_mean` uses a series of _SERIES_TERMS terms.
_SERIES_BELOW, _SERIES_TERMS = 0.3, 12
# Rounding error of the rate of a creep response, divided by the sum of the absolute values of its terms.
_RATE_ROUNDING = 1e-12


@njit(inner=True)
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
            f += second[k] * s * s * second_mean(x, mean)
        curvature = (second[k] - rates[k] * first[k]) * kept
        up += max(curvature, 0.0)
        down += max(-curvature, 0.0)
    return f, rate, up, down


@njit(inner=True)
def first_crossing(end, rounding, value, slope, bend, first, second, rates):
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
        s = first_crossing(length, _RATE_ROUNDING * size, -rate, bend, 0.0, first, still, decays)
        if s <= length:
            return times[k - 1] + s
        for j in range(decays.size):
            kept, mean = decay(decays[j] * length)
            carried[j] = carried[j] * kept + mean * change
    return np.nan
