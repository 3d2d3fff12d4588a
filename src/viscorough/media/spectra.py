"""Spectra of media of springs and dashpots, and the exact conversion between relaxation and retardation.

With the Laplace transforms ψ̂ and Ĵ of relaxation modulus and creep compliance, the relaxance Q(s) = s ψ̂(s) satisfies
s Ĵ(s) = 1/Q(s). Q has a pole at s = −r for every relaxation rate r. It has a zero at s = −λ for every retardation rate
λ. Poles and zeros alternate (Gross 1953; Tschoegl 1989).

`power_law_spectrum` approximates a springpot, which creeps by a power law of time, by springs and dashpots.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from viscorough.basics.types import Array

# Relative error of the springs and dashpots that approximate a power law.
POWER_LAW_ERROR = 1e-8
# Slow elements may be replaced up to a rate z/T with z^(4−a) = _SLOW_ERROR times this error, see `power_law_spectrum`.
_SLOW_ERROR = 100.0
# Number of bisections of an interval that contains a zero. The first ten reduce the ratio of the ends of the interval
# to 2. The others find the zero to rounding.
_BISECTIONS = 80
# The upper bound of the largest relaxation rate is increased by this share, because of rounding.
_MARGIN = 1e-9


class RelaxationSpectrum(NamedTuple):
    """Relaxation modulus ψ(t) = η δ(t) + G∞ + Σ G_i exp(−t/τ_i) of a dashpot, a spring and branches in parallel.

    A branch consists of a spring and a dashpot in series (Maxwell).

    viscosity : η of the parallel dashpot, 0 without a dashpot
    relaxed_modulus : G∞ of the parallel spring, 0 without a spring
    moduli, times : modulus G_i > 0 and relaxation time τ_i > 0 of each branch, arrays of shape (branches,)
    """

    viscosity: float
    relaxed_modulus: float
    moduli: Array
    times: Array

    @property
    def instantaneous_modulus(self) -> float:
        """Return G∞ + Σ G_i, the modulus at time 0 of a medium without a parallel dashpot."""
        return self.relaxed_modulus + self.moduli.sum()


class RetardationSpectrum(NamedTuple):
    """Creep compliance J(t) = J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)) of a spring, a dashpot and elements in series.

    An element consists of a spring and a dashpot in parallel (Kelvin-Voigt).

    instantaneous_compliance : J₀ of the spring, 0 without a spring
    fluidity : φ of the dashpot, the inverse of its viscosity; 0 without a dashpot
    compliances, times : compliance J_j > 0 and retardation time θ_j > 0 of each element, arrays of shape (elements,)
    """

    instantaneous_compliance: float
    fluidity: float
    compliances: Array
    times: Array


class Spectrum(NamedTuple):
    """Relaxation and retardation spectrum of a medium, and matrices that convert their internal variables.

    J = J₀ + φ₀ t + Σ J_j (1 − exp(−λ_j t)) and ψ = η δ(t) + G∞ + Σ G_b exp(−r_b t).

    viscosity, relaxed : η of the parallel dashpot and G∞ of the parallel spring
    moduli, rates : moduli G_b and rates r_b of the Maxwell branches, shape (branches,)
    instantaneous, fluidity : J₀ of the spring and φ₀ of the dashpot in series
    flows, decays : J_j λ_j and rates λ_j of the Kelvin-Voigt elements with compliances J_j, shape (elements,)
    remainders : matrix G_b r_b/(r_b − λ_j), which converts internal variables w_b of branches to remainders ρ_j of
        elements, shape (branches, elements)
    branches : matrix J_j λ_j/(r_b − λ_j), which converts remainders ρ_j to internal variables w_b, shape (elements,
        branches)

    Both matrices are summed over their first index: whole rows, without gaps in memory, are added quickly. Functions
    that `njit` compiles take a spectrum as an argument.
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


def spectrum_of(relaxation: RelaxationSpectrum, retardation: RetardationSpectrum) -> Spectrum:
    """Return the Spectrum of the medium that has these two spectra."""
    rates, decays = 1 / relaxation.times, 1 / retardation.times
    flows = retardation.compliances * decays
    if relaxation.viscosity:
        remainders, branches = np.zeros((0, decays.size)), np.zeros((decays.size, 0))
    else:
        apart = rates[:, None] - decays
        # If a relaxation rate equals a retardation rate within rounding, the modulus of the branch is negligible, and
        # its coefficients are set to 0.
        inverse = np.divide(1.0, apart, out=np.zeros_like(apart), where=apart != 0)
        remainders = (relaxation.moduli * rates)[:, None] * inverse
        branches = np.ascontiguousarray((flows * inverse).T)
    return Spectrum(
        float(relaxation.viscosity), float(relaxation.relaxed_modulus), np.ascontiguousarray(relaxation.moduli), rates,
        float(retardation.instantaneous_compliance), float(retardation.fluidity), flows, decays, remainders, branches,
    )  # fmt: skip


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


