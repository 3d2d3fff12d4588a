"""λ of curves with a given λ(X)."""

import numpy as np
import pytest

from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.mdr_lambda import match_lines

x = abscissa(1e-7, 10, 20)
BOOTSTRAP = {"resamples": 200, "seed": 1}
GEOMETRIC = BOOTSTRAP | {"average": "geometric"}


def scattered(beta, realizations, seed):
    """Return vt/h = X^β, each curve with a different factor."""
    factors = np.exp(0.3 * np.random.default_rng(seed).normal(size=(realizations, 1)))
    return factors * x**beta


def test_fit_returns_the_lambda_of_stretched_lines():
    """The discs are lines with s times the rms height, y3(X) = s y1(X/s), so the fit must return s for any curve."""
    steps = 7
    s = 10 ** (steps / 20)
    lines = scattered(0.4, 12, seed=8) * (1 + 0.5 * x)  # not a power law
    discs = s * np.roll(lines, steps, axis=1)
    value, low, high = match_lines(x, discs, lines, average="arithmetic", **BOOTSTRAP).lambda_in((1e-4, 1e-2))
    assert value == pytest.approx(np.pi * s**2, rel=1e-9)
    assert low < value < high
    match = match_lines(x, discs, lines, **GEOMETRIC)
    inner = (x > 1e-5) & (x < 1)
    np.testing.assert_allclose(match.lambda_at(x[inner])[0], np.pi * s**2, rtol=1e-9)
    best = match.best_stretch((1e-4, 1e-2))
    assert best[0] == pytest.approx(np.log(s), abs=1e-9)
    np.testing.assert_allclose(match.deviation(best, inner)[0], 0, atol=1e-9)


def test_best_stretch_makes_the_deviations_of_both_signs_equal():
    """Lines with another exponent deviate equally at both ends of the window, with opposite signs."""
    match = match_lines(x, scattered(0.5, 3, seed=1), scattered(0.4, 3, seed=1), **GEOMETRIC)
    window = (1e-4, 1e-2)
    inside = (x > 0.99e-4) & (x < 1.01e-2)
    deviation = match.deviation(match.best_stretch(window), inside)[0]
    assert deviation.max() == pytest.approx(-deviation.min(), rel=1e-9)
    assert deviation.max() == pytest.approx(0.1 * np.log(10), rel=1e-6)  # half of (0.5 − 0.4) over two decades


def test_deviation_is_nan_beyond_the_lines():
    lines = scattered(0.4, 3, seed=1)
    lines[0, x > 1e-2] = np.nan
    match = match_lines(x, scattered(0.4, 3, seed=1), lines, **GEOMETRIC)
    deviation = match.deviation(np.full(201, np.log(0.5)), np.full(x.size, True))[0]  # stretches the lines to 2X
    assert np.isfinite(deviation[x < 4.9e-3]).all()
    assert np.isnan(deviation[x > 5.1e-3]).all()
