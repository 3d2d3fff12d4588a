"""Compute a loading curve within a requested error, from few points of the map and to a loose tolerance.

1. Choose the tolerance so that it causes only a part of the requested error.
2. Compute the curve on every n-th point of the map, beginning with a large step n, a power of two.
3. Halve n, compute the curve again, and estimate its error by a comparison with the previous curve (see grid_error).
4. If the estimate is within the requested error, solve a few contacts of the full map, and compare them with the curve.
   They detect features that both samplings miss, such as a spike, or that both misrepresent, such as a fine texture.
   The depths at these contacts also detect jumps of the stiffness between them that lie at other forces on the curve.
5. Repeat steps 3 and 4 until estimate and comparison are within the requested error, or n = 1.

Most of the time is spent on the last curve and on the contacts of the full map: the previous curve has a quarter of the
points and takes about a quarter of the time.
"""

import warnings
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, Progress
from viscorough.contact.grid_error import every_nth_point, highest_missed, lowest_force, ordinal, with_grid_errors
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.state import ContactState
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
# A tolerance is relative to the depth. It is reduced if the depth at light loads exceeds this multiple of the rms
# height, as under a spike, since the roughness below the spike would otherwise be lost.
_DEPTH_OVER_RMS = 3.0
# Largest tolerance that is chosen, however large the requested error is.
_LOOSEST_TOLERANCE = 0.1
# The map of every n-th point is used for n above 2 only if it has at least this number of rows and of columns. On
# smaller maps, two curves can agree by chance.
_FEWEST_POINTS = 16
# The map of every n-th point is used for n above 2 only if at least this number of its points are not nan. On fewer
# points, two curves can agree by chance.
_FEWEST_ELEMENTS = 100
# Number of contacts of the full map that are compared with a curve, and position of the last of them in the range of
# ln F from the lowest force of mean errors (0) to the end of the curve (1). Missed features cause the largest
# differences at light loads, because they touch first, and fine textures at middle loads.
_CONTACTS, _LAST_CONTACT = 2, 0.35
# Largest tolerance of the contacts of the full map. To a looser tolerance, their contact fractions are a few percent
# too large, so that the curve would end too early.
_CONTACT_TOLERANCE = 1e-2
# Largest number of contacts that are added if the first do not suffice for a decision.
_FURTHER_CONTACTS = 4
# A contact at lighter load is added if ln F of the lightest contact exceeds ln F of the lowest force by more than this.
_LARGEST_GAP = 0.2
# A curve is accepted if it differs from the contacts of the full map by at most this share of the requested error. The
# rest is left for the forces between the contacts.
_WITHIN = 0.7
# Curves are compared at forces from this share of their last force on, if the rms height is 0.
_LEAST_RANGE = 1e-3
# Number of forces from which the depths of the contacts are interpolated, and of forces between two contacts at which
# the curve is evaluated.
_POINTS, _POINTS_BETWEEN = 200, 65
# A coarser map reaches a contact fraction at a smaller force. So a curve that is to end at a contact fraction of the
# full map is computed up to this multiple of the force at which the next coarser map reaches it.
_BEYOND_COARSER = 1.7
# Ratios of successive depths at which the end of the curve is searched for on the full map, if the curve ends too
# early. Small ratios come first, since long steps would lead far beyond the end. If no depth suffices, the curve ends
# at complete contact.
_RATIOS_TO_THE_END = 1.0, 1.1, 1.3, 1.5, *[2.0] * 10
# Work for contacts of the full map, relative to its whole curve. It only affects the reported progress.
_SHARE_OF_CONTACTS = 0.2
# Names of the quantities of a LoadingCurve that have a value for each level.
_LEVELS = "depth", "force", "stiffness", "contact_count", "residual", "grid_error", "force_grid_error", "area_change"
# Relative difference of two forces that may be due to rounding.
_ROUNDING = 1e-9

