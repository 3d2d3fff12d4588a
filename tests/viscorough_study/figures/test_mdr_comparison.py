"""Figure of the comparison of lines with discs, surface by surface."""

import numpy as np
import pytest

from support.figures import coordinates, legend_texts, mdr_table
from viscorough_study.figures.mdr_comparison import plot_mdr_comparison


def test_ratios_and_correlations_have_a_panel_each():
    table = mdr_table()
    figure = plot_mdr_comparison(table)
    for axes, name in zip(figure.axes, ("stiffness_ratio", "area_ratio", "correlation"), strict=True):
        for hurst, line in zip((0.4, 0.9), coordinates(axes), strict=False):
            np.testing.assert_array_equal(line, table.loc[table["hurst"] == hurst, ["x", name]])
    assert legend_texts(figure.legends[0]) == ["$H=0.4$", "$H=0.9$"]
    with pytest.raises(ValueError, match="plot_mdr_comparison: the table has no rows"):
        plot_mdr_comparison(table[:0])
