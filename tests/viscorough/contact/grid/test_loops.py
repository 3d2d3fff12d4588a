"""Loops over fields and contact sets of more than one block."""

from types import SimpleNamespace

import numpy as np
import pytest

from viscorough import SolverOptions, contact_at, indent, self_affine_disc
from viscorough.contact.border import BORDER
from viscorough.contact.grid import iteration, kernels, loops
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.parallel import BLOCK, run_blocks


@pytest.mark.parametrize("share", [0.02, 0.6])
@pytest.mark.parametrize("columns", [1, 60])
@pytest.mark.parametrize("further_columns", [-2 * BORDER, 16])  # of the load array, which may have no border
def test_places_of_a_set_wherever_rows_and_blocks_end(columns, share, further_columns):
    width, stride = columns + 2 * BORDER, columns + 2 * BORDER + further_columns
    rows = 2 * BLOCK // width + 5
    inside = np.pad(np.random.default_rng(2).random((rows, columns)) < share, BORDER).ravel()
    places, slots = GridLoops(3).contact_places(inside, width, stride)
    expected = np.flatnonzero(inside)
    np.testing.assert_array_equal(places, expected)
    np.testing.assert_array_equal(slots, (expected // width - BORDER) * stride + expected % width - BORDER)


def test_indices_beyond_32_bits_are_64_bits_wide():
    inside = np.zeros(20 * 5, dtype=bool)
    inside[[42, 77]] = True
    places, slots = GridLoops(3).contact_places(inside, 5, 2**32 // 20 + 1)
    np.testing.assert_array_equal(places, [42, 77])
    np.testing.assert_array_equal(slots, [6 * (2**32 // 20 + 1), 13 * (2**32 // 20 + 1)])


def test_sums_over_elements_that_join():
    random, share = np.random.default_rng(2), np.array([0.2, 0.7])
    change, initial_gap, tangent_gap = random.standard_normal((3, 1000))
    places, (pressure, tangent) = random.permutation(1000)[:600], abs(random.standard_normal((2, 600)))
    slope, gap = np.minimum(tangent_gap, -1e-30)[places], np.maximum(change + initial_gap, 0)[places]
    touch = np.clip(np.maximum(-gap / slope / 0.4, 1 - pressure / tangent / 0.4), 0, 1)
    assert np.mean((touch > 0) & (touch < 1)) > 0.05
    expected = [slope @ slope, slope**2 @ (1 - touch), *(slope**2 @ np.maximum(s - touch, 0) for s in share)]
    sums = np.zeros(4)
    kernels.touch_sums(change, initial_gap, tangent_gap, 0.4, share, sums, places, pressure, tangent)
    np.testing.assert_allclose(sums, expected, rtol=1e-9)


def test_new_places_and_the_lowest_value_are_found_in_every_block():
    inside, other = np.random.default_rng(3).random((2, 2 * BLOCK)) < 0.5
    place = np.arange(2 * BLOCK)
    before = SimpleNamespace(
        place=place[: BLOCK + 5], inside=other, initial_gap=None
    )  # when fewer elements were ranked
    after = SimpleNamespace(place=place, inside=inside, initial_gap=place)
    places, places_before = GridLoops(3).new_places(after, before)
    np.testing.assert_array_equal(places, np.flatnonzero(inside & ~(other & (place < BLOCK + 5))))
    np.testing.assert_array_equal(places_before, np.where(places < BLOCK + 5, places, 0))
    for lowest_at in (0, -1):
        assert GridLoops(3).lowest(-1.0 * (place == place[lowest_at])) == -1


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
def test_contacts_do_not_depend_on_the_division_into_blocks(tolerance, monkeypatch):
    """Boxes become larger from depth to depth; bands of rows share the loads of elements that leave."""
    disc, options = self_affine_disc(0.5, 65, seed=1), SolverOptions(dense_contacts=0, dense_interactions=0)
    given = {"depth": [0.2, 0.5, 1.0, 2.0], "tolerance": tolerance, "options": options}
    expected, expected_curve = contact_at(disc, **given), indent(disc, tolerance=tolerance)
    for module in (iteration, loops):
        monkeypatch.setattr(module, "BLOCK", 64)
    monkeypatch.setattr(GridLoops, "over", lambda self, array, function: run_blocks(function, array.size, 3, 64))
    contacts, curve = contact_at(disc, threads=3, **given), indent(disc, tolerance=tolerance, threads=3)
    for contact, alone in zip(contacts, contact_at(disc, **given), strict=True):  # on one thread
        np.testing.assert_array_equal(contact.pressure, alone.pressure)
        np.testing.assert_array_equal(contact.gap, alone.gap)
    for contact, whole in zip(contacts, expected, strict=True):
        assert contact.force == pytest.approx(whole.force, rel=0.1 * tolerance)
        np.testing.assert_allclose(contact.gap, whole.gap, rtol=0, atol=2 * tolerance * contact.depth)
        assert np.nanmin(contact.pressure) >= 0
    force = expected_curve.force[expected_curve.force <= curve.force[-1]]
    depth = expected_curve.depth[: force.size]
    np.testing.assert_allclose(curve.at_force(force)[0], depth, rtol=2 * max(tolerance, 1e-5))
