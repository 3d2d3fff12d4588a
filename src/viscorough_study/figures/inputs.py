"""Read the surfaces and ensembles that the figures show.

Each function reads one argument of the functions that draw figures, from the file with this path. Base discs are the
discs that all figures use.
"""

from functools import cache

import numpy as np

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles import pool
from viscorough_study.ensembles.surface_files import read_surfaces
from viscorough_study.fits.conventions import READINGS

_read = cache(read_dataset)  # a figure shows several parts of the same file


def examples(path):
    """Read the example discs; return a list of (Hurst exponent, heights, spacing)."""
    surfaces = read_surfaces(path)
    return [(realization.hurst, indenter.heights, indenter.spacing) for _, realization, indenter in surfaces]


def ensembles(path):
    """Read the curves of the base discs; return a list of ensembles, one for each Hurst exponent and combination.

    A combination is a choice of force, viscosity, diameter and rms height.
    """
    return list(pool.ensembles(pool.select(_read(path), group="base"), "ensemble").values())


def discs(path):
    """Read the curves of the base discs; return a list of ensembles, one for each Hurst exponent in ascending order."""
    by_hurst = pool.ensembles(pool.select(_read(path), group="base"), "hurst")
    return [by_hurst[hurst] for hurst in sorted(by_hurst)]


def longer_period(path):
    """Read the curves of the discs of reading B; return a list of ensembles, one for each Hurst exponent."""
    by_hurst = pool.ensembles(pool.select(_read(path), group="longer_period"), "hurst")
    return [by_hurst[hurst] for hurst in sorted(by_hurst)]


def controls(path):
    """Read the curves of discs that belong to no reading of the paper; return a list of ensembles, one for each H."""
    groups = [own["group"] for own in READINGS.values()]
    chosen = ~np.isin(_read(path)["group"].values, groups)
    return list(pool.ensembles(_read(path).isel(realization=chosen), "group", "hurst").values())


def lines(path):
    """Read the MDR lines; return a list of ensembles, one for each Hurst exponent."""
    return list(pool.ensembles(_read(path), "hurst").values())


def groups(path):
    """Read the measured surfaces; return {name of a group of scans: ensemble of this group}."""
    return pool.ensembles(_read(path), "group")


# {argument of functions that draw figures: function that reads it}
READERS = {
    "examples": examples,
    "ensembles": ensembles,
    "discs": discs,
    "longer_period": longer_period,
    "controls": controls,
    "lines": lines,
    "groups": groups,
}
