"""Figure of the levels chosen for a scene."""

import pytest

from support.figures import level_placement_table
from viscorough_study.figures.level_placement import plot_level_placement


def test_errors_are_over_the_accuracy_and_hollow_where_they_exceed_it():
    figure = plot_level_placement(level_placement_table())
    assert [text.get_text() for text in figure.axes[0].texts] == ["0.1", "0.9", "2"]
    assert [line.get_markerfacecolor() == "none" for line in figure.axes[0].lines[:3]] == [False, False, True]
    with pytest.raises(ValueError, match="plot_level_placement: the table has no rows"):
        plot_level_placement(level_placement_table()[:0])
