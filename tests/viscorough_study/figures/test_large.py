"""Figure of the cost of one disc."""

import numpy as np
import pytest

from support.figures import large_table, legend_texts
from viscorough_study.figures.large import plot_large


def test_exponents_of_the_cost_are_those_of_the_larger_half():
    table = large_table()
    labels = [text for axes in plot_large(table).axes for text in legend_texts(axes.get_legend())]
    slope = np.log(table["processor"].iloc[3] / table["processor"].iloc[2]) / np.log(10)
    assert labels == [
        "measured (elements across)",
        "wall time on 2 threads",
        f"exponent {slope:.2f}",
        "measured (elements across)",
        "exponent 1.00",
    ]
    with pytest.raises(ValueError, match="two sizes"):
        plot_large(table[:1])
