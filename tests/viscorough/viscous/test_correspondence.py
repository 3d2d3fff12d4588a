"""Kinetics from exact loading curves, against solutions that do not use the correspondence."""

import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from support.curves import curve_of_body, curve_of_levels
from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough.viscous.correspondence import kinetics

RADIUS, SLOPE, VISCOSITY = 1.7, 0.4, 30.0
DEPTHS = np.geomspace(1e-5, 10, 61)


@pytest.fixture
def sphere_curve():
    return curve_of_body(reference.sphere(RADIUS), DEPTHS)


def exact_sphere_depth(impulse):
    """Lee and Radok with the impulse in place of Ft."""
    return (3 * impulse / (16 * VISCOSITY * np.sqrt(RADIUS))) ** (2 / 3)


@pytest.mark.parametrize(
    ("body", "penetration", "shape"),
    [
        (reference.sphere, reference.sphere_penetration, RADIUS),
        (reference.cone, reference.cone_penetration, SLOPE),
    ],
)
def test_constant_force_follows_lee_and_radok(body, penetration, shape):
    curve = curve_of_body(body(shape), DEPTHS)
    force = 2.5
    for times in (None, np.geomspace(1e-3, 100, 40)):
        result = kinetics(curve, force, VISCOSITY, times)
        depth, velocity = penetration(result.time, shape, force, VISCOSITY)
        np.testing.assert_allclose(result.depth, depth, rtol=1e-12)
        np.testing.assert_allclose(result.velocity, velocity, rtol=1e-11)


def test_pulses_and_rests(sphere_curve):
    """Three triangular pulses separated by rests, during which nothing moves."""
    times = np.arange(13.0)
    force = np.array([0, 3, 0, 0, 0, 1, 0, 0, 0, 5, 0, 0, 0.0])
    result = kinetics(sphere_curve, force, VISCOSITY, times)
    impulse = np.array([0, 1.5, 3, 3, 3, 3.5, 4, 4, 4, 6.5, 9, 9, 9])
    np.testing.assert_allclose(result.depth, exact_sphere_depth(impulse), rtol=1e-12, atol=0)
    assert (result.velocity[force == 0] == 0).all()
    assert (result.velocity[force > 0] > 0).all()
    for rest in ([2, 3, 4], [6, 7, 8], [10, 11, 12]):
        assert np.ptp(result.depth[rest]) == 0


def test_step_of_force(sphere_curve):
    """The force doubles within one rounding of the time: the depth is continuous, the velocity doubles."""
    before = 2.0
    after = np.nextafter(before, 3)
    result = kinetics(sphere_curve, [1, 1, 2, 2], VISCOSITY, [0, before, after, 5])
    np.testing.assert_allclose(result.depth, exact_sphere_depth(np.array([0, 2, 2, 8])), rtol=1e-12, atol=0)
    assert result.velocity[2] == pytest.approx(2 * result.velocity[1], rel=1e-12)


def test_varying_force_against_time_integration(sphere_curve):
    """du/dt = F(t)/(8η√(Ru)), a flat punch of the present contact radius, integrated in time without the impulse."""
    times = np.linspace(0, 6, 25)
    force = np.random.default_rng(3).uniform(0, 4, times.size)
    result = kinetics(sphere_curve, force, VISCOSITY, times)

    def velocity(t, u):
        return np.interp(t, times, force) / (8 * VISCOSITY * np.sqrt(RADIUS * u))

    depth = result.depth[1]
    for i in range(1, times.size - 1):  # kinks of the force only between the integrations
        depth = solve_ivp(velocity, times[i : i + 2], [depth], rtol=1e-11, atol=0, method="DOP853").y[0, -1]
        assert depth == pytest.approx(result.depth[i + 1], rel=1e-9)
        assert velocity(times[i + 1], depth) == pytest.approx(result.velocity[i + 1], rel=1e-9)


@pytest.mark.parametrize(("length", "clock"), [(1e-12, 1e12), (1e12, 1e-12)])
def test_invariance_under_change_of_units(length, clock, sphere_curve):
    """The same motion in other units of length, time and viscosity, from which that of the force follows."""
    viscosity_unit = 1e-12
    times = np.linspace(0, 4, 9)
    force = np.array([0, 1, 2, 0, 0, 3, 1, 1, 0.5])
    expected = kinetics(sphere_curve, force, VISCOSITY, times)
    curve = curve_of_body(reference.sphere(RADIUS * length), DEPTHS * length)
    result = kinetics(curve, force * viscosity_unit * length**2 / clock, VISCOSITY * viscosity_unit, times * clock)
    np.testing.assert_allclose(result.time, times * clock, rtol=1e-15)
    np.testing.assert_allclose(result.depth, expected.depth * length, rtol=1e-12)
    np.testing.assert_allclose(result.velocity, expected.velocity * length / clock, rtol=1e-11)


