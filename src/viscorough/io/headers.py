"""What the header of a text file states: the spacing of the points, units of lengths, names of columns.

A statement is a line "key: value" or "key = value"; the unit of a length stands behind the number or in brackets behind
the key. Keys are compared without spaces, hyphens, underscores and case. A key that is not known states nothing, so
that "Camera pixel size" is not taken for the distance of the points; but a unit of length whose meaning is not known is
refused, and so is what can be read in two ways.
"""

import re
from collections.abc import Iterable, Sequence

from viscorough import units

Spacing = tuple[float, float]
Stated = dict[str, list[tuple[str, str, str]]]  # what a header states, by role: line, unit in brackets, value

_AGREEMENT = 1e-3  # relative difference up to which statements of the same length agree
_ROUNDING = 5e-3  # the same for a width and a distance of points, which are rounded to few digits

_NUMBER = r"[+-]?(?:\d+(?:[.,]\d+|\.)?|[.,]\d+)(?:[eE][+-]?\d+)?"
_LENGTH = re.compile(rf"[(\[]?({_NUMBER})\s*[(\[]?([^\d\s,;()\[\]/]*)(?:/(?:px|pixel|point))?[)\]]?", re.IGNORECASE)
_STATEMENT = re.compile(r"[\s#%/;!*\"'|]*([^\W\d_][^:=()\[\]\"]*?)\s*(?:[(\[]([^)\]]*)[)\]])?\"?\s*[:=](.*)")
_COLUMN = re.compile(r"([xyz])(?:[\[(/_]([^\])]*)[\])]?)?", re.IGNORECASE)
_FACTOR = re.compile(
    r"(?:height|z|data|value)\W*(?:conversion|scal(?:e|ing))?\W*factor|(?:(?:height|z|data|value)\W*)?"
    r"(?:scal(?:e|ing)|multiplier)(?:\W*factor)?$",
    re.IGNORECASE,
)
_DEGREES = {"lon", "lat", "longitude", "latitude"}

_STEP = "pixelsize pixelspacing pointspacing samplespacing spacing pixelgröße pixelabstand"
_STEPS = f"{_STEP} step stepsize pitch increment d"
# The spellings of keys by what they state; the axis stands before or behind, as in "x pixel size" and "pixel size x".
_ROLES = {
    "step x": {f"x{key}" for key in _STEPS.split()} | {f"{key}x" for key in _STEPS.split()} | {"deltax", "pixelwidth"},
    "step y": {f"y{key}" for key in _STEPS.split()} | {f"{key}y" for key in _STEPS.split()} | {"deltay", "pixelheight"},
    "step": {*_STEP.split(), "gridspacing", "lateralspacing", "tailledepixel", "tailledupixel", "taillepixel"}
    | {"cellsize"},
    "extent x": {"width", "breite", "largeur", "scanwidth", "imagewidth"},
    "extent y": {"height", "höhe", "hoehe", "hauteur", "scanheight", "imageheight"},
    "unit z": {"zunit", "unitz", "valueunit", "heightunit", "dataunit", "werteinheit", "zeinheit", "einheitz"}
    | {"höheneinheit", "unitédevaleur", "unitédesvaleurs", "unitéz", "unitédez", "unitédehauteur", "verticalunit"},
    "unit xy": {"lateralunit", "xyunit", "x/yunit", "x,yunit", "horizontalunit", "lateraleeinheit", "lateraleinheit"}
    | {"xyeinheit", "unitélatérale", "unitéxy"},
    "unit": {"unit", "lengthunit", "unitoflength", "einheit", "längeneinheit", "unité"},
    "channel": {"channel", "kanal", "canal", "datachannel"},
}
_ROLE_OF = {key: role for role, keys in _ROLES.items() for key in keys}


def states(line: str) -> bool:
    """Whether a line states a length, a unit or the name of a map."""
    match = _STATEMENT.match(line)
    return match is not None and bool(_role(match[1]))


