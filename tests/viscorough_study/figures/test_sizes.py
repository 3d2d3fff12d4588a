"""Figure of the exponents on grids from coarse to fine."""

import pytest

from support.figures import sizes_table
from support.study import SHOWN
from viscorough_study.figures.sizes import plot_sizes


def test_a_marker_for_every_ensemble_with_a_region():
    table = sizes_table()
    figure = plot_sizes(table, SHOWN)
    for axes, control in zip(figure.axes, ([0.01], []), strict=True):
        markers = [line for line in axes.lines if line.get_marker() not in ("None", "", "_", "|")]
        assert sorted(line.get_ydata()[0] for line in markers) == [*control, 0.3, 0.3, 0.31, 0.31]
    with pytest.raises(ValueError, match="plot_sizes: the table has no rows"):
        plot_sizes(table[:0], SHOWN)
