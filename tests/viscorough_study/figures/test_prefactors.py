"""Figure of the prefactor under every combination of conventions."""

import pandas as pd
import pytest

from support.figures import HURST, markers, whole_on_page
from support.study import BASE_SURFACES, SHOWN
from viscorough_study.conventions import left_open
from viscorough_study.figures.prefactors import NEAREST, plot_prefactors
from viscorough_study.prefactors import COLUMNS, combinations, prefactors, ranked, rows_of


def test_combinations_are_ranked_and_all_of_them_are_ticks(scaling):
    table = prefactors(scaling, BASE_SURFACES)
    open_rows, shown = left_open(table), {"case_group": "base"} | SHOWN
    figure = plot_prefactors(table, SHOWN)
    for axes, law in zip(figure.axes, ("eq4", "eq11"), strict=True):
        labels = [text.get_text() for text in axes.get_yticklabels()]
        assert len(labels) == NEAREST + 3
        assert [label.rsplit(" ", 1)[1] for label in labels[:NEAREST]] == [f"{rank}" for rank in range(1, NEAREST + 1)]
        rank = ranked(open_rows, law).index(shown) + 1
        assert labels[-3].startswith(f"as in the other figures, rank {rank}:")
        assert labels[-2].startswith("$L$ the radius (contradicts the paper), nearest:")
        assert labels[-1] == f"all {len(combinations(open_rows))} combinations left open"
        drawn = {round(line.get_xdata()[0], 12) for line in markers(axes) if line.get_ydata()[0] < 0.5}
        best = rows_of(table, ranked(open_rows, law)[0])
        assert drawn == {round(value, 12) for value in best[law]}
        ticks = [line for line in axes.lines if line.get_marker() == "|" and len(line.get_xdata()) > 1]
        assert len(ticks) == len(HURST)
        assert sum(len(line.get_xdata()) for line in ticks) == len(open_rows)
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_prefactors: the table has no rows"):
        plot_prefactors(pd.DataFrame(columns=list(COLUMNS)), SHOWN)
