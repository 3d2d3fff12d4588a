"""Loading curves in NetCDF files: every field is stored, units follow the length unit, invalid curves are refused."""

import dataclasses

import numpy as np
import pytest

from support.curves import assert_same_curve, one_line, random_curve
from viscorough.io import netcdf
from viscorough.io.curves import (
    PER_CURVE,
    STORED,
    curve_from_content,
    curve_to_content,
    stack_curves,
    unstack_curves,
)
from viscorough.io.netcdf import Content
from viscorough.loading_curve import LoadingCurve


def test_every_field_of_a_curve_is_stored():
    assert {field.name for field in dataclasses.fields(LoadingCurve)} == {*STORED, *PER_CURVE, "length_unit"}


@pytest.mark.parametrize("levels", [1, 7, netcdf.COMPRESSED_FROM])
def test_curve_survives_a_file_exactly(tmp_path, levels):
    curve = random_curve(levels)
    netcdf.write(curve_to_content(curve), tmp_path / "curve.nc")
    content = netcdf.read(tmp_path / "curve.nc")
    assert_same_curve(curve_from_content(content), curve)
    np.testing.assert_array_equal(content.variables["contact_fraction"].values, curve.contact_fraction)


@pytest.mark.parametrize(
    ("length_unit", "depth", "force"),
    [
        ("m", "m", "m2"),
        ("1", "1", "1"),
        ("micrometre", "micrometre", "micrometre2"),
        ("1e-6 m", "1e-6 m", "(1e-6 m)2"),
    ],
)
def test_units_are_powers_of_the_length_unit(length_unit, depth, force):
    content = curve_to_content(random_curve(length_unit=length_unit))
    assert curve_from_content(content).length_unit == length_unit
    variables = content.variables
    units = {name: variable.attributes["units"] for name, variable in variables.items()}
    assert (units["depth"], units["stiffness"], units["force"]) == (depth, depth, force)
    assert {units[name] for name in ("contact_count", "contact_fraction", "residual")} == {"1"}


def changed(content, name, change):
    """The content with one variable's values changed by a function."""
    variable = content.variables[name]
    replaced = variable._replace(values=change(variable.values.copy()))
    return Content(content.variables | {name: replaced}, content.attributes)


def with_entry(index, value):
    def change(values):
        values[index] = value
        return values

    return change


def test_contents_without_a_valid_curve_are_refused():
    good = curve_to_content(random_curve())
    without_stiffness = Content({k: v for k, v in good.variables.items() if k != "stiffness"}, good.attributes)
    scalar = Content(good.variables | {"depth": good.variables["depth"]._replace(dimensions=())}, good.attributes)
    empty = Content({k: v._replace(values=v.values[:0]) for k, v in good.variables.items()}, good.attributes)
    cases = {
        r"no numbers stiffness\(level\)": without_stiffness,
        r"no numbers depth\(level\)": scalar,
        r"no numbers force\(level\)": changed(good, "force", lambda values: values.astype(str)),
        "no attribute elements": Content(good.variables, {}),
        "there is no level": empty,
        "depth must": changed(good, "depth", with_entry(3, 0)),
        "stiffness must": changed(good, "stiffness", with_entry(0, 0)),
        "force must": changed(good, "force", with_entry(-1, np.nan)),
    }
    for what, content in cases.items():
        with pytest.raises(ValueError, match=what) as error:
            curve_from_content(content)
        one_line(error)


@pytest.mark.parametrize(
    ("name", "value", "needed"),
    [
        ("elements", "many", "a whole number"),
        ("elements", np.array([1, 2]), "a whole number"),
        ("elements", 2.5, "a whole number"),
        ("elements", -1, "a whole number"),
        ("operator_applications", np.nan, "a whole number"),
        ("operator_applications", np.inf, "a whole number"),
        ("tolerance", "fine", "a number from 0 on"),
        ("tolerance", np.array([1.0, 2.0]), "a number from 0 on"),
        ("tolerance", np.nan, "a number from 0 on"),
        ("method", 3, "text"),
        ("method", np.array(["a", "b"]), "text"),
    ],
)
def test_attributes_of_the_wrong_type_are_refused(name, value, needed):
    good = curve_to_content(random_curve())
    with pytest.raises(ValueError, match=f"attribute {name} is .*; {needed}.* is needed") as error:
        curve_from_content(good.with_attributes(**{name: value}))
    one_line(error)


@pytest.mark.parametrize(
    "changes",
    [{"force": np.full(7, np.inf)}, {"depth": np.zeros(7)}, {"stiffness": np.full(7, np.nan)}, {"levels": 0}],
    ids=["infinite force", "zero depth", "no stiffness", "no level"],
)
def test_invalid_curves_cannot_be_made(changes):
    with pytest.raises(ValueError, match="loading curve") as error:
        random_curve(**changes)
    one_line(error)


def test_stacked_curves_survive_files_exactly(tmp_path):
    curves = [
        random_curve(5),
        random_curve(1, seed=1, method="dense"),
        random_curve(9, seed=2, elements=2, operator_applications=0),
    ]
    content = stack_curves(curves)
    assert content.variables["depth"].dimensions == ("realization", "level")
    assert np.isnan(content.variables["depth"].values).sum() == 4 + 8
    assert content.variables["levels"].values.tolist() == [5, 1, 9]
    for name in ("once.nc", "twice.nc"):
        netcdf.write(content, tmp_path / name)
        content = netcdf.read(tmp_path / name)
        for read, curve in zip(unstack_curves(content), curves, strict=True):
            assert_same_curve(read, curve)
    np.testing.assert_array_equal(content.variables["elements"].values, [1009, 1009, 2])
    with pytest.raises(ValueError, match="at least one"):
        stack_curves([])
    with pytest.raises(ValueError, match="lengths are in m and um; one unit is allowed"):
        stack_curves([*curves, random_curve(length_unit="um")])


def test_unit_of_a_file_that_states_none_is_not_known():
    content = curve_to_content(random_curve())
    del content.variables["depth"].attributes["units"]
    assert curve_from_content(content).length_unit == "1"


@pytest.mark.parametrize("name", ["contact_count", "contact_fraction", "residual"])
def test_every_variable_of_a_curve_is_finite(name):
    good = curve_to_content(random_curve())
    for values in (np.full(7, np.nan), np.full(7, "a")):
        with pytest.raises(ValueError, match=name) as error:
            curve_from_content(changed(good, name, lambda _, values=values: values))
        one_line(error)
