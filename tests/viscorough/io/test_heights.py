"""Maps of heights are read exactly, with warnings about doubtful ones; bad files are refused with one line."""

import numpy as np
import pint
import pytest
import xarray as xr

import viscorough
from support.contract import refused
from viscorough import AccuracyWarning, read_heights
from viscorough.io.datasets import write_dataset

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore:.*rms slope")


@pytest.mark.filterwarnings("ignore:.*the map is tilted")
@pytest.mark.parametrize("dtype", ["float64", "float32", ">f8", "int16", "uint8"])
def test_heights_of_any_real_type_are_read_exactly(tmp_path, dtype):
    heights = np.arange(12).reshape(3, 4).astype(dtype)
    for array in (heights, np.asfortranarray(heights)):
        np.save(tmp_path / "heights.npy", array)
        indenter = read_heights(tmp_path / "heights.npy", 0.5)
        np.testing.assert_array_equal(indenter.heights, heights)
        assert indenter.heights.dtype == (np.float32 if dtype == "float32" else np.float64)
        assert indenter.heights.flags.c_contiguous
        assert indenter.spacing == 0.5


def test_heights_of_netcdf_files_are_read(tmp_path):
    heights = np.array([[np.nan, 1.0], [2.0, 3.0]])
    attributes = {"long_name": "height", "units": "um"}
    only = xr.Dataset({"z": (("y", "x"), heights, attributes), "rms": ((), 1.0, attributes)})
    named = only.assign(heights=(("y", "x"), 2 * heights, attributes))
    for ds, factor in ((only, 1), (named, 2)):
        write_dataset(ds, tmp_path / "a.nc")
        indenter = read_heights(tmp_path / "a.nc", 1.0)
        np.testing.assert_allclose(indenter.heights, 1e-6 * factor * heights, rtol=1e-14)
        assert indenter.length_unit == "m"
    for ds, what in (
        (named.rename(heights="y2"), "z, y2"),
        (only.drop_vars("z"), "maps of 2 dimensions: none"),
        (named.expand_dims(time=3), r"variable heights has the further dimensions time \(3\)"),
    ):
        write_dataset(ds, tmp_path / "b.nc")
        with refused(f"b.nc.*{what}"):
            read_heights(tmp_path / "b.nc", 1.0)


def test_leading_dimensions_of_length_1_are_left_out(tmp_path):
    """Leading dimensions of length 1 are left out. The spacings belong to the last two dimensions."""
    coordinates = {name: (name, step * np.arange(n), {"units": "um"}) for name, n, step in (("y", 3, 2), ("x", 4, 1))}
    heights = 1e-3 * np.random.default_rng(0).random((3, 4))
    plane = xr.Dataset({"z": (("y", "x"), heights, {"units": "um"})}, coordinates)
    for leading in ({"time": 1}, {"time": 1, "band": 1}):
        plane.expand_dims(leading).to_netcdf(tmp_path / "a.nc")
        indenter = read_heights(tmp_path / "a.nc")
        np.testing.assert_allclose(indenter.heights, 1e-6 * heights, rtol=1e-14)
        assert (indenter.spacing, indenter.row_spacing) == (1e-6, 2e-6)
    series = plane.expand_dims(time=3)
    series.to_netcdf(tmp_path / "series.nc")
    with refused(r"variable z has the further dimensions time \(3\); .* as isel\(time=0\) of xarray gives"):
        read_heights(tmp_path / "series.nc")
    series.isel(time=0).to_netcdf(tmp_path / "one.nc")
    np.testing.assert_allclose(read_heights(tmp_path / "one.nc").heights, 1e-6 * heights, rtol=1e-14)
    xr.merge([series.rename(z="series"), plane]).to_netcdf(tmp_path / "both.nc")
    np.testing.assert_allclose(read_heights(tmp_path / "both.nc").heights, 1e-6 * heights, rtol=1e-14)
    with refused("further dimensions time"):
        read_heights(tmp_path / "both.nc", channel="series")


