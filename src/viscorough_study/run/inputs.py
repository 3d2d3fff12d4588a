"""Input files of scripts that serve many rules."""

import pandas as pd

from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset


def read_input(path):
    """The table of a CSV file, or the dataset of a NetCDF file.

    path : or a list of paths, for an iterator over their tables or Contents (viscorough.io.netcdf)
    """
    if isinstance(path, str):
        return pd.read_csv(path) if path.endswith(".csv") else read_dataset(path)
    return (pd.read_csv(file) if file.endswith(".csv") else netcdf.read(file) for file in path)
