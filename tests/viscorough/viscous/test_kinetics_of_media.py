"""Kinetics in viscoelastic media, of a sphere whose loading curve is exact."""

import numpy as np
import pytest
from scipy.integrate import quad

from support.curves import curve_of_body
from support.media import MEDIA
from viscorough import reference
from viscorough.viscous.correspondence import impulses, kinetics
from viscorough.viscous.media import Newtonian

RADIUS, FORCE = 1.7, 0.03


@pytest.fixture(scope="module")
def curve():
    return curve_of_body(reference.sphere(RADIUS), np.geomspace(1e-6, 10, 71))


def depth_of_sphere(creep):
    """Lee and Radok: u^(3/2) = 3Φ/(16√R)."""
    return (3 * creep / (16 * np.sqrt(RADIUS))) ** (2 / 3)


@pytest.mark.parametrize("name", MEDIA)
def test_constant_force(curve, name):
    """Given as one number, and as samples."""
    medium, times = MEDIA[name], np.geomspace(1e-3, 90, 40)
    result = kinetics(curve, FORCE, medium, times)
    depth = depth_of_sphere(FORCE * medium.creep_compliance(times))
    np.testing.assert_allclose(result.depth, depth, rtol=1e-11)
    velocity = FORCE * medium.creep_rate(times) / (8 * np.sqrt(RADIUS * depth))
    np.testing.assert_allclose(result.velocity, velocity, rtol=1e-10)
    sampled = kinetics(curve, np.full(41, FORCE), medium, np.append(0, times))
    np.testing.assert_allclose(sampled.depth[1:], depth, rtol=1e-11)
    np.testing.assert_allclose(sampled.velocity[1:-1], velocity[:-1], rtol=1e-9)


@pytest.mark.parametrize("name", MEDIA)
def test_history_with_a_step_at_other_times(curve, name):
    """A ramp, a step and a hold; output times that are no samples, the time of the step among them."""
    medium = MEDIA[name]
    history = impulses([0.0, 0.02, 0.03, 0.03], [0.0, 2.0, 2.0, 8.0])
    times = np.array([0.5, 1.7, 2.0, 3.0, 8.0])
    result = kinetics(curve, history, medium, times)
    if name == "table":
        creep = 0.01 * medium.creep_integral(np.maximum(times - 2, 0), times)
    else:
        creep = [0.01 * quad(medium.creep_compliance, max(t - 2, 0), t, epsrel=1e-10)[0] for t in times]
    creep += np.where(times >= 2, 0.01 * medium.creep_compliance(np.maximum(times - 2, 0)), 0)
    np.testing.assert_array_equal(result.time, times)
    np.testing.assert_allclose(result.depth, depth_of_sphere(creep), rtol=1e-7)
    whole = kinetics(curve, history, medium)
    assert whole.time.tolist() == [0, 2, 2, 8]
    assert whole.depth[2] == pytest.approx(result.depth[2], rel=1e-14)
    assert whole.depth[1] <= whole.depth[2]
    assert whole.depth[0] == whole.velocity[0] == 0


@pytest.mark.parametrize("name", MEDIA)
def test_default_times_are_those_of_the_levels(curve, name):
    medium = MEDIA[name]
    result = kinetics(curve, FORCE, medium)
    reached = FORCE * medium.creep_compliance(result.time)
    depths = result.depth[result.time > 0]
    assert np.isin(depths, curve.depth).all()
    assert (np.diff(result.time) > 0).all()
    np.testing.assert_allclose(result.depth, depth_of_sphere(reached), rtol=1e-11)
    again = kinetics(curve, FORCE, medium, result.time)
    np.testing.assert_allclose(again.velocity, result.velocity, rtol=1e-6)
    at_once = medium.creep_compliance(0.0) > 0
    assert (result.time[0] == 0) == at_once
    if name == "solid":  # it stops at F/G∞, before the last levels
        limit = depth_of_sphere(FORCE / 1.5)
        assert result.depth[-1] == curve.depth[curve.depth < limit][-1]


def test_newtonian_is_what_a_viscosity_is(curve):
    times, force = np.linspace(0, 5, 20), np.linspace(0, 1, 20)
    by_name = kinetics(curve, force, Newtonian(30.0), times)
    for other in (kinetics(curve, force, 30.0, times), kinetics(curve, force, times=times, viscosity=30.0)):
        assert (other.depth == by_name.depth).all()
        assert (other.velocity == by_name.velocity).all()
    assert (kinetics(curve, 2.0, Newtonian(30.0)).time == curve.force * 30.0 / 2.0).all()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"viscosity": 3.0}, "one of medium and viscosity is needed"),
        ({"medium": "maxwell"}, "viscosity: maxwell; allowed"),
        ({"force": 1e9}, "at time 0 the creep ∫J dF is 2.5e+08, beyond the curve's last level"),
        ({"force": [0.01, 0.02, 1e9]}, "at time 2 the creep"),
        ({"force": [0.03, 0.01, 0.01]}, "from time 0.468839 on"),
        ({"force": [1, 1, 1], "times": [1.0, 1.0, 1.0]}, "or given twice where the force steps"),
        ({"force": 1e-9, "times": None}, "has no level between F/G 2.5e-10, at once, and 6.66667e-10, in the end"),
        ({"force": impulses([0.01, 0.02], [0.0, 1.0])}, "within those of the force history, 0 to 1"),
    ],
)
def test_refusals(curve, arguments, message):
    call = {"force": FORCE, "medium": MEDIA["solid"], "times": [0.0, 1.0, 2.0]} | arguments
    with pytest.raises(ValueError, match=r"^[^\n]+$") as refusal:
        kinetics(curve, **call)
    assert message in str(refusal.value)


def test_a_table_is_not_extrapolated(curve):
    for call in ({"force": FORCE, "times": [101.0]}, {"force": [0.01, 0.01], "times": [0.0, 101.0]}):
        with pytest.raises(ValueError, match="allowed: up to the last time of the table, 100"):
            kinetics(curve, medium=MEDIA["table"], **call)
