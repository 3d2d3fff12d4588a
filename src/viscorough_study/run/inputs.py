"""Functions by name, and their input files, for scripts that serve many rules."""

from importlib import import_module

import pandas as pd

from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset


def named(name):
    """A function or constant by its dotted name, such as "viscorough_study.fits.plateau.COLUMNS"."""
    module, _, attribute = name.rpartition(".")
    return getattr(import_module(module), attribute)


def read_input(path):
    """The table of a CSV file, or the dataset of a NetCDF file.

    path : or a list of paths, for an iterator over their tables or Contents (viscorough.io.netcdf)
    """
    if isinstance(path, str):
        return pd.read_csv(path) if path.endswith(".csv") else read_dataset(path)
    return (pd.read_csv(file) if file.endswith(".csv") else netcdf.read(file) for file in path)
