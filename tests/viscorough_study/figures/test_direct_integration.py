"""Figure of direct integration against both readings of the law."""

import pytest

from support.figures import coordinates, dashed, direct_table, whole_on_page
from viscorough_study.figures.direct_integration import plot_direct_integration


def test_every_indenter_has_a_panel_with_its_ratios_and_the_line_of_the_law():
    table = direct_table()
    figure = plot_direct_integration(table)
    assert [axes.get_title() for axes in figure.axes] == ["sphere", "rough disc, $H=0.4$"]
    for axes in figure.axes:
        assert [[10, 1], [100, 1]] in [line.tolist() for line in coordinates(axes)]
        assert [line.get_ydata()[0] for line in dashed(axes)] == [1.1]
        assert [text.get_text() for text in axes.texts] == ["1.100", "largest deviation 0"]
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_direct_integration: the table has no rows"):
        plot_direct_integration(table[:0])


def test_the_largest_deviation_is_written():
    table = direct_table().assign(depth_ratio=[1.0, 0.9995, 1.0, 1 + 2e-7])
    texts = [axes.texts[1].get_text() for axes in plot_direct_integration(table).axes]
    assert texts == ["largest deviation $5\\times 10^{-4}$", "largest deviation $2\\times 10^{-7}$"]