# Function that computes the loading curve of a map to a tolerance, up to a contact fraction or F/G [length²], whichever
# comes first, and reports its progress.
Compute = Callable[[Indenter, float, float, float, Progress], LoadingCurve]


def curve_within(
    error: float,
    indenter: Indenter,
    until_fraction: float,
    until_force: float,
    *,
    compute: Compute,
    solver: Callable[[float], ContactSolver],
    progress: Progress,
) -> LoadingCurve:
    """Return the LoadingCurve of a map within a requested error of the velocity.

    The curve may be computed on every n-th point of the map. Depths are counted from the highest point of the full map,
    and the contact fraction at the end of the curve refers to the full map. If the estimated error exceeds the
    requested error even on the full map, an AccuracyWarning is given.

    error : requested relative error, as root mean square over the forces from `grid_error.lowest_force` on
    indenter : full map
    until_fraction : largest contact fraction of the full map
    until_force : largest F/G of the curve [length²]
    compute : function that computes the LoadingCurve of a map
    solver : function of a tolerance that returns a ContactSolver of the full map
    progress : function that is called with the finished share of the computation
    """
    tolerance, steps = tolerance_for(error), _steps(indenter)
    ends = np.cumsum([0.0, *(1.0 / step**2 for step in steps[:-1]), 1.0 + _SHARE_OF_CONTACTS])
    ends /= ends[-1]
    sampled = every_nth_point(indenter, steps[0])
    curve = compute(sampled, tolerance, until_fraction, until_force, part_of(progress, *ends[:2]))
    tolerance *= _share_of_depth(indenter, curve, sampled)
    full_map = _FullMap(indenter, solver(min(tolerance, _CONTACT_TOLERANCE)))
    last_force, is_last, rejected = until_force, False, ""
    for step, start, end in zip(steps[1:-1], ends[1:], ends[2:], strict=False):
        coarse, coarse_map, sampled = curve, sampled, every_nth_point(indenter, step)
        missed = highest_missed(sampled, coarse_map)
        if not is_last:
            last_force = min(_BEYOND_COARSER * _force_at_fraction(coarse, until_fraction), until_force)
        curve = compute(sampled, tolerance, 1.0, last_force, part_of(progress, start, end))
        curve = with_grid_errors(curve, coarse, indenter, missed)
        estimate = curve.mean_grid_error or 0.0
        rejected = f"; on every {ordinal(step)} point it is {_percent(estimate)}"
        if estimate > error:
            continue
        if not is_last:
            is_last, reached = True, full_map.last_force(curve, sampled, until_fraction, until_force)
            if reached > curve.force[-1]:
                last_force = reached
                curve = compute(sampled, tolerance, 1.0, last_force, part_of(progress, end, end))
                curve = with_grid_errors(curve, coarse, indenter, missed)
                estimate = curve.mean_grid_error or 0.0
        completed = full_map.completed(curve, sampled, last_force)
        difference, is_within = full_map.compare(completed, error)
        if is_within and estimate <= error:
            choice = f"every {ordinal(step)} point, {_size(sampled)} of {_size(indenter)}, and {_stated(tolerance)}"
            choice += f": estimated error {_percent(estimate)}, within the requested {_percent(error)}"
            choice += f"; contacts of all points differ by {_percent(difference)}"
            return replace(completed, sampling=step, choice=choice)
        rejected = f"; on every {ordinal(step)} point, contacts of all points differ by {_percent(difference)}"
    del full_map  # frees its memory for the curve of the full map
    whole = compute(indenter, tolerance, until_fraction, until_force, part_of(progress, *ends[-2:]))
    whole = with_grid_errors(whole, curve, indenter, highest_missed(indenter, sampled))
    estimate = whole.mean_grid_error or 0.0
    if estimate > error:
        text = f"an error of {_percent(error)} is out of reach of this map: the estimated error of its grid is"
        warnings.warn(f"indent: {text} {_percent(estimate)}; a finer scan is needed", AccuracyWarning, 3)
    choice = f"all {_size(indenter)} points and {_stated(tolerance)}: estimated error {_percent(estimate)}, "
    choice += f"{'within' if estimate <= error else 'above'} the requested {_percent(error)}"
    return replace(whole, choice=choice + rejected)


