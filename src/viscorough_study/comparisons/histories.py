"""Compare motions of the row of springs with direct integration: loading, unloading and reloading.

The row of springs is a model of a surface: independent springs that have the same loading curve as the surface
(docs/theory.md, Any history). If each spring is replaced by a viscoelastic element that can push but not pull, the row
gives force and depth for any history (`viscorough.kinetics`). Direct integration (`viscorough.march`) computes the same
motion in time without the loading curve. Its error is of second order in the time step. If the motion of the row is
exact, half the time step therefore reduces the deviation between the two motions to a quarter.
"""

from itertools import pairwise

import numpy as np
import pandas as pd

from viscorough.contact.loading_path import indent
from viscorough.media.kinds import StandardLinearSolid
from viscorough.media.load import Load
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough.viscous.integration.march import march
from viscorough.viscous.kinetics import kinetics
from viscorough_study.run.seeds import gamma_factor_key, realization_seed

FORCE_CURVE, RECOVERY = "force curve", "recovery"
COLUMNS = {
    "motion": (f"{FORCE_CURVE}: depth ramped up, down and up again; {RECOVERY}: constant force, then removed", ""),
    "hurst": ("Hurst exponent H", "1"),
    "duration": ("duration T of a ramp, or of the force, over the relaxation time τ", "1"),
    "time": ("time t/τ since the start of the ramps, or since the removal of the force", "1"),
    "depth": ("depth u/h by the row of springs", "1"),
    "force": ("force F/(GhL) by the row of springs, with the relaxed shear modulus G", "1"),
    "direct": ("force in a force curve, depth in a recovery, by direct integration", "1"),
    "deviation": ("direct integration less row of springs, over the largest force or depth of the motion", "1"),
    "deviation_coarse": ("the same with time steps twice as long", "1"),
}
MEDIUM = StandardLinearSolid(4.0, 1.0, 1.0)  # its shear modulus relaxes from 4 G to G with the relaxation time τ = 1
# Durations of a ramp, or of a constant force, in units of the relaxation time τ: a fast motion, a motion about as fast
# as the medium relaxes, and a slow motion.
DURATIONS = 0.1, 1.0, 10.0
RAMPS = 0.0, 1.0, 0.0, 1.0  # depths at the ends of the ramps of a force curve, as shares of the largest depth
# Record the depth for this time after the force is removed, in units of τ. The retardation time of the medium is 4 τ.
RECOVERY_TIME = 10.0
# Number of coarse time steps between two samples of the load. Fine steps are half as long.
STEPS = 60
# Largest contact fraction of the loading curves. On a disc with 65 elements across, about 165 elements then touch.
FRACTION = 0.05
LAST = 0.99  # the motions use the loading curve up to this share of its last depth and force
TOLERANCE = 1e-6  # tolerance of the loading curves


def compare_histories(*, hursts, elements, seed):
    """Compare motions of discs by a row of springs (see the module) and by direct integration; return a table.

    Returns a pandas.DataFrame with the columns of `COLUMNS`.

    There is one disc per Hurst exponent. Each disc undergoes two kinds of motion, each with three durations. In a force
    curve the depth is prescribed; the contact opens and closes again. In a recovery a constant force is removed; all
    recoveries of a disc start at the same depth.
    hursts : Hurst exponents; elements : number of elements across every disc; seed : root of the discs' seeds
    """
    tables = []
    for hurst in hursts:
        disc = self_affine_disc(hurst, elements, seed=realization_seed(seed, *gamma_factor_key(hurst)))
        curve = indent(disc, tolerance=TOLERANCE, until_fraction=FRACTION)
        for duration in DURATIONS:
            ramps = Load(duration * np.arange(len(RAMPS)), depth=LAST * curve.depth[-1] * np.array(RAMPS))
            force = LAST * curve.force[-1] / MEDIUM.creep_compliance(duration)
            removed = Load([-duration, 0, 0, RECOVERY_TIME], force=[force, force, 0, 0])
            for motion, load in ((FORCE_CURVE, ramps), (RECOVERY, removed)):
                compared = _compare(disc, curve, load)
                tables.append(pd.DataFrame({"motion": motion, "hurst": hurst, "duration": duration} | compared))
    return pd.concat(tables, ignore_index=True)[list(COLUMNS)]


def _compare(disc, curve, load):
    """Compute a motion by the row of springs and by direct integration; return {column: values}.

    The values are at the ends of the coarse time steps of the direct integration.

    disc : rough disc with h = L = 1; curve : LoadingCurve of the disc; load : prescribed force or depth as a Load
    """
    fine, coarse = (_with_steps(load, number) for number in (2 * STEPS, STEPS))
    quantity = "force" if load.by_depth else "depth"
    springs = kinetics(curve, coarse, MEDIUM)
    exact = getattr(springs, quantity)
    direct = getattr(march(disc, fine, MEDIUM), quantity)[np.isin(fine.time, coarse.time)]
    direct_coarse = getattr(march(disc, coarse, MEDIUM), quantity)
    return {
        "time": springs.time,
        "depth": springs.depth,
        "force": springs.force,
        "direct": direct,
        "deviation": (direct - exact) / exact.max(),
        "deviation_coarse": (direct_coarse - exact) / exact.max(),
    }


def _with_steps(load, number):
    """Return the load with `number` equal time steps between neighbouring samples."""
    parts = [np.linspace(start, end, number + 1) for start, end in pairwise(load.time)]
    return load.with_times(np.unique(np.concatenate(parts)))[0]
