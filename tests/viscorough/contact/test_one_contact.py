"""Maps of one contact, against the deflection by a dense sum, and against the loading curve."""

import numpy as np
import pytest

from viscorough.contact.influence import influence_coefficient
from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.contact.options import SolverOptions
from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_disc

DISC = self_affine_disc(0.7, 33, seed=4)
GRID = SolverOptions(dense_contacts=0, dense_interactions=0)


def deflection(contact):
    """Displacement of the surface at every element by a dense sum over the pressures, w = d/(4πG) Σ K p."""
    row, column = np.nonzero(~np.isnan(contact.pressure))
    influence = influence_coefficient(np.subtract.outer(row, row) * 1.0, np.subtract.outer(column, column) * 1.0)
    result = np.full(contact.pressure.shape, np.nan)
    result[row, column] = influence @ contact.pressure[row, column] * contact.spacing / (4 * np.pi)
    return result


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-8])
@pytest.mark.parametrize("given", [{"depth": 0.5}, {"depth": 2.5}, {"force": 0.05}, {"force": 4.0}, {"force": 60.0}])
@pytest.mark.parametrize("options", [SolverOptions(), GRID], ids=["default", "grid"])
def test_maps_solve_the_contact_problem(given, tolerance, options):
    contact = contact_at(DISC, tolerance=tolerance, options=options, **given)
    inside = np.isfinite(DISC.heights)
    np.testing.assert_array_equal(np.isfinite(contact.pressure), inside)
    np.testing.assert_array_equal(np.isfinite(contact.gap), inside)
    np.testing.assert_array_equal(contact.contact, contact.pressure > 0)
    assert (contact.pressure[inside] >= 0).all()
    assert contact.residual <= tolerance
    allowed = (contact.residual + 1e-12) * contact.depth
    assert np.abs(contact.gap[contact.contact]).max() <= allowed
    assert np.nanmin(contact.gap) >= -allowed
    recomputed = deflection(contact) - contact.depth + DISC.initial_gap
    rounding = 1e-6 * contact.depth + 1e-7 * np.nanmax(contact.gap) if tolerance > 1e-4 else 1e-12
    np.testing.assert_allclose(recomputed, contact.gap, atol=rounding)
    assert np.nansum(contact.pressure) * DISC.spacing**2 == pytest.approx(contact.force, rel=1e-7)
    (name, value), *_ = given.items()
    assert getattr(contact, name) == value


def test_a_contact_is_a_level_of_the_curve():
    curve = indent(DISC, depths=[0.3, 1.2], tolerance=1e-6)
    contacts = contact_at(DISC, depth=[0.3, 1.2], tolerance=1e-6)
    for level, contact in enumerate(contacts):
        assert contact.force == pytest.approx(curve.force[level], rel=1e-9)
        assert contact.stiffness == pytest.approx(curve.stiffness[level], rel=1e-6)
        assert contact.contact_fraction == curve.contact_fraction[level]
    by_force = contact_at(DISC, force=curve.force, tolerance=1e-6)
    np.testing.assert_allclose([contact.depth for contact in by_force], curve.depth, rtol=1e-8)


def test_one_value_gives_one_contact_and_several_a_list():
    one, (first, second) = contact_at(DISC, force=1.0), contact_at(DISC, force=[1.0, 2.0])
    assert one.depth == pytest.approx(first.depth, rel=1e-6)
    assert second.force == 2.0
    assert isinstance(contact_at(DISC, force=[1.0]), list)


def test_unit_of_length_and_spacing_are_those_of_the_indenter():
    contact = contact_at(Indenter(DISC.heights, DISC.spacing, length_unit="um"), depth=1.0)
    assert (contact.length_unit, contact.spacing, contact.row_spacing) == ("um", DISC.spacing, DISC.spacing)


@pytest.mark.parametrize("options", [SolverOptions(), GRID], ids=["default", "grid"])
def test_maps_on_rectangular_elements(options):
    """The deflection of rectangles dx × dy, and the force as pressures times their area."""
    indenter = Indenter(DISC.heights, (0.2, 0.1))
    contact = contact_at(indenter, force=0.5, options=options)
    row, column = np.nonzero(np.isfinite(indenter.heights))
    distances = (np.subtract.outer(place, place) * 1.0 for place in (row, column))
    influence = influence_coefficient(*distances, indenter.aspect)
    surface = influence @ contact.pressure[row, column] * indenter.element_side / (4 * np.pi)
    recomputed = surface - contact.depth + indenter.initial_gap[row, column]
    assert np.abs(recomputed[contact.contact[row, column]]).max() <= (contact.residual + 1e-12) * contact.depth
    assert recomputed.min() >= -(contact.residual + 1e-12) * contact.depth
    assert np.nansum(contact.pressure) * 0.2 * 0.1 == pytest.approx(0.5, rel=1e-7)
    assert contact.contact_area == pytest.approx(contact.contact_count * 0.02)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "either depth or force must be given"),
        ({"depth": 1.0, "force": 1.0}, "either depth or force must be given"),
        ({"depth": 0.0}, "depth: allowed is one row of finite numbers above 0"),
        ({"force": -1.0}, "force: allowed is one row of finite numbers above 0"),
        ({"force": np.nan}, "force: allowed is one row of finite numbers"),
        ({"force": [2.0, 1.0]}, "force: allowed is one row of finite numbers above 0"),
        ({"depth": []}, "depth: allowed is one row"),
        ({"depth": 1.0, "tolerance": 1.0}, "tolerance must be between"),
    ],
)
def test_invalid_arguments_are_refused(arguments, message):
    with pytest.raises(ValueError, match=f"contact_at: {message}"):
        contact_at(DISC, **arguments)


def test_a_line_is_refused():
    with pytest.raises(ValueError, match="contact_at: the indenter's heights must be two-dimensional"):
        contact_at(Indenter(np.zeros(5), 1.0), depth=1.0)


def test_progress_grows_to_one():
    disc = self_affine_disc(0.7, 65, seed=1)
    seen = []
    contact_at(disc, force=[0.5, 1.0], progress=seen.append)
    assert len(seen) > 4
    assert (np.diff(seen) >= 0).all()
    assert seen[-1] == 1
    assert 0.5 in seen
