"""Figure of direct integration against both readings of the law."""

import pytest

from support.figures import coordinates, dashed, direct_table, legend_texts
from viscorough_study.figures.direct_integration import plot_direct_integration


def test_every_case_has_its_markers_and_the_line_of_the_law():
    table = direct_table()
    figure = plot_direct_integration(table)
    (axes,) = figure.axes
    assert legend_texts(figure.legends[0])[:2] == ["sphere", "rough disc, H = 0.4"]
    assert coordinates(axes)[0].tolist() == [[10, 1], [100, 1]]
    assert [line.get_ydata()[0] for line in dashed(axes)[:2]] == [1.1, 1.1]
    with pytest.raises(ValueError, match="plot_direct_integration: the table has no rows"):
        plot_direct_integration(table[:0])
