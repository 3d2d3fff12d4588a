"""The straightness of curves in region (b), on power laws, bent curves, and curves that bend outside of it."""

import numpy as np
import pytest

from support.study import LIMITS, ensemble_of, evidence
from viscorough_study.fits.local_slope import COLUMNS, local_slope_table, straightness

X = 10.0 ** np.linspace(-4, 1, 101)
HALF_WIDTH = 0.25 * np.log(10)
REGION = (1e-3, 1e-1)


def scattered(mean, number, size, seed=0):
    """Return realizations around a mean, correlated along X over half a decade."""
    noise = np.random.default_rng(seed).standard_normal((number, X.size + 20))
    smooth = np.lib.stride_tricks.sliding_window_view(noise, 21, axis=1)[:, :, :10].sum(axis=2) / np.sqrt(10)
    return mean + size * smooth


def measured(log_y, region=REGION):
    curves = ensemble_of(X, X * np.exp(-log_y)).isel(rms_convention=0)
    return straightness(curves, region, half_width=HALF_WIDTH, resamples=100, random=np.random.default_rng(1))


def test_spread_of_slopes_is_half_their_range_over_windows_inside_the_region():
    """The slope of 0.05 ln²X changes by 0.1 ln(X) over the middles of the windows, 1.5 decades."""
    parabola = measured(scattered(0.05 * np.log(X) ** 2, 100, 1e-6))
    assert parabola["half_spread"] == pytest.approx(0.05 * 1.5 * np.log(10), rel=1e-3)
    assert parabola["half_spread_low"] <= parabola["half_spread"] <= parabola["half_spread_high"]
    assert parabola["line_residual"] > 0.05
    straight = measured(scattered(0.3 * np.log(X), 100, 1e-6))
    assert max(straight["half_spread"], straight["line_residual"]) < 1e-5
    assert measured(scattered(0.3 * np.log(X), 100, 0.1))["half_spread_high"] > 1e-3


def test_data_outside_the_region_have_no_effect():
    """A kink a twentieth of a decade beyond each end of the region is within the reach of a window at the end."""
    inside = 0.3 * np.log(np.clip(X, REGION[0] / 1.1, REGION[1] * 1.1))
    outside = np.log(X / np.clip(X, REGION[0] / 1.1, REGION[1] * 1.1))
    assert measured(np.tile(inside + outside, (20, 1)))["half_spread"] < 1e-9


def test_short_regions_decide_nothing():
    """In a region of less than two windows, nearly all slopes are fitted to the same data."""
    bent = scattered(0.05 * np.log(X) ** 2, 20, 1e-6)
    assert np.isnan(measured(bent, (1e-2, 8e-2))["half_spread"])
    assert np.isfinite(measured(bent, (1e-2, 1e-1))["half_spread"])
    assert "x_low" not in measured(bent, None)


def test_curves_that_end_within_the_region_are_left_out():
    curves = scattered(0.3 * np.log(X), 20, 1e-6)
    short = np.vstack([curves, np.where(X < 1e-2, 9 * np.log(X), np.nan)])
    assert measured(short)["half_spread"] == pytest.approx(measured(curves)["half_spread"], abs=1e-6)


def test_table_has_a_row_for_each_group_of_the_pool():
    table = local_slope_table(
        evidence().discs,
        groups={"base": "disc", "longer_period": "square", "roll_off": "disc"},
        region=LIMITS,
        resamples=20,
        seed=1,
    )
    assert list(table) == list(COLUMNS)
    rows = list(table[["group", "hurst"]].itertuples(index=False, name=None))
    assert rows == [(group, hurst) for group in ("base", "longer_period") for hurst in (0.4, 0.6, 0.9)]
    assert table["half_spread"].max() < 0.02
