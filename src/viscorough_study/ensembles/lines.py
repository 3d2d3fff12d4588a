"""Compute the loading curves of an ensemble of lines by the method of dimensionality reduction; no line is stored."""

import numpy as np

from viscorough.mdr import reduce_heights
from viscorough.surfaces.lines import SelfAffineLines
from viscorough_study.ensembles.realization import Realization


def line_curves(name, spawn_key, surface, points, numbers, *, seed, until_x):
    """Yield (Realization, LoadingCurve) of the lines of an ensemble, up to X = F/(4GhL) = until_x.

    Lengths have no unit.

    name, spawn_key, surface, points, numbers : description of the ensemble (run.samples.batch_ensembles)
    seed : root seed of the seeds of all lines
    """
    lines = SelfAffineLines(points=points, **surface)  # for all realizations
    for number in range(*numbers):
        # every line has the nominal rms height
        labels = name, number, surface["hurst"], surface["length"], lines.spacing, {"line": surface["rms"]}, until_x
        realization = Realization(*labels)
        heights = lines.heights_in_any_order(np.random.SeedSequence(seed, spawn_key=(*spawn_key, number)))
        yield realization, reduce_heights(heights, lines.spacing, until_force=realization.until_force)
