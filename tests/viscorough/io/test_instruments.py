"""Files written by instruments and other programs; for their formats the extra `formats` is needed."""

import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from support.contract import refused
from viscorough import AccuracyWarning, read_heights

SurfaceTopography = pytest.importorskip("SurfaceTopography", reason="the extra 'formats' is not installed")
FILES = Path(__file__).with_name("instrument_files")
pytestmark = pytest.mark.filterwarnings("ignore::viscorough.errors.AccuracyWarning")


@pytest.mark.parametrize(
    ("name", "shape", "spacing", "unit"),
    [
        ("gwyddion-export-english.txt", (4, 3), (12.34e-6 / 3, 5678.9e-9 / 4), "m"),
        ("gwyddion-export-german.txt", (4, 3), (12.34e-6 / 3, 5678.9e-9 / 4), "m"),
        ("sdf-1.sdf", (4, 7), (1, 1), "um"),
        ("unnamed.ibw", (10, 10), (1, 1), "1"),
        ("top-1.top", (256, 256), (600 / 256, 600 / 256), "nm"),
    ],
)
def test_files_of_other_programs(name, shape, spacing, unit):
    """Heights, spacings and units, as SurfaceTopography reads them where it can: most of them are read without it."""
    reference = SurfaceTopography.read_topography(str(FILES / name))
    indenter = read_heights(FILES / name)
    assert indenter.heights.shape == shape
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx(spacing, rel=1e-12)
    assert indenter.length_unit == unit
    expected = np.ma.filled(np.ma.asarray(reference.heights(), dtype=float), np.nan).T
    np.testing.assert_allclose(indenter.heights, expected, rtol=1e-12)


@pytest.mark.parametrize("suffix", ["x3p", "gwy"])
def test_formats_written_by_another_program(tmp_path, suffix):
    """Rows are along y, points that were not measured are nan, both spacings are read, in metres."""
    heights = np.random.default_rng(1).random((6, 9)) * 1e-7
    measured = np.ma.masked_invalid(np.where(heights < 2e-8, np.nan, heights)) if suffix == "x3p" else heights
    surface = SurfaceTopography.Topography(measured.T, (9 * 2e-6, 6 * 3e-6), unit="m")
    getattr(surface, f"to_{suffix}")(str(tmp_path / f"a.{suffix}"))
    indenter = read_heights(tmp_path / f"a.{suffix}")
    np.testing.assert_allclose(indenter.heights, np.ma.filled(measured, np.nan), rtol=1e-6)
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2e-6, 3e-6), rel=1e-6)
    assert indenter.length_unit == "m"


def test_channels(tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for number, name in enumerate(("first", "second")):
            file[name] = np.random.default_rng(number).random((4, 4))
    with pytest.warns(AccuracyWarning, match="the channel 'first' is read; --channel chooses another of 'second'"):
        first = read_heights(tmp_path / "a.h5", 0.5, unit="um")
    second = read_heights(tmp_path / "a.h5", 0.5, unit="um", channel="second")
    by_number = read_heights(tmp_path / "a.h5", 0.5, unit="um", channel="1")
    np.testing.assert_array_equal(second.heights, by_number.heights)
    assert not np.allclose(first.heights, second.heights)
    assert (first.spacing, first.length_unit) == (0.5, "um")
    for channel, what in (
        (None, "--spacing is needed"),
        ("third", "no map of heights is called 'third'; .* are 'first'"),
    ):
        with refused(what):
            read_heights(tmp_path / "a.h5", channel=channel)


@pytest.mark.parametrize("name", ["a.mat", "a.npz", "a.bin", "a.h5"])
def test_arrays_have_rows_along_y(tmp_path, name):
    heights = np.random.default_rng(1).random((3, 5))
    with open(tmp_path / name, "wb") as file:
        if name == "a.mat":
            scipy.io.savemat(file, {"heights": heights})
        elif name == "a.npz":
            np.savez(file, heights=heights)
        elif name == "a.bin":
            np.save(file, heights)
        else:
            h5py = pytest.importorskip("h5py")
            with h5py.File(file, "w") as content:
                content["heights"] = heights
    np.testing.assert_array_equal(read_heights(tmp_path / name, 1.0).heights, heights)


def test_bad_files_are_one_line(tmp_path):
    (tmp_path / "noise.x3p").write_bytes(bytes(range(256)) * 4)
    (tmp_path / "square.raw").write_bytes(np.random.default_rng(1).bytes(2 * 50**2))
    (tmp_path / "empty.x3p").touch()
    (tmp_path / "cut.top").write_bytes((FILES / "top-1.top").read_bytes()[:9000])
    (tmp_path / "lines.sdf").write_text("1.0 2.0\n1.5 2.5\n2.0 3.0\n")
    for name in ("noise.x3p", "square.raw", "empty.x3p", "cut.top", "lines.sdf", "missing.plu"):
        with refused(name) as error:
            read_heights(tmp_path / name, 1.0)
        assert len(str(error.value)) < 400


def test_without_the_extra_the_message_names_the_remedy(tmp_path, monkeypatch):
    (tmp_path / "a.x3p").write_bytes(b"PK")
    monkeypatch.setitem(sys.modules, "SurfaceTopography.IO", None)  # as if it were not installed
    with refused(r"pip install 'viscorough\[formats\]'"):
        read_heights(tmp_path / "a.x3p")


def test_contents_decide_where_a_suffix_is_shared(tmp_path):
    """Some instruments write binary files under .dat, which is read as text otherwise."""
    (tmp_path / "a.dat").write_text("1 2\n3 4\n")
    assert read_heights(tmp_path / "a.dat", (1.0, 1.0)).heights.tolist() == [[1, 2], [3, 4]]
    (tmp_path / "b.dat").write_bytes((FILES / "unnamed.ibw").read_bytes())
    assert read_heights(tmp_path / "b.dat").heights.shape == (10, 10)
