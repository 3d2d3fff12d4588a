"""Levels placed automatically, by hand and naively."""

import numpy as np
import pytest

from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import level_placement


@pytest.fixture(scope="module")
def scenes():
    return level_placement.scenes(33, 0.7, 1)


def test_scenes_are_answered_to_their_accuracy(scenes):
    for scene in scenes:
        table = level_placement.compare(scene, 1, hand_picked=(6, 32, 128), naive=(8, 16))
        assert list(table.columns) == list(level_placement.COLUMNS)
        automatic = table[table["choice"] == "automatic"]
        assert automatic["reached"].item() == 1
        assert automatic["ratio"].item() == 1
        assert (table[table["choice"] == "best by hand"]["error"] <= scene.accuracy).all()
        assert table["choice"].tolist()[-1] == "naive"


def test_levels_by_hand_are_the_fewest_that_reach_the_accuracy(scenes):
    table = level_placement.compare(scenes[3], 1, hand_picked=(2, 3, 4, 6, 8, 16, 32), naive=(8,))
    number = table.set_index("choice").loc["best by hand", "levels"]
    fewer = [each for each in (2, 3, 4, 6, 8, 16) if each < number]
    assert fewer
    assert "best by hand" not in level_placement.compare(scenes[3], 1, hand_picked=fewer, naive=(8,))["choice"].tolist()


def test_a_curve_from_a_start_is_as_good_from_there_on():
    disc = self_affine_disc(0.7, 65, seed=1)
    whole, later = (indent(disc, tolerance=1e-3, start_fraction=start, until_fraction=0.5) for start in (0.0, 0.1))
    assert later.depth.size < whole.depth.size / 2
    force = np.geomspace(*np.interp([0.1, 0.5], whole.contact_fraction, whole.force), 50)[:-1]
    np.testing.assert_allclose(later.at_force(force)[0], whole.at_force(force)[0], rtol=2e-3)
    # Where many elements touch at once there is no level close to the start.
    assert (
        indent(
            level_placement.scenes(17, 0.7, 1)[0].indenter, start_fraction=0.01, until_fraction=0.5
        ).contact_fraction[-1]
        >= 0.5
    )
    with pytest.raises(ValueError, match=r"start_fraction must be from 0 to below until_fraction, not 0\.9"):
        indent(disc, start_fraction=0.9, until_fraction=0.5)
