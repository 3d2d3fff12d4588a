"""Labels beside what they name."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox

from viscorough_study.figures.placement import place_labels


def placed(labels, curve):
    """Axes with a curve, and the boxes of the labels in pixels."""
    figure = Figure(layout="constrained")
    axes = figure.subplots()
    axes.plot(*curve)
    axes.set(xlim=(0, 10), ylim=(0, 10))
    place_labels(axes, [(text, x, y, "red") for text, x, y in labels])
    renderer = FigureCanvasAgg(figure).get_renderer()
    return axes, [text.get_window_extent(renderer) for text in axes.texts]


def test_labels_hide_neither_each_other_nor_the_curve():
    x = np.linspace(0, 10, 500)
    axes, boxes = placed([(f"label {rank}", 5 + 0.3 * rank, 5 + 0.3 * rank) for rank in range(4)], (x, x))
    for rank, box in enumerate(boxes):
        assert not any(Bbox.intersection(box, other) for other in boxes[rank + 1 :])
        assert not box.count_contains(axes.transData.transform(np.column_stack([x, x])))


def test_labels_stay_inside():
    axes, boxes = placed([(f"label {rank}", 9.8, 9.9 - 9.8 * rank) for rank in range(2)], ([0, 1], [5, 5]))
    for box in boxes:
        assert axes.bbox.x0 < box.x0 < box.x1 < axes.bbox.x1
        assert axes.bbox.y0 < box.y0 < box.y1 < axes.bbox.y1


def test_a_label_rather_hides_a_piece_of_a_curve_than_a_marker():
    figure = Figure(layout="constrained")
    axes = figure.subplots()
    for x in np.arange(0, 5.1, 0.5):  # curves beneath all places but those on the right, where there are markers
        axes.plot([x, x], [0.5, 9.5])
    markers = [(x, y) for x in np.arange(5.3, 8, 0.3) for y in np.linspace(3, 7, 17)]
    for marker in markers:
        axes.plot(*marker, "o")
    axes.set(xlim=(0, 10), ylim=(0, 10))
    place_labels(axes, [("a label", 5, 5, "red")])
    box = axes.texts[0].get_window_extent(FigureCanvasAgg(figure).get_renderer())
    assert not box.count_contains(axes.transData.transform(markers))
