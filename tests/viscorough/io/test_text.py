"""Maps of heights in text files: stated spacings and units are read, missing ones are not guessed.

benchmarks/file_campaign.py tries ordinary variations of such files; these tests cover the others.
"""

import numpy as np
import pytest

from support.contract import refused
from viscorough.basics.errors import AccuracyWarning
from viscorough.io.heights import read_heights
from viscorough.io.scan import to_indenter
from viscorough.io.text import read_text

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore:.*rms slope")

NAN = np.nan
MATRIX = [[1, 2, 3], [4, 5, 6]]
TABLES = [
    ("\t1\t2\t3\n\t4\t5\t6\n", MATRIX),
    ("# first\n1 2 3 # one\n\n% in between\n4 5 6\n", MATRIX),
    ('"1,0","2,0","3,0"\n"4,0","5,0","6,0"\n', MATRIX),
    ("1,0 2 3,0\n4 5,0 6\n", MATRIX),
    ("1D0 2d0 0.3D1\n4 5 6\n", MATRIX),
    ("1 2 3\r\r\n4 5 6\r\r\n", MATRIX),
    (";1;2;3\n;4;5;6\n", MATRIX),
    ("1, 2, 3\n4, 5, 6\n", MATRIX),
    (";2;3\n4;5;6\n;8;\n", [[NAN, 2, 3], [4, 5, 6], [NAN, 8, NAN]]),
    ("1;2;3\n4;5;\n7;8;9\n", [[1, 2, 3], [4, 5, NAN], [7, 8, 9]]),
    ("4;5;6\n;;\n7;8;9\n", [[4, 5, 6], [NAN, NAN, NAN], [7, 8, 9]]),
    ("\t2,5\t\n4,5\t5,5\t6,5\n", [[NAN, 2.5, NAN], [4.5, 5.5, 6.5]]),
    ("#N/A 2 3\n4 #N/A 6\n", [[NAN, 2, 3], [4, NAN, 6]]),
    ("\u22121 2 3\n4 5 \u22126\n", [[-1, 2, 3], [4, 5, -6]]),
    ("-- NA\n1 2\n3 4\n", [[NAN, NAN], [1, 2], [3, 4]]),
    ("1\t2\n\t # no points\n5\t6\n", [[1, 2], [NAN, NAN], [5, 6]]),
]


@pytest.mark.parametrize(("text", "heights"), TABLES)
def test_tables_with_any_punctuation_and_gaps_are_read(tmp_path, text, heights):
    (tmp_path / "a.txt").write_text(text, encoding="utf-8", newline="")
    scan = read_text(tmp_path / "a.txt", is_map=True)
    np.testing.assert_array_equal(scan.heights, heights)
    assert (scan.unit, scan.spacing) == ("1", None)


@pytest.mark.parametrize(
    ("header", "unit", "spacing"),
    [
        ("Y pixel size: 0.8 um\nX pixel size: 0.5 um\nunit: um\n", "um", (0.5, 0.8)),
        ("pixel size: 1,5 \u00b5m\nunit: \u03bcm\n", "um", (1.5, 1.5)),
        ("# Breite: 12,34 \u00b5m\n# Höhe: 5,12 \u00b5m\n# Werteinheiten: nm\n", "nm", (6170, 2560)),
        ("XY units: mm\nZ units: um\ndx = 0.5\ndy = 0.5\n", "um", (500, 500)),
        ("# Lateral units: m\n# Height units: nm\n# dx=1e-6\n# dy=2e-6\n", "nm", (1000, 2000)),
        ("Camera pixel size: 6.5 um\nPixel size: 0.5 um\nunit: um\n", "um", (0.5, 0.5)),
        ("Width: 2 px\nHeight: 2 px\npixel size: 0.5 um\nunit: um\n", "um", (0.5, 0.5)),
        ("Width: 1 um\nHeight: 1 um\npixel size: 0.5 um\nZ unit: nm\n", "nm", (500, 500)),
    ],
)
def test_spacings_and_units_of_headers_are_read(tmp_path, header, unit, spacing):
    (tmp_path / "a.txt").write_text(f"{header}1 2\n3 4\n", encoding="utf-8")
    indenter = to_indenter(read_text(tmp_path / "a.txt", is_map=True))
    np.testing.assert_array_equal(indenter.heights, [[1, 2], [3, 4]])
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx(spacing, rel=1e-12)
    assert indenter.length_unit == unit


