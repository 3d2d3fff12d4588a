"""Rows of unilateral springs, against steps in time by an independent solver, and against themselves."""

import numpy as np
import pytest
from scipy.optimize import brentq

from support.media import SPRINGS_AND_DASHPOTS
from support.small_motion import SpringsAndDashpots, small_motion
from viscorough import Load, Springpot
from viscorough.media.creep_response import creep_response
from viscorough.media.kinds import KelvinVoigt, Maxwell, Newtonian, Prony, StandardLinearSolid
from viscorough.media.spectra import power_law_spectrum, relaxation_spectrum, spectrum_of
from viscorough.viscous.crossing import INTERVALS, first_crossing
from viscorough.viscous.move import BEYOND_CURVE, COMPLETE, INFINITE_FORCE, move_row


def moved(gaps, weights, medium, times, load, *, by_depth, limit=np.inf):
    spectrum = spectrum_of(medium.relaxation, medium.retardation)
    motion = move_row(gaps, weights, limit, spectrum, times, load, by_depth=by_depth)
    assert motion.ended == COMPLETE
    return motion


@pytest.mark.parametrize("slope", [0.0, 1e-89, 1e-30, 1e-3])
def test_touch_is_found_from_a_depth_at_rest(slope):
    """A creep rate that begins near zero makes the first steps towards the touch far too short."""
    rate, growth, value, end = 744.8, 260.2, -0.0371, 0.39

    def overlap(s):
        return value + slope * -np.expm1(-rate * s) / rate + growth * (s + np.expm1(-rate * s) / rate) / rate

    arrays = (np.array([number]) for number in (slope, growth, rate))
    found = first_crossing(end, 1e-15, 0.0, value, 0.0, 0.0, *arrays, np.zeros(INTERVALS))
    assert found == pytest.approx(brentq(overlap, 0, end, xtol=1e-15), rel=1e-12)


def test_spring_that_touches_without_force_does_not_stop_the_motion():
    """The depth follows the relaxing surface within rounding: the spring touches and is released at almost one time."""
    times = np.array(
        [0.0, 2127.6320909092888, 8048.847428328587, 20694.98052786512, 25874.657528482734, 33442.07285975315]
    )
    depth = np.array([0.0, 0.09581596715310134, 0.07627269493200359, 0.0, 0.11227494085039552, 0.04295061188474433])
    medium = Prony(
        0.0,
        [0.7299670681863927, 36.817978611235255, 0.30991467642947634],
        [17.331212032315722, 6150.782168561446, 9.276753072214472],
    )
    spring = np.zeros(1), np.ones(1), medium
    dense = np.unique(np.linspace(times[:-1], times[1:], 30))
    force = moved(*spring, dense, np.interp(dense, times, depth), by_depth=True).force
    at_samples = force[np.searchsorted(dense, times)]
    np.testing.assert_allclose(moved(*spring, times, depth, by_depth=True).force, at_samples, rtol=1e-9, atol=1e-12)
    assert force.max() < 3


def test_force_just_after_a_turn_does_not_depend_on_a_sample_close_to_it():
    """The dashpot pulls as soon as the depth falls, so the spring is released at the turn."""
    spring = np.zeros(1), np.ones(1), KelvinVoigt(1.0, 2.0)
    times, depth = np.array([0.0, 1.0, 1.0 + 2e-12, 2.0]), np.array([0.0, 1.0, 1.0 - 2e-12, 0.0])
    assert moved(*spring, times, depth, by_depth=True).force[1] == 0


def random_motion(number):
    """Return a row of springs, a medium, and a history with holds, rests, and steps if the medium allows them."""
    random = np.random.default_rng([54, number])
    medium = random_medium(random)
    springs = random.integers(2, 12)
    gaps = np.append(0, np.cumsum(random.random(springs - 1) * 10 ** random.uniform(-2, 0)))
    weights = 10 ** random.uniform(-1, 1, springs)
    times = np.cumsum(10 ** random.uniform(-1.5, 0.5, 9))
    by_depth = bool(number % 2)
    rigid = medium.relaxation.viscosity > 0
    if not (by_depth and rigid):
        times = np.repeat(times, 1 + (random.random(times.size) < 0.2))
    shape = random.random(times.size) * random.choice([0, 1, 1, 1], times.size)
    held = np.flatnonzero(random.random(times.size - 1) < 0.3)
    shape[held + 1] = shape[held]
    if by_depth:
        load = shape * (gaps[-1] * random.uniform(0.3, 1.5) + 0.01) - random.choice([0, 0.1]) * (shape > 0)
        load[0] = 0.0 if rigid else load[0]
    else:
        load = shape * weights.sum() * 10 ** random.uniform(-1, 1)
    return gaps, weights, medium, times, load, by_depth


