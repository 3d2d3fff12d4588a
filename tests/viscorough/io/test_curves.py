"""Loading curves in NetCDF files: every field is stored, units follow the length unit, invalid curves are refused."""

import dataclasses

import numpy as np
import pytest

from support.contract import refused
from support.curves import assert_same_curve, random_curve
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


def changed(content, name, change):
    """The content with one variable's values changed by a function."""
    variable = content.variables[name]
    replaced = variable._replace(values=change(variable.values.copy()))
    return Content(content.variables | {name: replaced}, content.attributes)


def at(index, value):
    """A change of values: one of them is replaced."""

    def change(values):
        values[..., index] = value
        return values

    return change


def with_units(content, **units):
    """The content with the units of some variables replaced; None: without."""
    variables = dict(content.variables)
    for name, unit in units.items():
        attributes = {"long_name": name} | ({} if unit is None else {"units": unit})
        variables[name] = variables[name]._replace(attributes=attributes)
    return Content(variables, content.attributes)


def both_ways(curve):
    """(content, its reader) of a curve alone and of a stack of one."""
    return (curve_to_content(curve), curve_from_content), (stack_curves([curve]), unstack_curves)


def test_every_field_of_a_curve_is_stored():
    assert {field.name for field in dataclasses.fields(LoadingCurve)} == {*STORED, *PER_CURVE, "length_unit"}


@pytest.mark.parametrize("levels", [1, netcdf.COMPRESSED_FROM])
def test_curve_survives_a_file_exactly(tmp_path, levels):
    curve = random_curve(levels)
    netcdf.write(curve_to_content(curve), tmp_path / "curve.nc")
    content = netcdf.read(tmp_path / "curve.nc")
    assert_same_curve(curve_from_content(content), curve)
    np.testing.assert_array_equal(content.variables["contact_fraction"].values, curve.contact_fraction)


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
    with refused("at least one"):
        stack_curves([])
    with refused("lengths are in m and um; one unit is allowed"):
        stack_curves([*curves, random_curve(length_unit="um")])


def test_contents_without_a_valid_curve_are_refused():
    good = curve_to_content(random_curve())
    depth = good.variables["depth"]
    for what, content in {
        r"no numbers stiffness\(level\)": Content({"depth": depth, "force": depth}, good.attributes),
        r"no numbers depth\(level\)": Content(good.variables | {"depth": depth._replace(dimensions=())}, {}),
        "no attribute elements": Content(good.variables, {}),
        "there is no level": Content({k: v._replace(values=v.values[:0]) for k, v in good.variables.items()}, {}),
    }.items():
        with refused(what):
            curve_from_content(content)


@pytest.mark.parametrize(
    ("name", "change", "what"),
    [
        ("depth", at(3, 0), "depth must"),
        ("force", at(-1, np.nan), "force must"),
        ("force", lambda values: values.astype(str), r"no numbers force\(level\)"),
        ("residual", at(2, np.nan), "residual"),
        ("contact_count", lambda count: count + 0.5, "a whole number from 1 to 200"),
        ("contact_count", lambda count: count[::-1].astype(np.uint8), "contact_count must not decrease"),
        ("contact_fraction", lambda share: share + 0.3, "contact_fraction must be contact_count over 200 elements"),
    ],
)
def test_numbers_that_are_none_or_contradict_each_other_are_refused(name, change, what):
    with refused(what):
        curve_from_content(changed(curve_to_content(random_curve(elements=200)), name, change))


@pytest.mark.parametrize(
    ("name", "change", "what"),
    [
        ("contact_count", at(0, 0), "a whole number from 1 to 1009"),
        ("contact_count", at(3, 1), "contact_count must not decrease"),
        ("residual", at(3, 1e-3), "residual must be from 0 to the tolerance"),
        ("stiffness", at(3, 1e-3), "stiffness must not decrease"),
        ("force", lambda values: 1e6 * values, "force must rise with the depth"),
        ("force", lambda values: 1e-6 * values, "force must rise with the depth"),
    ],
)
def test_numbers_that_no_contact_has_are_refused(name, change, what):
    for content, read in both_ways(random_curve(tolerance=1e-4)):
        with refused(what):
            read(changed(content, name, change))


