"""Read the surfaces and ensembles that the figures show.

Each function reads one argument of the functions that draw figures, and has the name of this argument. Its parameter
`files` is {name of an argument: path of the file with this argument}. Base discs are the discs that all figures use.
"""

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles import pool
from viscorough_study.ensembles.surface_files import read_surfaces


def examples(files):
    """Read the example discs; return a list of (Hurst exponent, heights, spacing)."""
    surfaces = read_surfaces(files["examples"])
    return [(realization.hurst, indenter.heights, indenter.spacing) for _, realization, indenter in surfaces]


def ensembles(files):
    """Read the curves of the base discs; return a list of ensembles, one for each Hurst exponent and combination.

    A combination is a choice of force, viscosity, diameter and rms height.
    """
    return list(pool.ensembles(pool.select(read_dataset(files["ensembles"]), group="base"), "case").values())


def discs(files):
    """Read the curves of the base discs; return a list of ensembles, one for each Hurst exponent in ascending order."""
    by_hurst = pool.ensembles(pool.select(read_dataset(files["discs"]), group="base"), "hurst")
    return [by_hurst[hurst] for hurst in sorted(by_hurst)]


def lines(files):
    """Read the MDR lines; return a list of ensembles, one for each Hurst exponent."""
    return list(pool.ensembles(read_dataset(files["lines"]), "hurst").values())


def groups(files):
    """Read the measured surfaces; return {name of a group of scans: ensemble of this group}."""
    return pool.ensembles(read_dataset(files["groups"]), "group")
