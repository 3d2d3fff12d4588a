"""Figure of the cost of one disc."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

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


def test_numbers_at_the_markers_meet_neither_frame_nor_ticks():
    across = 2 ** np.arange(7, 14) + 1
    costs = pd.DataFrame(
        {"across": across, "elements": across**2, "processor": 1e-6 * across**2.2, "memory": across**2}
    )
    figure = plot_large(costs.assign(threads=2, wall_threads=costs["processor"]))
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw_without_rendering()
    for axes in figure.axes:
        boxes = [text.get_window_extent(renderer) for text in axes.texts]
        assert len(boxes) == 7
        ticks = 5 / 72 * figure.dpi
        assert all(axes.bbox.x0 + ticks < box.x0 and box.y1 < axes.bbox.y1 for box in boxes)
