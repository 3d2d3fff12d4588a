"""Compute a loading curve within a requested error, from few points of the map and to a loose tolerance.

1. Choose the tolerance so that it causes only a part of the requested error.
2. Compute the curve on every n-th point of the map, beginning with a large step n, a power of two.
3. Halve n, compute the curve again, and estimate its error by a comparison with the previous curve (see grid_error).
4. Repeat step 3 until the estimated error is within the requested error, or n = 1.

Most of the time is spent on the last curve: the previous curve has a quarter of the points and takes about a quarter of
the time.
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

# On a given grid, a tolerance t causes a relative error of the velocity of this number times √t, as root mean square
# over all forces. The measured error was 1 % at t = 1e-2, and 2 to 4 % at t = 0.1 (self-affine discs of 129 to 513
# elements across, H = 0.2 to 0.8). The error grows as √t because the stiffness jumps whenever an element touches, and
# loose tolerances do not resolve these jumps.
_ERROR_PER_ROOT = 0.12
# Share of the requested error that the tolerance may cause. The squares of independent errors add up, so a share of
# √(1 − 0.4²) = 92 % is left for the error of the grid.
_SHARE_OF_TOLERANCE = 0.4
# Largest tolerance that is chosen, however large the requested error is.
_LOOSEST_TOLERANCE = 0.1
# The map of every n-th point is used for n above 2 only if it has at least this number of rows and of columns. On
# smaller maps, two curves can agree by chance.
_FEWEST_POINTS = 16
# The map of every n-th point is used for n above 2 only if at least this number of its points are not nan. On fewer
# points, two curves can agree by chance.
_FEWEST_ELEMENTS = 100

# Function that computes the loading curve of a map to a tolerance and reports its progress.
Compute = Callable[[Indenter, float, Progress], LoadingCurve]


def curve_within(error: float, indenter: Indenter, compute: Compute, progress: Progress) -> LoadingCurve:
    """Return the LoadingCurve of a map within a requested error of the velocity.

    The curve may be computed on every n-th point of the map. Depths are counted from the highest point of the full map.
    If the estimated error exceeds the requested error even on the full map, an AccuracyWarning is given.

    error : requested relative error, as root mean square over the forces from `grid_error.lowest_force` on
    indenter : full map
    compute : function of a map, a tolerance and a Progress that returns the LoadingCurve of this map
    progress : function that is called with the finished share of the computation
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
    """Return the loosest tolerance that causes at most the share _SHARE_OF_TOLERANCE of a requested velocity error."""
    return min((_SHARE_OF_TOLERANCE * error / _ERROR_PER_ROOT) ** 2, _LOOSEST_TOLERANCE)


def part_of(progress: Progress, start: float, end: float) -> Progress:
    """Return a function that reports the progress of a part of a computation.

    The returned function takes the finished share of the part, from 0 to 1.

    progress : function that takes the finished share of the whole computation
    start, end : shares of the whole computation that are finished at the start and at the end of the part
    """
    return lambda done: progress(float(start + done * (end - start)))


def _steps(indenter: Indenter) -> list[int]:
    """Return the steps n for which the curve of every n-th point is computed: decreasing powers of two, down to 1."""
    step = 2
    while (
        min(indenter.heights.shape) >= 2 * step * _FEWEST_POINTS
        and np.count_nonzero(~np.isnan(indenter.heights[:: 2 * step, :: 2 * step])) >= _FEWEST_ELEMENTS
    ):
        step *= 2
    return [2**power for power in range(step.bit_length() - 1, -1, -1)]


def _choice(indenter: Indenter, sampled: Indenter, step: int, tolerance: float) -> str:
    """Return a text that states the sampling and the tolerance.

    indenter, sampled : full map, and map of every n-th point with n = `step`
    """
    full, chosen = (" x ".join(map(str, each.heights.shape)) for each in (indenter, sampled))
    points = f"all {full} points" if step == 1 else f"every {ordinal(step)} point, {chosen} of {full},"
    return f"{points} and a tolerance of {tolerance:.2g}"


def _percent(error: float) -> str:
    return f"{100 * error:.2g} %"
