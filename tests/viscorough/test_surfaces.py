"""Generated surfaces against the theory of Gaussian processes with a power-law spectrum.

Spectra are computed with numpy's transform of whole periods, which is unbiased: the power of every wave is its
expectation times an exponential variate, whose logarithm has the mean -γ and the variance π²/6. Slopes fitted to
logarithms do not depend on the scaling of a realization to its rms height.
"""

import tracemalloc

import numpy as np
import pytest
from scipy import stats

from viscorough import lines, surfaces
from viscorough.indenter import Indenter
from viscorough.surfaces import cut_disc, self_affine_disc, self_affine_line, self_affine_square
from viscorough_study.seeds import realization_seed

EULER = np.euler_gamma
VARIANCE = np.pi**2 / 6
HURST = [0.0, 0.3, 0.8, 1.0]


def waves_of_square(points):
    """Which bins of np.fft.rfft2 are independent complex waves, their wavenumber and direction."""
    y = np.fft.fftfreq(points, 1 / points)[:, None]
    x = np.arange(points // 2 + 1.0)
    k = np.hypot(y, x)
    # of x = 0 one half mirrors the other; the shortest waves along an axis are real
    chosen = (k > 0) & (k <= points / 2) & (x < points / 2) & (y > -points / 2) & ((x > 0) | (y > 0))
    return chosen, k[chosen], np.arctan2(y, x)[chosen]


def power_of_squares(hurst, points=64, realizations=20, **options):
    chosen, k, direction = waves_of_square(points)
    squares = (self_affine_square(hurst, points, seed=seed, **options) for seed in range(realizations))
    return k, direction, np.array([np.abs(np.fft.rfft2(z)[chosen]) ** 2 for z in squares])


def power_of_lines(hurst, points=4096, realizations=10, **options):
    lines = (self_affine_line(hurst, points, seed=seed, **options).heights for seed in range(realizations))
    return np.arange(1, points // 2), np.array([np.abs(np.fft.rfft(z)[1:-1]) ** 2 for z in map(np.double, lines)])


def fitted_slope(k, power):
    """Slope of ln power over ln k within realizations; its exact standard error for exponential variates."""
    x = np.log(k) - np.log(k).mean()
    return (np.log(power) @ x).mean() / (x @ x), np.sqrt(VARIANCE / (len(power) * (x @ x)))


@pytest.mark.parametrize("hurst", HURST)
def test_slope_of_square(hurst):
    k, _, power = power_of_squares(hurst)
    slope, error = fitted_slope(k, power)
    assert abs(slope + 2 * (hurst + 1)) < 4 * error
    assert error < 0.02


@pytest.mark.parametrize("hurst", HURST)
def test_slope_of_line(hurst):
    k, power = power_of_lines(hurst, dtype=np.float64)
    slope, error = fitted_slope(k, power)
    assert abs(slope + 2 * hurst + 1) < 4 * error
    assert error < 0.02


@pytest.mark.parametrize("hurst", HURST)
def test_fixed_amplitudes_are_the_spectrum(hurst):
    k, _, power = power_of_squares(hurst, realizations=2, amplitudes="fixed")
    weighted = power * k ** (2 * hurst + 2)
    np.testing.assert_allclose(weighted, weighted[0, 0], rtol=1e-9)
    k, power = power_of_lines(hurst, realizations=2, amplitudes="fixed", dtype=np.float64)
    weighted = power * k ** (2 * hurst + 1)
    np.testing.assert_allclose(weighted, weighted[0, 0], rtol=1e-9)


def test_waves_that_are_their_own_mirror_image():
    """Cosines at the Nyquist wavelength: real amplitudes, yet of the same mean power as their neighbours.

    ln χ² of one degree of freedom has the mean -γ - ln 2 and the variance π²/2.
    """
    realizations = 4000
    lines = (self_affine_line(0.5, 8, seed=s, dtype=np.float64).heights for s in range(realizations))
    log_power = np.log([np.abs(np.fft.rfft(z)[3:]) ** 2 for z in lines])
    excess = (log_power[:, 1] - log_power[:, 0]).mean() - (-2 * np.log(4 / 3) - np.log(2))
    assert abs(excess) < 4 * np.sqrt((np.pi**2 / 2 + VARIANCE) / realizations)

    squares = (self_affine_square(0.5, 4, corners=True, seed=s) for s in range(realizations))
    log_power = np.log([np.abs(np.fft.rfft2(z)[[2, 1], [2, 1]]) ** 2 for z in squares])
    excess = (log_power[:, 0] - log_power[:, 1]).mean() - (-3 * np.log(2) - np.log(2))
    assert abs(excess) < 4 * np.sqrt((np.pi**2 / 2 + VARIANCE) / realizations)


@pytest.mark.parametrize("amplitudes", ["random", "fixed"])
@pytest.mark.parametrize("points", [2, 3, 4, 5, 257, 1000, 2**15, 2**15 + 3])
def test_line_of_any_length(points, amplitudes):
    for dtype, rounding in ((np.float32, 1e-6), (np.float64, 1e-12)):
        line = self_affine_line(0.4, points, rms=2e-6, length=3.0, amplitudes=amplitudes, seed=9, dtype=dtype)
        assert line.heights.shape == (points,)
        assert line.heights.dtype == dtype
        assert line.spacing == 3.0 / points
        assert line.elements == points
        assert np.std(line.heights, dtype=float) == pytest.approx(2e-6, rel=rounding)
        assert abs(np.mean(line.heights, dtype=float)) < 2e-6 * rounding


@pytest.mark.parametrize(
    ("generate", "lowest", "highest"),
    [
        (lambda: self_affine_square(0.5, 300, seed=1), 25, surfaces._BYTES_PER_POINT),
        (lambda: self_affine_line(0.5, 300_000, seed=1).heights, 4, 4 * lines._COPIES),
    ],
    ids=["square", "line"],
)
def test_required_memory_is_enough(generate, lowest, highest):
    """Bytes per point that numpy allocates; the transform of a line makes a copy that is not counted."""
    generate()
    tracemalloc.start()
    heights = generate()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert lowest < peak / heights.size < highest


def test_single_precision_is_the_same_line():
    double = self_affine_line(0.7, 10_000, seed=9, dtype=np.float64).heights
    np.testing.assert_allclose(self_affine_line(0.7, 10_000, seed=9).heights, double, atol=3e-6)


def test_isotropic():
    """Equal power in eight directions; without corners, so that every direction has the same wavelengths."""
    k, direction, power = power_of_squares(0.8)
    log_power = np.log(power) + 2 * 1.8 * np.log(k)
    log_power -= log_power.mean(axis=1, keepdims=True)
    sector = np.floor((direction / np.pi + 0.5) * 8).astype(int) % 8
    for s in range(8):
        deviations = log_power[:, sector == s]
        assert abs(deviations.mean()) < 4 * np.sqrt(VARIANCE / deviations.size) < 0.1


def test_random_amplitudes_are_complex_gaussian():
    """Power is exponential, the phase uniform and independent of neighbours, in every realization."""
    chosen, k, _ = waves_of_square(128)
    square = np.fft.rfft2(self_affine_square(0.3, 128, seed=4))[chosen]
    line = np.fft.rfft(self_affine_line(0.3, 2**14, seed=4, dtype=np.float64).heights)[1:-1]
    for wave, exponent, k_ in ((square, 1.3, k), (line, 0.8, np.arange(1, 2**13))):
        power = np.abs(wave * k_**exponent) ** 2
        power /= power.mean()
        phase = np.angle(wave) / (2 * np.pi) + 0.5
        # chance of a false alarm 1e-4 each; estimating the mean makes the first one smaller still
        assert stats.kstest(power, "expon").pvalue > 1e-4
        assert stats.kstest(phase, "uniform").pvalue > 1e-4
        # means of N independent variates of variance 1 (products of unit powers), 1/2 (cosines)
        neighbours = np.mean((power[1:] - 1) * (power[:-1] - 1))
        assert abs(neighbours) < 5 / np.sqrt(power.size)
        assert abs(np.mean(np.cos(2 * np.pi * np.diff(phase)))) < 4 / np.sqrt(2 * power.size)
        assert abs(stats.spearmanr(power, phase).statistic) < 4 / np.sqrt(power.size)


@pytest.mark.parametrize("amplitudes", ["random", "fixed"])
def test_heights_are_gaussian(amplitudes):
    """Heights further apart than the roll-off wavelength are hardly correlated, hence a Gaussian sample.

    The rms of one surface is that of hundreds of such patches, so that scaling to it does not matter.
    """
    options = {"roll_off_wavelength": 8, "roll_off_level": 1.0, "amplitudes": amplitudes}
    sample = [self_affine_square(0.8, 128, seed=seed, **options)[::16, ::16] for seed in range(30)]
    sample = np.ravel(sample)
    assert stats.kstest(sample, "norm").pvalue > 1e-4
    assert abs(np.mean(sample**4) - 3) < 4 * np.sqrt(96 / sample.size)
    assert abs(np.mean(sample**3)) < 4 * np.sqrt(15 / sample.size)


@pytest.mark.parametrize("level", [0.0, 0.25, 1.0])
def test_roll_off(level):
    """Fixed amplitudes: the spectrum itself. Waves of the roll-off wavelength belong to the power law."""
    k, _, power = power_of_squares(
        0.8, realizations=1, amplitudes="fixed", roll_off_wavelength=6.4, roll_off_level=level
    )
    relative = power[0] / power[0][k == 10][0]
    np.testing.assert_allclose(relative[k >= 10], (k[k >= 10] / 10) ** -3.6, rtol=1e-9)
    np.testing.assert_allclose(relative[k < 10], level, rtol=1e-9, atol=1e-20)

    options = {
        "amplitudes": "fixed",
        "roll_off_wavelength": 0.1,
        "roll_off_level": level,
        "dtype": np.float64,
    }
    k, power = power_of_lines(0.8, realizations=1, **options)
    relative = power[0] / power[0][k == 10][0]
    np.testing.assert_allclose(relative[k >= 10], (k[k >= 10] / 10) ** -2.6, rtol=1e-9)
    np.testing.assert_allclose(relative[k < 10], level, rtol=1e-9, atol=1e-20)


def test_roll_off_of_disc_is_in_diameters():
    disc = self_affine_disc(0.8, 64, period=2.0, roll_off_wavelength=0.25, rms_over="square", seed=3)
    square = self_affine_square(0.8, 128, roll_off_wavelength=16, seed=3)
    np.testing.assert_array_equal(disc.heights, cut_disc(square, 64))


@pytest.mark.parametrize("points", [32, 33])
def test_squares_that_are_not_normalised_have_one_spectrum(points):
    """On average over 400 realizations, with the total power 1; normalised ones are the same up to a factor."""
    options = {"corners": True, "normalised": False}
    spectra = [np.abs(np.fft.fft2(self_affine_square(0.5, points, seed=seed, **options))) ** 2 for seed in range(400)]
    power = np.mean(spectra, axis=0) / points**4
    assert power.sum() == pytest.approx(1, abs=0.1)
    x = np.abs(np.fft.fftfreq(points, 1 / points))
    expected = np.hypot(x[:, None], x)
    expected[0, 0] = np.inf
    expected = expected**-3.0 / (expected**-3.0).sum()
    inside = expected > 0
    np.testing.assert_allclose(power[inside] / expected[inside], 1, atol=0.45)  # nine standard errors
    ratio = self_affine_square(0.5, points, seed=1, **options) / self_affine_square(0.5, points, seed=1, corners=True)
    np.testing.assert_allclose(ratio, ratio[0, 0], rtol=1e-9)


@pytest.mark.parametrize("points", [32, 33])
def test_corners(points):
    x = np.abs(np.fft.fftfreq(points, 1 / points))
    beyond = np.hypot(x[:, None], x) > points / 2
    power = np.abs(np.fft.fft2(self_affine_square(0.5, points, seed=1))) ** 2
    filled = np.abs(np.fft.fft2(self_affine_square(0.5, points, corners=True, seed=1))) ** 2
    assert power[beyond].max() < 1e-25 * power.max()
    assert np.all(filled[beyond] > 1e-12 * filled.max())
    inside = ~beyond & (power > 1e-20)
    assert np.ptp(power[inside] / filled[inside]) < 1e-9  # only scaled


def test_disc_of_257():
    disc = self_affine_disc(0.4, seed=1)
    assert disc.elements == 51433
    assert disc.heights.shape == (257, 257)
    assert disc.spacing == 1 / 257


@pytest.mark.parametrize("n", [1, 3, 4, 5, 8, 33])
def test_cut_disc(n):
    square = np.arange(40.0**2).reshape(40, 40)
    disc = cut_disc(square, n)
    inside = ~np.isnan(disc)
    centre = (n - 1) / 2
    for i in range(n):
        for j in range(n):
            assert inside[i, j] == ((i - centre) ** 2 + (j - centre) ** 2 <= centre**2)
    np.testing.assert_array_equal(disc[inside], square[:n, :n][inside])
    with pytest.raises(ValueError, match="at least 41 x 41 points"):
        cut_disc(square, 41)


@pytest.mark.parametrize("period", [1.0, 1.3, 2.0])
def test_rms_conventions(period):
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


@pytest.mark.parametrize(
    "generate",
    [lambda seed: self_affine_disc(0.4, 33, seed=seed), lambda seed: self_affine_line(0.4, 999, seed=seed)],
    ids=["disc", "line"],
)
def test_realizations_depend_on_their_key_alone(generate):
    keys = [(1, 400000, combination, realization) for combination in range(2) for realization in range(3)]
    batch = {key: generate(realization_seed(2013, *key)).heights for key in keys}
    for key in keys[::-1]:
        np.testing.assert_array_equal(generate(realization_seed(2013, *key)).heights, batch[key])
    seed = realization_seed(2013, *keys[0])
    seed.spawn(3)
    np.testing.assert_array_equal(generate(seed).heights, batch[keys[0]])

    others = [np.nan_to_num(heights).ravel() for heights in batch.values()]
    others += [np.nan_to_num(generate(realization_seed(2014, *keys[0])).heights).ravel()]
    np.testing.assert_array_equal(np.abs(np.corrcoef(others)) > 0.999, np.eye(len(others), dtype=bool))
    np.testing.assert_array_equal(generate(5).heights, generate(np.random.SeedSequence(5)).heights)


def test_gaps():
    heights = np.array([[1.0, np.nan], [3.0, 2.5]], dtype=np.float32)
    indenter = Indenter(heights, 1)
    np.testing.assert_array_equal(indenter.initial_gap, [[2.0, np.nan], [0.0, 0.5]])
    assert indenter.initial_gap.dtype == np.float64
    assert indenter.elements == 3
    assert Indenter([[1, 2], [3, 4]], 1).heights.dtype == np.float64


@pytest.mark.parametrize(
    ("heights", "spacing", "message"),
    [
        (np.zeros((2, 2, 2)), 1, "one or two dimensions, not 3"),
        (np.float64(1), 1, "one or two dimensions, not 0"),
        ([["a"]], 1, "real numbers"),
        (np.ones((2, 2), complex), 1, "real numbers"),
        (np.ones((2, 2), bool), 1, "real numbers"),
        (np.ones((0, 3)), 1, "at least one element"),
        (np.full((2, 2), np.nan), 1, "at least one element"),
        ([[0, np.inf]], 1, "finite"),
        ([[0, -np.inf]], 1, "finite"),
        ([0, np.nan], 1, "must not be nan on a line"),
        ([0.0, 1.0], 0, "spacing: must be positive"),
        ([0.0, 1.0], -2.0, "spacing: must be positive"),
        ([0.0, 1.0], np.nan, "spacing: must be positive"),
        ([0.0, 1.0], np.inf, "spacing: must be positive"),
        ([0.0, 1.0], None, "spacing: must be a positive number"),
    ],
)
def test_bad_indenters(heights, spacing, message):
    with pytest.raises(ValueError, match=message) as error:
        Indenter(heights, spacing)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"hurst": 1.1}, "hurst: must be from 0 to 1"),
        ({"hurst": np.nan}, "hurst: must be from 0 to 1"),
        ({"rms": 0}, "rms: must be positive"),
        ({"roll_off_wavelength": 0}, "roll_off_wavelength: must be positive"),
        ({"roll_off_wavelength": 0.01}, "roll_off_wavelength: must leave at least one wave"),
        ({"roll_off_level": -1}, "roll_off_level: must be a finite number >= 0"),
        ({"amplitudes": "gaussian"}, "amplitudes: must be 'random' or 'fixed'"),
        ({"seed": -1}, "seed: must be a whole number"),
        ({"seed": None}, "seed: must be a whole number"),
    ],
)
def test_bad_options(options, message):
    for generate in (self_affine_disc, self_affine_line):
        arguments = {"hurst": 0.5, "seed": 1} | options
        with pytest.raises(ValueError, match=message) as error:
            generate(arguments.pop("hurst"), 33, **arguments)
        assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"elements_across": 2}, "elements_across: must be a whole number of at least 3"),
        ({"elements_across": 9.0}, "elements_across: must be a whole number"),
        ({"period": 0.5}, "period: must be at least 1"),
        ({"diameter": -1.0}, "diameter: must be positive"),
        ({"rms_over": "line"}, "rms_over: must be 'disc' or 'square'"),
    ],
)
def test_bad_discs(options, message):
    with pytest.raises(ValueError, match=message):
        self_affine_disc(0.5, **{"elements_across": 9, "seed": 1} | options)


def test_bad_lines():
    for options, message in (
        ({"points": 1}, "points: must be a whole number of at least 2"),
        ({"length": 0}, "length: must be positive"),
        ({"dtype": np.float16}, "dtype: must be float32 or float64"),
        ({"rms": 1e36}, "rms: must be from 1.2e-35 to 3.4e.35 for float32, not 1e.36"),
        ({"rms": 1e-36}, "rms: must be from 1.2e-35 to 3.4e.35 for float32, not 1e-36"),
        ({"rms": 1e306, "dtype": float}, "rms: must be from 2.2e-305 to 1.8e.305 for float64, not 1e.306"),
    ):
        with pytest.raises(ValueError, match=message):
            self_affine_line(0.5, **{"points": 9, "seed": 1} | options)
