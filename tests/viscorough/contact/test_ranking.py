"""Elements ranked step by step, against a ranking of all at once; contacts with few ranked elements."""

from dataclasses import replace

import numpy as np
import pytest

from viscorough import Indenter, SolverOptions, contact_at, indent
from viscorough.contact.halfspace import tiles
from viscorough.contact.ranking import Ranking
from viscorough.surfaces.self_affine import self_affine_square

HEIGHTS = self_affine_square(0.8, 200, seed=4)
ROW, COLUMN = np.mgrid[:200, :200]


def islands():
    """Return a map of few distant bumps above a plate that nothing touches; one bump in a corner, one a spike."""
    heights = np.full((200, 200), -1.0)
    for number, (y, x) in enumerate([(0, 0), (30, 170), (120, 60), (199, 110)]):
        heights = np.maximum(heights, -0.002 * ((ROW - y) ** 2 + (COLUMN - x) ** 2) - 0.01 * number)
    heights[150, 150] = 0.01
    return heights


MAPS = {
    "rough, rectangular elements": (HEIGHTS, (1.0, 1.7)),
    "hole": (np.where(np.hypot(ROW - 90, COLUMN - 110) < 60, np.nan, HEIGHTS), 1.0),
    "islands": (islands(), 1.0),
    "in a corner of a larger map": (np.pad(HEIGHTS[:60, :50], ((0, 90), (70, 0)), constant_values=np.nan), 1.0),
}


@pytest.fixture(params=MAPS)
def indenter(request):
    return Indenter(*MAPS[request.param])


# Solve small maps as maps of millions of elements: few ranked elements, restricted operators, estimated depths.
FEW_RANKED = SolverOptions(
    rank_first=50, rank_all_for_curves=50, blocks_from=1, blocks_in_contact=1, tiles_from=0, tiles_share=1.0
)


@pytest.fixture
def small_tiles(monkeypatch):
    monkeypatch.setattr(tiles, "SIDE", 40)


def test_ranking_step_by_step_equals_ranking_at_once(indenter):
    steps, at_once = Ranking(indenter, options=FEW_RANKED), Ranking(indenter)
    assert steps.elements.initial_gap.size == 0
    steps.rank_highest()
    at_once.rank_up_to(np.inf)
    elements, everything = steps.elements, at_once.elements
    assert 0 < elements.initial_gap.size < everything.initial_gap.size == everything.count == indenter.elements
    assert everything.initial_gap[0] == 0 < elements.initial_gap[-1]
    assert np.all(np.diff(everything.initial_gap) >= 0)
    np.testing.assert_allclose(
        everything.initial_gap * everything.units.length, indenter.initial_gap[everything.places_on_map()], rtol=1e-15
    )
    for depth in (0.01, 0.1, 0.3):
        steps.rank_up_to(depth)
        elements = steps.elements
        ranked = elements.initial_gap.size
        assert elements.next_gap(ranked) >= depth or not elements.unranked
        assert np.count_nonzero(everything.initial_gap <= depth) <= ranked
        for name in ("row", "column", "initial_gap"):
            np.testing.assert_array_equal(getattr(elements, name), getattr(everything, name)[:ranked])


@pytest.mark.parametrize("given", [{"depth": [0.02, 0.3, 1.0]}, {"force": [0.01, 1.0, 30.0]}])
def test_contacts_do_not_depend_on_the_number_of_ranked_elements(indenter, given, small_tiles):
    tolerance = 1e-6
    contacts = contact_at(indenter, tolerance=tolerance, options=FEW_RANKED, **given)
    all_ranked = replace(FEW_RANKED, rank_all_share=0.0, tiles_from=10**6)
    expected_contacts = contact_at(indenter, tolerance=tolerance, options=all_ranked, **given)
    for contact, expected in zip(contacts, expected_contacts, strict=True):
        assert contact.force == pytest.approx(expected.force, rel=tolerance)
        assert contact.depth == pytest.approx(expected.depth, rel=tolerance)
        assert contact.stiffness == pytest.approx(expected.stiffness, rel=1e-4)
        np.testing.assert_allclose(contact.gap, expected.gap, rtol=0, atol=2 * tolerance * contact.depth)
        np.testing.assert_array_equal(np.isnan(contact.pressure), np.isnan(indenter.heights))
        assert np.nanmin(contact.gap) >= -tolerance * contact.depth


def test_curves_do_not_depend_on_the_number_of_ranked_elements(indenter, small_tiles):
    curve = indent(indenter, until_fraction=0.4, options=FEW_RANKED)
    all_ranked = replace(FEW_RANKED, rank_all_for_curves=10**6)
    expected = indent(indenter, until_fraction=0.4, options=all_ranked)
    inside = expected.force <= curve.force[-1]
    depth, _ = curve.at_force(expected.force[inside])
    np.testing.assert_allclose(depth, expected.depth[inside], rtol=2e-3)
