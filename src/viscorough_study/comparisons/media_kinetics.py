"""Kinetics of ensembles in media other than the paper's, under a constant force applied at time 0.

In any linear viscoelastic medium of creep compliance J(t) the depth is that of the loading curve at F/G = F J(t), so
that u/h is one function of X = F J(t)/(4hL) for all media, and vt/h = a X/κ(X), where a = d ln J/d ln t is the exponent
of J. With the paper's J = t/η this is its vt/h = X/κ. Where X/κ = X^β/ζ, the exponent of vt/h in time is
β a + d ln a/d ln t: a power law in X is a power law in time only while J is one.
"""

import numpy as np
import pandas as pd

from viscorough.io.curves import unstack_curves
from viscorough.io.media import medium_from_mapping
from viscorough.reference import exponent_beta
from viscorough.viscous.correspondence import kinetics
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.power_law import local_slopes

COLUMNS = {
    "medium": ("name of the medium", None),
    "hurst": ("Hurst exponent H", "1"),
    "time": ("time t since the force was applied", "s"),
    "x": ("dimensionless creep X = F J(t)/(4hL)", "1"),
    "depth": ("geometric mean of the depth u/h", "1"),
    "velocity": ("geometric mean of the velocity vt/h", "1"),
    "exponent": ("local exponent d ln(vt/h)/d ln t, fitted over a quarter of a decade to either side", "1"),
    "creep_exponent": ("local exponent a = d ln J/d ln t of the creep compliance", "1"),
    "expected": ("local exponent of vt/h by Eq. 10, β a + d ln a/d ln t with β = H/(1 + H)", "1"),
    "realizations": ("realizations in the mean", "1"),
}
HALF_WIDTH = 0.25  # decades of time to either side over which local exponents are fitted


def named_media(cases):
    """{name: medium of viscorough.viscous.media} of the settings: mappings with a name and the keys of a medium."""
    return {case["name"]: medium_from_mapping({k: v for k, v in case.items() if k != "name"}) for case in cases}


def media_of_batches(curves, *, discs, until_x, rms_convention, cases, times, force):
    """`media_table` of batches of loading curves.

    curves : Content of the batches; discs, until_x : select the curves of these ensembles that were computed up to
        X = until_x; rms_convention : of h
    cases : [name and further keys of a medium]; times : low, high [s] and per_decade; force : F [N]
    """
    ensembles = {}
    for batch in curves:
        values = {name: variable.values for name, variable in batch.variables.items()}
        read, heights = unstack_curves(batch), values[f"rms_{rms_convention}"]
        diameter, hurst = np.broadcast_to(values["diameter"], heights.shape), values["hurst"].item()
        for i in np.flatnonzero(np.isin(values["case"].astype(str), discs) & (values["until_x"] == until_x)):
            joined, rms, _ = ensembles.get(hurst, ([], [], None))
            ensembles[hurst] = [*joined, read[i]], [*rms, heights[i]], diameter[i]
    return media_table(ensembles, named_media(cases), force=force, times=abscissa(**times))


def media_table(ensembles, media, *, force, times):
    """Means over the realizations of every ensemble in every medium; a pandas.DataFrame with the columns of `COLUMNS`.

    ensembles : {H: (loading curves, their rms heights, diameter)} [m]
    media : {name: medium of viscorough.viscous.media} in Pa and s; force : F [N]
    times : t > 0, logarithmically uniform [s]
    Times at which a depth lies beyond the end of its curve are omitted. X is that of the mean rms height.
    """
    parts = []
    for name, medium in media.items():
        creep = medium.creep_compliance(times), times * medium.creep_rate(times) / medium.creep_compliance(times)
        for hurst, (curves, rms, diameter) in ensembles.items():
            depth, velocity = _motions(curves, rms, medium, force, times)
            x = force * creep[0] / (4 * np.mean(rms) * diameter)
            defined = np.isfinite(depth).all(axis=0) & (velocity > 0).all(axis=0)
            motion = [values[..., defined] for values in (times, x, creep[1], depth, velocity)]
            parts.append(_means(*motion, exponent_beta(hurst)).assign(medium=name, hurst=hurst))
    return pd.concat(parts, ignore_index=True)[list(COLUMNS)]


def _motions(curves, rms, medium, force, times):
    """u/h and vt/h of all realizations, shape (realizations, times); nan where a curve has ended."""
    depth, velocity = np.full((2, len(curves), times.size), np.nan)
    for i, (curve, height) in enumerate(zip(curves, rms, strict=True)):
        if motion := motion_on_curve(curve, force, medium, times):
            end = motion.time.size  # the first times, because the creep compliance grows with time
            depth[i, :end] = motion.depth / height
            velocity[i, :end] = motion.velocity * motion.time / height
    return depth, velocity


def motion_on_curve(curve, force, medium, times):
    """Kinetics under a constant force at the times whose depth is on the loading curve; None if there are none."""
    reached = times[force * medium.creep_compliance(times) <= curve.force[-1]]
    return kinetics(curve, force, medium, reached) if reached.size else None


def _means(time, x, creep_exponent, depth, velocity, beta):
    """Table of geometric means; depth, velocity : shape (realizations, times), defined and with velocity > 0."""
    mean, log_time, half_width = np.log(velocity).mean(axis=0), np.log(time), HALF_WIDTH * np.log(10)
    return pd.DataFrame(
        {
            "time": time,
            "x": x,
            "depth": np.exp(np.log(depth).mean(axis=0)),
            "velocity": np.exp(mean),
            "exponent": local_slopes(log_time, mean, half_width),
            "creep_exponent": creep_exponent,
            "expected": local_slopes(log_time, np.log(creep_exponent * x**beta), half_width),
            "realizations": len(velocity),
        }
    )
