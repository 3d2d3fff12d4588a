"""Figure of the growth of the cost, and its fits."""

import numpy as np
import pandas as pd
import pytest

from support.figures import coordinates, legend_texts, methods_table
from viscorough_study.figures.growth import plot_growth


def test_medians_and_exponents_are_those_of_the_discs_solved_in_time():
    data = methods_table()
    automatic = data["method"] == "path, automatic levels"
    late = data[automatic & (data["elements"] == 257)].assign(wall_s=120.0, error=1.0)
    figure = plot_growth(pd.concat([data, late]))
    assert legend_texts(figure.legends[0])[0] == "automatic levels, 1e-3: $N^{1.20}$"
    np.testing.assert_allclose(coordinates(figure.axes[1])[0][:, 1], [65, 257, 513])


def test_table_without_rough_discs_is_refused():
    data = methods_table()
    with pytest.raises(ValueError, match="plot_growth: the table has no rows"):
        plot_growth(data[data["problem"] == "sphere"])
