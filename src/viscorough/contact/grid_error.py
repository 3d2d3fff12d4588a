"""Estimate the error due to the spacing of a map, from its loading curve and the curve of every second point.

A map contains no roughness between its points. The loading curve would change if the spacing of the map were halved
again and again. This change is estimated from the change of the curve when the spacing is doubled. In a fluid of
viscosity η the velocity at the force F is v = F/(η k/G), with the stiffness k and the shear modulus G. At equal forces,
the ratio of two velocities therefore follows from the stiffnesses. The errors at a level are estimated as follows. The
index 2 denotes the curve of every second point, and ⟨·⟩ the mean over all forces within half a decade of the level,
uniform in ln F:

    error of the velocity:          s √⟨ln²(v/v₂)⟩     v and v₂ at equal force; s = SAFETY_FACTOR
    error of the force:             r √⟨(1 − F₂/F)²⟩   F and F₂ at equal depth; r = FORCE_SAFETY_FACTOR
    change of the contact area A:   exp⟨ln(A/A₂)⟩ − 1  A and A₂ at equal force

The contact area of a self-affine surface decreases with the spacing without a limit, so its change is no error. For F₂,
the depth is counted from the highest point of the full map, which the coarse map usually misses. If the depth were
counted from the highest point of the coarse map, the error of the force would be four times as large.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from viscorough.basics.types import Array
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter

# Estimated error of the velocity, divided by the difference between the velocities on the curves of all points and of
# every second point. On most surfaces the difference alone exceeds the true error. With this factor, the estimate
# exceeded the deviation from a map sampled four times finer on nine of ten discs.
SAFETY_FACTOR = 1.3
# Estimated error of the force, divided by the difference between the forces at equal depth on the curves of all points
# and of every second point. This factor is larger than the factor for the velocity. If the spacing is halved
# repeatedly, the force changes in the same direction each time, above all on surfaces of small Hurst exponent. The
# changes of the force therefore add up to more than the changes of the velocity.
FORCE_SAFETY_FACTOR = 3.0
# Two curves are compared at this number of points per decade of force. Many points are needed, because the stiffness
# jumps whenever an element touches.
_POINTS_PER_DECADE = 50
# The error at a level is a mean over all forces within half a decade of the force F of the level. This constant is half
# a decade in ln F.
_HALF_WINDOW = 0.5 * np.log(10)
# Means over a whole curve begin at this reduced force X = F/(4GhL), where h is the rms height and L the diameter of the
# map. Smaller forces are carried by a few summits, which coarse grids cannot represent.
_LEAST_X = 0.01
# Means over a whole curve begin at the latest at this share of the largest force of the curve.
_LEAST_RANGE = 0.1


def every_nth_point(indenter: Indenter, step: int) -> Indenter:
    """Return the map of every n-th point of every n-th row, for n = `step`; its spacings are n times as large.

    Raises ValueError if all points of the coarser map are nan, or if it has fewer than two rows or columns.
    """
    heights = indenter.heights[::step, ::step]
    if min(heights.shape) < 2 or np.isnan(heights).all():
        rows, columns = indenter.heights.shape
        text = f"every n-th point, n = {step}, of a map of {rows} x {columns} points is no map with heights"
        raise ValueError(f"grid error: {text}; larger maps are needed")
    return Indenter(heights, step * indenter.spacing, step * indenter.row_spacing, indenter.length_unit)


def highest_missed(indenter: Indenter, coarse: Indenter) -> float:
    """Return the height of the highest point of a map above the highest point of a coarser map [length]."""
    return float(np.nanmax(indenter.heights)) - float(np.nanmax(coarse.heights))


def lowest_force(indenter: Indenter, last_force: float) -> float:
    """Return the smallest force F/G that contributes to means over a whole curve [length²].

    The returned force is F = 0.01 · 4GhL, but at most a tenth of the last force of the curve. Here h is the rms height
    of the map, and L the diameter of a disc with the area of the map.

    last_force : F/G at the end of the curve [length²]
    """
    area = indenter.elements * indenter.spacing * indenter.row_spacing
    diameter = 2 * np.sqrt(area / np.pi)
    return float(min(4 * _LEAST_X * np.nanstd(indenter.heights, dtype=float) * diameter, _LEAST_RANGE * last_force))


def with_grid_errors(curve: LoadingCurve, coarse: LoadingCurve, indenter: Indenter, missed: float) -> LoadingCurve:
    """Return a curve together with the estimated errors due to the spacing of its map.

    curve : loading curve of a map
    coarse : loading curve of every second point of the map; it is continued as a straight line beyond its last level
    indenter : map whose rms height and area determine the smallest force for mean errors (see `lowest_force`)
    missed : height of the highest point of the map above the highest point of the coarse map [length]
    """
    levels = np.log(curve.force)
    points = _points(levels[0], levels[-1])
    force = _forces(points, curve)
    depth, stiffness = curve.at_force(force)
    coarse_stiffness = coarse.at_force(np.minimum(force, coarse.force[-1]))[1]
    velocity = np.log(coarse_stiffness / stiffness) ** 2
    lost = (1 - _force_at_depth(coarse, depth - missed) / force) ** 2
    # An element of the coarse map has four times the area.
    area = np.log(_contact_count(curve, force) / (4 * _contact_count(coarse, force)))
    window = np.maximum(levels - _HALF_WINDOW, levels[0]), np.minimum(levels + _HALF_WINDOW, levels[-1])
    whole = np.log(max(lowest_force(indenter, curve.force[-1]), curve.force[0])), levels[-1]
    return replace(
        curve,
        grid_error=SAFETY_FACTOR * np.sqrt(_means(points, velocity, *window)),
        force_grid_error=FORCE_SAFETY_FACTOR * np.sqrt(_means(points, lost, *window)),
        area_change=np.expm1(_means(points, area, *window)),
        mean_grid_error=SAFETY_FACTOR * float(np.sqrt(_means(points, velocity, *whole))),
        mean_area_change=float(np.expm1(_means(points, area, *whole))),
    )


def _points(first: float, last: float) -> Array:
    """Return equidistant values of ln F from `first` to `last`, at which curves are compared."""
    return np.linspace(first, last, 2 + int(_POINTS_PER_DECADE * (last - first) / np.log(10)))


def _forces(points: Array, curve: LoadingCurve) -> Array:
    """Return the forces F for given values of ln F. Rounding does not move a force beyond the ends of the curve."""
    return np.clip(np.exp(points), curve.force[0], curve.force[-1])


def _means(points: Array, values: Array, low: Any, high: Any) -> Any:
    """Return the mean of a piecewise linear function between `low` and `high`, or its value there if low = high.

    points, values : function values at the points, between which the function is linear
    low, high : ends of the interval, within the range of the points; numbers or arrays of equal shape
    """
    integrals = np.append(0.0, np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(points)))
    width = high - low
    mean = (np.interp(high, points, integrals) - np.interp(low, points, integrals)) / np.where(width > 0, width, 1.0)
    return np.where(width > 0, mean, np.interp(low, points, values))


def _force_at_depth(curve: LoadingCurve, depth: Array) -> Array:
    """Return the force F/G at each depth; the force is 0 for depths below 0.

    Before its first level the curve is a straight line from the origin. Beyond its last level it continues along its
    tangent. Elsewhere, the force is interpolated as a power law of the depth between closely spaced points of the
    curve, which takes far less time than `LoadingCurve.at_depth`.
    """
    force = _forces(_points(*np.log(curve.force[[0, -1]])), curve)
    log_depth = np.log(np.clip(depth, curve.depth[0], curve.depth[-1]))
    within = np.exp(np.interp(log_depth, np.log(curve.at_force(force)[0]), np.log(force)))
    before = curve.force[0] / curve.depth[0] * np.maximum(depth, 0.0)
    beyond = within + curve.stiffness[-1] * (depth - curve.depth[-1])
    return np.select([depth < curve.depth[0], depth > curve.depth[-1]], [before, beyond], within)


def _contact_count(curve: LoadingCurve, force: Array) -> Array:
    """Return the number of elements in contact at each force; between levels it is a power law of the force."""
    return np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.contact_count)))