@pytest.mark.parametrize(
    ("heights", "what"),
    [
        (np.zeros((2, 2), complex), "real numbers are needed"),
        (np.array([["a", "b"]]), "real numbers are needed"),
        (np.array([[None, 1]]), "not readable .*pickle"),
        (np.array([[1.0, -np.inf]]), "infinite"),
    ],
)
def test_bad_heights_are_one_line(tmp_path, heights, what):
    np.save(tmp_path / "heights.npy", heights, allow_pickle=True)
    with refused(rf"heights\.npy.*{what}"):
        read_heights(tmp_path / "heights.npy", 1.0)


def test_bad_files_of_heights_are_one_line(tmp_path):
    np.save(tmp_path / "whole.npy", np.zeros((3, 3)))
    np.savez(tmp_path / "archive.npz", np.zeros((3, 3)))
    whole = (tmp_path / "whole.npy").read_bytes()
    damaged = {"cut.npy": whole[:-8], "head.npy": whole[:9], "empty.npy": b"", "text.npy": b"0 1\n2 3\n"}
    damaged |= {"archive.npy": (tmp_path / "archive.npz").read_bytes()}
    damaged |= {"open.npy": whole.replace(b"(3, 3)", b"(3, 3 "), "odd.npy": whole.replace(b"False", b"Fal%e")}
    for name, content in damaged.items():
        (tmp_path / name).write_bytes(content)
    (tmp_path / "folder.npy").mkdir()
    for name in (*damaged, "missing.npy", "missing.nc", "missing.txt", "missing", "folder.npy"):
        with refused(name):
            read_heights(tmp_path / name, 1.0)


def test_counts_are_scaled(tmp_path):
    """The map holds counts of a detector, 0.053 nm each, without a unit in the file."""
    np.save(tmp_path / "counts.npy", np.array([[0, 100], [200, 300]], np.int16))
    indenter = viscorough.read_heights(tmp_path / "counts.npy", 20.0, scale="0.053 nm")
    np.testing.assert_allclose(indenter.heights, np.array([[0, 5.3], [10.6, 15.9]]) * 1e-9, rtol=1e-14)
    assert (indenter.spacing, indenter.length_unit) == (pytest.approx(2e-8), "m")
    assert viscorough.read_heights(tmp_path / "counts.npy", 20.0, scale=2).heights[1, 1] == 600
    for scale in (0, "-1 nm", "1 s"):
        with refused(r"counts\.npy: "):
            viscorough.read_heights(tmp_path / "counts.npy", 20.0, scale=scale)
    viscorough.save(indenter, tmp_path / "m.nc")
    with refused("scale 0.053 nm: heights are in m in the file"):
        viscorough.read_heights(tmp_path / "m.nc", scale="0.053 nm")
    for odd in (["a", "b"], [True, False]):
        np.save(tmp_path / "odd.npy", np.array([odd, odd]))
        with refused(r"odd\.npy: .*real numbers are needed"):
            viscorough.read_heights(tmp_path / "odd.npy", 20.0, scale=2)


def test_scale_converts_values_that_are_no_lengths(tmp_path):
    """The values are phases of an interferometer, in radians. The message about the unit names the option."""
    values = np.array([[1, 2, 3], [4, 5, 7], [5, 8, 6]]) + 0.5
    xr.Dataset({"z": (("y", "x"), values, {"units": "rad"})}).to_netcdf(tmp_path / "a.nc")
    with refused(r"unit 'rad': not a unit of length, .*; argument scale, such as '5 nm', states the height of 1 rad"):
        read_heights(tmp_path / "a.nc", 2000.0)
    with pytest.warns(AccuracyWarning, match="tilted"):
        indenter = read_heights(tmp_path / "a.nc", "2 um", scale="5 nm")
    np.testing.assert_allclose(indenter.heights, 5e-9 * values, rtol=1e-14)
    assert (indenter.spacing, indenter.length_unit) == (pytest.approx(2e-6), "m")
    with refused("unit 'rad': not a unit of length"):
        read_heights(tmp_path / "a.nc", 2000.0, scale=5)


