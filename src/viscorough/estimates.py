"""Estimate depth and velocity of a rough indenter from the calibrated penetration law, without a simulation.

A constant force F on a medium of creep compliance J(t) acts as the elastic force F/G = F·J(t) (viscous.kinetics).
With X = F·J(t)/(4hL) the law gives

    u = h·(u/h)(X),    v = h·(J'(t)/J(t))·(vt/h)(X),    for a Newtonian medium J = t/η: v = (h/t)·(vt/h)(X).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscorough.argument_names import argument
from viscorough.arrays import ReadOnlyArrays, increasing, real_numbers
from viscorough.calibrated_law import PenetrationLaw, penetration_law
from viscorough.indenter import positive
from viscorough.summaries import span
from viscorough.viscous.creep_response import constant_creep
from viscorough.viscous.media import medium_of
from viscorough.viscous.medium import Medium


@dataclass(frozen=True)
class Estimate(ReadOnlyArrays):
    """Depth and velocity over time by the penetration law, arrays of shape (times,); nan outside the range of the law.

    time : times t
    x : dimensionless force X = F·J(t)/(4hL)
    depth, velocity : u and v = du/dt, arithmetic means over many surfaces at the same X, with h of each surface in X;
        u in the unit of the rms height, v in that unit per unit of time
    depth_low, depth_high, velocity_low, velocity_high : ends of the intervals that contain 95 % of single surfaces
    law : PenetrationLaw, which holds from law.x_low to law.x_high. The relative differences between its depth and
        velocity and the means over many surfaces are at most law.depth_error and law.velocity_error
    """

    time: np.ndarray
    x: np.ndarray
    depth: np.ndarray
    depth_low: np.ndarray
    depth_high: np.ndarray
    velocity: np.ndarray
    velocity_low: np.ndarray
    velocity_high: np.ndarray
    law: PenetrationLaw

    @property
    def where(self) -> NDArray[Any]:
        """Return for every time "" in the range of the law, "below" or "above" outside it."""
        return np.select([self.x < self.law.x_low, self.x > self.law.x_high], ["below", "above"], "")

    def __repr__(self) -> str:
        """Return the number of times, and the ranges of times, X, depths and velocities."""
        ranges = (f"{name} {span(getattr(self, name))}" for name in ("time", "x", "depth", "velocity"))
        return f"Estimate at {self.time.size} times, {', '.join(ranges)}"

    def __str__(self) -> str:
        """Return a table of time, X, depth and velocity with intervals of single surfaces, and the errors of means."""
        head = f"{'time':>10} {'X':>10} {'depth':>10} {'from':>10} {'to':>10} {'velocity':>10} {'from':>10} {'to':>10}"
        columns = (self.time, self.x, self.depth, self.depth_low, self.depth_high)
        columns += (self.velocity, self.velocity_low, self.velocity_high)
        rows = [
            " ".join(f"{'-' if np.isnan(value) else f'{value:.4g}':>10}" for value in row)
            + (f"  {where}" if where else "")
            for *row, where in zip(*columns, self.where, strict=True)
        ]
        law = self.law
        intervals = (
            f"from, to: 95 % of single surfaces; mean of many surfaces: depth ± {100 * law.depth_error:.2g} %, "
            f"velocity ± {100 * law.velocity_error:.2g} %"
        )
        return "\n".join([head, *rows, intervals])


def estimate(
    hurst: float, rms: float, diameter: float, force: float, medium: Medium | float, times: "ArrayLike"
) -> Estimate:
    """Estimate depth and velocity of a self-affine indenter under a constant force by the calibrated law.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from 0.1 to 1 [1].
    rms : float
        Rms height h [length].
    diameter : float
        Diameter L of the indenter [length].
    force : float
        Force F > 0, constant from time 0 on, in units such that F·J is a length².
    medium : Medium or float
        Medium such as viscorough.Maxwell, or the viscosity of a Newtonian medium.
    times : array_like
        Times above 0, increasing.

    Returns
    -------
    Estimate

    Raises
    ------
    ValueError
        For values outside these ranges, and if the law holds at none of the times.

    Examples
    --------
    >>> import viscorough
    >>> motion = viscorough.estimate(0.7, rms=0.1, diameter=1.0, force=1.0, medium=1.0, times=[0.01, 0.1])
    >>> bool(motion.depth_low[0] < motion.depth[0] < motion.depth_high[0])
    True
    """
    law, medium = penetration_law(hurst), medium_of(medium)
    rms, diameter, force = positive("rms", rms), positive("diameter", diameter), positive("force", force)
    times = np.atleast_1d(real_numbers(argument("times"), times))
    times = increasing(argument("times"), times, above_zero=True)
    creep, rate = constant_creep(force, medium, times)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        x = creep / (4 * rms * diameter)
    inside = (x >= law.x_low) & (x <= law.x_high)
    if not inside.any():
        raise ValueError(
            f"{argument('times')}: X = F·J(t)/(4hL) is {span(x)}; allowed: {law.x_low:.3g} to {law.x_high:.3g}, where "
            "the law holds; elsewhere indent a surface made by viscorough generate"
        )
    per_time, covered = rms * rate[inside] / creep[inside], x[inside]
    values = np.full((6, times.size), np.nan)
    values[:3, inside] = rms * np.array([law.depth(covered), *law.depth_interval(covered)])
    values[3:, inside] = per_time * np.array([law.velocity(covered), *law.velocity_interval(covered)])
    depth, depth_low, depth_high, velocity, velocity_low, velocity_high = values
    return Estimate(times, x, depth, depth_low, depth_high, velocity, velocity_low, velocity_high, law)
