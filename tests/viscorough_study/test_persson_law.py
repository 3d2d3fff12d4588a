"""The exponential law of Persson's theory."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import beta, erf

from viscorough_study.literature import persson_u0


@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_a_wide_band_has_the_closed_form(hurst):
    exact = np.sqrt(hurst / (2 * np.pi * (1 - hurst))) * beta(0.5, hurst / (2 * (1 - hurst)))
    assert persson_u0(hurst, 1e40) == pytest.approx(exact, rel=1e-6)


def test_pressure_does_the_work_that_the_elastic_energy_takes():
    """−dU/dp over p is u₀/p at small pressures: E* = 1, q₀ = 1, H = 0.6, band 50."""
    hurst, band = 0.6, 50.0
    power = 2 * hurst
    h = np.sqrt(2 * np.pi * (1 - band**-power) / power)  # of C = q^(−2−2H)

    def energy(p):
        def density(q):
            w = (np.pi * (q ** (2 - power) - 1) / (2 - power)) ** -0.5
            return q ** (-power) * erf(w * p)

        return np.pi / 2 * quad(density, 1, band, limit=400)[0]

    p = 1e-3
    u0 = (energy(1.01 * p) - energy(0.99 * p)) / (0.02 * p)
    assert persson_u0(hurst, band) == pytest.approx(u0 / h, rel=1e-3)
