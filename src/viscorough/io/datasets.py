"""NetCDF files as datasets of xarray, and batches of loading curves in them: for programs that compute with many files.

The only module of the library that imports xarray.
"""

import numpy as np
import xarray as xr

from viscorough.io import netcdf
from viscorough.io.atomic import atomic_write
from viscorough.io.curves import COMMENT, OVER_LEVELS, PER_CURVE, STORED, check_curve, level_attributes
from viscorough.loading_curve import LoadingCurve


def write_dataset(ds, path):
    """Write a dataset as CF-1.11 NetCDF, atomically.

    Every data variable needs `long_name`, and `units` unless it holds text. Adds the attributes Conventions
    and source ("viscorough <version>"), compresses large floats; nothing depends on when or where the file is
    written. Raises ValueError for missing attributes and for a path where no file can appear, OSError if
    writing fails.
    """
    for name, variable in ds.data_vars.items():
        netcdf.check_attributes(path, name, variable.dtype, variable.attrs)
    encoding = {}
    for name, variable in ds.variables.items():
        if variable.dtype.kind in "fi":
            encoding[name] = netcdf.compression(variable.size)
            if name in ds.coords:
                encoding[name]["_FillValue"] = None  # in CF no value of a coordinate may be missing
    ds = ds.drop_encoding().assign_attrs(netcdf.global_attributes())
    with atomic_write(path) as temporary:
        ds.to_netcdf(temporary, engine="netcdf4", encoding=encoding)


def read_dataset(path):
    """Read a NetCDF file into memory and close it; a one-line ValueError if it is missing or damaged."""
    as_stored = {"decode_times": False, "decode_timedelta": False}
    with netcdf.faults_named(path), xr.open_dataset(path, engine="netcdf4", **as_stored) as ds:
        return ds.load().drop_encoding()


def stack_curves(curves, length_unit="m"):
    """LoadingCurves as one Dataset (realization, level), nan beyond each curve's last level.

    Per realization: `levels`, the number of levels, and PER_CURVE. Raises ValueError for an empty list and
    for what is no loading curve (io.curves.check_curve).
    """
    if not curves:
        raise ValueError("stack_curves: there is no curve; at least one is needed")
    for curve in curves:
        check_curve(curve)
    levels = np.array([curve.depth.size for curve in curves])
    ds = xr.Dataset(attrs={"title": "Loading curves of rigid indenters", "comment": COMMENT})
    for name in OVER_LEVELS:
        padded = np.full((len(curves), levels.max()), np.nan)
        for row, curve in zip(padded, curves, strict=True):
            row[: curve.depth.size] = getattr(curve, name)
        ds[name] = (("realization", "level"), padded, level_attributes(name, length_unit))
    ds["levels"] = ("realization", levels, {"long_name": "number of levels of the curve", "units": "1"})
    for name, (kind, long_name) in PER_CURVE.items():
        values = np.array([getattr(curve, name) for curve in curves], dtype=object if kind is str else kind)
        ds[name] = ("realization", values, {"long_name": long_name} | ({} if kind is str else {"units": "1"}))
    return ds


def unstack_curves(ds):
    """The LoadingCurves of a Dataset made by stack_curves, in order."""
    curves = []
    for index in range(ds.sizes["realization"]):
        one = ds.isel(realization=index)
        values = {name: one[name].values[: int(one["levels"])] for name in STORED}
        values["contact_count"] = values["contact_count"].astype(int)  # floats only because of nan
        about = {name: convert(one[name].item()) for name, (convert, _) in PER_CURVE.items()}
        curves.append(LoadingCurve(**values, **about))
    return curves
