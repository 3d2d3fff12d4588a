"""Levels placed automatically, by hand and naively."""

import pytest

from viscorough_study.performance import level_placement


@pytest.fixture(scope="module")
def scenes():
    return level_placement.scenes(17, 0.7, 1)


def test_scenes_are_answered_to_their_accuracy(scenes):
    for scene in scenes:
        table = level_placement.compare(*scene, 1, hand_picked=(6, 32, 128), naive=(8,))
        assert list(table.columns) == list(level_placement.COLUMNS)
        automatic = table[table["choice"] == "automatic"]
        assert automatic["reached"].item() == 1
        assert automatic["ratio"].item() == 1
        assert (table[table["choice"] == "best by hand"]["error"] <= scene[2]).all()
        assert table["choice"].tolist()[-1] == "naive"


def test_levels_by_hand_are_the_fewest_that_reach_the_accuracy(scenes):
    tried = (2, 4, 8, 16, 32, 64, 128)
    table = level_placement.compare(*scenes[2], 1, hand_picked=tried, naive=(8,))
    number = table.set_index("choice").loc["best by hand", "levels"]
    fewer = [smaller for smaller in tried if smaller < number]
    assert fewer
    table = level_placement.compare(*scenes[2], 1, hand_picked=fewer, naive=(8,))
    assert "best by hand" not in table["choice"].tolist()
