"""The measurements of `make bench`, on small problems."""

import curves

from viscorough import self_affine_disc


def test_steps_of_a_curve_are_counted():
    """The curve itself counts the applications of its operator, too."""
    (steps,) = curves.over_operator([0.6], 1, elements=65).values()
    assert steps.pop("whole") > 1
    applications = curves.whole_curve(self_affine_disc(0.6, 65, seed=1))().operator_applications
    assert steps["operator"] == {"calls": applications, "cost": 1.0}
    assert steps["preconditioner"]["calls"] > applications - steps["start of the tangent"]["calls"]
    assert all(step["calls"] > 0 for step in steps.values())


def test_costs_are_compared_on_the_same_problem():
    (line,) = curves.lines([0.6], 1, points=2000)
    assert line["over_transform"] > 0
    assert [row["precision"] for row in curves.columns([9], 1)] == ["single", "double"]
    assert curves.rectangles([1.0, 5.0], 1, elements=17)[1.0] == 1
    assert set(curves.large_map(33)) == {"curve", "contact"}