STATED = [
    *[
        '"Unit","um"',
        "Unit,um,,",
        "Z unit;um",
        "Unit\tum",
        "Unit um",
        "Units [um]",
        "unit (um)",
        "\\Exported image units: um",
    ],
    *[
        "Height [um]",
        "# Heights (µm)",
        "Z in um",
        "Z,um",
        "Topography / um",
        "All heights in microns",
        "Höhe in µm",
        "Height_um",
    ],
    *['{"unit": "um"}', '# {"z_unit": "um", "scanner": 5}', '{\n"heights": {"unit": "um"}\n}', "{'unit': 'um'}"],
]


@pytest.mark.parametrize("suffix", [".txt", ".prn", ".grd", ".sdf", ""])
@pytest.mark.parametrize("header", STATED)
def test_units_in_usual_forms_are_read(tmp_path, header, suffix):
    path = tmp_path / f"a{suffix}"
    path.write_text(f"{header}\n1 2 3\n3 4 9\n2 5 7\n", encoding="utf-8")
    assert read_heights(path, 20).length_unit == "um"
    with refused("unit nm contradicts the file, in which heights are in um"):
        read_heights(path, 20, unit="nm")


SPACINGS = [
    "Pixel size,0.5,um",
    '"X pixel size";"0,5 um"\n"Y pixel size";"0,5 um"',
    "dx 0.5 um\ndy 0.5 um",
    "spacing\t500 nm",
]
SPACINGS += ['{"pixel size": "0.5 um"}', '{"spacing": [0.5, 0.5], "xy_unit": "um"}']


@pytest.mark.parametrize("header", SPACINGS)
def test_spacings_in_usual_forms_are_read(tmp_path, header):
    (tmp_path / "a.dat").write_text(f"{header}\nUnit: um\n1;2;3\n3;4;9\n2;5;7\n")
    assert read_heights(tmp_path / "a.dat").spacing == 0.5


@pytest.mark.parametrize(
    "line",
    [
        "exported as nm by hand",
        "[nm]",
        "Export as: nm",
        "<unit>nm</unit>",
        '{"out": {"scale": "nm"}}',
        "unit -> nm",
        "1 unit = 1 nm",
    ],
)
def test_unit_that_is_not_understood_is_named(tmp_path, line):
    (tmp_path / "a.txt").write_text(f"{line}\n1 2 3 1\n3 4 9 6\n2 5 7 3\n")
    with refused(r"the line '.*' holds the unit nm, but does not state .*; unit='nm' states it"):
        read_heights(tmp_path / "a.txt", 20)
    with refused("unit um: the line '.*' holds the unit nm"):
        read_heights(tmp_path / "a.txt", 20, unit="um")
    assert read_heights(tmp_path / "a.txt", 20, unit="nm").length_unit == "nm"


@pytest.mark.parametrize(
    "line", ["Tip radius: 10 nm", "Gemessen um 10 Uhr", "Wavelength (nm): 633", "at 05:10 pm", "633nm laser"]
)
def test_units_of_other_quantities_state_no_unit_of_heights(tmp_path, line):
    (tmp_path / "a.txt").write_text(f"{line}\n1 2 3\n3 4 9\n2 5 7\n")
    assert read_heights(tmp_path / "a.txt", 20, unit="um").length_unit == "um"


@pytest.mark.parametrize("header", ["No data: 0", "NODATA_value,0", "# bad value = 0", "Missing value 0"])
def test_stated_marks_of_missing_points_are_read(tmp_path, header):
    (tmp_path / "a.map").write_text(f"{header}\n1 2 3\n0 4 9\n2 5 7\n")
    assert np.isnan(read_heights(tmp_path / "a.map", 20).heights).nonzero() == ([1], [0])


@pytest.mark.parametrize("separator", [" ", "\t", ": ", " = ", ","])
@pytest.mark.parametrize("suffix", [".asc", ".grd", ""])
def test_esri_grids_with_any_suffix_are_read(tmp_path, suffix, separator):
    keys = {"ncols": 3, "nrows": 3, "xllcorner": 1000, "yllcorner": 2000, "cellsize": 0.5, "NODATA_value": 0}
    header = "\n".join(f"{key}{separator}{value}" for key, value in keys.items())
    (tmp_path / f"a{suffix}").write_text(f"{header}\n1 2 3\n0 4 9\n2 5 7\n")
    indenter = read_heights(tmp_path / f"a{suffix}")
    np.testing.assert_array_equal(indenter.heights, [[1, 2, 3], [NAN, 4, 9], [2, 5, 7]])
    assert indenter.spacing == 0.5
    np.testing.assert_allclose(indenter.row_positions, [2001.25, 2000.75, 2000.25])


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_utf_16_without_a_byte_order_mark_is_read(tmp_path, encoding):
    (tmp_path / "a.txt").write_text("1\t2\t3\n4\t5\t6\n", encoding=encoding)
    np.testing.assert_array_equal(read_text(tmp_path / "a.txt", is_map=True).heights, MATRIX)


