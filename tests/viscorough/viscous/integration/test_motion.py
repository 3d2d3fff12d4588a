"""Direct integrations as motions, against the correspondence on the elastic loading curve."""

import numpy as np
import pytest

from support.contract import refused
from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough.viscous.correspondence import impulses, kinetics
from viscorough.viscous.integration.events import march_events
from viscorough.viscous.integration.motion import under_constant_force, under_force_history
from viscorough.viscous.integration.stepping import march_steps

FORCE, VISCOSITY = 3.0, 7.0


@pytest.fixture(scope="module")
def disc():
    return self_affine_disc(0.7, 9, seed=1)


@pytest.fixture(scope="module")
def curve(disc):
    """With a level at every contact event, so that nothing is interpolated over one."""
    return indent(disc, tolerance=1e-11, depths=np.unique(march_events(disc).depth[1:]))


def test_constant_force(disc, curve):
    motion = under_constant_force(march_events(disc), FORCE / VISCOSITY)
    i = np.searchsorted(motion.depth, curve.depth[5:40])
    elastic = kinetics(curve, FORCE, VISCOSITY, motion.time[i])
    np.testing.assert_allclose(motion.depth[i], elastic.depth, rtol=1e-9)
    np.testing.assert_allclose(motion.velocity[i], np.diff(motion.depth)[i] / np.diff(motion.time)[i], rtol=1e-9)
    assert (motion.overlap == 0).all()
    assert motion.force is None


@pytest.mark.parametrize("method", ["events", "implicit"])
def test_force_history(disc, curve, method):
    """A force that rises, rests and ends: of the impulse alone, with the velocity of the force at that time."""
    times, force = np.array([0.0, 1.0, 2.0, 2.0, 3.0]), np.array([0.0, 2.0, 2.0, 0.0, 0.0])
    history = impulses(force, times)
    integration = march_events(disc)
    if method == "implicit":
        steps = np.unique(history.impulse[history.impulse > 0]) / VISCOSITY
        integration = march_steps(disc, steps, scheme="implicit", tolerance=1e-10)
    motion = under_force_history(integration, history, VISCOSITY)
    elastic = kinetics(curve, history, VISCOSITY)
    np.testing.assert_allclose(motion.depth[1:], elastic.depth[1:], rtol=1e-6)
    np.testing.assert_allclose(motion.velocity[1:], elastic.velocity[1:], rtol=1e-6)
    assert motion.depth[0] == 0
    assert motion.force.tolist() == force.tolist()
    assert motion.overlap is None


def test_an_impulse_beyond_the_last_event_is_refused(disc):
    events = march_events(disc, until_fraction=0.2)
    end = events.impulse[-1]
    under_force_history(events, impulses([1.0, 1.0], [0.0, end]), 1.0)
    with refused(
        f"impulse: {1.5 * end:.6g} is beyond the contact fraction at which events end; allowed: up to {end:.6g}"
    ):
        under_force_history(events, impulses([1.0, 1.0], [0.0, 1.5 * end]), 1.0)
