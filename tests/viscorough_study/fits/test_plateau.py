"""The test for a power law, on power laws, bent curves and a control, with realistic scatter."""

import numpy as np
import pytest

from support.study import ensemble_of
from viscorough_study.fits.plateau import (
    COLUMNS,
    PlateauTest,
    half_spread,
    inner_slopes,
    longest_plateau,
    plateau,
    plateau_row,
    shares,
)

X = 10.0 ** np.linspace(-4, 1, 101)
HALF_WIDTH = 0.25 * np.log(10)
HOW = {"half_width": HALF_WIDTH, "tolerance": 0.05, "resamples": 100}


def scattered(mean, number, size, seed=0):
    """Return realizations around a mean, correlated along X over half a decade."""
    noise = np.random.default_rng(seed).standard_normal((number, X.size + 20))
    smooth = np.lib.stride_tricks.sliding_window_view(noise, 21, axis=1)[:, :, :10].sum(axis=2) / np.sqrt(10)
    return mean + size * smooth


def control(x):
    """Return a curve of slope 0.8 at both ends and 0.2 in between, which contains no power law."""
    return 0.8 * np.log(x) - 0.6 * 1.2 * np.arcsinh(np.log(x / 0.01) / 1.2)


def test_longest_plateau_is_the_longest_run_within_the_tolerance():
    slopes = np.array([[0.0, 0.2, 0.25, 0.3, 0.29, 0.4], [0.0, 0.2, 0.4, 0.6, 0.8, 1.0], [0.3] * 6])
    assert longest_plateau(slopes, 0.05000001).tolist() == [3, 0, 5]


def test_plateau_ends_at_a_kink():
    """The slope is 0.4 up to X = 0.1 and 1 above. The longer plateau ends where local slopes include the kink."""
    mean = np.where(X < 0.1, 0.4 * np.log(X / 0.1), np.log(X / 0.1))
    columns = plateau(np.log(X), scattered(mean, 30, 1e-4), random=np.random.default_rng(1), **HOW)
    assert 3.75 - 1.26 <= columns["decades"] <= 3.75 - 1.05
    assert columns["decades_low"] <= columns["decades"] <= columns["decades_high"]


@pytest.mark.parametrize("number", [0, 1, 5])
def test_curves_shorter_than_a_slope_have_no_inner_slope(number):
    inner, slopes = inner_slopes(np.log(X[:number]), np.log(X[None, :number]), HALF_WIDTH)
    assert (inner.shape, slopes.shape) == ((0,), (1, 0))


def test_power_laws_pass_and_other_curves_fail():
    random, residuals = np.random.default_rng(2), scattered(0.0, 200, 0.1)
    residuals = residuals - residuals.mean(axis=0)
    means = 0.3 * np.log(X), control(X), 0.05 * np.log(X) ** 2
    options = {"draws": 20, "decades_min": 2.0, "random": random} | HOW
    assert [shares(np.log(X), mean, residuals, **options) for mean in means] == [(1, 0), (0, 1), (0, 1)]
    passed, failed = shares(np.log(X), means[0], scattered(0.0, 8, 0.5), **options)
    assert (passed, failed > 0.05) == (0, True), "few realizations lose power laws"


OPTIONS = {"x_range": [1e-3, 1.0], "half_width": 0.25, "tolerance": 0.05, "decades_min": 2.0}


def row(mean):
    curve, none = (
        ensemble_of(X, X * np.exp(-scattered(curve, number, 0.1, seed)), elements=10**9).isel(rms_convention=0)
        for curve, number, seed in ((mean, 200, 0), (control(X), 20, 1))
    )
    return plateau_row(curve, none, PlateauTest(**OPTIONS, resamples=100, draws=10), np.random.default_rng(4))


def test_row_distinguishes_a_power_law_from_a_control():
    law, none = row(0.3 * np.log(X) - 3), row(control(X))
    region_columns = {"half_spread", "half_spread_low", "half_spread_high", "region_decades"}
    assert {"case_group", *law} == set(COLUMNS) - region_columns
    assert law["decades"] == pytest.approx(3)
    assert law["decades_low"] >= 2
    assert none["decades_high"] < 2
    for columns in (law, none):
        assert (columns["power_law_passes"], columns["control_passes"]) == (1, 0)
        assert columns["power_law_fails"] == 0


def test_curves_that_do_not_reach_all_abscissae_are_undecided():
    curves = np.exp(-scattered(0.3 * np.log(X) - 3, 20, 0.1)) * X
    curves[0, -40:] = np.nan
    short = ensemble_of(X, curves).isel(rms_convention=0)
    columns = plateau_row(short, None, PlateauTest(**OPTIONS, resamples=20, draws=2), np.random.default_rng(1))
    assert columns == {"hurst": 0.7, "realizations": 20}


def spread_of(mean, region, size=1e-6):
    curves = ensemble_of(X, X * np.exp(-scattered(mean, 100, size))).isel(rms_convention=0)
    return half_spread(curves, region, half_width=HALF_WIDTH, resamples=100, random=np.random.default_rng(1))


def test_spread_of_slopes_is_half_their_range_in_the_region():
    """The slope of the parabola 0.05 ln²X changes by 0.1 ln(X_high/X_low) over the region; a power law has none."""
    parabola = spread_of(0.05 * np.log(X) ** 2, (1e-3, 1e-2))
    assert parabola["half_spread"] == pytest.approx(0.05 * np.log(10), rel=1e-3)
    assert parabola["half_spread_low"] <= parabola["half_spread"] <= parabola["half_spread_high"]
    assert parabola["region_decades"] == pytest.approx(1)
    assert spread_of(0.3 * np.log(X), (1e-3, 1e-2))["half_spread"] < 1e-5
    assert spread_of(0.3 * np.log(X), (1e-3, 1e-2), 0.1)["half_spread_high"] > 1e-3
    assert spread_of(0.3 * np.log(X), None) == {"region_decades": 0.0}


def test_spread_leaves_out_curves_that_end_within_the_region():
    mean = 0.3 * np.log(X)
    curves = np.exp(-scattered(mean, 20, 1e-6)) * X
    whole = ensemble_of(X, curves[1:]).isel(rms_convention=0)
    curves[0] *= 1 + 0.5 * np.sin(np.log(X))
    curves[0, 40:] = np.nan  # from X = 0.01 on
    short = ensemble_of(X, curves).isel(rms_convention=0)
    found = [
        half_spread(part, (1e-3, 1e-1), half_width=HALF_WIDTH, resamples=10, random=np.random.default_rng(1))
        for part in (short, whole)
    ]
    assert found[0]["half_spread"] == pytest.approx(found[1]["half_spread"], rel=1e-9)