def test_points_in_any_order_with_gaps_are_read(tmp_path):
    """Positions are rounded to a hundredth of the spacing; one column and one further point are missing."""
    random = np.random.default_rng(3)
    heights = random.standard_normal((6, 8))
    x, y = np.meshgrid(np.round(0.0996 * np.arange(8), 3), 5 - 0.25 * np.arange(6))
    heights[:, 3] = heights[2, 5] = np.nan
    points = np.stack([x, y, heights], axis=-1).reshape(-1, 3)
    np.savetxt(tmp_path / "a.xyz", random.permutation(points[np.isfinite(points[:, 2])]))
    with pytest.warns(AccuracyWarning, match="enclosed region"):
        indenter = read_heights(tmp_path / "a.xyz")
    np.testing.assert_array_equal(indenter.heights, heights[::-1])
    assert (indenter.spacing, indenter.row_spacing) == (pytest.approx(0.0996, rel=1e-3), pytest.approx(0.25))


Y, X = np.indices((12, 12)) - 5.0
MAPS = {
    "tilted plane": X + 2 * Y,
    "diagonal groove": -abs(X - Y),
    "edge of a step": np.where(X < -4, Y + 0.01 * Y**2, np.cos(7 * X + 5 * Y)).round(3),
    "rough and tilted": (3 * Y + np.random.default_rng(1).normal(size=(12, 12))).round(3),
}


@pytest.mark.parametrize("name", MAPS)
def test_maps_whose_edges_rise_are_read(tmp_path, name):
    np.savetxt(tmp_path / "a.txt", MAPS[name])
    np.testing.assert_array_equal(read_text(tmp_path / "a.txt").heights, MAPS[name])


POINTS = "0 0 1\n0.5 0 2\n0 0.25 3\n0.5 .25 4\n"


@pytest.mark.parametrize(
    "text",
    [
        *[f"{names}\n{POINTS}" for names in ("# X [µm], Y [µm], Z [nm]", "x_um y_um z_nm", "x/um;y/um;z/nm")],
        f"# Lateral units: um\n# Value units: nm\n{POINTS}",
        f"# X pixel size: 0.5 um\n# Y pixel size: 0.25 um\n# XY units: um\n# Z units: nm\n{POINTS}",
        "y [um];x [um];z [nm];n\n0;0;1;9\n0;0,5;2;9\n0,25;0;3;9\n0,25;0,5;4;9\n",
    ],
)
def test_points_with_units_in_headings_or_headers_are_read(tmp_path, text):
    (tmp_path / "a.xyz").write_text(text, encoding="utf-8")
    indenter = read_heights(tmp_path / "a.xyz")
    np.testing.assert_array_equal(indenter.heights, [[1, 2], [3, 4]])
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (500, 250, "nm")


def test_given_lateral_unit_applies_to_points(tmp_path):
    (tmp_path / "a.xyz").write_text(POINTS)
    indenter = read_heights(tmp_path / "a.xyz", unit="um", lateral_unit="mm")
    np.testing.assert_array_equal(indenter.heights, [[1, 2], [3, 4]])
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (500, 250, "um")
    (tmp_path / "b.xyz").write_text(f"# Value units: um\n{POINTS}")
    assert read_heights(tmp_path / "b.xyz", lateral_unit="mm").spacing == 500
    (tmp_path / "c.xyz").write_text(f"x [um] y [um] z [nm]\n{POINTS}")
    with refused("lateral_unit mm contradicts the file, in which positions x and y are in um"):
        read_heights(tmp_path / "c.xyz", lateral_unit="mm")
    with refused("heights are in no stated unit; unit is needed"):
        read_heights(tmp_path / "a.xyz", lateral_unit="mm")


@pytest.mark.parametrize("spacing", [0.5, (0.5, 0.5), "0.5", "500 um", (0.5, "500 um")])
def test_plain_spacing_is_in_the_given_lateral_unit(tmp_path, spacing):
    np.savetxt(tmp_path / "a.txt", np.eye(3))
    indenter = read_heights(tmp_path / "a.txt", spacing, unit="um", lateral_unit="mm")
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (500, 500, "um")


