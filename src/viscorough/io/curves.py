"""Convert loading curves to the content of NetCDF files and back, for one curve or a stack of curves."""

import contextlib
from collections.abc import Sequence
from typing import Any

import numpy as np

from viscorough.basics import units
from viscorough.basics.summaries import LENGTH_POWERS, si_unit
from viscorough.basics.types import Array
from viscorough.io.netcdf import Content
from viscorough.results.loading_curve import LoadingCurve

COMMENT = (
    "Rigid indenter on an incompressible half-space, no friction, no adhesion. Depth is from first contact, "
    "force is F/G, stiffness is d(F/G)/du. With viscosity for G and impulse for F it is the viscous solution."
)
_NEEDED = "a loading curve of viscorough indent is needed"
# Ignore relative differences up to this size, since another program may have stored the numbers in single precision.
_ROUNDING = 1e-6
# From one level to the next, contact count and stiffness may decrease by at most this multiple of the tolerance. Errors
# of the solver can cause decreases between close levels, up to about the tolerance.
_LOST = 10
# Variables of a curve with one value for each level: {name: (long_name, SI unit)}.
OVER_LEVELS: dict[str, tuple[str, str]] = {
    "depth": ("depth of indentation u", "m"),
    "force": ("normal force over shear modulus F/G", "m2"),
    "stiffness": ("tangent stiffness over shear modulus k/G", "m"),
    "contact_count": ("number of elements in contact", "1"),
    "contact_fraction": ("share of the indenter's elements in contact", "1"),
    "residual": ("largest gap in contact or overlap outside it that remains, over depth", "1"),
}
# Additional variables of a curve with estimated grid errors: {name: (long_name, SI unit)}.
ABOUT_GRID = {
    "grid_error": ("estimated relative error of the velocity due to the spacing of the map", "1"),
    "force_grid_error": ("estimated relative error of the force at a depth due to the spacing of the map", "1"),
    "area_change": ("relative change of the contact area when the spacing of the map is halved", "1"),
}
# Additional variables of a curve or contact, if the shear modulus is given: {name: (long_name, SI unit)}.
WITH_MODULUS = {"normal_force": ("normal force F", "N"), "normal_stiffness": ("normal stiffness k = dF/du", "N m-1")}
# Variables that are fields of LoadingCurve. The contact fraction is no field: it follows from the contact count.
STORED = [name for name in OVER_LEVELS if name != "contact_fraction"]
# Global attributes of every curve: {name: (type, long_name)}.
PER_CURVE = {
    "elements": (int, "number of elements of the indenter"),
    "operator_applications": (int, "applications of the half-space operator on the grid"),
    "tolerance": (float, "relative accuracy asked for"),
    "method": (str, "how the curve was obtained"),
}
# Global attributes of curves with estimated grid errors; both are numbers.
_MEANS = ("mean_grid_error", "mean_area_change")


def curve_to_content(curve: LoadingCurve, shear_modulus: float | None = None) -> Content:
    """Convert a LoadingCurve to the content of a NetCDF file: variables OVER_LEVELS and attributes PER_CURVE.

    The dimension of all variables is `level`. If the curve has grid errors, the variables ABOUT_GRID are added.

    shear_modulus : G [Pa], or in consistent units. If G is given, the variables
        WITH_MODULUS are added
    """
    values, unit = {name: getattr(curve, name) for name in OVER_LEVELS}, curve.length_unit
    values |= {name: getattr(curve, name) for name in ABOUT_GRID if getattr(curve, name) is not None}
    if shear_modulus is not None:
        values["normal_force"] = shear_modulus * curve.force
        values["normal_stiffness"] = shear_modulus * curve.stiffness
    attributes = {"title": "Loading curve of a rigid indenter", "comment": COMMENT}
    attributes |= {name: getattr(curve, name) for name in PER_CURVE}
    attributes |= {name: getattr(curve, name) for name in _MEANS if getattr(curve, name) is not None}
    quantities = OVER_LEVELS | ABOUT_GRID | WITH_MODULUS
    return {name: (("level",), each, described(*quantities[name], unit)) for name, each in values.items()}, attributes


def described(long_name: str, unit: str, length_unit: str) -> dict[str, str]:
    """Return the attributes long_name and units of a variable.

    unit : SI unit. If `length_unit` is "1", the user chooses all units, and the variable has the unit "1"
    """
    return {"long_name": long_name, "units": si_unit(unit, length_unit)}


def curve_from_content(content: Content) -> LoadingCurve:
    """Convert the content of a NetCDF file, made by curve_to_content, to a LoadingCurve with lengths in metres.

    Raises ValueError if the content holds no curve, if the units of other variables contradict the unit of the depth,
    and if the numbers contradict each other by more than the tolerance of the curve.
    """
    variables, attributes = content
    fields: dict[str, Any] = {}
    optional = [name for name in ("contact_fraction", *ABOUT_GRID) if name in variables]
    for name in [*STORED, *optional]:
        dimensions, values, _ = variables.get(name, ((), np.zeros(0), {}))
        if dimensions != ("level",) or values.dtype.kind not in "iuf":
            raise ValueError(f"no numbers {name}(level); {_NEEDED}")
        fields[name] = values
    for name, (convert, _) in PER_CURVE.items():
        if name not in attributes:
            raise ValueError(f"no attribute {name}; {_NEEDED}")
        fields[name] = _converted(name, attributes[name], convert)
    for name in _MEANS:
        if name in attributes:
            fields[name] = _converted(name, attributes[name], float)
    # Another program may have stored counts as floats.
    with np.errstate(invalid="ignore"):
        count = fields["contact_count"].astype(int)
    if np.array_equal(count, fields["contact_count"]):
        fields["contact_count"] = count
    fraction = fields.pop("contact_fraction", None)
    unit = length_unit_of(content)
    if unit not in ("m", units.UNKNOWN):
        metres = units.metres(unit)
        for name in ("depth", "force", "stiffness"):
            fields[name] = fields[name] * metres ** LENGTH_POWERS[OVER_LEVELS[name][1]]
    curve = LoadingCurve(**fields, length_unit=units.UNKNOWN if unit == units.UNKNOWN else "m")
    _check_contact(curve)
    if fraction is not None and not np.allclose(fraction, curve.contact_fraction, rtol=_ROUNDING, atol=0):
        raise ValueError(f"contact_fraction must be contact_count over {curve.elements} elements; {_NEEDED}")
    return curve


