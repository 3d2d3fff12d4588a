"""Where the levels of a loading path stand: depths far enough apart to be few, near enough to interpolate between."""

from dataclasses import dataclass

import numpy as np

from viscorough.loading_curve import interpolate_levels

# No finer interpolation is offered: it would need every contact event as a level, as direct integration has.
FINEST_ACCURACY = 1e-5
# Ratios of the depths of successive levels: the largest one; that of the first step after contact events, at most; that
# before the curve is wanted; and the smallest, which a high accuracy reduces further. A shorter step would only follow
# the kinks at which single elements join.
_MAX_DEPTH_RATIO, _INITIAL_DEPTH_RATIO, APPROACH_DEPTH_RATIO, _MIN_DEPTH_RATIO = 2.0, 1.15, 4.0, 1.02
_MIN_DEPTH_STEP_PER_ACCURACY = 200
# One more among n elements is a kink of about 1/n in the stiffness: up to this number over the accuracy, and never more
# than the second number, every event is a level.
_EVENTS_PER_ACCURACY, _MAX_EVENTS = 0.4, 400
# The next step aims at this share of the accuracy, with an error of third order in the step, and its logarithm changes
# by these factors at most.
_AIM, _ORDER, _LEAST_CHANGE, _LARGEST_CHANGE = 0.7, 3, 0.5, 1.6
# A step is not divided below this power of the one before: an error made there does not go away by shortening this one.
_LAST_STEP_POWER = 0.3
# Factor from the error at the middle level to that within the intervals, and share of the error of the stiffness in it:
# a kink of the stiffness matters more than the depth at the middle level shows. The estimate is not a bound
# (`make bench`, key curve, interpolation_error).
_MARGIN, _STIFFNESS_SHARE = 1.5, 0.03


@dataclass(frozen=True)
class Level:
    """What a loading curve keeps of a contact; reduced as in state.Contact."""

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
    """Depth ratios of levels between which interpolation shall have a relative error of the depth of `accuracy`."""

    def __init__(self, tolerance):
        self._accuracy = max(tolerance, FINEST_ACCURACY)
        self.min_ratio = min(_MIN_DEPTH_RATIO, 1 + _MIN_DEPTH_STEP_PER_ACCURACY * self._accuracy)
        self.events = int(min(_EVENTS_PER_ACCURACY / self._accuracy, _MAX_EVENTS))

    def first_ratio(self, levels):
        """Ratio of the first step after contact events: as long as about two of them."""
        # A step much longer than the one before would not be tested against it.
        ratio = (levels[-1].depth / levels[-min(len(levels), 5)].depth) ** 0.5
        return np.clip(ratio, self.min_ratio, _INITIAL_DEPTH_RATIO)

    def error(self, levels, ahead):
        """Estimated relative error of the interpolated depth around the last level; 0 where there is none before it."""
        return interpolation_error(*levels[-2:], ahead) if len(levels) > 1 else 0.0

    def is_too_long(self, levels, ratio, error):
        """Whether the step with this ratio from the last level is to be divided."""
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
    """
    ends = np.array([[level.depth, level.pressure_sum, level.tangent_sum, level.count] for level in (before, after)]).T
    (depth,), (tangent_sum,) = interpolate_levels(*ends, np.array([middle.pressure_sum]))
    depth_error, tangent_error = abs(depth / middle.depth - 1), abs(tangent_sum / middle.tangent_sum - 1)
    return _MARGIN * (depth_error + _STIFFNESS_SHARE * tangent_error)
