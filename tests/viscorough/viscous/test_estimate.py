"""Estimates by the penetration law: against simulations, for any medium, and outside the range of the law."""

import re

import numpy as np
import pytest

import viscorough
from support.contract import refused
from viscorough import Maxwell, Newtonian, StandardLinearSolid, estimate

RMS, DIAMETER = 2e-7, 3e-4
PER_X = 4 * RMS * DIAMETER  # F·J at X = 1
LAW = viscorough.penetration_law(0.6)


def test_estimate_is_the_mean_of_simulated_surfaces():
    """The mean is arithmetic, over 24 discs of 129 elements across."""
    hurst = 0.7
    times = np.geomspace(5e-3, 3, 6)  # force over viscosity is PER_X, so X = t
    times = times[times >= viscorough.penetration_law(hurst).x_low]
    estimated = estimate(hurst, RMS, DIAMETER, PER_X, 1.0, times)
    motions = []
    for seed in range(24):
        disc = viscorough.self_affine_disc(hurst, 129, rms=RMS, diameter=DIAMETER, seed=seed)
        curve = viscorough.indent(disc, until_force=1.1 * PER_X * times[-1], tolerance=1e-2)
        motion = viscorough.kinetics(curve, PER_X, 1.0, times)
        motions.append([motion.velocity, motion.depth])
    velocity, depth = np.mean(motions, axis=0)
    # The limit is three standard errors of the mean.
    np.testing.assert_allclose(estimated.velocity, velocity, rtol=0.2)
    np.testing.assert_allclose(estimated.velocity[times > 0.5], velocity[times > 0.5], rtol=0.05)
    np.testing.assert_allclose(estimated.depth, depth, rtol=0.2)


def test_newtonian_media_follow_the_law():
    times = np.array([0.02, 0.05])
    estimated = viscorough.estimate(0.6, RMS, DIAMETER, 3 * PER_X, Newtonian(3.0), times)
    np.testing.assert_allclose(estimated.x, times)
    for name, scale in (("velocity", RMS / times), ("depth", RMS)):
        np.testing.assert_allclose(getattr(estimated, name), scale * getattr(LAW, name)(times), rtol=1e-14)


@pytest.mark.parametrize("medium", [Maxwell(100.0, 1.0), StandardLinearSolid(100.0, 20.0, 0.3)])
def test_velocity_is_the_derivative_of_the_depth_in_any_medium(medium):
    times = 0.3 + 1e-5 * np.array([-1.0, 0.0, 1.0])
    estimated = estimate(0.6, RMS, DIAMETER, 0.2 * PER_X, medium, times)
    assert estimated.velocity[1] == pytest.approx(np.gradient(estimated.depth, times)[1], rel=1e-6)


def test_law_gives_no_numbers_outside_its_range():
    estimated = estimate(0.6, RMS, DIAMETER, PER_X, 1.0, [0.9 * LAW.x_low, 1.0, 1.1 * LAW.x_high])
    assert estimated.where.tolist() == ["below", "", "above"]
    for name in ("depth", "velocity"):
        assert np.isfinite(getattr(estimated, name)).tolist() == [False, True, False]
    *lines, errors = str(estimated).splitlines()
    assert [line.split()[-1] for line in lines[1:]][::2] == ["below", "above"]
    assert errors.endswith(f"depth ± {100 * LAW.depth_error:.2g} %, velocity ± {100 * LAW.velocity_error:.2g} %")


def test_values_outside_their_ranges_are_refused():
    right = {"hurst": 0.6, "rms": RMS, "diameter": DIAMETER, "force": PER_X, "medium": 1.0, "times": [0.02]}
    for changes, what in (
        ({"hurst": 1.05}, "hurst: must be from 0.1 to 1 for the penetration law"),
        ({"force": np.inf}, "force: must be a positive number, not inf"),
        ({"medium": 0}, "medium: 0; allowed: a medium as viscorough.Maxwell, or the viscosity of a Newtonian one"),
        ({"times": [2, 1]}, "times: allowed is one row"),
        ({"times": [5e3]}, f"X = F·J(t)/(4hL) is 5000; allowed: {LAW.x_low:.3g} to {LAW.x_high:.3g}, where"),
        ({"force": 1e300, "rms": 1e-300}, "is inf; allowed"),
    ):
        with refused(re.escape(what)):
            estimate(**right | changes)
