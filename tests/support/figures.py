"""Inputs of the tests of the figures, and the contents of a drawn figure."""

import numpy as np

from viscorough_study.ensembles.averages import abscissa

HURST = (0.4, 0.9)
COMBINATIONS = {
    "c1": {"force": 1.0, "viscosity": 1e6, "diameter": 1e-2, "rms": 1e-6},
    "c9": {"force": 300.0, "viscosity": 3e7, "diameter": 3e-2, "rms": 3e-7},
}
X = abscissa(1e-4, 30, 20)
ELEMENTS = 33


def ensemble_name(hurst, name):
    """Return the name of an ensemble as the workflow gives it."""
    return f"h{round(hurst * 1e4):05d}_{name}"


ENSEMBLES = {ensemble_name(hurst, name): at for hurst in HURST for name, at in COMBINATIONS.items()}


def drawn_points(axes):
    """Return every point of the lines, intervals, bands and bars of an axes."""
    paths = [path for collection in axes.collections for path in collection.get_paths()]
    bars = [patch.get_bbox().p1[None] for patch in axes.patches]
    return np.concatenate([*(line.get_xydata() for line in axes.lines), *(path.vertices for path in paths), *bars])
