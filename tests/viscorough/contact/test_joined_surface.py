"""Loading curves end at the depth of complete contact, which follows from two linear problems."""

import numpy as np
import pytest

from viscorough import Indenter, indent, self_affine_disc
from viscorough.contact.complete_contact import complete_contact
from viscorough.reference import sphere
from viscorough.surfaces.self_affine import self_affine_square


def with_hole(heights):
    row, column = np.indices(heights.shape)
    return np.where((abs(row - 20) < 6) & (abs(column - 25) < 4), np.nan, heights)


def pit(across):
    heights = np.zeros((across, across))
    heights[across // 2, across // 2] = -1.0
    return Indenter(heights, 1.0)


RANDOM = np.random.default_rng(1)
SQUARE = self_affine_square(0.8, 48, seed=2)
INDENTERS = {
    **{f"disc, H = {hurst:g}": self_affine_disc(hurst, 65, seed=1) for hurst in (0.0, 0.5, 1.0)},
    "hole": Indenter(with_hole(SQUARE), 0.1),
    "long rectangles": Indenter(SQUARE, 0.1, 0.5),
    "strip": Indenter(SQUARE[:3], 0.1),
    "terraces": Indenter(np.round(2 * SQUARE), 0.1),
    "white noise": Indenter(RANDOM.random((40, 40)), 0.1),
    "two heights": Indenter(1.0 * (RANDOM.random((40, 40)) < 0.5), 0.1),
    "sphere": sphere(1.0).indenter(33),
    "pit": pit(41),
    "far units": Indenter(1e-12 * SQUARE, 1e9),
}


@pytest.mark.parametrize("tolerance", [0.1, 1e-2, 1e-4])
@pytest.mark.parametrize("indenter", INDENTERS.values(), ids=INDENTERS)
def test_whole_curve_ends_where_contact_becomes_complete(indenter, tolerance):
    """Elements that overlap within the tolerance do not let the path continue."""
    curve, end = indent(indenter, tolerance=tolerance, until_fraction=1.0), complete_contact(indenter)
    assert curve.contact_fraction[-1] == 1.0
    np.testing.assert_allclose(curve.depth[-1], end.depth, rtol=0.01 * tolerance)
    np.testing.assert_allclose(curve.force[-1], end.force, rtol=0.01 * tolerance)
    np.testing.assert_allclose(curve.stiffness[-1], end.stiffness, rtol=0.01 * tolerance)
    assert curve.residual.max() <= tolerance


@pytest.mark.parametrize("until_fraction", [1 - 1e-5, 0.999, 0.99])
@pytest.mark.parametrize("name", ["disc, H = 1", "pit"])
def test_curve_until_almost_all_elements_touch_does_not_pass_complete_contact(name, until_fraction):
    curve = indent(INDENTERS[name], tolerance=1e-2, until_fraction=until_fraction)
    assert curve.contact_fraction[-1] >= until_fraction
    assert curve.depth[-1] <= complete_contact(INDENTERS[name]).depth * (1 + 1e-4)


def test_force_beyond_complete_contact_ends_the_curve_there():
    disc = INDENTERS["disc, H = 0.5"]
    end = complete_contact(disc)
    curve = indent(disc, tolerance=1e-2, until_fraction=1.0, until_force=3 * end.force)
    np.testing.assert_allclose(curve.force[-1], end.force, rtol=1e-4)
