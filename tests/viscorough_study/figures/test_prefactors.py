"""Figure of the prefactor under every combination of conventions."""

import pandas as pd
import pytest

from support.figures import legend_texts
from support.study import SHOWN
from viscorough_study.figures.prefactors import plot_prefactors
from viscorough_study.prefactors import COLUMNS, combinations, prefactors


def test_every_combination_is_drawn_and_the_nearest_named(scaling):
    table = prefactors(scaling)
    figure = plot_prefactors(table, SHOWN)
    for axes in figure.axes:
        assert len(axes.lines) >= len(combinations(table))
        names = legend_texts(axes.get_legend())
        assert "as in other figures" in names
        assert any(name.startswith("nearest: ") for name in names)
    with pytest.raises(ValueError, match="plot_prefactors: the table has no rows"):
        plot_prefactors(pd.DataFrame(columns=list(COLUMNS)), SHOWN)
