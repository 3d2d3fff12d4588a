"""Convert points x, y, z in any order to a map of heights, if x and y form a grid."""

from decimal import Decimal

import numpy as np

from viscorough.basics.types import Array, Integers

# Two positions count as the same if their distance is at most this share of the range of all positions.
_MERGED = 1e-6
# A position may differ from the nearest position on an equally spaced grid by at most this share of the spacing.
_OFF_GRID = 0.05
# A table of three columns may hold points x, y, z or a map of heights. If this is not certain, its rows count as points
# only if they fill at least this share of a grid, and if there are at least this many rows.
_LEAST_SHARE, _LEAST_POINTS = 0.5, 9


def gridded(points: Array, required: bool) -> tuple[Array, tuple[float, float]] | None:
    """Return (heights, (dx, dy)) of points on a grid of equal spacing.

    points : x, y, z, shape (points, 3)
    required : True if the rows of `points` certainly are x, y, z; ValueError is then raised if they form no grid. False
        if they may also be heights; None is then returned unless they clearly form a grid

    The heights have the shape (rows, columns), with y increasing from row to row and x from column to column. They are
    nan at missing points.
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
        if not required and min(np.bincount(column).max(), np.bincount(row).max()) == 1:
            # The table may be a profile with the columns x, z and number of the point.
            raise ValueError("no two points in a row or column")
    except ValueError as fault:
        if required:
            raise ValueError(f"points x, y, z form no grid of equal spacing ({fault}); a grid is needed") from None
        return None
    heights = np.full((rows, columns), np.nan)
    heights[row, column] = points[:, 2]
    return heights, (dx, dy)


def even_spacing(positions: Array) -> float | None:
    """Return the distance between positions that rise or fall in equal steps; None for other positions.

    Each position may deviate by one unit of its last printed digit (rounding), but by no more than a twentieth of the
    distance.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        step = abs(positions[-1] - positions[0]) / max(positions.size - 1, 1)
        off = np.abs(positions - np.linspace(positions[0], positions[-1], positions.size)).max()
    if not (0 < step < np.inf and off <= _OFF_GRID * step and off <= _last_digit(positions) + _MERGED * step):
        return None
    return float(f"{step:.12g}")


def _last_digit(numbers: Array) -> float:
    """Return the size of one unit in the last printed digit of numbers, such as 0.01 for 1.25 and 3.5.

    It is assumed that all numbers were printed with equally many decimals, or with equally many significant digits.
    """
    decimals = [Decimal(repr(number)).normalize() for number in numbers.tolist()]
    digits, places = zip(*(number.as_tuple()[1:] for number in decimals), strict=True)
    largest = max(number.adjusted() for number in decimals)
    return float(10.0 ** max(min(places), largest - max(map(len, digits)) + 1))


def _axis(positions: Array) -> tuple[Integers, int, float]:
    """Return (grid index of each position, number of grid points, spacing) along one axis of a grid.

    Positions may be rounded and repeated, and some grid points may have no position. Raises ValueError if the positions
    do not fit an equally spaced grid.
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
