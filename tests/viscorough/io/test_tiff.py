"""Maps of heights in TIFF files of microscopes, with the tags of ImageJ; georeferenced rasters are refused."""

import logging
import re
import subprocess
import sys

import numpy as np
import pytest
import tifffile

from support.contract import refused
from viscorough.io.heights import read_heights

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore:.*rms slope")

HEIGHTS = np.random.default_rng(0).random((5, 7)).astype("f4")


def imagej(path, **metadata):
    tifffile.imwrite(path, HEIGHTS, imagej=True, resolution=(2.0, 4.0), metadata=metadata)
    return path


def test_units_of_imagej_are_read(tmp_path):
    indenter = read_heights(imagej(tmp_path / "a.tif", unit="um"), unit="um")
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((0.5, 0.25), rel=1e-12)
    tifffile.imwrite(tmp_path / "plain.tif", HEIGHTS, resolution=(72, 72), resolutionunit="INCH")
    for path in (
        imagej(tmp_path / "b.tif", unit="px"),
        imagej(tmp_path / "c.tif", unit="um", yunit="mm"),
        tmp_path / "plain.tif",
    ):
        with refused("spacing is needed"):
            read_heights(path, unit="um")


def test_files_with_an_imagej_calibration_of_heights_are_refused(tmp_path):
    with refused("after a scale and an offset are applied"):
        read_heights(imagej(tmp_path / "a.tif", unit="um", cf=0, c0=5.0, c1=2.0, vunit="nm"), unit="m")


COMPRESSIONS = {
    "lzw": {"compression": "lzw"},
    "zstd": {"compression": "zstd"},
    "deflate_pred3": {"compression": "deflate", "predictor": 3},
}


@pytest.mark.parametrize("name", COMPRESSIONS)
def test_compressed_files_need_the_extra(tmp_path, name):
    """The extra `formats` reads them; without it, the message names it."""
    pytest.importorskip("imagecodecs", reason="the extra 'formats' is not installed")
    path = tmp_path / f"{name}.tif"
    tifffile.imwrite(path, HEIGHTS, **COMPRESSIONS[name])
    np.testing.assert_array_equal(read_heights(path, 1).heights, HEIGHTS)
    program = f"import sys, viscorough; sys.modules['imagecodecs'] = None; viscorough.read_heights({str(path)!r}, 1)"
    error = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False).stderr
    what = r'compressed by .*; pip install "viscorough\[formats\]" installs the decoder'
    assert re.search(rf"ValueError: .*{name}\.tif: .*{what}", error.splitlines()[-1])


def test_pages_are_chosen_by_number(tmp_path):
    tifffile.imwrite(tmp_path / "a.tif", np.stack([HEIGHTS, 2 * HEIGHTS]), photometric="minisblack")
    np.testing.assert_array_equal(read_heights(tmp_path / "a.tif", 1, channel="1").heights, 2 * HEIGHTS)
    for channel in ("2", "z"):
        with refused("it has 2 pages; channel 0 to 1"):
            read_heights(tmp_path / "a.tif", 1, channel=channel)


def test_bad_files_are_one_line(tmp_path):
    tifffile.imwrite(tmp_path / "whole.tif", HEIGHTS)
    (tmp_path / "cut.tif").write_bytes((tmp_path / "whole.tif").read_bytes()[:-90])
    tifffile.imwrite(tmp_path / "colours.tif", np.zeros((5, 7, 3), "u1"), photometric="rgb")
    tifffile.imwrite(tmp_path / "false.tif", np.zeros((5, 7), "u1"), colormap=np.zeros((3, 256), "u2"))
    tifffile.imwrite(tmp_path / "white.tif", np.zeros((5, 7), "u1"), photometric="miniswhite")
    tifffile.imwrite(tmp_path / "several.tif", np.zeros((2, 5, 7)), photometric="minisblack")
    complaints = {"cut": "not readable", "missing": "not readable", "colours": "3 colours"}
    complaints |= {"false": "in false colours", "white": "low numbers are white"}
    for name, what in (complaints | {"several": "2 pages; channel 0 to 1"}).items():
        with refused(f"{name}.tif.*{what}"):
            read_heights(tmp_path / f"{name}.tif", 1)


def test_log_of_the_tiff_library_is_not_printed(tmp_path, monkeypatch, capsys):
    (tmp_path / "empty.tif").write_bytes(b"II*\x00\x00\x00\x00\x00")
    monkeypatch.setattr(logging.getLogger(), "handlers", [])  # the handlers of the tests
    with refused(r"empty\.tif: not readable \(it has no picture\)"):
        read_heights(tmp_path / "empty.tif", 1)
    assert capsys.readouterr().err == ""


def test_georeferenced_rasters_are_refused_with_the_way_to_convert_them(tmp_path):
    heights = np.random.default_rng(1).random((4, 5), dtype="f4")
    tifffile.imwrite(tmp_path / "a.tif", heights, extratags=[(33550, "d", 3, (2.0, 3.0, 0.0), True)])
    tifffile.imwrite(tmp_path / "b.tif", heights)
    (tmp_path / "b.tif.aux.xml").touch()
    (tmp_path / "c.img").write_bytes(bytes(range(256)))
    for name in ("a.tif", "b.tif", "c.img"):
        with refused(rf"{name}: .*a georeferenced raster is not read; .* 'gdal_translate -of AAIGrid FILE NEW.asc'"):
            read_heights(tmp_path / name, 1.0)
