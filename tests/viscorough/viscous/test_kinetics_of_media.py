"""Kinetics in viscoelastic media, of a sphere whose loading curve is exact."""

import numpy as np
import pytest
from scipy.integrate import quad

from viscorough import reference
from viscorough.loading_curve import LoadingCurve
from viscorough.viscous.correspondence import impulses, kinetics
from viscorough.viscous.media import CreepTable, KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid

RADIUS, FORCE = 1.7, 0.03
TABLE_TIMES = np.append(0, np.geomspace(0.01, 100, 40))
MEDIA = {
    "maxwell": Maxwell(2.0, 5.0),
    "kelvin-voigt": KelvinVoigt(2.0, 5.0),
    "solid": StandardLinearSolid(4.0, 1.5, 0.3),
    "prony": Prony(0.5, [10.0, 1.0, 3.0], [0.01, 1.0, 50.0]),
    "springpot": Springpot(2.0, 0.4),
    "table": CreepTable(TABLE_TIMES, 0.2 + TABLE_TIMES**0.3),
}


@pytest.fixture(scope="module")
def curve():
    """Levels over seven decades of depth; ten elements join at each, so that at_force interpolates smoothly."""
    body, depth, count = reference.sphere(RADIUS), np.geomspace(1e-6, 10, 71), 10 * np.arange(1, 72)
    levels = depth, body.force(depth), body.stiffness(depth), count
    return LoadingCurve(*levels, 10**6, "by hand", 1e-9, 0, np.zeros(depth.size))


def depth_of_sphere(creep):
    """Lee and Radok: u^(3/2) = 3Φ/(16√R)."""
    return (3 * creep / (16 * np.sqrt(RADIUS))) ** (2 / 3)


@pytest.mark.parametrize("name", MEDIA)
def test_constant_force(curve, name):
    medium, times = MEDIA[name], np.geomspace(1e-3, 90, 40)
    result = kinetics(curve, FORCE, medium, times)
    depth = depth_of_sphere(FORCE * medium.creep_compliance(times))
    np.testing.assert_allclose(result.depth, depth, rtol=1e-11)
    velocity = FORCE * medium.creep_rate(times) / (8 * np.sqrt(RADIUS * depth))
    np.testing.assert_allclose(result.velocity, velocity, rtol=1e-10)


@pytest.mark.parametrize("name", MEDIA)
def test_samples_of_a_constant_force_are_the_constant_force(curve, name):
    times = np.append(0, np.geomspace(1e-2, 90, 30))
    constant = kinetics(curve, FORCE, MEDIA[name], times)
    sampled = kinetics(curve, np.full(times.size, FORCE), MEDIA[name], times)
    np.testing.assert_allclose(sampled.depth, constant.depth, rtol=1e-11)
    before_last = slice(1, -1)  # the last velocity is that before the last time, which at a kink of a table differs
    np.testing.assert_allclose(sampled.velocity[before_last], constant.velocity[before_last], rtol=1e-10)


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


def test_a_prony_series_of_a_million_seconds_becomes_a_newtonian_medium(curve):
    """Long after its relaxation times a liquid flows at the fluidity 1/Σ G_i τ_i."""
    medium = Prony(0.0, [1e4, 1.0], [1e-4, 1e-3])
    times = np.array([1.0, 10.0, 30.0])
    flow = kinetics(curve, FORCE, 1.0 + 1e-3, times)
    np.testing.assert_allclose(kinetics(curve, FORCE, medium, times).depth, flow.depth, rtol=2e-3)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"medium": None}, "one of medium and viscosity is needed"),
        ({"viscosity": 3.0}, "one of medium and viscosity is needed"),
        ({"medium": "maxwell"}, "viscosity: maxwell; allowed"),
        ({"force": 0.0}, "constant force: 0.0"),
        ({"force": 1e9}, "at time 0 the creep ∫J dF is 2.5e+08, beyond the curve's last level"),
        ({"force": [0.01, 0.02, 1e9]}, "at time 2 the creep"),
        ({"force": [0.01, -0.02, 0.01]}, "sample 1 is -0.02"),
        ({"force": [0.03, 0.01, 0.01]}, "from time 0.468839 on"),
        ({"times": [0.0, 1.0, 1.0]}, "each larger than the one before"),
        ({"force": [1, 1, 1], "times": [1.0, 1.0, 1.0]}, "or given twice where the force steps"),
        ({"force": [1, 1, 1], "times": [1.0, 2.0, 1.0]}, "or given twice where the force steps"),
        ({"force": [1, 1, 1], "times": ["0", "1", "2"]}, "finite numbers"),
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
