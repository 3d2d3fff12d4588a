"""The elastic loading path of a rigid indenter by boundary elements, level after level of increasing depth.

One path carries the viscous problem for every force history (viscorough.viscous.correspondence). While few elements touch,
every event (the next element touching) is a level: between events the curve is straight, so nothing is left to
interpolate. Later, levels stand where interpolation between them needs them.
"""

from dataclasses import dataclass

import numpy as np

from viscorough.contact.solver import ContactSolver
from viscorough.loading_curve import LoadingCurve

# Steps from level to level, as ratios of depths. A shorter one would only chase the kinks of single elements.
_LONGEST, _FIRST = 2.0, 1.15
_APPROACH = 4.0  # the same, on the way to where the curve is wanted
_EVENTS, _MOST_EVENTS = 0.4, 400
# No finer interpolation is offered: it would need every event, which is what viscorough.contact.dense is for.
_FINEST = 1e-5


def indent(indenter, *, tolerance=1e-3, depths=None, start_fraction=0.0, until_fraction=0.9, until_force=np.inf):
    """Loading curve of a rigid indenter pressed without friction into an incompressible elastic half-space.

    Solves w = (1/4πG) ∫ p/r dA with p ≥ 0, w ≥ u − g and p (w − u + g) = 0 for the gaps g of the indenter's elements
    (uniform pressure on square elements; Love 1929), at increasing depths u.

    indenter : Indenter with two-dimensional heights
    tolerance : largest gap in contact, or penetration outside it, over the depth, at every level, rounding included;
        the error of the force there is far below it (a hundredth, measured). Also the relative error of the depth
        interpolated between levels by LoadingCurve.at_force, down to 1e-5. Between 1e-12 and 0.1
    depths : exactly these depths, increasing [length]; default: levels placed as the tolerance needs them
    start_fraction : contact fraction from which on the curve is wanted, below `until_fraction`; before it stand only
        the few levels that lead there, and interpolation is not held to the tolerance; ignored where depths are given
    until_fraction : contact fraction at which to stop, in (0, 1]; ignored where depths are given
    until_force : F/G at which to stop [length²]; ignored where depths are given

    Returns a LoadingCurve. The last level is the first one at or beyond `until_fraction` or `until_force`.
    An indenter of one height has a single level, at a depth of one spacing: its curve is the line through it.
    Raises ValueError for arguments out of range, ConvergenceError if a level cannot be solved to the tolerance.
    """
    if indenter.heights.ndim != 2:
        raise ValueError("indent: the indenter's heights must be two-dimensional (lines are for reduce)")
    if not 1e-12 <= tolerance <= 0.1:
        raise ValueError(f"indent: tolerance must be between 1e-12 and 0.1, not {tolerance!r}")
    if not 0 < until_fraction <= 1:
        raise ValueError(f"indent: until_fraction must lie in (0, 1], not {until_fraction!r}")
    if not 0 <= start_fraction < until_fraction:
        raise ValueError(f"indent: start_fraction must be from 0 to below until_fraction, not {start_fraction!r}")
    if not until_force > 0:
        raise ValueError(f"indent: until_force must be positive, not {until_force!r}")
    solver = ContactSolver(indenter, tolerance)
    scale = 4 * np.pi * indenter.spacing
    if depths is None:
        levels = _levels(solver, start_fraction, until_fraction, until_force / (scale * solver.unit), indenter.spacing)
        depths = solver.unit * np.array([level.depth for level in levels])
    else:
        depths = np.atleast_1d(np.asarray(depths, dtype=float))
        if depths.ndim != 1 or depths.size == 0 or not np.all(np.isfinite(depths)):
            raise ValueError("indent: depths must be a list of finite numbers")
        if depths[0] <= 0 or np.any(np.diff(depths) <= 0):
            raise ValueError("indent: depths must be positive and strictly increasing")
        levels, contact = [], solver.touch()
        for depth in depths / solver.unit:
            contact = solver.advance(contact, depth)
            levels.append(_Level.of(contact))
    return LoadingCurve(
        depth=depths,
        force=scale * solver.unit * np.array([level.force for level in levels]),
        stiffness=scale * np.array([level.stiffness for level in levels]),
        contact_count=np.array([level.count for level in levels]),
        elements=solver.elements,
        method="boundary elements",
        tolerance=tolerance,
        operator_applications=solver.operator_applications,
        residual=np.array([level.residual for level in levels]),
    )


