"""Read and write tidy tables as pairs of a CSV and a NetCDF file.

The CSV file contains only the table. The NetCDF file contains its own digest (viscorough.io.digest) and the digest of
the CSV file. A table that was truncated or changed after it was written is therefore refused when it is read.
"""

import io
import json
from hashlib import sha256
from pathlib import Path

import pandas as pd

from viscorough.io import netcdf
from viscorough.io.atomic import atomic_write, reading
from viscorough.io.netcdf import opened

CSV_DIGEST = "csv_sha256"  # name of the attribute of the NetCDF file with the SHA-256 of the bytes of the CSV file


def write_table(table, csv_path, nc_path, *, columns, dimension, title, attributes=None):
    """Write a tidy table (a pandas.DataFrame) to a CSV file and to a NetCDF file, each atomically.

    csv_path, nc_path : paths that differ only in their suffix
    columns : {column: (long_name, units)} for exactly the columns of the table; text has no units
    dimension : name of the dimension of the rows in the NetCDF file
    title, attributes : global attributes of the NetCDF file

    Each row is one observation. Floats in the CSV file have as many digits as needed to read them back exactly; missing
    values are empty. Raises ValueError if `columns` and the columns of the table differ.
    """
    if differing := sorted(set(columns) ^ set(table.columns)):
        raise ValueError(f"{nc_path}: table and descriptions differ in {', '.join(differing)}; both are needed")
    csv = table.to_csv(index=False, lineterminator="\n").encode()
    if dimension in columns and table[dimension].dtype.kind not in "biuf":
        dimension = f"{dimension}_index"  # the CF conventions forbid coordinates of texts
    variables = {}
    for name, (long_name, units) in columns.items():
        values, described = table[name].to_numpy(), {"long_name": long_name, "units": units}
        if not values.size:  # an empty column has no type, so its type follows from its units
            values = values.astype(float if units else str)
        if values.dtype.kind == "b":  # NetCDF has no truth values; xarray understands this attribute
            values, described = values.astype("i1"), described | {"dtype": "bool"}
        if values.dtype.kind not in "iuf":
            values, described = values.astype(str), {"long_name": long_name}
        variables[name] = netcdf.Variable((dimension,), values, described)
    written = {"title": title} | (attributes or {}) | {CSV_DIGEST: sha256(csv).hexdigest()}
    netcdf.write(netcdf.Content(variables, written), nc_path)
    with atomic_write(csv_path) as temporary:
        temporary.write_bytes(csv)


def write_tables(tables, csv_paths, nc_paths, described, attributes):
    """Write several tables with `write_table`.

    tables : {name: table}
    csv_paths, nc_paths : paths of the files, in the order of `described`
    described : {name: {"columns": ..., "dimension": ..., "title": ...}}, arguments of `write_table`
    attributes : further global attributes of all NetCDF files
    """
    for (name, description), *paths in zip(described.items(), csv_paths, nc_paths, strict=True):
        write_table(tables[name], *paths, **description, attributes=attributes)


def read_table(csv_path, **options):
    """Return the table in a CSV file that write_table wrote, read with options of pandas.read_csv.

    Raises a one-line ValueError, which names the file, if the CSV or the NetCDF file is missing or damaged, or if the
    CSV file differs from the file that was written together with the NetCDF file of the same name.
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
    """Return attributes for write_table that record mappings, such as settings, as JSON (read with `read_recorded`)."""
    return {name: json.dumps(mapping) for name, mapping in mappings.items()}


def read_recorded(nc_path, name, missing=None):
    """Return a mapping that is recorded as JSON in an attribute of a NetCDF file.

    nc_path : file of a table or of an ensemble; name : name of the attribute
    missing : value to return if the file has no such attribute; with None a missing attribute raises a ValueError
    """
    with opened(nc_path) as file:
        return json.loads(file.getncattr(name)) if missing is None or name in file.ncattrs() else missing
