"""Elevation models that rasterio reads: units, masks, missing values and compressions; ESRI grids in degrees."""

import shutil
import sys

import numpy as np
import pytest
import tifffile

from support.contract import refused
from viscorough.io.heights import read_heights

rasterio = pytest.importorskip("rasterio", reason="the extra 'geo' is not installed")
HEIGHTS = 300 + np.random.default_rng(0).random((6, 8)).astype("f4")
UTM, FEET, METRES_ABOVE_FEET = "EPSG:32633", "EPSG:2263+6360", "EPSG:2263+5703"
SURVEY_FOOT = 1200 / 3937  # metres
LEFT, TOP = 5e5, 5e6
GRID = rasterio.transform.from_origin(LEFT, TOP, 2, 3)
pytestmark = pytest.mark.filterwarnings("ignore::viscorough.basics.errors.AccuracyWarning")


def elevation(path, heights=HEIGHTS, *, crs=UTM, transform=GRID, unit=None, mask=None, scale=None, **options):
    """Write a file with elements of 2 by 3 in the unit of a reference system; `mask` : True at missing points."""
    bands = np.reshape(heights, (-1, *HEIGHTS.shape))
    (rows, columns), suffix = HEIGHTS.shape, path.suffix
    options = {"driver": {".bil": "EHdr", ".img": "HFA"}.get(suffix, "GTiff")} | options
    size = {"height": rows, "width": columns, "count": len(bands), "dtype": bands.dtype.name}
    with rasterio.open(path, "w", crs=crs, transform=transform, **size, **options) as file:
        file.write(bands)
        if unit:
            file.units = [unit]
        if scale:
            file.scales, file.offsets = [scale[0]], [scale[1]]
        if mask is not None:
            file.write_mask(~mask)
    return path


def rio(arguments):
    """Run the command line of rasterio."""
    from rasterio.rio.main import main_group

    main_group(arguments.split(), standalone_mode=False)


@pytest.mark.parametrize(
    ("crs", "metres", "unit", "height_metres"),
    [
        (UTM, 1, "m", 1),
        (FEET, SURVEY_FOOT, None, SURVEY_FOOT),
        (METRES_ABOVE_FEET, SURVEY_FOOT, None, 1),
        ("EPSG:2222", 0.3048, "ft", 0.3048),  # international feet
        ("EPSG:2263", SURVEY_FOOT, "US survey foot", SURVEY_FOOT),
        ("+proj=utm +zone=33 +units=fath", 1.8288, "m", 1),
        ('LOCAL_CS["site",UNIT["US survey foot",0.304800609601219]]', SURVEY_FOOT, "m", 1),
    ],
)
def test_units_of_coordinates_and_heights(tmp_path, crs, metres, unit, height_metres):
    """One case is a compound reference system with survey feet along x and y and heights in metres."""
    indenter = read_heights(elevation(tmp_path / "a.tif", crs=crs, unit=unit)).to("m")
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2 * metres, 3 * metres), rel=1e-12)
    np.testing.assert_allclose(indenter.heights, HEIGHTS.astype(float) * height_metres, rtol=1e-6)


def test_height_unit_is_required_if_the_file_states_none(tmp_path):
    path = elevation(tmp_path / "a.tif", crs="EPSG:2263")
    with refused("heights in no stated unit; unit is needed"):
        read_heights(path)
    assert read_heights(path, unit="m").spacing == pytest.approx(2 * SURVEY_FOOT, rel=1e-12)


def test_two_different_units_of_heights_are_refused(tmp_path):
    path = elevation(tmp_path / "a.tif", crs=METRES_ABOVE_FEET, unit="ft")
    with refused(r"heights are in ft, and in m by its reference system"):
        read_heights(path)


@pytest.mark.parametrize("is_internal", [True, False])
def test_masked_points_are_nan(tmp_path, is_internal):
    """A masked number may be a possible height, and the file may have a value for missing data as well."""
    mask = np.zeros(HEIGHTS.shape, bool)
    mask[2:4, 3:6] = True
    heights = HEIGHTS.copy()
    heights[0, 0] = -9999
    with rasterio.Env(GDAL_TIFF_INTERNAL_MASK=is_internal):
        path = elevation(tmp_path / "a.tif", heights, unit="m", mask=mask, nodata=-9999)
    assert (tmp_path / "a.tif.msk").exists() is not is_internal
    mask[0, 0] = True
    for channel in (None, "0"):
        indenter = read_heights(path, channel=channel)
        np.testing.assert_array_equal(indenter.heights, np.where(mask, np.nan, HEIGHTS))
        assert indenter.heights.dtype == np.float32


