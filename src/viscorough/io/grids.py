"""Points x, y, z, in any order, as a map of heights where x and y form a grid."""

import numpy as np

from viscorough.types import Array, Integers

_MERGED = 1e-6  # positions closer than this, relative to their range, are one
_OFF_GRID = 0.05  # largest distance from the grid, relative to its spacing
_LEAST_SHARE, _LEAST_POINTS = 0.5, 9  # of the grid, that rows of unknown meaning need to be taken for its points


def gridded(points: Array, required: bool) -> tuple[Array, tuple[float, float]] | None:
    """(heights, (dx, dy)) of points on a grid of equal spacing; heights[row, column], both in increasing order.

    points : x, y, z, shape (points, 3)
    required : whether the points are known to be x, y, z; else None is returned for what is no grid

    Where a point of the grid is missing, the height is nan. Raises ValueError for required points that form no grid.
    """
    try:
        if points.shape[1] != 3:
            raise ValueError(f"{points.shape[1]} columns; three, x, y and z, are needed")
        if not np.isfinite(points[:, :2]).all():
            raise ValueError("x and y must be finite")
        (column, columns, dx), (row, rows, dy) = map(_axis, points[:, :2].T)
        if columns * rows > max(4 * len(points), 100):
            raise ValueError(f"{len(points)} points on a grid of {columns} by {rows}")
        if np.bincount(row * columns + column).max() > 1:
            raise ValueError("some points stand twice")
        if not required and len(points) < max(_LEAST_POINTS, _LEAST_SHARE * columns * rows):
            raise ValueError("few of its points")
    except ValueError as fault:
        if required:
            raise ValueError(f"points x, y, z form no grid of equal spacing ({fault}); a grid is needed") from None
        return None
    heights = np.full((rows, columns), np.nan)
    heights[row, column] = points[:, 2]
    return heights, (dx, dy)


def _axis(positions: Array) -> tuple[Integers, int, float]:
    """(index of each position, number of indices, spacing) along an axis of equal spacing. Raises ValueError.

    Positions may be rounded, and whole columns may be missing.
    """
    different = np.unique(positions)
    with np.errstate(over="ignore"):
        extent = different[-1] - different[0]
    if not 0 < extent < np.inf:
        raise ValueError("at least two positions in each direction are needed")
    different = different[np.diff(different, prepend=-np.inf) > _MERGED * extent]
    steps = np.diff(different)
    for step in (extent / steps.size, np.median(steps), steps.min()):
        count = round(extent / step)
        spacing = extent / count
        places = (positions - different[0]) / spacing
        index = np.rint(places).astype(int)
        if np.abs(places - index).max() <= _OFF_GRID:
            return index, count + 1, float(f"{spacing:.12g}")
    raise ValueError(f"steps lie between {steps.min():g} and {steps.max():g}")