def random_medium(random):
    first, second, third = 10 ** random.uniform(-1, 1, 3)
    kind = random.integers(5)
    if kind == 0:
        return Newtonian(first)
    if kind == 1:
        return Maxwell(first, second)
    if kind == 2:
        return KelvinVoigt(first, second)
    if kind == 3:
        return StandardLinearSolid(first * (1 + second), first, third)
    count = random.integers(2, 6)
    relaxed = random.choice([0.0, first])
    return Prony(relaxed, 10 ** random.uniform(-2, 1, count), 10 ** random.uniform(-3, 3, count))


def refined(times, load, parts):
    """Return the same history with more samples, and the indices of the old samples."""
    shares = np.arange(1, parts + 1) / parts
    new_times, new_load, place = [times[:1]], [load[:1]], [0]
    for k in range(1, times.size):
        share = shares if times[k] > times[k - 1] else np.ones(1)
        new_times.append(np.where(share == 1, times[k], times[k - 1] + share * (times[k] - times[k - 1])))
        new_load.append(np.where(share == 1, load[k], load[k - 1] + share * (load[k] - load[k - 1])))
        place.append(place[-1] + share.size)
    return np.concatenate(new_times), np.concatenate(new_load), np.array(place)


@pytest.mark.parametrize("number", range(10))
def test_steps_in_time_approach_the_exact_motion(number):
    """Steps in time resolve no contact or loss of contact within a step, so the difference shrinks with the steps."""
    gaps, weights, medium, times, load, by_depth = random_motion(number)
    spectrum = medium.relaxation
    same = SpringsAndDashpots(
        spectrum.viscosity, spectrum.relaxed_modulus, tuple(spectrum.moduli), tuple(spectrum.times)
    )
    motion = moved(gaps, weights, medium, times, load, by_depth=by_depth)
    found = []
    for parts in (8, 64):
        fine_times, fine_load, place = refined(times, load, parts)
        depths, forces = small_motion(gaps, weights, same, fine_times, **{"depth" if by_depth else "force": fine_load})
        found.append((forces if by_depth else depths)[place])
    exact = motion.force if by_depth else motion.depth
    # With a dashpot, the steps give the force just before each time.
    compared = np.append(np.diff(times) == 0, True) if by_depth and spectrum.viscosity else slice(None)
    coarse, fine = (np.abs(values - exact)[compared].max() / np.abs(exact).max() for values in found)
    assert fine < 1e-12 or fine < min(2e-3, 0.4 * coarse), (coarse, fine)


@pytest.mark.parametrize("number", range(40))
def test_motion_does_not_depend_on_samples_of_a_linear_history(number):
    *row, times, load, by_depth = random_motion(number)
    motion = moved(*row, times, load, by_depth=by_depth)
    fine_times, fine_load, place = refined(times, load, 7)
    again = moved(*row, fine_times, fine_load, by_depth=by_depth)
    for name in ("depth", "force"):
        values = getattr(motion, name)
        np.testing.assert_allclose(
            getattr(again, name)[place], values, rtol=0, atol=1e-11 * max(np.abs(values).max(), 1e-300), err_msg=name
        )


@pytest.mark.parametrize("number", range(40))
def test_values_at_a_sample_are_the_limits_just_after_it(number):
    """Just after the sample the velocity is also the slope of the depth. A step gives the values before it first."""
    *row, times, load, by_depth = random_motion(number)
    motion = moved(*row, times, load, by_depth=by_depth)
    ramps = np.flatnonzero(np.diff(times) > 0)
    delay = 1e-9 * np.diff(times)[ramps]
    fine_times = np.insert(times, ramps + 1, times[ramps] + delay)
    fine_load = np.insert(load, ramps + 1, load[ramps] + 1e-9 * np.diff(load)[ramps])
    after = ramps + 1 + np.arange(ramps.size)
    again = moved(*row, fine_times, fine_load, by_depth=by_depth)
    for name in ("depth", "force", "velocity") + (() if by_depth else ("deflection",)):
        at, later = getattr(motion, name)[ramps], getattr(again, name)
        np.testing.assert_allclose(at, later[after], rtol=0, atol=1e-4 * np.abs(later).max(), err_msg=name)
    if not by_depth:
        for name in ("in_contact", "largest"):
            np.testing.assert_array_equal(getattr(motion, name)[ramps], getattr(again, name)[after], err_msg=name)
    slope = (again.depth[after] - motion.depth[ramps]) / delay
    np.testing.assert_allclose(motion.velocity[ramps], slope, rtol=0, atol=1e-4 * np.abs(slope).max())


