"""The exact solutions against integrals for any profile or punch, the laws against Eq. 1."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.integrate import quad
from scipy.special import gamma as gamma_function

from viscorough import reference

PAPER = Path(__file__).parents[2] / "resources" / "paper"
BODIES = [(0.7, 1), (0.3, 1.5), (0.4, 2), (0.2, 3)]  # coefficient, exponent


@pytest.mark.parametrize(("coefficient", "exponent"), BODIES)
def test_power_law_body_follows_sneddon(coefficient, exponent):
    """For any profile z(r), u = a ∫₀ᵃ z'(r)/√(a² − r²) dr and F/G = 8 ∫₀ᵃ r² z'(r)/√(a² − r²) dr, with r = a sin t."""
    body, depth = reference.PowerLawBody(coefficient, exponent), 0.35
    radius = body.contact_radius(depth)

    def slope(t):
        return coefficient * exponent * (radius * np.sin(t)) ** (exponent - 1)

    assert depth == pytest.approx(radius * quad(slope, 0, np.pi / 2)[0], rel=1e-9)
    moment = quad(lambda t: (radius * np.sin(t)) ** 2 * slope(t), 0, np.pi / 2)[0]
    assert body.force(depth) == pytest.approx(8 * moment, rel=1e-9)


@pytest.mark.parametrize(("coefficient", "exponent"), BODIES)
def test_power_law_body_is_consistent(coefficient, exponent):
    body = reference.PowerLawBody(coefficient, exponent)
    depth = np.geomspace(1e-6, 1e3, 10)
    slope = (1 + 1 / exponent) * body.force(depth) / depth  # a power law
    np.testing.assert_allclose(body.stiffness(depth), slope, rtol=1e-13)
    np.testing.assert_allclose(body.depth(body.force(depth)), depth, rtol=1e-13)
    np.testing.assert_allclose(body.mdr_profile(body.contact_radius(depth)), depth, rtol=1e-13)

    indenter, line = body.indenter(4, width=2.0), body.mdr_line(4, width=2.0)
    assert indenter.spacing == line.spacing == 0.5
    centres = np.array([-0.75, -0.25, 0.25, 0.75])
    distance = np.hypot(centres, centres[:, None])
    np.testing.assert_allclose(indenter.heights, -coefficient * distance**exponent, rtol=1e-14)
    np.testing.assert_allclose(line.heights, -body.mdr_profile(centres), rtol=1e-14)


def test_sphere_follows_hertz_and_cone_follows_love():
    depth, radius, slope = np.geomspace(1e-3, 10, 5), 2.5, 0.3
    sphere, cone = reference.sphere(radius), reference.cone(slope)
    np.testing.assert_allclose(sphere.force(depth), 16 / 3 * np.sqrt(radius) * depth**1.5, rtol=1e-14)
    np.testing.assert_allclose(sphere.contact_radius(depth), np.sqrt(radius * depth), rtol=1e-14)
    np.testing.assert_allclose(cone.force(depth), 8 * depth**2 / (np.pi * slope), rtol=1e-14)
    np.testing.assert_allclose(cone.contact_radius(depth), 2 * depth / (np.pi * slope), rtol=1e-14)


def test_depth_of_flat_ellipse_follows_from_its_pressure():
    """The depth at the centre is u = (1/4πG)∫p/r dA in polar coordinates, p = F/(2πab)·(1−x²/a²−y²/b²)^(−1/2)."""
    for a, b in [(1.0, 1.0), (3.0, 2.0), (5.0, 0.4)]:
        # The integrand is periodic and smooth, so the rectangle rule is exact to rounding.
        angle = 2 * np.pi * np.arange(400) / 400
        edge = a * b / np.hypot(b * np.cos(angle), a * np.sin(angle))
        depth_per_force = edge.mean() * 2 * np.pi * (np.pi / 2) / (2 * np.pi * a * b) / (4 * np.pi)
        assert reference.flat_ellipse_stiffness(a, b) == pytest.approx(1 / depth_per_force, rel=1e-12)
    assert reference.flat_disc_stiffness(0.5) == pytest.approx(4.0 * reference.COMPLETE_CONTACT_STIFFNESS, rel=1e-15)


@pytest.mark.parametrize("hurst", [0.1, 0.9])
def test_eq_1_with_eq_3_has_no_gamma(hurst):
    """Integrate Eq. 1, with dF/du of Eq. 3 as F/v, and compare the laws without Γ; with Γ they miss by 5 to 13 %.

    With y = u/h and X = Ft/(4ηhL) as time, Eq. 1 is dy/dX = 1/κ with κ of Eq. 3, found by quadrature.
    """
    zeta, alpha = reference.zeta_viscous(hurst), reference.exponent_alpha(hurst)
    x = np.array([1e-5, 1e-4, 1e-3, 1e-2])
    depth = [quad(lambda x: 1 / zeta, 0, end, weight="alg", wvar=(-alpha, 0))[0] for end in x]  # ∫ X^(−α)/ζ dX
    np.testing.assert_allclose(reference.depth_law(x, zeta, alpha), depth, rtol=1e-7)
    np.testing.assert_allclose(reference.velocity_law(x, zeta, alpha), x / (zeta * x**alpha), rtol=1e-14)
    for law in (reference.depth_law, reference.velocity_law):
        excess = law(x, zeta, alpha, gamma=True) / law(x, zeta, alpha)
        np.testing.assert_allclose(excess, 1 / gamma_function(2 - alpha), rtol=1e-14)
        assert (excess > 1.04).all()
        assert (excess < 1.13).all()


LAWS = yaml.safe_load((PAPER / "laws.yaml").read_text(encoding="utf-8"))


def printed(law, **values):
    """Evaluate a law as the paper prints it (resources/paper/laws.yaml) at the given values."""
    return eval(LAWS[law]["formula"], {"pi": np.pi, "gamma": gamma_function, **values})


@pytest.mark.parametrize("name", [name for name, law in LAWS.items() if "function" in law])
def test_functions_agree_with_the_printed_laws(name):
    law = LAWS[name]
    values = {"X": 3e-4, "zeta": 1.3, "alpha": 0.62, "H": 0.7, "q": 5.0, "C2D": 0.2}
    options = {"gamma": True} if law.get("gamma") else {}
    computed = getattr(reference, law["function"])(*(values[name] for name in law["arguments"]), **options)
    assert computed == pytest.approx(printed(name, **values), rel=1e-14)


@pytest.mark.parametrize(
    "build",
    [
        lambda: reference.cone(-0.1),
        lambda: reference.PowerLawBody(1.0, np.nan),
        lambda: reference.flat_ellipse_stiffness(1.0, 2.0),
        lambda: reference.flat_disc_stiffness(0.0),
        lambda: reference.depth_law(0.1, 1.0, 1.0),
    ],
)
def test_impossible_shapes_and_exponents_are_refused(build):
    with pytest.raises(ValueError, match=r"^[^\n]*(?:allowed: |must be a positive number)[^\n]*$"):
        build()


@pytest.mark.parametrize(("x", "zeta"), [(-1.0, 1.0), (1.0, 0.0), (1.0, -1.0), ([1.0, -1.0], 1.0)])
def test_laws_of_negative_numbers_are_refused(x, zeta):
    with pytest.raises(ValueError, match="allowed: x of at least 0, zeta above 0"):
        reference.velocity_law(x, zeta, 0.5)
    for law in (reference.exponent_alpha, reference.exponent_beta, reference.zeta_elastic, reference.zeta_viscous):
        with pytest.raises(ValueError, match="hurst: -1; allowed"):
            law(-1)
        assert np.isnan(law(np.nan))
