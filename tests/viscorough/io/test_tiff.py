"""Maps of heights in TIFF files, with the tags that GeoTIFF, GDAL and ImageJ define."""

import logging

import numpy as np
import pytest
import tifffile

from support.contract import refused
from viscorough.io.heights import read_heights

HEIGHTS = np.random.default_rng(0).random((5, 7)).astype("f4")
METADATA, NODATA, KEYS = 42112, 42113, 34735
PROJECTED, GEOGRAPHIC, METRES, VERTICAL_METRES = (1024, 1), (1024, 2), (3076, 9001), (4099, 9001)
# The tags of pixels of 30 by 20, and of the place of the first of them.
SPACINGS = [(33550, "d", 3, (30.0, 20.0, 0.0), True), (33922, "d", 6, (0.0,) * 6, True)]


def geotiff(path, *keys, heights=HEIGHTS, tags=SPACINGS, nodata=None, **options):
    """A GeoTIFF with these (key, value) pairs in its directory of keys."""
    directory = [1, 1, 0, len(keys), *(number for key, value in keys for number in (key, 0, 1, value))]
    tags = [*tags, (KEYS, "H", len(directory), directory, True)]
    tags += [] if nodata is None else [(NODATA, "s", 0, nodata, True)]
    tifffile.imwrite(path, heights, extratags=tags, **options)
    return path


def test_missing_values_of_gdal_are_nan(tmp_path):
    heights = np.round(100 * HEIGHTS).astype("i2")
    heights[1, 2] = -32768
    keys = (PROJECTED, METRES, VERTICAL_METRES)
    indenter = read_heights(geotiff(tmp_path / "a.tif", *keys, heights=heights, nodata="-32768", compression="zlib"))
    np.testing.assert_array_equal(indenter.heights, np.where(heights == -32768, np.nan, heights))
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (30, 20, "m")
    lowest = np.where(HEIGHTS < 0.1, np.finfo("f4").min, HEIGHTS)
    path = geotiff(tmp_path / "b.tif", heights=lowest, nodata="-3.4028234663852886e+38")
    assert read_heights(path, unit="m").elements == np.count_nonzero(HEIGHTS >= 0.1)


@pytest.mark.parametrize(("code", "metres"), [(9002, 0.3048), (9003, 1200 / 3937)])
def test_feet_and_survey_feet(tmp_path, code, metres):
    path = geotiff(tmp_path / "a.tif", PROJECTED, (3076, code))
    assert read_heights(path, unit="m").spacing == pytest.approx(30 * metres, rel=1e-12)
    with refused("heights in no stated unit; --unit is needed"):
        read_heights(path)


def test_a_unit_of_heights_that_gdal_states(tmp_path):
    metadata = (METADATA, "s", 0, '<GDALMetadata><Item name="UNITTYPE" role="unittype">ft</Item></GDALMetadata>', True)
    path = geotiff(tmp_path / "a.tif", PROJECTED, METRES, tags=[*SPACINGS, metadata])
    np.testing.assert_allclose(read_heights(path).to("m").heights, 0.3048 * HEIGHTS, rtol=1e-6)
    with refused("its heights are in m and in ft"):
        read_heights(geotiff(tmp_path / "b.tif", PROJECTED, METRES, VERTICAL_METRES, tags=[*SPACINGS, metadata]))


def test_numbers_that_gdal_or_imagej_would_scale_are_refused(tmp_path):
    metadata = (METADATA, "s", 0, '<GDALMetadata><Item name="a" role="scale">0.5</Item></GDALMetadata>', True)
    geotiff(tmp_path / "a.tif", PROJECTED, tags=[*SPACINGS, metadata])
    imagej(tmp_path / "b.tif", unit="um", cf=0, c0=5.0, c1=2.0, vunit="nm")
    for name in ("a.tif", "b.tif"):
        with refused("after a scale and an offset are applied"):
            read_heights(tmp_path / name, unit="m")


@pytest.mark.parametrize("keys", [[(2048, 4326)], [(2054, 9102)], [(1024, 32767), (2048, 4326)], [GEOGRAPHIC]])
def test_degrees_are_refused(tmp_path, keys):
    with refused("degrees; a map in projected"):
        read_heights(geotiff(tmp_path / "a.tif", *keys), unit="m")


def imagej(path, **metadata):
    tifffile.imwrite(path, HEIGHTS, imagej=True, resolution=(2.0, 4.0), metadata=metadata)
    return path


def test_units_of_imagej(tmp_path):
    indenter = read_heights(imagej(tmp_path / "a.tif", unit="um"), unit="um")
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((0.5, 0.25), rel=1e-12)
    tifffile.imwrite(tmp_path / "plain.tif", HEIGHTS, resolution=(72, 72), resolutionunit="INCH")
    for path in (
        imagej(tmp_path / "b.tif", unit="px"),
        imagej(tmp_path / "c.tif", unit="um", yunit="mm"),
        tmp_path / "plain.tif",
    ):
        with refused("--spacing is needed"):
            read_heights(path, unit="um")


def test_pages_are_chosen_by_number(tmp_path):
    tifffile.imwrite(tmp_path / "a.tif", np.stack([HEIGHTS, 2 * HEIGHTS]), photometric="minisblack")
    np.testing.assert_array_equal(read_heights(tmp_path / "a.tif", 1, channel="1").heights, 2 * HEIGHTS)
    for channel in ("2", "z"):
        with refused("it has 2 pages; --channel 0 to 1"):
            read_heights(tmp_path / "a.tif", 1, channel=channel)


def test_bad_files_are_one_line(tmp_path):
    whole = geotiff(tmp_path / "fathoms.tif", PROJECTED, (3076, 9014), VERTICAL_METRES).read_bytes()
    (tmp_path / "cut.tif").write_bytes(whole[:-90])
    tifffile.imwrite(tmp_path / "colours.tif", np.zeros((5, 7, 3), "u1"), photometric="rgb")
    tifffile.imwrite(tmp_path / "false.tif", np.zeros((5, 7), "u1"), colormap=np.zeros((3, 256), "u2"))
    tifffile.imwrite(tmp_path / "white.tif", np.zeros((5, 7), "u1"), photometric="miniswhite")
    tifffile.imwrite(tmp_path / "several.tif", np.zeros((2, 5, 7)), photometric="minisblack")
    complaints = {"fathoms": "EPSG:9014", "cut": "not readable", "missing": "not readable", "colours": "3 colours"}
    complaints |= {"false": "in false colours", "white": "low numbers are white"}
    for name, what in (complaints | {"several": "2 pages; --channel 0 to 1"}).items():
        with refused(f"{name}.tif.*{what}"):
            read_heights(tmp_path / f"{name}.tif", 1)


def test_what_the_library_logs_is_not_printed_beside_the_error(tmp_path, monkeypatch, capsys):
    (tmp_path / "empty.tif").write_bytes(b"II*\x00\x00\x00\x00\x00")
    monkeypatch.setattr(logging.getLogger(), "handlers", [])  # those of the tests
    with refused(r"empty\.tif: not readable \(it has no picture\)"):
        read_heights(tmp_path / "empty.tif", 1)
    assert capsys.readouterr().err == ""
