"""Digests of NetCDF files: any change of the content is refused; files without a digest are read."""

import netCDF4
import numpy as np
import pytest
import xarray as xr

import viscorough
from support.contract import refused
from support.curves import random_curve
from viscorough import load_curve, read_heights
from viscorough.io import datasets, digest, netcdf
from viscorough.io.curves import stack_curves

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore:.*rms slope")

ABOUT = {"long_name": "depth", "units": "m"}


@pytest.fixture
def path(tmp_path):
    """Make a file with numbers and texts, both along a dimension and scalar."""
    variables = {
        "depth": (("level",), np.array([1.0, -0.0, np.nan]), ABOUT),
        "count": (("level",), np.array([1, 2, 3]), ABOUT | {"valid": np.array([1, 3])}),
        "spacing": ((), np.array(0.1), ABOUT),
        "name": (("level",), np.array(["a", "b", "c"], dtype=object), {"long_name": "name"}),
    }
    netcdf.write(tmp_path / "all.nc", variables, {"title": "All kinds", "tolerance": 1e-3})
    return tmp_path / "all.nc"


def assign(name, value):
    def change(file):
        file.set_auto_maskandscale(False)
        file[name][...] = value

    return change


CHANGES = {
    "one bit of a number": assign("depth", [np.nextafter(1.0, 2), -0.0, np.nan]),
    "whole numbers": assign("count", [1, 2, 4]),
    "a number alone": assign("spacing", 0.2),
    "a text": assign("name", np.array(["a", "b", "d"], dtype=object)),
    "a unit": lambda file: file["depth"].setncattr("units", "um"),
    "an attribute less": lambda file: file.delncattr("tolerance"),
    "the history": lambda file: file.setncattr("history", "by another program"),
    "the digest": lambda file: file.setncattr(digest.ATTRIBUTE, 64 * "0"),
    "a name": lambda file: file.renameVariable("depth", "height"),
    "a variable more": lambda file: file.createVariable("gap", "f8"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_changed_content_is_refused(path, change):
    netcdf.read(path)
    with netCDF4.Dataset(path, "a") as file:
        CHANGES[change](file)
    with refused(r"all\.nc: not readable \(.*content_sha256.*damaged, or another program"):
        netcdf.read(path)


def test_older_files_and_files_of_other_programs_are_read(path):
    """Files without a digest are read, even if a program kept other attributes."""
    with netCDF4.Dataset(path, "a") as file:
        file.delncattr(digest.ATTRIBUTE)
        file.setncattr("history", "written by viscorough 1.0.0")
        file["spacing"][...] = 0.2
    assert netcdf.read(path)[0]["spacing"][1] == 0.2
    x = np.arange(4.0)
    heights = xr.Dataset({"heights": (("y", "x"), np.eye(4), {"units": "m"})}, {"y": ("y", x), "x": ("x", x)})
    heights.to_netcdf(path)
    assert read_heights(path, 2.0).spacing == 2.0


def test_file_that_is_written_again_gets_a_new_digest(path):
    netcdf.write(path, *stack_curves([random_curve(3), random_curve(5)]))
    once = netcdf.read(path)
    netcdf.write(path, *once)
    assert netcdf.read(path)[1] == once[1]
    datasets.write_dataset(datasets.read_dataset(path).isel(realization=[0]), path)
    assert netcdf.read(path)[0]["levels"][1].tolist() == [3]


def test_damaged_number_in_a_curve_is_refused(tmp_path):
    """The file has a valid structure, and its curve is possible."""
    curve = random_curve(30)
    viscorough.save(curve, tmp_path / "curve.nc")
    whole = (tmp_path / "curve.nc").read_bytes()
    place = whole.index(curve.depth.tobytes())
    (tmp_path / "curve.nc").write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
    with refused(r"curve\.nc: not readable \(its content"):
        load_curve(tmp_path / "curve.nc")
