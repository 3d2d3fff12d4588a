"""Generated surfaces against the theory of Gaussian processes with a power-law spectrum.

Spectra are computed with numpy's transform of whole periods. It is unbiased: the power of every wave is its expectation
times an exponential variate.
"""

from functools import partial

import numpy as np
import pytest
from scipy import stats

from support.contract import refused
from viscorough.surfaces.lines import self_affine_line
from viscorough.surfaces.self_affine import cut_disc, self_affine_disc, self_affine_square
from viscorough_study.run.seeds import realization_seed


def waves_of_square(points):
    """Return the bins of np.fft.rfft2 that are independent complex waves, and their wavenumbers."""
    y = np.fft.fftfreq(points, 1 / points)[:, None]
    x = np.arange(points // 2 + 1.0)
    k = np.hypot(y, x)
    # At x = 0 one half of the bins mirrors the other. The shortest waves along an axis are real.
    chosen = (k > 0) & (k <= points / 2) & (x < points / 2) & (y > -points / 2) & ((x > 0) | (y > 0))
    return chosen, k[chosen]


def spectrum_of_square(hurst, **options):
    """Return wavenumber and power of every wave of a square with fixed amplitudes."""
    chosen, k = waves_of_square(64)
    square = self_affine_square(hurst, 64, amplitudes="fixed", seed=1, **options)
    return k, np.abs(np.fft.rfft2(square)[chosen]) ** 2


def spectrum_of_line(hurst, **options):
    line = self_affine_line(hurst, 4096, amplitudes="fixed", seed=1, dtype=float, **options)
    return np.arange(1, 2048), np.abs(np.fft.rfft(line.heights)[1:-1]) ** 2


@pytest.mark.parametrize("hurst", [0.0, 0.3, 1.0])
def test_fixed_amplitudes_are_the_spectrum(hurst):
    square, line = spectrum_of_square(hurst), spectrum_of_line(hurst)
    for (k, power), exponent in ((square, 2 * hurst + 2), (line, 2 * hurst + 1)):
        weighted = power * k**exponent
        np.testing.assert_allclose(weighted, weighted[0], rtol=1e-9)


def test_random_amplitudes_are_complex_gaussian():
    """Power is exponential and the phase uniform. Waves are as independent as numpy's random numbers."""
    chosen, k = waves_of_square(128)
    wave = np.fft.rfft2(self_affine_square(0.3, 128, seed=4))[chosen]
    power = np.abs(wave * k**1.3) ** 2
    power /= power.mean()
    phase = np.angle(wave) / (2 * np.pi) + 0.5
    # The chance of a false alarm is 1e-4 in each test; estimating the mean makes it smaller still in the first.
    assert stats.kstest(power, "expon").pvalue > 1e-4
    assert stats.kstest(phase, "uniform").pvalue > 1e-4


@pytest.mark.parametrize("density", [0.0, 0.25, 1.0])
def test_spectrum_is_flat_below_the_roll_off(density):
    """Fixed amplitudes give the spectrum itself. Waves of the roll-off wavelength belong to the power law."""
    square = spectrum_of_square(0.8, roll_off_wavelength=6.4, roll_off_level=density)
    line = spectrum_of_line(0.8, roll_off_wavelength=0.1, roll_off_level=density)
    for (k, power), exponent in ((square, -3.6), (line, -2.6)):
        relative, above = power / power[k == 10][0], k >= 10
        np.testing.assert_allclose(relative[above], (k[above] / 10) ** exponent, rtol=1e-9)
        np.testing.assert_allclose(relative[~above], density, rtol=1e-9, atol=1e-20)


@pytest.mark.parametrize("n", [1, 4, 5, 33])
def test_disc_is_cut_from_the_square(n):
    square = np.arange(40.0**2).reshape(40, 40)
    disc = cut_disc(square, n)
    from_centre = np.square(np.arange(n) - (n - 1) / 2)
    inside = np.add.outer(from_centre, from_centre) <= (n - 1) ** 2 / 4
    np.testing.assert_array_equal(disc, np.where(inside, square[:n, :n], np.nan))
    with pytest.raises(ValueError, match="at least 41 x 41 points"):
        cut_disc(square, 41)


@pytest.mark.parametrize("period", [1.0, 1.3])
def test_rms_height_follows_each_convention(period):
    options = {"rms": 3e-6, "diameter": 0.02, "period": period, "seed": 7}
    over_disc = self_affine_disc(0.6, 65, rms_over="disc", **options)
    over_square = self_affine_disc(0.6, 65, rms_over="square", **options)
    assert over_disc.spacing == over_square.spacing == 0.02 / 65
    assert np.nanstd(over_disc.heights) == pytest.approx(3e-6, rel=1e-12)
    square = self_affine_square(0.6, round(65 * period), seed=7)
    assert np.std(square) == pytest.approx(1, rel=1e-12)
    assert abs(square.mean()) < 1e-14
    np.testing.assert_allclose(over_square.heights, 3e-6 * cut_disc(square, 65), rtol=1e-14)
    ratio = over_disc.heights / over_square.heights
    np.testing.assert_allclose(ratio[~np.isnan(ratio)], np.nanmax(ratio), rtol=1e-12)


@pytest.mark.parametrize("generate", [partial(self_affine_disc, 0.4, 33), partial(self_affine_line, 0.4, 999)])
def test_realizations_depend_on_their_key_alone(generate):
    keys = [(2013, 1, 400000, 0, 0), (2013, 1, 400000, 0, 1), (2013, 1, 400000, 1, 0), (2014, 1, 400000, 0, 0)]
    batch = {key: generate(seed=realization_seed(*key)).heights for key in keys}
    for key in keys[::-1]:
        seed = realization_seed(*key)
        seed.spawn(3)
        np.testing.assert_array_equal(generate(seed=seed).heights, batch[key])
    others = [np.nan_to_num(heights).ravel() for heights in batch.values()]
    np.testing.assert_array_equal(np.abs(np.corrcoef(others)) > 0.999, np.eye(len(others), dtype=bool))
    np.testing.assert_array_equal(generate(seed=5).heights, generate(seed=np.random.SeedSequence(5)).heights)


def test_invalid_options_are_refused():
    disc, line = (self_affine_disc, 33), (self_affine_line, 33)
    for generators, options, message in (
        ((disc, line), {"hurst": 1.1}, "hurst: must be from 0 to 1"),
        ((disc, line), {"rms": 0}, "rms: must be a positive number"),
        ((disc, line), {"roll_off_wavelength": 0.01}, "roll_off_wavelength: must leave at least one wave"),
        ((disc, line), {"roll_off_level": -1}, "roll_off_level: must be a finite number >= 0"),
        ((disc, line), {"amplitudes": "gaussian"}, "amplitudes: must be 'random' or 'fixed'"),
        ((disc, line), {"seed": None}, "seed: must be a whole number"),
        ([(self_affine_disc, 2)], {}, "elements_across: must be a whole number of at least 3"),
        ([disc], {"period": 0.5}, "period: must be at least 1"),
        ([disc], {"diameter": -1.0}, "diameter: must be a positive number"),
        ([disc], {"rms_over": "line"}, "rms_over: must be 'disc' or 'square'"),
        ([(self_affine_line, 1)], {}, "points: must be a whole number of at least 2"),
        ([line], {"length": 0}, "length: must be a positive number"),
        ([line], {"dtype": np.float16}, "dtype: must be float32 or float64"),
        ([line], {"rms": 1e306, "dtype": float}, "rms: must be from 2.2e-305 to 1.8e.305 for float64"),
    ):
        for generate, size in generators:
            arguments = {"hurst": 0.5, "seed": 1} | options
            with refused(message):
                generate(arguments.pop("hurst"), size, **arguments)
