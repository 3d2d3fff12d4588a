"""Interpolation between the levels of a loading curve: exact for some curves, bounded by convexity for all."""

from types import SimpleNamespace

import numpy as np
import pytest

from support.curves import curve_of_body, curve_of_levels
from viscorough import reference


def springs(gaps, depths):
    """Return the curve of independent springs of stiffness 1 with these gaps: convex, straight between contacts."""
    loads = np.maximum(np.asarray(depths)[:, None] - gaps, 0)
    count = np.count_nonzero(np.asarray(depths)[:, None] > gaps, axis=1)
    return curve_of_levels(depths, loads.sum(axis=1), count, count)


@pytest.mark.parametrize("exponent", [1, 1.5, 2, 7])
def test_power_law_is_exact_between_two_levels(exponent):
    """ln u is linear in ln F, so the cubic is the line: three decades of depth with only rounding errors."""
    body = reference.PowerLawBody(0.3, exponent)
    level = np.array([1e-3, 1.0])
    curve = curve_of_body(body, level)
    depth = np.geomspace(1e-3, 1.0, 50)[1:-1]
    interpolated, stiffness = curve.at_force(body.force(depth))
    np.testing.assert_allclose(interpolated, depth, rtol=1e-12)
    np.testing.assert_allclose(stiffness, body.stiffness(depth), rtol=1e-11)


def test_one_joining_element_makes_two_tangents():
    """Three springs touch at depths 0, 1 and 3. At most one contact event lies between two levels."""
    gaps = np.array([0.0, 1.0, 3.0])
    curve = springs(gaps, [0.6, 1.1, 2.5, 3.7])
    depth = np.array([0.0, 0.1, 0.99, 1.01, 2.0, 2.99, 3.01, 3.7])
    force = np.maximum(depth[:, None] - gaps, 0).sum(axis=1)
    interpolated, stiffness = curve.at_force(force)
    np.testing.assert_allclose(interpolated, depth, rtol=1e-14, atol=1e-15)
    np.testing.assert_array_equal(stiffness, [1, 1, 1, 2, 2, 2, 3, 3])


def test_levels_decades_apart_are_exact_if_no_element_joins():
    """Both tangents are the same line, but the tangent at the upper level loses all digits near the lower level."""
    gaps = np.array([0.0, 1e-16])
    for last in np.random.default_rng(1).uniform(0.5, 1.0, 100):
        curve = springs(gaps, [3e-16, last])
        depth = np.geomspace(3e-16, last, 80)
        interpolated, stiffness = curve.at_force(np.maximum(depth[:, None] - gaps, 0).sum(axis=1))
        np.testing.assert_allclose(interpolated, depth, rtol=1e-14)
        assert (np.diff(interpolated) > 0).all()
        np.testing.assert_array_equal(stiffness, 2)


def test_stiffness_at_a_level_is_the_stored_one():
    """A contact event is a level. The stiffness jumps there, and the curve stores the stiffness beyond it."""
    gaps = np.array([0.0, 1.0, 3.0, 3.5])
    levels = springs(gaps, [1.0, 3.0, 3.5, 4.0])
    curve = curve_of_levels(levels.depth, levels.force, [2, 3, 4, 4], [2, 3, 4, 4])
    depth, stiffness = curve.at_force(curve.force)
    np.testing.assert_allclose(depth, curve.depth, rtol=1e-15)
    np.testing.assert_array_equal(stiffness, curve.stiffness)


@pytest.mark.parametrize("seed", range(6))
def test_convexity_confines_coarse_levels(seed):
    """On levels of any distance, the interpolant rises and lies between chord and tangents."""
    random = np.random.default_rng(seed)
    gaps = np.sort(random.random(300) ** 3)
    gaps -= gaps[0]
    levels = np.sort(random.uniform(0.01, 1.2, 4))
    curve = springs(gaps, levels)
    force = np.linspace(curve.force[0], curve.force[-1], 500)
    depth, stiffness = curve.at_force(force)

    j = np.clip(np.searchsorted(curve.force, force), 1, len(levels) - 1)
    chord = np.interp(force, curve.force, curve.depth)
    tangents = np.minimum(
        curve.depth[j - 1] + (force - curve.force[j - 1]) / curve.stiffness[j - 1],
        curve.depth[j] - (curve.force[j] - force) / curve.stiffness[j],
    )
    assert (depth >= chord * (1 - 1e-12)).all()
    assert (depth <= tangents * (1 + 1e-12)).all()
    assert (np.diff(depth) > 0).all()
    assert (stiffness >= curve.stiffness[j - 1]).all()
    assert (stiffness <= curve.stiffness[j]).all()


