"""One law fitted to all grids: given exponents, corrections and ranges."""

import numpy as np
import pytest

from viscorough_study.fits.infinite_grid import COLUMNS, limit_table, points
from viscorough_study.fits.power_law import log_means
from viscorough_study.fits.scaling_collapse import Grid

HURST, BETA, A, B, OMEGA = 0.6, 0.4, 1.3, -0.9, 0.5
RANGES = {"elements_min": [10, 20], "x_high": {"power": [0.03], "corrected": [0.3, 0.1]}}


def ensembles(*, scatter=0.1, punch=0.0, factor=np.exp, omega=OMEGA, seed=1):
    """Make ensembles of vt/h = A X^β exp(B X^ω) (or another factor) + punch X on four grids, with scatter."""
    generator, grids = np.random.default_rng(seed), []
    for number, realizations in ((65, 60), (257, 40), (1025, 30), (4097, 20)):
        x = 10 ** np.arange(np.ceil(20 * np.log10(2 * number ** -(1 + HURST))) / 20, 0, 0.05)
        law = A * x**BETA * factor(B * x**omega)
        tilt = generator.standard_normal((realizations, 2)) @ np.array([np.ones(x.size), 0.2 * np.log(x)])
        velocity = law * np.exp(scatter * tilt) + punch * x
        means = log_means(velocity, "geometric", 200, generator)
        count = 10 * (x / x[0]) ** 0.9
        grids.append(Grid(number, realizations, np.log(x), means, count, 1 / punch if punch else np.inf, 1.0))
    return {HURST: grids}


def limits_of(tolerance=0.05, **options):
    return limit_table({"discs": ensembles(**options)}, tolerance=tolerance, **RANGES)


def row(limits, quantity="whole", law="corrected"):
    (row,) = limits[(limits[["quantity", "law"]] == [quantity, law]).all(axis=1)].itertuples()
    return row


@pytest.mark.parametrize("factor", [np.exp, lambda z: 1 + 0.3 * z], ids=["exponential", "first order"])
def test_joint_fit_returns_the_law_within_its_intervals(factor):
    fits = [row(limits_of(seed=seed, factor=factor)) for seed in range(6)]
    assert sum(fitted.beta_low <= BETA <= fitted.beta_high for fitted in fits) >= 5
    assert all(fitted.ranges_low <= BETA <= fitted.ranges_high for fitted in fits)
    if factor is np.exp:
        assert sum(fitted.omega_low <= OMEGA <= fitted.omega_high for fitted in fits) >= 5
        assert np.median([fitted.correction for fitted in fits]) == pytest.approx(B, rel=0.2)
        assert np.median([fitted.amplitude for fitted in fits]) == pytest.approx(A, rel=0.1)


def test_resamples_scatter_as_means_of_independent_realizations():
    """A mean scatters by the standard deviation over √n; resamples of n curves, here 3, by √(2/3) of it."""
    generator, x = np.random.default_rng(1), np.geomspace(1e-3, 0.1, 9)
    logarithms = generator.standard_normal((3, 1))
    means = log_means(np.exp(logarithms) * x**BETA, "geometric", 4000, generator)
    grids = [Grid(number, 3, np.log(x), means, np.full(x.size, 10), 1.0, 1.0) for number in (65, 257)]
    _, log_y, _ = points(grids, "whole", elements_min=10, x_high=1.0)
    assert log_y[1:, 0].std() == pytest.approx(logarithms.std(ddof=1) / np.sqrt(3), rel=0.05)


def test_interface_is_fitted_without_the_punch():
    limits = limits_of(punch=1.0, scatter=0.02)
    interface = row(limits, "interface", "corrected")
    assert interface.beta_low - 1e-3 <= BETA <= interface.beta_high + 1e-3
    assert row(limits, "whole", "power").beta > row(limits, "interface", "power").beta


def test_fit_has_columns_ranges_and_findings():
    exact = row(limits_of(scatter=1e-9))
    assert (exact.amplitude, exact.beta, exact.correction, exact.omega) == pytest.approx((A, BETA, B, OMEGA), rel=1e-6)
    limits = limits_of(scatter=0.02)
    assert limits["omega"].isna().tolist() == limits["correction"].isna().tolist() == [*(limits["law"] == "power")]
    assert list(limits) == list(COLUMNS)
    assert (limits["ranges_low"] <= limits["beta_low"]).all()
    assert (limits["ranges_high"] >= limits["beta_high"]).all()
    assert row(limits).finding == "agrees"  # 0.4 and 0.375 agree
    for scatter, finding in ((0.002, "departs"), (0.5, "undecided")):
        assert row(limits_of(0.01, scatter=scatter)).finding == finding


@pytest.mark.parametrize(("omega", "fitted_omega"), [(OMEGA, OMEGA), (0.05, 0.2), (2.5, 1.5)])
def test_findings_are_undecided_if_the_correction_is_at_a_limit(omega, fitted_omega):
    """If the fitted exponent of the correction lies outside the allowed range, it ends at an end of this range."""
    fitted = row(limits_of(scatter=1e-4, omega=omega))
    assert fitted.omega == pytest.approx(fitted_omega)
    assert (fitted.finding == "undecided") == (fitted_omega != OMEGA)
