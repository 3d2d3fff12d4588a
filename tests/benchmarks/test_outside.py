"""Comparison with published numbers of others: the compared quantities and the published table."""

import numpy as np
import outside
import pandas as pd
import pytest

from support.documentation import ROOT


def test_contact_fraction_of_a_free_square_changes_with_the_grid_as_published():
    """Fewer elements touch on finer grids, and the correction removes most of this change."""
    rows = {row[1]: row for row in outside.free_squares(2)}
    _, _, theirs, ours, tolerance, *_ = rows["change of A/A₀ from 128² to 512²"]
    assert theirs == pytest.approx(-0.0148)
    assert ours < 0 < tolerance
    assert abs(rows["change of A*/A₀ from 128² to 512²"][3]) < 0.3 * abs(ours)


def test_slope_is_the_rms_slope_of_the_interpolated_heights():
    heights, slope = outside.surface(512, 32, 1, 0.8)
    differences = [(np.roll(heights, -1, axis) - heights) * 512 for axis in (0, 1)]
    assert np.sqrt(np.mean(np.square(differences).sum(axis=0))) == pytest.approx(slope, rel=0.01)
    assert heights.std() == pytest.approx(1, rel=1e-3)


def test_all_sources_but_one_are_met():
    """docs/published.md names the source."""
    published = pd.read_csv(ROOT / "docs/results/outside.csv")
    assert published[published["met"] == 0]["source"].unique().tolist() == [outside.SEPARATION_SOURCE]
