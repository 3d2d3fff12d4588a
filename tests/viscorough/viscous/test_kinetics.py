"""Kinetics from exact loading curves, against solutions that do not use the correspondence."""

import dataclasses

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from support.curves import curve_of_body
from support.media import MEDIA
from viscorough import Load, Springpot, indent, kinetics, reference, self_affine_disc

RADIUS, VISCOSITY, FORCE = 1.7, 30.0, 0.03
SPHERE = reference.sphere(RADIUS)
CURVE = curve_of_body(SPHERE, np.geomspace(1e-6, 10, 71))


def depth_of_sphere(creep):
    """Return the depth by Lee and Radok, u^(3/2) = 3Φ/(16√R); Φ = ∫F dt/η in a viscous medium."""
    return (3 * creep / (16 * np.sqrt(RADIUS))) ** (2 / 3)


# ---- a viscous medium


def test_depth_under_a_varying_force_agrees_with_time_integration():
    """The reference integrates du/dt = F(t)/(8η√(Ru)) in time: the velocity of a flat punch of the present radius."""
    times = np.linspace(0, 6, 25)
    force = np.random.default_rng(3).uniform(0, 4, times.size)
    result = kinetics(CURVE, force, VISCOSITY, times)

    def velocity(t, u):
        return np.interp(t, times, force) / (8 * VISCOSITY * np.sqrt(RADIUS * u))

    depth = result.depth[1]
    for i in range(1, times.size - 1):  # the force has kinks only between the integrations
        depth = solve_ivp(velocity, times[i : i + 2], [depth], rtol=1e-11, atol=0, method="DOP853").y[0, -1]
        assert depth == pytest.approx(result.depth[i + 1], rel=1e-9)
        assert velocity(times[i + 1], depth) == pytest.approx(result.velocity[i + 1], rel=1e-9)


def test_times_of_the_levels_reproduce_the_levels():
    """Rounding of F·t/η, up or down, must move no level beyond the ends of the curve."""
    curve = dataclasses.replace(CURVE, tolerance=1e-4)  # fewer springs, since between the levels nothing is compared
    for force in np.random.default_rng(5).uniform(0.1, 10, 50):
        levels = kinetics(curve, force, VISCOSITY, CURVE.force * VISCOSITY / force)
        np.testing.assert_allclose(levels.depth, CURVE.depth, rtol=1e-13)
        np.testing.assert_allclose(levels.velocity, force / (VISCOSITY * CURVE.stiffness), rtol=1e-12)


def test_contact_between_few_levels_is_the_contact_of_the_curve():
    """Between the last two levels the curve is almost straight, so no spring of the row touches there."""
    disc = self_affine_disc(0.7, 17, rms=0.05, seed=1)
    whole = indent(disc, until_fraction=1.0).force[-1]
    curve = indent(disc, forces=whole * np.array([1e-3, 1e-2, 1e-1, 1e3]))
    at_levels = kinetics(curve, 1.0, 1.0, curve.force).contact_fraction
    np.testing.assert_allclose(at_levels, curve.contact_fraction, rtol=1e-13)
    assert at_levels[-1] == 1
    midway = np.mean(curve.depth[-2:])
    by_depth = kinetics(curve, depth=[0.0, midway], medium=1.0, times=[0.0, 1.0]).contact_fraction[-1]
    under_force = kinetics(curve, 1.0, 1.0, [np.interp(midway, curve.depth, curve.force)]).contact_fraction[0]
    assert by_depth == pytest.approx(np.mean(curve.contact_fraction[-2:]), rel=1e-9)
    assert under_force == pytest.approx(by_depth, rel=1e-2)


def test_depth_is_undetermined_before_the_first_level():
    """At zero force the depth is zero. Above it, a curve of a round body is undetermined up to its first level."""
    times = np.array([0, 1e-12, 1])
    result = kinetics(CURVE, 1.0, VISCOSITY, times)
    np.testing.assert_array_equal(np.isnan(result.depth), [False, True, False])
    np.testing.assert_array_equal(np.isnan(result.velocity), [True, True, False])
    rested = kinetics(CURVE, [0, 0, 1], VISCOSITY, times)
    np.testing.assert_array_equal(rested.depth[:2], 0)
    np.testing.assert_array_equal(rested.velocity[:2], 0)


# ---- media


def accuracy(name, otherwise):
    """Return the accuracy of a motion: a springpot is replaced by springs and dashpots with its J to 1e-8."""
    return 1e-7 if name == "springpot" else otherwise


@pytest.mark.parametrize("name", MEDIA)
def test_constant_force_gives_the_creep_of_any_medium(name):
    """The force is given as one number and as samples."""
    medium, times = MEDIA[name], np.geomspace(1e-3, 90, 40)
    result = kinetics(CURVE, FORCE, medium, times)
    depth = depth_of_sphere(FORCE * medium.creep_compliance(times))
    np.testing.assert_allclose(result.depth, depth, rtol=accuracy(name, 1e-11))
    velocity = FORCE * medium.creep_rate(times) / (8 * np.sqrt(RADIUS * depth))
    np.testing.assert_allclose(result.velocity, velocity, rtol=accuracy(name, 1e-10))
    sampled = kinetics(CURVE, np.full(41, FORCE), medium, np.append(0, times))
    np.testing.assert_allclose(sampled.depth[1:], depth, rtol=accuracy(name, 1e-11))
    np.testing.assert_allclose(sampled.velocity[1:-1], velocity[:-1], rtol=accuracy(name, 1e-9))


