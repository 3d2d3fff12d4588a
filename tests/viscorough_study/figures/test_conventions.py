"""Figure of the conventions: a row for each change."""

import numpy as np
import pandas as pd
import pytest

from support.figures import HURST, markers, whole_on_page, without_region
from support.study import SHOWN
from viscorough import reference
from viscorough_study.conventions import select
from viscorough_study.figures.conventions import plot_conventions

pytestmark = pytest.mark.filterwarnings("error")


def test_conventions_has_a_row_for_each_change(scaling):
    figure = plot_conventions(scaling, SHOWN)
    grid = np.reshape(figure.axes, (2, len(HURST)))
    labels = [text.get_text() for text in grid[0, 0].get_yticklabels()]
    assert labels[0] == "as in other figures"
    assert labels[1:5] == ["arithmetic mean", "$h$ of the square", "lower half of window", "upper half of window"]
    radius = "radius: contradicts the paper"
    assert labels[5:] == ["window of given κ", "law with Γ (Eq. 9)", radius, "roll-off (control)"]
    changes = [{}, {"average": "arithmetic"}, {"rms_convention": "square"}]
    changes += [{"window_rule": rule} for rule in ("lower_half", "upper_half", "kappa")]
    changes += [{"gamma": "with"}, {"diameter_convention": "radius"}, {"case_group": "roll_off"}]
    for axes, quantity in zip(grid, ("beta", "zeta"), strict=True):
        for panel, hurst in zip(axes, HURST, strict=True):
            rows = {int(line.get_ydata()[0]): line.get_xdata()[0] for line in markers(panel)}
            for y, change in enumerate(changes):
                wanted = SHOWN | {"source": "discs", "case_group": "base", "hurst": hurst} | change
                (value,) = select(scaling, wanted)[quantity]
                assert rows.get(y) == value if np.isfinite(value) else y not in rows
    laws = {
        line.get_xdata()[0] for line in grid[1, 1].lines if len(set(line.get_xdata())) == 1 and line.get_zorder() == 1
    }
    assert laws == {reference.zeta_viscous(0.9), reference.zeta_elastic(0.9)}
    lengths = [np.diff(panel.get_xlim())[0] for panel in grid[0]]
    assert lengths[0] == pytest.approx(lengths[1])
    ratios = [np.divide(*panel.get_xlim()) for panel in grid[1]]
    assert ratios[0] == pytest.approx(ratios[1])
    assert whole_on_page(figure)


def test_conventions_say_where_there_is_no_region(scaling):
    figure = plot_conventions(without_region(scaling, 0.4), SHOWN)
    empty, other = figure.axes[:2]
    assert [text.get_text() for text in empty.texts] == ["no region (b)"] * 9
    assert not markers(empty)
    assert len(markers(other)) + len(other.texts) == 9
    assert whole_on_page(figure)


def test_conventions_go_on_in_further_rows(scaling):
    five = pd.concat([scaling.assign(hurst=scaling["hurst"] + shift) for shift in (0, 0.02, 0.04)])
    five = five[five["hurst"] < 0.93]
    figure = plot_conventions(five, SHOWN)
    titles = [axes.get_title() for axes in figure.axes]
    assert [title for title in titles if title] == [f"$H={h}$" for h in (0.4, 0.42, 0.44, 0.9, 0.92)]
    assert len(figure.axes) == 10
    with pytest.raises(ValueError, match="no discs"):
        plot_conventions(scaling[scaling["source"] == "lines"], SHOWN)
