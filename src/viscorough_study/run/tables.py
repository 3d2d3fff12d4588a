"""Tidy tables, written as CSV and NetCDF."""

import json

import xarray as xr

from viscorough.io.atomic import atomic_write
from viscorough.io.datasets import write_dataset
from viscorough.io.netcdf import opened


def write_table(table, csv_path, nc_path, *, columns, dimension, title, attributes=None):
    """Write a tidy table (pandas.DataFrame, one case per row) as CSV and NetCDF, each atomically.

    columns : {column: (long_name, units)} for exactly the columns of the table; text has no units
    dimension : name of the rows in the NetCDF file; attributes : its further global attributes

    Floats in the CSV have as many digits as needed to read them back exactly; missing values are empty.
    Raises ValueError if columns and table differ.
    """
    if differing := sorted(set(columns) ^ set(table.columns)):
        raise ValueError(f"{nc_path}: table and descriptions differ in {', '.join(differing)}; both are needed")
    ds = xr.Dataset(attrs={"title": title} | (attributes or {}))
    for name, (long_name, units) in columns.items():
        values, attributes = table[name].to_numpy(), {"long_name": long_name, "units": units}
        if not values.size:  # the types of empty columns are unspecified
            values = values.astype(float if units else str)
        if values.dtype.kind not in "biuf":
            values, attributes = values.astype(str), {"long_name": long_name}
            values = values.astype(object) if values.size else values  # empty objects would be stored as numbers
        ds[name] = (dimension, values, attributes)
    write_dataset(ds, nc_path)
    with atomic_write(csv_path) as temporary:
        table.to_csv(temporary, index=False, lineterminator="\n")


def recorded(**mappings):
    """Attributes for write_table that record mappings as JSON, such as settings and machine; see `read_recorded`."""
    return {name: json.dumps(mapping) for name, mapping in mappings.items()}


def read_recorded(nc_path, name, missing=None):
    """Mapping recorded as an attribute of a NetCDF file, of a table or of an ensemble.

    missing : returned if the file has no such attribute; if it is None, that raises a ValueError
    """
    with opened(nc_path) as file:
        return json.loads(file.getncattr(name)) if missing is None or name in file.ncattrs() else missing
