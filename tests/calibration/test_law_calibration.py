"""Calibration of the penetration law on curves with given constants, and on small discs."""

import numpy as np
import pytest
from law_calibration import COLUMNS, FIT_LOW, X, calibrate, complete_curve, fit_constants, law_integrals

from support.sum_rules import audit
from viscorough.law.calibrated_law import CONSTANTS, interface_depth, interface_velocity
from viscorough.surfaces.self_affine import self_affine_disc

LAW, ACROSS = (0.8, 0.35, 4.0, 2.0, 80.0), 129


def discs(number, scatter=0.2, seed=1, constants=LAW):
    """Return g parts and integrals of discs whose g is the law times a random factor of mean 1."""
    factor = 1 + scatter * np.random.default_rng(seed).standard_normal((number, 1))
    law = interface_velocity(X, *constants, across=ACROSS), interface_depth(X, *constants, across=ACROSS)
    return factor[:, None] * np.array(law), factor * law_integrals(constants, ACROSS)


@pytest.mark.parametrize("constants", [LAW, (0.58, 0.17, 3.8, 0.76, 300.0), (0.88, 0.4, 6.2, 3.9, 37.0)])
def test_fit_returns_the_constants_of_the_curve(constants):
    g, integrals = interface_velocity(X, *constants, across=257), law_integrals(constants, 257)
    assert fit_constants(g, integrals, np.full(X.size, 0.01), 257) == pytest.approx(constants, rel=1e-3)


def test_both_integrals_are_imposed_on_any_curve():
    """Here g is 10 % higher at X = 0.1 than in any law with these integrals."""
    integrals = law_integrals(LAW, ACROSS)
    bent = interface_velocity(X, *LAW, across=ACROSS) * (1 + 0.1 * np.exp(-((np.log(X / 0.1) / 2) ** 2)))
    constants = fit_constants(bent, integrals, np.full(X.size, 0.01), ACROSS)
    np.testing.assert_allclose(law_integrals(constants, ACROSS), integrals, rtol=1e-6)
    assert constants != pytest.approx(LAW, rel=0.01)


def test_row_has_intervals_and_the_range_confirmed_by_other_discs():
    row = calibrate(discs(60), discs(60, seed=2), ACROSS, resamples=20, seed=1)
    assert {"hurst", "across", *row} == set(COLUMNS)
    for name in (*CONSTANTS, "mean_gap", "energy"):
        assert row[f"{name}_low"] < row[name] < row[f"{name}_high"], name
    # All discs differ by a factor that shows in their integrals. Adjusted by it, the other discs have the g of the law.
    assert row["deviation"] < 0.004 < 0.01 < row["unadjusted"]
    assert row["standard_error"] < 1e-3
    assert row["x_low"] == pytest.approx(FIT_LOW, rel=1e-2)
    assert row["x_high"] > LAW[2]
    assert 0 < row["geometric_velocity"] < 0.03


def test_law_does_not_hold_where_other_discs_differ():
    parts, integrals = discs(60)
    changed = parts * np.where((X < 0.01) | (X > 5), 1.1, 1.0)
    row = calibrate((parts, integrals), (changed, integrals), ACROSS, resamples=2, seed=1)
    assert 0.01 <= row["x_low"] < row["x_high"] <= 5.1


def test_curve_of_a_disc_has_its_integrals():
    (velocity, depth), (mean_gap, energy, median, *_, highest, _, _) = complete_curve(0.6, 33, 1)
    disc = self_affine_disc(0.6, 33, seed=1)
    height, diameter = np.nanstd(disc.heights), 33 * disc.spacing
    result = audit(disc)
    assert (mean_gap, energy) == pytest.approx(
        (result.rules.first.exact / height, result.rules.second.exact / (4 * height**2 * diameter))
    )
    assert (velocity[-1], depth[-1]) == (0, mean_gap)
    heights = disc.heights - np.nanmean(disc.heights)
    assert (median, highest) == pytest.approx((np.nanmedian(heights) / height, np.nanmax(heights) / height))
    inside = 4 * height * diameter * X < result.curve.force[-1]
    x = X[inside]
    wanted, stiffness = result.curve.at_force(4 * height * diameter * x)
    punch = result.complete.stiffness / (4 * diameter)
    np.testing.assert_allclose(depth[inside] + x / punch, wanted / height, rtol=1e-3)
    np.testing.assert_allclose(velocity[inside] + x / punch, 4 * diameter * x / stiffness, rtol=2e-2)
