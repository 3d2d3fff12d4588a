"""The recommended penetration law: its numbers and its range, and that they come from the table of fits."""

import numpy as np
import pandas as pd
import pytest

import viscorough
from support.study import ROOT, SHOWN, evidence
from viscorough.calibrated_law import COLUMNS, calibration
from viscorough_study.fit_table import calibrated


def test_numbers_are_the_calibrated_ones():
    table = calibration()
    assert set(table) == set(COLUMNS) - {"source"}
    assert table["hurst"].tolist() == [0.1, 0.4, 0.6, 0.9]
    assert np.all(table["beta_low"] < table["beta"])
    assert np.all(table["beta"] < table["beta_high"])
    for i, hurst in enumerate(table["hurst"]):
        law = viscorough.penetration_law(hurst)
        assert (law.beta, law.zeta) == (table["beta"][i], table["zeta"][i])
        assert (law.x_low, law.x_high) == pytest.approx((table["x_low"][i], table["x_high"][i]))
        middle = np.sqrt(law.x_low * law.x_high)
        assert law.velocity(middle) == pytest.approx(middle**law.beta / law.zeta)


def test_interpolation_between_calibrated_exponents():
    law, low, high = (viscorough.penetration_law(hurst) for hurst in (0.5, 0.4, 0.6))
    assert law.beta == pytest.approx((low.beta + high.beta) / 2)
    assert law.zeta == pytest.approx((low.zeta + high.zeta) / 2)
    assert law.x_low == pytest.approx(np.sqrt(low.x_low * high.x_low))


def test_values_outside_the_calibrated_range_are_refused():
    law = viscorough.penetration_law(0.6)
    for x in (0.9 * law.x_low, 1.1 * law.x_high, np.nan):
        with pytest.raises(ValueError, match=r"allowed: .* region .b."):
            law.velocity([np.sqrt(law.x_low * law.x_high), x])
    for hurst in (0.05, 0.95):
        with pytest.raises(ValueError, match=r"hurst of the penetration law: must be from 0.1 to 0.9"):
            viscorough.penetration_law(hurst)


def test_depth_at_the_centre_is_the_published_one():
    """data/depth_ratio.csv against docs/claims.csv, which `make publish` writes both."""
    claims = pd.read_csv(ROOT / "docs/claims.csv").query("claim == 'depth'")
    for row in claims.itertuples():
        law = viscorough.penetration_law(float(row.case.removeprefix("H = ")))
        assert (law.depth_ratio, *law.depth_ratio_interval) == (row.value, row.low, row.high)
        centre = np.sqrt(law.x_low * law.x_high)
        assert law.depth(centre) == pytest.approx(law.depth_ratio * centre**law.beta / (law.zeta * law.beta))
    assert len(claims) == 4


def test_depth_is_the_integral_of_the_velocity():
    law = viscorough.penetration_law(0.7)
    x = np.geomspace(law.x_low, law.x_high, 2000)
    gained = np.trapezoid(law.velocity(x), np.log(x))  # v dt = (vt) d ln t
    assert law.depth(x[-1]) - law.depth(x[0]) == pytest.approx(gained, rel=1e-5)


def test_intervals_contain_the_law_and_follow_from_their_ends():
    law = viscorough.penetration_law(0.4)
    x = np.geomspace(law.x_low, law.x_high, 7)
    for function, interval in ((law.velocity, law.velocity_interval), (law.depth, law.depth_interval)):
        low, high = interval(x)
        assert (low < function(x)).all()
        assert (function(x) < high).all()
        with pytest.raises(ValueError, match="allowed"):
            interval(2 * law.x_high)
    assert law.velocity_interval(x)[1] == pytest.approx(x ** law.beta_interval[0] / law.zeta_interval[0])


def test_calibration_takes_rows_in_the_conventions_shown():
    table = calibrated(evidence().tables["scaling"], SHOWN)
    assert list(table) == list(COLUMNS)
    assert table["source"].tolist() == ["discs"] * 3 + ["lines"] * 3
    np.testing.assert_allclose(table.loc[table["hurst"] == 0.6, "beta"], 0.375, atol=1e-6)
