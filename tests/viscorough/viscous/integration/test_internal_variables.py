"""Direct integration with internal variables, against closed forms and the correspondence, which it never uses."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import brentq

from support.contract import refused
from support.media import SPRINGS_AND_DASHPOTS as MEDIA
from viscorough import Indenter, Load, indent, kinetics, march, self_affine_disc
from viscorough.basics.errors import ConvergenceError
from viscorough.media.kinds import KelvinVoigt, Maxwell, Newtonian, Springpot
from viscorough.viscous.integration.internal_variables import integrate_steps

DISC = Indenter(self_affine_disc(0.7, 65, seed=3).heights, 0.01, 0.02)
END = 2.0


@pytest.fixture(scope="module")
def curve():
    """Return a curve whose levels are all contact events, so it is exact in between."""
    return indent(DISC, until_fraction=0.05, tolerance=1e-10)


def stepped(indenter, medium, times, **load):
    """Return the motion by implicit steps under a `force` or at a `depth`, with `contact_count` and `pressure`."""
    motion, pressure = integrate_steps(indenter, medium, Load(times, **load))
    count = np.rint(motion.contact_fraction * indenter.elements).astype(int)
    return SimpleNamespace(**vars(motion), contact_count=count, pressure=pressure)


def largest_force(curve, medium, share=0.8):
    return share * curve.force[-1] / medium.creep_compliance(END)


def test_events_are_for_newtonian_media(curve):
    load = Load([0.0, 1.0], force=[1.0, 1.0])
    allowed = "allowed: a force on a Newtonian medium, or argument method='implicit'"
    for medium in (MEDIA["maxwell"], MEDIA["kelvin-voigt"]):
        with refused(f"method='events', a medium that is not Newtonian; {allowed}"):
            march(DISC, load, medium, method="events")
    with refused(f"method='events', load of a depth; {allowed}"):
        march(DISC, Load([0.0, 1.0], depth=[0.0, 1.0]), 1.0, method="events")
    with pytest.raises(ConvergenceError, match="4 elements touch before time 1"):
        march(DISC, Load([0.0, 1.0], force=curve.force[[-1, -1]]), 1.0, method="events", until_fraction=1e-3)


# ---- steps


@pytest.mark.parametrize("name", MEDIA)
def test_steps_are_of_second_order(curve, name):
    """The error is the largest error of the depth at ten times."""
    medium, errors = MEDIA[name], []

    def smooth_force(number):
        times = np.linspace(0, END, number + 1)
        return times, largest_force(curve, medium, 0.4) * (0.4 + 0.3 * times - 0.05 * times**2)

    times, force = smooth_force(4000)
    exact = kinetics(curve, force, medium, times)
    for number in (10, 20, 40):
        times, force = smooth_force(number)
        result = stepped(DISC, medium, times, force=force)
        assert np.isnan(result.receding_from)
        every = number // 10
        errors.append(abs(result.depth[every::every] / exact.depth[400::400] - 1).max())
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 2, atol=0.25)
    assert errors[-1] < 5e-4


def test_unloading_recedes_and_recovers():
    """A solid is unloaded: fewer elements are in contact, none is under tension, and the surface recovers in time."""
    disc = self_affine_disc(0.7, 17, seed=1)
    medium, curve = MEDIA["solid"], indent(disc, until_fraction=0.4)
    force = 0.5 * curve.force[-1] * 1.5
    times, load = np.array([0, 1.0, 1.05, 1.1, 5, 5, 6, 9]), force * np.array([1, 1, 0.5, 0.1, 0.1, 0, 0, 0])
    result = stepped(disc, medium, times, force=load)
    motion = kinetics(curve, load, medium, times)
    assert motion.receding_from == 1.0
    assert (motion.contact_fraction[-3:] == 0).all()
    fine, _ = Load(times, force=load).with_times(np.union1d(times, np.linspace(0, 9, 271)))
    assert motion.depth[-1] == pytest.approx(stepped(disc, medium, fine.time, force=fine.values).depth[-1], rel=0.05)
    assert result.receding_from == 1.05
    assert result.contact_count[3] < result.contact_count[1]
    assert (result.contact_count[-3:] == 0).all()
    assert 0 < result.depth[-1] < 0.02 * result.depth[1]
    times = np.append(0, np.linspace(1, 20, 30))
    long_after = stepped(disc, medium, times, force=force * np.where(times > 1, 0.1, 1))
    assert long_after.depth[-1] == pytest.approx(curve.at_force(0.1 * force / 1.5)[0], rel=1e-3)
    assert np.nanmin(long_after.pressure) >= 0


# ---- parallel dashpots: without the indenter, the surface stays or recovers

FLAT = Indenter(np.zeros((3, 3)), 1.0)
PUNCH = indent(FLAT).stiffness[-1]


@pytest.mark.parametrize(("medium", "last"), [(Newtonian(1.0), 0.05), (KelvinVoigt(1.0, 1.0), 0.01)])
def test_indenter_above_the_surface_has_no_force(medium, last):
    """The indenter is pressed in, moved out, and set above the surface: e⁻¹ and e⁻² of 0.1 in a Kelvin-Voigt medium."""
    motion = stepped(FLAT, medium, [0, 1, 2, 3], depth=[0, 0.1, 0, last])
    np.testing.assert_array_equal(motion.force[2:], 0)
    np.testing.assert_array_equal(motion.contact_count, [0, 9, 0, 0])
    np.testing.assert_array_equal(motion.pressure, 0)
    assert motion.force[1] == pytest.approx(PUNCH * (0.1 + getattr(medium, "shear_modulus", 0) * 0.1), rel=1e-12)
    assert motion.receding_from == 2


def test_indenter_touches_again_when_it_meets_the_recovering_surface():
    """Kelvin-Voigt, θ = 1: after 0.1 at time 1 the free surface is at 0.1 exp(1 − t); the indenter is at 0.01 t.

    They meet at 2.23; from then on F = k (G u + η u').
    """
    times = np.append([0, 1, 1], np.linspace(1.5, 4, 26))
    depth = np.append([0, 0.1, 0], 0.01 * times[3:])
    motion = stepped(FLAT, KelvinVoigt(1.0, 1.0), times, depth=depth)
    meets = brentq(lambda t: 0.01 * t - 0.1 * np.exp(1 - t), 1, 4)
    after = (times > 1) & (times > meets)
    np.testing.assert_array_equal(motion.contact_count, np.where(after | (np.arange(29) == 1), 9, 0))
    np.testing.assert_allclose(motion.force[after], PUNCH * (0.01 * times[after] + 0.01), rtol=1e-12)
    np.testing.assert_array_equal(motion.force[2:][~after[2:]], 0)


def test_step_of_the_depth_lifts_the_indenter_off_a_dashpot():
    times, depth = [0, 1, 1, 2, 2], np.array([0, 0.1, 0.05, 0.05, 0.08])
    motion = stepped(FLAT, Newtonian(1.0), times, depth=depth)
    np.testing.assert_array_equal(motion.contact_count, [0, 9, 0, 0, 0])
    np.testing.assert_array_equal(motion.force[2:], 0)
    assert motion.receding_from == 1
    with refused("depth steps into the surface at time 2, which takes an infinite force; allowed: ramps"):
        stepped(FLAT, Newtonian(1.0), times, depth=np.append(depth[:-1], 0.11))


# ---- the sphere


# ---- refusals


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"medium": Springpot(1.0, 0.5)}, "Springpot; allowed: media of springs and dashpots"),
        ({"times": [0.0, 2.0, 1.0]}, "each larger than the one before, or given twice"),
        ({"force": [1.0, -1.0, 1.0]}, "force: sample 1 is -1.0; allowed: finite, 0 or more"),
        ({"force": [1.0, 1.0]}, r"force: samples of shape \(2,\); allowed: one per time"),
        ({"depth": [0.0, 0.1, 0.2]}, "one of force and depth"),
        ({"indenter": Indenter(np.zeros(5), 1.0)}, "must be two-dimensional"),
        (
            {"medium": Newtonian(1.0), "force": None, "depth": [0.1, 0.1, 0.1]},
            "time 0, which takes an infinite force",
        ),
    ],
)
def test_invalid_motions_are_refused(arguments, message):
    call = {"indenter": Indenter(np.eye(3), 1.0), "medium": Maxwell(1.0, 1.0), "times": [0.0, 1.0, 2.0]}
    call |= {"force": [1.0, 1.0, 1.0]} | arguments
    with refused(message):
        stepped(call.pop("indenter"), call.pop("medium"), call.pop("times"), **call)