ZYGO = """Zygo XYZ Data File - Format 1
0 3 0 0 "Tue"
0 0 0 0 0 0
2 1 3 2


0 0
0 0.5 6.328e-07 0.4 1 0 2e-06 0
0
0
0
0
0
#
2 1 1
3 1 No Data
4 1 3
2 2 4
4 2 6
#
"""


def test_files_of_zygo_state_points_and_their_distance(tmp_path):
    (tmp_path / "a.xyz").write_text(ZYGO)
    indenter = read_heights(tmp_path / "a.xyz", unit="um")
    np.testing.assert_array_equal(indenter.heights, [[1, np.nan, 3], [4, np.nan, 6]])
    assert indenter.spacing == indenter.row_spacing == pytest.approx(2)


@pytest.mark.parametrize("row", ["2 1 7", "9 1 7", "4 x 6"])
def test_bad_files_of_zygo_are_one_line(tmp_path, row):
    (tmp_path / "b.xyz").write_text(f"{ZYGO}{row}\n")
    with refused("line 21"):
        read_heights(tmp_path / "b.xyz", unit="um")


SQUARE = "1 2\n3 4\n"
CORNERS = "0 0 1\n1 0 2\n0 1 3\n1 1 4\n"
BAD = [
    ("1 2_\n3 4\n", "line 1 .* is not a row of numbers"),
    ("# pixel size = 1\n1e999 2 3\n4 5 6\n7 8 9\n", "finite"),
    ("ncols 9.99999999999\nnrows 8\n1 2\n", "line 1 .*a whole number above 0 is needed for ncols"),
    (f"Z factor,0.001\n{SQUARE}", "times a factor"),
    (f"multiply by 0.5 for heights\n{SQUARE}", "times a factor"),
    ("DSAA\n3 3\n0 2\n0 2\n1 9\n1 2 3\n4 5 6\n7 8 9\n", "the format Surfer grid are not read"),
    ("ncols 1e400\nnrows 2\n1 2\n", "a whole number above 0 is needed for ncols"),
    (f"ncols 3\nnrows 2\ncellsize 1\n{SQUARE}5 6\n", "3 lines of 2 numbers contradict"),
    ("1 2\n3\n", "line 2: 1 cells, 2 in line 1"),
    ("1;2;3\n4;<0.1;6\n", "line 2: '<0.1' is not a number"),
    ("1,5, 2,5\n3,5, 4,5\n", "line 1 .*commas may be decimal marks or not"),
    ("0,5\n1,5\n", "commas may be decimal marks or not"),
    ('"1,234 5.5"\n"1,5 2.5"\n', "line 1 .*one decimal mark is needed"),
    ('"1";"2"\n"3.234,5";"4"\n', "line 2 .*one decimal mark is needed"),
    ("1,234.5;2\n3;4\n", "line 1 .*commas may be decimal marks or not"),
    ("1\u202f234 5\n6 7\n", "line 1 holds"),
    ("1 2 3\n\n3 4 5\n\n\n5 6 9\n\n7 8 1\n", "line 6: empty lines separate it"),
    ("\u00b1 -.5 \u00b1\n1 2 3\n4 5 6\n", "line 1 .* is not a row of numbers"),
    (";\n4;5\n6;7\n", "line 1: a row of empty cells"),
    (".\t.\t.\t\n1\t2\t3\t\n4\t5\t6\t\n", "line 1 .* is not a row of numbers"),
    ("# Channel: A\n1 2\n# Channel: B\n3 4\n", "line 3 .* stands between rows"),
    ("1 7 2\n2 3 9\n3 1 4\n4 8 8\n5 2 7\n6 9 1\n", "the first column counts up evenly"),
    (".33 7 2\n.67 3 9\n1.00 1 4\n1.33 8 8\n1.67 2 7\n2.00 9 1\n", "the first column counts up evenly"),
    ("7 2 0\n3 9 1\n1 4 2\n8 8 3\n2 7 4\n9 1 5\n", "the last column counts up evenly"),
    (".5 7 0\n1 3 1\n1.5 1 2\n2 8 3\n2.5 2 4\n3 9 5\n", "the first column counts up evenly"),
    ("".join(f"{i**1.5} {i % 3} {i % 4}\n" for i in range(10)), "the first column counts up throughout"),
    ("".join(f"{i} {i % 2} {i % 5}\n" for i in range(18)), "the first column counts up evenly"),
    (f"lon lat z\n{CORNERS}", "degrees"),
    (f"z over x and y\n{CORNERS}", r"one heading, such as 'x \[um\], y \[um\], z \[nm\]', is allowed"),
    (f"x [um] y [um] z [V]\n{CORNERS}", "'V' is no unit of length"),
    (f"# x [um] y [nm] z [um]\n{CORNERS}", "units um and nm"),
    (f"# foo units: um\n# pixel size: 1 um\n{SQUARE}", "foo units: um.*not stated"),
    *[
        (f"{heading}\n{CORNERS}", "not stated")
        for heading in ("x y z\num um nm", "x in um, y in um, z in nm", "z [nm]")
    ],
    *[
        (f"# {factor}\n{SQUARE}", "times a factor")
        for factor in (
            "Height conversion factor (-> m): 1e-9",
            "Z factor: about 2",
            "Z-Scale: 0.001 um",
            "Multiplier = 10",
        )
    ],
    ('# source: "viscorough 1.0.0"\ntime,depth\n0,1\n1,2\n', "holds no map of heights"),
    ("9 0 1 2 3 4 5\n" + "".join(f"{i} 3 1 4 1 5 {i * i % 7}\n" for i in range(6)), "counts up evenly"),
    ("x,y,height\n0,0,1\n1.1,0.3,2\n2.7,1.9,3\n", "form no grid"),
    (f"# dx=1 m, dy=1 m\n{SQUARE}", "not a length"),
    (f"# pixel size: 1,234 nm\n# unit: nm\n{SQUARE}", "1,234 is 1234 or 1.234"),
    ("# dx: 1 nm\n# unit: nm\n1 2 3\n4 5 6\n7 8 9\n", "between rows is not stated"),
    (f"# Width: 3 px\n# Height: 2 px\n{SQUARE}", "the table has 2 points there"),
    (f"# Width: 9 um\n# Height: 2 um\n# dx=1 um\n# unit: um\n{SQUARE}", "extend over 9e-06"),
]
OFF_A_GRID = [
    ("0 0 1\n1 0 2\n3 1 3\n1.3 1.2 3\n", "steps lie between"),
    (f"{CORNERS}1 1 5\n", "stand twice"),
    ("0 0\n1 0\n", "2 columns"),
    ("0 nan 1\n1 0 2\n", "finite"),
    ("".join(f"{i} {i} 1\n" for i in range(99)), "99 points on a grid of 99 by 99"),
]


