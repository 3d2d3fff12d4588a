"""Pressures in viscoelastic media against direct integration, which uses neither elastic contacts nor the creep."""

import numpy as np
import pytest

from support.contract import refused
from support.media import SPRINGS_AND_DASHPOTS as MEDIA
from viscorough import (
    CreepTable,
    Maxwell,
    Springpot,
    force_under_depth,
    impulses,
    indent,
    march_medium,
    pressure_at,
    self_affine_disc,
)

DISC = self_affine_disc(0.7, 17, seed=3)
DASHPOTS = ("newtonian", "kelvin-voigt")  # side by side with the rest of the medium


@pytest.mark.parametrize("name", sorted(set(MEDIA) - set(DASHPOTS)))
def test_pressures_of_a_ramp_and_a_step(name):
    medium, scale = MEDIA[name], 0.5
    times, force = np.array([0, 0.5, 0.5, 2.0]), scale * np.array([0.1, 0.5, 0.8, 1.0])
    steps = np.append(np.linspace(0, 0.5, 41), np.linspace(0.5, 2, 41))
    loads = np.append(np.interp(steps[:41], times[:2], force[:2]), np.interp(steps[41:], times[2:], force[2:]))
    exact = march_medium(DISC, medium, steps, force=loads).pressure
    errors = []
    for contacts in (16, 64):
        pressure = pressure_at(DISC, medium, impulses(force, times), 2.0, contacts=contacts, tolerance=1e-8)
        assert (np.isnan(pressure) == np.isnan(DISC.heights)).all()
        errors.append(np.nanmax(abs(pressure - exact)) / np.nanmax(exact))
    assert errors[1] < min(0.02, errors[0])
    assert np.nansum(pressure) * DISC.spacing**2 == pytest.approx(force[-1], rel=1e-2)


HISTORIES = {
    "ramp": ([0, 0.5, 0.5, 2.0], [0.1, 0.5, 0.8, 1.0]),
    "hold": ([0, 2.0], [0.7, 0.7]),
    "step at the end": ([0, 1.0, 2.0, 2.0], [0.1, 0.5, 0.6, 1.0]),
    "first force at the end": ([0, 2.0, 2.0], [0.0, 0.0, 1.0]),
}


@pytest.mark.parametrize("history", HISTORIES)
@pytest.mark.parametrize("name", DASHPOTS)
def test_pressures_of_dashpots_are_those_at_the_last_time(name, history):
    """Not the mean over the last step: all ways to compute them agree, however long that step is."""
    disc, medium = self_affine_disc(0.7, 33, seed=4), MEDIA[name]
    times, force = (np.array(values) for values in HISTORIES[history])
    by_steps = march_medium(disc, medium, times, force=force).pressure
    by_contacts = pressure_at(disc, medium, impulses(force, times), times[-1], tolerance=1e-8)
    np.testing.assert_allclose(by_contacts, by_steps, rtol=0, atol=1e-7 * np.nanmax(by_steps))
    for pressure in (by_steps, by_contacts):
        assert np.nansum(pressure) * disc.spacing**2 == pytest.approx(force[-1], rel=1e-12)


@pytest.mark.parametrize("name", DASHPOTS)
def test_force_of_a_dashpot_under_a_ramp_of_the_depth_is_that_at_each_time(name):
    times, curve = np.linspace(0, 2, 21), indent(DISC, tolerance=1e-11, depths=0.15 * np.linspace(0, 2, 21)[1:])
    steps = march_medium(DISC, MEDIA[name], times, depth=0.15 * times)
    expected = force_under_depth(curve, 0.15 * times, MEDIA[name], times)
    np.testing.assert_allclose(steps.force[1:], expected.force[1:], rtol=1e-9)
    assert np.nansum(steps.pressure) * DISC.spacing**2 == pytest.approx(steps.force[-1], rel=1e-12)


def test_pressures_at_a_step_within_the_history_are_those_after_it():
    force, times = [0.1, 0.5, 0.8, 1.0], [0, 0.5, 0.5, 2.0]
    after = pressure_at(DISC, MEDIA["newtonian"], impulses(force, times), 0.5)
    up_to_it = march_medium(DISC, MEDIA["newtonian"], times[:3], force=force[:3]).pressure
    np.testing.assert_allclose(after, up_to_it, rtol=0, atol=1e-3 * np.nanmax(up_to_it))
    assert np.nansum(after) * DISC.spacing**2 == pytest.approx(0.8, rel=1e-12)


@pytest.mark.parametrize("name", DASHPOTS)
def test_pressures_of_a_receding_contact_are_not_tensile(name):
    times, force = np.linspace(0, 2, 41), np.append(np.linspace(0, 1, 21), np.linspace(1, 0.05, 21)[1:])
    moved = march_medium(DISC, MEDIA[name], times, force=force)
    assert np.nanmin(moved.pressure) >= 0
    assert np.nansum(moved.pressure) * DISC.spacing**2 == pytest.approx(force[-1], rel=1e-12)


def test_a_step_and_its_hold_are_exact_in_the_sum():
    """The sum of the pressures is the force, in a springpot too, whose elastic part has no share in it at first."""
    for medium in (MEDIA["solid"], Springpot(2.0, 0.4)):
        pressure = pressure_at(DISC, medium, 0.5, 3.0, contacts=200)
        assert np.nansum(pressure) * DISC.spacing**2 == pytest.approx(0.5, rel=2e-2)
        assert np.nanmin(pressure) >= 0


def test_refusals():
    medium, force = Maxwell(1.0, 2.0), impulses([1.0, 1.0], [0.0, 1.0])
    for arguments, message in (
        ((CreepTable([0, 1], [0, 1]), 1.0, 1.0), "CreepTable; allowed: media whose relaxation is known"),
        ((medium, force, 2.0), "time: 2.0; allowed: within those of the force"),
        ((medium, impulses([1.0, 0.0], [0.0, 1.0]), 1.0), "from time 0 on the contact would recede"),
    ):
        with refused(message):
            pressure_at(DISC, *arguments)