@pytest.mark.parametrize(
    ("name", "value", "what"),
    [
        *[("elements", value, "a whole number.* is needed") for value in ("many", np.array([1, 2]), 2.5, -1)],
        ("operator_applications", np.inf, "a whole number.* is needed"),
        *[("tolerance", value, "a number from 0 on.* is needed") for value in ("fine", np.array([1.0, 2.0]), np.nan)],
        *[("method", value, "text is needed") for value in (3, np.array(["a", "b"]))],
        ("elements", 1, "a whole number from 1 to 1"),
        ("tolerance", 1.0, "a number below 1 is needed"),
        *[("length_unit", value, "depth is in 'um' and the attribute length_unit is") for value in ("m", 3, "N")],
    ],
)
def test_attributes_that_no_curve_has_are_refused(name, value, what):
    good = curve_to_content(random_curve(length_unit="um"))
    with refused(what):
        curve_from_content(good.with_attributes(**{name: value}))


@pytest.mark.parametrize(
    ("depth", "force", "stiffness"),
    [
        *[("um", power, "um") for power in ("um2", "um^2", "um**2", "µm2", "1e-12 m2", " um2 ")],
        ("(1e-6 m)", "um2", "um"),
        ("1", None, "1"),
    ],
)
def test_units_agree_however_they_are_spelled(depth, force, stiffness):
    content = with_units(curve_to_content(random_curve()), depth=depth, force=force, stiffness=stiffness)
    assert_same_curve(curve_from_content(content), random_curve(length_unit=depth))
    same = content.with_attributes(length_unit="µm" if depth == "um" else depth)
    assert curve_from_content(same).length_unit == depth


@pytest.mark.parametrize(
    ("units", "what"),
    [
        *[
            ({"force": unit}, f"force is in '{unit}' and depth in 'um'")
            for unit in ("nm2", "um", "1", "furlongs of it")
        ],
        ({"force": None}, "force is in '1' and depth in 'um'; 'um2' is needed for force"),
        ({"depth": "N", "force": "N2", "stiffness": "N"}, "'N': not a unit of length"),
        ({"depth": "1", "force": "1"}, "stiffness is in 'um' and depth in '1'"),
        ({"contact_fraction": "percent"}, "contact_fraction is in 'percent'"),
        ({"contact_count": 3.0}, "contact_count has the units 3.0; text is needed"),
    ],
)
def test_units_that_contradict_that_of_the_depth_are_refused(units, what):
    for content, read in both_ways(random_curve(length_unit="um")):
        with refused(what):
            read(with_units(content, **units))


ROW, COLUMN = np.mgrid[:13, :13] - 6.0
INDENTERS = {
    "disc": self_affine_disc(0.4, 13, seed=5),
    "terraces": Indenter(-0.1 * ((ROW // 3 + COLUMN // 2) % 3), 0.5),
    "sphere": Indenter(-(ROW**2 + COLUMN**2) / 50, 0.1, length_unit="um"),
}


@pytest.mark.parametrize("tolerance", [1e-1, 1e-3, 1e-8])
@pytest.mark.parametrize("kind", INDENTERS)
def test_curves_that_the_solvers_compute_are_read(kind, tolerance):
    """To their tolerance they are convex, and contact grows; in single precision they are read as well."""
    indenter, levels = INDENTERS[kind], np.linspace(0.1, 1, 7)
    whole = indent(indenter, tolerance=tolerance, until_fraction=1.0)
    for curve in (
        whole,
        indent(indenter, tolerance=tolerance, until_fraction=0.9, start_fraction=0.3),
        indent(indenter, tolerance=tolerance, depths=whole.depth[-1] * levels),
        indent(indenter, tolerance=tolerance, forces=whole.force[-1] * levels),
        reduce(self_affine_line(0.4, 100, seed=5)),
    ):
        content = curve_to_content(curve)
        assert_same_curve(curve_from_content(content), curve)
        singles = {k: v._replace(values=v.values.astype(np.float32)) for k, v in content.variables.items()}
        curve_from_content(Content(singles, content.attributes))
