"""Datasets of xarray in NetCDF files; that they are those of io.netcdf is tested with it."""

import xarray as xr

from support.cf import violations
from viscorough.io.datasets import read_dataset, write_dataset


def test_coordinates_have_no_fill_value_and_labels_of_a_dimension_are_no_coordinate(tmp_path):
    about = {"long_name": "convention"}
    ds = xr.Dataset({"beta": ("convention", [0.1, 0.2], about | {"units": "1"})}, {"convention": ["disc", "square"]})
    ds["convention"].attrs = about
    ds = ds.assign_coords(level=("level", [1.0, 2.0], {"long_name": "level", "units": "1"}))
    write_dataset(ds.assign_attrs(title="Fits"), tmp_path / "labels.nc")
    assert violations(tmp_path / "labels.nc") == []
    read = read_dataset(tmp_path / "labels.nc")
    assert read.sel(convention="square").beta == 0.2
    xr.testing.assert_equal(read, ds)
