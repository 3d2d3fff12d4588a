"""Read the inputs of figures that are not tables.

Each function reads one argument of the functions that draw figures, and has the name of this argument. The parameter
`files` is {argument: path of its file}.
"""

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles import pool
from viscorough_study.ensembles.surface_files import read_surfaces


def examples(files):
    """Return a list of (Hurst exponent, heights, spacing) of the example discs."""
    surfaces = read_surfaces(files["examples"])
    return [(realization.hurst, indenter.heights, indenter.spacing) for _, realization, indenter in surfaces]


def ensembles(files):
    """Return a list of the base discs of a pool, one ensemble (ensembles.pool) per case."""
    return list(pool.ensembles(pool.select(read_dataset(files["ensembles"]), group="base"), "case").values())


def discs(files):
    """Return a list of the base discs of a pool, one ensemble per Hurst exponent, by ascending exponent."""
    by_hurst = pool.ensembles(pool.select(read_dataset(files["discs"]), group="base"), "hurst")
    return [by_hurst[hurst] for hurst in sorted(by_hurst)]


def lines(files):
    """Return a list of the lines of a pool, one ensemble per Hurst exponent."""
    return list(pool.ensembles(read_dataset(files["lines"]), "hurst").values())


def groups(files):
    """Return the measured surfaces of a pool, {group of surfaces: ensemble}."""
    return pool.ensembles(read_dataset(files["groups"]), "group")
