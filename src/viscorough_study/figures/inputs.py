"""Read figure inputs other than tables; a function has the name of the argument and takes {argument: path}."""

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles import pool
from viscorough_study.ensembles.surface_files import read_surfaces


def examples(files):
    """Return a list of (Hurst exponent, heights, spacing) of the example discs."""
    surfaces = read_surfaces(files["examples"])
    return [(realization.hurst, indenter.heights, indenter.spacing) for _, realization, indenter in surfaces]


def ensembles(files):
    """Return the base discs of a pool, one ensemble per case."""
    return list(pool.ensembles(pool.select(read_dataset(files["ensembles"]), group="base"), "case").values())


def discs(files):
    """Return the base discs of a pool, one ensemble per Hurst exponent."""
    by_hurst = pool.ensembles(pool.select(read_dataset(files["discs"]), group="base"), "hurst")
    return [by_hurst[hurst] for hurst in sorted(by_hurst)]


def lines(files):
    """Return the lines of a pool, one ensemble per Hurst exponent."""
    return list(pool.ensembles(read_dataset(files["lines"]), "hurst").values())


def groups(files):
    """Return {group: ensemble of its measured surfaces} of a pool."""
    return pool.ensembles(read_dataset(files["groups"]), "group")
