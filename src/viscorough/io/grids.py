"""Points x, y, z, in any order, as a map of heights where x and y form a grid."""

from decimal import Decimal

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
        if not required and min(np.bincount(column).max(), np.bincount(row).max()) == 1:
            raise ValueError("no two points in a row or column")  # as x, z and a number of a profile
    except ValueError as fault:
        if required:
            raise ValueError(f"points x, y, z form no grid of equal spacing ({fault}); a grid is needed") from None
        return None
    heights = np.full((rows, columns), np.nan)
    heights[row, column] = points[:, 2]
    return heights, (dx, dy)


def even_spacing(positions: Array) -> float | None:
    """Return the distance between positions that rise, or fall, in equal steps; None for other positions.

    Each may be off its place as far as it was rounded, by a unit of the last digit, but not by more than a twentieth of
    the distance.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        step = abs(positions[-1] - positions[0]) / max(positions.size - 1, 1)
        off = np.abs(positions - np.linspace(positions[0], positions[-1], positions.size)).max()
    if not (0 < step < np.inf and off <= _OFF_GRID * step and off <= _last_digit(positions) + _MERGED * step):
        return None
    return float(f"{step:.12g}")


def _last_digit(numbers: Array) -> float:
    """Return the unit of the last digit of printed numbers, all with as many decimals, or else as many digits."""
    decimals = [Decimal(repr(number)).normalize() for number in numbers.tolist()]
    digits, places = zip(*(number.as_tuple()[1:] for number in decimals), strict=True)
    largest = max(number.adjusted() for number in decimals)
    return float(10.0 ** max(min(places), largest - max(map(len, digits)) + 1))


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
