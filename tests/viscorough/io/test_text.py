"""Maps of heights in text files: what they state is read, what they do not state is not guessed."""

import numpy as np
import pytest

from support.curves import one_line
from viscorough.io.heights import read_heights
from viscorough.io.text import read_text

NAN = np.nan
MATRICES = {
    "commas": "1,2,3\n4,5,6\n",
    "commas and spaces": "1, 2, 3\n4, 5, 6\n",
    "semicolons": "1;2;3\r\n4;5;6\r\n",
    "decimal commas": "1,0;2,0;3,0\n4,0;5,0;6,0\n",
    "decimal commas, spaces": "1,0 2,0 3,0\n4,0 5,0 6,0\n",
    "decimal commas, tabs": "1,0\t2,0\t3,0\n4,0\t5,0\t6,0\n",
    "indented": "\t1\t2\t3\n\t4\t5\t6\n",
    "tabs": "1\t2\t3\n4\t5\t6\n",
    "last delimiter": "1,2,3,\n4,5,6,\n",
    "quotes": '"1","2","3"\n"4","5","6"\n',
    "names of columns": "a,b,c\n1,2,3\n4,5,6\n",
    "comments": "# first\n1 2 3 # one\n\n% in between\n4 5 6\n",
    "exponents": "1e0 .2E+1 3.\n+4 5 0.6e1\n",
    "byte order mark": "\ufeff1 2 3\n4 5 6\n",
    "decimal commas in quotes": '"1,0","2,0","3,0"\n"4,0","5,0","6,0"\n',
    "decimal commas in some cells": "1,0 2 3,0\n4 5,0 6\n",
    "Fortran's exponents": "1D0 2d0 0.3D1\n4 5 6\n",
    "an empty line below every row": "1 2 3\r\r\n4 5 6\r\r\n",
    "semicolons are no comments": ";1;2;3\n;4;5;6\n",
}


@pytest.mark.parametrize("case", MATRICES)
def test_matrices_of_any_punctuation(tmp_path, case):
    (tmp_path / "a.txt").write_text(MATRICES[case], encoding="utf-8", newline="")
    scan = read_text(tmp_path / "a.txt")
    np.testing.assert_array_equal(scan.heights, [[1, 2, 3], [4, 5, 6]])
    assert (scan.unit, scan.spacing) == ("1", None)


@pytest.mark.parametrize(
    ("text", "heights"),
    [
        ("1 2 ***\nnan 5 BAD\n", [[1, 2, NAN], [NAN, 5, NAN]]),
        ("1,,3\n,5,\n", [[1, NAN, 3], [NAN, 5, NAN]]),
        ("1\t\t3\n4\t5\t\n", [[1, NAN, 3], [4, 5, NAN]]),
        ("1;No Data;3\n4;5;--\n", [[1, NAN, 3], [4, 5, NAN]]),
        (";2;3\n4;5;6\n;8;\n", [[NAN, 2, 3], [4, 5, 6], [NAN, 8, NAN]]),
        (";;\n4;5;6\n;;\n7;8;9\n", [[NAN, NAN, NAN], [4, 5, 6], [NAN, NAN, NAN], [7, 8, 9]]),
        ("\t2,5\t\n4,5\t5,5\t6,5\n", [[NAN, 2.5, NAN], [4.5, 5.5, 6.5]]),
        ("1,5\t2,5\t3,5\n4,5\t5,5\t\n7,5\t8,5\t9,5\n", [[1.5, 2.5, 3.5], [4.5, 5.5, NAN], [7.5, 8.5, 9.5]]),
        ("None,2,3\n4,5,6\n", [[NAN, 2, 3], [4, 5, 6]]),
        ("- 2 3\n4 5 6\n", [[NAN, 2, 3], [4, 5, 6]]),
        ("? 2 3\n4 5 6\n", [[NAN, 2, 3], [4, 5, 6]]),
        ("#N/A 2 3\n4 #N/A 6\n", [[NAN, 2, 3], [4, NAN, 6]]),
        ("n.a.;2;3\n4;5;6\n", [[NAN, 2, 3], [4, 5, 6]]),
        ("\u22121 2 3\n4 5 \u22126\n", [[-1, 2, 3], [4, 5, -6]]),
        ("1\t2\n\t # no points\n5\t6\n", [[1, 2], [NAN, NAN], [5, 6]]),
        ("-- --\n1 2\n3 4\n", [[NAN, NAN], [1, 2], [3, 4]]),
    ],
)
def test_gaps_are_nan(tmp_path, text, heights):
    (tmp_path / "a.csv").write_text(text)
    np.testing.assert_array_equal(read_text(tmp_path / "a.csv").heights, heights)


