"""Figure of speed against accuracy of the main methods."""

import numpy as np
import pandas as pd

from support.figures import coordinates, legend_texts, methods_table, whole_on_page
from viscorough_study.figures.speed import FLOOR, RING, plot_speed
from viscorough_study.performance.costs import pareto_front


def test_methods_are_named_at_their_lines_on_a_rough_disc_and_the_sphere():
    figure = plot_speed(methods_table())
    rough, sphere = figure.axes
    assert rough.get_title() == "(a) rough disc, $H=0.4$, 257 elements across"
    assert sphere.get_title() == "(b) sphere, 257 elements across"
    names = {"elastic path,\nautomatic levels", "elastic path,\ngiven levels", "MDR (model)"}
    assert {text.get_text() for text in sphere.texts} == {text.get_text() for text in rough.texts} == names
    assert whole_on_page(figure)


def test_headline_compares_the_fastest_of_each_kind_that_reach_an_error_of_one_percent():
    data = methods_table()
    slow = data["method"] == "explicit, uniform steps"
    figure = plot_speed(pd.concat([data, data[slow].assign(value=1024, wall_s=0.4, error=5e-3)]))
    for axes in figure.axes:
        assert axes.get_legend().get_title().get_text() == "to an error of 1 %:"
        assert legend_texts(axes.get_legend()) == ["elastic path 10 ms", "time steps ×40"]
    rings = [line.get_xydata()[0].tolist() for line in figure.axes[1].lines if line.get_label() == RING["label"]]
    np.testing.assert_allclose(rings, [[0.01, 1e-2], [0.4, 5e-3]])


def test_front_is_that_of_all_methods_and_errors_of_zero_stand_on_the_floor():
    data = methods_table()
    rough = data[(data["elements"] == 257) & (data["problem"] != "sphere")]
    lines = coordinates(plot_speed(data).axes[0])
    front = pareto_front(rough.assign(error=np.maximum(rough["error"], FLOOR)))
    np.testing.assert_allclose(lines[0], front[["wall_s", "error"]])
    assert any(line[:, 1].min() == FLOOR for line in lines[1:])