def test_interpolation_of_a_smooth_curve_is_of_fourth_order():
    """F = u² + u³ is no power law. Halving the spacing of the levels in ln u reduces the error by 2⁴."""
    force = np.polynomial.Polynomial([0, 0, 1, 1])
    body = SimpleNamespace(force=force, stiffness=force.deriv())
    depth, errors = np.geomspace(1e-2, 10, 3001), []
    for intervals in (10, 20, 40):
        curve = curve_of_body(body, np.geomspace(1e-2, 10, intervals + 1))
        interpolated, _ = curve.at_force(np.clip(force(depth), curve.force[0], curve.force[-1]))
        errors.append(np.max(np.abs(interpolated / depth - 1)))
    order = np.polyfit(np.log([1, 2, 4]), np.log(errors), 1)[0]
    assert -order > 3.7
    assert errors[-1] < 1e-5


def test_forces_outside_the_levels_give_nan():
    """Beyond the last level the result is nan; also below the first, unless the curve is a line through the origin."""
    straight = springs(np.array([0.0, 0.5]), [0.2])
    depth, stiffness = straight.at_force(np.array([0.0, 0.1, 0.2, 0.2000001, -0.1, np.nan]))
    np.testing.assert_allclose(depth, [0, 0.1, 0.2, np.nan, np.nan, np.nan], rtol=1e-15)
    np.testing.assert_array_equal(stiffness, [1, 1, 1, np.nan, np.nan, np.nan])
    assert np.shape(straight.at_force(0.1)) == (2,)
    assert straight.at_force(np.full((2, 3), 0.1))[0].shape == (2, 3)

    sphere = reference.sphere(1.0)
    level = np.array([0.1, 0.2])
    curve = curve_of_body(sphere, level)
    depth, _ = curve.at_force(curve.force[0] * np.array([0.5, 1.0]))
    np.testing.assert_array_equal(depth, [np.nan, 0.1])


@pytest.mark.parametrize("exponent", [1, 1.5, 7])
def test_force_at_a_depth_is_exact_for_a_power_law(exponent):
    body = reference.PowerLawBody(0.3, exponent)
    curve, depth = curve_of_body(body, np.array([1e-3, 1.0])), np.geomspace(1e-3, 1.0, 50)[1:-1]
    force, stiffness = curve.at_depth(depth)
    np.testing.assert_allclose(force, body.force(depth), rtol=1e-11)
    np.testing.assert_allclose(stiffness, body.stiffness(depth), rtol=1e-10)


@pytest.mark.parametrize("seed", range(4))
def test_force_at_a_depth_inverts_depth_at_a_force(seed):
    """On coarse levels the interpolant follows tangents and chords; the levels themselves are included."""
    random = np.random.default_rng(seed)
    gaps = np.sort(random.random(300) ** 3)
    curve = springs(gaps - gaps[0], np.sort(random.uniform(0.01, 1.2, 4)))
    depth = np.append(np.linspace(curve.depth[0], curve.depth[-1], 301), curve.depth)
    force, stiffness = curve.at_depth(depth)
    np.testing.assert_allclose(curve.at_force(force)[0], depth, rtol=1e-12)
    np.testing.assert_array_equal(force[-4:], curve.force)
    np.testing.assert_allclose(stiffness[-4:], curve.stiffness, rtol=1e-14)


def test_depths_outside_the_levels_give_nan():
    straight = springs(np.array([0.0, 0.5]), [0.2])
    force, stiffness = straight.at_depth(np.array([[0.0, 0.1, 0.2], [0.2000001, -0.1, np.nan]]))
    np.testing.assert_allclose(force, [[0, 0.1, 0.2], [np.nan] * 3], rtol=1e-15)
    np.testing.assert_array_equal(stiffness, [[1, 1, 1], [np.nan] * 3])
    curve = curve_of_body(reference.sphere(1.0), np.array([0.1, 0.2]))
    np.testing.assert_array_equal(curve.at_depth([0.0, 0.05, 0.1])[0], [0.0, np.nan, curve.force[0]])


def test_contact_fraction_is_the_share_of_all_elements():
    curve = springs(np.array([0.0, 0.5]), [0.2, 0.8])
    np.testing.assert_array_equal(curve.contact_fraction, [1e-6, 2e-6])
