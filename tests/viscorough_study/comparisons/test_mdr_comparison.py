"""Lines with the spectrum of a surface, compared with the surface."""

import numpy as np
import pytest
from scipy import stats

from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces.indenter import Indenter
from viscorough_study.comparisons.mdr_comparison import COLUMNS, compare_reduction, is_power_of_ten, mean_gaps


def test_comparison_has_ratios_of_stiffness_area_and_gap():
    x = {"x_low": 1e-3, "x_high": 3.0, "per_decade": 5}
    table = compare_reduction(hursts=[0.8], elements=33, realizations=6, tolerance=1e-3, seed=1, **x)
    assert list(table) == list(COLUMNS)
    assert table["stiffness_ratio"].between(0.3, 3).all()
    half_width = stats.t.ppf(0.975, 5) * table["stiffness_scatter"] / np.sqrt(6)
    for end, side in (("low", -1), ("high", 1)):
        distance = np.log(table[f"stiffness_ratio_{end}"] / table["stiffness_ratio"])
        np.testing.assert_allclose(distance, side * half_width)
    np.testing.assert_allclose(stats.norm.cdf(np.arctanh(table["chance"]) * np.sqrt(6 - 3)), 0.975, atol=1e-4)
    assert table["gap_ratio"].notna().equals(is_power_of_ten(table["x"]))
    assert table["gap_ratio"].dropna().between(0.05, 1.5).all()


def test_mean_gap_of_a_line_is_the_mean_over_its_points():
    line = Indenter(np.random.default_rng(1).normal(size=500), 0.01)
    curve = reduce(line)
    force = curve.force[[3, 40, -1]]
    initial = line.heights.max() - line.heights
    gaps = [np.maximum(initial - depth, 0).mean() for depth in curve.depth[[3, 40, -1]]]
    np.testing.assert_allclose(mean_gaps(line, curve, force, 1e-3), gaps, rtol=1e-12, atol=1e-15)


def test_mean_gap_of_flat_and_raised_discs_is_exact():
    """A flat punch has no gap. A raised element of height 1 holds the other elements apart by about its height."""
    flat = np.where(np.hypot(*np.mgrid[-8:9, -8:9]) <= 8.5, 0.0, np.nan)
    raised = flat.copy()
    raised[8, 8] = 1.0
    for heights, expected in ((flat, 0.0), (raised, 1.0)):
        disc = Indenter(heights, 1 / 17)
        (gap,) = mean_gaps(disc, indent(disc, until_force=1.0), np.array([1e-4]), 1e-3)
        assert gap == pytest.approx(expected, abs=5e-3)
