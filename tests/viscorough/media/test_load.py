"""Loads: a force or a depth over time, with further samples."""

import numpy as np
import pytest

from support.contract import refused
from viscorough import Load


def test_a_load_has_an_integral_and_further_samples():
    load = Load([0.0, 1.0, 1.0, 3.0], force=[0.0, 2.0, 1.0, 1.0])
    assert load.integral.tolist() == [0.0, 1.0, 1.0, 3.0]
    more, place = load.with_times([0.5, 1.0, 2.0])
    assert more.time.tolist() == [0.0, 0.5, 1.0, 1.0, 2.0, 3.0]
    assert more.values[place].tolist() == [1.0, 1.0, 1.0]
    depth = Load([0.0, 1.0], depth=[0.0, -1.0])
    assert (depth.by_depth, load.by_depth) == (True, False)


def test_times_equal_up_to_rounding_share_a_sample():
    load = Load([0.0, 0.3, 0.3, 1.0], depth=[0.0, 3.0, 1.0, 1.0])
    for time in (np.nextafter(0.3, 0), 0.3, np.nextafter(0.3, 1)):
        more, place = load.with_times([0.1, np.nextafter(0.1, 1), time, np.nextafter(1, 2)])
        assert more.time.tolist() == [0.0, 0.1, 0.3, 0.3, 1.0]
        assert place.tolist() == [1, 1, 3, 4]


@pytest.mark.parametrize("force", [[-1.0, 1.0], [np.inf, 1.0], [1.0]], ids=repr)
def test_a_force_that_pulls_or_is_not_finite_is_no_load(force):
    with refused("Load: force"):
        Load([0.0, 1.0], force=force)


def test_a_load_is_a_force_or_a_depth():
    for values in ({}, {"force": [1.0, 1.0], "depth": [1.0, 1.0]}):
        with refused("Load: one of force and depth is needed"):
            Load([0.0, 1.0], **values)
    with refused("Load: depth: sample 1 is nan; allowed: finite"):
        Load([0.0, 1.0], depth=[0.0, np.nan])
