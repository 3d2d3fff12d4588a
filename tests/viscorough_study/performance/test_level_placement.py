"""Levels placed automatically, by hand and naively."""

import pytest

from viscorough_study.performance import level_placement

ACCURACIES = (1e-1, 1e-2)


@pytest.fixture(scope="module")
def scenes():
    return level_placement.scenes(17, 0.7, 1)


def test_scenes_are_answered_to_every_accuracy(scenes):
    for scene in scenes:
        table = level_placement.compare(*scene, 1, accuracies=ACCURACIES, numbers=(6, 32, 128))
        assert list(table.columns) == list(level_placement.COLUMNS)
        assert table["accuracy"].tolist() == [accuracy for accuracy in ACCURACIES for _ in range(3)]
        assert (table[table["choice"] == "automatic"]["reached"] == 1).all()
        assert ((table["error"] <= table["accuracy"]) == table["reached"]).all()
        assert (table["processor_s"] > 0).all()


def test_levels_by_hand_are_the_fewest_that_reach_the_accuracy(scenes):
    tried, at = (2, 4, 8, 16, 32, 64, 128), {"accuracies": (1e-3,)}
    table = level_placement.compare(*scenes[2], 1, numbers=tried, **at).set_index("choice")
    assert table.loc["best by hand", "reached"] == 1
    fewer = [number for number in tried if number < table.loc["best by hand", "levels"]]
    assert fewer
    table = level_placement.compare(*scenes[2], 1, numbers=fewer, **at).set_index("choice")
    assert table.loc["best by hand", "reached"] == 0
