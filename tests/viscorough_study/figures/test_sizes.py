"""Figure of the exponents on grids from coarse to fine."""

import pytest

from support.figures import sizes_table
from support.study import SHOWN
from viscorough_study.figures.sizes import plot_sizes


def shown(axes):
    markers = [line for line in axes.lines if line.get_marker() not in ("None", "", "_", "|")]
    return sorted(line.get_ydata()[0] for line in markers)


def test_a_marker_for_every_ensemble_with_a_fit():
    """In the window of region (b) of discs and lines, and in the fixed one."""
    table = sizes_table()
    figure = plot_sizes(table, SHOWN)
    moving = [0.3, 0.3, 0.31, 0.31]
    expected = [[0.01, *moving], moving, [0.35] * 6, [0.35] * 6]
    assert [shown(axes) for axes in figure.axes] == expected
    assert "4 to 8 discs" in figure.axes[0].get_title()
    assert "$X$ = 0.01 to 0.1" in figure.axes[3].get_title()
    assert len(plot_sizes(table[table["window_rule"] == "default"], SHOWN).axes) == 2
    with pytest.raises(ValueError, match="plot_sizes: the table has no rows"):
        plot_sizes(table[:0], SHOWN)
