"""Prepare measured maps of heights for contact: missing values, cropping, sign, tilt or form, holes.

`doubts` describes defects of unprepared maps, which would make the results of a contact wrong without an error.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from viscorough.basics.argument_names import argument, spelled
from viscorough.basics.arrays import real_numbers, shown, whole_number
from viscorough.basics.types import Array, Mask
from viscorough.surfaces.indenter import Indenter, check_indenter

DETREND = ("none", "mean", "plane", "sphere")
FILL = ("none", "harmonic")
# Rise of the fitted plane over the rms height about it, from which on a map is called tilted.
_NOTABLE_TILT = 6
# Distance of a suspicious value from all other values, over their range. It is 1 for a common mark.
_FAR = 10
# Common marks of missing values.
_MARKS = (9999.0, -9999.0, -99999.0, -32768.0, -32767.0, 32767.0, 65535.0, -1e38, 1e38)
# Height of a spike above all its neighbours, over the usual difference of neighbours.
_SPIKE = 20
# Largest slope of a fitted sphere within the map.
_LARGEST_SLOPE = 0.99
# Largest number of iterations of the fit of a sphere.
_MAX_ITERATIONS = 20

# ((first column, end), (first row, end))
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
    """Prepare a map of heights: missing values, crop, sign, form and holes, in this order.

    Each step is optional. A sphere of curvature k is a + bx + cy + k r²/(1 + √(1 − k²r²)), with r the distance from the
    middle of the map.

    Parameters
    ----------
    indenter : Indenter
        Map of heights.
    nodata : Sequence[float], optional
        Value, or several values, of points that were not measured; these points become nan.
    crop : pairs of int, optional
        ((first column, end), (first row, end)), numbers of points from 0; ends are not included.
    flip : bool, optional
        Change the sign, for maps of depths instead of heights.
    detrend : str, optional
        "mean", "plane" or "sphere": subtract this form, fitted by least squares to all points that are not nan. A
        sphere includes a plane.
    fill : str, optional
        "harmonic": fill enclosed nan regions by the Laplace equation with the heights around them.

    Returns
    -------
    Indenter

    Raises
    ------
    ValueError
        For a line, an unknown option, a crop beyond the map, and if no sphere fits.

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
    heights = indenter.heights.copy()
    with np.errstate(over="ignore"):
        heights[np.isin(heights, marks.astype(heights.dtype))] = np.nan
    if crop is not None:
        if np.shape(crop) != (2, 2):
            raise ValueError(f"{argument('crop')}: {shown(crop)}; ((first column, end), (first row, end)) is needed")
        crop = [[whole_number("crop", point, at_least=0) for point in pair] for pair in crop]
        for (first, end), size, name in zip(crop, heights.shape[::-1], ("columns", "rows"), strict=True):
            if not 0 <= first < end <= size:
                raise ValueError(f"{argument('crop')} to {name} {first}:{end}; within 0:{size} is allowed")
        (left, right), (top, bottom) = crop
        heights = heights[top:bottom, left:right].copy()
    if np.isnan(heights).all():
        raise ValueError(f"no height is left after {argument('nodata')} and {argument('crop')}; at least one is needed")
    if flip:
        np.negative(heights, out=heights)
    if detrend != "none":
        heights = heights - _fitted(heights, indenter.spacing, indenter.row_spacing, detrend)
    if fill == "harmonic":
        heights = _filled(heights, indenter.aspect)
    return Indenter(heights, indenter.spacing, indenter.row_spacing, indenter.length_unit)


def doubts(indenter: Indenter) -> list[str]:
    """Describe tilt, enclosed nan regions, suspicious values and spikes of a map, in one line each."""
    if indenter.heights.ndim != 2 or min(indenter.heights.shape) < 3:
        return []
    heights = indenter.heights
    # Suspicious values cause tilt and spikes, so these are not described as well.
    texts = [*_suspicious_values(heights)] or [*_tilt(indenter), *_spikes(heights)]
    return [*texts, *_holes(heights)]


# ---- mean, plane, sphere


def _fitted(heights: Array, dx: float, dy: float, form: str) -> Array:
    """Return the form (mean, plane or sphere) at the points of a map, fitted by least squares.

    A sphere is fitted by the Gauss-Newton method. All lengths are divided by the distance of the corners from the
    middle, `reach` times the larger spacing.
    """
    (rows, columns), measured, largest = heights.shape, ~np.isnan(heights), max(dx, dy)
    dx, dy = dx / largest, dy / largest  # the size of the map could overflow
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
        slope = squared / (root * (1 + root))  # of the sag with respect to the curvature
        functions = np.concatenate([plane, [slope]])[:, measured]
        tangent = _sag(curvature, squared) - curvature * slope
        values, last = _factors(functions, target - tangent[measured]), curvature
        curvature = float(values[3])
        if not abs(curvature) < _LARGEST_SLOPE:
            raise ValueError(
                f"{argument('detrend', 'sphere')}: the sphere that fits is smaller than the map; crop to a cap of it"
            )
        if abs(curvature - last) <= 1e-12 * abs(curvature):
            break
    return largest * (reach * (np.tensordot(values[:3], plane, 1) + _sag(curvature, squared)))


def _factors(functions: Array, target: Array) -> Array:
    """Return the factors of functions, shape (functions, points), whose weighted sum is closest to the target."""
    return np.linalg.lstsq(functions @ functions.T, functions @ target, rcond=1e-13)[0]


def _sag(curvature: float, squared: Array) -> Array:
    """Return the height of a sphere above its lowest point (k > 0), k r²/(1 + √(1 − k²r²))."""
    return curvature * squared / (1 + np.sqrt(1 - curvature**2 * squared))


def _tilt(indenter: Indenter) -> Iterator[str]:
    """Yield a text if the map is tilted by much more than its roughness explains."""
    heights, measured = indenter.heights, ~np.isnan(indenter.heights)
    plane = _fitted(heights, indenter.spacing, indenter.row_spacing, "plane")[measured]
    rise, rms = np.ptp(plane), np.sqrt(np.mean((heights[measured] - plane) ** 2))
    if rise > _NOTABLE_TILT * rms and rise > 1e-9 * np.nanmax(np.abs(heights)):
        about = (
            f"{rise / rms:.3g} times the rms height about it" if rms > 1e-9 * rise else "and nothing is left about it"
        )
        text = f"the map is tilted: a plane through it rises by {rise:.3g}, {about}"
        yield f"{text}; {argument('detrend', 'plane')} removes it"


# ---- values that mark missing points, spikes


def _suspicious_values(heights: Array) -> Iterator[str]:
    """Yield texts about extreme values that are repeated and far from all other values."""
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
            removes = f"{spelled(f'--nodata {exact}', f'nodata={exact}')} removes"
            yield (
                f"{count} points ({share:.2g} %) have the value {exact}, far from all others ({lowest:g} to "
                f"{highest:g}): if it marks what was not measured, {removes} it"
            )


def _spikes(heights: Array) -> Iterator[str]:
    """Yield a text about single points that are far higher than all their neighbours."""
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
            f"{argument('nodata')} with their values sets those to nan that are artefacts"
        )


# ---- holes


def _enclosed(heights: Array) -> tuple[Mask, int]:
    """Return a mask of all nan regions that do not reach the edge, and their number."""
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
            f"{argument('fill', 'harmonic')} closes them"
        )


def _filled(heights: Array, aspect: float) -> Array:
    """Fill enclosed holes by the five-point Laplace equation: each point is a weighted mean of its four neighbours.

    The weights are 1/dx² along x and 1/dy² along y.

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
