"""Choose the coarsest sampling of a map and the loosest tolerance that meet a requested error.

1. Choose the tolerance: it may use a part of the error.
2. Compute the curve on every n-th point of the map, with n a power of two, from coarse to fine. Compare it with the
   curve before, on half as many points in each direction (grid_error).
3. Stop when the estimated error is within the request, or at the full map.

The last curve costs most: the curve before, on a quarter of the points, takes about a quarter of its time.
"""

import warnings
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Progress
from viscorough.contact.grid_error import every_nth_point, highest_missed, ordinal, with_grid_errors
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter

# A tolerance t causes an error of this number times √t in the velocity on a given grid, as root mean square over all
# forces: 1 % at t = 1e-2, and 2 to 4 % at t = 0.1 (self-affine discs of 129 to 513 elements across, H = 0.2 to 0.8). It
# grows as √t because k jumps at contact events, which loose tolerances do not resolve.
_ERROR_PER_ROOT = 0.12
# Share of the requested error that the tolerance may cause. Independent errors add in squares: 92 % are left to the
# grid.
_SHARE_OF_TOLERANCE = 0.4
_LOOSEST_TOLERANCE = 0.1
# Smallest number of points across a map in the coarsest sampling: with fewer, grids agree by chance.
_FEWEST_POINTS = 16
# Smallest number of points that are not nan, for the same reason.
_FEWEST_ELEMENTS = 100

Compute = Callable[[Indenter, float, Progress], LoadingCurve]


def curve_within(error: float, indenter: Indenter, compute: Compute, progress: Progress) -> LoadingCurve:
    """Return the LoadingCurve of a map within an error of the velocity; its depths count from the highest point of all.

    error : relative, root mean square over the forces from grid_error.lowest_force on
    compute : function of a map, a tolerance and a Progress that returns the curve
    progress : function of the finished share
    """
    tolerance, steps = tolerance_for(error), _steps(indenter)
    ends = np.cumsum([0.0, *(1.0 / step**2 for step in steps)])
    ends /= ends[-1]
    sampled = every_nth_point(indenter, steps[0])
    curve = compute(sampled, tolerance, part_of(progress, *ends[:2]))
    before = np.inf
    for step, start, end in zip(steps[1:], ends[1:], ends[2:], strict=True):
        coarse, coarse_map, sampled = curve, sampled, every_nth_point(indenter, step)
        curve = compute(sampled, tolerance, part_of(progress, start, end))
        curve = with_grid_errors(curve, coarse, indenter, highest_missed(sampled, coarse_map))
        estimate = float(curve.mean_grid_error or 0.0)
        if estimate <= error or step == 1:
            break
        before = estimate
    if estimate > error:
        text = f"an error of {_percent(error)} is out of reach of this map: the estimated error of its grid is"
        warnings.warn(f"indent: {text} {_percent(estimate)}; a finer scan is needed", AccuracyWarning, 3)
    choice = _choice(indenter, sampled, step, tolerance)
    choice += f": estimated error {_percent(estimate)}, {'within' if estimate <= error else 'above'} the requested "
    choice += _percent(error)
    if np.isfinite(before):
        choice += f"; on every {ordinal(2 * step)} point it is {_percent(before)}"
    return replace(curve, depth=curve.depth + highest_missed(indenter, sampled), sampling=step, choice=choice)


def tolerance_for(error: float) -> float:
    """Return the loosest tolerance for an error of the velocity: the tolerance may cause a part of it."""
    return min((_SHARE_OF_TOLERANCE * error / _ERROR_PER_ROOT) ** 2, _LOOSEST_TOLERANCE)


def part_of(progress: Progress, start: float, end: float) -> Progress:
    """Return the Progress of a part of a computation, from the share `start` to the share `end`."""
    return lambda done: progress(float(start + done * (end - start)))


def _steps(indenter: Indenter) -> list[int]:
    """Return the steps n of the samplings, powers of two, from coarse to fine."""
    step = 2
    while (
        min(indenter.heights.shape) >= 2 * step * _FEWEST_POINTS
        and np.count_nonzero(~np.isnan(indenter.heights[:: 2 * step, :: 2 * step])) >= _FEWEST_ELEMENTS
    ):
        step *= 2
    return [2**power for power in range(step.bit_length() - 1, -1, -1)]


def _choice(indenter: Indenter, sampled: Indenter, step: int, tolerance: float) -> str:
    """Return the sampling and the tolerance as a text."""
    full, chosen = (" x ".join(map(str, each.heights.shape)) for each in (indenter, sampled))
    points = f"all {full} points" if step == 1 else f"every {ordinal(step)} point, {chosen} of {full},"
    return f"{points} and a tolerance of {tolerance:.2g}"


def _percent(error: float) -> str:
    return f"{100 * error:.2g} %"
