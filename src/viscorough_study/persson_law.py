"""The exponential law of pressure and separation in Persson's theory, for a self-affine surface."""

import numpy as np
from scipy.integrate import quad
from scipy.special import exprel


def persson_u0(hurst, band):
    """u₀/h of p ∝ exp(−u/u₀) at small pressures, without the fitted factor γ by which others multiply it.

    With the spectrum C ∝ q^(−2−2H) between q₀ and ζq₀ the theory has the elastic energy (π/2)E* ∫ q² C P dq for each
    area, where P = erf(w p/E*) and w(q) = (π ∫ q³ C dq)^(−1/2) up to q. From p du = −dU follows at small pressures

        u₀ = √π ∫ q² C w dq = h √(H/π) ∫₁^ζ x^(−2H) [(x^(2−2H) − 1)/(2 − 2H)]^(−1/2) dx / √(1 − ζ^(−2H)).

    hurst : H in (0, 1]; band : ζ, longest over shortest wavelength, above 1
    Source: B. N. J. Persson, Phys. Rev. Lett. 99, 125502 (2007).
    """

    def integrand(s):  # with x = exp(s²), which is regular at x = 1 and, unlike the one above, defined at H = 1
        return 2 * np.exp((1 - 2 * hurst) * s**2) / np.sqrt(exprel((2 - 2 * hurst) * s**2))

    integral, _ = quad(integrand, 0, np.sqrt(np.log(band)))
    return np.sqrt(hurst / np.pi) * integral / np.sqrt(-np.expm1(-2 * hurst * np.log(band)))
