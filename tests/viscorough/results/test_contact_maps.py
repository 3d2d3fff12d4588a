"""Quantities that follow from the maps of a contact: areas, pressures, patches."""

from dataclasses import replace

import numpy as np
import pytest

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
