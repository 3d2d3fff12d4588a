"""What scripts that serve many rules are told by name: functions, and the files that these take."""

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

    path : or a list of them, of which the tables or the Contents (viscorough.io.netcdf) are read one after the other
    """
    if isinstance(path, str):
        return pd.read_csv(path) if path.endswith(".csv") else read_dataset(path)
    return (pd.read_csv(one) if one.endswith(".csv") else netcdf.read(one) for one in path)
