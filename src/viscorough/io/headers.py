"""Read the header of a text file: spacing of the points, units of lengths, names of columns.

A statement is a line "key: value" or "key = value", or a known key and its value with a comma, semicolon, tab, space
or brackets between them, or an entry of a JSON object. A title such as "Height [nm]" states the unit of the heights.
The unit of a length follows the number, or is in brackets after the key. Spaces, hyphens, underscores and capitals in
keys do not matter. Unknown keys are ignored, so that "Camera pixel size" is not taken for the spacing of the points. A
unit is refused if it is not certain to which lengths it belongs. A line with two possible meanings is refused, too.
Lines that hold a unit of length in any other form are listed as mentions.
"""

import json
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from viscorough.basics import units
from viscorough.basics.argument_names import argument, spelled

Spacing = tuple[float, float]
# Statements "key (unit): value" of a header, sorted by their meaning: {role (a key of _ROLES): [(line, unit, value)]}.
Stated = dict[str, list[tuple[str, str, str]]]

# If a header states the same spacing twice, the two values may differ by at most this share.
_AGREEMENT = 1e-3
# The stated extent of the map and the extent that follows from a stated spacing may differ by at most this share. Both
# are often rounded to few digits.
_ROUNDING = 5e-3

_NUMBER = r"[+-]?(?:\d+(?:[.,]\d+|\.)?|[.,]\d+)(?:[eE][+-]?\d+)?"
_LENGTH = re.compile(rf"[(\[]?({_NUMBER})\s*[(\[]?([^\d\s,;()\[\]/]*)(?:/(?:px|pixel|point))?[)\]]?", re.IGNORECASE)
_STATEMENT = re.compile(r"[\s#%/;!*\"'|\\]*([^\W\d_][^:=()\[\]\"]*?)\s*(?:[(\[]([^)\]]*)[)\]])?\"?\s*[:=](.*)")
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
# Pattern of a title of a matrix of heights, with their unit: "Height [nm]", "Heights in nm", "Z,nm".
_TITLE = re.compile(
    r"(?:(?:the|all|measured|exported|surface|image|sample|map|of)\s+)*"
    r"(?:z|(?:z\W*)?(?:heights?|topograph(?:y|ie)|elevations?|höhen?|hoehen?|hauteurs?|values?|data|numbers))"
    r"(?:[\W_]*(?:values?|data|map))?(?:\s+(?:is|are))?"
    r"(?:[\s_]+in[\s_]+|[\s/,;:=|_-]*[\s/,;:=|\[({<_-])[\s\"']*([^\W_]+)[\s\"']*[\])}>]?",
    re.IGNORECASE,
)
# Pattern of a unit of length in a text, other than the unit of a quantity such as "10 nm".
_MENTION = re.compile(
    r"(?<![^\W_])(?<![./^])(?<!\d\s)([pnuµμmc]m|Å|[aA]ngstr[oö]ms?|[mM]icrons?|(?:[nN]ano|[mM]icro|[mM]illi|[cC]enti)?[mM]et(?:er|re)s?"
    r"|(?<=[\[(])m(?=[\])]))(?![\w/^²³]|\s*\d)"
)
# Pattern of a text that may state a factor of the heights.
_MAY_BE_FACTOR = re.compile(
    r"multipl(?:y|ied|ier)|(?<![^\W\d_])(?:heights?|z|data|values?|numbers?|counts?)\W*(?:\w+\W*)?(?:factor|scal)",
    re.IGNORECASE,
)
_DEGREES = {"lon", "lat", "longitude", "latitude"}