def test_mask_file_of_a_microscope_picture_is_used(tmp_path):
    mask = HEIGHTS > 300.8
    with rasterio.Env(GDAL_TIFF_INTERNAL_MASK=False):
        elevation(tmp_path / "masked.tif", unit="m", mask=mask)
    tifffile.imwrite(tmp_path / "a.tif", HEIGHTS)
    shutil.copy(tmp_path / "masked.tif.msk", tmp_path / "a.tif.msk")
    indenter = read_heights(tmp_path / "a.tif", 1, unit="um")
    np.testing.assert_array_equal(indenter.heights, np.where(mask, np.nan, HEIGHTS))


def test_mask_inside_a_microscope_picture_is_used(tmp_path):
    mask = HEIGHTS > 300.8
    elevation(tmp_path / "a.tif", mask=mask, crs=None, transform=None)
    indenter = read_heights(tmp_path / "a.tif", 1, unit="um")
    np.testing.assert_array_equal(indenter.heights, np.where(mask, np.nan, HEIGHTS))


def test_metadata_file_of_gdal_for_a_picture_is_used(tmp_path):
    heights = HEIGHTS.copy()
    heights[2, 3] = -1
    tifffile.imwrite(tmp_path / "a.tif", heights)
    band = "<NoDataValue>-1</NoDataValue><UnitType>um</UnitType>"
    text = f'<PAMDataset><PAMRasterBand band="1">{band}</PAMRasterBand></PAMDataset>'
    (tmp_path / "a.tif.aux.xml").write_text(text)
    indenter = read_heights(tmp_path / "a.tif", 1)
    np.testing.assert_array_equal(indenter.heights, np.where(heights == -1, np.nan, heights))
    assert indenter.length_unit == "um"


def test_values_for_missing_data_are_nan(tmp_path):
    whole = np.round(100 * HEIGHTS).astype("i2")
    whole[1, 2] = -32768
    indenter = read_heights(elevation(tmp_path / "a.tif", whole, unit="m", nodata=-32768))
    np.testing.assert_array_equal(indenter.heights, np.where(whole == -32768, np.nan, whole))
    lowest = np.where(HEIGHTS < 300.1, np.finfo("f4").min, HEIGHTS)
    path = elevation(tmp_path / "b.tif", lowest, unit="m", nodata=float(np.finfo("f4").min))
    np.testing.assert_array_equal(read_heights(path).heights, np.where(HEIGHTS < 300.1, np.nan, HEIGHTS))


def test_scale_and_offset_are_applied_to_measured_points(tmp_path):
    counts = np.arange(48, dtype="i2").reshape(HEIGHTS.shape)
    indenter = read_heights(elevation(tmp_path / "a.tif", counts, unit="m", scale=(0.5, 100), nodata=3))
    np.testing.assert_array_equal(indenter.heights, np.where(counts == 3, np.nan, 100 + 0.5 * counts))


@pytest.mark.parametrize(
    "options",
    [{"compress": "lzw"}, {"compress": "zstd"}, {"compress": "deflate", "predictor": 3}, {"compress": "lerc"}],
)
def test_compressed_files_are_read(tmp_path, options):
    indenter = read_heights(elevation(tmp_path / "a.tif", unit="m", **options))
    np.testing.assert_array_equal(indenter.heights, HEIGHTS)
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (2, 3, "m")


@pytest.mark.parametrize("suffix", [".bil", ".img"])
def test_other_formats_of_gdal_are_read(tmp_path, suffix):
    indenter = read_heights(elevation(tmp_path / f"a{suffix}"), unit="m")
    np.testing.assert_array_equal(indenter.heights, HEIGHTS)
    assert (indenter.spacing, indenter.row_spacing) == (2, 3)