@pytest.mark.parametrize("duration", [1.0, 1e4])
def test_deflections_add_up_to_the_creep_response_in_the_largest_contact(duration):
    """After a long hold a fluid carries the same pressure everywhere, so all springs touch at once in a reload."""
    for number in range(0, 400, 2):
        gaps, weights, medium, times, force, _ = random_motion(number)
        load = Load(duration * times, force=force)
        motion = moved(gaps, weights, medium, load.time, load.values, by_depth=False)
        creep = creep_response(spectrum_of(medium.relaxation, medium.retardation), load)
        largest = motion.largest
        found, expected = motion.deflection[largest], creep[largest]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-10 * creep.max(), err_msg=number)


@pytest.mark.parametrize("number", range(40))
def test_spring_forces_fall_along_the_row_and_add_up(number):
    """The derivative c = −∂φ/∂g ≥ 0 makes all pressures positive."""
    gaps, weights, medium, times, load, by_depth = random_motion(number)
    motion = moved(gaps, weights, medium, times, load, by_depth=by_depth)
    largest = max(motion.force.max() / weights.sum(), motion.pressures.max())
    assert (motion.pressures >= -1e-12 * largest).all()
    assert (np.diff(motion.pressures) <= 1e-12 * largest).all()
    total = weights @ motion.pressures
    assert total == pytest.approx(motion.force[-1], abs=1e-11 * max(motion.force.max(), 1e-300))


def test_released_spring_recovers_by_the_compliance():
    """After a press of duration t₁, a standard linear solid loses contact at once and recovers as J does."""
    medium = StandardLinearSolid(4.0, 1.0, 0.5)
    times = np.array([0.0, 2.0, 2.0, 3.0, 7.0])
    motion = moved(np.zeros(1), np.ones(1), medium, times, np.array([1.0, 1, 0, 0, 0]), by_depth=False)
    creep = medium.creep_compliance
    expected = [creep(0.0), creep(2.0), creep(2.0) - creep(0.0), creep(3.0) - creep(1.0), creep(7.0) - creep(5.0)]
    np.testing.assert_allclose(motion.depth, expected, rtol=1e-13)
    assert motion.velocity[3] == pytest.approx(medium.creep_rate(3.0) - medium.creep_rate(1.0), rel=1e-12)


def test_newtonian_surface_does_not_recover():
    gaps, times = np.linspace(0, 1, 11), np.array([0.0, 1.0, 2.0, 3.0, 4.0])
    depth = np.array([0.0, 0.55, 0.2, 0.55, 0.75])
    motion = moved(gaps, np.ones(11), Newtonian(2.0), times, depth, by_depth=True)
    # The force is taken just after each time. No spring touches before the depth reaches 0.55 again.
    np.testing.assert_allclose(motion.force, [2.0 * 0.55, 0, 0, 2.0 * 6 * 0.2, 2.0 * 8 * 0.2], rtol=1e-12)
    assert motion.in_contact.tolist() == [1, 0, 0, 6, 8]
    assert motion.released_from == 1.0


def test_motion_ends_at_the_last_depth_and_at_infinite_forces():
    gaps, times = np.array([0.0, 0.5]), np.array([0.0, 1.0])
    solid = spectrum_of(*(getattr(SPRINGS_AND_DASHPOTS["solid"], name) for name in ("relaxation", "retardation")))
    motion = move_row(gaps, np.ones(2), 0.8, solid, times, np.array([0.0, 1.0]), by_depth=True)
    assert (motion.ended, motion.until) == (BEYOND_CURVE, pytest.approx(0.8, rel=1e-12))
    assert np.isnan(motion.depth[1])
    dashpot = spectrum_of(*(getattr(SPRINGS_AND_DASHPOTS["newtonian"], name) for name in ("relaxation", "retardation")))
    step = np.array([0.0, 0.0, 1.0])
    motion = move_row(gaps, np.ones(2), np.inf, dashpot, times[[0, 1, 1]], step, by_depth=True)
    assert (motion.ended, motion.until) == (INFINITE_FORCE, 1.0)


@pytest.mark.parametrize("exponent", [0.05, 0.5, 0.95])
def test_power_law_of_springs_and_dashpots(exponent):
    medium, times = Springpot(2.0, exponent), np.geomspace(1e-4, 1e3, 50)
    retardation = power_law_spectrum(2.0, exponent, 1e-5, 1e3)
    relaxation = relaxation_spectrum(retardation)
    creep = retardation.instantaneous_compliance + retardation.fluidity * times
    creep = creep - np.expm1(-times[:, None] / retardation.times) @ retardation.compliances
    np.testing.assert_allclose(creep, medium.creep_compliance(times), rtol=1e-8)  # what a springpot promises
    modulus = np.exp(-times[:, None] / relaxation.times) @ relaxation.moduli
    np.testing.assert_allclose(modulus[5:], medium.relaxation_modulus(times[5:]), rtol=3e-6)
    assert relaxation.instantaneous_modulus * retardation.instantaneous_compliance == pytest.approx(1, rel=1e-12)
