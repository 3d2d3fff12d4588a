"""Datasets of xarray in NetCDF files; that they are those of io.netcdf is tested with it."""

import xarray as xr

from support.cf import violations
from support.contract import refused
from viscorough.io.datasets import read_dataset, write_dataset
from viscorough.io.netcdf import COMPRESSED_FROM


def test_labels_of_a_dimension_survive_and_are_no_coordinate_variable(tmp_path):
    about = {"long_name": "convention"}
    ds = xr.Dataset({"beta": ("convention", [0.1, 0.2], about | {"units": "1"})}, {"convention": ["disc", "square"]})
    ds["convention"].attrs = about
    write_dataset(ds.assign_attrs(title="Fits"), tmp_path / "labels.nc")
    assert violations(tmp_path / "labels.nc") == []
    read = read_dataset(tmp_path / "labels.nc")
    assert read.sel(convention="square").beta == 0.2
    xr.testing.assert_equal(read, ds)


def test_coordinates_have_no_fill_value_and_variables_need_units(tmp_path):
    about = {"long_name": "depth", "units": "m"}
    values = [float(number) for number in range(COMPRESSED_FROM)]
    ds = xr.Dataset({"depth": ("level", values, about)}, {"level": ("level", values, about)}, {"title": "Depths"})
    write_dataset(ds, tmp_path / "a.nc")
    assert violations(tmp_path / "a.nc") == []
    del ds["depth"].attrs["units"]
    with refused("variable depth lacks units"):
        write_dataset(ds, tmp_path / "b.nc")
    assert not (tmp_path / "b.nc").exists()