@pytest.mark.parametrize("crs", ["EPSG:4326", "EPSG:4979", "EPSG:4326+5773"])
def test_degrees_are_refused_whatever_the_unit(tmp_path, crs):
    path = elevation(tmp_path / "a.tif", crs=crs, transform=rasterio.transform.from_origin(9, 50, 1e-3, 1e-3))
    with refused("coordinates are in degrees; a map in projected coordinates is needed, as 'rio warp"):
        read_heights(path, unit="m")


def test_tiles_of_the_shuttle_mission_are_in_degrees(tmp_path):
    (tmp_path / "N46E013.hgt").write_bytes(bytes(2 * 1201**2))
    with refused("degrees; a map in projected"):
        read_heights(tmp_path / "N46E013.hgt", 30, unit="m")


def test_advice_for_maps_in_degrees_works(tmp_path):
    path = elevation(tmp_path / "a.tif", crs="EPSG:4326", transform=rasterio.transform.from_origin(15, 46, 1e-3, 1e-3))
    rio(f"warp {path} {tmp_path / 'b.tif'} --dst-crs {UTM}")
    assert read_heights(tmp_path / "b.tif", unit="m").spacing == pytest.approx(95, rel=0.2)  # 0.001 degrees


# ---- reference systems that are incomplete or missing


def minimal(path, *keys):
    """Write a GeoTIFF with only these (key, value) pairs, and elements of 30 by 20."""
    directory = [1, 1, 0, len(keys), *(number for key, value in keys for number in (key, 0, 1, value))]
    place = [(33550, "d", 3, (30.0, 20.0, 0.0), True), (33922, "d", 6, (0.0, 0.0, 0.0, LEFT, TOP, 0.0), True)]
    tifffile.imwrite(path, HEIGHTS, extratags=[*place, (34735, "H", len(directory), directory, True)])
    return path


@pytest.mark.parametrize(
    "keys", [[(1024, 1), (3076, 9003)], [(1024, 1)], [(2048, 4326)], [(2054, 9102)], [(1024, 32767), (2048, 4326)]]
)
def test_incomplete_reference_systems_are_refused(tmp_path, keys):
    """GDAL would read the first of them, in survey feet without a projection, as metres."""
    path = minimal(tmp_path / "a.tif", *keys)
    with refused("incomplete, so that the unit of x and y is not certain; .* 'rio edit-info --crs EPSG:CODE FILE'"):
        read_heights(path, unit="m")
    rio(f"edit-info --crs {UTM} {path}")
    assert read_heights(path, unit="m").spacing == 30


def test_a_map_without_reference_system_is_in_the_unit_that_is_given(tmp_path):
    path = elevation(tmp_path / "a.tif", crs=None)
    indenter = read_heights(path)
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (2, 3, "1")
    assert read_heights(path, unit="m").length_unit == "m"


@pytest.mark.parametrize("suffix", [".tif", ".bil"])
def test_coordinates_that_may_be_degrees_are_refused(tmp_path, suffix):
    for left, top, step in ((-105.56, 40.09, 3 / 3600), (-180.5, 90.5, 1)):  # points at -180 and 90
        near = rasterio.transform.from_origin(left, top, step, step)
        path = elevation(tmp_path / f"a{suffix}", crs=None, transform=near)
        with refused("may be degrees; lengths are needed, with unit"):
            read_heights(path)
        assert read_heights(path, unit="mm").spacing == pytest.approx(step)


ESRI = "ncols 4\nnrows 3\nxll{0} {1}\nyll{0} {2}\ncellsize {3}\nNODATA_value -9999\n1 2 3 4\n5 6 7 9\n2 8 1 3\n"


@pytest.mark.parametrize(
    ("place", "is_refused"),
    [
        (("corner", -105.56, 40.09, 0.000833333333), True),
        (("center", -180, -90, 90), True),  # whole Earth, points at the poles
        (("corner", 0, -45, 30), True),  # longitudes may count to 360
        (("corner", 178, 0, 1), True),
        (("corner", -180.5, -90.5, 1), True),  # points at -180 and -90
        (("corner", 356.5, 87.5, 1), True),  # points at 360 and 90
        (("corner", 358, 0, 1), False),
        (("corner", 0, 88, 1), False),
        (("corner", 500000, 40, 1), False),
    ],
)
def test_esri_grids_that_may_be_in_degrees_need_a_unit(tmp_path, place, is_refused):
    path = tmp_path / "a.asc"
    path.write_text(ESRI.format(*place))
    if is_refused:
        with refused(r"a\.asc: x from .* may be degrees"):
            read_heights(path)
    else:
        assert read_heights(path).spacing == place[-1]
    assert read_heights(path, unit="m").spacing == place[-1]


