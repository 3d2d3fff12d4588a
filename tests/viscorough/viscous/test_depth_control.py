"""The force under a given depth, of a sphere against closed forms."""

import numpy as np

from support.contract import refused
from support.curves import curve_of_body
from support.media import MEDIA
from viscorough import KelvinVoigt, kinetics, reference

SPHERE = reference.sphere(1.7)
CURVE = curve_of_body(SPHERE, np.geomspace(1e-6, 1, 601))


def test_force_of_a_dashpot_is_taken_just_after_each_time():
    medium, times, depth = MEDIA["newtonian"], np.arange(5.0), np.array([0.0, 0.1, 0.4, 0.4, 0.5])
    result = kinetics(CURVE, depth=depth, medium=medium, times=times)
    expected = medium.viscosity * SPHERE.stiffness(depth[1:]) * np.array([0.3, 0.0, 0.1, 0.1])
    np.testing.assert_allclose(result.force[1:], expected, rtol=1e-4)


def test_force_of_a_held_depth_relaxes_to_the_force_of_the_curve():
    """The row has the force of the curve at depths that are held, also between the levels of a coarse curve."""
    curve = curve_of_body(SPHERE, np.geomspace(1e-6, 1, 61), tolerance=1e-2)
    load = [0.0, 0.234, 0.234, 0.567, 0.567]
    motion = kinetics(curve, depth=load, medium=MEDIA["solid"], times=[0.0, 1.0, 100.0, 101.0, 200.0])
    expected = MEDIA["solid"].relaxation.relaxed_modulus * curve.at_depth([0.234, 0.567])[0]
    np.testing.assert_allclose(motion.force[[2, 4]], expected, rtol=1e-12)


def test_step_without_instantaneous_compliance_needs_an_infinite_force():
    """After the step, the force of the sphere relaxes as the modulus of the medium."""
    medium, times = MEDIA["springpot"], np.array([1.0, 1.1, 2.0, 30.0])
    motion = kinetics(CURVE, depth=np.full(4, 0.3), medium=medium, times=times)
    assert motion.force[0] == np.inf
    expected = SPHERE.force(0.3) * medium.relaxation_modulus(times[1:] - 1)
    np.testing.assert_allclose(motion.force[1:], expected, rtol=1e-7)


def test_force_of_a_dashpot_has_the_stiffness_of_the_curve():
    """The stiffness of the row jumps from spring to spring, by up to 0.2 %, which the force must not show."""
    curve = curve_of_body(SPHERE, np.geomspace(1e-6, 1, 61), tolerance=1e-2)
    times = np.linspace(0.0, 2.0, 41)
    motion = kinetics(curve, depth=0.4 * times, medium=MEDIA["newtonian"], times=times)
    expected = MEDIA["newtonian"].viscosity * 0.4 * curve.at_depth(motion.depth[1:])[1]
    np.testing.assert_allclose(motion.force[1:], expected, rtol=1e-9)


def test_invalid_histories_are_refused():
    for arguments, message in (
        (
            {"medium": KelvinVoigt(1.0, 1.0), "depth": [0, 0, 0.1]},
            "steps into the surface at time 1, which takes an infinite force",
        ),
        ({"depth": [0.1, 0.2]}, r"one per time, shape \(3,\)"),
        ({"depth": [0.1, 0.2, 2.0]}, "load: the depth 2 is beyond the curve's last level; allowed: up to 1"),
        ({"times": [0.0, 1.0, 0.5]}, "each larger than the one before, or given twice"),
    ):
        call = {"depth": [0.1, 0.2, 0.3], "medium": MEDIA["solid"], "times": [0.0, 1.0, 1.0]} | arguments
        with refused(message):
            kinetics(CURVE, **call)
