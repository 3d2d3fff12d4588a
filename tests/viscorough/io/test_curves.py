"""Loading curves in NetCDF files: every field is stored, units follow the length unit, invalid curves are refused."""

import numpy as np
import pytest

import viscorough
from support.contract import refused
from support.curves import assert_same_curve, random_curve
from viscorough import Indenter, load_curve
from viscorough.io import netcdf
from viscorough.io.curves import curve_from_content, curve_to_content, stack_curves


def values(name, change):
    """Return a change of a content: a function replaces the values of a variable."""

    def changed(content):
        variables, about = content
        dimensions, numbers, attributes = variables[name]
        return variables | {name: (dimensions, change(numbers.copy()), attributes)}, about

    return changed


def entry(name, index, value):
    """Return a change of a content: one new value of a variable."""

    def change(numbers):
        numbers[..., index] = value
        return numbers

    return values(name, change)


def units(**texts):
    """Return a change of a content: new units of some variables; None: without units."""

    def changed(content):
        variables, about = dict(content[0]), content[1]
        for name, unit in texts.items():
            attributes = {"long_name": name} | ({} if unit is None else {"units": unit})
            variables[name] = *variables[name][:2], attributes
        return variables, about

    return changed


def attribute(name, value):
    """Return a change of a content: a new attribute."""
    return lambda content: (content[0], content[1] | {name: value})


ABOUT_GRID = {
    "grid_error": [0.3, 0.01],
    "force_grid_error": [0.2, 0.0],
    "area_change": [-0.5, 0.1],
    "mean_grid_error": 1 / 3,
    "mean_area_change": -1 / 7,
}


@pytest.mark.parametrize(
    ("name", "levels", "about"),
    [("a.nc", 1, {}), ("a.nc", netcdf.COMPRESSED_FROM, {}), ("a.nc", 2, ABOUT_GRID)],
)
def test_curve_is_read_exactly_as_written(tmp_path, name, levels, about):
    curve = random_curve(levels, **about)
    viscorough.save(curve, str(tmp_path / name))
    assert_same_curve(load_curve(tmp_path / name), curve)
    viscorough.save(Indenter(np.eye(3), 1.0), tmp_path / "map.nc")
    with refused(r"map\.nc: .*a loading curve of viscorough indent is needed"):
        load_curve(tmp_path / "map.nc")


def test_lengths_are_converted_to_metres():
    in_metres = random_curve()
    factors = {"depth": 1e9, "force": 1e18, "stiffness": 1e9}
    numbers = {name: getattr(in_metres, name) * factor for name, factor in factors.items()}
    content = units(depth="nm", force="nm2", stiffness="nm")(curve_to_content(random_curve(**numbers)))
    curve = curve_from_content(content)
    assert curve.length_unit == "m"
    for name in factors:
        np.testing.assert_allclose(getattr(curve, name), getattr(in_metres, name), rtol=1e-14)


def test_curves_of_one_unit_are_stacked():
    curves = [random_curve(5), random_curve(1, seed=1, method="dense"), random_curve(9, seed=2)]
    variables, _ = stack_curves(curves)
    assert variables["depth"][0] == ("realization", "level")
    assert np.isnan(variables["depth"][1]).sum() == 4 + 8
    assert variables["levels"][1].tolist() == [5, 1, 9]
    with refused("at least one"):
        stack_curves([])
    with refused("lengths are in m and 1; one unit is allowed"):
        stack_curves([*curves, random_curve(length_unit="1")])


IMPOSSIBLE = [
    (lambda content: ({"depth": content[0]["depth"]}, {}), r"no numbers force\(level\)"),
    (lambda content: (content[0], {}), "no attribute elements"),
    (values("force", lambda force: force.astype(str)), r"no numbers force\(level\)"),
    (entry("depth", 3, 0), "loading curve: depth: allowed is one row of finite numbers above 0"),
    (entry("force", -1, np.nan), "force: allowed"),
    (entry("residual", 2, np.nan), "residual"),
    (values("contact_count", lambda count: count + 0.5), "a whole number from 1 to 200"),
    (values("contact_count", lambda count: count[::-1].astype(np.uint8)), "contact_count must not decrease"),
    (values("contact_fraction", lambda share: share + 0.3), "contact_fraction must be contact_count over 200 elements"),
    *[(attribute("elements", value), "a whole number is needed") for value in ("many", np.array([1, 2]), 2.5)],
    (attribute("elements", -1), "loading curve: -1 elements"),
    *[(attribute("tolerance", value), "a number is needed") for value in ("fine", np.array([1.0, 2.0]), np.nan)],
    *[(attribute("method", value), "text is needed") for value in (3, np.array(["a", "b"]))],
    (attribute("elements", 1), "a whole number from 1 to 1"),
    (attribute("tolerance", 1.0), "a number below 1 is needed"),
    *[(attribute("length_unit", value), "attribute length_unit is") for value in ("um", 3, "N")],
    (entry("contact_count", 0, 0), "a whole number from 1 to 200"),
    (entry("contact_count", 3, 1), "contact_count must not decrease"),
    (entry("residual", 3, 1e-2), "residual must be from 0 to the tolerance"),
    (entry("stiffness", 3, 1e-3), "stiffness must not decrease"),
    (values("force", lambda force: 1e6 * force), "force must rise with the depth"),
    (values("force", lambda force: 1e-6 * force), "force must rise with the depth"),
    *[(units(force=unit), f"force is in '{unit}' and depth in 'm'") for unit in ("nm2", "m", "1", "µm2")],
    (units(force=None), "force is in '1' and depth in 'm'; 'm2' is needed for force"),
    (units(depth="N", force="N2", stiffness="N"), "'N': not a unit of length"),
    (units(depth="1", force="1"), "stiffness is in 'm' and depth in '1'"),
    (units(contact_fraction="percent"), "contact_fraction is in 'percent'"),
    (units(contact_count=3.0), "contact_count is in 3.0"),
]


@pytest.mark.parametrize(("change", "what"), IMPOSSIBLE)
def test_impossible_curves_are_refused(change, what):
    curve = random_curve(elements=200)
    with refused(what):
        curve_from_content(change(curve_to_content(curve)))


@pytest.mark.parametrize(
    ("change", "what"),
    [
        (entry("grid_error", 1, -0.1), "loading curve: grid_error must be finite and not below 0"),
        (entry("force_grid_error", 0, np.nan), "loading curve: force_grid_error must be finite"),
        (entry("area_change", 0, -1.5), "loading curve: area_change must be finite and not below -1"),
        (units(grid_error="m"), "grid_error is in 'm'"),
        (attribute("mean_grid_error", -0.1), "loading curve: mean_grid_error must be finite and not below 0"),
        (attribute("mean_area_change", -2.0), "loading curve: mean_area_change must be finite and not below -1"),
        (attribute("operator_applications", -1), "loading curve: operator_applications must not be negative"),
    ],
)
def test_impossible_grid_errors_are_refused(change, what):
    content = curve_to_content(random_curve(2, **ABOUT_GRID))
    curve_from_content(content)
    with refused(what):
        curve_from_content(change(content))