def test_prj_file_states_the_units_of_an_esri_grid(tmp_path):
    path = tmp_path / "a.asc"
    path.write_text(ESRI.format("corner", 10, 20, 2))
    (tmp_path / "a.prj").write_text(rasterio.crs.CRS.from_user_input(METRES_ABOVE_FEET).to_wkt(version="WKT1_ESRI"))
    indenter = read_heights(path, unit="m")
    assert (indenter.spacing, indenter.heights[0, 3]) == (pytest.approx(2 * SURVEY_FOOT, rel=1e-12), 4)
    (tmp_path / "a.prj").write_text(rasterio.crs.CRS.from_user_input("EPSG:4326").to_wkt(version="WKT1_ESRI"))
    with refused("coordinates are in degrees"):
        read_heights(path, unit="m")


# ---- geometry, bands, faults


def test_a_rotated_grid_keeps_its_spacings(tmp_path):
    cosine, sine = 0.8, 0.6
    turned = rasterio.Affine(2 * cosine, 3 * sine, LEFT, 2 * sine, -3 * cosine, TOP)
    indenter = read_heights(elevation(tmp_path / "a.tif", transform=turned, unit="m"))
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx((2, 3), rel=1e-12)
    sheared = rasterio.Affine(2, 0.1, LEFT, 0, -3, TOP)
    with refused("rows and columns are not perpendicular"):
        read_heights(elevation(tmp_path / "b.tif", transform=sheared, unit="m"))


def test_bands_and_pages_are_chosen_by_number(tmp_path):
    bands = elevation(tmp_path / "bands.tif", np.stack([HEIGHTS, 2 * HEIGHTS]), photometric="minisblack")
    one = {"extratags": [(33550, "d", 3, (2.0, 3.0, 0.0), True), (33922, "d", 6, (0, 0, 0, LEFT, TOP, 0), True)]}
    pages = tmp_path / "pages.tif"
    with tifffile.TiffWriter(pages) as file:
        for factor in (1, 2):
            file.write(factor * HEIGHTS, **one)
    for path, what in ((bands, "bands"), (pages, "pages")):
        indenter = read_heights(path, channel="1", unit="m")
        np.testing.assert_array_equal(indenter.heights, 2 * HEIGHTS)
        assert (indenter.spacing, indenter.row_spacing) == (2, 3)
        for channel in (None, "2", "z"):
            with refused(f"it has 2 {what}; channel 0 to 1 chooses one"):
                read_heights(path, channel=channel, unit="m")


def test_bad_files_are_one_line(tmp_path, capfd):
    whole = elevation(tmp_path / "whole.tif", unit="m", compress="deflate").read_bytes()
    (tmp_path / "cut.tif").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "noise.img").write_bytes(bytes(range(256)) * 4)
    elevation(tmp_path / "colours.tif", np.zeros((3, 6, 8), "u1"), photometric="rgb")
    complaints = {"cut.tif": "not readable", "noise.img": "not readable", "missing.dem": "not readable"}
    for name, what in (complaints | {"colours.tif": "3 bands"}).items():
        with refused(f"{name}: .*{what}"):
            read_heights(tmp_path / name, unit="m")
    with refused(r"a picture in colours \(band 1 is green\)"):
        read_heights(tmp_path / "colours.tif", unit="m", channel="1")
    assert capfd.readouterr().err == ""


def test_message_without_the_extra_names_the_remedy(tmp_path, monkeypatch):
    paths = [elevation(tmp_path / "a.tif"), elevation(tmp_path / "a.bil"), tmp_path / "a.asc"]
    paths[-1].write_text(ESRI.format("corner", LEFT, TOP, 2))  # next to a.prj
    monkeypatch.setitem(sys.modules, "rasterio", None)  # as if it were not installed
    for path in paths:
        with refused(rf'{path.name}: .*pip install "viscorough\[geo\]"'):
            read_heights(path, unit="m")
