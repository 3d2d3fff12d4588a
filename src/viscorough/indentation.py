"""The elastic loading path of a rigid indenter by boundary elements, level after level of increasing depth.

One path carries the viscous problem for every force history (see viscorough.viscous). While few elements touch,
every event (the next element touching) is a level: between events the curve is straight, so nothing is left to
interpolate. Later, levels stand where interpolation between them needs them.
"""

import numpy as np

from viscorough.contact import ContactSolver
from viscorough.curve import LoadingCurve

# Up to this many elements in contact every event is a level.
_EVENTS = 24
# Limits of the step from level to level, as ratios of depths.
_SHORTEST, _LONGEST, _FIRST = 1.02, 2.0, 1.15


def indent(indenter, *, tolerance=1e-3, depths=None, until=0.9, until_force=np.inf):
    """Loading curve of a rigid indenter pressed without friction into an incompressible elastic half-space.

    Solves w = (1/4πG) ∫ p/r dA with p ≥ 0, w ≥ u − g and p (w − u + g) = 0 for the gaps g of the indenter's elements
    (uniform pressure on square elements; Love 1929), at increasing depths u.

    indenter : surfaces.Indenter with two-dimensional heights
    tolerance : largest gap in contact, or penetration outside it, over the depth, at every level; and largest
        relative error of interpolating the curve with LoadingCurve.at_force. The error of force and stiffness at
        the levels is of second order in it. Between 1e-12 and 0.1
    depths : exactly these depths, increasing [length]; default: levels chosen by the tolerance
    until : contact fraction at which to stop, in (0, 1]; ignored where depths are given
    until_force : F/G at which to stop [length²]; ignored where depths are given

    Returns a LoadingCurve. The last level is the first one at or beyond `until` or `until_force`.
    An indenter of one height has a single level, at a depth of one spacing: its curve is the line through it.
    Raises ValueError for arguments out of range, ConvergenceError if a level cannot be solved to the tolerance.
    """
    if indenter.heights.ndim != 2:
        raise ValueError("indent: the indenter's heights must be two-dimensional (lines are for reduce)")
    if not 1e-12 <= tolerance <= 0.1:
        raise ValueError(f"indent: tolerance must be between 1e-12 and 0.1, not {tolerance!r}")
    if not 0 < until <= 1:
        raise ValueError(f"indent: until is a contact fraction in (0, 1], not {until!r}")
    if not until_force > 0:
        raise ValueError(f"indent: until_force must be positive, not {until_force!r}")
    solver = ContactSolver(indenter, tolerance)
    scale = 4 * np.pi * indenter.spacing
    if depths is None:
        contacts = _levels(solver, until, until_force / scale, indenter.spacing)
    else:
        depths = np.atleast_1d(np.asarray(depths, dtype=float))
        if depths.ndim != 1 or depths.size == 0 or not np.all(np.isfinite(depths)):
            raise ValueError("indent: depths must be a list of finite numbers")
        if depths[0] <= 0 or np.any(np.diff(depths) <= 0):
            raise ValueError("indent: depths must be positive and strictly increasing")
        contacts, contact = [], solver.touch()
        for depth in depths:
            contact = solver.advance(contact, depth)
            contacts.append(_Level(contact))
    column = {name: np.array([getattr(c, name) for c in contacts]) for name in _Level.__slots__}
    return LoadingCurve(
        depth=column["depth"],
        force=scale * column["force"],
        stiffness=scale * column["stiffness"],
        contact_count=column["count"],
        elements=solver.elements,
        method="boundary elements",
        tolerance=tolerance,
        operators=solver.operators,
        residual=column["residual"],
    )


class _Level:
    """What the curve keeps of a contact: a few numbers, not its fields."""

    __slots__ = ("count", "depth", "force", "residual", "stiffness")

    def __init__(self, contact):
        for name in self.__slots__:
            setattr(self, name, getattr(contact, name))


def _levels(solver, until, until_force, spacing):
    """Levels from first touch to the contact fraction or force at which to stop."""
    most = until * solver.elements
    # The first level lies on the straight line of first touch: nothing else is in contact before its gap is closed.
    lower = solver.gap[solver.gap > 0]
    contact = solver.advance(solver.touch(), lower[0] if lower.size else spacing)
    levels = [_Level(contact)]
    while contact.count < min(_EVENTS, most) and contact.force < until_force:
        following = solver.next_event(contact)
        if following is None:
            break
        contact = following
        levels.append(_Level(contact))
    # Two events or so in the first step, and no step much longer than the one before: longer ones go untested.
    ratio = np.clip((contact.depth / levels[-min(len(levels), 5)].depth) ** 0.5, _SHORTEST, _FIRST)
    ahead = []
    while contact.count < most and contact.force < until_force:
        if not ahead:
            depth = contact.depth * ratio
            # The tangent underestimates the force: the last level is at or just beyond the force to stop at.
            depth = min(depth, contact.depth + (until_force - contact.force) / contact.stiffness)
            ahead.append(solver.advance(contact, max(depth, contact.depth * _SHORTEST)))
        error = _interpolation_error(levels[-2:], _Level(ahead[-1])) if len(levels) > 1 else 0.0
        step = ahead[-1].depth / contact.depth
        if (
            len(levels) > 1
            and error > solver.tolerance
            and step > max(_SHORTEST**2, (contact.depth / levels[-2].depth) ** 0.3)
        ):
            ahead.append(solver.advance(contact, contact.depth * np.sqrt(step)))
            continue
        contact = ahead.pop()
        levels.append(_Level(contact))
        growth = np.clip((0.7 * solver.tolerance / max(error, 1e-30)) ** (1 / 3), 0.5, 1.6)
        ratio = np.clip(step**growth, _SHORTEST, _LONGEST)
    return levels


def _interpolation_error(before, after):
    """Estimated relative error of the depth interpolated in the intervals that meet in the middle of three levels.

    It is measured: the curve is interpolated across both and compared with the level between. Over many rough discs
    the largest error within either interval was below this estimate in 95 of 100 cases (a kink of k counts more
    than the depth at the middle tells, hence its share).
    """
    ends = [before[0], after]
    across = LoadingCurve(
        *(np.array([getattr(c, name) for c in ends]) for name in ("depth", "force", "stiffness", "count")),
        elements=0,
        method="",
        tolerance=0.0,
        operators=0,
        residual=np.zeros(2),
    )
    middle = before[1]
    depth, stiffness = across.at_force(middle.force)
    return 2 * (abs(depth / middle.depth - 1) + 0.03 * abs(stiffness / middle.stiffness - 1))
