"""Maps of one contact, against the deflection by a dense sum, and against the loading curve."""

import numpy as np
import pytest

from support.influence import influence_matrix
from viscorough import Indenter, SolverOptions, contact_at, indent, self_affine_disc
from viscorough.contact.halfspace.influence import influence_coefficient
from viscorough.viscous.integration.events import newtonian_events

DISC = self_affine_disc(0.7, 33, seed=4)
GRID = SolverOptions(dense_contacts=0, dense_interactions=0)
INDENTERS = {"squares": DISC, "rectangles": Indenter(DISC.heights, (0.2, 0.1))}
# Maps of few rows or columns with many elements, which the grid solver treats differently from squares.
STRIPS = {(1, 170): 1.0, (2, 85): 1.0, (3, 57): (1.0, 4.0), (9, 38): 1.0, (170, 1): 1.0, (57, 3): (4.0, 1.0)}
INDENTERS |= {f"strip {shape}": Indenter(np.random.default_rng(1).random(shape), d) for shape, d in STRIPS.items()}


def deflection(indenter, pressure):
    """Return the displacement of the surface at every element by a dense sum over the pressures, w = d/(4πG) Σ K p."""
    place = np.nonzero(np.isfinite(indenter.heights))
    result = np.full(pressure.shape, np.nan)
    result[place] = influence_matrix(*place, indenter.aspect) @ pressure[place] * indenter.element_side / (4 * np.pi)
    return result


@pytest.mark.parametrize("indenter", INDENTERS.values(), ids=INDENTERS)
@pytest.mark.parametrize("tolerance", [1e-2, 1e-8])
@pytest.mark.parametrize("given", [{"depth": 0.5}, {"force": 0.05}, {"force": 4.0}])
@pytest.mark.parametrize("options", [SolverOptions(), GRID], ids=["default", "grid"])
def test_maps_solve_the_contact_problem(indenter, given, tolerance, options):
    contact = contact_at(indenter, tolerance=tolerance, options=options, **given)
    inside = np.isfinite(indenter.heights)
    np.testing.assert_array_equal(np.isfinite(contact.pressure), inside)
    np.testing.assert_array_equal(np.isfinite(contact.gap), inside)
    np.testing.assert_array_equal(contact.contact, contact.pressure > 0)
    assert (contact.pressure[inside] >= 0).all()
    assert contact.residual <= tolerance
    allowed = (contact.residual + 1e-12) * contact.depth
    assert np.abs(contact.gap[contact.contact]).max() <= allowed
    assert np.nanmin(contact.gap) >= -allowed
    recomputed = deflection(indenter, contact.pressure) - contact.depth + indenter.initial_gap
    rounding = 1e-6 * contact.depth + 1e-7 * np.nanmax(contact.gap) if tolerance > 1e-4 else 1e-12
    np.testing.assert_allclose(recomputed, contact.gap, atol=rounding)
    area = indenter.spacing * indenter.row_spacing
    assert np.nansum(contact.pressure) * area == pytest.approx(contact.force, rel=1e-7)
    assert contact.contact_area == pytest.approx(contact.contact_count * area)
    (name, value), *_ = given.items()
    assert getattr(contact, name) == value


def test_long_strip_meets_complementarity():
    """The curve starts with contact events; its last contacts are so large that all of the preconditioner is used."""
    strip = Indenter(np.random.default_rng(1).random((1, 6000)), 1.0)
    curve = indent(strip, until_fraction=0.5)
    assert curve.contact_fraction[-1] >= 0.5
    contact = contact_at(strip, depth=curve.depth[-1], tolerance=1e-6, options=GRID)
    influence = influence_coefficient(0.0, np.arange(-5999.0, 6000)) / (4 * np.pi)
    gap = np.convolve(contact.pressure[0], influence)[5999:11999] - contact.depth + strip.initial_gap[0]
    assert max(abs(gap[contact.contact[0]]).max(), -gap.min()) <= contact.residual * contact.depth
    assert contact.residual <= 1e-6
    assert curve.force[-1] == pytest.approx(contact.force, rel=1e-5)
    assert curve.stiffness[-1] == pytest.approx(contact.stiffness, rel=1e-3)


def test_contact_equals_a_level_of_the_curve():
    curve = indent(DISC, depths=[0.3, 1.2], tolerance=1e-6)
    contacts = contact_at(DISC, depth=[0.3, 1.2], tolerance=1e-6)
    for level, contact in enumerate(contacts):
        assert contact.force == pytest.approx(curve.force[level], rel=1e-9)
        assert contact.stiffness == pytest.approx(curve.stiffness[level], rel=1e-6)
        assert contact.contact_fraction == curve.contact_fraction[level]
    by_force = contact_at(DISC, force=curve.force, tolerance=1e-6)
    np.testing.assert_allclose([contact.depth for contact in by_force], curve.depth, rtol=1e-8)


def test_one_value_gives_one_contact_in_the_unit_of_the_indenter_and_several_a_list():
    disc = Indenter(DISC.heights, DISC.spacing, length_unit="m")
    single, several = contact_at(disc, force=0.01), contact_at(disc, force=[0.01])
    assert isinstance(several, list)
    assert single.depth == several[0].depth
    assert (single.length_unit, single.spacing, single.row_spacing) == ("m", DISC.spacing, DISC.spacing)


def test_invalid_arguments_are_refused():
    for arguments, message in (
        ({"depth": 1.0, "force": 1.0}, "contact_at: either depth or force must be given"),
        ({"force": [2.0, 1.0]}, "argument force: allowed is one row of finite numbers above 0, each larger"),
        ({"depth": []}, "argument depth: allowed is one row"),
        ({"depth": 1.0, "tolerance": 1.0}, "argument tolerance must be between"),
        (
            {"indenter": Indenter(np.zeros(5), 1.0), "depth": 1.0},
            "contact_at: the indenter's heights must be two-dim",
        ),
    ):
        with pytest.raises(ValueError, match=message):
            contact_at(**({"indenter": DISC} | arguments))


@pytest.mark.filterwarnings("ignore:overflow")
def test_force_that_overflows_is_refused():
    huge = Indenter(np.array([[0.0, -1e307], [-1e306, -1e307]]), 1e10)
    with pytest.raises(ValueError, match="too large to represent"):
        contact_at(huge, depth=1e306)


@pytest.mark.parametrize("seed", range(5))
def test_no_element_is_under_tension_at_forces_of_contact_events(seed):
    """An element that touches at exactly this force has no pressure, but for rounding of either sign."""
    indenter = Indenter(np.random.default_rng(seed).random((5, 6)), 1.0, 1.7)
    forces = newtonian_events(indenter).impulse[1:]
    for force in (forces * (1 + np.finfo(float).eps * np.arange(-2, 3)[:, None])).ravel():
        contact = contact_at(indenter, force=force, tolerance=1e-8)
        assert contact.pressure.min() >= 0
        np.testing.assert_allclose(contact.pressure.sum() * 1.7, force, rtol=2e-12)