class _FullMap:
    """Contacts of the full map, with which curves of every n-th point are compared.

    Contacts are solved when they are first needed, and are kept for later comparisons.
    """

    def __init__(self, indenter: Indenter, solver: ContactSolver) -> None:
        self._indenter, self._solver = indenter, solver
        self._contacts: list[_ContactValues] = []
        self._reaches_light_loads = False

    @cached_property
    def _first(self) -> ContactState:
        """Return the contact at the end of the straight first part of the curve."""
        return self._solver.first_contact()

    def last_force(self, curve: LoadingCurve, sampled: Indenter, until_fraction: float, until_force: float) -> float:
        """Return the force F/G at which the curve must end to reach a contact fraction of the full map.

        This is the last force of the curve, if the full map reaches the contact fraction at its last depth. The
        returned force does not exceed `until_force`.

        curve : curve of `sampled`
        """
        if curve.force[-1] >= until_force or self._solver.is_flat:
            return until_force
        contact, depth = self._solver.unloaded_state(), curve.depth[-1] + highest_missed(self._indenter, sampled)
        for ratio in _RATIOS_TO_THE_END if until_fraction < 1 else ():
            depth *= ratio
            contact = self._solver.advance(contact, depth)
            if contact.count >= until_fraction * self._solver.elements.count:
                self._contacts.append(_ContactValues.of(contact))
                return float(curve.force[-1]) if ratio == 1 else min(contact.force, until_force)
        return min(self._solver.solve_complete_contact().force, until_force)

    def completed(self, curve: LoadingCurve, sampled: Indenter, last_force: float) -> LoadingCurve:
        """Return the curve of a sampled map with depths from the highest point of the full map, and with both ends.

        - If the sampling misses the highest elements of the full map, these alone carry the load at first. The curve
          then begins with the first level of the full map. The first levels of the sampled map are left out if they
          are less stiff than the highest elements.
        - If the sampled map is in complete contact before the last force, a level is added on the straight line that
          leads to this force.
        """
        missed = highest_missed(self._indenter, sampled)
        levels = {name: getattr(curve, name) for name in _LEVELS if getattr(curve, name) is not None}
        levels["depth"] = levels["depth"] + missed
        if missed > 0:
            levels = _with_first_level(levels, self._first.depth, self._first.force)
        if curve.contact_count[-1] == curve.elements and curve.force[-1] * (1 + _ROUNDING) < last_force < np.inf:
            levels = {name: np.append(values, values[-1]) for name, values in levels.items()}
            levels["depth"][-1] += (last_force - curve.force[-1]) / curve.stiffness[-1]
            levels["force"][-1] = last_force
        return replace(curve, **levels)

    def compare(self, curve: LoadingCurve, error: float) -> tuple[float, bool]:
        """Return the difference of a curve from the full map, and whether it is within a requested error.

        The difference is the relative difference of the velocity, as root mean square over the range of ln F in which
        the requested error is defined. Its square is linear between the contacts, apart from the part that
        `_hidden_between` adds. Further contacts are solved where they matter most, until the larger of two neighbouring
        differences could take its place without changing the decision.
        """
        largest = curve.force[-1]
        lowest = lowest_force(self._indenter, largest) or _LEAST_RANGE * largest
        first, last = np.log(lowest), np.log(largest)
        if not self._reaches_light_loads:
            self._solve(_depths_to_compare(curve, first, first + _LAST_CONTACT * (last - first)))
            self._reaches_light_loads = True
        for further in range(_FURTHER_CONTACTS + 1):
            self._contacts.sort()
            depth, force, stiffness = np.array(self._contacts).T
            difference = np.log(stiffness / curve.at_force(np.minimum(force, largest))[1])
            square = difference**2
            # Outside the range of the contacts, the difference equals the difference in the first or the last contact.
            points = np.clip(np.log(force), first, last)
            width, ends = np.diff(points), (points[0] - first) * square[0] + (last - points[-1]) * square[-1]
            linear, upper = width * (square[1:] + square[:-1]) / 2, width * np.maximum(square[1:], square[:-1])
            hidden = _hidden_between(curve, depth, force, difference)
            least, mean, most = (
                float(np.sqrt((parts.sum() + ends) / (last - first)))
                for parts in (linear, linear + hidden, upper + hidden)
            )
            lacks_light_loads = points[0] - first > _LARGEST_GAP
            is_decided = most <= _WITHIN * error and not lacks_light_loads
            if least > error or is_decided or further == _FURTHER_CONTACTS:
                break
            if lacks_light_loads:
                # Assume F ∝ u² for the depth u, as for a cone.
                self._solve(depth[:1] * np.exp(0.5 * (first - points[0])))
            else:
                between = int(np.argmax(upper - linear + hidden))
                self._solve(0.5 * (depth[between : between + 1] + depth[between + 1]))
        return mean, mean <= _WITHIN * error

    def _solve(self, depths: Array) -> None:
        """Solve contacts of the full map at increasing depths [length], and keep their values."""
        contact = self._solver.unloaded_state()
        for depth in depths:
            contact = self._solver.advance(contact, float(depth))
            self._contacts.append(_ContactValues.of(contact))


