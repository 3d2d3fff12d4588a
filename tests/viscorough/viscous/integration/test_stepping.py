"""Time stepping of the viscous problem against its exact solution, event by event."""

import numpy as np
import pytest

from viscorough import AccuracyWarning, Indenter, reference, self_affine_disc
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.integration.stepping import newtonian_steps

DISC = Indenter(self_affine_disc(0.6, 33, seed=3).heights, (1.0, 2.0))


@pytest.fixture(scope="module")
def events():
    return newtonian_events(DISC)


@pytest.mark.parametrize("steps", [1, 15])
def test_implicit_steps_of_any_size_are_exact(events, steps):
    last = events.impulse[700]
    impulses = np.geomspace(last / 300, last, steps) if steps > 1 else np.array([last])
    result = newtonian_steps(DISC, impulses, scheme="implicit", tolerance=1e-8)
    np.testing.assert_allclose(result.depth, events.depth_at(impulses), rtol=1e-7)
    assert result.overlap.max() < 1e-7
    touching = np.searchsorted(events.impulse, impulses, side="right")
    np.testing.assert_allclose(result.contact_count, touching, atol=2)


def test_implicit_steps_find_depths_at_jumps_of_the_force():
    """At a tolerance of 1e-2, contacts of this sphere differ by a ring of elements from one depth to the next."""
    sphere = reference.sphere(1.0)
    forces = sphere.force(sphere.mdr_profile(np.geomspace(0.1, 0.45, 12)))
    steps = newtonian_steps(sphere.indenter(257), forces, scheme="implicit", tolerance=1e-2)
    np.testing.assert_allclose(steps.depth[-1], sphere.mdr_profile(0.45), rtol=1e-2)


def test_long_explicit_steps_overlap_the_surface_deeply(events):
    """The scheme fails as known, warns, and reports the overlap."""
    with pytest.warns(AccuracyWarning, match=r"overlaps the surface by up to \d"):
        result = newtonian_steps(DISC, np.linspace(0, events.impulse[700], 11)[1:])
    assert result.overlap[0] > 0.5
    assert result.depth[0] > 2 * events.depth_at(result.impulse[0])


def test_invalid_arguments_are_refused():
    for change, message in (
        ({"scheme": "magic"}, "scheme must be one of explicit, implicit"),
        ({"impulses": [2.0, 1.0]}, "each larger than the one before"),
        ({"indenter": Indenter(np.zeros(3), 1.0)}, "two-dimensional"),
    ):
        arguments = {"indenter": DISC, "impulses": [1.0], **change}
        with pytest.raises(ValueError, match=message):
            newtonian_steps(arguments.pop("indenter"), arguments.pop("impulses"), **arguments)


@pytest.mark.parametrize("tolerance", [1e-6, 5e-2], ids=["double", "single"])
def test_depths_that_overflow_are_refused(tolerance):
    """A deep indenter touches no surface beyond the map. Depths that overflow are refused."""
    indenter = Indenter(np.random.default_rng(0).random((3, 3)), 1.0)
    with pytest.warns(AccuracyWarning):
        steps = newtonian_steps(indenter, [1.0, 1e31], tolerance=tolerance)
    assert steps.contact_count[-1] == 9
    assert steps.depth[-1] > 1e30
    with pytest.raises(ValueError, match="the largest that is allowed"):
        newtonian_steps(indenter, [1.0, 1e305], tolerance=tolerance)
