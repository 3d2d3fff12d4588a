"""Kinetics of ensembles in other media than the paper's, under a constant force applied at time 0.

In any linear viscoelastic medium of creep compliance J(t) the depth is that of the loading curve at F/G = F J(t), so
that u/h is one function of X = F J(t)/(4hL) for all media, and vt/h = (d ln X/d ln t) X/κ(X). With the paper's J = t/η
this is its vt/h = X/κ. A power law in X is a power law in time only while J is one.
"""

import numpy as np
import pandas as pd

from viscorough.io.media import medium_from_mapping
from viscorough.viscous.correspondence import kinetics
from viscorough_study.power_law import local_slope

COLUMNS = {
    "medium": ("name of the medium", None),
    "hurst": ("Hurst exponent H", "1"),
    "time": ("time t since the force was applied", "s"),
    "x": ("dimensionless creep X = F J(t)/(4hL)", "1"),
    "depth": ("geometric mean of the depth u/h", "1"),
    "velocity": ("geometric mean of the velocity vt/h", "1"),
    "velocity_error": ("two standard errors of ln(vt/h)", "1"),
    "exponent": ("local exponent d ln(vt/h)/d ln t, fitted over a quarter of a decade to either side", "1"),
    "realizations": ("realizations in the mean", "1"),
}
HALF_WIDTH = 0.25  # decades of time to either side over which local exponents are fitted


def named_media(cases):
    """{name: medium of viscorough.viscous.media} of the settings: mappings with a name and the keys of a medium."""
    return {case["name"]: medium_from_mapping({k: v for k, v in case.items() if k != "name"}) for case in cases}


def media_table(ensembles, media, *, force, times):
    """Means over the realizations of every ensemble in every medium, with `COLUMNS`.

    ensembles : {H: (loading curves, their rms heights, diameter)} [m]
    media : {name: medium of viscorough.viscous.media} in Pa and s; force : F [N]; times : t > 0, increasing [s]

    Times at which a curve ends before the depth is reached are left out. X is that of the mean rms height.
    """
    parts = []
    for name, medium in media.items():
        compliance = medium.creep_compliance(times)
        for hurst, (curves, rms, diameter) in ensembles.items():
            depth, velocity = (np.full((len(curves), times.size), np.nan) for _ in range(2))
            for i, (curve, height) in enumerate(zip(curves, rms, strict=True)):
                reached = force * compliance <= curve.force[-1]
                if reached.any():
                    motion = kinetics(curve, force, medium, times[reached])
                    depth[i, reached] = motion.depth / height
                    velocity[i, reached] = motion.velocity * motion.time / height
            x = force * compliance / (4 * np.mean(rms) * diameter)
            parts.append(_means(times, x, depth, velocity).assign(medium=name, hurst=hurst))
    return pd.concat(parts, ignore_index=True)[list(COLUMNS)]


def _means(times, x, depth, velocity):
    """Geometric means at the times at which all realizations are defined and move."""
    defined = np.isfinite(depth).all(axis=0) & (velocity > 0).all(axis=0)
    log_depth, log_velocity = np.log(depth[:, defined]), np.log(velocity[:, defined])
    mean, time = log_velocity.mean(axis=0), times[defined]
    number = len(velocity)
    return pd.DataFrame(
        {
            "time": time,
            "x": x[defined],
            "depth": np.exp(log_depth.mean(axis=0)),
            "velocity": np.exp(mean),
            "velocity_error": 2 * log_velocity.std(axis=0, ddof=1) / np.sqrt(number),
            "exponent": local_slope(time, np.exp(mean), HALF_WIDTH),
            "realizations": number,
        }
    )
