"""Labels beside what they name."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox

from viscorough_study.figures.placement import place_labels


def placed(labels, *curves, **look):
    """Axes with curves, and the boxes of the labels in pixels."""
    axes = Figure(layout="constrained").subplots()
    for curve in curves:
        axes.plot(*curve, **look)
    axes.set(xlim=(0, 10), ylim=(0, 10))
    place_labels(axes, [(text, x, y, "red") for text, x, y in labels])
    renderer = FigureCanvasAgg(axes.figure).get_renderer()
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
    # Curves beneath all places but those on the right, where there are markers.
    curves = [([x, x], [0.5, 9.5]) for x in np.arange(0, 5.1, 0.5)]
    markers = [(x, y) for x in np.arange(5.3, 8, 0.3) for y in np.linspace(3, 7, 17)]
    axes, (box,) = placed([("a label", 5, 5)], *curves, *markers, marker="o")
    assert not box.count_contains(axes.transData.transform(markers))
