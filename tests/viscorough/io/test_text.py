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


def test_points_with_units_of_their_columns(tmp_path):
    (tmp_path / "a.txt").write_text("# X [µm], Y [µm], Z [nm]\n0 0 1\n0.5 0 2\n0 0.25 3\n0.5 .25 4\n")
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
