"""Figure of the comparison of lines with discs, surface by surface."""

import numpy as np
import pytest

from support.figures import coordinates, legend_texts, mdr_table, whole_on_page
from viscorough_study.figures.mdr_comparison import plot_mdr_comparison


def test_means_scatter_and_correlations_have_a_panel_each():
    table = mdr_table()
    figure = plot_mdr_comparison(table)
    drawn = table.assign(stiffness_scatter=np.exp(table["stiffness_scatter"]))
    names = ("stiffness_ratio", "stiffness_scatter", "area_ratio", "gap_ratio", "correlation", "force_ratio")
    for axes, name in zip(figure.axes, names, strict=True):
        for hurst, line in zip((0.4, 0.9), coordinates(axes), strict=False):
            np.testing.assert_array_equal(line, drawn.loc[drawn["hurst"] == hurst, ["x", name]])
    (legend,) = figure.legends
    assert legend_texts(legend) == ["$H=0.4$", "$H=0.9$"]
    assert legend.get_title().get_text() == "6 discs and lines for each $H$"
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_mdr_comparison: the table has no rows"):
        plot_mdr_comparison(table[:0])


def test_bands_are_the_intervals_and_the_correlations_by_chance():
    stiffness, _, area, gap, correlation, _ = plot_mdr_comparison(mdr_table()).axes
    for axes, ends in ((stiffness, {0.5, 2.0}), (area, {5.0, 20.0}), (gap, {0.25, 1.0}), (correlation, {-0.5, 0.5})):
        for band in axes.collections:
            assert set(band.get_paths()[0].vertices[:, 1]) == ends
    assert [len(axes.collections) for axes in (stiffness, area, gap, correlation)] == [2, 2, 2, 1]
