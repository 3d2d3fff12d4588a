"""Many realizations of a line, by the seeds of the study: moments, spectrum and independence of heights and waves.

A line's coefficients are complex Gaussian numbers times a factor common to all of its waves, which sets the rms height.
Directions do not depend on that factor, nor do logarithms of powers over their mean within the line, here called
strengths: over those of the spectrum they have the mean 0 and the variance π²/6. False alarms have chances below 1e-3
for each test; seeds are fixed.
"""

import numpy as np
import pytest
from scipy import stats

from viscorough.lines import SelfAffineLines
from viscorough_study.run.seeds import line_key, realization_seed

HURST, POINTS, REALIZATIONS = 0.5, 512, 1000
WAVES = POINTS // 2 - 1  # without the shortest one, which is real
# Excess of the largest of n exponential variates over ln n that has a chance of 5e-5.
EXCESS = 10


@pytest.fixture(scope="module")
def heights():
    """Realizations of rms height 1, shape (REALIZATIONS, POINTS)."""
    lines, key = SelfAffineLines(HURST, POINTS), line_key(HURST)
    seeds = (realization_seed(2013, *key, number) for number in range(REALIZATIONS))
    return np.array([lines.heights(seed) for seed in seeds], dtype=float)


@pytest.fixture(scope="module")
def coefficients(heights):
    """Of the waves 1, 2, ..., over the root of the spectrum; shape (REALIZATIONS, WAVES)."""
    return np.fft.rfft(heights)[:, 1:-1] * np.arange(1, WAVES + 1) ** (HURST + 0.5)


@pytest.fixture(scope="module")
def directions(coefficients):
    return coefficients / abs(coefficients)


@pytest.fixture(scope="module")
def strengths(coefficients):
    log_power = np.log(abs(coefficients) ** 2)
    return log_power - log_power.mean(axis=1, keepdims=True)


def largest_exponential(variates):
    """Whether the largest of variates, exponential and of mean 1, is as large as that of so many ones may be."""
    return variates.max() < np.log(variates.size) + EXCESS


def test_mean_and_variance_are_the_same_at_every_point(heights):
    """Gaussian heights would have the variance 2 of their squares; those of a fixed rms height have less."""
    assert abs(heights.mean(axis=0)).max() < 4.5 / np.sqrt(REALIZATIONS)
    assert abs((heights**2).mean(axis=0) - 1).max() < 4.5 * np.sqrt(2 / REALIZATIONS)


def test_every_wave_has_the_power_of_the_spectrum(strengths):
    deviations = strengths.mean(axis=0) / np.sqrt(np.pi**2 / 6 / REALIZATIONS)
    assert abs(deviations).max() < 5
    assert 1e-4 < stats.chi2.cdf(np.sum(deviations**2), WAVES - 1) < 1 - 1e-4


def test_directions_and_strengths_have_their_distributions(coefficients, strengths):
    assert stats.kstest(np.angle(coefficients).ravel() / (2 * np.pi) % 1, "uniform").pvalue > 1e-4
    assert np.var(strengths) == pytest.approx(np.pi**2 / 6, rel=0.02)


def test_realizations_are_independent(directions, strengths):
    """No two have waves in common, be they turned, mirrored, or shifted from one wave to the next ones."""
    pairs = np.triu_indices(REALIZATIONS, 1)
    for shift in range(8):
        left, right = directions[:, shift:], directions[:, : WAVES - shift]
        for other in (right, right.conj()):
            products = abs(left @ other.T) ** 2 / (WAVES - shift)
            assert largest_exponential(products[pairs])
            assert np.mean(products[pairs]) == pytest.approx(1, abs=0.02)
    products = strengths @ strengths.T / (np.pi**2 / 6 * np.sqrt(WAVES))
    assert abs(products[pairs]).max() < 8
    assert np.var(products[pairs]) == pytest.approx(1, abs=0.05)
