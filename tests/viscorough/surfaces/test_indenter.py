"""Rigid indenters: heights of any real type, copied and kept; masks; heights out of range."""

import numpy as np
import pytest

from support.contract import refused
from viscorough import Indenter, indent, reduce


def test_rms_slope_and_element_of_a_plane():
    y, x = np.mgrid[:5, :7]
    heights = 0.6 * x + 1.6 * y
    for indenter in (Indenter(heights, (2.0, 4.0)), Indenter(heights, 2.0, 4.0), Indenter(heights.T, (4.0, 2.0))):
        assert indenter.rms_slope == pytest.approx(np.hypot(0.3, 0.4))
        assert indenter.element_side == pytest.approx(np.sqrt(8))
    assert (indenter.spacing, indenter.row_spacing, indenter.aspect) == (4.0, 2.0, 0.5)
    assert Indenter(heights, (5**0.5, 5**-0.5)).aspect == pytest.approx(1 / 5)
    for one_spacing in (heights, heights[0]):
        assert Indenter(one_spacing, 0.3).row_spacing == Indenter(one_spacing, 0.3).element_side == 0.3
    assert Indenter(np.array([[1.0]]), 1.0).rms_slope == 0


def test_spacings_and_units_out_of_range_are_refused():
    for arguments, what in (
        (((1.0, 2.0, 3.0),), "spacing: must be a positive number"),
        (("1,2",), "must be a positive number"),
        ((np.nan,), "spacing: must be a positive number"),
        (((1.0, -2.0),), "must be a positive number, not -2"),
        ((1.0, 5.1), "differ by more than a factor of 5"),
        ((1.0, None, 3), "length_unit: 3; allowed are"),
    ):
        with refused(what):
            Indenter(np.zeros((2, 2)), *arguments)
    with pytest.raises(ValueError, match="a line has no rows"):
        Indenter(np.zeros(3), (2.0, 3.0))


@pytest.mark.parametrize(("name", "points"), [("column_positions", 4), ("row_positions", 3)])
def test_positions_of_another_number_of_points_are_refused(name, points):
    with refused(rf"indenter {name}: shape \(5,\); {points} finite numbers are needed"):
        Indenter(np.zeros((3, 4)), 1.0, **{name: np.arange(5.0)})


def test_gaps_are_computed_in_double_precision():
    """Single precision cannot represent 2**24 - 0.001."""
    heights = np.array([[2.0**24, 0.001], [1, 1.001]]).astype(np.float32)
    exact = 2.0**24 - heights.astype(float)
    np.testing.assert_array_equal(Indenter(heights, 1.0).initial_gap, exact)
    for door, given in ((indent, heights), (reduce, heights.ravel())):
        typed, double = (door(Indenter(values, 1.0), until_fraction=1) for values in (given, given.astype(float)))
        np.testing.assert_array_equal([typed.depth, typed.force], [double.depth, double.force])


@pytest.mark.parametrize(
    ("heights", "what"),
    [
        (np.array([[1e308, -1e308]]), "also their differences; some are infinite"),
        (np.array([[np.longdouble("1e400"), 0]]), "some are infinite"),
        (np.zeros((2, 2, 2)), "one or two dimensions, not"),
        ([["a"]], "real numbers"),
        (np.ones((0, 3)), "at least one element"),
        ([[0, -np.inf]], "finite"),
        ([1.0, np.nan], "must not be nan on a line"),
        (np.ma.array([[1.0, 2.0]], mask=[[0, 1]]), "real numbers are needed"),
    ],
)
def test_invalid_heights_are_refused(heights, what):
    with refused(what):
        Indenter(heights, 1.0)
