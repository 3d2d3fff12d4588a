"""Discrete spectra of linear viscoelastic media, and the exact way from relaxation to retardation.

With the relaxance Q(s) = s ψ̂(s) of a relaxation modulus ψ, the creep compliance has s Ĵ(s) = 1/Q(s): the retardation
rates are the zeros of Q at s = −λ, which separate its poles, the relaxation rates (Gross 1953; Tschoegl 1989).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from viscorough.types import Array
from viscorough.viscous.medium import RelaxationSpectrum, RetardationSpectrum

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


def zero_of_increasing(function: Callable[[Array], Array], low: Any, high: Any) -> Array:
    """Zeros of an increasing function of arrays, entry by entry, between 0 < low < high, to rounding.

    Bisection, of the exponent at first: zeros may be many decades from either end.
    """
    for _ in range(_BISECTIONS):
        middle = np.where(high > 2 * low, np.sqrt(low) * np.sqrt(high), low + 0.5 * (high - low))
        positive = function(middle) > 0
        low, high = np.where(positive, low, middle), np.where(positive, middle, high)
    return low + 0.5 * (high - low)
