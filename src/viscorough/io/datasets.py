"""Convert the content of NetCDF files to datasets of xarray and back, and read and write datasets.

Only this module and `result_datasets` import xarray. Its import takes about as long as the contact of a small map, so
that commands and jobs which need no labelled arithmetic use `io.netcdf`.
"""

import xarray as xr

from viscorough.basics.types import FilePath
from viscorough.io import netcdf


def content_to_dataset(content: netcdf.Content) -> xr.Dataset:
    """Convert the content of a NetCDF file to a dataset of xarray.

    A variable becomes a coordinate if its only dimension has the name of the variable.
    """
    variables, attributes = content
    return xr.Dataset(variables, attrs=attributes | netcdf.global_attributes())


def write_dataset(ds: xr.Dataset, path: FilePath) -> None:
    """Write a dataset as CF-1.11 NetCDF with `netcdf.write`, which states what the variables need and what it raises.

    The CF conventions forbid coordinates of texts. If the labels of a dimension x are texts, they are therefore written
    as a variable x with the dimension x_index.
    """
    labels = {name: f"{name}_index" for name in ds.indexes if ds[name].dtype.kind not in "biuf"}
    ds = ds.reset_index(list(labels)).rename_dims(labels)
    variables = {str(name): (v.dims, v.values, v.attrs) for name, v in ds.variables.items()}
    netcdf.write(path, variables, ds.attrs)  # type: ignore[arg-type]  # names of dimensions are texts


def read_dataset(path: FilePath) -> xr.Dataset:
    """Read a NetCDF file into memory, and restore the text labels that write_dataset converted.

    Raises a one-line ValueError if the file is missing or damaged.
    """
    ds = content_to_dataset(netcdf.read(path))
    labels = {dim: dim.removesuffix("_index") for dim in map(str, ds.dims) if dim.endswith("_index")}
    return ds.swap_dims(labels)
