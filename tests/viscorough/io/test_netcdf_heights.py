"""NetCDF files are read as CF defines them, whatever their suffix; contradictions and doubtful files are refused."""

import re

import netCDF4
import numpy as np
import pytest
import xarray as xr

from support.contract import refused
from viscorough import read_heights
from viscorough.io import netcdf
from viscorough.io.netcdf_heights import uniform_spacing

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore:.*rms slope")

HEIGHTS = np.random.default_rng(0).random((3, 4))


def netcdf_map(path, *, unit="um", x=(0, 0.5, 1.0, 1.5), y=(3, 2, 1), x_unit="um", y_unit="um", dimensions=("y", "x")):
    """Write a file with the map HEIGHTS, with coordinates if they are given."""
    heights = HEIGHTS if dimensions == ("y", "x") else HEIGHTS.T
    parts = {"heights": (dimensions, heights, unit), "x": (("x",), x, x_unit), "y": (("y",), y, y_unit)}
    variables = {
        name: (names, np.array(values, float), {"units": unit} if unit else {})
        for name, (names, values, unit) in parts.items()
        if values is not None
    }
    xr.Dataset(variables).to_netcdf(path)
    return path


@pytest.mark.parametrize(
    ("content", "arguments", "spacings", "metres"),
    [
        ({}, {}, (0.5, 1), 1e-6),
        ({"dimensions": ("x", "y")}, {}, (0.5, 1), 1e-6),
        ({"unit": "nm", "y": (1e-6, 2e-6, 3e-6), "y_unit": "m"}, {}, (500, 1000), 1e-9),
        ({"unit": None, "x_unit": None, "y_unit": None}, {"unit": "mm"}, (0.5, 1), 1e-3),
        ({"x": range(4), "y": range(1, 4), "x_unit": None, "y_unit": None}, {"spacing": 7}, (7, 7), 1e-6),
        ({"x": range(4), "y": range(3), "x_unit": "px", "y_unit": "px"}, {"spacing": 7}, (7, 7), 1e-6),
        ({"unit": "nm"}, {"spacing": ("0.5 um", "1e-6 m")}, (500, 1000), 1e-9),
    ],
)
def test_coordinates_of_netcdf_give_the_spacings(tmp_path, content, arguments, spacings, metres):
    indenter = read_heights(netcdf_map(tmp_path / "a.nc", **content), **arguments)
    np.testing.assert_allclose(indenter.heights, metres * HEIGHTS, rtol=1e-14)
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx(np.multiply(spacings, metres), rel=1e-14)


def test_positions_far_from_0_keep_their_precision():
    northings = 5.4e6 + 0.5 * np.arange(9)
    assert uniform_spacing("y", northings) == 0.5
    assert uniform_spacing("y", northings.astype(np.float32)) == 0.5
    assert uniform_spacing("y", (5e5 + 0.1 * np.arange(200)).astype(np.float32)) == pytest.approx(0.1, rel=3e-3)
    jitter = np.array([0, 0.95, -0.95, 0.5, 0, 0.9, -0.9, 0, 0])
    irregular = 2e6 + np.arange(9) + 0.04 * jitter, 5.4e6 + 3 * np.arange(9) + jitter
    for positions in (*irregular, 1e-6 * np.array([0, 1, 2.2])):
        with refused("not uniform"):
            uniform_spacing("y", positions)
    with refused(r"too coarse|not uniform"):
        uniform_spacing("y", (5.4e6 + 0.7 * np.arange(9)).astype(np.float32))


@pytest.mark.parametrize(
    ("content", "arguments", "what"),
    [
        ({}, {"spacing": 0.5}, "spacing 0.5 um contradicts the file, in which rows are 1 um apart"),
        ({}, {"unit": "nm"}, "unit nm contradicts the file, in which heights are in um"),
        ({"unit": None}, {}, "coordinates are in um, heights in no stated unit; argument unit"),
        ({"x_unit": None, "y_unit": None}, {}, "coordinates in no stated unit; argument spacing"),
        ({"x": range(4), "y": range(3), "x_unit": None, "y_unit": None}, {}, "spacing is needed"),
        ({"y_unit": None}, {}, "coordinates are in um and no unit; one unit is needed"),
        ({"y_unit": "s"}, {}, "not a unit of length"),
        ({"unit": "V"}, {"unit": "um"}, "not a unit of length"),
        ({"y": None}, {}, "only the coordinate x"),
        ({}, {"channel": "phase"}, "none of them is the channel phase"),
        ({"x": (0, 1, np.nan, 3)}, {}, "coordinate x is not finite"),
        ({}, {"spacing": (1, 2, 3)}, "one distance, or two of columns and rows"),
    ],
)
def test_contradictions_are_refused_in_one_line(tmp_path, content, arguments, what):
    path = netcdf_map(tmp_path / "a.nc", **content)
    with refused(what) as error:
        read_heights(path, **arguments)
    assert str(error.value).startswith(str(path))


