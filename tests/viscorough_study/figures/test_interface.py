"""Figure of the interface and the punch in series."""

import numpy as np
import pandas as pd
import pytest

from support.figures import interface_tables_drawn, whole_on_page
from support.study import SHOWN
from viscorough_study.figures.interface import plot_interface


def test_interface_law_and_plateaus_are_drawn():
    table, curves = interface_tables_drawn()
    figure = plot_interface(table, curves, SHOWN)
    discs, lines, law, plateaus = figure.axes
    wanted = table[table["average"] == SHOWN["average"]]
    of_discs = wanted[(wanted["source"] == "discs") & (wanted["across"] == 257)].drop_duplicates("hurst")
    assert len(discs.collections) == len(of_discs)
    assert len(discs.lines) == 3 * len(of_discs)  # g, its law and its plateau
    assert len(lines.lines) == 2 * sum(wanted["case_group"] == "lines")
    for line in law.lines[: len(of_discs)]:
        np.testing.assert_allclose(line.get_ydata(), 1.02, rtol=1e-9)
    drawn = sorted(line.get_ydata()[0] for line in plateaus.lines if line.get_marker() not in ("_", "|"))
    shown = wanted[(wanted["source"] == "discs") | (wanted["case_group"] != "sizes")]
    assert drawn == pytest.approx(sorted(shown["u0"]))
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_interface: the table has no rows"):
        plot_interface(pd.DataFrame(columns=list(table)), curves, SHOWN)
