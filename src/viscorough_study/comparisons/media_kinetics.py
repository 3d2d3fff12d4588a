"""Compute kinetics of ensembles in media other than the paper's, under a constant force from time 0 on.

In a linear viscoelastic medium with the creep compliance J(t), the depth at time t is the depth of the elastic loading
curve at F/G = F J(t). So u/h is the same function of X = F J(t)/(4hL) in all media. The velocity is vt/h = a X/κ(X),
where a = d ln J/d ln t is the local exponent of J. The paper's medium has J = t/η, so a = 1 and vt/h = X/κ. If X/κ is a
power law, X^β/ζ, the exponent of vt/h in time is β a + d ln a/d ln t. A power law in X is therefore a power law in time
only while J is a power law.
"""

from itertools import chain, product

import numpy as np
import pandas as pd

from viscorough.io.medium_files import medium_from_mapping
from viscorough.viscous.kinetics import kinetics
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
HALF_WIDTH = 0.25  # the fit of a local exponent at a time extends over this many decades to either side of this time


def named_media(media):
    """Return {name: medium} for mappings that contain a name and the parameters of a medium (io.medium_files)."""
    return {own["name"]: medium_from_mapping({k: v for k, v in own.items() if k != "name"}) for own in media}


def media_of_batches(batches, *, discs, rms_convention, media, times, force):
    """Return the `media_table` of loading curves that are stored in files (ensembles.curve_files).

    batches : iterable of lists of (Realization, LoadingCurve), one for each file
    discs : names of the ensembles of discs that are used
    rms_convention : where the rms height h is measured (fits.conventions); force : F [N]
    media : media, each described by a mapping, for `named_media`
    times : {"low", "high", "per_decade"}, the range [s] and the number per decade of the times
    """
    ensembles = {}
    for realization, curve in chain.from_iterable(batches):
        if realization.ensemble in discs:
            groups = ensembles.setdefault(realization.hurst, {})
            curves, rms, _ = groups.setdefault(realization.until_x, ([], [], realization.diameter))
            curves.append(curve)
            rms.append(realization.rms[rms_convention])
    ensembles = {hurst: list(groups.values()) for hurst, groups in ensembles.items()}
    return media_table(ensembles, named_media(media), force=force, times=abscissa(**times))


def media_table(ensembles, media, *, force, times):
    """Average the motion over each ensemble in each medium; return a pandas.DataFrame with `COLUMNS`.

    ensembles : {H: groups of surfaces}. A group is (loading curves, rms heights [m], diameter [m]); all its curves were
        computed up to the same X
    media : {name: medium of viscorough.media.kinds} in Pa and s; force : F [N]
    times : times t > 0, logarithmically uniform [s]
    A curve reaches a time if the depth at this time is on the curve. The mean at a time contains only groups whose
    curves all reach this time. The table omits times that no group reaches, and times at which a velocity is 0. It has
    no rows if no group reaches any time. X is computed with the mean rms height.
    """
    parts = [pd.DataFrame(columns=list(COLUMNS))]
    for (name, medium), (hurst, groups) in product(media.items(), ensembles.items()):
        motions = [_motions(*group, medium, force=force, times=times) for group in groups]
        depth, velocity = (np.concatenate(values) for values in zip(*motions, strict=True))
        moving = (velocity > 0).any(axis=0) & ~(velocity <= 0).any(axis=0)
        if not moving.any():
            continue
        time, mean = times[moving], np.nanmean(np.log(velocity[:, moving]), axis=0)
        rms, diameter = np.concatenate([rms for _, rms, _ in groups]), groups[0][2]
        columns = {
            "medium": name,
            "hurst": hurst,
            "time": time,
            "x": force * medium.creep_compliance(time) / (4 * np.mean(rms) * diameter),
            "depth": np.exp(np.nanmean(np.log(depth[:, moving]), axis=0)),
            "velocity": np.exp(mean),
            "exponent": local_slopes(np.log(time), mean, HALF_WIDTH * np.log(10)),
            "realizations": np.isfinite(velocity[:, moving]).sum(axis=0),
        }
        parts.append(pd.DataFrame(columns))
    return pd.concat(parts[1:] or parts, ignore_index=True)[list(COLUMNS)]


def _motions(curves, rms, _, medium, *, force, times):
    """Return u/h and vt/h of a group of loading curves, each of shape (curves, times).

    The values at a time are nan unless all curves of the group reach this time.
    """
    time = reached_times(min(curve.force[-1] for curve in curves), force, medium, times)
    depth, velocity = np.full((2, len(curves), times.size), np.nan)
    for i, (curve, height) in enumerate(zip(curves, rms, strict=True)):
        if time.size:
            motion = kinetics(curve, force, medium, time)
            depth[i, : time.size], velocity[i, : time.size] = motion.depth / height, motion.velocity * time / height
    return depth, velocity


def reached_times(last, force, medium, times):
    """Return the times at which the depth under a constant force F is still on a loading curve, that is F J(t) <= last.

    last : F/G at the end of the loading curve; J : creep compliance of the medium; times : times to choose from
    """
    return times[force * medium.creep_compliance(times) <= last]
