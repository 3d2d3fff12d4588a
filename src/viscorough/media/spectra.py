"""Exact conversion between the relaxation spectrum and the retardation spectrum of springs and dashpots.

With the Laplace transforms ψ̂ and Ĵ of relaxation modulus and creep compliance, the relaxance Q(s) = s ψ̂(s) satisfies
s Ĵ(s) = 1/Q(s). Q has a pole at s = −r for every relaxation rate r. It has a zero at s = −λ for every retardation rate
λ. Poles and zeros alternate (Gross 1953; Tschoegl 1989).

`power_law_spectrum` approximates a springpot, which creeps by a power law of time, by springs and dashpots.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from viscorough.basics.types import Array
from viscorough.media.medium import RelaxationSpectrum, RetardationSpectrum

# Relative error of the springs and dashpots that approximate a power law.
_POWER_LAW_ERROR = 1e-10
# Rate of the slowest element in the approximation of a power law, multiplied by the longest time. Up to the longest
# time, the creep of slower elements is linear in time to 1e-10.
_SLOWEST = 1e-10
# Number of bisections of an interval that contains a zero. The first ten reduce the ratio of the ends of the interval
# to 2. The others find the zero to rounding.
_BISECTIONS = 80


def retardation_spectrum(relaxation: RelaxationSpectrum) -> RetardationSpectrum:
    """Return the RetardationSpectrum of the same medium as a RelaxationSpectrum.

    The medium is either a dashpot, alone or parallel to a spring, or it has at least one Maxwell branch and no parallel
    dashpot.

    With the relaxation rates r_i = 1/τ_i, the retardation rates λ are the zeros of Q(−λ) = G∞ + Σ G_i λ/(λ − r_i). One
    zero lies between every two neighbouring r_i. If G∞ > 0, a further zero lies below the smallest r_i. If G∞ = 0, the
    zero at λ = 0 is a dashpot with φ = 1/Σ G_i τ_i. The compliances are J_j = 1/(λ_j Σ_i G_i r_i/(r_i − λ_j)²).

    The unknown is the distance of a zero from the nearest r_i. So a zero that is close to an r_i loses no digits.
    Moduli that differ by many decades lead to such zeros.
    """
    viscosity, relaxed, moduli, times = relaxation
    if viscosity:
        compliance = np.array([1 / relaxed] if relaxed else [])
        return RetardationSpectrum(0.0, 0.0 if relaxed else 1 / viscosity, compliance, viscosity * compliance)
    order = np.argsort(-times)
    rates, moduli = 1 / times[order], moduli[order]
    # Each zero lies between `below` and `above`: two neighbouring relaxation rates, or 0 and the smallest rate.
    below = rates[:-1] if relaxed == 0 else np.append(0.0, rates[:-1])
    above = rates[rates.size - below.size :]
    from_rates = rates[:, None]  # the following arrays have a row per relaxation rate and a column per zero

    def relaxance(pole: Array, distance: Array) -> Array:
        rate = pole + distance
        return relaxed + (moduli[:, None] * rate / (pole - from_rates + distance)).sum(axis=0)

    half = 0.5 * (above - below)
    # Between two poles, Q falls from +∞ to −∞. So if Q is negative halfway, the zero is nearer to the lower pole.
    # Between 0, which is not a pole, and the first pole, Q falls from G∞ to −∞. In every interval, the distance of the
    # zero from the nearer end of the interval is computed, so that a zero near 0 keeps all its digits.
    lower = relaxance(below, half) < 0
    pole, sign = np.where(lower, below, above), np.where(lower, 1.0, -1.0)
    distance = sign * zero_of_increasing(lambda size: -sign * relaxance(pole, sign * size), np.finfo(float).tiny, half)
    zeros = pole + distance
    slopes = (moduli[:, None] * from_rates / (pole - from_rates + distance) ** 2).sum(axis=0)
    fluidity = 1 / (moduli / rates).sum() if relaxed == 0 else 0.0
    return RetardationSpectrum(1 / relaxation.instantaneous_modulus, fluidity, 1 / (zeros * slopes), 1 / zeros)


def relaxation_spectrum(retardation: RetardationSpectrum) -> RelaxationSpectrum:
    """Return the RelaxationSpectrum of the same fluid as a RetardationSpectrum with J₀ > 0 and φ > 0.

    This is the inverse of `retardation_spectrum`. With the retardation rates λ_j = 1/θ_j, the relaxation rates r are
    the zeros of s Ĵ(s) = J₀ + φ/s + Σ J_j λ_j/(s + λ_j) at s = −r. One zero lies below each λ_j, above the next smaller
    λ_j, and one zero lies above all λ_j. The moduli are G_i = 1/(φ/r_i + r_i Σ_j J_j λ_j/(r_i − λ_j)²).
    """
    instantaneous, fluidity, compliances, times = retardation
    if not times.size:  # a spring and a dashpot in series
        return RelaxationSpectrum(0.0, 0.0, np.array([1 / instantaneous]), np.array([instantaneous / fluidity]))
    decays = np.sort(1 / times)
    flows = (compliances / times)[np.argsort(1 / times)]
    most = np.finfo(float).max ** 0.25 * decays[-1]
    low, high = np.append(np.finfo(float).tiny ** 0.25 * decays[0], decays), np.append(decays, most)

    def response(rate: Array) -> Array:
        with np.errstate(divide="ignore"):
            return instantaneous - fluidity / rate + (flows / (decays - rate[:, None])).sum(axis=1)

    rates = zero_of_increasing(response, low, high)
    slopes = fluidity / rates + rates * (flows / (rates[:, None] - decays) ** 2).sum(axis=1)
    return RelaxationSpectrum(0.0, 0.0, 1 / slopes, 1 / rates)


def power_law_spectrum(modulus: float, exponent: float, shortest: float, longest: float) -> RetardationSpectrum:
    """Return springs and dashpots with J = t^a/(K Γ(1 + a)) at times t from `shortest` to `longest`.

    modulus, exponent : K and a of the springpot

    The integral t^a/Γ(1 + a) = sin(πa)/π ∫(1 − exp(−t eˣ)) exp(−a x) dx is replaced by a sum at equal steps of x, with
    one Kelvin-Voigt element per step. A spring replaces all elements that are much faster than `shortest`. A dashpot
    replaces all elements that are much slower than `longest`. Relative errors of J and ψ are about 1e-10.
    """
    step = np.pi**2 / -np.log(_POWER_LAW_ERROR)
    start = np.log(_SLOWEST / longest)
    logarithms = np.arange(start, np.log(-np.log(_POWER_LAW_ERROR) * 2 / shortest) + step, step)
    weight = np.sin(np.pi * exponent) / np.pi * step / modulus
    faster = np.exp(-exponent * (logarithms[-1] + step)) / -np.expm1(-exponent * step)
    slower = np.exp((1 - exponent) * (logarithms[0] - step)) / -np.expm1(-(1 - exponent) * step)
    return RetardationSpectrum(
        weight * faster, weight * slower, weight * np.exp(-exponent * logarithms), np.exp(-logarithms)
    )


def zero_of_increasing(function: Callable[[Array], Array], low: Any, high: Any) -> Array:
    """Return the zero of an increasing function between low and high, with 0 < low < high, to rounding.

    The function takes and returns an array. Each entry of the array is a separate equation, so there is one zero per
    entry. The zeros are found by bisection. While the ends of an interval are far apart, their logarithms are bisected,
    because a zero may be many decades from either end.
    """
    for _ in range(_BISECTIONS):
        middle = np.where(high > 2 * low, np.sqrt(low) * np.sqrt(high), low + 0.5 * (high - low))
        if ((middle <= low) | (middle >= high)).all():  # no numbers are left between the ends
            break
        positive = function(middle) > 0
        low, high = np.where(positive, low, middle), np.where(positive, middle, high)
    return low + 0.5 * (high - low)
