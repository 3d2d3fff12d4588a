"""Quantities that follow from the maps of a contact: areas, pressures, patches."""

from dataclasses import replace

import numpy as np
import pytest

import viscorough
from support.contract import refused
from viscorough.basics.errors import AccuracyWarning
from viscorough.results.contact_maps import Contact

# The map has three patches, two of which share a corner, and one point outside the indenter.
PRESSURE = np.array([[1, 2, 0, 0, 4], [0, 3, 0, 0, 0], [0, 0, 5, 0, np.nan]])
GAP = np.where(PRESSURE > 0, 0.0, 0.1) + 0 * PRESSURE
NUMBERS = {"depth": 1.0, "force": 90.0, "stiffness": 1.0, "residual": 0.0, "tolerance": 1e-3}
CONTACT = Contact(PRESSURE, GAP, PRESSURE > 0, **NUMBERS, spacing=2.0, row_spacing=3.0)


def test_areas_and_pressures_follow_from_the_maps():
    assert (CONTACT.elements, CONTACT.contact_count) == (14, 5)
    assert CONTACT.contact_fraction == 5 / 14
    assert CONTACT.contact_area == 30.0
    assert CONTACT.mean_pressure == pytest.approx(3.0)
    assert CONTACT.largest_pressure == 5.0
    # There are ten changes between neighbours; the change at the point outside the indenter does not count.
    assert CONTACT.corrected_contact_area == pytest.approx(30 - 60 * (np.pi - 1 + np.log(2)) / 24)


@pytest.mark.parametrize("change", [np.flipud, np.fliplr, np.transpose], ids=lambda change: change.__name__)
def test_a_turned_map_has_the_same_areas(change):
    """Elements outside the indenter lie before and after elements in contact, along rows and columns."""
    pressure = PRESSURE.copy()
    pressure[2, 0], pressure[0, 3], pressure[1, 1] = np.nan, np.nan, 0.0
    area = 30 - 6 - 7 * 6 * (np.pi - 1 + np.log(2)) / 24  # seven changes, none at points outside the indenter
    for pressures in (pressure, change(pressure)):
        maps = {"pressure": pressures, "gap": 0 * pressures, "contact": pressures > 0}
        assert replace(CONTACT, **maps).corrected_contact_area == pytest.approx(area)


def test_patches_are_connected_by_sides_and_the_largest_comes_first():
    labels, areas = CONTACT.patches()
    np.testing.assert_array_equal(areas, [18.0, 6.0, 6.0])
    np.testing.assert_array_equal(labels, [[1, 1, 0, 0, 2], [0, 1, 0, 0, 0], [0, 0, 3, 0, 0]])


def test_forces_in_newtons_on_a_modulus():
    """A map in nm under 10 uN on G = 0.5 MPa: F/G is 2e-11 m2 or 2e7 nm2; the integral of p in Pa over m2 is F."""
    indenter = viscorough.Indenter(-np.add.outer(np.arange(9.0), np.arange(9.0)), 5e3, length_unit="nm")
    with pytest.warns(AccuracyWarning, match="contact is complete"):
        contact = viscorough.contact_at(indenter, force="10 uN", shear_modulus="0.5 MPa")
    with pytest.warns(AccuracyWarning, match="contact is complete"):
        plain = viscorough.contact_at(indenter, force=2e7)
    assert contact.force == pytest.approx(2e7, rel=1e-12)
    assert contact.normal_force == pytest.approx(1e-5, rel=1e-12)
    assert contact.normal_stiffness == pytest.approx(contact.stiffness * 1e-9 * 0.5e6, rel=1e-12)
    assert np.nansum(contact.pressure) * 0.5e6 * 5e-6**2 == pytest.approx(1e-5, rel=1e-6)
    last = str(contact).splitlines()[-1]
    assert last.startswith("force F 1e-05 N, mean p ")
    assert f"largest p {0.5 * contact.largest_pressure:.4g} MPa, stiffness k {contact.normal_stiffness:.4g} N/m" in last
    assert (plain.normal_force, plain.normal_stiffness) == (None, None)
    assert viscorough.contact_at(indenter, depth="20 nm").depth == 20
    curve = viscorough.indent(indenter, forces=["5 uN", "10 uN"], shear_modulus=0.5e6)
    np.testing.assert_allclose(curve.force, [1e7, 2e7], rtol=1e-12)
    with refused("force 10 uN: a force needs .* a plain number is F/G"):
        viscorough.contact_at(indenter, force="10 uN")
    with refused("shear_modulus: must be positive and finite, not -1.0"):
        viscorough.contact_at(indenter, force=1, shear_modulus=-1)
    with refused("shear_modulus and young_modulus exclude each other; one of them is allowed"):
        viscorough.contact_at(indenter, force=1, shear_modulus=1, young_modulus=1)
    with refused("poisson is for use with young_modulus"):
        viscorough.indent(indenter, forces=[1], shear_modulus=1, poisson=0.3)
    with refused("poisson: must be above -1 and at most 0.5, not -1.0"):
        viscorough.indent(indenter, forces=[1], young_modulus=1, poisson=-1)
