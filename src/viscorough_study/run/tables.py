"""Read and write tidy tables as CSV and NetCDF.

The NetCDF file contains its own digest (viscorough.io.digest) and the digest of the CSV file. So a table that was
truncated or changed after writing is refused, while the CSV contains only the table.
"""

import io
import json
from hashlib import sha256
from pathlib import Path

import pandas as pd

from viscorough.io.atomic import atomic_write, reading
from viscorough.io.netcdf import opened

CSV_DIGEST = "csv_sha256"  # attribute of the NetCDF file: SHA-256 of the bytes of the CSV file


def write_table(table, csv_path, nc_path, *, columns, dimension, title, attributes=None):
    """Write a tidy table (pandas.DataFrame, one case per row) as CSV and NetCDF, each atomically.

    columns : {column: (long_name, units)} for exactly the columns of the table; text has no units
    dimension : name of the rows in the NetCDF file; attributes : its further global attributes

    Floats in the CSV have as many digits as needed to read them back exactly; missing values are empty.
    Both files must have the same name but for the suffix. Raises ValueError if columns and table differ.
    """
    import xarray as xr  # takes long to import, and only writing needs it

    from viscorough.io.datasets import write_dataset

    if differing := sorted(set(columns) ^ set(table.columns)):
        raise ValueError(f"{nc_path}: table and descriptions differ in {', '.join(differing)}; both are needed")
    csv = table.to_csv(index=False, lineterminator="\n").encode()
    ds = xr.Dataset(attrs={"title": title} | (attributes or {}) | {CSV_DIGEST: sha256(csv).hexdigest()})
    for name, (long_name, units) in columns.items():
        values, attributes = table[name].to_numpy(), {"long_name": long_name, "units": units}
        if not values.size:  # empty columns have no types
            values = values.astype(float if units else str)
        if values.dtype.kind not in "biuf":
            values, attributes = values.astype(str), {"long_name": long_name}
            values = values.astype(object) if values.size else values  # empty objects would be stored as numbers
        ds[name] = (dimension, values, attributes)
    write_dataset(ds, nc_path)
    with atomic_write(csv_path) as temporary:
        temporary.write_bytes(csv)


def read_table(csv_path, **options):
    """Read the CSV file of a table that write_table wrote, with options of pandas.read_csv.

    Raises a one-line ValueError, which names the file, if the table differs from the table that was written with the
    NetCDF file of the same name, or if either file is missing or damaged.
    """
    nc_path = Path(csv_path).with_suffix(".nc")
    with opened(nc_path) as file:
        written = file.getncattr(CSV_DIGEST)
    with reading(csv_path, "remove both files, so that the next run makes them again"):
        csv = Path(csv_path).read_bytes()
        if sha256(csv).hexdigest() != written:
            raise ValueError(f"it does not match {nc_path.name}, which was written with it")
    return pd.read_csv(io.BytesIO(csv), **options)


def recorded(**mappings):
    """Return attributes for write_table that record mappings, such as settings, as JSON; see `read_recorded`."""
    return {name: json.dumps(mapping) for name, mapping in mappings.items()}


def read_recorded(nc_path, name, missing=None):
    """Return a mapping recorded as an attribute of a NetCDF file, of a table or of an ensemble.

    missing : value returned if the file has no such attribute; None raises a ValueError
    """
    with opened(nc_path) as file:
        return json.loads(file.getncattr(name)) if missing is None or name in file.ncattrs() else missing
