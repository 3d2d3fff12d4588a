"""Quantities that follow from the maps of a contact: areas, pressures, patches."""

import numpy as np
import pytest

from viscorough.contact_maps import Contact

# Three patches if sides connect, two if corners do, too; one point lies outside the indenter.
PRESSURE = np.array([[1, 2, 0, 0, 4], [0, 3, 0, 0, 0], [0, 0, 5, 0, np.nan]])


def contact():
    gap = np.where(PRESSURE > 0, 0.0, 0.1) + 0 * PRESSURE
    force = np.nansum(PRESSURE) * 2.0 * 3.0
    numbers = {"depth": 1.0, "force": force, "stiffness": 1.0, "residual": 0.0, "tolerance": 1e-3}
    return Contact(PRESSURE, gap, PRESSURE > 0, **numbers, spacing=2.0, row_spacing=3.0)


def test_areas_and_pressures():
    result = contact()
    assert (result.elements, result.contact_count) == (14, 5)
    assert result.contact_fraction == 5 / 14
    assert result.contact_area == 30.0
    assert result.mean_pressure == pytest.approx(3.0)
    assert result.largest_pressure == 5.0


def test_patches_are_connected_by_sides_or_corners_and_the_largest_comes_first():
    labels, areas = contact().patches()
    np.testing.assert_array_equal(areas, [18.0, 6.0, 6.0])
    np.testing.assert_array_equal(labels, [[1, 1, 0, 0, 2], [0, 1, 0, 0, 0], [0, 0, 3, 0, 0]])
    labels, areas = contact().patches(connectivity=8)
    np.testing.assert_array_equal(areas, [24.0, 6.0])
    assert labels[2, 2] == 1
    with pytest.raises(ValueError, match="patches: connectivity must be 4 or 8, not 6"):
        contact().patches(6)