@pytest.mark.parametrize(
    ("name", "text", "what"),
    [*[("bad.txt", *case) for case in BAD], *[("bad.xyz", *case) for case in OFF_A_GRID]],
)
def test_bad_texts_are_one_line(tmp_path, name, text, what):
    (tmp_path / name).write_text(text, encoding="utf-8")
    with refused(what) as error:
        read_heights(tmp_path / name)
    assert str(error.value).count(name) == 1


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


GEOGRAPHIC = (
    'GEOGCS["GCS",DATUM["D",SPHEROID["S",6378137.0,298.257]],PRIMEM["G",0.0],UNIT["Degree",0.0174532925199433]]'
)
PROJECTED = (
    f'PROJCS["P",{GEOGRAPHIC},PROJECTION["Conic"],PARAMETER["False_Easting",984250.0],UNIT["Foot_US",0.3048006096]]'
)
HEIGHT_SYSTEM = 'VERTCS["V",VDATUM["N"],PARAMETER["Direction",1.0],UNIT["Meter",1.0]]'


def test_prj_file_states_the_units_of_an_esri_grid(tmp_path):
    path = tmp_path / "a.asc"
    path.write_text(ESRI.format("corner", 10, 20, 2))
    for text, options in ((PROJECTED, {"unit": "m"}), (f"{PROJECTED},{HEIGHT_SYSTEM}", {})):
        (tmp_path / "a.prj").write_text(text)
        indenter = read_heights(path, **options)
        assert (indenter.spacing, indenter.heights[0, 3]) == (pytest.approx(2 * 0.3048006096, rel=1e-12), 4)
    for text in (GEOGRAPHIC, "Projection UTM\nUnits FEET\n"):
        (tmp_path / "a.prj").write_text(text)
        with refused(r"a.prj: .*in degrees, or in an unknown system.*projected coordinates is needed"):
            read_heights(path, unit="m")
