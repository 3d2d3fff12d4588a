"""Figure of speed against accuracy."""

import numpy as np
import pandas as pd
import pytest

from support.figures import coordinates, legend_texts, methods_table
from viscorough_study.figures.speed import FLOOR, plot_speed
from viscorough_study.performance.pareto import pareto_front


def test_speed_shows_every_method_and_the_front_on_one_grid_of_each_indenter():
    data = methods_table()
    figure = plot_speed(data)
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == [
        "sphere, 257 elements across",
        "rough disc, H = 0.4, 257 elements across",
        "rough disc, H = 0.4, region (b) alone",
    ]
    rough = data[(data["elements"] == 257) & (data["problem"] != "sphere")]
    lines = coordinates(figure.axes[1])
    np.testing.assert_allclose(lines[1], [[0.01, 1e-2], [0.02, FLOOR]])  # an error of zero stands on the floor
    front = pareto_front(rough.assign(error=np.maximum(rough["error"], FLOOR)))
    np.testing.assert_allclose(lines[-1], front[["wall_s", "error"]])
    np.testing.assert_allclose(coordinates(figure.axes[2])[1][0], [0.01, 5e-3])
    texts = legend_texts(figure.legends[0])
    assert "other solvers are not installed" in texts
    assert "   MDR" in texts


def test_speed_shows_other_solvers_hollow():
    data = methods_table()
    peer = data[data["method"] == "MDR"].assign(method="ASPHER", group="other solver")
    figure = plot_speed(pd.concat([data, peer]))
    texts = legend_texts(figure.legends[0])
    assert "   ASPHER" in texts
    assert "other solvers are not installed" not in texts
    assert any(line.get_markerfacecolor() == "none" and line.get_linestyle() == "--" for line in figure.axes[1].lines)


def test_empty_table_is_refused():
    with pytest.raises(ValueError, match="plot_speed: the table has no rows"):
        plot_speed(methods_table().iloc[:0])
