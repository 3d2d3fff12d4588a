"""Figure of the comparison with other solvers."""

import numpy as np
import pytest

from support.figures import coordinates, other_solvers_table
from viscorough_study.figures.other_solvers import plot_other_solvers


def test_every_ratio_is_drawn_and_two_threads_are_hollow():
    figure = plot_other_solvers(other_solvers_table())
    lines = coordinates(figure.axes[0])
    assert sorted(line[0, 0] for line in lines if len(line) == 1) == [1.0, 1.0, 2.5, 3.5]
    ranges = sorted(tuple(line[:, 0]) for line in lines if len(line) == 2)
    np.testing.assert_allclose(ranges, [(0.9 * ratio, 1.1 * ratio) for ratio in (1.0, 1.0, 2.5, 3.5)])
    hollow = [line for line in figure.axes[0].lines if line.get_markerfacecolor() == "none"]
    assert [line.get_xdata()[0] for line in hollow] == [2.5]
    with pytest.raises(ValueError, match="plot_other_solvers: the table has no rows"):
        plot_other_solvers(other_solvers_table()[:0])