def stored(path, kind, values, fill_value=None, **attributes):
    """Write a file with the given stored values in a variable `z`; values of None are not written."""
    values = np.ma.masked_equal(np.where(np.equal(values, None), 0, values).astype(kind), 0)
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("y", values.shape[0])
        file.createDimension("x", values.shape[1])
        variable = file.createVariable("z", kind, ("y", "x"), fill_value=fill_value)
        variable.set_auto_maskandscale(False)
        variable.setncatts(attributes)
        for place in np.argwhere(~np.ma.getmaskarray(values)):
            variable[tuple(place)] = values.data[tuple(place)]
    return path


@pytest.mark.parametrize(
    ("kind", "attributes", "expected"),
    [
        ("f4", {"missing_value": np.float32(1e20)}, [[1.5, 2], [3, np.nan]]),
        ("f8", {"missing_value": [1.5, 3.0], "fill_value": 2.0}, [[np.nan, np.nan], [np.nan, 1e20]]),
        ("f8", {"valid_max": 3.0, "scale_factor": 2.0, "add_offset": 1.0}, [[4, 5], [7, np.nan]]),
        ("i2", {"valid_range": np.array([2, 3], np.int16), "scale_factor": 0.5}, [[np.nan, 1], [1.5, np.nan]]),
        ("i1", {"_Unsigned": "true", "scale_factor": 0.5, "add_offset": -1.0}, [[-0.5, 0], [0.5, 3.5]]),
    ],
)
def test_packed_and_missing_values_are_unpacked(tmp_path, kind, attributes, expected):
    """The last stored value is 1e20 for real numbers, or 9 for whole numbers. Attributes of storage are not kept."""
    values = [[1.5, 2], [3, 1e20]] if kind.startswith("f") else [[1, 2], [3, 9]]
    path = stored(tmp_path / "a.nc", kind, values, **attributes)
    expected = np.asarray(expected, "f4" if kind == "f4" else "f8")
    np.testing.assert_array_equal(netcdf.read(path)[0]["z"][1], expected)
    assert netcdf.read(path)[0]["z"][2] == {}
    np.testing.assert_array_equal(read_heights(path, 1.0).heights, expected)


@pytest.mark.parametrize("kind", ["f4", "i2"])
def test_values_that_were_not_written_are_missing(tmp_path, kind):
    path = stored(tmp_path / "a.nc", kind, [[1, None], [3, 4]], scale_factor=0.5)
    np.testing.assert_array_equal(read_heights(path, 1.0).heights, [[0.5, np.nan], [1.5, 2]])


@pytest.mark.parametrize(
    ("kind", "attributes", "what"),
    [
        ("f4", {"missing_value": 1e20}, "attribute missing_value of z is float64, but the variable is float32"),
        ("i2", {"missing_value": np.int32(9), "scale_factor": 0.5}, "missing_value of z is int32, .* the same type"),
        ("i2", {"valid_max": 1.0, "scale_factor": 0.5}, "valid_max of z is float64, but the variable is int16"),
        ("u1", {"valid_min": np.int8(1), "scale_factor": 0.5}, "valid_min of z is int8, but the variable is uint8"),
        ("f8", {"missing_value": "none"}, "missing_value of z is <U4, but the variable is float64"),
        ("f8", {"scale_factor": "2"}, "scale_factor of z is '2'; a number is needed"),
        ("f8", {"add_offset": [1.0, 2.0]}, r"add_offset of z is \[1.0, 2.0\]; a number is needed"),
        ("i1", {"_Unsigned": "yes"}, "attribute _Unsigned of z is 'yes'; 'true' or 'false' is needed"),
    ],
)
def test_attributes_that_the_library_would_ignore_are_refused(tmp_path, kind, attributes, what):
    path = stored(tmp_path / "a.nc", kind, [[1, 2], [3, 9]], **attributes)
    for read in (netcdf.read, read_heights):
        with refused(rf"a\.nc: .*{what}"):
            read(path)


