"""What the header of a text file states: the spacing of the points, units of lengths, names of columns.

A statement is a line "key: value" or "key = value"; the unit of a length stands behind the number or in brackets behind
the key. Keys are compared without spaces, hyphens, underscores and case. A key that is not known states nothing, so
that "Camera pixel size" is not taken for the distance of the points; but a unit of length whose meaning is not known is
refused, and so is what can be read in two ways.
"""

import re
from collections.abc import Iterable, Sequence

from viscorough import units
from viscorough.argument_names import argument, spelled

Spacing = tuple[float, float]
Stated = dict[str, list[tuple[str, str, str]]]  # what a header states, by role: line, unit in brackets, value

_AGREEMENT = 1e-3  # relative difference up to which statements of the same length agree
_ROUNDING = 5e-3  # the same for a width and a distance of points, which are rounded to few digits

_NUMBER = r"[+-]?(?:\d+(?:[.,]\d+|\.)?|[.,]\d+)(?:[eE][+-]?\d+)?"
_LENGTH = re.compile(rf"[(\[]?({_NUMBER})\s*[(\[]?([^\d\s,;()\[\]/]*)(?:/(?:px|pixel|point))?[)\]]?", re.IGNORECASE)
_STATEMENT = re.compile(r"[\s#%/;!*\"'|]*([^\W\d_][^:=()\[\]\"]*?)\s*(?:[(\[]([^)\]]*)[)\]])?\"?\s*[:=](.*)")
_COLUMN = re.compile(r"([xyz])(?:[\[(/_]([^\])]*)[\])]?)?", re.IGNORECASE)
_PROFILE_COLUMN = re.compile(
    r"(?:(?P<x>x|position|pos\.?|distance|lateral|length|abstand|weg|strecke|länge|abscisse)|(?P<y>y)"
    r"|(?P<z>z|heights?|profile?|topography|elevation|höhe|hoehe|hauteur))(?:[\[(/_](?P<unit>[^\])]*)[\])]?)?",
    re.IGNORECASE,
)
_FACTOR = re.compile(
    r"(?:height|z|data|value)\W*(?:conversion|scal(?:e|ing))?\W*factor|(?:(?:height|z|data|value)\W*)?"
    r"(?:scal(?:e|ing)|multiplier)(?:\W*factor)?$"
    r"|bit\W*(?:2|to)\W*[pnuµμm]?m$|[pnuµμm]?m\W*(?:per|/)\W*(?:bit|count|digit|lsb)s?$|(?:z\W*)?lsb$",
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
    lines: Sequence[str], shape: tuple[int, ...], decimal: str, profile_columns: int = 0
) -> tuple[str, Spacing | None, str, tuple[str, ...] | None]:
    """(unit, spacing, lateral unit, columns) in lines of text above, below and beside a table of that shape.

    decimal : mark of the table; a decimal comma there makes "1,234" a number below two
    profile_columns : number of columns of the table if it holds a profile, whose points lie along x; 0 for a map

    unit : of the heights; "1" if it is not stated
    spacing : (dx, dy); None if it is not stated, nan for a direction in which it is not
    lateral unit : of the spacing, or of positions x and y; "1" if it is not stated
    columns : names of the columns of points in their order, such as ("x", "y", "z"), or ("x", "z") of a profile; None
        if they are not stated

    Raises ValueError for statements that contradict each other or can be read in two ways, and above a map for the
    heading of a profile.
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
            way = f"without this line, and with {argument('scale')}, they are read"
            raise ValueError(f"header {line.strip()[:80]!r}: heights are the numbers times a factor; {way}")
        elif re.search(r"(?i)(?:units?|einheit(?:en)?|unités?)$", key) and units.is_length(_unit_text(value)):
            text = "of which lengths is not stated; 'XY units', 'Z units' are allowed"
            raise ValueError(f"header {line.strip()[:80]!r}: {text}")
    columns, of_columns = _columns(others, profile_columns or shape[1], of_profile=profile_columns > 0)

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


def names_profile(lines: Iterable[str], count: int) -> bool:
    """Return True if a line heads a table of `count` columns as positions x and heights z of a profile."""
    return any(len(cells) == count and _profile_columns(cells) for cells in (_cells(_heading(line)) for line in lines))


def _heading(line: str) -> str:
    """The text of a line that may head columns, with units attached to the names."""
    return re.sub(r"\s+(?=[\[(/])|(?<=/)\s+", "", line.strip("#%/;,!| \t").replace('"', ""))


def _cells(heading: str) -> list[str]:
    """The names in a heading, separated by commas, semicolons and tabs, or else by spaces."""
    return [cell.strip() for cell in re.split(r"[,;\t]" if re.search(r"[,;\t]", heading) else r"\s+", heading)]


def _columns(lines: Sequence[str], count: int, of_profile: bool) -> tuple[tuple[str, ...] | None, dict[str, str]]:
    """(names of the columns in their order or None, {name: unit}) of a line that heads columns x, y, z, or x and z.

    Other columns have the name "". Raises ValueError for positions in degrees, for what may be a heading or its units
    in another form, for two headings, and for the heading of a profile above a map.
    """
    names: tuple[str, ...] | None = None
    found: dict[str, str] = {}
    for line in lines:
        text = _heading(line)
        cells = _cells(text)
        profile = _profile_columns(cells) if len(cells) == count else None
        if profile and not of_profile:
            text = f"heading {text[:60]!r}: positions and heights of a profile"
            raise ValueError(f"{text}; {spelled('viscorough reduce', 'read_line')} reads it, a map has columns x, y, z")
        heading = profile if of_profile else _map_columns(cells) if len(cells) == count else None
        if names is None and heading:
            names, found = heading
            if wrong := next((unit for unit in found.values() if not units.is_length(unit)), None):
                raise ValueError(f"heading {text[:60]!r}: {wrong!r} is no unit of length, such as um, nm or m")
            continue
        words = set(re.split(r"[\W\d_]+", text.lower()))
        if words & _DEGREES:
            raise ValueError(f"heading {text[:60]!r}: positions in degrees; lengths x and y are needed")
        of_units = len(cells) == count > 1 and all(map(units.is_length, cells))
        in_brackets = map(units.is_length, re.findall(r"[\[(]([^\W\d]\w*)[\])]", text))
        if of_units or words >= ({"x", "z"} if of_profile else {"x", "y", "z"}) or any(in_brackets):
            example = "x [um], z [nm]" if of_profile else "x [um], y [um], z [nm]"
            text = f"header {text[:60]!r}: which columns and units these are is not stated"
            raise ValueError(f"{text}; one heading, such as {example!r}, is allowed")
    return names, found


def _map_columns(cells: Sequence[str]) -> tuple[tuple[str, ...], dict[str, str]] | None:
    """(names, {name: unit}) of cells that head columns x, y and z, in any order, and others; None for other cells."""
    matches = [_COLUMN.fullmatch(cell) for cell in cells]
    if [m and m[1].lower() for m in matches] == ["x", "y", None]:  # z has another name
        matches[2] = _COLUMN.fullmatch(re.sub(r"^[^\W\d_][^\[(/_]*", "z", cells[2]))
    names = tuple(match[1].lower() if match else "" for match in matches)
    if sorted(filter(None, names)) != ["x", "y", "z"]:
        return None
    return names, {match[1].lower(): match[2] for match in matches if match and match[2] is not None}


def _profile_columns(cells: Sequence[str]) -> tuple[tuple[str, ...], dict[str, str]] | None:
    """The same of cells that head the positions x and heights z of a profile, one of which may be named y."""
    matches = [_PROFILE_COLUMN.fullmatch(cell) for cell in cells]
    names = [next(name for name in "xyz" if match[name]) if match else "" for match in matches]
    if sorted(names) == ["y", "z"] or sorted(names) == ["x", "y"]:
        names[names.index("y")] = "x" if "z" in names else "z"
    if sorted(filter(None, names)) != ["x", "z"]:
        return None
    pairs = zip(names, matches, strict=True)
    return tuple(names), {name: match["unit"] for name, match in pairs if match and match["unit"] is not None}
