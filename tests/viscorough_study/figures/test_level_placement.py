"""Figure of the levels chosen for a scene."""

import pytest

from support.figures import level_placement_table, whole_on_page
from viscorough_study.figures.level_placement import plot_level_placement


def test_bars_are_times_with_their_errors_beside_them_and_hatched_where_these_exceed_the_accuracy():
    figure = plot_level_placement(level_placement_table())
    (axes,) = figure.axes
    assert [bar.get_width() for bar in axes.patches] == [1.0, 0.8, 20.0]
    assert [bool(bar.get_hatch()) for bar in axes.patches] == [False, False, True]
    assert [text.get_text() for text in axes.texts] == [
        "50 ms, 40 levels, error $10^{-4}$",
        "40 ms, 16 levels, error $9\\times 10^{-4}$",
        "1000 ms, 512 levels, error 0.002",
    ]
    assert [text.get_text() for text in axes.get_yticklabels()] == ["full curve\nerror up to 0.001"]
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_level_placement: the table has no rows"):
        plot_level_placement(level_placement_table()[:0])
