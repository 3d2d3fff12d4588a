"""Discrete spectra of linear viscoelastic media, and the exact way from relaxation to retardation.

With the relaxance Q(s) = s ψ̂(s) of a relaxation modulus ψ, the creep compliance has s Ĵ(s) = 1/Q(s): the retardation
rates are the zeros of Q at s = −λ, which separate its poles, the relaxation rates (Gross 1953; Tschoegl 1989).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from viscorough.basics.types import Array
from viscorough.media.medium import RelaxationSpectrum, RetardationSpectrum

_POWER_LAW_ERROR = 1e-10
# Rate of the slowest element of a power law, times the longest time: creep by slower ones is linear to 1e-10.
_SLOWEST = 1e-10
_BISECTIONS = 80  # ten halve the exponent of any bracket to a factor of 2; the rest halve the number to its rounding


def retardation_spectrum(relaxation: RelaxationSpectrum) -> RetardationSpectrum:
    """The RetardationSpectrum of a RelaxationSpectrum: of a dashpot beside a spring or nothing, or with a branch.

    The zeros of Q(−λ) = G∞ + Σ G_i λ/(λ − r_i), r_i = 1/τ_i, lie one between neighbouring poles and, if G∞ > 0, one
    below the first; with G∞ = 0 the zero at λ = 0 is a dashpot with φ = 1/Σ G_i τ_i. Every zero is found as its
    distance from the nearest pole, so that zeros close to poles, as of moduli many decades apart, lose no digits.
    The strengths are J_j = 1/(λ_j Σ_i G_i r_i/(r_i − λ_j)²).
    """
    viscosity, relaxed, moduli, times = relaxation
    if viscosity:
        compliance = np.array([1 / relaxed] if relaxed else [])
        return RetardationSpectrum(0.0, 0.0 if relaxed else 1 / viscosity, compliance, viscosity * compliance)
    order = np.argsort(-times)
    rates, moduli = 1 / times[order], moduli[order]
    below = rates[:-1] if relaxed == 0 else np.append(0.0, rates[:-1])  # the pole, or 0, below each zero
    above = rates[rates.size - below.size :]
    from_rates = rates[:, None]  # relaxation rates down, zeros across

    def relaxance(pole: Array, distance: Array) -> Array:
        rate = pole + distance
        return relaxed + (moduli[:, None] * rate / (pole - from_rates + distance)).sum(axis=0)

    half = 0.5 * (above - below)
    # Q falls from +∞ (or G∞) to −∞ between poles: it is negative halfway if the zero is nearer to the lower one. Of 0,
    # which is no pole, distances are taken as well: a small zero is then found to its own rounding.
    lower = relaxance(below, half) < 0
    pole, sign = np.where(lower, below, above), np.where(lower, 1.0, -1.0)
    distance = sign * zero_of_increasing(lambda size: -sign * relaxance(pole, sign * size), np.finfo(float).tiny, half)
    zeros = pole + distance
    slopes = (moduli[:, None] * from_rates / (pole - from_rates + distance) ** 2).sum(axis=0)
    fluidity = 1 / (moduli / rates).sum() if relaxed == 0 else 0.0
    return RetardationSpectrum(1 / relaxation.instantaneous_modulus, fluidity, 1 / (zeros * slopes), 1 / zeros)


def relaxation_spectrum(retardation: RetardationSpectrum) -> RelaxationSpectrum:
    """Return the RelaxationSpectrum of a fluid with J₀ > 0 and φ > 0: the inverse of `retardation_spectrum`.

    The zeros of s Ĵ(s) = J₀ + φ/s + Σ J_j λ_j/(s + λ_j) at s = −r lie one below each rate λ_j = 1/θ_j and one above
    all of them. The moduli are G_i = 1/(φ/r + r Σ_j J_j λ_j/(r − λ_j)²).
    """
    instantaneous, fluidity, compliances, times = retardation
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
    """Return springs and dashpots that creep by t^a/(K Γ(1 + a)) at times from `shortest` to `longest`.

    t^a/Γ(1 + a) = sin(πa)/π ∫(1 − exp(−t eˣ)) exp(−a x) dx is summed at equal steps of x. Elements that are faster than
    `shortest` become a spring, and elements that are slower than `longest` a dashpot. Relative errors of J and ψ are
    about 1e-10.
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
    """Zeros of an increasing function of arrays, entry by entry, between 0 < low < high, to rounding.

    Bisection, of the exponent at first: zeros may be many decades from either end.
    """
    for _ in range(_BISECTIONS):
        middle = np.where(high > 2 * low, np.sqrt(low) * np.sqrt(high), low + 0.5 * (high - low))
        positive = function(middle) > 0
        low, high = np.where(positive, low, middle), np.where(positive, middle, high)
    return low + 0.5 * (high - low)
