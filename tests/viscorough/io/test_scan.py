"""Spacings and units: from the file where it states them, refused where file and arguments contradict each other."""

import netCDF4
import numpy as np
import pytest

from support.curves import one_line
from viscorough import units
from viscorough.io.heights import read_heights
from viscorough.io.scan import Scan, to_indenter, uniform_spacing

HEIGHTS = np.random.default_rng(0).random((3, 4))


def netcdf_map(path, *, unit="um", x=(0, 0.5, 1.0, 1.5), y=(3, 2, 1), x_unit="um", y_unit="um", dimensions=("y", "x")):
    """A file with the map HEIGHTS, and coordinates where they are given."""
    with netCDF4.Dataset(path, "w") as file:
        for name, positions, axis_unit in (("x", x, x_unit), ("y", y, y_unit)):
            file.createDimension(name, 4 if name == "x" else 3)
            if positions is not None:
                variable = file.createVariable(name, "f8", (name,))
                variable[:] = positions
                if axis_unit:
                    variable.units = axis_unit
        variable = file.createVariable("heights", "f8", dimensions)
        variable[:] = HEIGHTS if dimensions == ("y", "x") else HEIGHTS.T
        if unit:
            variable.units = unit
    return path


@pytest.mark.parametrize("dimensions", [("y", "x"), ("x", "y")])
def test_coordinates_of_netcdf_give_the_spacings(tmp_path, dimensions):
    indenter = read_heights(netcdf_map(tmp_path / "a.nc", dimensions=dimensions))
    np.testing.assert_array_equal(indenter.heights, HEIGHTS)
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (0.5, 1, "um")


def test_coordinates_are_converted_to_the_unit_of_the_heights(tmp_path):
    indenter = read_heights(netcdf_map(tmp_path / "a.nc", unit="nm", y=(1e-6, 2e-6, 3e-6), y_unit="m"))
    np.testing.assert_array_equal(indenter.heights, HEIGHTS)
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (500, 1000, "nm")


def test_coordinates_without_any_unit_are_in_that_of_the_heights(tmp_path):
    path = netcdf_map(tmp_path / "a.nc", unit=None, x_unit=None, y_unit=None)
    assert (read_heights(path).spacing, read_heights(path).length_unit) == (0.5, "1")
    assert read_heights(path, unit="mm").length_unit == "mm"


def test_indices_state_no_spacing(tmp_path):
    path = netcdf_map(tmp_path / "a.nc", x=range(4), y=range(1, 4), x_unit=None, y_unit=None)
    assert read_heights(path, 7).spacing == 7
    with pytest.raises(ValueError, match="--spacing is needed"):
        read_heights(path)


def test_given_spacing_that_agrees_is_accepted(tmp_path):
    path = netcdf_map(tmp_path / "a.nc", unit="nm")
    for given in ((500, 1000), (500.1, 999.9), (units.quantity("0.5 um"), units.quantity("1e-6 m"))):
        indenter = read_heights(path, given)
        assert (indenter.spacing, indenter.row_spacing) == (500, 1000)
    np.save(tmp_path / "a.npy", HEIGHTS)
    indenter = read_heights(tmp_path / "a.npy", [units.quantity("2 um")] * 2, unit="nm")
    assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == (2000, 2000, "nm")


def test_a_plain_spacing_is_not_taken_in_another_unit_than_that_of_x_and_y(tmp_path):
    (tmp_path / "a.txt").write_text("# XY units: mm\n# Z units: um\n1 2\n3 4\n")
    with pytest.raises(ValueError, match="heights are in um, x and y in mm; a spacing with a unit"):
        read_heights(tmp_path / "a.txt", 0.5)
    assert read_heights(tmp_path / "a.txt", [units.quantity("0.5 mm")] * 2).spacing == 500


def test_positions_far_from_0_are_as_exact_as_their_precision():
    northings = 5.4e6 + 0.5 * np.arange(9)
    assert uniform_spacing("y", northings) == 0.5
    assert uniform_spacing("y", northings.astype(np.float32)) == 0.5
    assert uniform_spacing("y", (5e5 + 0.1 * np.arange(200)).astype(np.float32)) == pytest.approx(0.1, rel=3e-3)
    jitter = np.array([0, 0.95, -0.95, 0.5, 0, 0.9, -0.9, 0, 0])
    for positions in (
        2e6 + np.arange(9) + 0.04 * jitter,
        2e6 + np.arange(9) + 0.4 * jitter,
        5.4e6 + 3 * np.arange(9) + jitter,
    ):
        with pytest.raises(ValueError, match="not uniform"):
            uniform_spacing("y", positions)
    with pytest.raises(ValueError, match=r"too coarse|not uniform"):
        uniform_spacing("y", (5.4e6 + 0.7 * np.arange(9)).astype(np.float32))


CONTRADICTIONS = {
    "spacing": ({}, {"spacing": 0.5}, "--spacing 0.5 um contradicts the file, in which rows are 1 um apart"),
    "unit": ({}, {"unit": "nm"}, "--unit nm contradicts the file, in which heights are in um"),
    "heights without unit": ({"unit": None}, {}, "coordinates are in um, heights in no stated unit; --unit"),
    "coordinates without unit": ({"x_unit": None, "y_unit": None}, {}, "coordinates in no stated unit; --spacing"),
    "one coordinate without unit": ({"y_unit": None}, {}, "coordinates are in um and 1"),
    "degrees": ({"x_unit": "degrees_east", "y_unit": "degrees_north"}, {}, "degrees_north"),
    "seconds": ({"y_unit": "s"}, {}, "not a unit of length"),
    "volts": ({"unit": "V"}, {}, "not a unit of length"),
    "volts, unit given": ({"unit": "V"}, {"unit": "um"}, "not a unit of length"),
    "one coordinate": ({"y": None}, {}, "only the coordinate x"),
    "logarithmic": ({"x": (1, 10, 100, 1000)}, {}, "coordinate x is not uniform"),
    "back and forth": ({"x": (0, 1, 0, 1)}, {}, "coordinate x is not uniform"),
    "constant": ({"x": (1, 1, 1, 1)}, {}, "coordinate x is not uniform"),
    "nan": ({"x": (0, 1, np.nan, 3)}, {}, "coordinate x is not finite"),
    "three spacings": ({}, {"spacing": (1, 2, 3)}, "one distance, or the two"),
    "negative": ({}, {"spacing": -1}, "must be positive"),
    "channel": ({}, {"channel": "phase"}, "none of them is the channel phase"),
}


@pytest.mark.parametrize("case", CONTRADICTIONS)
def test_contradictions_are_refused_in_one_line(tmp_path, case):
    content, arguments, what = CONTRADICTIONS[case]
    path = netcdf_map(tmp_path / "a.nc", **content)
    with pytest.raises(ValueError, match=what) as error:
        read_heights(path, **arguments)
    assert one_line(error).startswith(str(path))


def test_spacing_with_a_unit_needs_a_known_unit_of_the_heights():
    with pytest.raises(ValueError, match=r"--spacing 2 um: .* --unit is needed"):
        to_indenter(Scan(HEIGHTS), [units.quantity("2 um")] * 2)


def test_coordinates_in_single_precision_are_uniform():
    positions = np.linspace(1000, 1001, 2001, dtype=np.float32)
    assert uniform_spacing("x", positions) == pytest.approx(5e-4, rel=1e-3)
    positions[7] += 2e-3
    with pytest.raises(ValueError, match="not uniform"):
        uniform_spacing("x", positions)
