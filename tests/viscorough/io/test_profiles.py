"""Profiles in text files: read_line reads heights along a line in the grammar of maps; they are never read as maps."""

import numpy as np
import pytest

import viscorough
from support.contract import refused
from viscorough import Indenter
from viscorough.io.heights import read_heights, read_line

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore:.*rms slope")

X = 0.5 * np.arange(12) - 1
UNEVEN = np.array([0, 0.31, 0.64, 1.02, 1.3, 1.71, 2.0, 2.3, 2.6, 3.1, 3.2, 3.7])
Z = np.random.default_rng(1).normal(0, 9, 12).round(3)


def columns(*values, delimiter=" ", form="{:g}"):
    """Return the text of columns of numbers."""
    return "".join(delimiter.join(map(form.format, row)) + "\n" for row in zip(*values, strict=True))


def with_decimal_commas(text):
    return text.replace(".", ",")


PROFILES = {
    "column": columns(Z),
    "row": columns(*Z[:, None]),
    "x evenly spaced": columns(X, Z),
    "x falling": columns(X[::-1], Z[::-1]),
    "x in thirds": columns(np.round(X * 2 / 3, 2), Z),
    "x of four digits": "".join(f"{i * 10 / 3:.4g} {z}\n" for i, z in enumerate(Z)),
    "rows": columns(*np.transpose([X, Z])),
    "tabs": columns(X, Z, delimiter="\t"),
    "decimal commas": with_decimal_commas(columns(X, Z, delimiter=";")),
    "heading": "x;z\n" + columns(X, Z, delimiter=";"),
    "x and y": "X,Y\n" + columns(X, Z, delimiter=",", form="{:.3f}"),
    "z first": "# Höhe;Position\n" + columns(Z, X, delimiter=";"),
    "others left out": "x z n\n" + columns(X, Z, range(12)),
    "header": "spacing: 0.5\n" + columns(Z),
}


@pytest.mark.parametrize("name", PROFILES)
def test_profiles_are_lines_and_no_maps(tmp_path, name):
    (tmp_path / "a.txt").write_text(PROFILES[name], encoding="utf-8")
    states_spacing = name not in ("column", "row")
    line = read_line(tmp_path / "a.txt", *([] if states_spacing else [0.5]))
    np.testing.assert_array_equal(line.heights, Z)
    assert line.spacing == pytest.approx({"x in thirds": 1 / 3, "x of four digits": 10 / 3}.get(name, 0.5), rel=1e-3)
    with refused("read_line"):
        read_heights(tmp_path / "a.txt", 0.5)


@pytest.mark.parametrize(
    "text",
    [
        columns(UNEVEN, Z),
        columns(*np.transpose([UNEVEN, Z])),
        columns(X + 0.001 * X**2, Z, form="{:.5f}"),
        columns(UNEVEN, Z, delimiter="\t"),
        with_decimal_commas(columns(UNEVEN, Z, delimiter=";")),
        columns(UNEVEN, np.where(Z > 5, np.nan, Z)),
        "x [um], z [nm]\n" + columns(UNEVEN, Z, delimiter=", ", form="{:.3f}"),
        "x z n\n" + columns(UNEVEN, Z, range(12)),
        columns(UNEVEN, Z, range(12)),
        columns(Z, range(12)),
    ],
)
def test_profiles_with_uneven_steps_or_gaps_are_neither_lines_nor_maps(tmp_path, text):
    (tmp_path / "a.txt").write_text(text, encoding="utf-8")
    with refused("read_line"):
        read_heights(tmp_path / "a.txt", 0.5)
    with refused("line|numpy.interp"):
        read_line(tmp_path / "a.txt")


@pytest.mark.parametrize("heading", ["x [um], z [nm]", "# Position (µm), Height (nm)", "x/um;z/nm", "z_nm x_um"])
def test_units_of_a_heading_are_used(tmp_path, heading):
    order = (Z, X) if heading.startswith("z") else (X, Z)
    delimiter = next(mark for mark in (", ", ";", " ") if mark in heading)
    table = columns(*order, delimiter=delimiter, form="{:.3f}")
    (tmp_path / "a.csv").write_text(f"{heading}\n{table}", encoding="utf-8")
    line = read_line(tmp_path / "a.csv")
    np.testing.assert_array_equal(line.heights, Z)
    assert (line.spacing, line.length_unit) == (pytest.approx(500, rel=1e-12), "nm")


def test_lateral_unit_applies_to_positions(tmp_path):
    (tmp_path / "a.txt").write_text(columns(X, Z))
    line = read_line(tmp_path / "a.txt", unit="um", lateral_unit="mm")
    assert (line.spacing, line.length_unit) == (500, "um")


@pytest.mark.parametrize("heights", [Z[:, None], Z[None, :], np.stack([Z, Z[::-1]]), np.stack([Z, Z[::-1]], axis=1)])
def test_two_spacings_make_a_map_of_few_rows_or_columns(tmp_path, heights):
    np.savetxt(tmp_path / "a.txt", heights)
    surface = read_heights(tmp_path / "a.txt", (0.5, 0.25))
    np.testing.assert_array_equal(surface.heights, heights)
    assert (surface.spacing, surface.row_spacing) == (0.5, 0.25)


def test_numbers_of_points_state_no_spacing(tmp_path):
    (tmp_path / "a.txt").write_text(columns(range(1, 13), Z))
    assert read_line(tmp_path / "a.txt", 0.25).spacing == 0.25
    with refused("distance between neighbouring points is not stated"):
        read_line(tmp_path / "a.txt")


def test_saved_line_is_read_again(tmp_path):
    line = Indenter(Z, 0.5, length_unit="um")
    viscorough.save(line, tmp_path / "line.csv")
    again = read_line(tmp_path / "line.csv")
    np.testing.assert_array_equal(again.heights, Z)
    assert (again.spacing, again.length_unit) == (0.5, "um")


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("1 2 3\n4 5 6\n7 8 9\n", "3 rows of 3 numbers"),
        ("1 2\n3 4\n", "at least 3 points"),
        ("1\nnan\n3\n", "1 of 3 heights are missing"),
        ("time;depth\n0;1\n1;2\n2;4\n", "names two columns"),
        ("# time depth\n\n0 1\n1 2\n2 4\n", "names two columns"),
        ("x [s], z [nm]\n0, 1\n1, 2\n2, 4\n", "'s' is no unit of length"),
        ("spacing: 0.2\n0 1\n.5 2\n1 4\n", "0.2 in the header, 0.5 between"),
        ("1e308 1\n-1e308 2\n-1.7e308 4\n", "not equally spaced"),
        ("0.5 1\nnan 2\n1.5 4\n", "not finite"),
        ("1\n2\n4\n\n5\n6\n", "line 5: empty lines separate it"),
        ("ncols 1\nnrows 3\ncellsize 1\n1\n2\n4\n", "no heights along a line"),
        ('# source: "viscorough 1.0.0"\ndepth,force\n0.5,1\n1,2.5\n2,4\n', "no heights along a line"),
    ],
)
def test_bad_profiles_are_one_line(tmp_path, text, what):
    (tmp_path / "a.txt").write_text(text, encoding="utf-8")
    with refused(what):
        read_line(tmp_path / "a.txt")


def test_content_and_not_suffix_decides_how_a_line_is_read(tmp_path):
    (tmp_path / "a.pro").write_text(columns(Z))
    np.testing.assert_array_equal(read_line(tmp_path / "a.pro", 0.5).heights, Z)
    (tmp_path / "b.txt").write_bytes(bytes(100))
    with refused("unknown kind of file"):
        read_line(tmp_path / "b.txt", 0.5)
