"""Files appear whole or not at all, round trips are exact, bad files are one line."""

import dataclasses
import os
import platform
import signal
import subprocess
import sys
import textwrap

import netCDF4
import numpy as np
import pandas as pd
import pytest
import xarray as xr

from viscorough.io import storage
from viscorough.loading_curve import LoadingCurve
from viscorough_study.tables import write_table


def a_curve(levels=7, seed=0, **changes):
    """Increasing numbers with all the digits a double has; nothing of physics."""
    random = np.random.default_rng(seed)
    values = {
        "depth": np.cumsum(random.random(levels) + 0.1) * 1e-7,
        "force": np.cumsum(random.random(levels) + 0.1) * 1e-13,
        "stiffness": np.cumsum(random.random(levels) + 0.1) * 1e-6,
        "contact_count": np.cumsum(random.integers(1, 9, levels)),
        "elements": 1009,
        "method": "boundary elements",
        "tolerance": 1e-3 / 3,
        "operator_applications": 41,
        "residual": random.random(levels) * 1e-4,
    }
    return LoadingCurve(**(values | changes))


def a_dataset(values):
    return xr.Dataset({"depth": ("level", values, {"long_name": "depth", "units": "m"})})


def assert_same(one, other):
    for field in dataclasses.fields(LoadingCurve):
        ours, theirs = getattr(one, field.name), getattr(other, field.name)
        np.testing.assert_array_equal(ours, theirs, err_msg=field.name, strict=True)
        assert type(ours) is type(theirs), field.name


def one_line(error):
    text = str(error.value)
    assert text
    assert "\n" not in text
    return text


# ---- whole or not at all


def test_bytes_are_reproducible_and_no_time_is_written(tmp_path):
    ds = storage.stack_curves([a_curve(900, seed) for seed in range(5)])
    for name in ("one.nc", "two.nc"):
        storage.write_dataset(ds, tmp_path / name)
    assert (tmp_path / "one.nc").read_bytes() == (tmp_path / "two.nc").read_bytes()
    assert set(storage.read_dataset(tmp_path / "one.nc").attrs) == {
        "title",
        "comment",
        "Conventions",
        "source",
    }


def test_permissions_are_those_of_any_new_file(tmp_path):
    storage.write_dataset(a_dataset([1.0]), tmp_path / "new.nc")
    (tmp_path / "plain").write_text("")
    assert (tmp_path / "new.nc").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_target_of_a_link_is_replaced_and_not_the_link(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "link.nc").symlink_to(tmp_path / "folder" / "real.nc")
    storage.write_dataset(a_dataset([1.0]), tmp_path / "link.nc")
    assert (tmp_path / "link.nc").is_symlink()
    assert (tmp_path / "folder" / "real.nc").is_file()


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, MemoryError, TypeError])
def test_interrupted_writing_leaves_what_was_there_before(tmp_path, monkeypatch, interruption):
    path = tmp_path / "curve.nc"
    storage.write_dataset(a_dataset([1.0]), path)
    whole = path.read_bytes()

    def half_way(ds, target, **options):
        target.write_bytes(b"half")
        raise interruption

    monkeypatch.setattr(xr.Dataset, "to_netcdf", half_way)
    with pytest.raises(interruption):
        storage.write_dataset(a_dataset([2.0]), path)
    assert path.read_bytes() == whole
    assert os.listdir(tmp_path) == ["curve.nc"]


