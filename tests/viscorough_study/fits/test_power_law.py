"""Fits of power laws and regions, on ensembles with given power laws, made without the module."""

import numpy as np
import pytest
from scipy.stats import binom

from support.study import LIMITS, ensemble_of, three_regions
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.intervals import with_interval
from viscorough_study.fits.power_law import find_region, fit_power_law, named_windows

x = abscissa(1e-7, 10, 20)
BOOTSTRAP = {"resamples": 400, "seed": 1}


def curves(stiffness, **coords):
    return ensemble_of(x, stiffness, **coords).isel(rms_convention=0)


def scattered(beta, prefactor, realizations, seed):
    """Return vt/h of power laws with different slopes and prefactors; their geometric mean is the law."""
    rng = np.random.default_rng(seed)
    log_x = np.log(x)
    slopes = beta + 0.03 * rng.normal(size=(realizations, 1))
    logs = np.log(prefactor) + slopes * log_x + 0.3 * rng.normal(size=(realizations, 1))
    return np.exp(logs + 0.05 * rng.normal(size=logs.shape))


def test_region_is_found_on_a_three_region_curve():
    """The ends of the region are the outermost abscissae with 10 elements in contact and κ = 0.2."""
    low, high = find_region(curves(three_regions(x), elements=10**3), **LIMITS)
    assert low == x[x >= (10 / 10**3 / 1.2) ** (1 / 0.6)][0]
    assert high == x[x <= (0.2 / 1.2) ** (1 / 0.6)][-1]


def test_region_ends_before_a_contact_that_no_longer_grows():
    """A plateau of κ below stiffness_max, for example of a flat-topped asperity, does not belong to region (b)."""
    _, high = find_region(curves(np.minimum(1.2 * x**0.6, 0.05)), **LIMITS)
    corner = (0.05 / 1.2) ** (1 / 0.6)
    assert corner / 10**0.25 < high < corner * 10**0.25


def test_region_needs_nearly_all_realizations():
    stiffness = np.tile(three_regions(x), (20, 1))
    stiffness[:2, x > 1e-3] = np.nan  # 90 % are left
    _, high = find_region(curves(stiffness), **LIMITS)
    assert high == x[x <= 1e-3][-1]


@pytest.mark.parametrize("stiffness", [np.ones(x.size), np.full(x.size, np.nan)])
def test_curve_without_a_region_has_no_windows(stiffness):
    mean = curves(three_regions(x))
    mean["stiffness_geometric"] = "abscissa", stiffness
    mean["velocity_geometric"] = "abscissa", x / stiffness
    assert find_region(mean, **LIMITS) is None
    windows = named_windows(mean, stiffness_range=(0.5, 0.6), **LIMITS)
    assert windows == dict.fromkeys(("default", "lower_half", "upper_half", "kappa"))


def test_named_windows_follow_from_the_region():
    windows = named_windows(curves(three_regions(x)), stiffness_range=(0.03, 0.3), **LIMITS)
    low, high = windows["default"]
    middle = pytest.approx(np.sqrt(low * high))
    assert (windows["lower_half"], windows["upper_half"]) == ((low, middle), (middle, high))
    inside = x[(three_regions(x) >= 0.03) & (three_regions(x) <= 0.3)]
    assert windows["kappa"] == (inside[0], inside[-1])


def test_windows_with_two_abscissae_are_not_fitted():
    """With two abscissae per decade, two have a stiffness in the first range, and three in the second."""
    coarse = curves(three_regions(x), elements=10**7).isel(abscissa=slice(None, None, 10))
    assert named_windows(coarse, stiffness_range=(0.03, 0.1), **LIMITS)["kappa"] is None
    assert named_windows(coarse, stiffness_range=(0.03, 0.3), **LIMITS)["kappa"] is not None


def test_fit_is_least_squares_in_logarithms():
    """The reference is numpy's polynomial fit of numpy's averages. The ends of the window belong to it."""
    velocity = scattered(0.4, 0.7, 9, seed=2)
    inside = slice(60, 101)
    averages = {"arithmetic": np.log(velocity.mean(axis=0)), "geometric": np.log(velocity).mean(axis=0)}
    for average, mean in averages.items():
        betas, zetas = fit_power_law(x, velocity, (x[60], x[100]), average=average, resamples=20, seed=1)
        slope, height = np.polyfit(np.log(x[inside]), mean[inside], 1)
        assert (betas[0], zetas[0]) == pytest.approx((slope, np.exp(-height)), rel=1e-10)


@pytest.mark.parametrize("realizations", [8, 24])
def test_intervals_cover_the_truth_95_times_in_100(realizations):
    """Of 200 ensembles, the number of hits is in the 99.9 % range of the binomial distribution."""
    hits = np.zeros(2)
    for seed in range(200):
        velocity = scattered(0.4, 0.7, realizations, seed=(realizations, seed))
        samples = fit_power_law(x, velocity, (1e-5, 1e-1), average="geometric", resamples=200, seed=seed)
        intervals = [with_interval(values, realizations) for values in samples]
        hits += [low <= truth <= high for truth, (_, low, high) in zip((0.4, 1 / 0.7), intervals, strict=True)]
    fewest, most = binom.interval(0.999, 200, 0.95)
    assert fewest <= hits.min() <= hits.max() <= most


def test_partly_defined_realizations_count_at_their_abscissae():
    velocity = np.vstack([x**0.4, 3 * x**0.4])
    velocity[1, x > 1e-3] = np.nan
    betas, zetas = fit_power_law(x, velocity, (2e-3, 1e-1), average="arithmetic", **BOOTSTRAP)
    assert with_interval(betas, 2) == pytest.approx((0.4, 0.4, 0.4), abs=1e-12)
    assert zetas[0] == pytest.approx(1, rel=1e-12)
    assert np.isnan(betas).any()  # some resamples contain only the second curve
    velocity[0, x > 1e-2] = np.nan
    with pytest.raises(ValueError, match="no realization"):
        fit_power_law(x, velocity, (2e-3, 1e-1), average="arithmetic", **BOOTSTRAP)


def test_fit_of_one_realization_has_no_interval():
    velocity = np.tile(x**0.4, (3, 1))
    betas, _ = fit_power_law(x, velocity[:1], (1e-4, 1e-2), average="geometric", **BOOTSTRAP)
    assert np.isnan(with_interval(betas, 1)[1:]).all()
    with pytest.raises(ValueError, match="at least 3"):
        fit_power_law(x, velocity, (1.0e-4, 1.1e-4), average="geometric", **BOOTSTRAP)
