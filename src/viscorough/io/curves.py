"""Loading curves in NetCDF files: variables over levels, and attributes that say how the curve was obtained."""

import re

import numpy as np

from viscorough.io.netcdf import Content, Variable
from viscorough.loading_curve import LoadingCurve

COMMENT = (
    "Rigid indenter on an incompressible half-space, no friction, no adhesion. Depth is from first contact, "
    "force is F/G, stiffness is d(F/G)/du. With viscosity for G and impulse for F it is the viscous solution."
)
# variable over levels: (long_name, power of the length unit)
OVER_LEVELS = {
    "depth": ("depth of indentation u", 1),
    "force": ("normal force over shear modulus F/G", 2),
    "stiffness": ("tangent stiffness over shear modulus k/G", 1),
    "contact_count": ("number of elements in contact", 0),
    "contact_fraction": ("share of the indenter's elements in contact", 0),
    "residual": ("largest gap in contact or overlap outside it that remains, over depth", 0),
}
STORED = [name for name in OVER_LEVELS if name != "contact_fraction"]  # fields of LoadingCurve, not derived
PER_CURVE = {
    "elements": (int, "number of elements of the indenter"),
    "operator_applications": (int, "applications of the half-space operator on the grid"),
    "tolerance": (float, "relative accuracy asked for"),
    "method": (str, "how the curve was obtained"),
}


def check_curve(curve):
    """Raise ValueError for what is no loading curve: overflow or a damaged file must not pass for a result."""
    if curve.depth.size == 0:
        raise ValueError("loading curve: there is no level; at least one is needed")
    for name in ("depth", "force"):
        values = getattr(curve, name)
        if not (np.isfinite(values).all() and (np.diff(values, prepend=0) > 0).all()):
            raise ValueError(f"loading curve: {name} must be finite, positive and increase from level to level")
    if not (np.isfinite(curve.stiffness).all() and (curve.stiffness > 0).all()):
        raise ValueError("loading curve: stiffness must be finite and positive")


def level_attributes(name, length_unit):
    """Attributes of a variable of OVER_LEVELS: long_name and units, a power of the length unit."""
    long_name, power = OVER_LEVELS[name]
    if power == 0 or length_unit == "1":
        units = "1"
    elif power == 1:
        units = length_unit
    else:  # UDUNITS: m2, but (1e-6 m)2
        units = f"{length_unit if re.fullmatch('[A-Za-z]+', length_unit) else f'({length_unit})'}{power}"
    return {"long_name": long_name, "units": units}


def curve_to_content(curve, length_unit="m"):
    """A LoadingCurve as the Content of a file: variables OVER_LEVELS on the dimension `level`, attributes PER_CURVE.

    length_unit : of the curve, as UDUNITS spells it; "1" if it is not known

    Raises ValueError unless depth and force increase and all numbers are positive and finite.
    """
    check_curve(curve)
    variables = {
        name: Variable(("level",), getattr(curve, name), level_attributes(name, length_unit)) for name in OVER_LEVELS
    }
    attributes = {"title": "Loading curve of a rigid indenter", "comment": COMMENT}
    return Content(variables, attributes | {name: getattr(curve, name) for name in PER_CURVE})


def curve_from_content(content):
    """The LoadingCurve of a Content made by curve_to_content. Raises ValueError if it does not hold one."""
    stored, about = {}, {}
    for name in STORED:
        variable = content.variables.get(name)
        if variable is None or variable.dimensions != ("level",) or variable.values.dtype.kind not in "iuf":
            raise ValueError(f"no numbers {name}(level); a loading curve of viscorough indent is needed")
        stored[name] = variable.values
    for name, (convert, _) in PER_CURVE.items():
        if name not in content.attributes:
            raise ValueError(f"no attribute {name}; a loading curve of viscorough indent is needed")
        about[name] = convert(content.attributes[name])
    curve = LoadingCurve(**stored, **about)
    check_curve(curve)
    return curve
