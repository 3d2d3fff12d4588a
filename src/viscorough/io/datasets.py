"""Convert the content of NetCDF files to datasets of xarray, and write and read datasets.

Only this module and `result_datasets` import xarray, which takes long to import.
"""

import xarray as xr

from viscorough.basics.types import FilePath
from viscorough.io import netcdf


def content_to_dataset(content: netcdf.Content) -> xr.Dataset:
    """Convert the content of a NetCDF file to a dataset of xarray.

    A variable becomes a coordinate if its only dimension has the name of the variable.
    """
    given = {name: (v.dimensions, v.values, v.attributes) for name, v in content.variables.items()}
    along = {name for name, (dimensions, _, _) in given.items() if dimensions == (name,)}
    data = {name: variable for name, variable in given.items() if name not in along}
    coordinates = {name: given[name] for name in along}
    return xr.Dataset(data, coordinates, attrs=content.attributes | netcdf.global_attributes())


def write_dataset(ds: xr.Dataset, path: FilePath) -> None:
    """Write a dataset as CF-1.11 NetCDF, atomically.

    Every data variable needs the attribute `long_name`, and `units` unless it holds text. The attributes Conventions,
    source ("viscorough <version>") and history are added, and large numeric arrays are compressed. The file does not
    depend on the time and place of writing. The CF conventions forbid coordinates of texts. If the labels of a
    dimension x are texts, they are therefore written as a variable x with the dimension x_index.

    Raises ValueError for a path that cannot be written, OSError if writing fails.
    """
    labels = {name: f"{name}_index" for name in ds.indexes if ds[name].dtype.kind not in "biuf"}
    ds = ds.reset_index(list(labels)).rename_dims(labels)
    numeric = {name: variable for name, variable in ds.variables.items() if variable.dtype.kind in "fi"}
    encoding = {name: netcdf.compression(variable.size) for name, variable in numeric.items()}
    for name in numeric.keys() & ds.coords.keys():
        encoding[name]["_FillValue"] = None  # the CF conventions forbid missing values in a coordinate
    ds = ds.drop_encoding().assign_attrs(netcdf.global_attributes())
    with netcdf.written_with_digest(path) as temporary:
        ds.to_netcdf(temporary, engine="netcdf4", encoding=encoding)


def read_dataset(path: FilePath) -> xr.Dataset:
    """Read a NetCDF file into memory, close it, and restore the text labels that write_dataset converted.

    Raises a one-line ValueError if the file is missing or damaged.
    """
    with netcdf.opened(path) as file:
        ds = xr.open_dataset(xr.backends.NetCDF4DataStore(file), decode_times=False, decode_timedelta=False).load()
    labels = {dim: dim.removesuffix("_index") for dim in map(str, ds.dims) if dim.endswith("_index")}
    return ds.drop_encoding().swap_dims(labels)
