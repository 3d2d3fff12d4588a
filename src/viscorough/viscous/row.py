"""Row of independent springs that has a given loading curve.

Along a loading curve the contact only grows, and its stiffness k never decreases. With s₊ = max(s, 0), the elastic
force at depth u is therefore

    F_el(u)/G = ∫ (u − g)₊ dk(g)/G.

This is the force of a row of independent springs: the springs with initial gaps from g to g + dg have the stiffness dk
(docs/theory.md). The row is finite, so its force is piecewise linear in the depth. At chosen depths it equals the force
of the interpolated curve (LoadingCurve.at_force). The depths are chosen from the levels of the curve:

- If at most one element joins the contact between two levels, the curve between them consists of their two tangents.
  The tangents meet at the gap of one spring, whose stiffness is the jump of k. This part of the row is exact.
- Between other levels, the interpolated curve is divided into chords. Their number is chosen so that their depth
  deviates by at most about 0.03 times the tolerance of the curve, and so that k jumps by at most about 0.2 % from chord
  to chord.
- If the tangent of the first level misses the origin, the curve before this level is taken to be a power law with the
  same force and the same tangent at this level.
- Finally, the points are replaced by the greatest convex function below all of them, so that no stiffness dk is
  negative.
"""

from typing import NamedTuple

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Mask
from viscorough.media.load import Load
from viscorough.media.spectra import zero_of_increasing
from viscorough.results.loading_curve import LoadingCurve

# Largest deviation of a chord from the interpolated curve: _DEVIATION times the tolerance of the curve, relative to the
# depth. A tolerance below _FINEST counts as _FINEST, because the interpolated curve is not more accurate.
_DEVIATION, _FINEST = 0.03, 1e-7
# Largest relative jump of the stiffness from one chord to the next. The relative error of the velocity is about half of
# this jump.
_STIFFNESS_STEP = 2e-3
# Largest number of chords between two levels, and approximate largest number of chords in total.
_MOST_CHORDS, _MOST_SPRINGS = 2000, 100_000
# Number of chords that replace the power law before the first level of the curve.
_EARLY_CHORDS = 64
# The first of these chords ends at least at the depth where the stiffness of the power law is 1/_EARLY_CHORDS to this
# power, 4e-15, of its value at the first level. Motions overflow if the first spring is far softer. The exponent of the
# power law is large if the first level is deep although few elements touch.
_LARGEST_DECAY = 8.0
# The force of the row is exactly the force of the loading curve at the turns of a load, at most so many.
_MOST_TURNS = 200
# A load may exceed the end of the loading curve by this share, because of rounding.
ROUNDING = 1e-10
# The tangents of two levels meet between the levels only if each tangent differs from the curve at the other level by
# more than this share of the force. Rounding alone makes a difference of about 1e-15.
_FORCE_ROUNDING = 1e-12


class RowOfSprings(NamedTuple):
    """Row of independent springs that has the force of a loading curve; arrays of shape (springs,).

    gap : initial gaps, which increase from 0 [length]
    stiffness : stiffness dk/G > 0 of each spring [length]
    contact_fraction : share of the elements of the indenter that are in contact when this spring has just touched
    limit : depth up to which the curve is known; infinite if the curve reaches complete contact
    first_depth : depth below which the curve is not known and is taken to be a power law; 0 if the whole curve is known
    """

    gap: Array
    stiffness: Array
    contact_fraction: Array
    limit: float
    first_depth: float


def row_of_springs(curve: LoadingCurve, load: Load | None = None) -> RowOfSprings:
    """Return the row of springs that has the force of a loading curve.

    load : if it prescribes the depth, the force of the row is exactly the force of the interpolated curve at the depths
        at which it turns, steps or is held (the _MOST_TURNS deepest of them)
    """
    depths = np.array([]) if load is None or not load.by_depth else _turning_depths(load)
    parts = [_before_first_level(curve)]
    if curve.depth.size > 1:
        parts.append(_between_levels(curve))
    depth, force, count = np.hstack(parts)
    new = np.setdiff1d(depths, depth)
    new = new[(new > curve.depth[0]) & (new < curve.depth[-1])]
    if new.size:
        place = np.searchsorted(depth, new)
        at_new = zero_of_increasing(lambda force: curve.at_force(force)[0] - new, *curve.force[[0, -1]])
        count = np.insert(count, place, elements_in_contact(curve, new))
        depth, force = np.insert(depth, place, new), np.insert(force, place, at_new)
    kept = _below_all(depth, force)
    depth, force, count = depth[kept], force[kept], count[kept]
    chords = np.diff(force) / np.diff(depth)
    gap, limit = depth[:-1], curve.depth[-1] * (1 + ROUNDING)
    if curve.contact_count[-1] == curve.elements:
        # After complete contact the curve is a straight line. No chord before it is steeper, except by rounding.
        last = curve.stiffness[-1]
        chords, gap, limit = np.append(np.minimum(chords, last), last), depth, np.inf
    jumps = np.diff(chords, prepend=0.0)
    first_depth = 0.0 if curve.starts_straight else float(curve.depth[0])
    used = jumps > 0
    fraction = np.maximum(count[: gap.size], 1) / curve.elements
    return RowOfSprings(gap[used], jumps[used], fraction[used], float(limit), first_depth)


