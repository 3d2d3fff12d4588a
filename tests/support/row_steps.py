"""Move a row of unilateral springs by the steps in time of `march`; each spring takes the step by itself.

Every spring with gap g and stiffness w has a deflection y, a force w φ and branches b with φ = G∞ y + Σ G_b w_b + η y'.
The steps are the same as in viscorough.viscous.integration.internal_variables. The contact problem is solved by
sorting: the springs with the smallest distance from the indenter are pressed.
"""

from types import SimpleNamespace

import numpy as np
from scipy.special import exprel

_ROUNDING = 1e-12


def stepped_row(gaps, weights, relaxation, times, *, force=None, depth=None):
    """Return depth and force of the row at these times, from step to step; arrays of shape (times,).

    gaps, weights : one value per spring, shape (springs,); force or depth : one value per time
    """
    by_depth, values = force is None, np.asarray(depth if force is None else force, float)
    viscosity, relaxed, moduli, own_times = relaxation
    deflection, branches = np.zeros(gaps.size), np.zeros((moduli.size, gaps.size))
    touching = np.zeros(gaps.size, bool)
    depths, forces, rate, u = [], [], 0.0, 0.0
    for k, time in enumerate(times):
        length = time - times[k - 1] if k else 0.0
        rate = (values[k] - values[k - 1]) / length if length else rate
        if length > 0 or viscosity == 0:
            at_end = by_depth or viscosity == 0
            load = values[k] if at_end else 0.5 * (values[k - 1] + values[k])
            x = length / own_times
            decay, gain = np.exp(-x), exprel(-x)
            spring = viscosity / (length * exprel(-length * relaxed / viscosity)) if viscosity else relaxed
            stiffness = spring + moduli @ gain
            kept = relaxed * deflection + (moduli * decay) @ branches
            free = gaps + deflection - kept / stiffness  # distance of the spring without a force
            u = load if by_depth else _depth(free, weights * stiffness, load)
            pressure = np.maximum(stiffness * (u - free), 0.0)
            change = (pressure - kept) / stiffness
            branches = decay[:, None] * branches + np.outer(gain, change)
            deflection = deflection + change
            closed = gaps + deflection - u <= _ROUNDING * (abs(u) + gaps)
            touching = closed & (touching | (pressure > _ROUNDING * stiffness * (abs(u) + gaps)))
        else:  # a dashpot does not move in a step of the force, or of the depth away from the surface
            if by_depth and values[k] < u:
                touching = np.zeros_like(touching)
            u = values[k] if by_depth else u
        if by_depth and viscosity:
            kept = relaxed * deflection + moduli @ branches
            pressure = np.where(touching, np.maximum(kept + viscosity * rate, 0.0), 0.0)
        depths.append(u)
        forces.append(weights @ pressure if by_depth else values[k])
    return SimpleNamespace(depth=np.array(depths), force=np.array(forces))


def _depth(heights, stiffness, force):
    """Return the u with Σ stiffness (u − height)₊ = force; the lowest height without a force."""
    order = np.argsort(heights, kind="stable")
    heights, sums = heights[order], np.cumsum(stiffness[order])
    moments = np.cumsum(stiffness[order] * heights)
    count = max(int(np.searchsorted(sums * heights - moments, force, side="left")), 1)
    return (force + moments[count - 1]) / sums[count - 1]
