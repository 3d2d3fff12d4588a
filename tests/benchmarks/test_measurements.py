"""The measurements of `make bench`, on small problems."""

from functools import partial

import curves
import pytest

from viscorough import self_affine_disc


def test_every_part_takes_time():
    """The disc has enough elements for both the dense solver and the grid."""
    shares = curves.shares(partial(curves.indent, self_affine_disc(0.6, 65, seed=1)))
    assert all(share > 0 for share in shares.values())
    assert sum(share for part, share in shares.items() if part != "processor_s") == pytest.approx(1)


def test_a_curve_takes_longer_than_its_operator():
    (steps,) = curves.over_operator([0.6], 2, elements=65).values()
    assert steps.pop("whole") > 1
    assert steps["operator"] == {"calls": steps["operator"]["calls"], "cost": 1.0}
    assert all(step["calls"] > 0 and step["cost"] > 0 for step in steps.values())


def test_costs_are_compared_on_the_same_problem():
    (line,) = curves.lines([0.6], 1, points=2000)
    assert line["over_transform"] > 0
    assert [row["precision"] for row in curves.columns([9], 1)] == ["single", "double"]
    assert curves.rectangles([1.0, 5.0], 1, elements=17)[1.0] == 1
    assert set(curves.large_map(33)) == {"curve", "contact"}
