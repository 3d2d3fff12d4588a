"""Result type of an estimate: depth and velocity of a rough indenter, by the calibrated penetration law."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscorough.basics.summaries import span
from viscorough.law.calibrated_law import PenetrationLaw


@dataclass(frozen=True, eq=False)
class Estimate:
    """Depth and velocity by the penetration law, as functions of time; arrays of shape (times,).

    Depths and velocities are nan at times when X lies outside the range of the law.

    time : times t
    x : dimensionless force X = F·J(t)/(4hL), with force F, creep compliance J, rms height h and diameter L
    depth, velocity : u and v = du/dt, as arithmetic means over many surfaces at the same X. The X of each surface
        contains the rms height of this surface. u has the unit of the rms height, and v has this unit divided by the
        unit of time
    law : PenetrationLaw, which holds for X from law.x_low to law.x_high. Its relative errors, compared with means over
        many surfaces, are at most law.depth_error and law.velocity_error
    """

    time: np.ndarray
    x: np.ndarray
    depth: np.ndarray
    velocity: np.ndarray
    law: PenetrationLaw

    @property
    def where(self) -> NDArray[Any]:
        """Return for every time "" if X is within the range of the law, else "below" or "above"."""
        return np.select([self.x < self.law.x_low, self.x > self.law.x_high], ["below", "above"], "")

    def __repr__(self) -> str:
        """Return a line with the number of times and the ranges of times, X, depths and velocities."""
        ranges = (f"{name} {span(getattr(self, name))}" for name in ("time", "x", "depth", "velocity"))
        return f"Estimate at {self.time.size} times, {', '.join(ranges)}"

    def __str__(self) -> str:
        """Return a table with time, X, depth and velocity in each row, and a last line with the errors of the law."""
        head = f"{'time':>10} {'X':>10} {'depth':>10} {'velocity':>10}"
        columns = (self.time, self.x, self.depth, self.velocity)
        rows = [
            " ".join(f"{'-' if np.isnan(value) else f'{value:.4g}':>10}" for value in row)
            + (f"  {where}" if where else "")
            for *row, where in zip(*columns, self.where, strict=True)
        ]
        law = self.law
        errors = (
            f"mean of many surfaces: depth ± {100 * law.depth_error:.2g} %, velocity ± {100 * law.velocity_error:.2g} %"
        )
        return "\n".join([head, *rows, errors])
