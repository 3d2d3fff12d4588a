"""Figures over the number of elements."""

import numpy as np
import pandas as pd
import pytest

from support.study import SHOWN
from viscorough_study.figures.large import plot_large
from viscorough_study.figures.sizes import plot_sizes


def test_a_marker_for_every_ensemble_with_a_region():
    rows = [
        {**SHOWN, "source": source, "hurst": hurst, "elements": n, "beta": beta, "beta_low": 0.2, "beta_high": 0.4}
        | ({"rms_convention": "line"} if source == "lines" else {})
        | {"case_group": "sizes"}
        for source in ("discs", "lines")
        for hurst in (0.3, 0.7)
        for n, beta in ((100, np.nan), (1000, 0.3), (10000, 0.31))
    ]
    control = rows[1] | {"case_group": "controls", "beta": 0.01}
    table = pd.DataFrame([*rows, control])
    figure = plot_sizes(table, SHOWN)
    for axes in figure.axes:
        markers = [line for line in axes.lines if line.get_marker() not in ("None", "", "_", "|")]
        expected = [0.3, 0.3, 0.31, 0.31]
        assert sorted(line.get_ydata()[0] for line in markers) == ([0.01] if axes is figure.axes[0] else []) + expected
    with pytest.raises(ValueError, match="no rows"):
        plot_sizes(table[:0], SHOWN)


def test_exponents_of_the_cost_are_those_of_the_larger_half():
    elements = np.array([1e3, 1e4, 1e5, 1e6])
    table = pd.DataFrame({"across": [36, 113, 357, 1128], "elements": elements})
    table["processor"] = 1.0 + 1e-6 * elements**1.2
    table["memory"] = 400 * elements
    figure = plot_large(table)
    labels = [text.get_text() for axes in figure.axes for text in axes.get_legend().get_texts()]
    slope = np.log(table["processor"].iloc[3] / table["processor"].iloc[2]) / np.log(10)
    assert labels == ["measured", f"exponent {slope:.2f}", "measured", "exponent 1.00"]
    with pytest.raises(ValueError, match="two sizes"):
        plot_large(table[:1])