@np.errstate(over="ignore")  # rates of extreme media overflow; their motions are refused
def relaxation_spectrum(retardation: RetardationSpectrum) -> RelaxationSpectrum:
    """Return the RelaxationSpectrum of the same medium as a RetardationSpectrum.

    This is the inverse of `retardation_spectrum`. Without a spring (J₀ = 0), the medium must be Newtonian or
    Kelvin-Voigt; with a spring, it needs a dashpot (φ > 0) or at least one element. With the
    retardation rates λ_j = 1/θ_j, the relaxation rates r are the zeros of s Ĵ(s) = J₀ + φ/s + Σ J_j λ_j/(s + λ_j) at
    s = −r. One zero lies between every two neighbouring λ_j, and one above all λ_j. If φ > 0, a further zero lies below
    the smallest λ_j, and G∞ = 0. Otherwise G∞ = 1/(J₀ + Σ J_j). The moduli are
    G_i = 1/(φ/r_i + r_i Σ_j J_j λ_j/(r_i − λ_j)²).

    The unknown is the distance of a zero from the nearest λ_j, so that a zero that is close to a λ_j loses no digits.
    """
    instantaneous, fluidity, compliances, times = retardation
    if instantaneous == 0:
        relaxed = float(1 / compliances[0]) if times.size else 0.0
        viscosity = relaxed * float(times[0]) if times.size else 1 / fluidity
        return RelaxationSpectrum(viscosity, relaxed, np.array([]), np.array([]))
    order = np.argsort(-times)
    decays, flows = 1 / times[order], (compliances / times)[order]
    below = np.append(0.0, decays) if fluidity else decays
    # The largest zero lies below the sum of the largest λ_j and (φ + Σ J_j λ_j)/J₀.
    above = np.append(below[1:], below[-1] + (fluidity + flows.sum()) / instantaneous * (1 + _MARGIN))
    from_decays = decays[:, None]  # the following arrays have a row per retardation rate and a column per zero

    def response(pole: Array, distance: Array) -> Array:
        elements = (flows[:, None] / (from_decays - pole - distance)).sum(axis=0)
        return instantaneous - fluidity / (pole + distance) + elements

    half = 0.5 * (above - below)
    lower = response(below, half) > 0
    pole, sign = np.where(lower, below, above), np.where(lower, 1.0, -1.0)
    distance = sign * zero_of_increasing(lambda size: sign * response(pole, sign * size), np.finfo(float).tiny, half)
    rates = pole + distance
    slopes = fluidity / rates + rates * (flows[:, None] / (from_decays - pole - distance) ** 2).sum(axis=0)
    relaxed = 0.0 if fluidity else 1 / (instantaneous + compliances.sum())
    return RelaxationSpectrum(0.0, relaxed, 1 / slopes, 1 / rates)


def power_law_spectrum(modulus: float, exponent: float, shortest: float, longest: float) -> RetardationSpectrum:
    """Return springs and dashpots with J = t^a/(K Γ(1 + a)) at times t from `shortest` to `longest`.

    modulus, exponent : K and a of the springpot

    The integral t^a/Γ(1 + a) = sin(πa)/π ∫(1 − exp(−t eˣ)) exp(−a x) dx is replaced by a sum at equal steps of x, with
    one Kelvin-Voigt element per step. A spring replaces all elements that are much faster than `shortest`. A dashpot
    and one element replace all elements whose rates λ are at most z/T, where T = `longest`. Each of these creeps by
    λt − (λt)²/2 + (λt)³/6 − …. The three unknowns φ, J and λ of the replacement follow from the sums m_n of the first
    three terms, φ + Jλ = m₁, Jλ² = m₂ and Jλ³ = m₃, and the relative error of J(T) is less than z^(4−a)/1000. With all
    errors, the relative error of J is about 1e-8.
    """
    logarithm = -np.log(POWER_LAW_ERROR)
    step = np.pi**2 / logarithm
    start = np.log(_SLOW_ERROR * POWER_LAW_ERROR) / (4 - exponent) - np.log(longest)
    logarithms = np.arange(start, np.log(logarithm / shortest) + step, step)
    weight = np.sin(np.pi * exponent) / np.pi * step / modulus
    faster = np.exp(-exponent * (logarithms[-1] + step)) / -np.expm1(-exponent * step)
    powers = np.arange(1, 4) - exponent
    first, second, third = np.exp(powers * (logarithms[0] - step)) / -np.expm1(-powers * step)
    slow = third / second
    return RetardationSpectrum(
        weight * faster,
        weight * (first - second / slow),
        weight * np.append(second / slow**2, np.exp(-exponent * logarithms)),
        np.append(1 / slow, np.exp(-logarithms)),
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
