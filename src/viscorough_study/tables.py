"""Tidy tables, written as CSV and NetCDF."""

import xarray as xr

from viscorough.io.atomic import atomic_write
from viscorough.io.datasets import write_dataset


def write_table(table, csv_path, nc_path, *, columns, dimension, title):
    """Write a tidy table (pandas.DataFrame, one case per row) as CSV and as NetCDF, each atomically.

    columns : {column: (long_name, units)} for exactly the columns of the table; text has no units
    dimension : name of the rows in the NetCDF file

    Floats in the CSV have as many digits as reading them back exactly takes; missing values are empty there.
    Raises ValueError if columns and table differ.
    """
    if differing := sorted(set(columns) ^ set(table.columns)):
        raise ValueError(f"{nc_path}: table and descriptions differ in {', '.join(differing)}; both are needed")
    ds = xr.Dataset(attrs={"title": title})
    for name, (long_name, units) in columns.items():
        values, attributes = table[name].to_numpy(), {"long_name": long_name, "units": units}
        if values.dtype.kind not in "biuf":
            values, attributes = values.astype(str).astype(object), {"long_name": long_name}
        ds[name] = (dimension, values, attributes)
    write_dataset(ds, nc_path)
    with atomic_write(csv_path) as temporary:
        table.to_csv(temporary, index=False, lineterminator="\n")
