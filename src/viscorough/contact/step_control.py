"""Choose the depths of the levels of a loading curve: few levels, yet close enough for accurate interpolation.

The curve is interpolated between the levels. The curve is convex, so between two levels it lies in the triangle formed
by the chord and the two tangents. This gives an upper bound on the error of the interpolated depth in every interval,
for every surface. On rough surfaces the error is far smaller than the bound. A bound of about three times the allowed
error is therefore accepted, if the error is also predicted from the depths where the elements touch, and the predicted
error is small enough.
"""

from dataclasses import dataclass

import numpy as np

from viscorough.basics.types import Array
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.state import ContactState, GridContact
from viscorough.results.loading_curve import interpolate_between

# Smallest error of interpolation that can be requested. A smaller error would require a level at every contact event,
# which is as much work as direct integration in time.
FINEST_ACCURACY = 1e-5
# Largest ratio of the depths of successive levels.
_MAX_DEPTH_RATIO = 2.0
# At small depths, the levels of a curve are contact events (depths where an element touches). Longer steps of the depth
# follow. If there are too few contact events to choose the length of the first longer step, it multiplies the depth by
# this ratio.
_INITIAL_DEPTH_RATIO = 1.15
# If n elements are in contact, the stiffness jumps by about the share 1/n when the next element touches. Every such
# contact event is a level of the curve as long as n is at most this number divided by the allowed error.
_EVENTS_PER_ACCURACY = 0.4
# Up to this number of elements in contact, every contact event is a level, whatever the allowed error is. Computing
# these events takes less time than a single longer step.
_FEWEST_EVENTS = 40
# With more than this number of elements in contact, contact events are not used as levels, even if the allowed error is
# very small.
_MAX_EVENTS = 400
# The next step in depth is chosen so that its expected error bound is this share of the allowed bound.
_AIM = 0.8
# The error bound of a step from depth u₁ to u₂ is proportional to ln(u₂/u₁) raised to this power.
_ORDER = 2
# From one step to the next, the logarithm of the ratio of successive depths is multiplied by at least this factor.
_LEAST_CHANGE = 0.3
# From one step to the next, the logarithm of the ratio of successive depths is multiplied by at most this factor.
_LARGEST_CHANGE = 2.0
# If an interval between two levels is divided, the depth of the new level lies between these shares of the interval.
_DIVISION = 0.15, 0.85
# Forces where the error bound is evaluated, as shares of the force interval between two levels.
_POINTS = np.linspace(0, 1, 18)[1:-1]
# The error bound is multiplied by this factor, because the bound may be larger between the points of its evaluation.
_BETWEEN_POINTS = 1.15
# If the predicted error is small enough, an interval between two levels is accepted although its error bound is larger
# than the allowed error, by up to this factor.
_RELAXED_BOUND = 3.3
# A larger error bound (see _RELAXED_BOUND) is accepted only if the predicted error is at most this share of the allowed
# error.
_PREDICTED_ERROR = 0.5
# The error is predicted only if at least this number of elements joins the contact in the interval.
_PREDICTED_COUNT = 10
# The predicted error is used only if the computed growth of the force in the interval, divided by the predicted growth,
# is within these limits.
_AGREEMENT = 0.8, 1.25
# If the error bound is below this share of the allowed error, the error need not be predicted: the interval is accepted
# in any case, and the next step is lengthened as much as allowed.
_NEGLIGIBLE_BOUND = 0.15
# The error bound is not evaluated below this share of the force interval between two levels, because the logarithm of
# the force could overflow there.
_SMALLEST_SHARE = 1e-3
# This number avoids a division by zero.
_TINY = 1e-30
# Largest number of contacts that are kept for later levels; each contact takes memory.
_MOST_AHEAD = 2


@dataclass(frozen=True)
class Level:
    """Values of one solved contact that a loading curve stores, in reduced units (see state.ContactState)."""

    depth: float
    pressure_sum: float
    tangent_sum: float
    count: int
    residual: float = 0.0

    @classmethod
    def of(cls, contact: ContactState) -> "Level":
        """Return the Level of a contact."""
        return cls(contact.reduced_depth, contact.pressure_sum, contact.tangent_sum, contact.count, contact.residual)


