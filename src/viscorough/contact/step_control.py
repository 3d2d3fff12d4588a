"""Place the levels of a loading path: few levels, yet close enough for accurate interpolation.

The curve is convex, so between two levels it lies in the triangle of their tangents and their chord. This bounds the
error of the interpolated depth in every interval, for every surface. On rough surfaces the error is far below the
bound. About three times the bound is accepted if the error predicted from the contact depths of the elements is small
enough.
"""

from dataclasses import dataclass

import numpy as np

from viscorough.basics.types import Array
from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.state import ContactState, GridContact
from viscorough.results.loading_curve import interpolate_between

# Finest tolerance of interpolation: a smaller tolerance would require every contact event as a level, like direct
# integration.
FINEST_ACCURACY = 1e-5
# Largest ratio of the depths of successive levels.
_MAX_DEPTH_RATIO = 2.0
# Ratio of the depths of the first step if there are few contact events.
_INITIAL_DEPTH_RATIO = 1.15
# Every contact event is a level up to a contact count of this number over the accuracy: an element that joins n others
# makes a kink of about 1/n in the stiffness.
_EVENTS_PER_ACCURACY = 0.4
# Follow at least this number of events, since so few cost less than a single longer step.
_FEWEST_EVENTS = 40
# Follow at most this number of events.
_MAX_EVENTS = 400
# The next step aims at this share of the admissible bound.
_AIM = 0.8
# Order of the bound in the logarithm of the depth ratio.
_ORDER = 2
# Smallest change of this logarithm from step to step, as a factor.
_LEAST_CHANGE = 0.3
# Largest change of this logarithm from step to step, as a factor.
_LARGEST_CHANGE = 2.0
# A step is divided within these shares of it.
_DIVISION = 0.15, 0.85
# Shares of an interval's force for evaluations of the bound.
_POINTS = np.linspace(0, 1, 18)[1:-1]
# The bound may be larger between these points by this factor.
_BETWEEN_POINTS = 1.15
# An interval is accepted up to this multiple of the bound if the predicted error is small enough.
_RELAXED_BOUND = 3.3
# Largest predicted error for a relaxed bound, over the accuracy.
_PREDICTED_ERROR = 0.5
# Smallest number of joining elements for a prediction.
_PREDICTED_COUNT = 10
# A prediction must agree with the force to within these factors.
_AGREEMENT = 0.8, 1.25
# Below this share of the accuracy the next step becomes as much longer as allowed, without a prediction.
_NEGLIGIBLE_BOUND = 0.15
# Smallest share of an interval's force for an evaluation of the bound: the logarithm of the force must not overflow.
_SMALLEST_SHARE = 1e-3
# Avoids a division by zero.
_TINY = 1e-30
# Largest number of contacts kept ahead, since each takes memory.
_MOST_AHEAD = 2


@dataclass(frozen=True)
class Level:
    """Quantities of a contact that a loading curve stores, in the reduced units of state.ContactState."""

    depth: float
    pressure_sum: float
    tangent_sum: float
    count: int
    residual: float = 0.0

    @classmethod
    def of(cls, contact: ContactState) -> "Level":
        """Return the level of a contact."""
        return cls(contact.reduced_depth, contact.pressure_sum, contact.tangent_sum, contact.count, contact.residual)


class ContactsAhead(list):
    """Contacts already solved beyond the requested contact, the nearest last; few, as each takes memory."""

    def keep(self, contact: ContactState) -> None:
        """Add a contact nearer than all others."""
        self.append(contact)
        del self[:-_MOST_AHEAD]


