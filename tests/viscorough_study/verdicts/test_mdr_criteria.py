"""Criteria for claims on the MDR of lines, applied to tables with given values."""

import dataclasses

import numpy as np
import pytest

from support.study import HURST, evidence, mdr_tables
from viscorough_study.verdicts import mdr_criteria


def verdicts(claim, tolerance, **tables):
    """Return verdicts on the cases of a claim by tables of `mdr_tables`, or by the given tables."""
    good = evidence()
    made = dataclasses.replace(good, tables=good.tables | tables)
    return [case["verdict"] for case in getattr(mdr_criteria, claim)(made, tolerance)]


@pytest.mark.parametrize(
    ("claim", "windows", "drift", "ratio"),
    [
        ("lambda_constant", 1, 1.3, 1.0),
        ("exact_correspondence", 1, 0.5, 1.0),
        ("whole_curve", 1, 0.5, 1.0),
        ("coincide_equal_windows", 2, 5.0, 1.0),
        ("line_area", 1, 1.0, 100.0),
        ("line_gap", 1, 1.0, 0.6),
        ("single_surface", 1, 1.0, 1.5),
    ],
)
def test_equal_quantities_are_reproduced_and_different_ones_are_not(claim, windows, drift, ratio):
    single = {"ratio": 1.02} if claim == "single_surface" else {}
    assert verdicts(claim, 0.1, **mdr_tables(**single)) == ["reproduced"] * windows * len(HURST)
    assert verdicts(claim, 0.1, **mdr_tables(drift, ratio)) == ["not reproduced"] * windows * len(HURST)


@pytest.mark.parametrize(
    ("deviation", "coarse", "verdict"),
    [(2e-5, 8e-5, "reproduced"), (2e-5, 3e-5, "not reproduced"), (2e-3, 8e-3, "not reproduced")],
)
def test_own_line_is_exact_if_its_deviation_is_small_and_falls_with_the_steps(deviation, coarse, verdict):
    every = mdr_tables()["histories"]
    first = every["hurst"] == HURST[0]
    changed = {"deviation": every["deviation"].mask(first, -deviation)}
    changed["deviation_coarse"] = every["deviation_coarse"].mask(first, coarse)
    assert verdicts("own_line", 1e-3, histories=every.assign(**changed)) == [verdict, "reproduced", "reproduced"]


def test_intervals_across_the_tolerance_are_undecided():
    assert set(verdicts("lambda_constant", 0.1, **mdr_tables(drift=1.1))) == {"undecided"}
    few = mdr_tables(ratio=1.2)["reduction"].assign(realizations=3)
    assert set(verdicts("single_surface", 0.1, reduction=few)) == {"undecided"}


def test_quantities_are_taken_inside_region_b():
    table = mdr_tables()["reduction"]
    outside = ~table["x"].between(*evidence().regions[0.6])
    assert outside.any()
    changed = table.assign(area_ratio=np.where(outside, 50.0, table["area_ratio"]))
    assert set(verdicts("line_area", 0.1, reduction=changed)) == {"reproduced"}
    assert set(verdicts("line_area", 0.1, reduction=table[table["x"] > 0.9])) == {"undecided"}
