"""Pressures in viscoelastic media against direct integration, which uses neither elastic contacts nor creep."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import gamma

from support.contract import refused
from support.marching import stepped
from support.media import SPRINGS_AND_DASHPOTS as MEDIA
from support.media import Wrapped
from viscorough import (
    Load,
    Maxwell,
    Springpot,
    contact_at,
    indent,
    kinetics,
    pressure_at,
    self_affine_disc,
)

DISC = self_affine_disc(0.7, 17, seed=3)
DASHPOTS = ("newtonian", "kelvin-voigt")  # parallel to the rest of the medium


@pytest.mark.parametrize("name", sorted(set(MEDIA) - set(DASHPOTS)))
def test_pressures_after_a_ramp_and_a_step_agree_with_direct_integration(name):
    medium, scale = MEDIA[name], 0.5
    times, force = np.array([0, 0.5, 0.5, 2.0]), scale * np.array([0.1, 0.5, 0.8, 1.0])
    steps = np.append(np.linspace(0, 0.5, 41), np.linspace(0.5, 2, 41))
    loads = np.append(np.interp(steps[:41], times[:2], force[:2]), np.interp(steps[41:], times[2:], force[2:]))
    exact = stepped(DISC, medium, steps, force=loads).pressure
    errors = []
    for contacts in (16, 64):
        pressure = pressure_at(DISC, Load(times, force=force), medium, 2.0, contacts=contacts, tolerance=1e-8)
        assert (np.isnan(pressure) == np.isnan(DISC.heights)).all()
        errors.append(np.nanmax(abs(pressure - exact)) / np.nanmax(exact))
    assert errors[1] < 0.02
    assert errors[1] <= errors[0], "equal where there are fewer contact events than contacts"
    assert np.nansum(pressure) * DISC.spacing**2 == pytest.approx(force[-1], rel=1e-2)


HISTORIES = {
    "ramp": ([0, 0.5, 0.5, 2.0], [0.1, 0.5, 0.8, 1.0]),
    "hold": ([0, 2.0], [0.7, 0.7]),
    "step at the end": ([0, 1.0, 2.0, 2.0], [0.1, 0.5, 0.6, 1.0]),
    "first force at the end": ([0, 2.0, 2.0], [0.0, 0.0, 1.0]),
}


@pytest.mark.parametrize("history", HISTORIES)
@pytest.mark.parametrize("name", DASHPOTS)
def test_pressures_of_dashpots_are_taken_at_the_last_time(name, history):
    """The pressures are not means over the last step: all methods agree, however long that step is."""
    disc, medium = self_affine_disc(0.7, 33, seed=4), MEDIA[name]
    times, force = (np.array(values) for values in HISTORIES[history])
    by_steps = stepped(disc, medium, times, force=force).pressure
    by_contacts = pressure_at(disc, Load(times, force=force), medium, times[-1], tolerance=1e-8)
    np.testing.assert_allclose(by_contacts, by_steps, rtol=0, atol=1e-7 * np.nanmax(by_steps))
    for pressure in (by_steps, by_contacts):
        assert np.nansum(pressure) * disc.spacing**2 == pytest.approx(force[-1], rel=1e-12)


@pytest.mark.parametrize("name", DASHPOTS)
def test_dashpot_force_agrees_with_kinetics_under_a_depth_ramp(name):
    times, curve = np.linspace(0, 2, 21), indent(DISC, tolerance=1e-11, depths=0.15 * np.linspace(0, 2, 21)[1:])
    steps = stepped(DISC, MEDIA[name], times, depth=0.15 * times)
    expected = kinetics(curve, depth=0.15 * times, medium=MEDIA[name], times=times)
    np.testing.assert_allclose(steps.force[1:], expected.force[1:], rtol=1e-9)
    assert np.nansum(steps.pressure) * DISC.spacing**2 == pytest.approx(steps.force[-1], rel=1e-12)


def test_pressures_at_a_step_are_taken_after_it():
    force, times = [0.1, 0.5, 0.8, 1.0], [0, 0.5, 0.5, 2.0]
    after = pressure_at(DISC, Load(times, force=force), MEDIA["newtonian"], 0.5)
    up_to_it = stepped(DISC, MEDIA["newtonian"], times[:3], force=force[:3]).pressure
    np.testing.assert_allclose(after, up_to_it, rtol=0, atol=1e-3 * np.nanmax(up_to_it))
    assert np.nansum(after) * DISC.spacing**2 == pytest.approx(0.8, rel=1e-12)


@pytest.mark.parametrize("control", ["force", "depth"])
@pytest.mark.parametrize("name", MEDIA)
def test_pressures_of_a_receding_and_returning_contact_are_exact(name, control):
    """No pressure is tensile, the sum is the force, and direct integration agrees."""
    if control == "depth" and name in DASHPOTS:
        values = 0.1 * np.array([0, 1, 0.95, 1.05])
    else:
        values = (0.8 if control == "force" else 0.1) * np.array([0, 1, 0.3, 0.6])
    corners, times = np.array([0, 1.0, 1.4, 2.0]), np.linspace(0, 2, 1001)
    moved = stepped(DISC, MEDIA[name], times, **{control: np.interp(times, corners, values)})
    found = pressure_at(DISC, Load(corners, **{control: values}), MEDIA[name], 2.0, contacts=64, tolerance=1e-8)
    # Under a force both sums are exactly this force; under a depth each method gives a slightly different force.
    exact = 1e-12 if control == "force" else 1e-3
    for pressure in (moved.pressure, found):
        assert np.nanmin(pressure) >= 0
        assert np.nansum(pressure) * DISC.spacing**2 == pytest.approx(moved.force[-1], rel=exact)
    assert np.nansum(moved.pressure) * DISC.spacing**2 == pytest.approx(moved.force[-1], rel=1e-12)
    assert np.nansum(abs(found - moved.pressure)) < 1e-2 * np.nansum(moved.pressure)
    # The steps of direct integration may miss the last event.
    assert np.count_nonzero((np.nan_to_num(found) > 0) != (np.nan_to_num(moved.pressure) > 0)) <= 1


STEPS = Load([0, 0.5, 0.5, 2.0], force=[0.1, 0.5, 0.8, 1.0])
ALL = MEDIA | {f"springpot {exponent}": Springpot(2.0, exponent) for exponent in (0.1, 0.4, 0.9)}


@pytest.mark.parametrize("contacts", [1, 5, 64])
@pytest.mark.parametrize("name", ALL)
def test_sum_of_the_pressures_is_the_force(name, contacts):
    """The times are a step, shortly after it, and later. In a springpot the depth does not follow a step at once."""
    for time, force in ((0.25, 0.3), (0.5, 0.8), (0.5001, 0.8 + 0.2 * 1e-4 / 1.5), (2.0, 1.0)):
        pressure = pressure_at(DISC, STEPS, ALL[name], time, contacts=contacts)
        assert (np.isnan(pressure) == np.isnan(DISC.heights)).all()
        assert np.nansum(pressure) * DISC.spacing**2 == pytest.approx(force, rel=1e-9)
        assert np.nanmin(pressure) >= 0


@pytest.mark.parametrize("exponent", [0.2, 0.5, 0.8])
def test_pressures_at_a_step_in_a_springpot_are_the_limit_from_later_times(exponent):
    medium = Springpot(2.0, exponent)
    at_step, later = (pressure_at(DISC, STEPS, medium, time, tolerance=1e-8) for time in (0.5, 0.5 + 1e-13))
    assert np.nansum(abs(later - at_step)) < 5e-3 * np.nansum(at_step)


def test_first_step_in_a_springpot_is_carried_by_the_highest_element():
    pressure = pressure_at(DISC, Load([0.0, 2.0, 2.0], force=[0.0, 0.0, 1.0]), Springpot(2.0, 0.4), 2.0)
    assert np.nanargmax(pressure) == np.nanargmax(DISC.heights)
    assert np.count_nonzero(np.nan_to_num(pressure)) == 1
    assert np.nansum(pressure) * DISC.spacing**2 == pytest.approx(1.0)


def held_in_a_springpot(disc, medium, force, time):
    """Return p under a constant force, to rounding: p_el is linear in Φ between contact events; quadrature of ∫ψ dΦ."""
    a, last = medium.exponent, force * float(medium.creep_compliance(time))
    events = indent(disc, tolerance=1e-11, until_fraction=1.0).force
    levels = np.append(events[events < last], last)
    ends = time * np.append(0.0, (levels / last) ** (1 / a))
    factor = force / (gamma(1 + a) * gamma(1 - a)) * a
    pressure, before = np.where(np.isnan(disc.heights), np.nan, 0.0), 0.0
    for level, start, end, fall in zip(levels, ends[:-1], ends[1:], np.diff(levels, prepend=0.0), strict=True):
        middle = 0.5 * (start + end)
        if start == 0:
            first = quad(lambda s: (time - s) ** -a, 0, middle, weight="alg", wvar=(a - 1, 0), epsrel=1e-12)[0]
        else:
            first = quad(lambda s: s ** (a - 1) * (time - s) ** -a, start, middle, epsrel=1e-12)[0]
        if level == last:
            second = quad(lambda s: s ** (a - 1), middle, time, weight="alg", wvar=(0, -a), epsrel=1e-12)[0]
        else:
            second = quad(lambda s: s ** (a - 1) * (time - s) ** -a, middle, end, epsrel=1e-12)[0]
        after = np.nan_to_num(contact_at(disc, force=level, tolerance=1e-11).pressure)
        pressure += factor * (first + second) * (after - before) / fall
        before = after
    return pressure


def test_pressures_in_a_springpot_converge_at_second_order():
    """The reference pressures are exact. The error is a mean over the elements, several times and exponents."""
    disc, errors = self_affine_disc(0.7, 9, seed=3), []
    for exponent in (0.2, 0.5, 0.8):
        medium = Springpot(2.0, exponent)
        for time in (1e-3, 0.1, 1.0, 2.0, 4.0):
            exact = held_in_a_springpot(disc, medium, 0.5, time)
            found = (pressure_at(disc, 0.5, medium, time, contacts=n, tolerance=1e-9) for n in (8, 64))
            errors.append([np.nansum(abs(pressure - exact)) / np.nansum(exact) for pressure in found])
    coarse, fine = np.mean(errors, axis=0)
    assert fine < 2e-4
    assert np.log(coarse / fine) / np.log(8) > 1.8


def test_media_of_users_are_integrated_numerically():
    """A medium whose ψ is known only as a function has the same pressures as the equal springpot."""

    springpot = Springpot(2.0, 0.4)

    class WithRelaxation(Wrapped):
        def relaxation_modulus(self, time):
            return self.inner.relaxation_modulus(time)

        def relaxation_integral(self, start, end):
            return self.inner.relaxation_integral(start, end)

    for time in (0.5, 0.51, 2.0):
        exact, found = (pressure_at(DISC, STEPS, medium, time) for medium in (springpot, WithRelaxation(springpot)))
        assert np.nansum(abs(found - exact)) < 1e-3 * np.nansum(exact)


def test_invalid_arguments_are_refused():
    medium, force = Maxwell(1.0, 2.0), Load([0.0, 1.0], force=[1.0, 1.0])
    for arguments, message in (
        ((force, medium, 2.0), "time: 2.0; allowed: within those of the load"),
        ((0.0, medium, 1.0), "constant force: 0.0; allowed: a finite number above 0"),
    ):
        with refused(message):
            pressure_at(DISC, *arguments)
