"""Datasets of xarray in NetCDF files."""

import os

import netCDF4
import pytest
import xarray as xr

from support.cf import violations
from support.curves import random_curve
from viscorough.io.curves import stack_curves
from viscorough.io.datasets import read_dataset, write_dataset
from viscorough.io.netcdf import COMPRESSED_FROM

GLOBAL = {"title", "comment", "Conventions", "source", "history"}


def stacked(curves):
    """Loading curves as a dataset of xarray."""
    content = stack_curves(curves)
    return xr.Dataset({name: tuple(variable) for name, variable in content.variables.items()}, attrs=content.attributes)


def test_bytes_are_reproducible_and_no_time_is_written(tmp_path):
    ds = stacked([random_curve(900, seed) for seed in range(5)])
    for name in ("one.nc", "two.nc"):
        write_dataset(ds, tmp_path / name)
    assert (tmp_path / "one.nc").read_bytes() == (tmp_path / "two.nc").read_bytes()
    assert set(read_dataset(tmp_path / "one.nc").attrs) == GLOBAL


@pytest.mark.parametrize("attribute", ["units", "long_name"])
def test_every_variable_needs_units_and_long_name(tmp_path, attribute):
    ds = xr.Dataset({"depth": ("level", [1.0], {"long_name": "depth", "units": "m"})})
    del ds["depth"].attrs[attribute]
    with pytest.raises(ValueError, match=f"variable depth lacks {attribute}"):
        write_dataset(ds, tmp_path / "a.nc")
    assert os.listdir(tmp_path) == []


def test_files_carry_cf_attributes_and_compress_large_floats(tmp_path):
    large = stacked([random_curve(COMPRESSED_FROM, length_unit="um")])
    large = large.assign_coords(realization=("realization", [0.5], {"long_name": "coordinate", "units": "1"}))
    write_dataset(large, tmp_path / "a.nc")
    with netCDF4.Dataset(tmp_path / "a.nc") as file:
        assert file.Conventions == "CF-1.11"
        assert file.source.startswith("viscorough ")
        units = {name: variable.units for name, variable in file.variables.items() if name != "method"}
        assert units == dict.fromkeys(units, "1") | {"depth": "um", "force": "um2", "stiffness": "um"}
        assert all(variable.long_name for variable in file.variables.values())
        assert file["depth"].filters()["zlib"]
        assert not file["tolerance"].filters()["zlib"]
        assert "_FillValue" in file["depth"].ncattrs()
        assert "_FillValue" not in file["realization"].ncattrs()


def test_labels_of_a_dimension_survive_and_are_no_coordinate_variable(tmp_path):
    about = {"long_name": "convention"}
    ds = xr.Dataset({"beta": ("convention", [0.1, 0.2], about | {"units": "1"})}, {"convention": ["disc", "square"]})
    ds["convention"].attrs = about
    write_dataset(ds.assign_attrs(title="Fits"), tmp_path / "labels.nc")
    assert violations(tmp_path / "labels.nc") == []
    read = read_dataset(tmp_path / "labels.nc")
    assert read.sel(convention="square").beta == 0.2
    xr.testing.assert_equal(read, ds)