class _ContactValues(NamedTuple):
    """Depth u [length], force F/G [length²] and stiffness k/G [length] of a contact."""

    depth: float
    force: float
    stiffness: float

    @classmethod
    def of(cls, contact: ContactState) -> "_ContactValues":
        return cls(contact.depth, contact.force, contact.stiffness)


def _depths_to_compare(curve: LoadingCurve, first: float, last: float) -> Array:
    """Return depths of a curve at which to compare it, at equal steps of ln F + ln k with the force F and stiffness k.

    Equal steps of ln F alone could miss the forces just after many elements have touched.

    first, last : ln F at the first and at the last depth
    """
    force = np.exp(np.linspace(first, last, _POINTS))
    depth, stiffness = curve.at_force(force)
    way = np.log(force) + np.log(stiffness)
    return np.interp(np.linspace(way[0], way[-1], _CONTACTS), way, depth)


def _hidden_between(curve: LoadingCurve, depth: Array, force: Array, difference: Array) -> Array:
    """Return ∫d² dlnF for differences d of the velocity that only the depths of contacts of the full map show.

    Depth u and force F determine ∫dF/k of the full map between two contacts, where k is the stiffness. Let R be the
    part of this integral that the curve, corrected by the differences at both contacts, misses. R is due to a relative
    difference of 1/k, or to jumps of k at other forces, as on stepped surfaces. In the second case the curve is shifted
    in ln F by R/(g₂ − g₁), where g = u − F/k is the depth at which the tangent of the curve at a contact has no force.
    The larger of the two integrals is returned for each pair of neighbouring contacts.

    curve : curve that is compared with the full map
    depth, force : depth and force of the contacts, in increasing order
    difference : ln k of the full map minus ln k of the curve at the force of each contact
    """
    inside = np.clip(force, curve.force[0], curve.force[-1])
    low, high = inside[:-1, None], inside[1:, None]
    share = np.linspace(0, 1, _POINTS_BETWEEN)
    points = np.log(low) + share * np.log(high / low)
    forces = np.clip(np.exp(points), low, high)
    stiffness = curve.at_force(forces)[1]
    at_depth, at_stiffness = curve.at_force(inside)
    at_depth = at_depth + (force - inside) / at_stiffness
    linear = difference[:-1, None] + share * np.diff(difference)[:, None]
    rise, width = np.diff(at_depth), points[:, -1] - points[:, 0]
    missing = np.abs(np.diff(depth) - rise - np.trapezoid(np.expm1(-linear) / stiffness, forces, axis=1))
    uniform = width * np.divide(missing, rise, out=np.zeros_like(rise), where=rise > 0) ** 2
    gaps = np.diff(at_depth - force / at_stiffness)
    shift = np.divide(missing, gaps, out=width.copy(), where=missing < gaps * width)
    largest = uniform
    for moved in (points - shift[:, None], points + shift[:, None]):
        ratio = np.log(curve.at_force(np.clip(np.exp(moved), low, high))[1] / stiffness)
        largest = np.maximum(largest, np.trapezoid(ratio**2, points, axis=1))
    return largest