def read_header(
    lines: Sequence[str], shape: tuple[int, ...], decimal: str
) -> tuple[str, Spacing | None, str, tuple[str, ...] | None]:
    """(unit, spacing, lateral unit, columns) in lines of text above, below and beside a table of that shape.

    decimal : mark of the table; a decimal comma there makes "1,234" a number below two

    unit : of the heights; "1" if it is not stated
    spacing : (dx, dy); None if it is not stated, nan for a direction in which it is not
    lateral unit : of the spacing, or of positions x and y; "1" if it is not stated
    columns : names of the columns of points in their order, such as ("x", "y", "z"); None if they are not stated

    Raises ValueError for statements that contradict each other or can be read in two ways.
    """
    stated: Stated = {role: [] for role in _ROLES}
    others = []
    for line in lines:
        match = _STATEMENT.match(line)
        if match is None:
            others.append(line)
            continue
        key, value = match[1], match[3].strip(" \t,;|\"'")
        if (role := _role(key)) and value:  # "Height (nm):" heads numbers below
            stated[role].append((line.strip()[:80], match[2] or "", value))
        elif _FACTOR.match(key) and ("factor" in key.lower() or _LENGTH.match(value)):
            text = "heights are the numbers times a factor; without this line, and with --scale, they are read"
            raise ValueError(f"header {line.strip()[:80]!r}: {text}")
        elif re.search(r"(?i)(?:units?|einheit(?:en)?|unités?)$", key) and units.is_length(_unit_text(value)):
            text = "of which lengths is not stated; 'XY units', 'Z units' are allowed"
            raise ValueError(f"header {line.strip()[:80]!r}: {text}")
    columns, of_columns = _columns(others, shape[1])

    def unit_among(role: str, *axes: str) -> str:
        return _agreed([*(_unit_text(value) for _, _, value in stated[role]), *(of_columns.get(a, "") for a in axes)])

    spacing, lateral = _spacing(stated, shape, unit_among("unit xy", "x", "y"), decimal)
    unit = unit_among("unit z", "z") or unit_among("unit")
    return unit or units.UNKNOWN, spacing, lateral or units.UNKNOWN, columns


def _role(key: str) -> str:
    """What a key states, one of `_ROLES`; "" if it is not known."""
    compact = re.sub(r"[\s_.-]+", "", key.lower())
    return _ROLE_OF.get(re.sub(r"(unité?|einheit)(?:s|en)", r"\1", compact), "")


def _unit_text(value: str) -> str:
    """The unit that a value is; "" for one that counts points."""
    text = value.strip("[](){} ")
    return "" if units.counts_points(text) else text


def _agreed(texts: Iterable[str]) -> str:
    """The unit in texts, which may spell it differently; "" for none. Raises ValueError if they are different units."""
    different = list(dict.fromkeys(filter(None, texts)))
    for other in different[1:]:
        if units.metres(different[0]) != units.metres(other):
            raise ValueError(f"header: units {different[0]} and {other} for the same lengths; one unit is needed")
    return different[0] if different else ""


def _spacing(stated: Stated, shape: tuple[int, ...], lateral: str, decimal: str) -> tuple[Spacing | None, str]:
    """((dx, dy), unit) that statements give, the unit being the lateral one if it is stated; "" for none.

    The spacing is None if there is no statement, and nan for a direction without one.
    """
    steps: list[list[float]] = [[], []]
    extents: list[list[float]] = [[], []]
    have_units = set()
    axes_of = {"step x": (0,), "step y": (1,), "step": (0, 1), "extent x": (0,), "extent y": (1,)}
    for role, axes in axes_of.items():
        for line, bracket, value in stated[role]:
            of_both = role == "step" and value.count(" x ") == 1  # "0.5 um x 0.8 um"
            for axis, text in zip(axes, value.split(" x ") if of_both else [value] * len(axes), strict=True):
                number, unit = _length(line, text, decimal)
                if unit and bracket and unit != bracket:
                    raise ValueError(f"header {line!r}: units {bracket} and {unit}; one unit is needed")
                unit = unit or bracket
                if not units.counts_points(unit):
                    unit = unit or lateral
                    have_units.add(bool(unit))
                    lengths = extents if role.startswith("extent") else steps
                    lengths[axis].append(number * units.metres(unit) / units.metres(lateral or "m") if unit else number)
                elif role.startswith("extent") and number != shape[1 - axis]:
                    raise ValueError(f"header {line!r}: the table has {shape[1 - axis]} points there")
    if not (any(steps) or all(extents)):  # a height alone may be one of the heights
        return None, lateral
    if len(have_units) > 1:
        raise ValueError("the header states units for some of the lengths only; one for all, or none, is needed")
    dx, dy = (_agreed_step(axis, steps[axis], extents[axis], shape[1 - axis]) for axis in (0, 1))
    return (dx, dy), lateral or ("m" if have_units == {True} else "")