def test_other_encodings(tmp_path):
    text = "# Width: 2 µm\n# Height: 1 µm\n# Value units: nm\n1 2\n3 4\n"
    for encoding in ("utf-8", "utf-16", "latin-1"):
        (tmp_path / "a.txt").write_text(text, encoding=encoding)
        indenter = read_heights(tmp_path / "a.txt")
        assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (1000, 500, "nm")


@pytest.mark.parametrize(
    ("header", "unit", "spacing"),
    [
        ("# dx = 0.5 um\n# dy = 250 nm\n# z unit: nm\n", "nm", (500, 250)),
        ("# pixel size: 0.5 um\n# unit: um\n", "um", (0.5, 0.5)),
        ("# Width: 4 mm\n# Height: 2 mm\n# Value units: m\n", "m", (2e-3, 1e-3)),
        ("x spacing = 2\ny spacing = 3\n", "1", (2, 3)),
        ("X pixel size: 0.5 um\nY pixel size: 0.8 um\nunit: um\n", "um", (0.5, 0.8)),
        ("Y pixel size: 0.8 um\nX pixel size: 0.5 um\nunit: um\n", "um", (0.5, 0.8)),
        ("pixel size: 0.5 um x 0.8 um\nunit: um\n", "um", (0.5, 0.8)),
        ("pixel size: 0.5 x 0.8 um\nunit: um\n", "um", (0.5, 0.8)),
        ("pixel size: 1,5 \u00b5m\nunit: \u03bcm\n", "um", (1.5, 1.5)),
        ("# Breite: 12,34 \u00b5m\n# Höhe: 5,128 \u00b5m\n# Werteinheiten: nm\n", "nm", (6170, 2564)),
        ("X units: mm\nY units: mm\nZ units: um\ndx = 0.5\ndy = 0.5\n", "um", (500, 500)),
        ("Z units: um\nXY units: mm\npixel size = 0.5\n", "um", (500, 500)),
        ("# Lateral units: m\n# Height units: nm\n# dx=1e-6, dy=2e-6\n", "nm", (1000, 2000)),
        ("X pixel size (um): 0.5\nY pixel size (um): 0.8\nZ unit: um\n", "um", (0.5, 0.8)),
        ("Pixel_size = 0.5 um\nunit = um\n", "um", (0.5, 0.5)),
        ("Camera pixel size: 6.5 um\nPixel size: 0.5 um\nunit: um\n", "um", (0.5, 0.5)),
        ("Width: 2 px\nHeight: 2 px\npixel size: 0.5 um\nunit: um\n", "um", (0.5, 0.5)),
        ("Width: 1 um\nHeight: 1 um\npixel size: 0.5 um\nHeight [nm]\n", "nm", (500, 500)),
    ],
)
def test_headers(tmp_path, header, unit, spacing):
    (tmp_path / "a.txt").write_text(f"{header}1 2\n3 4\n")
    indenter = read_heights(tmp_path / "a.txt")
    np.testing.assert_array_equal(indenter.heights, [[1, 2], [3, 4]])
    assert (indenter.spacing, indenter.row_spacing) == pytest.approx(spacing, rel=1e-12)
    assert indenter.length_unit == unit


def test_esri_grids(tmp_path):
    head = "ncols 3\nnrows 2\nxllcorner 7\nyllcorner 9\n"
    (tmp_path / "a.asc").write_text(f"{head}cellsize 0.5\nNODATA_value -99\n1 2 3\n4 -99 6\n")
    indenter = read_heights(tmp_path / "a.asc")
    np.testing.assert_array_equal(indenter.heights, [[1, 2, 3], [4, NAN, 6]])
    assert (indenter.spacing, indenter.row_spacing) == (0.5, 0.5)
    (tmp_path / "b.asc").write_text(f"{head}dx 0.5\ndy 0.25\n1 2 3 4 5 6\n")
    indenter = read_heights(tmp_path / "b.asc")
    np.testing.assert_array_equal(indenter.heights, [[1, 2, 3], [4, 5, 6]])
    assert (indenter.spacing, indenter.row_spacing) == (0.5, 0.25)


def test_points_in_any_order_with_gaps(tmp_path):
    """Positions rounded to a hundredth of their distance, one column and one more point missing."""
    random = np.random.default_rng(3)
    heights = random.standard_normal((6, 8))
    x, y = np.meshgrid(np.round(0.0996 * np.arange(8), 3), 5 - 0.25 * np.arange(6))
    heights[:, 3] = heights[2, 5] = np.nan
    points = np.stack([x, y, heights], axis=-1).reshape(-1, 3)
    points = random.permutation(points[np.isfinite(points[:, 2])])
    np.savetxt(tmp_path / "a.xyz", points)
    indenter = read_heights(tmp_path / "a.xyz")
    np.testing.assert_array_equal(indenter.heights, heights[::-1])
    assert indenter.spacing == pytest.approx(0.0996, rel=1e-3)
    assert indenter.row_spacing == pytest.approx(0.25)


