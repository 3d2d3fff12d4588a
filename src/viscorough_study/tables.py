"""Tidy tables: written as CSV and NetCDF, and rows of those of fits."""

import xarray as xr

from viscorough.calibrated_law import COLUMNS as CALIBRATION
from viscorough.io.atomic import atomic_write
from viscorough.io.datasets import write_dataset


def write_table(table, csv_path, nc_path, *, columns, dimension, title):
    """Write a tidy table (pandas.DataFrame, one case per row) as CSV and as NetCDF, each whole or not at all.

    columns : {column: (long_name, units)} for exactly the columns of the table; text has no units
    dimension : name of the rows in the NetCDF file

    Floats in the CSV have the digits that reading them back exactly takes; missing values are empty there.
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


def fits(table, shown, **wanted):
    """Rows of the scaling table under the conventions shown, replaced or added to by those wanted; by ascending H.

    Rows without a region (b), which have no exponent, are left out.
    """
    for column, value in (shown | wanted).items():
        table = table[table[column] == value]
    return table.dropna(subset="beta").sort_values("hurst")


def calibrated(scaling, shown):
    """Rows of base discs and of lines under the conventions shown, of the scaling table."""
    base = scaling[scaling["case_group"] == "base"]
    for name, value in shown.items():
        base = base[(base[name] == value) | ((name == "rms_convention") & (base[name] == "line"))]
    return base.dropna(subset="beta")[list(CALIBRATION)].sort_values(["source", "hurst"], ignore_index=True)