_STEP = "pixelsize pixelspacing pointspacing samplespacing spacing pixelgröße pixelabstand"
_STEPS = f"{_STEP} step stepsize pitch increment d"
# Statements that a header may make: {role (meaning of the statement): keys with this meaning}. Keys are in lower case
# and without spaces. A key names its axis first or last: "xpixelsize" or "pixelsizex".
_ROLES = {
    "step x": {f"x{key}" for key in _STEPS.split()} | {f"{key}x" for key in _STEPS.split()} | {"deltax", "pixelwidth"},
    "step y": {f"y{key}" for key in _STEPS.split()} | {f"{key}y" for key in _STEPS.split()} | {"deltay", "pixelheight"},
    "step": {*_STEP.split(), "gridspacing", "lateralspacing", "tailledepixel", "tailledupixel", "taillepixel"}
    | {"cellsize"},
    "extent x": {"width", "breite", "largeur", "scanwidth", "imagewidth"},
    "extent y": {"height", "höhe", "hoehe", "hauteur", "scanheight", "imageheight"},
    "unit z": {"zunit", "unitz", "valueunit", "heightunit", "dataunit", "werteinheit", "zeinheit", "einheitz"}
    | {"exportedimageunit", "imageunit", "imagedataunit", "exporteddataunit", "heightsunit", "valuesunit", "zdataunit"}
    | {
        "zvalueunit",
        "heightdataunit",
        "zaxisunit",
        "unitheight",
        "unitofheight",
        "unitofheights",
        "unitofz",
        "unitdata",
    }
    | {"unitofvalues", "unitofdata", "topographyunit", "elevationunit", "zlengthunit", "heightdata", "zscaleunit"}
    | {"höheneinheit", "unitédevaleur", "unitédesvaleurs", "unitéz", "unitédez", "unitédehauteur", "verticalunit"},
    "unit xy": {"lateralunit", "xyunit", "x/yunit", "x,yunit", "horizontalunit", "lateraleeinheit", "lateraleinheit"}
    | {"xyeinheit", "unitélatérale", "unitéxy", "scaleunit", "pixelunit", "spacingunit", "positionunit"},
    "unit": {"unit", "lengthunit", "unitoflength", "einheit", "längeneinheit", "unité"},
    "missing": {"nodata", "nodatavalue", "missingvalue", "missingdata", "missingdatavalue", "badvalue", "baddatavalue"}
    | {"invalidvalue", "undefinedvalue", "fillvalue", "nullvalue", "blankvalue", "voidvalue", "maskedvalue"},
    "channel": {"channel", "kanal", "canal", "datachannel"},
}
_ROLE_OF = {key: role for role, keys in _ROLES.items() for key in keys}
# Axes to which a stated length applies: {role of the statement (a key of _ROLES): axes}, where 0 is x and 1 is y.
_AXES = {"step x": (0,), "step y": (1,), "step": (0, 1), "extent x": (0,), "extent y": (1,)}


class Header(NamedTuple):
    """Units and spacing that a header states.

    unit : unit of the heights; "1" if it is not stated
    spacing : (dx, dy), the distances between columns and between rows. A distance that is not stated is nan; None if
        both are missing
    lateral_unit : unit of the spacing, or of positions x and y; "1" if it is not stated
    columns : names of the columns in the order of the table, such as ("x", "y", "z"), or ("x", "z") for a profile.
        Columns with other quantities have the name "". None if no heading names the columns
    missing : numbers that mark missing points
    mentions : (line, unit) of the lines that hold a unit of length without stating what it belongs to
    """

    unit: str
    spacing: Spacing | None
    lateral_unit: str
    columns: tuple[str, ...] | None
    missing: tuple[float, ...] = ()
    mentions: tuple[tuple[str, str], ...] = ()


class _Columns(NamedTuple):
    """Columns of a table, as their heading names them.

    names : "x", "y" or "z" for each column; "" for a column that holds neither positions nor heights
    units : {name of a column: its unit}, for columns whose heading states a unit
    """

    names: tuple[str, ...]
    units: dict[str, str]


class _Length(NamedTuple):
    """Length that a line of the header states for one axis: the spacing of the points or the extent of the map.

    line : the line of the header
    axis : 0 for x, 1 for y
    is_extent : True for an extent of the map, False for a spacing
    number : value of the length in `unit`
    unit : unit of the length; "" if it is not stated
    """

    line: str
    axis: int
    is_extent: bool
    number: float
    unit: str


def states(line: str) -> bool:
    """Return True if a line of text states a length, a unit or the name of a map."""
    return bool(_title(line)) or any(role != "missing" for role, _, _ in _stated_in(line))


def is_statement(line: str) -> bool:
    """Return True if a line above a table is a statement or a title, and therefore no row with a misprint."""
    return bool(_title(line) or _stated_in(line))