@pytest.mark.parametrize("content", [b"\x01\x02" + 40 * b"\xff\xd8abc", 9 * b"1 2\x08\n"])
def test_binary_files_with_the_suffix_of_a_text_are_refused_without_their_bytes(tmp_path, content):
    path = tmp_path / "a.txt"
    path.write_bytes(content)
    with refused(r"a\.txt: its content has no known format") as error:
        read_heights(path, 1.0)
    assert str(error.value).isprintable()
    assert len(str(error.value)) < len(str(path)) + 120


@pytest.mark.parametrize(("slope", "is_steep"), [(0.29, False), (0.31, True)])
def test_steep_slopes_give_a_warning(tmp_path, recwarn, slope, is_steep):
    ridges = np.abs(np.arange(16) % 8 - 4.0)  # the slope is 1 almost everywhere
    heights = np.broadcast_to(ridges, (16, 16)) * slope
    np.save(tmp_path / "a.npy", heights)
    indenter = read_heights(tmp_path / "a.npy", 1.0)
    assert indenter.rms_slope == pytest.approx(slope)
    texts = [str(warning.message) for warning in recwarn if warning.category is viscorough.AccuracyWarning]
    expected = f"{tmp_path / 'a.npy'}: the rms slope is 0.31; the theory holds for small slopes, below about 0.3"
    assert texts == [expected] * is_steep


def test_a_spacing_may_be_a_text_with_a_unit(tmp_path):
    np.save(tmp_path / "a.npy", np.random.default_rng(1).normal(size=(4, 4)))
    for spacing in ("0.5 um", ("500 nm", "0.5 um"), 500):
        indenter = read_heights(tmp_path / "a.npy", spacing, unit="nm")
        assert (indenter.spacing, indenter.row_spacing) == pytest.approx((5e-7, 5e-7))
    with refused("spacing '0.5 Pa'|unit 'Pa': cannot be converted to nm"):
        read_heights(tmp_path / "a.npy", "0.5 Pa", unit="nm")
    with refused(r"spacing 0.5 um: needs a plain number, since the unit of heights is not known"):
        read_heights(tmp_path / "a.npy", "0.5 um")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"spacing": 1e-320}, "too small to represent"),
        ({"spacing": 10**400}, "argument spacing: 1.* real numbers are needed"),
        ({"spacing": 1j}, "argument spacing: 1j; real numbers"),
        ({"spacing": True}, "argument spacing: True; real numbers"),
        ({"spacing": pint.Quantity([1.0, 2.0], "um"), "unit": "um"}, "argument spacing: .* real numbers"),
        ({"spacing": 1.0, "scale": 1j}, "argument scale: 1j; real numbers"),
        ({"spacing": 1.0, "scale": 10**400}, "argument scale: 1.* real numbers"),
        ({"spacing": 1.0, "nodata": 1j}, "nodata: 1j; real numbers"),
        ({"spacing": 1.0, "crop": 5}, "crop: 5"),
        ({"spacing": 1.0, "crop": [[0, 1.5], [0, 2]]}, "crop: must be a whole number"),
    ],
)
def test_arguments_that_are_no_numbers_are_refused_by_name(tmp_path, options, message):
    np.save(tmp_path / "heights.npy", np.arange(16.0).reshape(4, 4) % 5)
    with refused(rf"heights.npy: .*{message}"):
        read_heights(tmp_path / "heights.npy", **options)


def map_of(x, y, heights, **attributes):
    """Return a dataset of heights in um with coordinates in um."""
    axes = {name: (name, values, {"units": "um"}) for name, values in (("y", y), ("x", x))}
    return xr.Dataset({"heights": (("y", "x"), heights, {"units": "um", **attributes})}, axes)


