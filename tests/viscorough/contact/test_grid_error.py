"""Errors of the grid against Hertz, their definition and finer maps."""

import numpy as np
import pytest

from support.contract import refused
from viscorough import (
    Indenter,
    indent,
    reference,
    self_affine_disc,
)
from viscorough.contact.grid_error import SAFETY_FACTOR

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


@pytest.mark.parametrize("heights", [np.zeros((2, 40)), np.where(np.indices((9, 9)).sum(0) % 2, 0.0, np.nan)[:, 1:]])
def test_maps_without_every_second_point_are_refused(heights):
    heights = heights.copy()
    heights[::2, ::2] = heights[::2, ::2] if len(heights) == 2 else np.nan
    with refused("grid error: every n-th point, n = 2, of a map of .* larger maps are needed"):
        indent(Indenter(heights, 1.0), estimate_grid_error=True)