def test_times_of_the_levels_reproduce_the_levels(sphere_curve):
    """Rounding of F·t/η, up or down, moves no level beyond the ends of the curve."""
    for force in np.random.default_rng(5).uniform(0.1, 10, 50):
        levels = kinetics(sphere_curve, force, VISCOSITY)
        again = kinetics(sphere_curve, force, VISCOSITY, levels.time)
        np.testing.assert_allclose(again.depth, levels.depth, rtol=1e-13)
        np.testing.assert_allclose(again.velocity, levels.velocity, rtol=1e-12)


def test_sum_of_many_samples_reaches_the_last_level(sphere_curve):
    for force in (1 / 3, 0.7, 1e9):
        times = np.linspace(0, VISCOSITY * sphere_curve.force[-1] / force, 100_001)
        result = kinetics(sphere_curve, np.full(times.size, force), VISCOSITY, times)
        assert result.depth[-1] == pytest.approx(sphere_curve.depth[-1], rel=1e-9)


def test_before_the_first_level(sphere_curve):
    """At zero force the depth is zero. Between there and the first level the curve of a round body is undetermined, and
    of one element is a straight line.
    """
    times = np.array([0, 1e-12, 1])
    result = kinetics(sphere_curve, 1.0, VISCOSITY, times)
    np.testing.assert_array_equal(np.isnan(result.depth), [False, True, False])
    np.testing.assert_array_equal(np.isnan(result.velocity), [True, True, False])
    rested = kinetics(sphere_curve, [0, 0, 1], VISCOSITY, times)
    np.testing.assert_array_equal(rested.depth[:2], 0)
    np.testing.assert_array_equal(rested.velocity[:2], 0)

    one = curve_of_levels([0.5], [1.0], [2.0], [1])
    result = kinetics(one, 4.0, 10.0, [0, 0.1, 2.5])
    np.testing.assert_allclose(result.depth, [0, 0.02, 0.5], rtol=1e-14)
    np.testing.assert_allclose(result.velocity, 0.2, rtol=1e-14)


@pytest.mark.parametrize(
    ("arguments", "allowed"),
    [
        ({"viscosity": 0.0}, "viscosity: 0.0; allowed: a finite number above 0"),
        ({"viscosity": [1.0]}, "a finite number"),
        ({"force": 0.0}, "constant force: 0.0; allowed: a finite number above 0"),
        ({"force": [1.0, 2.0], "times": None}, "needs the time of each sample"),
        ({"force": [1.0, 2.0]}, "one per time"),
        ({"force": [1.0, -1e-9, 2.0]}, "sample 1 is -1e-09; allowed: finite, 0 or more"),
        ({"times": [0.0, 2.0, 1.0]}, "each larger than the one before"),
        ({"times": [[0.0, 1.0]]}, "one row"),
        ({"times": [-1.0, 1.0]}, "start at -1; allowed: from 0 on"),
        ({"times": [0.0, 1e9]}, "allowed: up to"),
        ({"force": [0.0, 1e9, 0.0]}, "allowed: up to"),
    ],
)
def test_refusals(arguments, allowed, sphere_curve):
    call = {"force": 1.0, "viscosity": VISCOSITY, "times": [0.0, 1.0, 2.0]} | arguments
    with pytest.raises(ValueError, match=r"^[^\n]+$") as refusal:
        kinetics(sphere_curve, **call)
    assert allowed in str(refusal.value)


def test_the_remedy_of_a_short_curve_is_one():
    """What the message asks for gives a curve on which the same motion is found."""
    disc = self_affine_disc(0.7, 17, seed=1)
    curve = indent(disc, until_fraction=0.1)
    with pytest.raises(ValueError, match=r"beyond the curve's last level; .*; indent further, with") as error:
        kinetics(curve, 3.0, 2.0, [1.0, 40.0])
    force = float(re.search(r"level at F/G = (\S+) \(forces\)", str(error.value))[1])
    longer = indent(disc, forces=[*curve.force, force])
    assert np.isfinite(kinetics(longer, 3.0, 2.0, [40.0]).depth).all()