class StepControl:
    """Choose the depths of successive levels for a given relative error of the interpolated depth.

    tolerance : the allowed error, at least FINEST_ACCURACY
    threads : number of threads

    min_ratio : smallest ratio of the depths of successive levels; a triangle of this width is flatter than the accuracy
    events : up to this contact count every contact event is a level
    """

    def __init__(self, tolerance: float, threads: int = 1) -> None:
        self._threads, self._accuracy = threads, max(tolerance, FINEST_ACCURACY)
        self.min_ratio = 1 + self._accuracy
        self.events = int(np.clip(_EVENTS_PER_ACCURACY / self._accuracy, _FEWEST_EVENTS, _MAX_EVENTS))

    def first_ratio(self, levels: list[Level]) -> float:
        """Return the ratio of the first step after contact events, from the bound over the last quarter of them."""
        first = levels[-1 - len(levels) // 4]
        ratio = levels[-1].depth / first.depth
        if ratio == 1:
            return _INITIAL_DEPTH_RATIO
        return self.next_ratio(ratio, interpolation_bound(first, levels[-1]) / self._accuracy)

    def excess(self, before: ContactState, after: ContactState) -> float:
        """Return the bound on the interpolation error between two contacts, over the allowed bound.

        before, after : ContactStates
        """
        bound = interpolation_bound(Level.of(before), Level.of(after)) / self._accuracy
        if not _NEGLIGIBLE_BOUND < bound < _RELAXED_BOUND:
            return bound  # in any case the step is divided, or the next step is much longer
        is_smooth = _predicted_error(before, after, self._threads) <= _PREDICTED_ERROR * self._accuracy
        return bound / _RELAXED_BOUND if is_smooth else bound

    def next_ratio(self, ratio: float, excess: float) -> float:
        """Return the ratio of the step after a step with this ratio."""
        change = (_AIM / max(excess, _TINY)) ** (1 / _ORDER)
        return np.clip(ratio ** np.clip(change, _LEAST_CHANGE, _LARGEST_CHANGE), self.min_ratio, _MAX_DEPTH_RATIO)


def interpolation_bound(before: Level, after: Level) -> float:
    """Bound the relative error of the depth interpolated between two levels, from the convexity of the curve.

    The bound is the largest distance of the interpolated depth from the sides of the triangle of chord and tangents. It
    is evaluated at the intersection of the tangents and at equal intervals of the force.

    before, after : Levels
    """
    if after.count - before.count in (0, 1):
        return 0.0  # the two tangents are the curve
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
    """Return the depth that divides the interval between two levels: the intersection of their tangents.

    If the stiffness jumps at one depth, it is this depth. Otherwise it is near the middle of the interval.
    """
    return before.depth + (after.depth - before.depth) * np.clip(_meeting(before, after), *_DIVISION)


def _meeting(before: Level, after: Level) -> float:
    """Return the depth of the intersection of the tangents of two levels, as a share of the interval between them."""
    width = after.depth - before.depth
    rise = after.tangent_sum - before.tangent_sum
    missing = after.tangent_sum * width - (after.pressure_sum - before.pressure_sum)
    return missing / (rise * width) if rise > 0 else 0.5


def interpolate(before: Level, after: Level, force: Array) -> Array:
    """Interpolate depths between two Levels at reduced forces ΣP, as LoadingCurve.at_force does."""
    forces, depths = (before.pressure_sum, after.pressure_sum), (before.depth, after.depth)
    stiffnesses = before.tangent_sum, after.tangent_sum
    return interpolate_between(forces, depths, stiffnesses, after.count - before.count, force)[0]


def _predicted_error(before: ContactState, after: ContactState, threads: int) -> float:
    """Predict the relative error of interpolation between two contacts from the contact depths of the elements.

    The gap e of an element outside the contact is convex in the depth: it touches no earlier than at u₀ − e/e_q, with
    the gap and the tangent gap before. Its pressure is concave: it touches no earlier than at u₁ − P/q, with pressure
    and tangent after. The larger of these two depths predicts its touch closely. The stiffness that an element adds is
    taken as proportional to e_q², as for the first element to join, and the sum as the difference of the two tangent
    sums.

    Returns infinity if it cannot be predicted.
    """
    if not isinstance(before, GridContact) or not isinstance(after, GridContact):  # either may be solved densely
        return np.inf
    loops = GridLoops(threads)
    place_after, place = loops.new_places(after.fields, before.fields)
    if place.size < _PREDICTED_COUNT or not place.all():  # place 0 is outside the grid of the contact before
        return np.inf
    fields = before.fields.gap_change.values, before.fields.initial_gap, before.fields.tangent_gap.values
    share, width = _POINTS[1::2], after.reduced_depth - before.reduced_depth
    loads = (load[place_after].astype(float) for load in (after.fields.pressure, after.fields.tangent))
    # Σw, Σw (1 − touch) and, for every share s of the interval, Σw max(s − touch, 0), with touches from 0 to 1 and the
    # weights w = e_q².
    sums = sum(loops.each(kernels.touch_sums, (*fields, width, share), place, *loads))
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
