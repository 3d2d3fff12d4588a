"""Figure of λ over X and of exponents in equal windows."""

import numpy as np
import pytest

from support.figures import coordinates, legend_texts, mdr_lambda_tables, whole_on_page
from viscorough_study.figures.mdr_lambda import plot_mdr_lambda


def test_region_is_thick_and_unknown_differences_are_left_out():
    of_lambda, exponents = mdr_lambda_tables()
    figure = plot_mdr_lambda(of_lambda, exponents)
    values, ratios, differences = figure.axes
    for axes, name in ((values, "lambda"), (ratios, "velocity_ratio")):
        lines = coordinates(axes)
        for hurst, (whole, inside) in zip((0.4, 0.9), (lines[:2], lines[2:4]), strict=True):
            rows = of_lambda[of_lambda["hurst"] == hurst]
            np.testing.assert_array_equal(whole, rows[["x", name]])
            np.testing.assert_array_equal(inside, rows.loc[rows["in_region"] == 1, ["x", name]])
        assert [line.get_linewidth() for line in axes.lines[1:4:2]] == [2, 2]
    marks = [line for line in differences.lines if line.get_marker() in "oDs"]
    assert [line.get_ydata().item() for line in marks] == [-0.1, 0.0, -0.1, 0.0]
    assert legend_texts(figure.legends[0]) == ["$H=0.4$", "$H=0.9$", "own region", "same X", "same κ"]
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_mdr_lambda: the table has no rows"):
        plot_mdr_lambda(of_lambda[:0], exponents)