@dataclass(frozen=True)
class _Level:
    """What the curve keeps of a contact: a few numbers, not its fields."""

    depth: float
    force: float
    stiffness: float
    count: int
    residual: float

    @classmethod
    def of(cls, contact):
        return cls(contact.depth, contact.force, contact.stiffness, contact.count, contact.residual)


def _levels(solver, start_fraction, until_fraction, until_force, spacing):
    """Levels from first touch to the contact fraction or force at which to stop."""
    most = until_fraction * solver.elements
    accuracy = max(solver.tolerance, _FINEST)
    # One more among n elements is a kink of about 1/n in the stiffness; so many of them are followed one by one.
    events = int(min(_EVENTS / accuracy, _MOST_EVENTS))
    shortest = min(1.02, 1 + 200 * accuracy)

    # The first level lies on the straight line of first touch: nothing else is in contact before its gap is closed.
    lower = solver.gap[solver.gap > 0]
    contact = solver.advance(solver.touch(), lower[0] if lower.size else spacing)
    levels = [_Level.of(contact)]

    def open_end():
        return contact.count < most and contact.force < until_force

    ahead = []  # contacts at larger depths, solved already, the next one last
    ratio = _APPROACH
    while open_end() and contact.count < 0.7 * start_fraction * solver.elements and ratio > shortest:
        # The next level must not lie beyond the start: the curve between the two is wanted in part.
        following = solver.advance(contact, contact.depth * ratio)
        if following.count > start_fraction * solver.elements or following.force > until_force:
            ahead.append(following)
            ratio = ratio**0.5
            continue
        contact = following
        levels.append(_Level.of(contact))

    if open_end() and contact.count < events:
        followed, contact = solver.follow_events(contact, min(events, int(np.ceil(most))), until_force)
        levels += [_Level(*event, 0.0) for event in zip(*followed, strict=True)]
        ahead = [each for each in ahead if each.depth > shortest * contact.depth]

    # As long as two events or so; a step much longer than the one before would not be tested against it.
    ratio = np.clip((contact.depth / levels[-min(len(levels), 5)].depth) ** 0.5, shortest, _FIRST)
    while open_end():
        if not ahead:
            # The tangent underestimates the force: the last level is at or just beyond the force to stop at.
            enough = contact.depth + (until_force - contact.force) / contact.stiffness
            ahead.append(solver.advance(contact, max(min(contact.depth * ratio, enough), contact.depth * shortest)))
        error, limit, step = 0.0, shortest**2, ahead[-1].depth / contact.depth
        if len(levels) > 1:
            error = _interpolation_error(*levels[-2:], _Level.of(ahead[-1]))
            # An error made in the interval before does not go away by shortening this one.
            limit = max(limit, (contact.depth / levels[-2].depth) ** 0.3)
        if error > accuracy and step > limit:
            ahead.append(solver.advance(contact, contact.depth * np.sqrt(step)))
            continue
        contact = ahead.pop()
        levels.append(_Level.of(contact))
        growth = np.clip((0.7 * accuracy / max(error, 1e-30)) ** (1 / 3), 0.5, 1.6)
        ratio = np.clip(step**growth, shortest, _LONGEST)
    return levels


def _interpolation_error(before, middle, after):
    """Estimated relative error of the depth interpolated in the two intervals between three levels.

    It is measured: the curve is interpolated across both and compared with the level in the middle. Over many rough
    discs the largest error within the intervals was below this estimate in 95 of 100 cases (a kink of the stiffness
    counts more than the depth in the middle tells, hence its share).
    """
    ends = np.array([[c.depth, c.force, c.stiffness, c.count] for c in (before, after)]).T
    across = LoadingCurve(*ends, elements=0, method="", tolerance=0.0, operator_applications=0, residual=np.zeros(2))
    depth, stiffness = across.at_force(middle.force)
    return 1.5 * (abs(depth / middle.depth - 1) + 0.03 * abs(stiffness / middle.stiffness - 1))
