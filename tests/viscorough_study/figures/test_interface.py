"""Figure of the interface and the punch in series."""

import numpy as np
import pandas as pd
import pytest

from support.figures import interface_tables_drawn, literature_table, whole_on_page
from support.study import SHOWN
from viscorough_study.figures.interface import plot_interface


def test_interface_law_and_plateaus_are_drawn():
    table, curves = interface_tables_drawn()
    figure = plot_interface(table, curves, literature_table(), SHOWN)
    discs, lines, law, plateaus = figure.axes
    wanted = table[table["average"] == SHOWN["average"]]
    of_discs = wanted[(wanted["source"] == "discs") & (wanted["across"] == 257)].drop_duplicates("hurst")
    assert len(discs.collections) == len(of_discs)
    assert len(discs.lines) == 3 * len(of_discs)  # g, its law and its plateau
    assert len(lines.lines) == 2 * sum(wanted["case_group"] == "lines")
    for line in law.lines[: len(of_discs)]:
        np.testing.assert_allclose(line.get_ydata(), 1.02, rtol=1e-9)
    drawn = sorted(line.get_ydata()[0] for line in plateaus.lines if line.get_marker() not in ("_", "|", "None"))
    shown = wanted[(wanted["source"] == "discs") | (wanted["case_group"] != "sizes")]
    assert drawn == pytest.approx(sorted(shown["u0"]))
    assert whole_on_page(figure)
    with pytest.raises(ValueError, match="plot_interface: the table has no rows"):
        plot_interface(pd.DataFrame(columns=list(table)), curves, literature_table(), SHOWN)


def test_values_of_others_are_drawn_and_named():
    table, curves = interface_tables_drawn()
    plateaus = plot_interface(table, curves, literature_table(), SHOWN).axes[3]
    (band,) = [one for one in plateaus.collections if hasattr(one, "get_facecolor") and len(one.get_facecolor())]
    corners = {tuple(corner) for corner in band.get_paths()[0].vertices}
    assert corners == {(0.4, 0.5), (0.4, 0.56), (0.9, 0.41), (0.9, 0.46)}
    (line,) = [line for line in plateaus.lines if line.get_linestyle() == "--" and line.get_marker() == "None"]
    assert set(line.get_ydata()) == {0.4}
    assert [text.get_text() for text in plateaus.texts] == ["One 2007, γ of later fits", "One et al. 2013"]
    nothing = plot_interface(table, curves, literature_table().iloc[:0], SHOWN).axes[3]
    assert not nothing.texts
