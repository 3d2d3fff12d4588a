"""Loading curves in NetCDF files: every field is stored, units follow the length unit, invalid curves are refused."""

import dataclasses

import numpy as np
import pytest

from support.curves import assert_same_curve, one_line, random_curve
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
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
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_disc, self_affine_line


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


def with_units(content, **units):
    """The content with the units of some variables replaced; None: without."""
    variables = dict(content.variables)
    for name, unit in units.items():
        attributes = {"long_name": name} | ({} if unit is None else {"units": unit})
        variables[name] = variables[name]._replace(attributes=attributes)
    return Content(variables, content.attributes)


def test_unit_of_a_file_that_states_none_is_not_known():
    content = with_units(curve_to_content(random_curve()), depth=None, force=None, stiffness="1")
    assert curve_from_content(content).length_unit == "1"


@pytest.mark.parametrize(
    ("depth", "force", "stiffness"),
    [
        *[("um", power, "um") for power in ("um2", "um^2", "um**2", "µm2", "micron2", "1e-12 m2", " um2 ")],
        ("µm", "um2", "1e-6 m"),
        ("(1e-6 m)", "um2", "um"),
    ],
)
def test_units_agree_however_they_are_spelled(depth, force, stiffness):
    content = with_units(curve_to_content(random_curve()), depth=depth, force=force, stiffness=stiffness)
    assert_same_curve(curve_from_content(content), random_curve(length_unit=depth))


@pytest.mark.parametrize(
    ("units", "what"),
    [
        ({"force": "nm2"}, "force is in 'nm2' and depth in 'um'; 'um2' is needed for force"),
        ({"force": "um"}, "force is in 'um'"),
        ({"force": "N"}, "force is in 'N'"),
        ({"force": "1"}, "force is in '1' and depth in 'um'"),
        ({"force": None}, "force is in '1' and depth in 'um'"),
        ({"force": "furlongs of it"}, "force is in 'furlongs of it'"),
        ({"stiffness": "m"}, "stiffness is in 'm'"),
        ({"depth": "m"}, "force is in 'um2' and depth in 'm'; 'm2' is needed for force"),
        ({"depth": None}, "force is in 'um2' and depth in '1'; '1' is needed for force"),
        ({"depth": "N", "force": "N2", "stiffness": "N"}, "'N': not a unit of length"),
        ({"depth": "1", "force": "1"}, "stiffness is in 'um' and depth in '1'"),
        ({"contact_fraction": "percent"}, "contact_fraction is in 'percent'"),
        ({"residual": "um"}, "residual is in 'um'"),
        ({"contact_count": 3.0}, "contact_count has the units 3.0; text is needed"),
    ],
)
def test_units_that_contradict_that_of_the_depth_are_refused(units, what):
    curve = random_curve(length_unit="um")
    for content, read in ((curve_to_content(curve), curve_from_content), (stack_curves([curve]), unstack_curves)):
        with pytest.raises(ValueError, match=what) as error:
            read(with_units(content, **units))
        one_line(error)


@pytest.mark.parametrize(("attribute", "agrees"), [("1", True), ("µm", True), ("m", False), (3, False), ("N", False)])
def test_the_unit_of_the_heights_is_that_of_the_depth(attribute, agrees):
    content = curve_to_content(random_curve(length_unit="um")).with_attributes(length_unit=attribute)
    if agrees:
        assert curve_from_content(content).length_unit == "um"
        return
    with pytest.raises(ValueError, match="depth is in 'um' and the attribute length_unit is") as error:
        curve_from_content(content)
    one_line(error)


BAD_NUMBERS = [
    ("contact_count", 3, -1, "a whole number from 1 to 1009"),
    ("contact_count", 0, 0, "a whole number from 1 to 1009"),
    ("contact_count", -1, 1010, "a whole number from 1 to 1009"),
    ("contact_count", 3, 1, "contact_count must not decrease"),
    ("residual", 3, -1e-9, "residual must be from 0 to the tolerance"),
    ("residual", 3, 1e-3, "residual must be from 0 to the tolerance"),
    ("stiffness", 3, 1e-7, "stiffness must not decrease"),
    ("stiffness", 3, 1e-3, "stiffness must not decrease"),
    ("force", slice(None), lambda values: 1e6 * values, "force must rise with the depth"),
    ("force", slice(None), lambda values: 1e-6 * values, "force must rise with the depth"),
    ("depth", slice(None), lambda values: 1e3 * values, "force must rise with the depth"),
    ("depth", 0, 1e-9, "force must rise with the depth"),
]


