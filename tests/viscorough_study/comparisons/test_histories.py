"""Motions of the row of springs agree with direct integration, whether the contact grows or recedes."""

import numpy as np
import pytest

from viscorough_study.comparisons.histories import COLUMNS, DURATIONS, FORCE_CURVE, RECOVERY, compare_histories

DISC = {"hursts": [0.7], "elements": 33, "seed": 1}


@pytest.fixture(scope="module")
def table():
    return compare_histories(**DISC)


def test_deviation_of_direct_integration_falls_as_the_square_of_the_step(table):
    assert list(table) == list(COLUMNS)
    fine, coarse = (table[name].abs().max() for name in ("deviation", "deviation_coarse"))
    assert fine < 2e-4
    assert 3 < coarse / fine < 5


def test_contact_opens_in_unloading_and_closes_in_reloading(table):
    for duration in DURATIONS:
        rows = table[(table["motion"] == FORCE_CURVE) & (table["duration"] == duration)]
        unloading = rows[rows["time"].between(duration, 2 * duration)]
        assert unloading.query("depth > 0 and direct == 0")["force"].tolist()[-1:] == [0.0]
        assert rows["force"].iloc[-1] > 0


def test_recoveries_start_at_one_depth(table):
    """The force of each duration is chosen so; otherwise their motions could not be compared."""
    recoveries = table[table["motion"] == RECOVERY]
    before = recoveries[recoveries["time"] == 0].groupby("duration")["depth"].max()
    assert len(before) == len(DURATIONS)
    np.testing.assert_allclose(before, before.iloc[0], rtol=1e-6)
