"""Estimate the error of the grid: compare the loading curve of a map with the curve on every second point of it.

A map contains no roughness between its points. The change of a curve when the spacing doubles estimates its change when
the spacing is halved, and the sum of all further changes. At equal forces F the velocities v = F/(η k/G) of both curves
have the ratio of the stiffnesses. With ⟨·⟩ the mean over half a decade of force to either side, uniform in ln F,

    velocity:  s √⟨ln²(v/v₂)⟩          v₂ on every second point, s a safety factor
    force:     r √⟨(1 − F₂/F)²⟩        F₂ at the depth of F, counted from the highest point of the full map; r a factor
    area:      exp⟨ln(A/A₂)⟩ − 1       the change of the contact area when the spacing is halved; not an error

The raw contact area of a self-affine surface decreases with the spacing without a limit, so it has no error. A coarse
map misses the highest point: if its depth were counted from its own highest point, the error of the force would be four
times as large.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from viscorough.basics.types import Array
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter

# The difference from the curve on every second point exceeds the true error of most surfaces. With this factor it
# exceeds the error of nine surfaces of ten (benchmarks/grid_errors.py).
SAFETY_FACTOR = 1.3
# The same factor for the force at a given depth. The force changes in one direction from spacing to spacing, above all
# on surfaces of small Hurst exponent, so its changes add up to more than the changes of the velocity.
FORCE_SAFETY_FACTOR = 3.0
# Points per decade of force in comparisons of two curves, whose stiffnesses jump at contact events.
_POINTS_PER_DECADE = 50
# Half the width, in ln F, of the range of forces for averages of differences: half a decade.
_HALF_WINDOW = 0.5 * np.log(10)
# Smallest normalised force X = F/(4GhL) for means over a curve: a few summits carry a smaller force, and coarse grids
# cannot represent them.
_LEAST_X = 0.01
# A curve that ends at a small force is judged by this part of it.
_LEAST_RANGE = 0.1


def every_nth_point(indenter: Indenter, step: int) -> Indenter:
    """Return the map of the points 0, n, 2n, … of every n-th row, at n times the spacings.

    Raises ValueError if no point is left, or fewer than two rows or columns.
    """
    if step == 1:
        return indenter
    heights = indenter.heights[::step, ::step]
    if min(heights.shape) < 2 or np.isnan(heights).all():
        rows, columns = indenter.heights.shape
        text = f"every {ordinal(step)} point of a map of {rows} x {columns} points is no map with heights"
        raise ValueError(f"grid error: {text}; larger maps are needed")
    return Indenter(heights, step * indenter.spacing, step * indenter.row_spacing, indenter.length_unit)


def ordinal(number: int) -> str:
    """Return a number as it counts, such as "2nd" or "4th"."""
    ending = {1: "st", 2: "nd", 3: "rd"}.get(number % 10, "th") if number // 10 % 10 != 1 else "th"
    return f"{number}{ending}"


def highest_missed(indenter: Indenter, coarse: Indenter) -> float:
    """Return the height of the highest point of a map above the highest point of a coarser map [length]."""
    return float(np.nanmax(indenter.heights)) - float(np.nanmax(coarse.heights))


def lowest_force(indenter: Indenter, last_force: float) -> float:
    """Return the smallest F/G of means over a curve [length²].

    It is X = F/(4GhL) = 0.01, with the rms height h of the map and the diameter L of a disc of its area, or a tenth of
    the last force if this is smaller.
    """
    area = indenter.elements * indenter.spacing * indenter.row_spacing
    diameter = 2 * np.sqrt(area / np.pi)
    return float(min(4 * _LEAST_X * np.nanstd(indenter.heights, dtype=float) * diameter, _LEAST_RANGE * last_force))


def with_grid_errors(curve: LoadingCurve, coarse: LoadingCurve, indenter: Indenter, missed: float) -> LoadingCurve:
    """Return a curve with the estimated errors of its grid.

    curve, coarse : curve on a map, and on every second point of it; the coarse curve is straight beyond its last level
    indenter : map for `lowest_force`
    missed : `highest_missed` of the two maps
    """
    levels = np.log(curve.force)
    points = _points(levels[0], levels[-1])
    force = _forces(points, curve)
    depth, stiffness = curve.at_force(force)
    coarse_stiffness = coarse.at_force(np.minimum(force, coarse.force[-1]))[1]
    velocity = np.log(coarse_stiffness / stiffness) ** 2
    lost = (1 - _force_at_depth(coarse, depth - missed) / force) ** 2
    area = np.log(_contact_count(curve, force) / (4 * _contact_count(coarse, force)))  # larger elements
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
    """Return equidistant points from first to last for the comparison of curves."""
    return np.linspace(first, last, 2 + int(_POINTS_PER_DECADE * (last - first) / np.log(10)))


def _forces(points: Array, curve: LoadingCurve) -> Array:
    """Return forces at the points ln F, without rounding beyond the ends of the curve."""
    return np.clip(np.exp(points), curve.force[0], curve.force[-1])


def _means(points: Array, values: Array, low: Any, high: Any) -> Any:
    """Return means from `low` to `high` of values that are linear between the points; the value itself if low = high.

    low, high : ends within the points, numbers or arrays of equal shape
    """
    integrals = np.append(0.0, np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(points)))
    width = high - low
    mean = (np.interp(high, points, integrals) - np.interp(low, points, integrals)) / np.where(width > 0, width, 1.0)
    return np.where(width > 0, mean, np.interp(low, points, values))


def _force_at_depth(curve: LoadingCurve, depth: Array) -> Array:
    """Return the force at depths, 0 above the first contact; beyond its ends the curve is straight.

    The power law between forces at close distances takes far less time than `LoadingCurve.at_depth`.
    """
    force = _forces(_points(*np.log(curve.force[[0, -1]])), curve)
    log_depth = np.log(np.clip(depth, curve.depth[0], curve.depth[-1]))
    within = np.exp(np.interp(log_depth, np.log(curve.at_force(force)[0]), np.log(force)))
    before = curve.force[0] / curve.depth[0] * np.maximum(depth, 0.0)
    beyond = within + curve.stiffness[-1] * (depth - curve.depth[-1])
    return np.select([depth < curve.depth[0], depth > curve.depth[-1]], [before, beyond], within)


def _contact_count(curve: LoadingCurve, force: Array) -> Array:
    """Return the number of elements in contact at forces, a power law of the force between the levels."""
    return np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.contact_count)))