def test_killed_while_writing_leaves_no_file(tmp_path):
    script = textwrap.dedent("""
        import sys, time, xarray as xr
        from viscorough.io import storage
        write = xr.Dataset.to_netcdf
        def slow(ds, target, **options):
            write(ds, target, **options)
            print(target, flush=True)
            time.sleep(60)
        xr.Dataset.to_netcdf = slow
        ds = xr.Dataset({"depth": ("level", [1.0], {"long_name": "depth", "units": "m"})})
        storage.write_dataset(ds, sys.argv[1])
    """)
    command = [sys.executable, "-c", script, str(tmp_path / "curve.nc")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        temporary = process.stdout.readline().strip()
        assert os.path.dirname(temporary) == str(tmp_path), "else os.replace is not atomic"
        process.send_signal(signal.SIGKILL)
    assert process.returncode == -signal.SIGKILL
    assert not (tmp_path / "curve.nc").exists()
    assert not [name for name in os.listdir(tmp_path) if name.endswith(".nc")]


@pytest.mark.parametrize("limit", [0, 1000, 20_000])
def test_full_disk_is_one_line_and_leaves_nothing(tmp_path, limit):
    """A limit on the size of files stands for the full disk: both fail in the middle of writing."""
    script = textwrap.dedent("""
        import resource, sys
        import numpy as np, xarray as xr
        from viscorough.io import storage
        noise = np.random.default_rng(0).random(20_000)
        ds = xr.Dataset({"depth": ("level", noise, {"long_name": "depth", "units": "m"})})
        resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]), int(sys.argv[2])))
        try:
            storage.write_dataset(ds, sys.argv[1])
        except OSError as error:
            print(error)
    """)
    command = [sys.executable, "-c", script, str(tmp_path / "curve.nc"), str(limit)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) == 1
    assert "curve.nc: not written" in done.stdout
    assert os.listdir(tmp_path) == []


def test_places_where_no_file_can_appear(tmp_path, monkeypatch):
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")  # of the kind of /dev/null, which replacing would break the machine
    for path in (tmp_path / "none" / "a.nc", tmp_path / "folder", tmp_path / "pipe"):
        with pytest.raises(ValueError, match=str(path)) as error:
            storage.write_dataset(a_dataset([1.0]), path)
        one_line(error)
    monkeypatch.setattr(os, "access", lambda path, mode: False)  # root may write everywhere
    with pytest.raises(ValueError, match="not writable"):
        storage.write_dataset(a_dataset([1.0]), tmp_path / "a.nc")
    assert sorted(os.listdir(tmp_path)) == ["folder", "pipe"]


# ---- CF


@pytest.mark.parametrize("attribute", ["units", "long_name"])
def test_every_variable_needs_units_and_long_name(tmp_path, attribute):
    ds = a_dataset([1.0])
    del ds["depth"].attrs[attribute]
    with pytest.raises(ValueError, match=f"variable depth lacks {attribute}"):
        storage.write_dataset(ds, tmp_path / "a.nc")
    assert os.listdir(tmp_path) == []


def test_files_carry_cf_attributes_and_compress_large_floats(tmp_path):
    large = storage.stack_curves([a_curve(storage.COMPRESSED_FROM)], length_unit="um")
    large = large.assign_coords(realization=("realization", [0.5], {"long_name": "coordinate", "units": "1"}))
    storage.write_dataset(large, tmp_path / "a.nc")
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


@pytest.mark.parametrize(
    ("length_unit", "depth", "force"),
    [
        ("m", "m", "m2"),
        ("1", "1", "1"),
        ("micrometre", "micrometre", "micrometre2"),
        ("1e-6 m", "1e-6 m", "(1e-6 m)2"),
    ],
)
def test_units_are_powers_of_the_length_unit(length_unit, depth, force):
    ds = storage.curve_to_dataset(a_curve(), length_unit)
    assert (ds["depth"].units, ds["stiffness"].units, ds["force"].units) == (depth, depth, force)
    assert {ds[name].units for name in ("contact_count", "contact_fraction", "residual")} == {"1"}


# ---- round trips


def test_every_field_of_a_curve_is_stored():
    assert {field.name for field in dataclasses.fields(LoadingCurve)} == {*storage.STORED, *storage.PER_CURVE}


@pytest.mark.parametrize("levels", [1, 7, storage.COMPRESSED_FROM])
def test_curve_survives_a_file_exactly(tmp_path, levels):
    curve = a_curve(levels)
    storage.write_dataset(storage.curve_to_dataset(curve), tmp_path / "curve.nc")
    ds = storage.read_dataset(tmp_path / "curve.nc")
    assert_same(storage.curve_from_dataset(ds), curve)
    np.testing.assert_array_equal(ds["contact_fraction"], curve.contact_fraction)


def test_stacked_curves_survive_files_exactly(tmp_path):
    curves = [a_curve(5), a_curve(1, seed=1, method="dense"), a_curve(9, seed=2, elements=2, operator_applications=0)]
    ds = storage.stack_curves(curves)
    assert ds["depth"].dims == ("realization", "level")
    assert int(ds["depth"].isnull().sum()) == 4 + 8
    assert ds["levels"].values.tolist() == [5, 1, 9]
    for name in ("once.nc", "twice.nc"):
        storage.write_dataset(ds, tmp_path / name)
        ds = storage.read_dataset(tmp_path / name)
        for read, curve in zip(storage.unstack_curves(ds), curves, strict=True):
            assert_same(read, curve)
    with pytest.raises(ValueError, match="at least one"):
        storage.stack_curves([])


def test_table_survives_both_files_exactly(tmp_path):
    table = pd.DataFrame(
        {
            "source": ["discs", "lines", "discs"],
            "beta": [0.1 + 0.2, 1 / 3, np.nan],
            "realizations": [8, 50, 16],
            "passed": [True, False, True],
        }
    )
    columns = {
        "source": ("origin of the curves", None),
        "beta": ("exponent of the power law", "1"),
        "realizations": ("number of realizations", "1"),
        "passed": ("whether it agrees", "1"),
    }
    files = tmp_path / "fits.csv", tmp_path / "fits.nc"
    write_table(table, *files, columns=columns, dimension="fit", title="Fits")
    pd.testing.assert_frame_equal(pd.read_csv(files[0]), table, check_exact=True)
    ds = storage.read_dataset(files[1])
    assert dict(ds.sizes) == {"fit": 3}
    assert ds.title == "Fits"
    assert ds["beta"].attrs == {"long_name": "exponent of the power law", "units": "1"}
    pd.testing.assert_frame_equal(ds.to_dataframe(), table, check_exact=True, check_names=False, check_index_type=False)
    del columns["beta"]
    with pytest.raises(ValueError, match="beta"):
        write_table(table, tmp_path / "b.csv", tmp_path / "b.nc", columns=columns, dimension="fit", title="")
    assert sorted(os.listdir(tmp_path)) == ["fits.csv", "fits.nc"]


# ---- bad files


def test_missing_foreign_and_truncated_files_are_one_line(tmp_path):
    storage.write_dataset(storage.stack_curves([a_curve(5000)]), tmp_path / "whole.nc")
    whole = (tmp_path / "whole.nc").read_bytes()
    (tmp_path / "folder.nc").mkdir()
    cases = {"missing.nc": None, "folder.nc": None, "empty.nc": b"", "text.nc": b"depth,force\n1,2\n"}
    cases |= {f"cut{share}.nc": whole[: len(whole) * share // 100] for share in (0, 1, 10, 50, 90, 99)}
    for name, content in cases.items():
        if content is not None:
            (tmp_path / name).write_bytes(content)
        with pytest.raises(ValueError, match=f"{name}: not readable") as error:
            storage.read_dataset(tmp_path / name)
        one_line(error)


def test_damage_inside_compressed_data_is_noticed(tmp_path):
    storage.write_dataset(storage.stack_curves([a_curve(5000)]), tmp_path / "a.nc")
    content = bytearray((tmp_path / "a.nc").read_bytes())
    middle = len(content) // 2
    content[middle : middle + 64] = bytes(64)
    (tmp_path / "a.nc").write_bytes(content)
    with pytest.raises(ValueError, match="not readable"):
        storage.read_dataset(tmp_path / "a.nc")


def test_datasets_that_are_no_curve():
    good = storage.curve_to_dataset(a_curve())
    falling = good.copy(deep=True)
    falling["depth"][3] = 0
    flat = good.copy(deep=True)
    flat["stiffness"][0] = 0
    unknown = good.copy(deep=True)
    unknown["force"][-1] = np.nan
    cases = {
        r"no numbers stiffness\(level\)": good.drop_vars("stiffness"),
        r"no numbers depth\(level\)": good.isel(level=0),
        "no attribute elements": good.drop_attrs(),
        "there is no level": good.isel(level=slice(0)),
        "depth must": falling,
        "stiffness must": flat,
        "force must": unknown,
    }
    for what, ds in cases.items():
        with pytest.raises(ValueError, match=what) as error:
            storage.curve_from_dataset(ds)
        one_line(error)
    for bad in (a_curve(force=np.full(7, np.inf)), a_curve(depth=np.zeros(7)), a_curve(levels=0)):
        for make in (storage.curve_to_dataset, lambda curve: storage.stack_curves([a_curve(), curve])):
            with pytest.raises(ValueError, match="loading curve") as error:
                make(bad)
            one_line(error)


# ---- heights


def heights_file(folder, heights, name="heights.npy"):
    np.save(folder / name, heights, allow_pickle=True)
    return folder / name


@pytest.mark.parametrize("dtype", ["float64", "float32", "float16", ">f8", "int16", "uint8"])
def test_heights_of_any_real_type_are_read_exactly(tmp_path, dtype):
    heights = np.arange(12).reshape(3, 4).astype(dtype)
    for array in (heights, np.asfortranarray(heights)):
        indenter = storage.read_heights(heights_file(tmp_path, array), 0.5)
        np.testing.assert_array_equal(indenter.heights, heights)
        assert indenter.heights.dtype == np.dtype(float)
        assert indenter.heights.flags.c_contiguous
        assert indenter.spacing == 0.5


def test_heights_of_netcdf(tmp_path):
    heights = np.array([[np.nan, 1.0], [2.0, 3.0]])
    attributes = {"long_name": "height", "units": "um"}
    only = xr.Dataset({"z": (("y", "x"), heights, attributes), "rms": ((), 1.0, attributes)})
    named = only.assign(heights=(("y", "x"), 2 * heights, attributes))
    for name, ds, factor in (("only.nc", only, 1), ("named.nc", named, 2)):
        storage.write_dataset(ds, tmp_path / name)
        np.testing.assert_array_equal(storage.read_heights(tmp_path / name, 1.0).heights, factor * heights)
        assert storage.length_unit_of(tmp_path / name) == "um"
    assert storage.length_unit_of("heights.npy") == "1"
    packed = {"z": {"dtype": "int16", "scale_factor": 0.5, "_FillValue": -1}}
    only.drop_attrs().to_netcdf(tmp_path / "packed.nc", encoding=packed)
    np.testing.assert_array_equal(storage.read_heights(tmp_path / "packed.nc", 1.0).heights, heights)
    assert storage.length_unit_of(tmp_path / "packed.nc") == "1"
    for name, ds, what in (
        ("two.nc", named.rename(heights="y2"), "z, y2"),
        ("none.nc", only.drop_vars("z"), "no two-dimensional"),
        ("cube.nc", named.expand_dims("realization"), "shape"),
    ):
        storage.write_dataset(ds, tmp_path / name)
        with pytest.raises(ValueError, match=what) as error:
            storage.read_heights(tmp_path / name, 1.0)
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
        storage.read_heights(heights_file(tmp_path, heights), 1.0)
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
    (tmp_path / "heights.txt").write_text("0 1\n2 3\n")
    for name in (*cases, "missing.npy", "missing.nc", "folder.npy", "heights.txt", "heights"):
        with pytest.raises(ValueError, match=name) as error:
            storage.read_heights(tmp_path / name, 1.0)
        one_line(error)


def test_what_a_killed_process_left_vanishes(tmp_path):
    """Another process's file stays while that runs."""
    kill = "import os, sys; from viscorough.io.storage import whole_or_not_at_all as w\nwith w(sys.argv[1]) as t:\n"
    kill += "    t.write_text('half'); os.kill(os.getpid(), 9)"
    for _ in range(2):
        subprocess.run([sys.executable, "-c", kill, str(tmp_path / "a.csv")], check=False)
    assert len(list(tmp_path.glob(".a.csv.*.part"))) == 1, "the second took away what the first one left"
    running = tmp_path / f".a.csv.{platform.node()}.{os.getpid()}.1234abcd.part"
    running.write_text("of a process that is alive")
    with storage.whole_or_not_at_all(tmp_path / "a.csv") as temporary:
        temporary.write_text("whole")
    assert sorted(path.name for path in tmp_path.iterdir()) == [running.name, "a.csv"]
    assert (tmp_path / "a.csv").read_text() == "whole"