@pytest.mark.parametrize(("name", "index", "value", "what"), BAD_NUMBERS)
def test_numbers_that_no_contact_has_are_refused(name, index, value, what):
    curve = random_curve(tolerance=1e-4)

    def change(values):
        values[..., index] = value(values[..., index]) if callable(value) else value
        return values

    for content, read in ((curve_to_content(curve), curve_from_content), (stack_curves([curve]), unstack_curves)):
        with pytest.raises(ValueError, match=what) as error:
            read(changed(content, name, change))
        one_line(error)


@pytest.mark.parametrize(
    ("name", "values", "what"),
    [
        ("contact_count", 0.5, "a whole number from 1 to 1009"),
        ("contact_fraction", 0.3, "contact_fraction must be contact_count over 1009 elements"),
    ],
)
def test_counts_and_fractions_that_contradict_each_other_are_refused(name, values, what):
    content = curve_to_content(random_curve())
    with pytest.raises(ValueError, match=what) as error:
        curve_from_content(changed(content, name, lambda old: old + values))
    one_line(error)


@pytest.mark.parametrize(
    ("attribute", "value", "what"),
    [("elements", 1, "a whole number from 1 to 1"), ("tolerance", 1.0, "a number below 1 is needed")],
)
def test_attributes_that_no_curve_has_are_refused(attribute, value, what):
    with pytest.raises(ValueError, match=what) as error:
        curve_from_content(curve_to_content(random_curve()).with_attributes(**{attribute: value}))
    one_line(error)


def test_counts_of_unsigned_bytes_are_compared_as_numbers():
    content = curve_to_content(random_curve(elements=200))
    with pytest.raises(ValueError, match="contact_count must not decrease"):
        curve_from_content(changed(content, "contact_count", lambda counts: counts[::-1].astype(np.uint8)))


@pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 1e-3, 1e-5, 1e-8])
@pytest.mark.parametrize("kind", ["disc", "terraces", "sphere"])
def test_curves_that_the_solvers_compute_are_read(kind, tolerance):
    """To their tolerance they are convex, and contact grows; in single precision they are read as well."""
    row, column = np.mgrid[:21, :21] - 10.0
    indenter = {
        "disc": self_affine_disc(0.4, 21, seed=5),
        "terraces": Indenter(-0.1 * ((row // 5 + column // 3) % 3), 0.5),
        "sphere": Indenter(-(row**2 + column**2) / 50, 0.1, length_unit="um"),
    }[kind]
    curve = indent(indenter, tolerance=tolerance, until_fraction=1.0)
    levels = np.linspace(0.1, 1, 7)
    curves = [
        curve,
        indent(indenter, tolerance=tolerance, until_fraction=0.9, start_fraction=0.3),
        indent(indenter, tolerance=tolerance, depths=curve.depth[-1] * levels),
        indent(indenter, tolerance=tolerance, forces=curve.force[-1] * levels),
        reduce(self_affine_line(0.4, 1000, seed=5)),
    ]
    for curve in curves:
        content = curve_to_content(curve)
        assert_same_curve(curve_from_content(content), curve)
        singles = {k: v._replace(values=v.values.astype(np.float32)) for k, v in content.variables.items()}
        curve_from_content(Content(singles, content.attributes))


@pytest.mark.parametrize("name", ["contact_count", "contact_fraction", "residual"])
def test_every_variable_of_a_curve_is_finite(name):
    good = curve_to_content(random_curve())
    for values in (np.full(7, np.nan), np.full(7, "a")):
        with pytest.raises(ValueError, match=name) as error:
            curve_from_content(changed(good, name, lambda _, values=values: values))
        one_line(error)
