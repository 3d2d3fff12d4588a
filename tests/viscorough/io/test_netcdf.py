"""NetCDF files written and read without xarray: exact round trips, agreement with xarray, damaged files."""

import os
import subprocess
import sys
import textwrap

import netCDF4
import numpy as np
import pytest
import xarray as xr

from support.curves import one_line, random_curve
from viscorough.io import datasets, netcdf
from viscorough.io.curves import curve_to_content
from viscorough.io.netcdf import Content, Variable

GLOBAL = {"title", "comment", "Conventions", "source", "history"}
METRES = {"long_name": "depth", "units": "m"}


def content_of(values, name="depth", **attributes):
    return Content({name: Variable(("level",), np.asarray(values), METRES | attributes)}, {"title": "Depths"})


def test_bytes_are_reproducible_and_no_time_is_written(tmp_path):
    for name in ("one.nc", "two.nc"):
        netcdf.write(curve_to_content(random_curve(900)), tmp_path / name)
    assert (tmp_path / "one.nc").read_bytes() == (tmp_path / "two.nc").read_bytes()
    of_curve = {"elements", "operator_applications", "tolerance", "method"}
    assert set(netcdf.read(tmp_path / "one.nc").attributes) == GLOBAL | of_curve


@pytest.mark.parametrize("levels", [1, 7, netcdf.COMPRESSED_FROM])
def test_xarray_writes_and_reads_the_same(tmp_path, levels):
    """The two ways to write a file differ in nothing that a reader sees."""
    content = curve_to_content(random_curve(levels))
    ds = xr.Dataset(content.variables, attrs=content.attributes)
    netcdf.write(content, tmp_path / "ours.nc")
    datasets.write_dataset(ds, tmp_path / "theirs.nc")
    xr.testing.assert_identical(*(datasets.read_dataset(tmp_path / name) for name in ("ours.nc", "theirs.nc")))
    with netCDF4.Dataset(tmp_path / "ours.nc") as ours, netCDF4.Dataset(tmp_path / "theirs.nc") as theirs:
        assert list(ours.variables) == list(theirs.variables)
        assert ours.ncattrs() == theirs.ncattrs()
        for one, other in zip(ours.variables.values(), theirs.variables.values(), strict=True):
            assert (one.dtype, one.dimensions, one.filters()) == (other.dtype, other.dimensions, other.filters())
            assert set(one.ncattrs()) == set(other.ncattrs())


def test_content_survives_a_file_exactly(tmp_path):
    """Variables of every kind that an input file may hold, known to the command line or not."""
    random = np.random.default_rng(0)
    variables = {
        "depth": Variable(("level",), np.append(random.random(4), np.nan), METRES),
        "count": Variable(("level",), np.arange(5, dtype=np.int32), METRES),
        "level": Variable(("level",), np.arange(5.0), METRES),
        "map": Variable(("y", "x"), random.random((2, 3)).astype(np.float32), METRES | {"valid": np.array([0.0, 1.0])}),
        "rms": Variable((), np.array(0.1), METRES),
        "name": Variable(("y",), np.array(["first", "second"], dtype=object), {"long_name": "name"}),
    }
    netcdf.write(Content(variables, {"title": "All kinds", "scale": 2.5}), tmp_path / "a.nc")
    content = netcdf.read(tmp_path / "a.nc")
    assert content.attributes == {"title": "All kinds", "scale": 2.5} | netcdf.global_attributes()
    for name, variable in variables.items():
        read = content.variables[name]
        assert read.dimensions == variable.dimensions
        np.testing.assert_array_equal(read.values, variable.values, strict=True)
        np.testing.assert_equal(read.attributes, variable.attributes)


def test_packed_and_missing_values_are_unpacked(tmp_path):
    packing = {"depth": {"dtype": "int16", "scale_factor": 0.5, "_FillValue": -1}, "count": {"_FillValue": 7}}
    ds = xr.Dataset({"depth": ("level", [0.5, np.nan, 2.0]), "count": ("level", [1, 7, 3])})
    ds.to_netcdf(tmp_path / "packed.nc", encoding=packing)
    content = netcdf.read(tmp_path / "packed.nc")
    np.testing.assert_array_equal(content.variables["depth"].values, [0.5, np.nan, 2.0])
    np.testing.assert_array_equal(content.variables["count"].values, [1, np.nan, 3])
    assert [variable.attributes for variable in content.variables.values()] == [{}, {}]