HEIGHTS = np.random.default_rng(4).normal(0, 0.01, (6, 8))


@pytest.mark.parametrize("sign_y", [1, -1])
@pytest.mark.parametrize("sign_x", [1, -1])
def test_contacts_have_the_coordinates_of_the_map(tmp_path, sign_x, sign_y):
    """Rows and columns may rise or fall; the map is not mirrored."""
    x, y = 5 + sign_x * 0.5 * np.arange(8), 100 + sign_y * 0.25 * np.arange(6)
    map_of(x, y, HEIGHTS).to_netcdf(tmp_path / "a.nc")
    surface = read_heights(tmp_path / "a.nc", crop=((1, 8), (0, 5)))
    for result in (
        surface,
        viscorough.contact_at(surface, depth=1e-8),
    ):
        viscorough.save(result, tmp_path / "result.nc")
        with xr.open_dataset(tmp_path / "result.nc") as ds:
            np.testing.assert_allclose(ds.x, 1e-6 * x[1:], rtol=1e-14)
            np.testing.assert_allclose(ds.y, 1e-6 * y[:5], rtol=1e-14)


@pytest.mark.parametrize(("spacing", "is_doubtful"), [(2e-11, True), (2e-9, False), (1.2, False), (1.3, True)])
@pytest.mark.parametrize("suffix", ["npy", "nc"])
def test_a_field_of_unlikely_size_gives_a_warning(tmp_path, recwarn, spacing, is_doubtful, suffix):
    """The eight points per row span 0.16 nm, 16 nm, 9.6 m and 10.4 m."""
    heights = 1e-3 * spacing * np.random.default_rng(1).random((8, 8))
    np.save(tmp_path / "a.npy", heights)
    viscorough.save(viscorough.Indenter(heights, spacing, length_unit="m"), tmp_path / "a.nc")
    read_heights(tmp_path / f"a.{suffix}", *([spacing] if suffix == "npy" else []), unit="m")
    texts = [str(warning.message) for warning in recwarn]
    assert (
        any("fields are from 1 nm to 10 m wide: check argument spacing and argument unit" in text for text in texts)
        is is_doubtful
    )


@pytest.mark.parametrize(("offset", "is_coarse"), [(1e2, False), (1e4, True)])
def test_coarse_heights_in_single_precision_give_a_warning(tmp_path, recwarn, offset, is_coarse):
    """Single precision has steps of 7.6e-6 at 100 and of 9.8e-4 at 10 000; the rms height is 1e-3."""
    heights = np.random.default_rng(1).normal(offset, 1e-3, (32, 32))
    np.save(tmp_path / "a.npy", heights.astype(np.float32))
    np.save(tmp_path / "b.npy", heights)
    read_heights(tmp_path / "a.npy", 1.0)
    assert any("heights are stored in steps of" in str(warning.message) for warning in recwarn) is is_coarse
    recwarn.clear()
    read_heights(tmp_path / "b.npy", 1.0)
    assert not [warning for warning in recwarn if "steps" in str(warning.message)]


def test_lines_of_other_programs_give_a_warning(tmp_path, recwarn):
    """viscorough writes lines with the spectrum that Eq. 13 needs."""
    line = viscorough.self_affine_line(0.7, 32, seed=1, length_unit="m")
    viscorough.save(line, tmp_path / "own.nc")
    np.testing.assert_array_equal(viscorough.read_line(tmp_path / "own.nc").heights, line.heights)
    assert not recwarn
    xr.open_dataset(tmp_path / "own.nc").load().drop_attrs(deep=False).to_netcdf(tmp_path / "other.nc")
    np.save(tmp_path / "a.npy", line.heights)
    for path, spacing in ((tmp_path / "other.nc", None), (tmp_path / "a.npy", line.spacing)):
        with pytest.warns(AccuracyWarning, match="a line cut from a measured surface is stiffer than the surface"):
            viscorough.read_line(path, spacing, unit="m")
