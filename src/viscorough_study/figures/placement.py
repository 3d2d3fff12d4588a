"""Placement of labels next to points, clear of each other and of the curves."""

from itertools import product

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.patheffects import withStroke
from matplotlib.transforms import Bbox

DIRECTIONS = ((1, 0), (0, -1), (0, 1), (-1, 0), (1, -1), (1, 1), (-1, -1), (-1, 1))
DISTANCES = (4, 9, 15, 22, 30)  # points
HALO = {"path_effects": [withStroke(linewidth=2, foreground="white")]}
DARKER = 0.75  # factor on the colours of lines, which are too light for text
NEAR, MISLEADING = 5, 1000  # distance in points to another labelled point, and its cost in covered points of curves
POINTS_OF_CURVE = 400  # number of points at which a curve is sampled
WEIGHT_OF_MARKER = 40  # cost of covering a single marker, in covered points of curves


def place_labels(axes, labels):
    """Place labels next to points of axes whose limits and scales are final.

    labels : list of (text, x, y, color), drawn in slightly darker colours
    Each label in turn takes the position, in eight directions and up to 30 points away, at which it covers no other
    label and as little of the curves as possible; a leader line joins a distant label to its point.
    """
    figure = axes.figure.figure  # also where axes.figure is a subfigure
    canvas = FigureCanvasAgg(figure)
    figure.draw_without_rendering()  # fixes the layout to that of the saved figure
    renderer, pixels = canvas.get_renderer(), figure.dpi / 72
    legend, frame, curves = axes.get_legend(), axes.get_window_extent(renderer), _points_of_curves(axes)
    taken = [legend.get_window_extent(renderer)] if legend else []
    named = axes.transData.transform([(x, y) for _, x, y, _ in labels]).reshape(-1, 2)
    for (text, x, y, color), point in zip(labels, named, strict=True):
        look = {"textcoords": "offset points", "va": "bottom", "color": np.multiply(DARKER, to_rgb(color)), **HALO}
        label = axes.annotate(text, (x, y), (0, 0), **look)
        size = label.get_window_extent(renderer).size
        others = named[(named != point).any(axis=1)]
        places = []
        for distance, direction in product(DISTANCES, np.array(DIRECTIONS)):
            corner = point + direction * distance * pixels + (direction - 1) / 2 * size
            box = Bbox.from_bounds(*corner, *size)
            hidden = sum(bool(Bbox.intersection(box, other)) for other in taken)
            cost = 1e4 * (hidden + (_inside(frame, box.corners()) < 4)) + _inside(box, curves)
            cost += MISLEADING * _inside(box.padded(NEAR * pixels), others) + distance / DISTANCES[-1]
            places.append((cost, len(places), distance, box))
        *_, distance, box = min(places)
        label.set_position((box.p0 - point) / pixels)
        if distance > DISTANCES[0]:
            nearest = np.clip(point, box.p0, box.p1)
            ends = axes.transData.inverted().transform([point, nearest])
            axes.plot(*ends.T, color=color, linewidth=0.4, scalex=False, scaley=False, label="_leader")
        taken.append(box.padded(1.5 * pixels))


def _inside(box, points):
    """Number of points in a box."""
    return ((points > box.p0) & (points < box.p1)).all(axis=1).sum()


def _points_of_curves(axes):
    """Points along all curves of an axes, in pixels, shape (points, 2)."""
    points = [np.empty((0, 2))]
    for line in axes.lines:
        path = line.get_transform().transform(line.get_xydata())
        path = path[np.isfinite(path).all(axis=1)]
        if len(path) > 1:
            along = np.append(0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
            at = np.linspace(0, along[-1], POINTS_OF_CURVE)
            points.append(np.column_stack([np.interp(at, along, path[:, i]) for i in (0, 1)]))
        else:
            points.append(np.repeat(path, WEIGHT_OF_MARKER, axis=0))
    return np.concatenate(points)