class ContactsAhead(list):
    """List of contacts that were solved beyond the current level, in the order of decreasing depth.

    The nearest contact is the last item. The list is short, because each contact takes memory.
    """

    def keep(self, contact: ContactState) -> None:
        """Add a contact that is nearer to the current level than all others in the list."""
        self.append(contact)
        del self[:-_MOST_AHEAD]


class StepControl:
    """Choose the depths of successive levels for a given relative error of the interpolated depth.

    Arguments:

    tolerance : allowed relative error; smaller values are replaced by FINEST_ACCURACY
    threads : number of threads

    Attributes:

    min_ratio : smallest ratio of the depths of successive levels. At this ratio the depth changes only by the allowed
        error, so interpolation between the levels is accurate enough
    events : number of elements in contact up to which there is a level whenever an element touches
    """

    def __init__(self, tolerance: float, threads: int = 1) -> None:
        self._threads, self._accuracy = threads, max(tolerance, FINEST_ACCURACY)
        self.min_ratio = 1 + self._accuracy
        self.events = int(np.clip(_EVENTS_PER_ACCURACY / self._accuracy, _FEWEST_EVENTS, _MAX_EVENTS))

    def first_ratio(self, levels: list[Level]) -> float:
        """Return the depth after the first long step, divided by the depth before this step.

        Before this step, there is a level at every contact event, that is, at every depth where an element touches. The
        step follows the last of these levels. Its length is chosen from the error bound of the interval that spans the
        last quarter of these levels.

        levels : levels at contact events
        """
        first = levels[-1 - len(levels) // 4]
        ratio = levels[-1].depth / first.depth
        if ratio == 1:
            return _INITIAL_DEPTH_RATIO
        return self.next_ratio(ratio, interpolation_bound(first, levels[-1]) / self._accuracy)

    def excess(self, before: ContactState, after: ContactState) -> float:
        """Return the ratio of the error bound between two contacts to the allowed bound.

        The interval between the contacts is accepted if the ratio is at most 1. If the predicted error is small enough,
        the allowed bound is larger (_RELAXED_BOUND).
        """
        bound = interpolation_bound(Level.of(before), Level.of(after)) / self._accuracy
        if not _NEGLIGIBLE_BOUND < bound < _RELAXED_BOUND:
            # The bound alone decides whether the interval is accepted, so the error need not be predicted.
            return bound
        is_smooth = _predicted_error(before, after, self._threads) <= _PREDICTED_ERROR * self._accuracy
        return bound / _RELAXED_BOUND if is_smooth else bound

    def next_ratio(self, ratio: float, excess: float) -> float:
        """Return the depth after the next step divided by the depth before it.

        ratio : ratio of the depths after and before the last step
        excess : error bound of the last step divided by the allowed bound
        """
        change = (_AIM / max(excess, _TINY)) ** (1 / _ORDER)
        return np.clip(ratio ** np.clip(change, _LEAST_CHANGE, _LARGEST_CHANGE), self.min_ratio, _MAX_DEPTH_RATIO)


def interpolation_bound(before: Level, after: Level) -> float:
    """Return a bound on the relative error of the depth interpolated between two levels of a convex curve.

    The curve lies in the triangle of the chord and the two tangents. The bound is the largest distance in depth from
    the interpolated curve to the sides of this triangle, divided by the depth. It is evaluated at the intersection of
    the tangents and at equal intervals of the force.
    """
    if after.count - before.count in (0, 1):
        return 0.0  # at most one element joins, so the curve consists of the two tangents, and interpolation is exact
    rise = after.pressure_sum - before.pressure_sum
    at_meeting = before.tangent_sum * _meeting(before, after) * (after.depth - before.depth) / rise
    share = np.append(_POINTS, min(max(at_meeting, _SMALLEST_SHARE), 1.0))
    force = np.minimum(before.pressure_sum + share * rise, after.pressure_sum)
    depth = interpolate(before, after, force)
    chord = before.depth + share * (after.depth - before.depth)
    tangents = np.minimum(
        before.depth + (force - before.pressure_sum) / before.tangent_sum,
        after.depth - (after.pressure_sum - force) / after.tangent_sum,
    )
    return _BETWEEN_POINTS * (np.maximum(tangents - depth, depth - chord) / depth).max()


def division(before: Level, after: Level) -> float:
    """Return the depth for a new level between two levels: the intersection of their tangents, limited by _DIVISION.

    If the stiffness jumps at a single depth, the tangents intersect at this depth. Otherwise they intersect near the
    middle of the interval.
    """
    return before.depth + (after.depth - before.depth) * np.clip(_meeting(before, after), *_DIVISION)


def _meeting(before: Level, after: Level) -> float:
    """Return the depth of the intersection of the tangents of two levels, as a share of the interval between them."""
    width = after.depth - before.depth
    rise = after.tangent_sum - before.tangent_sum
    missing = after.tangent_sum * width - (after.pressure_sum - before.pressure_sum)
    return missing / (rise * width) if rise > 0 else 0.5


def interpolate(before: Level, after: Level, force: Array) -> Array:
    """Return depths interpolated between two levels, as LoadingCurve.at_force does.

    force : reduced forces ΣP between the levels
    """
    forces, depths = (before.pressure_sum, after.pressure_sum), (before.depth, after.depth)
    stiffnesses = before.tangent_sum, after.tangent_sum
    return interpolate_between(forces, depths, stiffnesses, after.count - before.count, force)[0]


def _predicted_error(before: ContactState, after: ContactState, threads: int) -> float:
    """Predict the relative error of interpolation between two contacts from the depths where elements touch.

    1. Predict the depth where each joining element touches. The gap is a convex function of the depth, so the element
       touches no earlier than at u₀ − e/e_q, with the depth u₀, the gap e and the tangent gap e_q in the contact
       `before`. The pressure is a concave function of the depth, so the element touches no earlier than at u₁ − P/q,
       with the depth u₁, the pressure P and the tangent q in the contact `after`. The larger of these two depths is
       close to the true depth.
    2. Take the stiffness that each element adds as proportional to e_q², which is correct for the first element that
       touches. All elements together add the difference of the two tangent sums Σq.
    3. Integrate the predicted stiffness over the depth to find the force at several depths. Interpolate the depths at
       these forces, and compare them with the true depths.

    Returns infinity if the error cannot be predicted.
    """
    if not isinstance(before, GridContact) or not isinstance(after, GridContact):
        return np.inf  # a DenseContact does not store the gaps of elements out of contact
    loops = GridLoops(threads)
    place_after, place = loops.new_places(after.fields, before.fields)
    # An element with place 0 lies outside the grid of the contact `before`, so its gap there is unknown.
    if place.size < _PREDICTED_COUNT or not place.all():
        return np.inf
    share, width = _POINTS[1::2], after.reduced_depth - before.reduced_depth
    pressure, tangent = (load[place_after].astype(float) for load in (after.fields.pressure, after.fields.tangent))

    # Each joining element touches after a share t of the interval (0 to 1), and has the weight w = e_q². The computed
    # sums are Σw, then Σw (1 − t), then Σw max(s − t, 0) for every share s of the interval in `share`.
    def touch_sums(i: int, j: int) -> Array:
        part = np.zeros(2 + share.size)
        kernels.touch_sums(
            gap_change=before.fields.gap_change.values,
            initial_gap=before.fields.initial_gap,
            tangent_gap=before.fields.tangent_gap.values,
            width=width,
            share=share,
            sums=part,
            places=place[i:j],
            pressure=pressure[i:j],
            tangent=tangent[i:j],
        )
        return part

    sums = sum(loops.over(place, touch_sums))
    added = (after.tangent_sum - before.tangent_sum) / sums[0]
    rise = (after.pressure_sum - before.pressure_sum) / width - before.tangent_sum
    predicted_rise = added * sums[1]
    if not 0 < _AGREEMENT[0] * predicted_rise <= rise <= _AGREEMENT[1] * predicted_rise:
        return np.inf
    above_tangent = added * sums[2:] * rise / predicted_rise
    force = before.pressure_sum + width * (share * before.tangent_sum + above_tangent)
    depth = before.reduced_depth + width * share
    interpolated = interpolate(Level.of(before), Level.of(after), np.minimum(force, after.pressure_sum))
    return np.abs(interpolated / depth - 1).max()