@pytest.mark.parametrize(
    "heading",
    [
        "# X [µm], Y [µm], Z [nm]",
        "x/um y/um z/nm",
        "x_um y_um z_nm",
        "x (um)\ty (um)\theight (nm)",
        "x in um, y in um, z in nm",
        "x y z\num um nm",
        "# Lateral units: um\n# Value units: nm",
        "Position x [um]  Position y [um]  Höhe [nm]",
    ],
)
def test_points_with_units_of_their_columns(tmp_path, heading):
    (tmp_path / "a.xyz").write_text(f"{heading}\n0 0 1\n0.5 0 2\n0 0.25 3\n0.5 .25 4\n", encoding="utf-8")
    (tmp_path / "a.txt").write_text("y [um];x [um];z [nm];n\n0;0;1;9\n0;0,5;2;9\n0,25;0;3;9\n0,25;0,5;4;9\n")
    np.testing.assert_array_equal(read_heights(tmp_path / "a.xyz").heights, [[1, 2], [3, 4]])
    indenter = read_heights(tmp_path / "a.txt")
    np.testing.assert_array_equal(indenter.heights, [[1, 2], [3, 4]])
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (500, 250, "nm")


def test_three_columns_are_a_matrix_unless_they_form_a_grid(tmp_path):
    matrix = np.random.default_rng(1).integers(0, 9, (40, 3))
    np.savetxt(tmp_path / "a.txt", matrix)
    np.testing.assert_array_equal(read_text(tmp_path / "a.txt").heights, matrix)
    y, x = np.mgrid[:3, :4]
    np.savetxt(tmp_path / "b.txt", np.stack([x, y, x + y], axis=-1).reshape(-1, 3))
    np.testing.assert_array_equal(read_text(tmp_path / "b.txt").heights, x + y)


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
"""


def test_files_of_zygo_need_the_unit_of_their_heights(tmp_path):
    (tmp_path / "a.xyz").write_text(f"{ZYGO}2 1 1\n3 1 No Data\n4 1 3\n2 2 4\n4 2 6\n#\n")
    indenter = read_heights(tmp_path / "a.xyz", unit="um")
    np.testing.assert_array_equal(indenter.heights, [[1, NAN, 3], [4, NAN, 6]])
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (2, 2, "um")
    for rows, what in (
        ("", "--unit is needed"),
        ("2 1 7\n", "line 20"),
        ("9 1 7\n", "line 20"),
        ("4 x 6\n", "line 20"),
    ):
        (tmp_path / "b.xyz").write_text(f"{ZYGO}2 1 1\n3 1 No Data\n4 1 3\n2 2 4\n4 2 6\n{rows}#\n")
        with pytest.raises(ValueError, match=what) as error:
            read_heights(tmp_path / "b.xyz")
        assert one_line(error).count("b.xyz") == 1


BAD = {
    "empty": (b"", "no row of numbers"),
    "words": (b"abc\ndef\n", "no row of numbers"),
    "ragged": (b"1 2\n3\n", "line 2: 1 cells, 2 in line 1"),
    "misprint": (b"1 2\n3 x\n", "line 2: 'x' is not a number"),
    "misprint in the first row": (b"1 2_\n3 4\n", "line 1 .* is not a row of numbers"),
    "infinite": (b"# pixel size = 1\n1e999 2\n3 4\n", "finite"),
    "wrong count": (b"ncols 3\nnrows 2\ncellsize 1\n1 2\n3 4\n", "4 numbers; 3 columns and 2 rows"),
    "endless grid": (b"ncols 1e400\nnrows 2\n1 2\n", "inf columns"),
    "no spacing": (b"1 2\n3 4\n", "--spacing is needed"),
    "volts": (b"# Value units: V\n# pixel size = 1 um\n1 2\n3 4\n", "'V': not a unit of length"),
    "seconds": (b"# pixel size = 1 s\n# unit: um\n1 2\n3 4\n", "'s': not a unit of length"),
    "unit of the spacing only": (b"# pixel size = 1 um\n1 2\n3 4\n", "--unit is needed"),
    "unit of one side only": (b"# Width: 1 um\n# Height: 1\n1 2\n3 4\n", "one direction only"),
    "no width": (b"# Width: 0 um\n# Height: 1 um\n# unit: um\n1 2\n3 4\n", "spacing: must be positive"),
    "unknown mark in the first row": (b"<0.1 2 3\n4 5 6\n", "line 1 .* is not a row of numbers"),
    "unknown mark in a row": (b"1;2;3\n4;<0.1;6\n", "line 2: '<0.1' is not a number"),
    "only unknown marks in the first row": (b"x x x\n4 5 6\n", "line 1 .* is not a row of numbers"),
    "commas with and without spaces": (b"1,5, 2,5\n3,5, 4,5\n", "line 1 .*with and without spaces"),
    "one column with decimal commas": (b"0,5\n1,5\n", "one column with decimal commas"),
    "leading zeros": (b"1,05,2,10\n3,15,4,20\n", "one column with decimal commas|columns of whole numbers"),
    "thousands": (b"1,234.5;2\n3;4\n", "line 1 .*decimal points and decimal commas"),
    "spaces in numbers": ("1\u202f234 5\n6 7\n".encode(), "line 1 holds"),
    "two maps": (b"1 2\n3 4\n\n5 6\n7 8\n", "line 4: empty lines separate it"),
    "two maps with empty lines between rows": (b"1 2\n\n3 4\n\n\n5 6\n\n7 8\n", "line 6: empty lines separate it"),
    "a row of empty cells apart from the others": (b"\t\nsecond part\n3\t4\n5\t6\n", "line 1: a row of empty cells"),
    "two maps of Gwyddion": (b"# Channel: A\n1 2\n# Channel: B\n3 4\n", "line 3 .* stands between rows"),
    "numbers of rows": (b"1 7 2\n2 3 9\n3 1 4\n4 8 8\n5 2 7\n6 9 1\n", "the first column counts up evenly"),
    "contradicting lines": (b"ncols 3\nnrows 2\ncellsize 1\n1 2\n3 4\n5 6\n", "3 lines of 2 numbers contradict"),
    "unit of x, plain spacing": (b"# XY units: mm\n# Z units: um\n1 2\n3 4\n", "--spacing is needed"),
    "degrees": (b"lon lat z\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n", "degrees"),
    "volts in a heading": (b"x [um] y [um] z [V]\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n", "'V' is no unit of length"),
    "two units": (b"# z unit: um\n# value units: nm\n# dx=1 um, dy=1 um\n1 2\n3 4\n", "units um and nm"),
    "unit of what": (b"# foo units: um\n# pixel size: 1 um\n1 2\n3 4\n", "foo units: um.*not stated"),
    "two spacings": (b"# dx=1 um\n# dx=2 um\n# dy=1 um\n# unit: um\n1 2\n3 4\n", "columns are 1 or 2 um apart"),
    "width and spacing": (b"# Width: 9 um\n# Height: 2 um\n# dx=1 um\n# unit: um\n1 2\n3 4\n", "extend over 9 um"),
    "no factor": (b"# height conversion factor (-> m) =\n# dx=1 m, dy=1 m\n1 2\n3 4\n", "not a length|number"),
    "a thousand or one": (b"# pixel size: 1,234 nm\n# unit: nm\n1 2\n3 4\n", "1,234 is 1234 or 1.234"),
    "one direction": (b"# dx: 1 nm\n# unit: nm\n1 2\n3 4\n", "between rows is not stated"),
    "another number of columns": (b"# Width: 3 px\n# Height: 2 px\n1 2\n3 4\n", "the table has 2 points there"),
    "spacing in pixels": (b"# pixel size: 1 px\n# unit: nm\n1 2\n3 4\n", "--spacing is needed"),
    "flat elements": (b"# dx = 1 um\n# dy = 9 um\n# unit: um\n1 2\n3 4\n", "five|5"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_texts_are_one_line(tmp_path, case):
    content, what = BAD[case]
    (tmp_path / "bad.txt").write_bytes(content)
    with pytest.raises(ValueError, match=what) as error:
        read_heights(tmp_path / "bad.txt")
    assert one_line(error).count("bad.txt") == 1


@pytest.mark.parametrize(
    ("rows", "what"),
    [
        ("0 0 1\n", "two positions"),
        ("0 0 1\n1 0 2\n3 1 3\n1.3 1.2 3\n", "steps lie between"),
        ("0 0 1\n1 0 2\n0 1 3\n1 1 4\n1 1 5\n", "stand twice"),
        ("0 0\n1 0\n", "2 columns"),
        ("0 nan 1\n1 0 2\n", "finite"),
        ("# x [um] y [nm] z [um]\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n", "x is in um, y in nm"),
        ("".join(f"{i} {i} 1\n" for i in range(99)), "99 points on a grid of 99 by 99"),
    ],
)
def test_points_off_a_grid_are_refused(tmp_path, rows, what):
    (tmp_path / "bad.xyz").write_text(rows)
    with pytest.raises(ValueError, match=what) as error:
        read_heights(tmp_path / "bad.xyz")
    assert one_line(error).count("bad.xyz") == 1