@pytest.mark.parametrize(
    ("kind", "attributes"),
    [("i2", {}), ("u1", {"units": "nm"}), ("f4", {}), ("i4", {"scale": 0.5})],
)
def test_counts_without_a_scale_are_refused(tmp_path, kind, attributes):
    """Whole numbers may be counts of a detector, whose factor is in another variable or in a manual."""
    path = stored(tmp_path / "a.nc", kind, [[1, 2], [3, 9]], **attributes)
    with refused(
        "its numbers are whole, without a scale, .*; argument scale, such as '5 nm', states the height of 1 count"
    ):
        read_heights(path, 1.0)
    metres = 1e-9 if "units" in attributes else 1
    heights = read_heights(path, 1.0, scale=0.5).heights
    np.testing.assert_allclose(heights, metres * np.array([[0.5, 1], [1.5, 4.5]]), rtol=1e-14)


@pytest.mark.parametrize(("kind", "fill"), [("u1", 255), ("i1", -127)])
def test_bytes_that_may_be_missing_are_refused(tmp_path, kind, fill):
    """255 is white in an 8-bit picture, and the value of bytes that were not written."""
    with refused(f"bytes of z have the value {fill}, which may mark missing values; the attribute _FillValue"):
        read_heights(stored(tmp_path / "a.nc", kind, [[1, fill], [3, 4]], scale_factor=0.5), 1.0)
    path = stored(tmp_path / "b.nc", kind, [[1, fill], [3, 4]], fill_value=fill, scale_factor=0.5)
    np.testing.assert_array_equal(read_heights(path, 1.0).heights, [[0.5, np.nan], [1.5, 2]])


@pytest.mark.parametrize(
    ("name", "attributes"),
    [("depth", {}), ("z", {"standard_name": "depth"}), ("z", {"long_name": "Depth below the rim"})],
)
def test_a_depth_needs_a_direction(tmp_path, name, attributes):
    dataset = xr.open_dataset(netcdf_map(tmp_path / "a.nc")).load().rename(heights=name)
    dataset[name].attrs.update(attributes)
    dataset.to_netcdf(tmp_path / "b.nc")
    with refused(f"variable {name} is a depth, of which larger may be lower; argument flip states this"):
        read_heights(tmp_path / "b.nc")
    np.testing.assert_allclose(read_heights(tmp_path / "b.nc", flip=True).heights, -1e-6 * HEIGHTS)
    for positive, sign in (("up", 1), ("down", -1)):
        dataset[name].attrs["positive"] = positive
        dataset.to_netcdf(tmp_path / f"{positive}.nc")
        np.testing.assert_allclose(read_heights(tmp_path / f"{positive}.nc").heights, sign * 1e-6 * HEIGHTS)
        with refused(f"argument flip: the file states positive = {positive}, which is obeyed; leave it out"):
            read_heights(tmp_path / f"{positive}.nc", flip=True)


def test_a_unit_in_another_attribute_is_refused(tmp_path):
    dataset = xr.open_dataset(netcdf_map(tmp_path / "a.nc", unit=None)).load()
    dataset.heights.attrs["unit"] = "nm"
    dataset.to_netcdf(tmp_path / "b.nc")
    with refused("attribute unit of heights is 'nm'; the unit belongs into the attribute units"):
        read_heights(tmp_path / "b.nc", unit="nm")


def test_hdf5_without_named_dimensions_is_refused_with_lines_that_make_a_map(tmp_path, monkeypatch):
    h5py = pytest.importorskip("h5py")
    monkeypatch.chdir(tmp_path)
    with h5py.File("a.h5", "w") as file:
        file["topography"] = HEIGHTS
    with refused("it is HDF5, but no NetCDF; a map in .npy is made in Python: import h5py") as error:
        read_heights("a.h5", 1.0)
    exec(re.search(r"in Python: (.*)", str(error.value))[1], {})
    np.testing.assert_array_equal(read_heights("map.npy", 1.0).heights, HEIGHTS)
    with h5py.File("b.h5", "w", userblock_size=512) as file:
        file["measurement/topography"] = HEIGHTS
    with refused("it is HDF5, but no NetCDF"):
        read_heights("b.h5", 1.0)
