"""Numbers of others: what is compared, and what is published of it."""

import numpy as np
import outside
import pandas as pd
import pytest

from support.documentation import ROOT


def test_a_free_square_has_the_pressure_of_the_study():
    """Elements touch less on finer grids, and the correction takes away most of that."""
    rows = {row[1]: row for row in outside.free_squares(2)}
    _, _, theirs, ours, tolerance, *_ = rows["change of A/A₀ from 128² to 512²"]
    assert theirs == pytest.approx(-0.0148)
    assert ours < 0 < tolerance
    assert abs(rows["change of A*/A₀ from 128² to 512²"][3]) < 0.3 * abs(ours)


def test_the_slope_is_that_of_the_interpolated_heights():
    heights, slope = outside.surface(512, 32, 1, 0.8)
    differences = [(np.roll(heights, -1, axis) - heights) * 512 for axis in (0, 1)]
    assert np.sqrt(np.mean(np.square(differences).sum(axis=0))) == pytest.approx(slope, rel=0.01)
    assert heights.std() == pytest.approx(1, rel=1e-3)


def test_one_source_alone_is_not_met():
    """docs/outside.md says which."""
    published = pd.read_csv(ROOT / "docs/results/outside.csv")
    assert published[published["met"] == 0]["source"].unique().tolist() == [outside.SEPARATION_SOURCE]