def _turning_depths(load: Load) -> Array:
    """Return the depths at which a prescribed depth turns, steps or is held; at most the _MOST_TURNS deepest."""
    moves = np.sign(np.diff(load.values, prepend=0.0))
    turns = np.append(moves[:-1] * moves[1:] <= 0, True) | (np.diff(load.time, append=np.inf) == 0)
    return np.unique(load.values[turns])[-_MOST_TURNS:]


def _before_first_level(curve: LoadingCurve) -> Array:
    """Return points of the curve from the origin to its first level, shape (3, points).

    The rows of the array are depths, forces and numbers of elements in contact.
    """
    depth, force, stiffness, count = (x[0] for x in (curve.depth, curve.force, curve.stiffness, curve.contact_count))
    exponent = stiffness * depth / force
    if curve.starts_straight or exponent <= 1:
        return np.array([[0.0, depth], [0.0, force], [count, count]])
    share = np.linspace(0, 1, _EARLY_CHORDS + 1) ** min(2.0, _LARGEST_DECAY / (exponent - 1))
    return np.array([depth * share, force * share**exponent, count * share])


def _between_levels(curve: LoadingCurve) -> Array:
    """Return points of the curve after its first level, shape (3, points).

    They include all other levels. The rows of the array are depths, forces and numbers of elements in contact.
    """
    depth, force, stiffness, count = curve.depth, curve.force, curve.stiffness, curve.contact_count
    joined = np.diff(count)
    tangents = (joined >= 0) & (joined <= 1)
    chords = np.ones(joined.size, int)
    deviation = np.diff(force) * np.maximum(-np.diff(1 / stiffness), 0) / 8
    allowed = _DEVIATION * max(curve.tolerance, _FINEST) * depth[:-1]
    needed = np.maximum(np.sqrt(deviation / allowed), np.abs(np.diff(np.log(stiffness))) / _STIFFNESS_STEP)
    needed *= min(1.0, _MOST_SPRINGS / max(needed.sum(), 1.0))
    chords[~tangents] = np.clip(np.ceil(needed[~tangents]), 1, _MOST_CHORDS).astype(int)

    interval = np.repeat(np.arange(joined.size), chords)
    number = np.arange(interval.size) - np.repeat(np.cumsum(chords) - chords, chords) + 1
    share = number / chords[interval]
    is_level = number == chords[interval]
    forces = force[interval] * (force[1:] / force[:-1])[interval] ** share
    forces[is_level] = force[1:]
    depths = np.empty_like(forces)
    depths[is_level] = depth[1:]
    depths[~is_level] = curve.at_force(forces[~is_level])[0]
    counts = elements_in_contact(curve, depths)

    meeting = _meeting_of_tangents(curve, tangents)
    between = np.flatnonzero(np.isfinite(meeting))
    at = np.cumsum(chords)[between] - 1  # indices of the levels that follow the new points
    depths = np.insert(depths, at, meeting[between])
    forces = np.insert(forces, at, force[between] + stiffness[between] * (meeting[between] - depth[between]))
    counts = np.insert(counts, at, count[between + 1].astype(float))
    return np.array([depths, forces, counts])


def elements_in_contact(curve: LoadingCurve, depth: Array) -> Array:
    """Return the number of elements in contact at depths of a loading curve, not rounded.

    Between levels that differ by several elements the number is linear in the depth, as it is from 0 to the first
    level. Between levels that differ by one element it is the number of the lower level.
    """
    depths, counts = np.append(0.0, curve.depth), np.append(0.0, curve.contact_count)
    joined = np.diff(counts, append=counts[-1])
    joined[1:][(joined[1:] >= 0) & (joined[1:] <= 1)] = 0
    # A depth that is a level except for rounding is the level.
    below = np.clip(np.searchsorted(depths, depth * (1 + ROUNDING), "right") - 1, 0, depths.size - 1)
    rise = np.diff(depths, append=np.inf)[below]
    return counts[below] + joined[below] * np.maximum(depth - depths[below], 0.0) / rise


def _meeting_of_tangents(curve: LoadingCurve, tangents: Mask) -> Array:
    """Return the depth at which the tangents of two neighbouring levels meet.

    There is one depth for each interval between levels. It is nan if the tangents do not meet within the interval, or
    if they meet at one of the levels within rounding: the slope from this level to the meeting would be rounding error.

    tangents : True for the intervals to compute; the depth is nan for other intervals
    """
    force, stiffness = curve.force, curve.stiffness
    rise, rounding = np.diff(curve.depth), _FORCE_ROUNDING * force[1:]
    below_first = stiffness[1:] * rise - np.diff(force)  # how far the second tangent is below the first level
    below_second = np.diff(force) - stiffness[:-1] * rise  # how far the first tangent is below the second level
    inside = tangents & (below_first > rounding) & (below_second > rounding)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(inside, curve.depth[:-1] + below_first / np.diff(stiffness), np.nan)


@njit
def _below_all(depth, force):
    """Return the indices of the points that are corners of the greatest convex function below all points.

    depth, force : coordinates of the points, in the order of increasing depth
    """
    corners = np.empty(depth.size, np.int64)
    count = 0
    for i in range(depth.size):
        if i > 0 and depth[i] <= depth[corners[count - 1]]:
            continue  # this point has the same depth as the last corner, within rounding
        while count > 1:
            a, b = corners[count - 2], corners[count - 1]
            before = (force[b] - force[a]) / (depth[b] - depth[a])
            after = (force[i] - force[b]) / (depth[i] - depth[b])
            if after >= before:
                break
            count -= 1
        corners[count] = i
        count += 1
    return corners[:count]