def length_unit_of(content: Content) -> str:
    """Return the unit of the depth; "1" if the content of a file states no unit for it.

    Raises ValueError if the unit of another variable is not the required power of the unit of the depth.
    """
    variables, attributes = content
    stated = {name: about.get("units", units.UNKNOWN) for name, (_, _, about) in variables.items()}
    length = stated["depth"]
    if length != units.UNKNOWN:
        units.metres(str(length))  # raises ValueError unless this is a unit of length
    for name, (_, unit) in (OVER_LEVELS | ABOUT_GRID).items():
        needed = units.with_length(unit, length)
        if stated.get(name, needed) != needed:
            raise ValueError(f"{name} is in {stated[name]!r} and depth in {length!r}; {needed!r} is needed for {name}")
    if (attribute := attributes.get("length_unit", length)) != length:
        raise ValueError(f"depth is in {length!r} and the attribute length_unit is {attribute!r}; one unit is needed")
    return str(length)


def _check_contact(curve: LoadingCurve) -> None:
    """Raise ValueError if the numbers of a curve contradict a growing contact by more than the curve's tolerance.

    While the contact grows, the force F(u) is a convex function of the depth u. The mean slope ΔF/Δu between two levels
    therefore lies between the stiffnesses at these levels.
    """
    if not curve.tolerance < 1:
        raise ValueError(f"attribute tolerance is {curve.tolerance:g}; a number below 1 is needed")
    count, stiffness = curve.contact_count.astype(float), curve.stiffness
    tolerance = max(curve.tolerance, _ROUNDING)
    depth_steps, force_steps = (np.diff(values, prepend=0) for values in (curve.depth, curve.force))
    with np.errstate(over="ignore", invalid="ignore"):
        slack = tolerance * stiffness * curve.depth
        too_soft = force_steps < np.append(0, stiffness[:-1]) * depth_steps - slack
        too_stiff = force_steps > stiffness * depth_steps + slack
    no_count = (count != np.rint(count)) | (count < 1) | (count > curve.elements)
    no_residual = ~((curve.residual >= 0) & (curve.residual <= tolerance))  # True for nan, too
    wrong = {
        f"contact_count must be a whole number from 1 to {curve.elements}": no_count,
        "contact_count must not decrease": np.diff(count, prepend=0) < -_LOST * tolerance * count,
        f"residual must be from 0 to the tolerance, {curve.tolerance:g}": no_residual,
        "stiffness must not decrease": np.diff(stiffness, prepend=0) < -_LOST * tolerance * stiffness,
        "force must rise with the depth as the stiffness requires": too_soft | too_stiff,
    }
    for needed, where in wrong.items():
        if where.any():
            raise ValueError(f"{needed} (level {np.argmax(where)}); {_NEEDED}")


def _converted(name: str, value: Any, kind: type) -> Any:
    """Convert the value of a global attribute to int, float or str. Raises ValueError for other values.

    kind : int, float or str
    """
    with contextlib.suppress(TypeError, ValueError, OverflowError):
        converted = kind(value)
        if isinstance(value, str) if kind is str else np.ndim(value) == 0 and converted == value:
            return converted
    needed = {int: "a whole number", float: "a number", str: "text"}[kind]
    raise ValueError(f"attribute {name} is {value!r}; {needed} is needed")


def stack_curves(curves: Sequence[LoadingCurve]) -> Content:
    """Combine loading curves into the content of one NetCDF file, with the dimensions (realization, level).

    A realization is one curve. Curves with fewer levels are filled up with nan. The variables `levels` (number of
    levels) and PER_CURVE have one value for each curve. Grid errors are left out.

    Raises ValueError for an empty list, and for curves in different units of length.
    """
    if not curves:
        raise ValueError("curves: there is none; at least one is needed")
    length_unit, *others = dict.fromkeys(curve.length_unit for curve in curves)
    if others:
        raise ValueError(f"curves: lengths are in {length_unit} and {others[0]}; one unit is allowed")
    levels = np.array([curve.depth.size for curve in curves])
    variables: dict[str, Any] = {}
    for name, quantity in OVER_LEVELS.items():
        rows = padded([getattr(curve, name) for curve in curves])
        variables[name] = ("realization", "level"), rows, described(*quantity, length_unit)
    attributes = {"long_name": "number of levels of the curve", "units": "1"}
    variables["levels"] = ("realization",), levels, attributes
    for name, (kind, long_name) in PER_CURVE.items():
        values: Any = np.array([getattr(curve, name) for curve in curves], dtype=object if kind is str else kind)
        attributes = {"long_name": long_name} | ({} if kind is str else {"units": "1"})
        variables[name] = ("realization",), values, attributes
    return variables, {"title": "Loading curves of rigid indenters", "comment": COMMENT}


def padded(rows: Sequence[Array]) -> Array:
    """Combine rows of numbers into one array, with nan beyond the ends of shorter rows."""
    table = np.full((len(rows), max(map(len, rows))), np.nan)
    for whole, row in zip(table, rows, strict=True):
        whole[: len(row)] = row
    return table
