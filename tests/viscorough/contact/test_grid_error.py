"""Errors of the grid against Hertz, their definition and finer maps; curves to a requested error."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from support.contract import refused
from support.curves import curve_of_body
from viscorough import (
    AccuracyWarning,
    Indenter,
    Load,
    contact_at,
    indent,
    kinetics,
    reference,
    self_affine_disc,
)
from viscorough.contact.grid_error import FORCE_SAFETY_FACTOR, SAFETY_FACTOR, lowest_force, with_grid_errors

HALF_A_DECADE = np.log(10) / 2
BALL = reference.sphere(2.0)


def root_mean_square(values):
    return np.sqrt(np.mean(np.square(values)))


def every_second(indenter):
    return Indenter(indenter.heights[::2, ::2], (2 * indenter.spacing, 2 * indenter.row_spacing))


def velocity_change(curve, other, force):
    """Return ln of the ratio of two velocities at the same forces."""
    return np.log(other.at_force(force)[1] / curve.at_force(force)[1])


# ---- the estimate ----------------------------------------------------------------------------------------------------
@pytest.mark.parametrize("elements", [65, 67], ids=["apex on every second point", "apex between every second point"])
def test_grid_error_of_a_sphere_exceeds_the_error_against_hertz(elements):
    """Without the apex of the ball every second point is lower by δ, which changes the force by a share of 1.5 δ/u."""
    curve = indent(BALL.indenter(elements, width=2), until_fraction=0.5, estimate_grid_error=True)
    hertz_depth = (curve.force / BALL.force(1.0)) ** (2 / 3)
    velocity = np.log(BALL.stiffness(hertz_depth) / curve.stiffness)
    force = BALL.force(curve.depth) / curve.force - 1
    levels = np.flatnonzero(curve.contact_count >= 20)
    assert levels.size > 50
    for level in levels:
        window = abs(np.log(curve.force / curve.force[level])) < HALF_A_DECADE
        assert root_mean_square(velocity[window]) < curve.grid_error[level]
        assert root_mean_square(force[window]) < curve.force_grid_error[level]
    assert curve.grid_error[-1] < 0.02
    assert curve.force_grid_error[-1] < 0.003
    assert -0.03 < curve.area_change[-1] < -0.01  # counting elements makes the area of a disc too large, by about 1.6 %


def test_grid_error_is_the_difference_from_every_second_point():
    """The error is a mean over half a decade of force to either side; the mean error covers all F from hL/25 on."""
    disc = self_affine_disc(0.6, 65, rms=0.02, seed=3)
    curve = indent(disc, tolerance=1e-4, estimate_grid_error=True)
    coarse = indent(every_second(disc), tolerance=1e-4, until_fraction=1.0)
    area = disc.elements * disc.spacing**2
    lowest = 0.04 * 0.02 * np.sqrt(4 * area / np.pi)
    for level in np.flatnonzero(curve.force > lowest)[::20]:
        ends = np.clip(curve.force[level] * np.sqrt([0.1, 10]), curve.force[0], curve.force[-1])
        change = velocity_change(curve, coarse, np.geomspace(*ends, 2001))
        assert curve.grid_error[level] == pytest.approx(SAFETY_FACTOR * root_mean_square(change), rel=0.05, abs=1e-3)
    change = velocity_change(curve, coarse, np.geomspace(lowest, curve.force[-1], 2001))
    assert curve.mean_grid_error == pytest.approx(SAFETY_FACTOR * root_mean_square(change), rel=0.03)


@pytest.mark.parametrize("shape", [(20, 20), (21, 20)], ids=["even", "odd"])
def test_grid_error_of_a_flat_punch(shape):
    """The curve has one level, and the velocity is proportional to 1/stiffness of the punch."""
    punch = Indenter(np.zeros(shape), 1.0)
    curve = indent(punch, estimate_grid_error=True)
    change = np.log(indent(every_second(punch)).stiffness / curve.stiffness)
    assert curve.grid_error == pytest.approx(SAFETY_FACTOR * abs(change))
    assert curve.mean_grid_error == pytest.approx(curve.grid_error[0])
    assert curve.area_change == pytest.approx([punch.elements / (4 * every_second(punch).elements) - 1])


def test_coarse_curve_is_continued_as_a_straight_line():
    """The curve of every second point ends at half of the depth; its stiffness stays the same from there on."""
    depth = np.geomspace(0.01, 1.0, 200)
    curve, coarse = curve_of_body(BALL, depth), curve_of_body(BALL, depth[depth <= 0.5])
    end = coarse.depth[-1]
    curve = with_grid_errors(curve, coarse, BALL.indenter(33, width=2), 0.0)
    force = np.geomspace(curve.force[-1] / np.sqrt(10), curve.force[-1], 2001)
    depth = (force / BALL.force(1.0)) ** (2 / 3)
    beyond = np.maximum(depth - end, 0.0)
    straight = BALL.force(np.minimum(depth, end)) + BALL.stiffness(end) * beyond
    assert curve.force_grid_error[-1] == pytest.approx(
        FORCE_SAFETY_FACTOR * root_mean_square(1 - straight / force), rel=0.02
    )
    ratio = BALL.stiffness(depth) / BALL.stiffness(np.minimum(depth, end))
    assert curve.grid_error[-1] == pytest.approx(SAFETY_FACTOR * root_mean_square(np.log(ratio)), rel=0.02)


def test_given_levels_have_grid_errors():
    disc = self_affine_disc(0.8, 65, rms=0.02, seed=1)
    whole = indent(disc, estimate_grid_error=True)
    force = whole.force[[-8, -4]]
    for given in ({"forces": force}, {"depths": whole.depth[[-8, -4]]}):
        curve = indent(disc, estimate_grid_error=True, **given)
        np.testing.assert_allclose(curve.force, force, rtol=1e-4)
        assert curve.grid_error.shape == (2,)
        assert (curve.grid_error < 3 * whole.grid_error[[-8, -4]]).all()
    assert indent(disc, forces=force).grid_error is None


def test_missing_points_and_rectangles_have_grid_errors():
    """The map has a hole and elements twice as long as wide; every second point keeps both."""
    disc = self_affine_disc(0.8, 64, rms=0.02, seed=2)
    heights = disc.heights[::2].copy()
    heights[10:14, 20:30] = np.nan
    fine = Indenter(heights, (disc.spacing, 2 * disc.spacing))
    curve = indent(fine, estimate_grid_error=True)
    coarse = indent(every_second(fine), until_fraction=1.0)
    middle = np.searchsorted(curve.force, 0.01 * curve.force[-1])
    ends = curve.force[middle] * np.sqrt([0.1, 10])
    change = velocity_change(curve, coarse, np.geomspace(*ends, 2001))
    assert curve.grid_error[middle] == pytest.approx(SAFETY_FACTOR * root_mean_square(change), rel=0.05)


@pytest.mark.parametrize("asked", [{"estimate_grid_error": True}, {"error": 0.1}])
@pytest.mark.parametrize("heights", [np.zeros((2, 40)), np.where(np.indices((9, 9)).sum(0) % 2, 0.0, np.nan)[:, 1:]])
def test_maps_without_every_second_point_are_refused(asked, heights):
    heights = heights.copy()
    heights[::2, ::2] = heights[::2, ::2] if len(heights) == 2 else np.nan
    with refused("grid error: every 2nd point of a map of .* larger maps are needed"):
        indent(Indenter(heights, 1.0), **asked)


# ---- curves to a requested error -------------------------------------------------------------------------------------
@pytest.mark.parametrize("error", [0.2, 0.05])
def test_requested_error_is_met_with_fewer_points(error):
    disc = self_affine_disc(0.9, 257, rms=0.02, seed=4)
    curve, full = indent(disc, error=error), indent(disc)
    assert curve.sampling == {0.2: 8, 0.05: 2}[error]
    assert curve.elements < 1.1 * disc.elements / curve.sampling**2
    assert curve.mean_grid_error <= error
    force = np.geomspace(0.04 * 0.02, 3 * 0.02, 101)
    assert root_mean_square(velocity_change(full, curve, force)) < error
    assert f"every {curve.sampling}" in curve.choice
    assert f"the requested {100 * error:g} %" in curve.choice


def test_depths_count_from_the_highest_point_of_the_whole_map():
    """The sampling leaves out the highest point of the map."""
    indenter = BALL.indenter(133, width=2)
    curve = indent(indenter, error=0.2, until_fraction=0.5)
    missed = -np.nanmax(indenter.heights[:: curve.sampling, :: curve.sampling])
    level = np.searchsorted(curve.contact_count, 32)
    assert missed > 0.03 * curve.depth[level]
    assert curve.depth[level] == pytest.approx((curve.force[level] / BALL.force(1.0)) ** (2 / 3), rel=0.005)


def spiked():
    """A single bad pixel, 20 rms heights high, lies between the points of every sampling."""
    disc = self_affine_disc(0.8, 129, rms=0.05, seed=1)
    heights = disc.heights.copy()
    heights[61, 45] = 1.0
    return Indenter(heights, disc.spacing)


def with_grain():
    """A grain of 3 x 3 points, ten rms heights high."""
    disc = self_affine_disc(0.8, 129, rms=0.05, seed=1)
    heights = disc.heights.copy()
    heights[60:63, 44:47] += 0.5
    return Indenter(heights, disc.spacing)


def sine():
    """A texture of 4.03 points: every 4th point is a wave of 541 points."""
    phase = 2 * np.pi * np.arange(128) / 4.03
    return Indenter(0.05 * (np.sin(phase)[:, None] + np.sin(phase)), 0.01)


def sawtooth():
    """Turned grooves that are sharp on one side, on a rough disc."""
    disc = self_affine_disc(0.9, 129, rms=0.001, seed=1)
    return Indenter(disc.heights + 0.05 * (np.arange(129) / 12.37 % 1), disc.spacing)


@pytest.mark.parametrize("error", [0.05, 0.2])
@pytest.mark.parametrize("surface", [spiked, with_grain, sine, sawtooth])
def test_features_that_a_sampling_misses_are_found(surface, error):
    """The curves of two samplings agree, but the curve of all points differs from both by up to a factor of ten."""
    indenter = surface()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)  # the full map may be too coarse for the request
        curve = indent(indenter, error=error)
    full = indent(indenter)
    lowest = lowest_force(indenter, full.force[-1])
    force = np.geomspace(lowest, min(full.force[-1], curve.force[-1]) * (1 - 1e-9), 1001)
    assert root_mean_square(velocity_change(full, curve, force)) < 1.3 * error


def test_plateaus_of_a_quantised_surface_touch_at_their_force():
    """The stiffness rises tenfold where a plateau touches, so a small error of this force changes velocities a lot."""
    disc = self_affine_disc(0.65, 66, rms=0.05, seed=111299470)
    disc = replace(disc, heights=np.round(disc.heights / 0.0833) * 0.0833)
    full = indent(disc)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        curve = indent(disc, error=0.1)
    force = np.geomspace(lowest_force(disc, full.force[-1]), min(full.force[-1], curve.force[-1]) * (1 - 1e-9), 1001)
    assert root_mean_square(velocity_change(full, curve, force)) < 0.13


@pytest.mark.parametrize("fraction", [0.3, 0.9])
def test_contact_fraction_at_the_end_is_that_of_the_whole_map(fraction):
    disc = self_affine_disc(0.7, 129, rms=0.02, seed=3)
    curve = indent(disc, error=0.2, until_fraction=fraction)
    assert curve.sampling > 1
    assert fraction <= contact_at(disc, force=curve.force[-1] * (1 + 1e-9)).contact_fraction < 0.1 + fraction
    assert indent(disc, error=0.2, until_force=0.01).force[-1] == pytest.approx(0.01, rel=0.1)


def test_curve_begins_where_the_highest_element_of_the_whole_map_touches():
    """Motions then begin at force 0, although the highest point that was sampled is far below the spike."""
    disc = self_affine_disc(0.8, 129, rms=0.02, seed=3)
    full, curve = indent(disc), indent(disc, error=0.2)
    assert curve.sampling > 1
    assert np.nanmax(disc.heights) > np.nanmax(disc.heights[:: curve.sampling, :: curve.sampling])
    assert curve.starts_straight
    assert curve.force[0] == pytest.approx(full.force[0])
    assert (np.diff(curve.stiffness) >= -1e-6 * curve.stiffness[:-1]).all()
    motion = kinetics(curve, Load([0.0, 1.0, 2.0], force=[0.0, 0.01, 0.0]), 1.0)
    assert motion.depth == pytest.approx(
        kinetics(full, Load([0.0, 1.0, 2.0], force=[0.0, 0.01, 0.0]), 1.0).depth, rel=0.05
    )


def test_flat_map_needs_few_points():
    curve = indent(Indenter(np.zeros((65, 65)), 1.0), error=0.1)
    assert curve.sampling > 1
    assert curve.stiffness == pytest.approx(indent(Indenter(np.zeros((65, 65)), 1.0)).stiffness, rel=0.1)


def test_error_that_cannot_be_reached_is_a_warning():
    disc = self_affine_disc(0.1, 33, rms=0.02, seed=1)
    with pytest.warns(AccuracyWarning, match="an error of 1 % is out of reach of this map: .* a finer scan is needed"):
        curve = indent(disc, error=0.01)
    assert curve.sampling == 1
    assert curve.choice.startswith("all 33 x 33 points")
    np.testing.assert_allclose(curve.at_force(0.001)[0], indent(disc).at_force(0.001)[0], rtol=1e-3)


@pytest.mark.parametrize("other", [{"tolerance": 1e-3}, {"depths": [0.01]}, {"forces": [0.01]}], ids=str)
def test_error_excludes_the_options_that_it_chooses(other):
    with refused("indent: error and .* exclude each other"):
        indent(self_affine_disc(0.8, 33, seed=1), error=0.1, **other)


@pytest.mark.parametrize("error", [0.0, 1e-4, 0.6, 5, np.nan, -0.1])
def test_error_is_a_share(error):
    with refused("indent: error.*(must be between 0.001 and 0.5|a finite number is needed)"):
        indent(self_affine_disc(0.8, 33, seed=1), error=error)