def read_header(lines: Sequence[str], shape: tuple[int, ...], decimal: str, profile_columns: int = 0) -> Header:
    """Return the units, spacing and columns that the lines of text around a table of numbers state, as a Header.

    lines : lines above the table, and comments in and below the table
    shape : rows and columns of the table
    decimal : decimal mark of the table. If it is a comma, "1,234" is read as 1.234
    profile_columns : number of columns of the table if it holds a profile, whose points lie along x; 0 for a map

    Raises ValueError for statements that contradict each other or have two meanings, and for the heading of a profile
    above a map.
    """
    stated, unknown, others = _statements(lines)
    count = profile_columns or shape[1]
    titles = [] if profile_columns > 1 else [(line, unit) for line in others if (unit := _title(line))]
    others = [line for line in others if line not in [title for title, _ in titles]]
    stated["unit z"] += [(line.strip()[:80], "", unit) for line, unit in titles]
    columns = _heading_of_columns(others, count, is_profile=profile_columns > 0)

    def stated_unit(role: str, *axes: str) -> str:
        headed = [] if columns is None else [columns.units.get(axis, "") for axis in axes]
        return _agreed([*(_unit_text(value) for _, _, value in stated[role]), *headed])

    spacing, lateral = _spacing(stated, shape, stated_unit("unit xy", "x", "y"), decimal)
    unit = stated_unit("unit z", "z") or stated_unit("unit")
    names = None if columns is None else columns.names
    mentions = tuple(mention for line in unknown + others for mention in _mentions(line)) if columns is None else ()
    missing = tuple(float(value.replace(",", ".")) for _, _, value in stated["missing"])
    return Header(unit or units.UNKNOWN, spacing, lateral or units.UNKNOWN, names, missing, mentions)


def _statements(lines: Sequence[str]) -> tuple[Stated, list[str], list[str]]:
    """Separate statements from other lines of a header.

    Return ({role: statements}, statements with unknown keys, other lines).

    Raises ValueError for a factor by which the heights must be multiplied, and for a unit of length if the line does
    not state to which lengths the unit belongs.
    """
    stated: Stated = {role: [] for role in _ROLES}
    unknown, others = [], []
    for line in _without_json(lines):
        found = _stated_in(line)
        for role, bracket, value in found:
            stated[role].append((line.strip()[:80], bracket, value))
        if found:
            continue
        match = _STATEMENT.match(line)
        if match is None:
            others.append(line)
            if _MAY_BE_FACTOR.search(line) and re.search(r"\d", line):
                _refuse_factor(line)
            continue
        unknown.append(line)
        key, value = match[1], match[3].strip(" \t,;|\"'")
        if _FACTOR.match(key) and ("factor" in key.lower() or _LENGTH.match(value)):
            _refuse_factor(line)
        elif re.search(r"(?i)(?:units?|einheit(?:en)?|unités?)$", key) and units.is_length(_unit_text(value)):
            text = "of which lengths is not stated; 'XY units', 'Z units' are allowed"
            raise ValueError(f"header {line.strip()[:80]!r}: {text}")
    return stated, unknown, others


def _refuse_factor(line: str) -> None:
    """Raise ValueError for a line that states a factor of the heights."""
    way = f"without this line, and with {argument('scale')}, they are read"
    raise ValueError(f"header {line.strip()[:80]!r}: heights are the numbers times a factor; {way}")


def _stated_in(line: str) -> list[tuple[str, str, str]]:
    """Return [(role, unit in brackets, value)] of the statement in a line; [] for another line."""
    match = _STATEMENT.match(line)
    if match is not None:
        # "Height (nm):" without a value is a heading of the numbers below.
        role, value = _role(match[1]), match[3].strip(" \t,;|\"'")
        return [(role, match[2] or "", value)] if role and value and _suits(role, value, strict=False) else []
    text = line.replace('"', "").strip("#%/;!*\\'|, \t")
    if bracket := re.fullmatch(r"([^\[({<]+)[\[({<]\s*([^\])}>]*)[\])}>]", text):
        role = _role(bracket[1])
        return [(role, "", bracket[2])] if role.startswith("unit") else []
    for separator in (r"\s*;\s*", r"\s*\t\s*", r"\s*\|\s*", r"\s*,\s*", r"\s+"):
        words = re.split(separator, text)
        for count in range(len(words) - 1, 0, -1):
            key, value = " ".join(words[:count]), " ".join(words[count:])
            if (role := _role(key)) and role != "channel" and _suits(role, value, strict=True):
                bracket = re.search(r"[\[(]([^\])]*)[\])]\s*$", key)
                return [(role, bracket[1] if bracket else "", value)]
    return []


