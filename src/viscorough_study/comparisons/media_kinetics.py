"""Kinetics of ensembles in media other than the paper's, under a constant force applied at time 0.

In any linear viscoelastic medium of creep compliance J(t) the depth is that of the loading curve at F/G = F J(t), so
that u/h is one function of X = F J(t)/(4hL) for all media, and vt/h = a X/κ(X), where a = d ln J/d ln t is the exponent
of J. With the paper's J = t/η this is its vt/h = X/κ. Where X/κ = X^β/ζ, the exponent of vt/h in time is
β a + d ln a/d ln t: a power law in X is a power law in time only while J is one.
"""

from itertools import product

import numpy as np
import pandas as pd

from viscorough.io.curves import unstack_curves
from viscorough.io.media import medium_from_mapping
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
    "realizations": ("realizations in the mean", "1"),
}
HALF_WIDTH = 0.25  # decades of time to either side over which local exponents are fitted


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


def named_media(cases):
    """{name: medium} of mappings with a name and the keys of a medium."""
    return {case["name"]: medium_from_mapping({k: v for k, v in case.items() if k != "name"}) for case in cases}


def media_table(ensembles, media, *, force, times):
    """Means over the realizations of every ensemble in every medium; a pandas.DataFrame with the columns of `COLUMNS`.

    ensembles : {H: (loading curves, their rms heights, diameter)} [m]
    media : {name: medium of viscorough.viscous.media} in Pa and s; force : F [N]
    times : t > 0, logarithmically uniform [s]
    Times at which a depth lies beyond the end of its curve are omitted. X is that of the mean rms height.
    """
    parts = []
    for (name, medium), (hurst, (curves, rms, diameter)) in product(media.items(), ensembles.items()):
        time = reached_times(min(curve.force[-1] for curve in curves), force, medium, times)
        if not time.size:
            continue
        motions = [kinetics(curve, force, medium, time) for curve in curves]
        depth = np.array([motion.depth / height for motion, height in zip(motions, rms, strict=True)])
        velocity = np.array([motion.velocity * time / height for motion, height in zip(motions, rms, strict=True)])
        moving = (velocity > 0).all(axis=0)
        time, mean = time[moving], np.log(velocity[:, moving]).mean(axis=0)
        columns = {
            "medium": name,
            "hurst": hurst,
            "time": time,
            "x": force * medium.creep_compliance(time) / (4 * np.mean(rms) * diameter),
            "depth": np.exp(np.log(depth[:, moving]).mean(axis=0)),
            "velocity": np.exp(mean),
            "exponent": local_slopes(np.log(time), mean, HALF_WIDTH * np.log(10)),
            "realizations": len(curves),
        }
        parts.append(pd.DataFrame(columns))
    return pd.concat(parts, ignore_index=True)[list(COLUMNS)]


def reached_times(last, force, medium, times):
    """The times at which the creep under a constant force is at most the last F/G of a loading curve."""
    return times[force * medium.creep_compliance(times) <= last]
