"""Maps of heights in .npy and NetCDF files, read exactly; bad files are refused with one line."""

import numpy as np
import pytest
import xarray as xr

from support.curves import one_line
from viscorough.io.datasets import write_dataset
from viscorough.io.heights import read_heights


def heights_file(folder, heights, name="heights.npy"):
    np.save(folder / name, heights, allow_pickle=True)
    return folder / name


@pytest.mark.filterwarnings("ignore:.*the map is tilted")
@pytest.mark.parametrize("dtype", ["float64", "float32", "float16", ">f8", "int16", "uint8"])
def test_heights_of_any_real_type_are_read_exactly(tmp_path, dtype):
    heights = np.arange(12).reshape(3, 4).astype(dtype)
    for array in (heights, np.asfortranarray(heights)):
        indenter = read_heights(heights_file(tmp_path, array), 0.5)
        np.testing.assert_array_equal(indenter.heights, heights)
        assert indenter.heights.dtype == (np.float32 if dtype == "float32" else np.float64)
        assert indenter.heights.flags.c_contiguous
        assert indenter.spacing == 0.5


def test_heights_of_netcdf(tmp_path):
    heights = np.array([[np.nan, 1.0], [2.0, 3.0]])
    attributes = {"long_name": "height", "units": "um"}
    only = xr.Dataset({"z": (("y", "x"), heights, attributes), "rms": ((), 1.0, attributes)})
    named = only.assign(heights=(("y", "x"), 2 * heights, attributes))
    for name, ds, factor in (("only.nc", only, 1), ("named.nc", named, 2)):
        write_dataset(ds, tmp_path / name)
        indenter = read_heights(tmp_path / name, 1.0)
        np.testing.assert_array_equal(indenter.heights, factor * heights)
        assert indenter.length_unit == "um"
    packed = {"z": {"dtype": "int16", "scale_factor": 0.5, "_FillValue": -1}}
    only.drop_attrs().to_netcdf(tmp_path / "packed.nc", encoding=packed)
    indenter = read_heights(tmp_path / "packed.nc", 1.0)
    np.testing.assert_array_equal(indenter.heights, heights)
    assert indenter.length_unit == "1"
    for name, ds, what in (
        ("two.nc", named.rename(heights="y2"), "z, y2"),
        ("none.nc", only.drop_vars("z"), "no two-dimensional"),
        ("cube.nc", named.expand_dims("realization"), "shape"),
    ):
        write_dataset(ds, tmp_path / name)
        with pytest.raises(ValueError, match=what) as error:
            read_heights(tmp_path / name, 1.0)
        assert name in one_line(error)


BAD_HEIGHTS = {
    "line": (np.zeros(3), "shape"),
    "cube": (np.zeros((2, 2, 2)), "shape"),
    "number": (np.array(1.0), "shape"),
    "complex": (np.zeros((2, 2), complex), "complex128"),
    "text": (np.array([["a", "b"]]), "<U1"),
    "truth": (np.zeros((2, 2), bool), "bool"),
    "objects": (np.array([[None, 1]]), "not readable .*pickle"),
    "infinite": (np.array([[1.0, np.inf]]), "infinite"),
    "deep": (np.array([[1.0, -np.inf]]), "infinite"),
    "outside": (np.full((2, 2), np.nan), "nan"),
    "empty": (np.zeros((0, 3)), "at least one"),
}


@pytest.mark.parametrize("case", BAD_HEIGHTS)
def test_bad_heights_are_one_line(tmp_path, case):
    heights, what = BAD_HEIGHTS[case]
    with pytest.raises(ValueError, match=what) as error:
        read_heights(heights_file(tmp_path, heights), 1.0)
    assert "heights.npy" in one_line(error)


def test_bad_files_of_heights_are_one_line(tmp_path):
    whole = heights_file(tmp_path, np.zeros((3, 3))).read_bytes()
    np.savez(tmp_path / "archive.npz", np.zeros((3, 3)))
    cases = {"cut.npy": whole[:-8], "head.npy": whole[:9], "empty.npy": b"", "text.npy": b"0 1\n2 3\n"}
    cases |= {"archive.npy": (tmp_path / "archive.npz").read_bytes(), "text.nc": b"0 1"}
    cases |= {"open.npy": whole.replace(b"(3, 3)", b"(3, 3 "), "odd.npy": whole.replace(b"False", b"Fal%e")}
    for name, content in cases.items():
        (tmp_path / name).write_bytes(content)
    (tmp_path / "folder.npy").mkdir()
    (tmp_path / "heights.txt").write_text("0 1\n2 3 4\n")
    for name in (*cases, "missing.npy", "missing.nc", "folder.npy", "heights.txt", "heights"):
        with pytest.raises(ValueError, match=name) as error:
            read_heights(tmp_path / name, 1.0)
        one_line(error)
