"""Matrices of numbers in text are read exactly, and every text that could mean something else is refused."""

import re

import numpy as np
import pytest

from support.contract import refused
from viscorough import AccuracyWarning, read_heights, read_line

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore::viscorough.AccuracyWarning")

HEIGHTS = np.array([[1.0, -2.5, 3e-1, 4], [0.5, np.nan, 6, -7], [1, 2, 8.25, 0], [0, 3, 1, 5]])


def text(delimiter, row_end="\n"):
    rows = [delimiter.join("nan" if np.isnan(cell) else repr(float(cell)) for cell in row) for row in HEIGHTS]
    return row_end.join(rows)


@pytest.mark.parametrize(("delimiter", "row_end"), [("   ", "\n"), ("\t", "\r\n"), (", ", "\r"), (" ; ", "\n")])
def test_a_matrix_with_one_delimiter_is_read(tmp_path, delimiter, row_end):
    (tmp_path / "a.txt").write_text(f"# first run{row_end}{text(delimiter, row_end)}{row_end}", newline="")
    indenter = read_heights(tmp_path / "a.txt", (0.5, 0.75), unit="um")
    np.testing.assert_allclose(indenter.heights, 1e-6 * HEIGHTS, rtol=1e-14)
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (5e-7, 7.5e-7, "m")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_comments_may_have_any_encoding(tmp_path, encoding):
    content = f"# geschliffen, Prüfling A\n\n  {text(' ')}\n# Ende\n\n"
    (tmp_path / "a.dat").write_text(content, encoding=encoding)
    np.testing.assert_array_equal(read_heights(tmp_path / "a.dat", 1.0).heights, HEIGHTS)


@pytest.mark.parametrize(
    ("content", "what"),
    [
        ("a b c d\n" + text(" "), r"line 1 \('a b c d'\) has 'a' in it"),
        ("% 5\n" + text(" "), "has '%' in it"),
        (text(" ") + " #", r"line 4 .*has '#' in it"),
        (text(" ").replace("nan", "N/A"), "has 'N' in it"),
        (text(" ").replace("nan", "inf"), "has 'i' in it"),
        (text(" ").replace("-2.5", "-2_5"), "has '_' in it"),
        (text(" ").replace("-2.5", "0x1"), "has 'x' in it"),
        (text(" ").replace("-2.5", "1e"), "line 1 has '1e', which is no number"),
        (text(" ").replace("-2.5", "--1"), "line 1 has '--1', which is no number"),
        (text(" ").replace("-2.5", "\N{MINUS SIGN}2.5"), "has '\N{MINUS SIGN}' in it"),
        (text(" ").replace(".", ","), "which is no number; one delimiter, and points as decimal marks"),
        (text(";").replace(".", ","), "';' and ',' in one row; one delimiter, and points as decimal marks"),
        (text("\t").replace(".", ","), "one delimiter, and points as decimal marks"),
        ("1,5, 2,5, 3,5, 4,5\n" * 4, "its commas may be decimal marks"),
        ("1,5,-2,5,3,05,4,5\n" * 4, "its commas may be decimal marks"),
        ("1,5e+00,-2,5e-01\n" * 4, "its commas may be decimal marks"),
        (text(",").replace("nan", ""), "line 2 has an empty cell; .* nan if one is missing"),
        (text(",").replace("\n", ",\n"), "line 1 has an empty cell"),
        ("\t1\t2\t3\n4\t5\t6\t\n" * 2, "line 1 has an empty cell"),
        (text(" ") + " 5", "line 4 has 5 cells, line 1 has 4"),
        (text(" ") + "\n\n" + text(" "), "line 5 separates two matrices"),
        (text(" ") + "\n# New slice\n" + text(" "), "line 5 separates two matrices"),
        ("# nothing\n\n", "no row of numbers"),
        ("", "it is empty"),
    ],
)
def test_texts_that_are_no_matrix_of_numbers_are_refused(tmp_path, content, what):
    (tmp_path / "a.txt").write_text(content, encoding="utf-8")
    with refused(rf"a\.txt: .*{what}"):
        read_heights(tmp_path / "a.txt", 1.0, unit="um")


@pytest.mark.parametrize(
    "comment",
    [
        *("Width: 10.00 µm", "Value units: m", "heights in nm", "step 0.5um", "1 pixel = 2", "dx = 0.5", "Bit2nm"),
        *("cellsize 0.5", "Pixel Width 3", "dx 2", "step size 2"),
        *("x-length: 4000", "Einheit", "Z in Ångström", "micrometres", "rad", "20 °C", "in \N{GREEK SMALL LETTER MU}m"),
    ],
)
def test_comments_with_a_unit_or_a_number_are_refused(tmp_path, comment):
    (tmp_path / "a.txt").write_text(f"# {comment}\n{text(' ')}", encoding="utf-8")
    with refused(r"line 1 .*holds a unit or a number, .*; save as \.gwy or NetCDF, or remove the line"):
        read_heights(tmp_path / "a.txt", 1.0, unit="um")