def _force_at_fraction(curve: LoadingCurve, fraction: float) -> float:
    """Return the force F/G at which a curve reaches a contact fraction, or its last force if it ends before."""
    return float(np.exp(np.interp(fraction, curve.contact_fraction, np.log(curve.force))))


def _with_first_level(levels: dict[str, Array], depth: float, force: float) -> dict[str, Array]:
    """Return the levels of a curve after a straight first part up to a depth u₁ and force F₁.

    The stiffness is F₁/u₁ until it is exceeded by the stiffness of the given curve, but at least up to the depth u₁. So
    all later forces increase by the same amount. Levels before are left out.

    levels : {name of a quantity: its values at all levels}
    depth, force : u₁ [length] and F₁ [length²]
    """
    straight = force / depth
    stiff, at_depth, at_force = levels["stiffness"], levels["depth"], levels["force"]
    follows = (stiff > straight * (1 + _ROUNDING)) & (at_depth > depth * (1 + _ROUNDING))
    start = int(np.argmax(follows)) if follows.any() else stiff.size - 1
    # The stiffness exceeds F₁/u₁ where the tangent at the level `start` meets the tangent before it.
    offset = at_force - stiff * at_depth
    tangent_force, tangent_stiffness = (offset[start - 1], stiff[start - 1]) if start else (0.0, 0.0)
    meeting = (tangent_force - offset[start]) / (stiff[start] - tangent_stiffness)
    meeting = min(max(meeting, depth), at_depth[start])
    after = {name: values[start] for name, values in levels.items()}
    levels = {name: values[start:] for name, values in levels.items()}
    levels["force"] = levels["force"] + (straight * meeting - (offset[start] + stiff[start] * meeting))
    depths = np.array([depth, meeting] if meeting > depth * (1 + _ROUNDING) else [depth])
    first = {name: np.full_like(values[:1], after[name], shape=depths.size) for name, values in levels.items()}
    first |= {"depth": depths, "force": straight * depths, "stiffness": np.full(depths.size, straight)}
    first["contact_count"] = np.ones(depths.size, levels["contact_count"].dtype)
    return {name: np.append(first[name], values) for name, values in levels.items()}


def tolerance_for(error: float) -> float:
    """Return the loosest tolerance that causes at most the share _SHARE_OF_TOLERANCE of a requested velocity error."""
    return min((_SHARE_OF_TOLERANCE * error / _ERROR_PER_ROOT) ** 2, _LOOSEST_TOLERANCE)


def _share_of_depth(indenter: Indenter, curve: LoadingCurve, sampled: Indenter) -> float:
    """Return the factor of the tolerance for a map whose depths at light loads are large (see _DEPTH_OVER_RMS).

    curve : curve of `sampled`, the map of every n-th point
    """
    force = max(lowest_force(indenter, curve.force[-1]), curve.force[0])
    depth = float(curve.at_force(force)[0]) + highest_missed(indenter, sampled)
    rms = float(np.nanstd(indenter.heights, dtype=float))
    return min(1.0, _DEPTH_OVER_RMS * rms / depth) if rms > 0 else 1.0


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


def _size(indenter: Indenter) -> str:
    """Return the numbers of rows and columns of a map as a text."""
    return " x ".join(map(str, indenter.heights.shape))


def _stated(tolerance: float) -> str:
    return f"a tolerance of {tolerance:.2g}"


def _percent(error: float) -> str:
    return f"{100 * error:.2g} %"
