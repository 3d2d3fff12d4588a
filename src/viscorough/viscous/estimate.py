"""Estimate depth and velocity of a rough indenter from the calibrated penetration law, without a simulation.

In a medium with creep compliance J(t), the depth at time t under a constant force F is the depth of an elastic contact
under the same force in a medium of modulus 1/J(t) (viscous.kinetics). With the rms height h, the diameter L, and the
reduced force X = F·J(t)/(4hL), depth and velocity are

    u = h·D(X),    v = h·(J'(t)/J(t))·V(X).

The penetration law gives the functions D = u/h and V = vt/h. In a Newtonian medium J = t/η, and so v = (h/t)·V(X).
"""

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import increasing, positive, real_numbers
from viscorough.basics.summaries import span
from viscorough.law.calibrated_law import penetration_law
from viscorough.law.estimate import Estimate
from viscorough.media.creep_response import constant_creep
from viscorough.media.kinds import medium_of
from viscorough.media.medium import Medium


def estimate(
    hurst: float, rms: float, diameter: float, force: float, medium: Medium | float, times: "ArrayLike"
) -> Estimate:
    """Estimate depth and velocity of a self-affine indenter under a constant force by the calibrated law.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from 0.1 to 1.
    rms : float
        Rms height h [length].
    diameter : float
        Diameter L of the indenter [length].
    force : float
        Force F > 0, constant from time 0 on. It is in units such that F·J, with the creep compliance J of the medium,
        is a length².
    medium : Medium or float
        Medium such as viscorough.Maxwell, or the viscosity of a Newtonian medium.
    times : array_like
        Times above 0, increasing.

    Returns
    -------
    Estimate
        Depth and velocity at `times`, as means over many surfaces; nan at times at which the law does not hold.

    Raises
    ------
    ValueError
        For values outside these ranges, and if the law holds at none of the times.

    Examples
    --------
    >>> import viscorough
    >>> motion = viscorough.estimate(0.7, rms=0.1, diameter=1.0, force=1.0, medium=1.0, times=[0.01, 0.1])
    >>> motion.depth.round(3)
    array([0.058, 0.157])
    """
    law, medium = penetration_law(hurst), medium_of(medium)
    rms, diameter, force = positive("rms", rms), positive("diameter", diameter), positive("force", force)
    times = np.atleast_1d(real_numbers("argument times", times))
    times = increasing("argument times", times, above_zero=True)
    creep, rate = constant_creep(force, medium, times)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        x = creep / (4 * rms * diameter)
    inside = (x >= law.x_low) & (x <= law.x_high)
    if not inside.any():
        raise ValueError(
            f"argument times: X = F·J(t)/(4hL) is {span(x)}; allowed: {law.x_low:.3g} to {law.x_high:.3g}, where "
            "the law holds; elsewhere indent a surface made by viscorough generate"
        )
    per_time, covered = rms * rate[inside] / creep[inside], x[inside]
    depth, velocity = np.full((2, times.size), np.nan)
    depth[inside], velocity[inside] = rms * law.depth(covered), per_time * law.velocity(covered)
    return Estimate(times, x, depth, velocity, law)
