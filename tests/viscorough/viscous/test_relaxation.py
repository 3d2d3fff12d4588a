"""The force under a given depth, of a sphere against closed forms."""

import numpy as np
import pytest
from scipy.integrate import quad

from viscorough import reference
from viscorough.loading_curve import LoadingCurve
from viscorough.viscous.media import CreepTable, KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid
from viscorough.viscous.relaxation import force_under_depth

SPHERE = reference.sphere(1.7)
MEDIA = {
    "newtonian": Newtonian(3.0),
    "maxwell": Maxwell(2.0, 5.0),
    "kelvin-voigt": KelvinVoigt(2.0, 5.0),
    "solid": StandardLinearSolid(4.0, 1.5, 0.3),
    "prony": Prony(0.5, [10.0, 1.0, 3.0], [0.01, 1.0, 50.0]),
    "springpot": Springpot(2.0, 0.4),
}


@pytest.fixture(scope="module")
def curve():
    depth, count = np.geomspace(1e-6, 1, 601), 10 * np.arange(1, 602)
    levels = depth, SPHERE.force(depth), SPHERE.stiffness(depth), count
    return LoadingCurve(*levels, 10**6, "by hand", 1e-9, 0, np.zeros(depth.size))


@pytest.mark.parametrize("name", ["maxwell", "solid", "prony", "springpot"])
def test_a_step_relaxes_with_the_modulus(curve, name):
    times = np.array([1.0, 1.1, 2.0, 30.0])
    result = force_under_depth(curve, np.full(4, 0.3), MEDIA[name], times)
    np.testing.assert_allclose(result.force, SPHERE.force(0.3) * MEDIA[name].relaxation_modulus(times - 1), rtol=1e-9)


@pytest.mark.parametrize("name", MEDIA)
def test_a_ramp_and_its_hold(curve, name):
    """F = ∫ψ(t − s) f'(u(s)) u' ds over the ramp, by quadrature; plus η k u' of a dashpot while it moves."""
    medium, speed, end = MEDIA[name], 0.2, 1.5
    times = np.array([0, 0.7, 1.2, 1.5, 1.5, 2.0, 9.0])
    depth = speed * np.minimum(times, end)
    result = force_under_depth(curve, depth, medium, times)
    for k in (1, 2, 5, 6):
        moved = min(times[k], end)
        weight = {"weight": "alg", "wvar": (0, -0.4)} if name == "springpot" and times[k] < end else {}
        regular = times[k] ** 0 if not weight else None

        def integrand(s, time=times[k], regular=regular):
            modulus = medium.relaxation_modulus(time - s) if regular else medium.relaxation_modulus(1.0)
            return modulus * speed * SPHERE.stiffness(speed * s)

        expected = quad(integrand, 0, moved, **weight)[0]
        if name in ("newtonian", "kelvin-voigt") and times[k] < end:
            expected += medium.viscosity * speed * SPHERE.stiffness(speed * times[k])
        assert result.force[k] == pytest.approx(expected, rel=3e-4, abs=1e-12)


def test_newtonian_force_is_that_of_the_moving_punch(curve):
    times = np.linspace(0, 2, 9)
    result = force_under_depth(curve, 0.3 * times, 3.0, times)
    np.testing.assert_allclose(result.force[1:], 3 * 0.3 * SPHERE.stiffness(0.3 * times[1:]), rtol=1e-9)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"medium": CreepTable([0, 1], [0, 1])}, "CreepTable; allowed: media whose relaxation is known"),
        ({"medium": Newtonian(1.0)}, "steps at time 0, which takes an infinite force"),
        ({"medium": KelvinVoigt(1.0, 1.0), "depth": [0, 0, 0.1]}, "steps at time 1, which takes an infinite force"),
        ({"depth": [0.1, 0.2, 0.1]}, "sample 2 is 0.1; allowed: depths that do not decrease"),
        ({"depth": [0.1, np.nan, 0.1]}, "sample 1 is nan"),
        ({"depth": [-0.1, 0.1, 0.1]}, "sample 0 is -0.1"),
        ({"depth": [0.1, 0.2]}, r"one per time, shape \(3,\)"),
        ({"depth": [0.1, 0.2, 2.0]}, "depth: 2 is beyond the curve's last level; allowed: up to 1"),
        ({"times": [0.0, 1.0, 0.5]}, "or given twice where the depth steps"),
        ({"times": [1.0, 1.0, 1.0]}, "or given twice where the depth steps"),
        ({"times": [0.0, 1.0, np.inf]}, "finite"),
    ],
)
def test_refusals(curve, arguments, message):
    call = {"depth": [0.1, 0.2, 0.3], "medium": MEDIA["solid"], "times": [0.0, 1.0, 1.0]} | arguments
    with pytest.raises(ValueError, match=rf"^[^\n]*{message}[^\n]*$"):
        force_under_depth(curve, **call)
