"""Figures of speed and accuracy from small tables."""

import numpy as np
import pandas as pd
import pytest

from viscorough_study.figures.growth import plot_growth
from viscorough_study.figures.level_placement import plot_level_placement
from viscorough_study.figures.other_solvers import plot_other_solvers
from viscorough_study.figures.speed import FLOOR, plot_speed
from viscorough_study.performance import measurement
from viscorough_study.performance.cost_growth import fit_cost
from viscorough_study.performance.pareto import pareto_front


def table():
    rows = []
    for problem, hurst in (("rough disc, H = 0.4", 0.4), ("sphere", np.nan)):
        for elements in (65, 257, 513):
            for method, group, value, wall, error in (
                ("path, automatic levels", "path", 1e-3, 1e-6 * elements**2.4, 1e-3),
                ("path, at the depths", "path", 1e-1, 0.01, 1e-2),
                ("path, at the depths", "path", 1e-6, 0.02, 0.0),
                ("explicit, uniform steps", "marching", 16, 0.5, 0.5),
                ("MDR", "model", 64, 0.001, 0.3),
            ):
                about = {"problem": problem, "hurst": hurst, "elements": elements, "method": method, "group": group}
                seen = {"value": value, "wall_s": wall, "processor_s": wall, "error": error, "error_b": error / 2}
                rest = {"knob": "", "largest_error": error, "operator_applications": elements, "steps": 1, "memory": 1}
                rows.append(about | seen | rest)
    return pd.DataFrame(rows)[list(measurement.COLUMNS)]


def drawn(axes):
    """Coordinates of all lines of an axes."""
    return [line.get_xydata() for line in axes.lines]


def test_speed_shows_every_method_and_the_front_on_one_grid_of_each_indenter():
    data = table()
    figure = plot_speed(data)
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == [
        "sphere, 257 elements across",
        "rough disc, H = 0.4, 257 elements across",
        "rough disc, H = 0.4, region (b) alone",
    ]
    rough = data[(data["elements"] == 257) & (data["problem"] != "sphere")]
    lines = drawn(figure.axes[1])
    np.testing.assert_allclose(lines[1], [[0.01, 1e-2], [0.02, FLOOR]])  # an error of zero stands on the floor
    front = pareto_front(rough.assign(error=np.maximum(rough["error"], FLOOR)))
    np.testing.assert_allclose(lines[-1], front[["wall_s", "error"]])
    np.testing.assert_allclose(drawn(figure.axes[2])[1][0], [0.01, 5e-3])
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "other solvers are not installed" in texts
    assert "   MDR" in texts


def test_speed_shows_other_solvers_hollow():
    data = table()
    peer = data[data["method"] == "MDR"].assign(method="ASPHER", group="other solver")
    figure = plot_speed(pd.concat([data, peer]))
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "   ASPHER" in texts
    assert "other solvers are not installed" not in texts
    assert any(line.get_markerfacecolor() == "none" and line.get_linestyle() == "--" for line in figure.axes[1].lines)


def test_growth_fits_the_exponent():
    assert fit_cost(np.array([1e3, 1e5]), np.array([1.0, 1e3]))[0] == pytest.approx(1.5)
    data = table()
    late = data[(data["method"] == "path, automatic levels") & (data["elements"] == 257)].assign(
        wall_s=120.0, error=1.0
    )
    figure = plot_growth(pd.concat([data, late]))  # what was not answered in time has no cost
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels[0] == "automatic levels, 1e-3: $N^{1.20}$"
    np.testing.assert_allclose(drawn(figure.axes[1])[0][:, 1], [65, 257, 513])


def test_peers():
    rows = [("eight levels", 0.4, "viscorough", 1, 1.0), ("eight levels", 0.4, "ASPHER", 1, 3.5)]
    rows += [("eight levels", 0.4, "ASPHER", 2, 2.5), ("one level", 0.4, "viscorough", 1, 1.0)]
    figure = plot_other_solvers(pd.DataFrame(rows, columns=["task", "hurst", "solver", "threads", "ratio"]))
    assert sorted(line[0, 0] for line in drawn(figure.axes[0])) == [1.0, 1.0, 2.5, 3.5]
    hollow = [line for line in figure.axes[0].lines if line.get_markerfacecolor() == "none"]
    assert [line.get_xdata()[0] for line in hollow] == [2.5]


def test_scenes():
    rows = [("full curve", "automatic", 1e-3, 1e-4, 1, 1.0), ("full curve", "best by hand", 1e-3, 9e-4, 1, 0.8)]
    rows += [("full curve", "naive", 1e-3, 2e-3, 0, 20.0)]
    figure = plot_level_placement(
        pd.DataFrame(rows, columns=["scene", "choice", "accuracy", "error", "reached", "ratio"])
    )
    assert [text.get_text() for text in figure.axes[0].texts] == ["0.1", "0.9", "2"]
    assert figure.axes[0].lines[2].get_markerfacecolor() == "none"


@pytest.mark.parametrize("plot", [plot_speed, plot_growth, plot_other_solvers, plot_level_placement])
def test_empty_tables_are_refused(plot):
    with pytest.raises(ValueError, match="the table has no rows"):
        plot(table().iloc[:0])
