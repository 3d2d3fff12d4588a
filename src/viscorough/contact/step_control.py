"""Placement of the levels of a loading path: few of them, yet close enough for accurate interpolation between them."""

from dataclasses import dataclass

import numpy as np

from viscorough.loading_curve import interpolate_levels

# Smallest accuracy of interpolation that is offered: a smaller one would require every contact event as a level, as in
# direct integration.
FINEST_ACCURACY = 1e-5
# Ratios of the depths of successive levels: the largest one; the largest one of the first step after contact events;
# the one below the start fraction; and the smallest one, which a high accuracy reduces further. A shorter step would
# only resolve the kinks at which single elements join.
_MAX_DEPTH_RATIO, _INITIAL_DEPTH_RATIO, APPROACH_DEPTH_RATIO, _MIN_DEPTH_RATIO = 2.0, 1.15, 4.0, 1.02
_MIN_DEPTH_STEP_PER_ACCURACY = 200
# An element that joins n others makes a kink of about 1/n in the stiffness: every event is a level up to a contact
# count of the first number over the accuracy, but at most the second number.
_EVENTS_PER_ACCURACY, _MAX_EVENTS = 0.4, 400
# The next step aims at this share of the accuracy, for an error of third order in the logarithm of the depth ratio;
# this logarithm changes by a factor between the last two numbers.
_AIM, _ORDER, _LEAST_CHANGE, _LARGEST_CHANGE = 0.7, 3, 0.5, 1.6
# A depth ratio is not reduced below this power of the preceding one: the estimated error is that of both intervals, and
# a shorter step does not reduce the error of the preceding interval.
_LAST_STEP_POWER = 0.3
# Factor from the error at the middle level to that within the intervals, and share of the error of the stiffness in it:
# a kink of the stiffness changes the depth within the intervals more than at the middle level. The estimate is not a
# bound (`make bench`, key curve, interpolation_error).
_MARGIN, _STIFFNESS_SHARE = 1.5, 0.03


@dataclass(frozen=True)
class Level:
    """The quantities of a contact that a loading curve stores; reduced as in state.Contact."""

    depth: float
    pressure_sum: float
    tangent_sum: float
    count: int
    residual: float = 0.0

    @classmethod
    def of(cls, contact):
        """The level of a contact."""
        return cls(contact.reduced_depth, contact.pressure_sum, contact.tangent_sum, contact.count, contact.residual)


class StepControl:
    """Depth ratios of successive levels for a given relative error of the interpolated depth.

    tolerance : the error aimed at, not below FINEST_ACCURACY

    min_ratio : smallest ratio of the depths of successive levels
    events : contact count up to which every contact event is a level
    """

    def __init__(self, tolerance):
        self._accuracy = max(tolerance, FINEST_ACCURACY)
        self.min_ratio = min(_MIN_DEPTH_RATIO, 1 + _MIN_DEPTH_STEP_PER_ACCURACY * self._accuracy)
        self.events = int(min(_EVENTS_PER_ACCURACY / self._accuracy, _MAX_EVENTS))

    def first_ratio(self, levels):
        """Ratio of the first step after contact events: about that of two events.

        If it were much larger than the step before, the error estimate, which covers both, would not be reliable.
        """
        ratio = (levels[-1].depth / levels[-min(len(levels), 5)].depth) ** 0.5
        return np.clip(ratio, self.min_ratio, _INITIAL_DEPTH_RATIO)

    def error(self, levels, ahead):
        """Estimated relative error of the interpolated depth around the last level; 0 if no level precedes it."""
        return interpolation_error(*levels[-2:], ahead) if len(levels) > 1 else 0.0

    def is_too_long(self, levels, ratio, error):
        """Whether a step from the last level with this ratio and error is to be divided."""
        limit = self.min_ratio**2
        if len(levels) > 1:
            limit = max(limit, (levels[-1].depth / levels[-2].depth) ** _LAST_STEP_POWER)
        return error > self._accuracy and ratio > limit

    def next_ratio(self, ratio, error):
        """Ratio of the step after one with this ratio and error."""
        change = (_AIM * self._accuracy / max(error, 1e-30)) ** (1 / _ORDER)
        return np.clip(ratio ** np.clip(change, _LEAST_CHANGE, _LARGEST_CHANGE), self.min_ratio, _MAX_DEPTH_RATIO)


def interpolation_error(before, middle, after):
    """Estimated relative error of the depth interpolated in the two intervals between three levels.

    The curve is interpolated from the first level to the third and compared with the second.

    before, middle, after : Levels
    """
    ends = np.array([[level.depth, level.pressure_sum, level.tangent_sum, level.count] for level in (before, after)]).T
    (depth,), (tangent_sum,) = interpolate_levels(*ends, np.array([middle.pressure_sum]))
    depth_error, tangent_error = abs(depth / middle.depth - 1), abs(tangent_sum / middle.tangent_sum - 1)
    return _MARGIN * (depth_error + _STIFFNESS_SHARE * tangent_error)
