"""NetCDF files: exact round trips, agreement with xarray, damaged files."""

import os
import resource

import netCDF4
import numpy as np
import pytest
import xarray as xr

from support.cf import violations
from support.contract import refused
from support.curves import random_curve
from support.faults import DAMAGES
from viscorough.io import datasets, digest, netcdf
from viscorough.io.curves import curve_to_content, described

METRES = {"long_name": "depth", "units": "m"}


def content_of(values):
    return {"depth": (("level",), values, METRES)}, {"title": "Depths"}


@pytest.mark.parametrize("levels", [1, netcdf.COMPRESSED_FROM])
def test_xarray_reads_what_was_written(tmp_path, levels):
    """The same content always gives the same bytes, and a dataset is written with the same content."""
    content = curve_to_content(random_curve(levels))
    netcdf.write(tmp_path / "curve.nc", *content)
    netcdf.write(tmp_path / "again.nc", *content)
    assert (tmp_path / "curve.nc").read_bytes() == (tmp_path / "again.nc").read_bytes()
    ds = xr.load_dataset(tmp_path / "curve.nc")
    given = xr.Dataset(content[0], attrs=content[1])
    assert ds.attrs.items() >= given.attrs.items()
    xr.testing.assert_identical(ds.drop_attrs(deep=False), given.drop_attrs(deep=False))
    datasets.write_dataset(ds, tmp_path / "dataset.nc")
    digests = {netcdf.read(tmp_path / f"{name}.nc")[1][digest.ATTRIBUTE] for name in ("curve", "dataset")}
    assert len(digests) == 1
    with netCDF4.Dataset(tmp_path / "curve.nc") as file:
        assert file["depth"].filters()["zlib"] == (levels > 1)


def test_coordinates_have_no_fill_value_and_labels_of_a_dimension_are_no_coordinate(tmp_path):
    about = {"long_name": "convention"}
    ds = xr.Dataset({"beta": ("convention", [0.1, 0.2], about | {"units": "1"})}, {"convention": ["disc", "square"]})
    ds["convention"].attrs = about
    ds = ds.assign_coords(level=("level", [1.0, 2.0], {"long_name": "level", "units": "1"}))
    datasets.write_dataset(ds.assign_attrs(title="Fits"), tmp_path / "labels.nc")
    assert violations(tmp_path / "labels.nc") == []
    read = datasets.read_dataset(tmp_path / "labels.nc")
    assert read.sel(convention="square").beta == 0.2
    xr.testing.assert_equal(read, ds)


def test_content_is_read_exactly_as_written(tmp_path):
    """The content has variables of every kind that an input file may hold, also kinds that no command uses."""
    random = np.random.default_rng(0)
    variables = {
        "depth": (("level",), np.append(random.random(4), np.nan), METRES),
        "count": (("level",), np.arange(5, dtype=np.int32), METRES),
        "level": (("level",), np.arange(5.0), METRES),
        "map": (("y", "x"), random.random((2, 3)).astype(np.float32), METRES | {"valid": np.array([0.0, 1.0])}),
        "name": (("y",), np.array(["first", "second"], dtype=object), {"long_name": "name"}),
    }
    netcdf.write(tmp_path / "a.nc", variables, {"title": "All kinds", "scale": 2.5})
    stored, attributes = netcdf.read(tmp_path / "a.nc")
    assert attributes.items() >= {"title": "All kinds", "scale": 2.5, "Conventions": "CF-1.11"}.items()
    for name, (dimensions, values, about) in variables.items():
        assert stored[name][0] == dimensions
        np.testing.assert_array_equal(stored[name][1], values, strict=True)
        np.testing.assert_equal(stored[name][2], about)


@pytest.mark.parametrize(("unit", "units"), [("m", ("s", "m s-1", "m2")), ("1", ("1", "1", "1"))])
def test_without_a_unit_of_length_all_units_are_the_users(unit, units):
    assert tuple(described("", each, unit)["units"] for each in ("s", "m s-1", "m2")) == units


@pytest.mark.parametrize("limit", [0, 20_000])
def test_full_disk_is_one_line_and_leaves_no_file(tmp_path, limit):
    """A limit on the size of files imitates the full disk: both fail in the middle of writing."""
    noise, limits = np.random.default_rng(0).random(20_000), resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limits[1]))
    try:
        with pytest.raises(OSError, match=r"curve\.nc: not written .*; room on a writable disk is needed") as error:
            netcdf.write(tmp_path / "curve.nc", *content_of(noise))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert len(str(error.value).splitlines()) == 1
    assert os.listdir(tmp_path) == []


def test_missing_foreign_and_damaged_files_are_one_line(tmp_path):
    netcdf.write(tmp_path / "whole.nc", *content_of(np.random.default_rng(0).random(5_000)))
    whole = (tmp_path / "whole.nc").read_bytes()
    (tmp_path / "folder.nc").mkdir()
    contents = {"missing.nc": None, "folder.nc": None, "empty.nc": b"", "text.nc": b"depth,force\n1,2\n"}
    contents |= {f"cut{share}.nc": whole[: len(whole) * share // 100] for share in (1, 99)}
    contents |= {f"{name}.nc": damage(whole) for name, damage in DAMAGES.items()}
    for name, content in contents.items():
        if content is not None:
            (tmp_path / name).write_bytes(content)
        with refused(f"{name}: not readable"):
            netcdf.read(tmp_path / name)
