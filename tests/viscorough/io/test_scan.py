"""Spacings and units are read from the file if it states them; contradictions of file and arguments are refused."""

import numpy as np
import pytest
import xarray as xr

from support.contract import refused
from viscorough import read_heights
from viscorough.basics import units
from viscorough.io.scan import uniform_spacing

# Heights of these files are patterns of numbers, steeper than real surfaces.
pytestmark = pytest.mark.filterwarnings("ignore:.*rms slope")

HEIGHTS = np.random.default_rng(0).random((3, 4))


def netcdf_map(path, *, unit="um", x=(0, 0.5, 1.0, 1.5), y=(3, 2, 1), x_unit="um", y_unit="um", dimensions=("y", "x")):
    """Write a file with the map HEIGHTS, with coordinates if they are given."""
    heights = HEIGHTS if dimensions == ("y", "x") else HEIGHTS.T
    parts = {"heights": (dimensions, heights, unit), "x": (("x",), x, x_unit), "y": (("y",), y, y_unit)}
    variables = {
        name: (names, np.array(values, float), {"units": unit} if unit else {})
        for name, (names, values, unit) in parts.items()
        if values is not None
    }
    xr.Dataset(variables).to_netcdf(path)
    return path


@pytest.mark.parametrize(
    ("content", "arguments", "spacings", "unit"),
    [
        ({}, {}, (0.5, 1), "um"),
        ({"dimensions": ("x", "y")}, {}, (0.5, 1), "um"),
        ({"unit": "nm", "y": (1e-6, 2e-6, 3e-6), "y_unit": "m"}, {}, (500, 1000), "nm"),
        ({"unit": None, "x_unit": None, "y_unit": None}, {"unit": "mm"}, (0.5, 1), "mm"),
        ({"x": range(4), "y": range(1, 4), "x_unit": None, "y_unit": None}, {"spacing": 7}, (7, 7), "um"),
        ({"x": range(4), "y": range(3), "x_unit": "px", "y_unit": "px"}, {"spacing": 7}, (7, 7), "um"),
        ({"unit": "nm"}, {"spacing": (units.quantity("0.5 um"), units.quantity("1e-6 m"))}, (500, 1000), "nm"),
    ],
)
def test_coordinates_of_netcdf_give_the_spacings(tmp_path, content, arguments, spacings, unit):
    indenter = read_heights(netcdf_map(tmp_path / "a.nc", **content), **arguments)
    np.testing.assert_array_equal(indenter.heights, HEIGHTS)
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (*spacings, unit)


def test_plain_spacing_needs_one_unit_for_all_axes(tmp_path):
    (tmp_path / "a.txt").write_text("# XY units: mm\n# Z units: um\n1 2 3\n3 4 9\n2 5 7\n")
    with refused("heights are in um, x and y in mm; a spacing with a unit"):
        read_heights(tmp_path / "a.txt", 0.5)
    assert read_heights(tmp_path / "a.txt", [units.quantity("0.5 mm")] * 2).spacing == 500


def test_positions_far_from_0_keep_their_precision():
    northings = 5.4e6 + 0.5 * np.arange(9)
    assert uniform_spacing("y", northings) == 0.5
    assert uniform_spacing("y", northings.astype(np.float32)) == 0.5
    assert uniform_spacing("y", (5e5 + 0.1 * np.arange(200)).astype(np.float32)) == pytest.approx(0.1, rel=3e-3)
    jitter = np.array([0, 0.95, -0.95, 0.5, 0, 0.9, -0.9, 0, 0])
    irregular = 2e6 + np.arange(9) + 0.04 * jitter, 5.4e6 + 3 * np.arange(9) + jitter
    for positions in (*irregular, 1e-6 * np.array([0, 1, 2.2])):
        with refused("not uniform"):
            uniform_spacing("y", positions)
    with refused(r"too coarse|not uniform"):
        uniform_spacing("y", (5.4e6 + 0.7 * np.arange(9)).astype(np.float32))


@pytest.mark.parametrize(
    ("content", "arguments", "what"),
    [
        ({}, {"spacing": 0.5}, "spacing 0.5 um contradicts the file, in which rows are 1 um apart"),
        ({}, {"unit": "nm"}, "unit nm contradicts the file, in which heights are in um"),
        ({"unit": None}, {}, "coordinates are in um, heights in no stated unit; unit"),
        ({"x_unit": None, "y_unit": None}, {}, "coordinates in no stated unit; spacing"),
        ({"x": range(4), "y": range(3), "x_unit": None, "y_unit": None}, {}, "spacing is needed"),
        ({"y_unit": None}, {}, "coordinates are in um and 1"),
        ({"y_unit": "s"}, {}, "not a unit of length"),
        ({"unit": "V"}, {"unit": "um"}, "not a unit of length"),
        ({"y": None}, {}, "only the coordinate x"),
        ({}, {"channel": "phase"}, "none of them is the channel phase"),
        ({"x": (0, 1, np.nan, 3)}, {}, "coordinate x is not finite"),
        ({}, {"spacing": (1, 2, 3)}, "one distance, or the two"),
    ],
)
def test_contradictions_are_refused_in_one_line(tmp_path, content, arguments, what):
    path = netcdf_map(tmp_path / "a.nc", **content)
    with refused(what) as error:
        read_heights(path, **arguments)
    assert str(error.value).startswith(str(path))
