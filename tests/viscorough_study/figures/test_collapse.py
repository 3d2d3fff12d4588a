"""Figure of the collapse of the curves of all grids."""

import numpy as np
import pytest

from support.figures import collapse_tables, curves_of_sizes, whole_on_page
from viscorough_study.figures.collapse import SHIFT, plot_collapse


def test_curves_of_a_law_are_horizontal_and_exponents_have_their_intervals():
    curves, (collapse, infinite) = curves_of_sizes(), collapse_tables()
    figure = plot_collapse(curves, collapse, infinite)
    whole, interface, exponents = figure.axes
    assert whole_on_page(figure)
    for rank in range(2):
        for line in whole.lines[2 * rank : 2 * rank + 2]:
            np.testing.assert_allclose(line.get_ydata(), np.exp(0.5) * SHIFT**-rank)
    assert [line.get_xdata()[0] for line in whole.lines[:2]] == pytest.approx([1e-4 * 33**1.4, 1e-4 * 129**1.4])
    assert all(line.get_ydata()[-1] < line.get_ydata()[0] for line in interface.lines)
    bars = [line for line in exponents.lines if line.get_linewidth() == 4]
    assert [tuple(np.round(bar.get_ydata(), 3)) for bar in bars] == [(-0.02, 0.02)] * 4
    markers = [line for line in exponents.lines if line.get_marker() in "os" and len(line.get_xdata()) == 1]
    assert [line.get_ydata()[0] for line in markers] == pytest.approx([0.03] * 8)
    with pytest.raises(ValueError, match="plot_collapse: the table has no rows"):
        plot_collapse(curves, collapse[:0], infinite)