@pytest.mark.parametrize("name", MEDIA)
def test_history_with_a_step_is_evaluated_at_other_times(name):
    """The force is a ramp, a step and a hold. Output times are no samples, except for the time of the step."""
    medium = MEDIA[name]
    history = Load([0.0, 2.0, 2.0, 8.0], force=[0.0, 0.02, 0.03, 0.03])
    times = np.array([0.5, 1.7, 2.0, 3.0, 8.0])
    result = kinetics(CURVE, history, medium, times)
    options = {"limit": 200, "epsrel": 1e-10}
    creep = [0.01 * quad(medium.creep_compliance, max(t - 2, 0), t, **options)[0] for t in times]
    creep += np.where(times >= 2, 0.01 * medium.creep_compliance(np.maximum(times - 2, 0)), 0)
    np.testing.assert_array_equal(result.time, times)
    np.testing.assert_allclose(result.depth, depth_of_sphere(creep), rtol=1e-7)
    whole = kinetics(CURVE, history, medium)
    assert whole.time.tolist() == [0, 2, 2, 8]
    assert whole.depth[2] == pytest.approx(result.depth[2], rel=1e-14)
    assert whole.depth[1] <= whole.depth[2]
    assert whole.depth[0] == 0


@pytest.mark.parametrize("name", MEDIA)
def test_velocity_at_kinks_and_steps_follows_the_creep(name):
    """dΦ/dt is Σ ΔF J'(t − s) over the steps and Σ ΔF' J(t − s) over the kinks, both before the time t.

    It is taken just after each sample, but just before the step and at the end of the load.
    """
    medium = MEDIA[name]
    load = Load([0.0, 1.0, 2.0, 2.0, 3.0, 4.0], force=[0.0, 0.02, 0.03, 0.04, 0.04, 0.07])
    starts, kinks = np.array([0.0, 1.0, 2.0, 3.0]), np.array([0.02, -0.01, -0.01, 0.03])
    motion, before = kinetics(CURVE, load, medium), np.array([False, True, False, False, True])
    since = load.time[1:, None] - starts
    past = (since > 0) | ((since == 0) & ~before[:, None])
    rate = np.where(past, medium.creep_compliance(np.maximum(since, 0.0)), 0.0) @ kinks
    rate[2:] += 0.01 * medium.creep_rate(load.time[3:] - 2)
    expected = rate / SPHERE.stiffness(motion.depth[1:])
    np.testing.assert_allclose(motion.velocity[1:], expected, rtol=accuracy(name, 1e-9))


@pytest.mark.parametrize("name", MEDIA)
def test_default_times_are_a_hundred_over_the_whole_curve(name):
    medium = MEDIA[name]
    result = kinetics(CURVE, FORCE, medium)
    at_once, times = FORCE * medium.creep_compliance(0.0), result.time[result.time > 0]
    assert (times.size, result.time[0] == 0) == (100, at_once > 0)
    np.testing.assert_allclose(np.diff(np.log(times)), np.log(times[-1] / times[0]) / 99, rtol=1e-9)
    depth = depth_of_sphere(FORCE * medium.creep_compliance(result.time))
    np.testing.assert_allclose(result.depth, depth, rtol=accuracy(name, 1e-11))
    end = FORCE * medium.creep_compliance(1e300)
    assert result.depth[-1] == pytest.approx(min(CURVE.depth[-1], depth_of_sphere(end)), rel=2e-3)


# ---- refusals


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"medium": 0.0}, "medium: 0.0; allowed: a medium as viscorough.Maxwell, or the viscosity of a Newtonian one"),
        ({"force": 0.0}, "constant force: 0.0; allowed: a finite number above 0"),
        (
            {"force": 1e9},
            "at time 0 the load has the depth of F/G = 2.5e+08 in an elastic half-space, beyond the curve's last level",
        ),
        (
            {"force": 1e-9, "times": None},
            "the creep is from F/G 2.5e-10, at once, to 6.66667e-10, in the end",
        ),
        ({"force": [1.0, 2.0], "times": None}, "needs the time of each sample"),
        ({"force": [1.0, -1e-9, 2.0]}, "sample 1 is -1e-09; allowed: finite, 0 or more"),
        ({"force": [0.01, 0.02, 1e9]}, "at time 2 the load has the depth"),
        ({"force": [1, 1, 1], "times": [1.0, 1.0, 1.0]}, "or given twice where the force steps"),
        ({"force": Load([0.0, 1.0], force=[0.01, 0.02])}, "within the history of the force, 0 to 1"),
        ({"times": [0.0, 2.0, 1.0]}, "each larger than the one before"),
        ({"times": [[0.0, 1.0]]}, "one row"),
        ({"times": ["0", "1", "2"]}, "times: an array of <U1; real numbers are needed"),
        ({"times": [-1.0, 1.0]}, "start at -1; allowed: from 0 on"),
        ({"medium": VISCOSITY, "times": [0.0, 1e9]}, "allowed: up to"),
        ({"medium": Springpot(2.0, 0.05), "times": None}, "times: intervals from 1.22856e-126 to"),
    ],
)
def test_invalid_arguments_are_refused(arguments, message):
    call = {"force": FORCE, "medium": MEDIA["solid"], "times": [0.0, 1.0, 2.0]} | arguments
    with pytest.raises(ValueError, match=r"^[^\n]+$") as refusal:
        kinetics(CURVE, **call)
    assert message in str(refusal.value)


def test_summary_states_si_units():
    curve = dataclasses.replace(CURVE, length_unit="m")
    motion = kinetics(curve, FORCE, 1.0, [1e-4, 1e-3])
    lines = str(motion).splitlines()
    assert lines[1] == "time t 0.0001 to 0.001 s"
    assert lines[4].startswith("velocity v ")
    assert lines[4].endswith(" mm s-1")