def _suits(role: str, value: str, *, strict: bool) -> bool:
    """Return True if a value suits the role of its key.

    strict : True if the key and its value may be words of a sentence. The value must then be a unit or a length
    """
    if role == "missing":
        return bool(re.fullmatch(_NUMBER, value))
    if not strict:
        return True
    if role.startswith("unit"):
        return units.is_length(_unit_text(value)) or units.counts_points(value)
    return bool(_LENGTH.fullmatch(value)) or (role == "step" and " x " in value)


def _without_json(lines: Sequence[str]) -> list[str]:
    """Return lines in which each JSON object is replaced by lines "key: value"; keys of nested objects are joined."""
    kept: list[str] = []
    open_lines: list[str] = []
    for line in lines:
        text = line.strip("#%/;! \t")
        if not open_lines and not text.startswith("{"):
            kept.append(line)
            continue
        open_lines.append(text)
        try:
            content = json.loads(" ".join(open_lines).replace("'", '"'))
        except ValueError:
            continue
        kept += [f"{key}: {value}" for key, value in _entries(content)] if isinstance(content, dict) else open_lines
        open_lines = []
    return kept + open_lines


def _entries(content: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (key, value) of the entries of a JSON object; a list of two numbers becomes "a x b"."""
    for key, value in content.items():
        if isinstance(value, dict):
            yield from ((f"{key} {inner}", text) for inner, text in _entries(value))
        elif isinstance(value, list):
            yield key, " x ".join(map(str, value))
        else:
            yield key, str(value)


def _title(line: str) -> str:
    """Return the unit in a title such as "Height [nm]"; "" for another line."""
    match = _TITLE.fullmatch(line.replace('"', "").strip("#%/;!*\\'|, \t"))
    return match[1] if match and units.is_length(match[1]) else ""


def _mentions(line: str) -> list[tuple[str, str]]:
    """Return [(line, unit)] of the units of length that a line holds, except for units of quantities."""
    match = _STATEMENT.match(line)
    if match and re.match(r"\s*[-+]?[\d.,]+", match[3]):
        return []
    found = [unit[1] for unit in _MENTION.finditer(line)]
    if match and units.is_length(value := match[3].strip(" \t,;|\"'[](){}<>")):
        found.append(value)
    if re.search(r"(?i)units?(?![^\W\d_])|einheit|unité", line):
        found += re.findall(r"(?<![\w'])(?:[pnuµμmc]?m)(?![\w'])", line)
    return [(line.strip()[:60], unit) for unit in found]


def _role(key: str) -> str:
    """Return the role of a key (see `_ROLES`), such as "step x" for "Pixel Size X"; "" for an unknown key."""
    compact = re.sub(r"\s*[\[(][^\])]*[\])]|[\s_.-]+", "", key.lower())
    return _ROLE_OF.get(re.sub(r"(unité?|einheit)(?:s|en)", r"\1", compact), "")


def _unit_text(value: str) -> str:
    """Return the unit in the value of a statement, without brackets; "" for a unit that counts points, such as px."""
    text = value.strip("[](){} ")
    return "" if units.counts_points(text) else text


def _agreed(texts: Iterable[str]) -> str:
    """Return the unit that all nonempty texts state, in the spelling of the first text; "" if all texts are empty.

    Raises ValueError if two texts are different units.
    """
    different = list(dict.fromkeys(filter(None, texts)))
    for other in different[1:]:
        if units.metres(different[0]) != units.metres(other):
            raise ValueError(f"header: units {different[0]} and {other} for the same lengths; one unit is needed")
    return different[0] if different else ""


def _spacing(stated: Stated, shape: tuple[int, ...], lateral: str, decimal: str) -> tuple[Spacing | None, str]:
    """Return ((dx, dy), unit), the spacing of the points, from the stated spacings and extents of the map.

    stated : statements of the header
    shape : rows and columns of the table
    lateral : unit that the header states for all lengths along x and y; "" if it states no such unit
    decimal : decimal mark of the table

    A distance dx or dy that is not stated is nan; the spacing is None if both are missing. The returned unit is
    `lateral` if the header states it. Otherwise it is "m" if the lengths have units, and "" if they have none.
    """
    points = shape[::-1]
    steps: list[list[float]] = [[], []]
    extents: list[list[float]] = [[], []]
    have_units = set()
    for length in _lengths(stated, decimal):
        if units.counts_points(length.unit):
            if length.is_extent and length.number != points[length.axis]:
                raise ValueError(f"header {length.line!r}: the table has {points[length.axis]} points there")
            continue
        unit = length.unit or lateral
        have_units.add(bool(unit))
        number = length.number * units.metres(unit) / units.metres(lateral or "m") if unit else length.number
        (extents if length.is_extent else steps)[length.axis].append(number)
    # The statement "height" without the statement "width" may be a height of the surface.
    if not (any(steps) or all(extents)):
        return None, lateral
    if len(have_units) > 1:
        raise ValueError("the header states units for some of the lengths only; one for all, or none, is needed")
    dx, dy = (_agreed_step(axis, steps[axis], extents[axis], points[axis]) for axis in (0, 1))
    return (dx, dy), lateral or ("m" if have_units == {True} else "")


def _lengths(stated: Stated, decimal: str) -> Iterator[_Length]:
    """Yield the spacings and extents that a header states. Raises ValueError if one length has two different units."""
    for role, axes in _AXES.items():
        for line, bracket, value in stated[role]:
            is_pair = role == "step" and value.count(" x ") == 1  # such as "0.5 um x 0.8 um" for dx and dy
            for axis, text in zip(axes, value.split(" x ") if is_pair else [value] * len(axes), strict=True):
                number, unit = _length(line, text, decimal)
                if unit and bracket and unit != bracket:
                    raise ValueError(f"header {line!r}: units {bracket} and {unit}; one unit is needed")
                yield _Length(line, axis, role.startswith("extent"), number, unit or bracket)


def _length(line: str, value: str, decimal: str) -> tuple[float, str]:
    """Convert the text of a length, such as "0.5 um", to (number, unit); the unit is "" if none is stated.

    line : line of the header with this length, for messages
    value : text of the length
    decimal : decimal mark of the table

    Raises ValueError for a text that is no length, and for a comma that may separate decimals or thousands.
    """
    match = _LENGTH.fullmatch(value)
    if match is None:
        raise ValueError(f"header {line!r}: not a length; a number, with or without a unit, is needed")
    text = match[1]
    if decimal != "," and re.fullmatch(r"[+-]?[1-9]\d{0,2},\d{3}", text):
        readings = f"{text.replace(',', '')} or {text.replace(',', '.')}"
        raise ValueError(f"header: {text} is {readings}; a decimal point is needed")
    return float(text.replace(",", ".")), match[2]


def _agreed_step(axis: int, steps: Sequence[float], extents: Sequence[float], count: int) -> float:
    """Return the spacing along an axis from the lengths that the header states for this axis; nan without such lengths.

    axis : 0 for x, 1 for y
    steps, extents : stated spacings, and stated extents of the map, along the axis
    count : number of points along the axis; the extent of the map is `count` or `count` − 1 spacings

    Raises ValueError if the statements do not agree.
    """
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
    """Return True if one of the lines is the heading of a profile: `count` names of columns, including x and z."""
    return any(len(cells) == count and _profile_columns(cells) for cells in (_cells(_heading(line)) for line in lines))


def _heading(line: str) -> str:
    """Return a line without comment marks, quotation marks and spaces before units: "x[um]" for "# x [um]"."""
    return re.sub(r"\s+(?=[\[(/])|(?<=/)\s+", "", line.strip("#%/;,!| \t").replace('"', ""))


def _cells(heading: str) -> list[str]:
    """Split a heading at commas, semicolons and tabs, or at spaces if the heading contains none of these."""
    return [cell.strip() for cell in re.split(r"[,;\t]" if re.search(r"[,;\t]", heading) else r"\s+", heading)]


def _heading_of_columns(lines: Sequence[str], count: int, is_profile: bool) -> _Columns | None:
    """Find the line that is the heading of a table, and return the columns that it names; None without such a line.

    count : number of columns of the table
    is_profile : True if the table holds a profile with columns x and z, False for a map with columns x, y and z

    Raises ValueError for units that are not lengths, for positions in degrees, for a second heading, for a line that
    resembles a heading but is not recognised, and for the heading of a profile above a map.
    """
    found = None
    for line in lines:
        text = _heading(line)
        columns = _columns(text, count, is_profile)
        if found is None and columns is not None:
            if wrong := next((unit for unit in columns.units.values() if not units.is_length(unit)), None):
                raise ValueError(f"heading {text[:60]!r}: {wrong!r} is no unit of length, such as um, nm or m")
            found = columns
        else:
            _check_no_heading(text, count, is_profile)
    return found


def _columns(heading: str, count: int, is_profile: bool) -> _Columns | None:
    """Read a text as the heading of `count` columns, and return the columns; None if the text is no such heading.

    Raises ValueError if the text is the heading of a profile but the table is a map.
    """
    cells = _cells(heading)
    if len(cells) != count:
        return None
    profile = _profile_columns(cells)
    if profile and not is_profile:
        text = f"heading {heading[:60]!r}: positions and heights of a profile"
        raise ValueError(f"{text}; {spelled('viscorough reduce', 'read_line')} reads it, a map has columns x, y, z")
    return profile if is_profile else _map_columns(cells)


def _check_no_heading(text: str, count: int, is_profile: bool) -> None:
    """Raise ValueError if a text may be a heading that was not recognised, or if it names positions in degrees."""
    words = set(re.split(r"[\W\d_]+", text.lower()))
    if words & _DEGREES:
        raise ValueError(f"heading {text[:60]!r}: positions in degrees; lengths x and y are needed")
    cells = _cells(text)
    only_units = len(cells) == count > 1 and all(map(units.is_length, cells))
    has_unit_in_brackets = any(map(units.is_length, re.findall(r"[\[(]([^\W\d]\w*)[\])]", text)))
    names, example = ({"x", "z"}, "x [um], z [nm]") if is_profile else ({"x", "y", "z"}, "x [um], y [um], z [nm]")
    # In a table with more columns, a unit in brackets belongs to no column; it is listed as a mention.
    if only_units or (has_unit_in_brackets and (is_profile or count == 3)) or words >= names:
        text = f"header {text[:60]!r}: which columns and units these are is not stated"
        raise ValueError(f"{text}; one heading, such as {example!r}, is allowed")


def _map_columns(cells: Sequence[str]) -> _Columns | None:
    """Return the columns of a heading that names x, y and z in any order; None for another heading.

    cells : names in the heading, perhaps with units. Names of further columns are allowed
    """
    matches = [_COLUMN.fullmatch(cell) for cell in cells]
    # If the first two of three columns are x and y, the third column is z under another name.
    if [m and m[1].lower() for m in matches] == ["x", "y", None]:
        matches[2] = _COLUMN.fullmatch(re.sub(r"^[^\W\d_][^\[(/_]*", "z", cells[2]))
    names = tuple(match[1].lower() if match else "" for match in matches)
    if sorted(filter(None, names)) != ["x", "y", "z"]:
        return None
    stated = {match[1].lower(): match[2] for match in matches if match and match[2] is not None}
    return _Columns(names, stated)


def _profile_columns(cells: Sequence[str]) -> _Columns | None:
    """Return the columns of a heading that names positions x and heights z of a profile; None for another heading.

    If the only names are y and z, y are the positions. If the only names are x and y, y are the heights.

    cells : names in the heading, perhaps with units
    """
    matches = [_PROFILE_COLUMN.fullmatch(cell) for cell in cells]
    names = [next(name for name in "xyz" if match[name]) if match else "" for match in matches]
    if sorted(names) == ["y", "z"] or sorted(names) == ["x", "y"]:
        names[names.index("y")] = "x" if "z" in names else "z"
    if sorted(filter(None, names)) != ["x", "z"]:
        return None
    pairs = zip(names, matches, strict=True)
    stated = {name: match["unit"] for name, match in pairs if match and match["unit"] is not None}
    return _Columns(tuple(names), stated)