@pytest.mark.parametrize("attribute", ["units", "long_name"])
def test_every_variable_needs_units_and_long_name(tmp_path, attribute):
    for value in ("", 1, np.array([1, 2])):
        with pytest.raises(ValueError, match=f"variable depth lacks {attribute}"):
            netcdf.write(content_of([1.0], **{attribute: value}), tmp_path / "a.nc")
    assert os.listdir(tmp_path) == []


def test_fill_value_and_compression(tmp_path):
    netcdf.write(content_of(np.ones(netcdf.COMPRESSED_FROM)), tmp_path / "large.nc")
    netcdf.write(content_of(np.ones(netcdf.COMPRESSED_FROM), name="level"), tmp_path / "coordinate.nc")
    netcdf.write(content_of(np.ones(3)), tmp_path / "small.nc")
    with netCDF4.Dataset(tmp_path / "large.nc") as file:
        assert file["depth"].filters()["zlib"]
        assert np.isnan(file["depth"]._FillValue)
    with netCDF4.Dataset(tmp_path / "coordinate.nc") as file:
        assert "_FillValue" not in file["level"].ncattrs(), "in CF no value of a coordinate may be missing"
    with netCDF4.Dataset(tmp_path / "small.nc") as file:
        assert not file["depth"].filters()["zlib"]


@pytest.mark.parametrize("limit", [0, 1000, 20_000])
def test_full_disk_is_one_line_and_leaves_nothing(tmp_path, limit):
    """A limit on the size of files stands for the full disk: both fail in the middle of writing."""
    script = textwrap.dedent("""
        import resource, sys
        import numpy as np
        from viscorough.io import netcdf
        noise = np.random.default_rng(0).random(20_000)
        variable = netcdf.Variable(("level",), noise, {"long_name": "depth", "units": "m"})
        resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]), int(sys.argv[2])))
        try:
            netcdf.write(netcdf.Content({"depth": variable}, {}), sys.argv[1])
        except OSError as error:
            print(error)
    """)
    command = [sys.executable, "-c", script, str(tmp_path / "curve.nc"), str(limit)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) == 1
    assert "curve.nc: not written (File too large)" in done.stdout
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("read", [netcdf.read, datasets.read_dataset], ids=["content", "dataset"])
def test_missing_foreign_and_truncated_files_are_one_line(tmp_path, read):
    netcdf.write(content_of(np.random.default_rng(0).random(50_000)), tmp_path / "whole.nc")
    whole = (tmp_path / "whole.nc").read_bytes()
    (tmp_path / "folder.nc").mkdir()
    cases = {"missing.nc": None, "folder.nc": None, "empty.nc": b"", "text.nc": b"depth,force\n1,2\n"}
    cases |= {f"cut{share}.nc": whole[: len(whole) * share // 100] for share in (0, 1, 10, 50, 90, 99)}
    for name, damaged in cases.items():
        if damaged is not None:
            (tmp_path / name).write_bytes(damaged)
        with pytest.raises(ValueError, match=f"{name}: not readable") as error:
            read(tmp_path / name)
        one_line(error)


@pytest.mark.parametrize("read", [netcdf.read, datasets.read_dataset], ids=["content", "dataset"])
def test_damage_inside_compressed_data_is_detected(tmp_path, read):
    netcdf.write(content_of(np.random.default_rng(0).random(50_000)), tmp_path / "a.nc")
    damaged = bytearray((tmp_path / "a.nc").read_bytes())
    middle = len(damaged) // 2
    damaged[middle : middle + 64] = bytes(64)
    (tmp_path / "a.nc").write_bytes(damaged)
    with pytest.raises(ValueError, match="not readable"):
        read(tmp_path / "a.nc")
