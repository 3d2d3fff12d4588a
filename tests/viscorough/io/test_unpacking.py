"""Packed and missing values of NetCDF variables, for attributes of any type."""

import netCDF4
import numpy as np
import pytest

from support.contract import refused
from viscorough.io import netcdf
from viscorough.io.heights import read_heights

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore:.*rms slope")

NAN = np.nan


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


def read(path):
    return netcdf.read(path).variables["z"].values


@pytest.mark.parametrize("kind", ["f4", "f8", "i2", "u4", "i8"])
def test_values_that_were_not_written_are_missing(tmp_path, kind):
    path = stored(tmp_path / "a.nc", kind, [[1, None], [3, 4]])
    np.testing.assert_array_equal(read(path), [[1, NAN], [3, 4]])
    indenter = read_heights(path, 1.0)
    assert indenter.elements == 3
    np.testing.assert_array_equal(indenter.initial_gap, [[3, NAN], [1, 0]])


@pytest.mark.parametrize(("kind", "fill"), [("u1", 255), ("i1", -127)])
def test_every_value_of_a_byte_is_valid_without_a_fill_value(tmp_path, kind, fill):
    """255 is white in an 8-bit picture."""
    np.testing.assert_array_equal(read(stored(tmp_path / "a.nc", kind, [[1, fill]])), [[1, fill]])
    np.testing.assert_array_equal(read(stored(tmp_path / "b.nc", kind, [[1, fill]], fill_value=fill)), [[1, NAN]])


@pytest.mark.parametrize(
    ("kind", "attributes", "expected"),
    [
        # 1e20 in double precision is no number of single precision.
        ("f4", {"missing_value": 1e20}, [[1, 2], [3, NAN]]),
        ("f4", {"missing_value": 1e20, "fill_value": 2}, [[1, NAN], [3, NAN]]),
        ("f8", {"missing_value": [1.0, 3.0]}, [[NAN, 2], [NAN, 1e20]]),
        ("f8", {"valid_range": [2.0, 3.0]}, [[NAN, 2], [3, NAN]]),
        ("f4", {"valid_min": 2}, [[NAN, 2], [3, 1e20]]),
        ("f8", {"valid_max": 3.0, "scale_factor": 2.0, "add_offset": 1.0}, [[3, 5], [7, NAN]]),
        ("i2", {"missing_value": 9.0}, [[1, 2], [3, NAN]]),
        ("i2", {"missing_value": 99_999}, [[1, 2], [3, 9]]),
        ("i2", {"valid_max": np.int16(3), "scale_factor": 0.5}, [[0.5, 1], [1.5, NAN]]),
        ("i2", {"valid_range": np.array([2, 3], np.int16), "add_offset": 10.0}, [[NAN, 12], [13, NAN]]),
        ("u2", {"missing_value": np.int32(-9)}, [[1, 2], [3, 9]]),
    ],
)
def test_attributes_mark_missing_values(tmp_path, kind, attributes, expected):
    """The last stored value is 1e20 for real numbers, or 9 for whole numbers. Attributes of storage are not kept."""
    path = stored(tmp_path / "a.nc", kind, [[1, 2], [3, 1e20 if kind.startswith("f") else 9]], **attributes)
    expected = np.array(expected).astype(kind if kind.startswith("f") else float)
    np.testing.assert_array_equal(read(path), expected)
    assert netcdf.read(path).variables["z"].attributes == {}
    np.testing.assert_array_equal(read_heights(path, 1.0).heights, expected)


@pytest.mark.parametrize(
    ("kind", "attributes", "what"),
    [
        ("f8", {"missing_value": "none"}, "'none', not a number"),
        ("f8", {"scale_factor": [1.0, 2.0]}, r"array\(\[1., 2.\]\), not a number"),
        ("f8", {"valid_range": "0 5"}, "'0 5', not two numbers"),
        ("f8", {"valid_min": [0.0, 1.0]}, ".* not a number"),
        ("i2", {"valid_max": 1.0, "scale_factor": 0.5}, ".* not a number like those stored"),
        ("i1", {"_Unsigned": "yes"}, "'yes', not 'true' or 'false'"),
    ],
)
def test_attributes_that_are_no_numbers_are_refused(tmp_path, kind, attributes, what):
    path = stored(tmp_path / "a.nc", kind, [[1, 2], [3, 9]], **attributes)
    with refused(f"a.nc: not readable .*attribute {next(iter(attributes))} of z is {what}"):
        read(path)


@pytest.mark.parametrize(
    ("kind", "attributes", "expected"),
    [
        ("i1", {"_Unsigned": "true"}, [[1, 156], [255, 128]]),
        ("i1", {"_Unsigned": "True", "fill_value": -1}, [[1, 156], [NAN, 128]]),
        ("i1", {"_Unsigned": "true", "missing_value": np.int16(255)}, [[1, 156], [NAN, 128]]),
        ("i1", {"_Unsigned": "true", "valid_range": np.array([2, -100], np.int8)}, [[NAN, 156], [NAN, 128]]),
        ("i1", {"_Unsigned": "true", "scale_factor": 0.5, "add_offset": -1.0}, [[-0.5, 77], [126.5, 63]]),
        ("i2", {"_Unsigned": "true"}, [[1, 65436], [65535, 65408]]),
        ("i1", {"_Unsigned": "false"}, [[1, -100], [-1, -128]]),
        ("f4", {"_Unsigned": "true"}, [[1, -100], [-1, -128]]),
    ],
)
def test_unsigned_numbers_stored_as_signed_ones_are_read(tmp_path, kind, attributes, expected):
    path = stored(tmp_path / "a.nc", kind, [[1, -100], [-1, -128]], **attributes)
    np.testing.assert_array_equal(read(path), expected)
    np.testing.assert_array_equal(read_heights(path, 1.0).heights, expected)


def test_signed_numbers_stored_as_unsigned_ones_are_read(tmp_path):
    path = stored(tmp_path / "a.nc", "u1", [[1, 156], [255, 128]], _Unsigned="false", missing_value=np.uint8(255))
    np.testing.assert_array_equal(read(path), [[1, -100], [NAN, -128]])


@pytest.mark.parametrize("fill", [-32767, 7])
def test_unsigned_values_that_were_not_written_are_missing(tmp_path, fill):
    options = {} if fill == -32767 else {"fill_value": fill}
    path = stored(tmp_path / "a.nc", "i2", [[1, None], [-1, 4]], _Unsigned="true", **options)
    np.testing.assert_array_equal(read(path), [[1, NAN], [65535, 4]])


def test_whole_numbers_beyond_double_precision_are_refused(tmp_path):
    with refused(r"whole numbers must not exceed 2\*\*53"):
        read_heights(stored(tmp_path / "a.nc", "u8", [[2**60, None]]), 1.0)
