"""What the header of a text file states: the spacing of the points, units of lengths, names of columns.

A statement is "key: value" or "key = value", several to a line if commas, semicolons or tabs part them; its unit stands
behind the number or in brackets behind the key. Keys are compared without spaces, hyphens, underscores and case. A key
that is not known states nothing, so that "Camera pixel size" is not taken for the distance of the points; but a unit of
length whose meaning is not known is refused, and so is what can be read in two ways.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from viscorough import units

Stated = dict[str, list[tuple[str, str, str]]]  # what a header states, by role: line, unit in brackets, value

_AGREEMENT = 1e-3  # relative difference up to which statements of the same length agree
_ROUNDING = 5e-3  # the same for a width and a distance of points, which are rounded to few digits

# Atomic groups: a number or a unit is taken whole, or not at all.
_NUMBER = r"(?>[+-]?(?:\d+(?:[.,]\d+|\.)?|[.,]\d+)(?:[eEdD][+-]?\d+)?)"
_UNIT = r"(?>(?:(?!(?:x|by|and|und|et)(?:\b|\d))[^\W\d][^\s,;()\[\]{}×]*|[\"'°%])?)"
_LENGTH = rf"({_NUMBER})[ \t]*[(\[]?({_UNIT})[)\]]?"
_BETWEEN = r"\s*(?:x|×|\*|by|,|;)\s*"
_END = r"(?!\s*[-+.,'’^*]?\d)"
_ONE = re.compile(rf"[(\[]?\s*{_LENGTH}{_END}")
_PAIR = re.compile(rf"([(\[]?)\s*{_LENGTH}({_BETWEEN}){_LENGTH}\s*({_UNIT}){_END}")
_STATEMENT = re.compile(
    r"(?:^|[,;\t|])[\s#%/;!*\"'|]*([^\W\d_][^:=,;\t|()\[\]\"]*?)\s*(?:[(\[]([^)\]]*)[)\]])?\"?\s*[:=]\s*"
)
_KEY_WITH_UNIT = re.compile(r"(.*\w)\s*(?:\s+in\s+|/\s*)(\S+)")
_AXIS = re.compile(
    r"([xyz])(?:pos|position|coord|coordinate|axis|achse|koordinate|value|wert)?|height|höhe|hauteur|elevation"
)
_OTHER_LANGUAGE = re.compile(r"(?i)breite|höhe|kanal|einheit|größe|abstand|largeur|hauteur|canal|unité|taille")


def _keys(template: str) -> dict[str, set[str]]:
    """The spellings of a key in a text, by axis: a before it or behind it, as in "x pixel size" and "pixel size x"."""
    return {a: {f"{a}{key}" for key in template.split()} | {f"{key}{a}" for key in template.split()} for a in "xy"}


_STEPS = (
    "pixelsize pixelspacing pointspacing samplespacing spacing step stepsize pitch increment pixelgröße pixelabstand d"
)
_EXTENTS = "size scansize scanrange range length extent"
_STEP = "pixelsize pixelspacing pointspacing samplespacing gridspacing lateralspacing spacing pixelgröße pixelabstand"
_ROLES = {
    "step x": _keys(_STEPS)["x"] | {"deltax", "pixelwidth", "pixelbreite"},
    "step y": _keys(_STEPS)["y"] | {"deltay", "pixelheight", "pixelhöhe"},
    "step": set(_STEP.split()) | {"tailledepixel", "tailledupixel", "taillepixel", "cellsize"},
    "extent x": _keys(_EXTENTS)["x"] | {"width", "breite", "largeur", "scanwidth", "imagewidth"},
    "extent y": _keys(_EXTENTS)["y"] | {"height", "höhe", "hoehe", "hauteur", "scanheight", "imageheight"},
    "extent": {"scansize", "scanrange", "scanarea", "imagesize"},
    "unit z": {"zunit", "unitz", "valueunit", "heightunit", "dataunit", "werteinheit", "zeinheit", "einheitz"}
    | {"höheneinheit", "unitédevaleur", "unitédesvaleurs", "unitéz", "unitédez", "unitédehauteur", "verticalunit"},
    "unit x": {"xunit", "unitx", "xeinheit", "einheitx", "unitéx"},
    "unit y": {"yunit", "unity", "yeinheit", "einheity", "unitéy"},
    "unit xy": {"lateralunit", "xyunit", "x/yunit", "x,yunit", "horizontalunit", "lateraleeinheit", "lateraleinheit"}
    | {"xyeinheit", "unitélatérale", "unitéxy"},
    "unit": {"unit", "lengthunit", "unitoflength", "einheit", "längeneinheit", "unité"},
    "factor": {"heightconversionfactor"},
    "channel": {"channel", "kanal", "canal", "datachannel"},
}
_ROLE_OF = {key: role for role, keys in _ROLES.items() for key in keys}


class Header(NamedTuple):
    """What a header states.

    spacing : (dx, dy), in the unit spacing_unit; None if it states none, nan for a direction of which it states none
    spacing_unit, lateral_unit : of the spacing, and of positions x and y; "1" if it states none, "px" for numbers of
        points
    unit, factor : heights are the numbers in the file times the factor, in this unit; "1" if it states none
    columns : names of the columns of points in their order, such as ("x", "y", "z"); None if it states none
    """

    spacing: tuple[float, float] | None
    spacing_unit: str
    lateral_unit: str
    unit: str
    factor: float
    columns: tuple[str, ...] | None


def states(line: str) -> bool:
    """Whether a line states a length, a unit or the name of a map."""
    return any(role for role, *_ in _statements([line]))


def read_header(lines: Sequence[str], shape: tuple[int, ...], delimiter: str | None, decimal: str) -> Header:
    """The Header in lines of text above, below and beside a table of that shape.

    delimiter, decimal : of the table; a decimal comma there makes "1,234" a number below two

    Raises ValueError for statements that contradict each other or can be read in two ways.
    """
    lines = [line for line in lines if line.strip()]
    statements = _statements(lines)
    columns, units_of_columns = _headings(lines, shape, delimiter)
    comma = decimal == "," or any(_OTHER_LANGUAGE.search(line) for line in lines)
    stated: Stated = {role: [] for role in _ROLES}
    for role, line, unit, value in statements:
        if role:
            stated[role].append((line, unit, value))
        elif _has_unit_of_unknown_meaning(line, value):
            text = "of which lengths is not stated; 'x units', 'y units', 'z units' are allowed"
            raise ValueError(f"header {line!r}: {text}")

    def unit_among(*roles: str, of_column: str = "") -> str:
        texts = [_unit_text(value) for role in roles for _, _, value in stated[role]]
        return _agreed([text for text in [*texts, of_column] if not units.counts_points(text)])

    factor, unit = 1.0, ""
    for line, bracket, value in stated["factor"]:
        factor, unit = _lengths(line, "", value, comma)[0][0], bracket.replace("->", "").strip()
    own, general = unit_among("unit z", of_column=units_of_columns.get("z", "")), unit_among("unit")
    of_positions = [units_of_columns.get(axis, "") for axis in "xy"]
    lateral = [
        unit_among(f"unit {axis}", "unit xy", of_column=text) for axis, text in zip("xy", of_positions, strict=True)
    ]
    spacing, spacing_unit = _spacing(stated, shape, lateral, comma)
    different = lateral[0] != lateral[1] and ("" in lateral or units.metres(lateral[0]) != units.metres(lateral[1]))
    if different and spacing is None:
        raise ValueError(f"x is in {lateral[0] or 'no unit'}, y in {lateral[1] or 'no unit'}; one unit is needed")
    lateral_unit = "px" if any(map(units.counts_points, of_positions)) else lateral[0] or "1"
    return Header(spacing, spacing_unit, lateral_unit, unit or own or general or "1", factor, columns)


def _has_unit_of_unknown_meaning(line: str, value: str) -> bool:
    """Whether a statement gives a unit of length to something unknown, such as "foo units: um"."""
    key, unit = re.split(r"[:=]", line)[0].lower(), _unit_text(value)
    is_unit = re.search(r"(?:units?|einheit(?:en)?|unités?)\W*$", key) and not units.counts_points(unit)
    return bool(is_unit) and _is_unit(unit)


def _statements(lines: Sequence[str]) -> list[tuple[str, str, str, str]]:
    """The statements in lines: role or "", the text, the unit in brackets behind the key, and the value."""
    found = []
    for line in lines:
        matches = list(_STATEMENT.finditer(line))
        ends = [*(match.start() for match in matches[1:]), len(line)]
        for match, end in zip(matches, ends, strict=False):
            key, unit = match[1], match[2] or ""
            if not _role(key) and (inner := _KEY_WITH_UNIT.fullmatch(key)):
                key, unit = inner[1], unit or inner[2]
            if unit.lower() in ("x", "y"):  # "pixel size (x)"
                key, unit = key + unit, ""
            value, text = line[match.end() : end].strip(" \t,;|\"'"), line[match.start() : end].strip(" \t,;|#%/")
            found.append((_role(key), text[:80], unit, value))
    return found


def _role(key: str) -> str:
    """What a key states, one of `_ROLES`; "" if it is not known."""
    compact = re.sub(r"[\s_.-]+", "", key.lower())
    return _ROLE_OF.get(re.sub(r"(unité?|einheit)(?:s|en)", r"\1", compact), "")


def _unit_text(value: str) -> str:
    """The unit at the start of a value: "nm" of "[nm] (height)", "1e-6 m" of "1e-6 m"."""
    words = value.strip("[](){}\"' ").split()
    if not words:
        return "1"
    several = re.fullmatch(_NUMBER, words[0]) and len(words) > 1
    return " ".join(words[: 2 if several else 1]).strip("[](){}\"',;")


def _agreed(texts: Iterable[str]) -> str:
    """The unit in texts, which may spell it differently; "" for none. Raises ValueError if they are different units."""
    different = list(dict.fromkeys(text for text in texts if text not in ("", "1")))
    for other in different[1:]:
        if units.metres(different[0]) != units.metres(other):
            raise ValueError(f"header: units {different[0]} and {other} for the same lengths; one unit is needed")
    return different[0] if different else ""


def _number(text: str, comma: bool) -> float:
    """A number of a header. Raises ValueError if its comma may be a decimal mark or part thousands."""
    if "," in text and not comma and re.fullmatch(r"[+-]?[1-9]\d{0,2},\d{3}", text):
        readings = f"{text.replace(',', '')} or {text.replace(',', '.')}"
        raise ValueError(f"header: {text} is {readings}; a decimal point is needed")
    return float(text.replace(",", ".").replace("D", "e").replace("d", "e"))


def _lengths(line: str, unit: str, value: str, comma: bool) -> list[tuple[float, str]]:
    """[(number, unit)] of a statement, one or two. Raises ValueError for what cannot be read for certain."""
    if match := _PAIR.match(value):
        _, first, unit_first, between, second, unit_second, behind = match.groups()
        if "," in between and between.strip() == between and not match[1] and ("." in first) != ("." in second):
            raise ValueError(f"header {line!r}: one number or two; a decimal point, or spaces, are needed")
        unit_second = unit_second or behind or unit
        return [(_number(first, comma), unit_first or unit_second), (_number(second, comma), unit_second or unit_first)]
    match = _ONE.match(value)
    if match is None:
        raise ValueError(f"header {line!r}: not a length; a number, with or without a unit, is needed")
    own = re.sub(r"/(?:px|pixel|point)$", "", match[2], flags=re.IGNORECASE)
    if own and unit and unit != own:
        raise ValueError(f"header {line!r}: units {unit} and {own}; one unit is needed")
    return [(_number(match[1], comma), own or unit)]


def _spacing(
    stated: Stated, shape: tuple[int, ...], lateral: Sequence[str], comma: bool
) -> tuple[tuple[float, float] | None, str]:
    """((dx, dy), unit) that statements give; (None, "1") for none; nan for a direction without statement."""
    steps: list[list[tuple[float, str]]] = [[], []]
    extents: list[list[tuple[float, str]]] = [[], []]
    axes_of = {"step x": (0,), "step y": (1,), "step": (0, 1), "extent x": (0,), "extent y": (1,), "extent": (0, 1)}
    for role, axes in axes_of.items():
        for line, bracket, value in stated[role]:
            if bracket and not re.match(rf"\s*[(\[]?\s*{_NUMBER}", value):
                continue  # "Height (nm):" heads numbers below
            lengths = _lengths(line, bracket, value, comma)
            if len(lengths) == 2 and len(axes) == 1:
                raise ValueError(f"header {line!r}: two lengths for one direction; one is needed")
            if role == "extent" and len(lengths) == 1 and shape[0] != shape[1]:
                continue  # of which side is not said
            for place, axis in enumerate(axes):
                number, unit = lengths[place % len(lengths)]
                if units.counts_points(unit):
                    if role.startswith("extent") and number != shape[1 - axis]:
                        raise ValueError(f"header {line!r}: the table has {shape[1 - axis]} points there")
                else:
                    (extents if role.startswith("extent") else steps)[axis].append((number, unit or lateral[axis]))
    if not (any(steps) or all(extents)):  # a height alone may be one of the heights
        return None, "1"
    unit = next((unit for axis in (0, 1) for _, unit in steps[axis] + extents[axis] if unit), "")
    dx, dy = (_agreed_step(axis, steps[axis], extents[axis], shape[1 - axis], unit) for axis in (0, 1))
    return (dx, dy), unit or "1"


def _agreed_step(
    axis: int, steps: Iterable[tuple[float, str]], extents: Iterable[tuple[float, str]], count: int, unit: str
) -> float:
    """The distance of points along an axis, in a unit, from statements that must agree; nan for none."""

    def converted(lengths: Iterable[tuple[float, str]]) -> Iterator[float]:
        for number, own in lengths:
            if unit and not own:
                raise ValueError("the header states a unit for one direction only; one for both, or none, is needed")
            yield number * units.metres(own) / units.metres(unit) if unit and own != unit else number

    name = "columns" if axis == 0 else "rows"
    steps, extents = list(converted(steps)), list(converted(extents))
    for a in steps:
        if abs(a - steps[0]) > _AGREEMENT * abs(steps[0]):
            raise ValueError(f"header: {name} are {steps[0]:g} or {a:g} {unit} apart; statements that agree are needed")
    for extent in extents:
        if not steps:
            if abs(extent - extents[0]) > _AGREEMENT * abs(extents[0]):
                text = f"{name} extend over {extents[0]:g} or {extent:g} {unit}"
                raise ValueError(f"header: {text}; one extent is needed")
        elif min(abs(extent / n - steps[0]) for n in (count, max(count - 1, 1))) > _ROUNDING * abs(steps[0]):
            text = f"{name} are {steps[0]:g} {unit} apart, {count} of them extend over {extent:g} {unit}"
            raise ValueError(f"header: {text}; statements that agree are needed")
    if not (steps or extents):
        return float("nan")
    return float(f"{steps[0] if steps else extents[0] / count:.14g}")


def _headings(
    lines: Sequence[str], shape: tuple[int, ...], delimiter: str | None
) -> tuple[tuple[str, ...] | None, dict[str, str]]:
    """(names of the columns in their order or None, {name: unit}) of a line that heads columns x, y and z, or heights.

    Raises ValueError for degrees, units that are none of length, and headings that differ.
    """
    names: tuple[str, ...] | None = None
    found: dict[str, str] = {}
    for number, line in enumerate(lines):
        cells = _cells(line, delimiter)
        axes = [_axis(cell) for cell in cells]
        heads_points = len(cells) == shape[1] and all(axes.count(name) == 1 for name in "xyz")
        if not heads_points and not (axes == ["z"] and _unit_of_heading(cells[0])):
            if not _STATEMENT.search(line) and any(map(_is_unit, re.findall(r"[\[(]\s*([^\W\d]\w*)\s*[\])]", line))):
                text = "of which lengths these are the units is not stated; 'x [um], y [um], z [nm]' is allowed"
                raise ValueError(f"header {line.strip()[:60]!r}: {text}")
            continue
        if heads_points:
            if names not in (None, tuple(axes)):
                raise ValueError(f"header: columns are {', '.join(names)} or {', '.join(axes)}; one heading is needed")
            names = tuple(axes)
        texts = [_unit_of_heading(cell) for cell in cells]
        below = [cell.strip("[]()") for cell in _cells(lines[number + 1], delimiter)] if number + 1 < len(lines) else []
        if not any(texts) and len(below) == len(cells) and all(map(_is_unit, below)):
            texts = below
        for name, text in zip(axes, texts, strict=True):
            if name and text and not _is_unit(text):
                raise ValueError(f"heading {line.strip()[:60]!r}: {text!r} is no unit of length, such as um, nm or m")
            if name and text and found.setdefault(name, text) != text:
                raise ValueError(f"header: {name} is in {found[name]} or {text}; one unit is needed")
    return names, found


def _cells(line: str, delimiter: str | None) -> list[str]:
    """The headings in a line, each with its unit."""
    line = line.strip().lstrip("#%/;! \t").replace('"', "")
    if delimiter is None or delimiter not in line:
        line = re.sub(r"\s+(?=[\[(/])|(?<=/)\s+", "", line)
        line = re.sub(r"(?<=\w)\s+in\s+(?=\w)", "/", line)
        delimiter = next((mark for mark in (r"\s*[,;\t]\s*", r"\s{2,}") if re.search(mark, line)), r"\s+")
    else:
        delimiter = re.escape(delimiter)
    return [cell.strip() for cell in re.split(delimiter, line)]


def _axis(cell: str) -> str:
    """Which of x, y and z a heading names; "" for none. Raises ValueError for longitude and latitude."""
    for word in re.split(r"[\W_]+", re.split(r"[\[(/]", cell.lower())[0]):
        if match := _AXIS.fullmatch(word):
            return match[1] or "z"
        if word in ("lon", "lat", "longitude", "latitude", "long", "länge", "breitengrad", "längengrad"):
            raise ValueError(f"heading {cell!r}: positions in degrees; lengths x and y are needed")
    return ""


def explicit_unit(heading: str) -> str | None:
    """The unit in a heading such as "x [um]", "x (um)", "x/um" or "x in um"; None for other headings."""
    match = re.search(r"[\[(]([^\])]*)[\])]|/\s*(.+)$|\bin\s+(\S+)$", heading)
    return next(text for text in match.groups() if text is not None).strip() if match else None


def _unit_of_heading(cell: str) -> str:
    """The unit in a heading, also as its last word, as in "x_um"; "" for none."""
    if unit := explicit_unit(cell):
        return unit
    words = re.split(r"[\s_]+", cell)
    return words[-1] if len(words) > 1 and not _axis(words[-1]) and _is_unit(words[-1]) else ""


def _is_unit(text: str) -> bool:
    """Whether a text is a unit of length, or counts points."""
    try:
        return units.counts_points(text) or bool(units.length_unit(text))
    except ValueError:
        return False