def _length(line: str, value: str, decimal: str) -> tuple[float, str]:
    """(number, unit or "") of a statement. Raises ValueError for another value, or a comma that may part thousands."""
    match = _LENGTH.fullmatch(value)
    if match is None:
        raise ValueError(f"header {line!r}: not a length; a number, with or without a unit, is needed")
    text = match[1]
    if decimal != "," and re.fullmatch(r"[+-]?[1-9]\d{0,2},\d{3}", text):
        readings = f"{text.replace(',', '')} or {text.replace(',', '.')}"
        raise ValueError(f"header: {text} is {readings}; a decimal point is needed")
    return float(text.replace(",", ".")), match[2]


def _agreed_step(axis: int, steps: Sequence[float], extents: Sequence[float], count: int) -> float:
    """The distance of points along an axis, from statements that must agree; nan for none."""
    if not (steps or extents):
        return float("nan")
    step = steps[0] if steps else extents[0] / count
    agree = all(abs(other - step) <= _AGREEMENT * step for other in steps)
    for extent in extents:
        agree &= any(abs(extent - n * step) <= _ROUNDING * n * step for n in (count, count - 1))
    if not agree:
        name = "columns" if axis == 0 else "rows"
        text = f"{name} are {' or '.join(f'{a:g}' for a in steps)} apart" if steps else f"{count} {name}"
        extend = "".join(f", they extend over {extent:g}" for extent in extents)
        raise ValueError(f"header: {text}{extend}; positive lengths that agree are needed")
    return float(f"{step:.14g}")


def _columns(lines: Sequence[str], count: int) -> tuple[tuple[str, ...] | None, dict[str, str]]:
    """(names of the columns in their order or None, {name: unit}) of a line that heads columns x, y and z.

    Other columns have the name "". Raises ValueError for positions in degrees, for what may be a heading or its units
    in another form, and for two headings.
    """
    names: tuple[str, ...] | None = None
    found: dict[str, str] = {}
    for line in lines:
        text = re.sub(r"\s+(?=[\[(/])|(?<=/)\s+", "", line.strip("#%/;,!| \t").replace('"', ""))
        cells = [cell.strip() for cell in re.split(r"[,;\t]" if re.search(r"[,;\t]", text) else r"\s+", text)]
        matches = [_COLUMN.fullmatch(cell) for cell in cells]
        if len(cells) == count == 3 and [m and m[1].lower() for m in matches] == ["x", "y", None]:  # z has another name
            matches[2] = _COLUMN.fullmatch(re.sub(r"^[^\W\d_][^\[(/_]*", "z", cells[2]))
        axes = tuple(match[1].lower() if match else "" for match in matches)
        if names is None and len(cells) == count and sorted(filter(None, axes)) == ["x", "y", "z"]:
            names, found = axes, {match[1].lower(): match[2] for match in matches if match and match[2] is not None}
            if wrong := next((unit for unit in found.values() if not units.is_length(unit)), None):
                raise ValueError(f"heading {text[:60]!r}: {wrong!r} is no unit of length, such as um, nm or m")
            continue
        words = set(re.split(r"[\W\d_]+", text.lower()))
        if words & _DEGREES:
            raise ValueError(f"heading {text[:60]!r}: positions in degrees; lengths x and y are needed")
        of_units = len(cells) == count > 1 and all(map(units.is_length, cells))
        in_brackets = map(units.is_length, re.findall(r"[\[(]([^\W\d]\w*)[\])]", text))
        if of_units or words >= {"x", "y", "z"} or any(in_brackets):
            needed = "one heading, such as 'x [um], y [um], z [nm]', is allowed"
            raise ValueError(f"header {text[:60]!r}: which columns and units these are is not stated; {needed}")
    return names, found
