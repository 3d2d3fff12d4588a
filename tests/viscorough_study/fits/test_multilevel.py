"""Check the estimate from surfaces on several grids: sums, intervals, remainders and the allocation of surfaces."""

import numpy as np
import pytest
from scipy.special import zeta

from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.multilevel import Level, estimates, mean_error, optimal_surfaces, slopes_of, starting_grid


def waves_of_line(hurst, points, seed):
    """Draw the amplitudes of the waves of a line, k = 1 ... (n − 1)/2, with mean squares k^(−1−2H)."""
    half = points // 2
    random = np.random.default_rng(seed).standard_normal(2 * half).view(complex) * np.sqrt(0.5)
    return random * np.arange(1, half + 1) ** (-(1 + 2 * hurst) / 2)


def curve_of_line(waves, hurst, points, x):
    """Return ln(vt/h) of a line by the MDR (F = 4G Δx Σ(u − g)₊) with the waves that the grid contains.

    As for discs, h² is the mean square of the heights plus the expected mean square of the waves that are missing.
    """
    kept = np.append(0, waves[: points // 2])
    heights = np.fft.irfft(kept, points) * points
    gaps = np.sort(heights.max() - heights)
    rms = np.sqrt(np.mean(heights**2) + 2 * zeta(1 + 2 * hurst, points // 2 + 1))
    forces = (np.arange(points) * gaps - np.append(0, np.cumsum(gaps)[:-1])) / (points * rms)  # X where each touches
    return np.log(x / (np.searchsorted(forces, x, side="left") / points))


def synthetic_levels(means, sizes, *, scatter=1.0, scatter_of_pairs=0.1, seed=0):
    """Return levels with one statistic: its mean on each grid, and its scatter between surfaces and between grids."""
    random = np.random.default_rng(seed)
    levels = []
    for i, (mean, size) in enumerate(zip(means, sizes, strict=True)):
        fine = mean + scatter * random.standard_normal((size, 1))
        step = mean - means[i - 1]
        coarse = fine - step - scatter_of_pairs * random.standard_normal((size, 1)) if i else None
        levels.append(Level(2 ** (i + 5) + 1, fine, coarse, (4.0**i, 4.0 ** (i - 1))))
    return levels


def test_sum_over_pairs_of_the_same_surfaces_is_the_plain_mean_on_the_finest_grid():
    values = np.random.default_rng(1).normal(size=(4, 30, 1))  # four grids, the same 30 surfaces on each
    levels = [Level(i, values[i], values[i - 1] if i else None) for i in range(4)]
    samples = [level.one(0) for level in levels]
    for base in range(4):
        assert abs(mean_error(samples, base)[0] - values[3].mean()) < 1e-14


def test_sum_starts_on_the_finest_grid_if_pairs_scatter_as_much_as_surfaces():
    sizes = [1000, 100, 100]
    close = synthetic_levels([0.5, 0.4, 0.35], sizes, scatter_of_pairs=0.1)
    apart = synthetic_levels([0.5, 0.4, 0.35], sizes, scatter_of_pairs=3.0)
    assert starting_grid([level.one(0) for level in close]) == 0
    assert starting_grid([level.one(0) for level in apart]) == 2


def test_remainder_is_the_sum_of_a_geometric_sequence():
    steps = 0.1 * 0.5 ** np.arange(4)
    means = 1 - np.append(0, np.cumsum(steps))
    levels = synthetic_levels(means, [4000] * 5, scatter=0.02, scatter_of_pairs=0.01)
    (estimate,) = estimates(levels, 0)
    assert estimate.ratio[1] <= 0.5 <= estimate.ratio[2] < 0.6
    assert abs(estimate.limit[0] - (means[-1] - steps[-1])) < 0.003
    assert estimate.limit[1] < means[-1] - steps[-1] < estimate.limit[2]
    assert estimate.remainder[0] == pytest.approx(estimate.limit[0] - estimate.value)


@pytest.mark.parametrize("means", [[1.0, 1.0, 1.0, 1.0], [1.0, 0.9, 0.8, 0.7]], ids=["no trend", "steady trend"])
def test_limit_is_undecided_if_differences_need_not_decrease(means):
    (estimate,) = estimates(synthetic_levels(means, [200] * 4), 0)
    assert estimate.ratio[2] >= 1
    assert np.isnan(estimate.limit).all()
    assert np.isfinite([estimate.value, estimate.low, estimate.high]).all()


def test_two_differences_determine_no_limit():
    (estimate,) = estimates(synthetic_levels([1.0, 0.9, 0.85], [200] * 3), 0)
    assert np.isnan(estimate.limit).all()


def test_allocated_surfaces_reach_the_half_width_at_the_least_cost():
    variances, seconds, half_width = np.array([0.03, 2e-3, 3e-4]), np.array([0.2, 0.9, 3.0]), 0.02
    numbers = optimal_surfaces(variances, seconds, half_width)
    assert 1.96 * np.sqrt(np.sum(variances / numbers)) == pytest.approx(half_width, rel=0.02)
    random = np.random.default_rng(0)
    for _ in range(100):  # any other numbers with the same variance cost more
        other = numbers * random.uniform(0.5, 2, size=3)
        other *= np.sum(variances / other) / np.sum(variances / numbers)
        assert other @ seconds > 0.999 * numbers @ seconds


def test_interval_of_lines_contains_the_exponent_of_their_finest_grid():
    grids, sizes, repetitions, hurst = (33, 65, 129), (16, 12, 8), 400, 0.4
    x = abscissa(0.01, 0.1, 10)
    matrix = slopes_of(np.log(x), [(0, len(x) - 1)])
    bank = []
    for position, (points, size) in enumerate(zip(grids, sizes, strict=True)):
        curves = np.empty((size * repetitions, min(position + 1, 2), len(x)))
        for surface in range(len(curves)):
            waves = waves_of_line(hurst, points, np.random.SeedSequence(3, spawn_key=(position, surface)))
            for grid in range(curves.shape[1]):
                curves[surface, grid] = curve_of_line(waves, hurst, grids[position - grid], x)
        bank.append((curves @ matrix).reshape(repetitions, size, -1))
    # The exponent is known from all repetitions together, with a tenth of the error of a single one.
    truth = bank[0].mean() + sum((pairs[..., 0] - pairs[..., 1]).mean() for pairs in bank[1:])
    contained = []
    for repetition in range(repetitions):
        drawn = [pairs[repetition] for pairs in bank]
        levels = [Level(n, d[:, :1], d[:, 1:] if d.shape[1] > 1 else None) for n, d in zip(grids, drawn, strict=True)]
        (estimate,) = estimates(levels, repetition)
        contained.append(estimate.low <= truth <= estimate.high)
    assert 0.9 <= np.mean(contained) <= 0.98
