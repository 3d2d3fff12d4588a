"""Claims on the MDR of lines, applied to tables with given values."""

import dataclasses

import numpy as np
import pytest

from support.study import HURST, evidence, mdr_tables
from viscorough_study.verdicts import lines


def verdicts(claim, **tables):
    """Return verdicts on the cases of a claim by tables of `mdr_tables`, or by the given tables."""
    good = evidence()
    made = dataclasses.replace(good, tables=good.tables | tables)
    return [case["verdict"] for case in getattr(lines, claim).judge(made, 0.1)]


@pytest.mark.parametrize(
    ("claim", "drift", "ratio"),
    [
        ("lambda_constant", 1.3, 1.0),
        ("exact_correspondence", 0.5, 1.0),
        ("line_area", 1.0, 100.0),
        ("line_gap", 1.0, 0.6),
    ],
)
def test_equal_quantities_hold_and_different_ones_do_not(claim, drift, ratio):
    assert verdicts(claim, **mdr_tables()) == ["holds"] * len(HURST)
    assert verdicts(claim, **mdr_tables(drift, ratio)) == ["not"] * len(HURST)


def test_intervals_across_the_tolerance_are_undecided():
    assert set(verdicts("lambda_constant", **mdr_tables(drift=1.1))) == {"undecided"}


def test_quantities_are_taken_inside_region_b():
    table = mdr_tables()["reduction"]
    outside = ~table["x"].between(*evidence().regions[0.6])
    assert outside.any()
    changed = table.assign(area_ratio=np.where(outside, 50.0, table["area_ratio"]))
    assert set(verdicts("line_area", reduction=changed)) == {"holds"}
    assert set(verdicts("line_area", reduction=table[table["x"] > 0.9])) == {"undecided"}