GRID = np.array([[x, y, 10 * y + x] for y in (0, 2, 4) for x in (1.0, 2, 3, 4)])


@pytest.mark.parametrize(
    ("table", "what"),
    [
        (GRID, "three columns, as of points x, y, z"),
        (np.random.default_rng(1).random((60, 3)), "three columns, as of points x, y, z"),
        (np.column_stack([GRID, GRID[:, :1]]), "may hold points or a profile"),
        (np.random.default_rng(1).random((30, 4)), "may hold points or a profile"),
        (np.column_stack([GRID, GRID[:, :1]])[:7], "may hold points or a profile"),
        (GRID.T, "may hold points or a profile"),
        (np.array([[0, 0.3, 1], [2, 0.1, 2], [4, 0.6, 3]]), "the first column rises or falls evenly"),
        (GRID[:, :2], "a table of 12 by 2 may hold points or a profile; a profile has a single column"),
        (np.column_stack([np.arange(6), np.random.default_rng(1).random((6, 6))]), "the first column rises or falls"),
        (np.column_stack([np.arange(4), np.random.default_rng(1).random((4, 6))]), "the first column rises or falls"),
        (np.vstack([-0.5 * np.arange(7), np.random.default_rng(1).random((6, 7))]), "the first row rises or falls"),
    ],
)
def test_tables_of_points_profiles_and_positions_are_refused(tmp_path, table, what):
    np.savetxt(tmp_path / "a.txt", table)
    with refused(what):
        read_heights(tmp_path / "a.txt", 1.0)


def test_points_in_npy_are_refused(tmp_path):
    np.save(tmp_path / "a.npy", GRID)
    with refused("three columns, as of points x, y, z"):
        read_heights(tmp_path / "a.npy", 1.0)


@pytest.mark.parametrize("delimiter", [" ", ","])
def test_the_lines_for_points_make_their_map(tmp_path, monkeypatch, capsys, delimiter):
    """Points that fill no grid are noticed."""
    monkeypatch.chdir(tmp_path)
    shuffled = np.random.default_rng(1).permutation(GRID)
    np.savetxt("points.txt", shuffled, delimiter=delimiter)
    with refused("in Python: import numpy as np; ") as error:
        read_heights("points.txt", 1.0)
    lines = re.search(r"in Python: (.*)", str(error.value))[1]
    exec(lines, {})
    np.testing.assert_array_equal(np.load("map.npy"), [[1, 2, 3, 4], [21, 22, 23, 24], [41, 42, 43, 44]])
    assert capsys.readouterr().out == "[1. 1. 1.] [2. 2.]\n"
    for damaged in (shuffled[1:], np.vstack([shuffled[1:], shuffled[1:2]])):
        np.savetxt("points.txt", damaged, delimiter=delimiter)
        with pytest.raises((AssertionError, ValueError)):
            exec(lines, {})


@pytest.mark.parametrize("content", ["1\n2\n4\nnan\n", "1 2 4 nan"])
def test_a_text_with_one_row_or_column_is_a_line(tmp_path, content):
    (tmp_path / "a.txt").write_text(content.replace("nan", "3"))
    with pytest.warns(AccuracyWarning, match="Eq. 13 holds for lines whose spectrum"):
        line = read_line(tmp_path / "a.txt", "0.5 um", unit="nm")
    np.testing.assert_allclose(line.heights, [1e-9, 2e-9, 4e-9, 3e-9], rtol=1e-14)
    assert (line.spacing, line.length_unit) == (pytest.approx(5e-7), "m")
    with refused("heights have the shape .4,.; a map is needed; lines are for reduce"):
        read_heights(tmp_path / "a.txt", 1.0)
    (tmp_path / "b.txt").write_text(content)
    with refused("must not be nan on a line"):
        read_line(tmp_path / "b.txt", 1.0)


def test_lines_have_one_spacing(tmp_path):
    np.save(tmp_path / "a.npy", np.arange(4.0))
    with refused("one distance is needed for a line"):
        read_line(tmp_path / "a.npy", (1.0, 2.0))
    np.save(tmp_path / "map.npy", np.eye(4))
    with refused("a line is needed; maps are for indent"):
        read_line(tmp_path / "map.npy", 1.0)
