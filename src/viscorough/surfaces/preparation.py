"""Prepare measured maps of heights for contact computations.

`prepare` marks missing values, crops the map, changes the sign, removes tilt or form, and fills holes. `doubts`
describes defects of a map that was not prepared. The solver would accept such a map, but the results would be wrong.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from viscorough.basics.arrays import real_numbers, shown, whole_number
from viscorough.basics.types import Array, Mask
from viscorough.surfaces.indenter import Indenter, check_indenter

# Allowed values of the arguments `detrend` and `fill` of `prepare`.
DETREND = ("none", "mean", "plane", "sphere")
FILL = ("none", "harmonic")
# A map is called tilted if the fitted plane rises by more than this multiple of the rms height about the plane.
_NOTABLE_TILT = 6
# A height is suspicious if its distance from all other heights is more than this multiple of the range of the other
# heights. For a common mark of missing values, the distance must only exceed the range.
_FAR = 10
# Values that instruments and programs often write for missing heights.
_MARKS = (9999.0, -9999.0, -99999.0, -32768.0, -32767.0, 32767.0, 65535.0, -1e38, 1e38)
# A point is called a spike if it is higher than all its neighbours by more than this multiple of the median difference
# between neighbours.
_SPIKE = 20
# The distance of the corners of the map from its middle must be less than this share of the radius of a fitted sphere.
_LARGEST_SLOPE = 0.99
# Largest number of iterations in the fit of a sphere.
_MAX_ITERATIONS = 20

# Part of a map, as ((first column, end), (first row, end)), where the ends are not included.
Crop = Sequence[Sequence[int]]


def prepare(
    indenter: Indenter,
    *,
    nodata: Sequence[float] = (),
    crop: Crop | None = None,
    flip: bool = False,
    detrend: str = "none",
    fill: str = "none",
) -> Indenter:
    """Prepare a measured map of heights for contact computations.

    The steps are, in this order: replace marks of missing values by nan, crop the map, change the sign of the heights,
    subtract a form, and fill holes. Each step is optional.

    Parameters
    ----------
    indenter : Indenter
        Map of heights.
    nodata : Sequence[float], optional
        One or several values that mark missing heights in the map. Points with these values become nan.
    crop : pairs of int, optional
        Part of the map to keep, as ((first column, end), (first row, end)). Columns and rows are counted from 0, and
        the ends are not included.
    flip : bool, optional
        True to change the sign, for maps of depths instead of heights.
    detrend : str, optional
        Form to subtract: "mean", "plane", "sphere", or "none". The form is fitted by least squares to all points that
        are not nan. "sphere" is a sphere of curvature k on a plane, a + bx + cy + k r²/(1 + √(1 − k²r²)), with the
        coordinates x and y and the distance r from the middle of the map.
    fill : str, optional
        "harmonic" to fill every region of nan that is enclosed by heights. The new heights solve the Laplace equation,
        with the heights around the region as boundary values.

    Returns
    -------
    Indenter

    Raises
    ------
    ValueError
        For a line instead of a map, an unknown option, a crop beyond the map, and if no height is left or no sphere
        fits.

    Examples
    --------
    >>> import numpy as np
    >>> import viscorough
    >>> heights = np.add.outer(np.arange(4.0), np.arange(4.0) % 2)  # a tilted map
    >>> prepared = viscorough.prepare(viscorough.Indenter(heights, 1.0), detrend="plane")
    >>> bool(np.ptp(prepared.heights) < np.ptp(heights))
    True
    """
    check_indenter("prepare", indenter, 2)
    if detrend not in DETREND or fill not in FILL:
        raise ValueError(f"detrend {detrend!r}, fill {fill!r}; allowed: {', '.join(DETREND)}; {', '.join(FILL)}")
    marks = real_numbers("nodata", nodata)
    if not (marks.size or crop is not None or flip) and (detrend, fill) == ("none", "none"):
        return indenter
    heights, columns, rows = indenter.heights.copy(), indenter.column_positions, indenter.row_positions
    with np.errstate(over="ignore"):
        heights[np.isin(heights, marks.astype(heights.dtype))] = np.nan
    if crop is not None:
        if np.shape(crop) != (2, 2):
            raise ValueError(f"argument crop: {shown(crop)}; ((first column, end), (first row, end)) is needed")
        crop = [[whole_number("crop", point, at_least=0) for point in pair] for pair in crop]
        for (first, end), size, name in zip(crop, heights.shape[::-1], ("columns", "rows"), strict=True):
            if not 0 <= first < end <= size:
                raise ValueError(f"argument crop to {name} {first}:{end}; within 0:{size} is allowed")
        (left, right), (top, bottom) = crop
        heights = heights[top:bottom, left:right].copy()
        columns, rows = columns if columns is None else columns[left:right], rows if rows is None else rows[top:bottom]
    if np.isnan(heights).all():
        raise ValueError("no height is left after argument nodata and argument crop; at least one is needed")
    if flip:
        np.negative(heights, out=heights)
    if detrend != "none":
        heights = heights - _fitted(heights, indenter.spacing, indenter.row_spacing, detrend)
    if fill == "harmonic":
        heights = _filled(heights, indenter.aspect)
    spacings, unit = (indenter.spacing, indenter.row_spacing), indenter.length_unit
    return Indenter(heights, *spacings, unit, columns, rows, from_file=indenter.from_file)


def doubts(indenter: Indenter) -> list[str]:
    """Describe the defects of a map: suspicious values, tilt, spikes and enclosed regions of nan, each in one line."""
    if indenter.heights.ndim != 2 or min(indenter.heights.shape) < 3:
        return []
    heights = indenter.heights
    # Suspicious values cause tilt and spikes, so tilt and spikes are described only if no value is suspicious.
    texts = [*_suspicious_values(heights)] or [*_tilt(indenter), *_spikes(heights)]
    return [*texts, *_holes(heights)]


# ---- mean, plane, sphere


def _fitted(heights: Array, dx: float, dy: float, form: str) -> Array:
    """Return the heights of a form that is fitted to a map by least squares, at the points of the map.

    A sphere is fitted by the Gauss-Newton method. In this fit, all lengths are in units of the distance from the middle
    of the map to its corners.

    dx, dy : spacings of the map
    form : "mean", "plane" or "sphere"
    """
    (rows, columns), measured, largest = heights.shape, ~np.isnan(heights), max(dx, dy)
    # Divide by the larger spacing first, so that the size of the map cannot overflow. From here on, `reach` is the
    # distance of the corners from the middle of the map, in units of the larger spacing.
    dx, dy = dx / largest, dy / largest
    reach = np.hypot(dx * columns, dy * rows) / 2
    x = dx * (np.arange(columns) - (columns - 1) / 2) / reach
    y = dy * (np.arange(rows)[:, None] - (rows - 1) / 2) / reach
    plane = np.stack(np.broadcast_arrays(1.0, x, y)[: 1 if form == "mean" else 3])
    target = heights[measured].astype(float)
    if form != "sphere":
        return np.tensordot(_factors(plane[:, measured], target), plane, 1)
    target = target / reach / largest
    curvature, squared = 0.0, x**2 + y**2
    for _ in range(_MAX_ITERATIONS):
        root = np.sqrt(1 - curvature**2 * squared)
        slope = squared / (root * (1 + root))  # derivative of `_sag` with respect to the curvature
        functions = np.concatenate([plane, [slope]])[:, measured]
        tangent = _sag(curvature, squared) - curvature * slope
        values, last = _factors(functions, target - tangent[measured]), curvature
        curvature = float(values[3])
        if not abs(curvature) < _LARGEST_SLOPE:
            raise ValueError(
                "argument detrend='sphere': the sphere that fits is smaller than the map; crop to a cap of it"
            )
        if abs(curvature - last) <= 1e-12 * abs(curvature):
            break
    return largest * (reach * (np.tensordot(values[:3], plane, 1) + _sag(curvature, squared)))


def _factors(functions: Array, target: Array) -> Array:
    """Return factors of functions, so that the sum of factor times function is closest to the target.

    functions : values of the functions, shape (functions, points)
    target : values to fit by least squares, shape (points,)
    """
    return np.linalg.lstsq(functions @ functions.T, functions @ target, rcond=1e-13)[0]


def _sag(curvature: float, squared: Array) -> Array:
    """Return k r²/(1 + √(1 − k²r²)), the height of a sphere of curvature k > 0 above its lowest point.

    For k < 0, return the height above the highest point of the sphere, which is negative.

    squared : r², squared distance from the middle
    """
    return curvature * squared / (1 + np.sqrt(1 - curvature**2 * squared))


def _tilt(indenter: Indenter) -> Iterator[str]:
    """Yield a text if the tilt of the map is much larger than its roughness."""
    heights, measured = indenter.heights, ~np.isnan(indenter.heights)
    plane = _fitted(heights, indenter.spacing, indenter.row_spacing, "plane")[measured]
    rise, rms = np.ptp(plane), np.sqrt(np.mean((heights[measured] - plane) ** 2))
    if rise > _NOTABLE_TILT * rms and rise > 1e-9 * np.nanmax(np.abs(heights)):
        about = (
            f"{rise / rms:.3g} times the rms height about it" if rms > 1e-9 * rise else "and nothing is left about it"
        )
        text = f"the map is tilted: a plane through it rises by {rise:.3g}, {about}"
        yield f"{text}; argument detrend='plane' removes it"


# ---- suspicious values and spikes


def _suspicious_values(heights: Array) -> Iterator[str]:
    """Yield a text if the lowest value is suspicious, and a text if the highest value is suspicious.

    A value is suspicious if it is far from all other values, and is either repeated or a common mark of missing values.
    """
    for extreme in (np.fmin, np.fmax):
        value = float(extreme.reduce(heights, axis=None))
        is_value = heights == value
        count = int(np.count_nonzero(is_value))
        others = heights[~is_value & ~np.isnan(heights)]
        if not others.size:
            return
        lowest, highest = float(others.min()), float(others.max())
        gap, span = max(lowest - value, value - highest), highest - lowest
        is_mark = any(abs(value - mark) <= 1e-6 * abs(mark) for mark in _MARKS) or abs(value) >= 1e30
        if gap > (1 if is_mark else _FAR) * span and (is_mark or (count > 1 and span > 0)):
            share = 100 * count / (count + others.size)
            exact = f"{value:g}" if float(f"{value:g}") == value else repr(value)
            yield (
                f"{count} points ({share:.2g} %) have the value {exact}, far from all others ({lowest:g} to "
                f"{highest:g}): if it marks what was not measured, argument nodata={exact} removes it"
            )


def _spikes(heights: Array) -> Iterator[str]:
    """Yield a text about spikes, which are single points far above all their neighbours, if the map has spikes."""
    from scipy import ndimage

    neighbours = np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]])
    without_nan = np.where(np.isnan(heights), -np.inf, heights)
    with np.errstate(invalid="ignore"):
        above = (heights - ndimage.maximum_filter(without_nan, footprint=neighbours))[1:-1, 1:-1]
        steps = np.abs(np.diff(heights[:: max(1, len(heights) // 256)], axis=1))
        usual, relief = np.nanmedian(steps) if np.isfinite(steps).any() else 0.0, np.nanstd(heights)
        spikes = np.isfinite(above) & (above > _SPIKE * usual) & (above > relief)
    count = int(np.count_nonzero(spikes))
    if usual > 0 and 0 < count <= 1e-3 * heights.size + 1:
        largest = float(above[spikes].max())
        yield (
            f"{count} single points stand up to {largest:.3g} above all their neighbours, {largest / usual:.3g} times "
            "the usual step between neighbours: spikes touch first; "
            "argument nodata with their values sets those to nan that are artefacts"
        )


# ---- holes


def _enclosed(heights: Array) -> tuple[Mask, int]:
    """Return a mask of all regions of nan that do not reach the edge of the map, and the number of these regions."""
    from scipy import ndimage

    missing = np.isnan(heights)
    if not missing.any():
        return missing, 0
    holes = ndimage.binary_fill_holes(~missing) & missing
    return holes, ndimage.label(holes)[1]


def _holes(heights: Array) -> Iterator[str]:
    holes, count = _enclosed(heights)
    if count:
        points = np.count_nonzero(holes)
        regions, share = f"{count} enclosed region{'' if count == 1 else 's'}", 100 * points / heights.size
        yield (
            f"{regions} without heights ({points} points, {share:.2g} %) are holes that never touch; "
            "argument fill='harmonic' closes them"
        )


def _filled(heights: Array, aspect: float) -> Array:
    """Fill enclosed regions of nan by the five-point Laplace equation, and return the heights.

    The height of each filled point is the weighted mean of its four neighbours. The weights are 1/dx² along x and 1/dy²
    along y.

    aspect : dy/dx
    """
    from scipy import sparse
    from scipy.sparse.linalg import spsolve

    holes, count = _enclosed(heights)
    if count == 0:
        return heights
    hole, weights = np.flatnonzero(holes), np.array([aspect**2, aspect**2, 1.0, 1.0])
    neighbours = hole[:, None] + [1, -1, heights.shape[1], -heights.shape[1]]
    ends = np.arange(0, neighbours.size + 1, 4)
    sums = sparse.csr_array((np.tile(weights, hole.size), neighbours.ravel(), ends), shape=(hole.size, heights.size))
    matrix = sparse.diags_array(np.full(hole.size, weights.sum())) - sums[:, hole]
    filled = heights.copy()
    filled[holes] = spsolve(sparse.csc_matrix(matrix), sums @ np.where(holes, 0, heights).ravel())
    return filled
