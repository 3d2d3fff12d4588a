"""Write random text files of given maps, as instruments and programs do; for file_campaign.py.

A file is a matrix of heights, the points x, y, z of a grid, an ESRI ASCII grid, or a profile, which is a line and no
map. Random choices are the notation of numbers, delimiters, decimal marks, marks of missing points, header, comments,
encoding and ends of lines. In text_files.yaml, "clear" headers are unambiguous, "unclear" headers may be refused, and
"bad" headers must be refused.
"""

import re
from pathlib import Path

import numpy as np
import yaml
from file_cases import UNITS, Case, Draft, distances, map_shape, missing_points

# ---- numbers, delimiters, marks of missing points

FORMATS = {
    "fixed": lambda value, decimals: f"{value:.{decimals}f}",
    "integers": lambda value, _: f"{value:.0f}",
    "%g": lambda value, _: f"{value * 1e-7:.6g}",
    "exponents": lambda value, _: f"{value * 1e-7:.5e}",
    "capital exponents": lambda value, _: f"{value:.3E}",
    "plus signs": lambda value, decimals: f"{value:+.{decimals}f}",
    "no leading zero": lambda value, _: re.sub(r"^(-?)0\.", r"\1.", f"{value:.2f}"),
}
ODD_FORMATS = {
    "D exponents": lambda value, _: f"{value:.4e}".replace("e", "D"),
    "U+2212": lambda value, _: f"{value:.3f}".replace("-", "\u2212"),
    "thousands": lambda value, _: f"{1000 * value:,.2f}",
    "thousands with apostrophes": lambda value, _: f"{1000 * value:,.2f}".replace(",", "'"),
    "thousands with thin spaces": lambda value, _: f"{1000 * value:,.2f}".replace(",", "\u202f"),
}
PLAIN = str.maketrans({"\u2212": "-", "D": "e", **dict.fromkeys(",'\u202f")})
SWAPPED = str.maketrans(".,", ",.")
DELIMITERS = {"space": " ", "spaces": "   ", "aligned": " ", "tab": "\t", "comma": ",", "semicolon": ";"}
DELIMITERS |= {"comma and space": ", ", "semicolon and space": "; "}
ODD_DELIMITERS = {"pipe": "|", "spaced pipe": " | ", "tab and space": "\t ", "spaced semicolon": " ; "}
MARKS = ("nan", "NaN", "NAN", "NA", "N/A", "null", "BAD", "***", "--", "---", "void")
ODD_MARKS = ("None", "-", "?", "#N/A", "#NV", "n.a.", "masked", "<0.1", "NULL", "n/a", "*", "missing", ".", "x", "±")
ODD_MARKS += ("#DIV/0!", "1.#QNAN", "-nan(ind)", "----", "fehlt")
NUMBER_MARKS = ("-9999", "-99999", "-32768", "1e38")


def printed(draft, shape, odd=0.1):
    """Return numbers as they are printed, with a decimal point, and their values."""
    form, decimals = draft.pick(FORMATS, ODD_FORMATS, odd=odd), int(draft.random.integers(1, 7))
    cells = [[form(value, decimals) for value in row] for row in draft.random.normal(0, 30, shape)]
    return cells, np.array([[float(cell.translate(PLAIN)) for cell in row] for row in cells])


def matrix_rows(draft, shape):
    """Return (rows of text, heights, delimiter, has decimal commas, options) of a matrix with missing points."""
    cells, heights = printed(draft, shape)
    quoted, grouped = draft.chance(0.08), {"thousands", "thousands with thin spaces"} & set(draft.traits)
    delimiter = draft.pick({"semicolon": ";"} if grouped else DELIMITERS, [] if grouped else ODD_DELIMITERS, odd=0.06)
    has_comma = delimiter.strip() == ","
    # Decimal commas between plain commas are ambiguous, unless in quotes.
    decimal_comma = draft.chance(0.3) and not {"integers", "D exponents"} & set(draft.traits)
    decimal_comma &= delimiter != "," or quoted
    if decimal_comma:
        cells = [[cell.translate(SWAPPED) for cell in row] for row in cells]
        draft.note("decimal commas", clear=not has_comma and _are_decimals(cells, delimiter))
    elif has_comma and "integers" in draft.traits:
        digits = {len(cell) for row in cells for cell in row[1:]}
        draft.note("", clear=shape[1] > 2 and digits != {3})  # otherwise they may be decimals or thousands
    mask, options = missing_points(draft, shape), {}
    if mask.any():
        mark = _mark(draft, delimiter, mask)
        cells = [[mark if mask[i, j] else cell for j, cell in enumerate(row)] for i, row in enumerate(cells)]
        if mark in NUMBER_MARKS and draft.chance(0.5):
            draft.note("nodata given")
            options["nodata"] = float(mark)
        heights[mask] = float(mark) if mark in NUMBER_MARKS and not options else np.nan
    if quoted:
        draft.note("quotes", clear=bool(delimiter.strip(" ")))
        cells = [[f'"{cell}"' for cell in row] for row in cells]
    width = max(len(cell) for row in cells for cell in row) if "aligned" in draft.traits else 0
    rows = [delimiter.join(cell.rjust(width) for cell in row) for row in cells]
    if draft.chance(0.06):
        draft.note("trailing delimiters")
        rows = [row + delimiter for row in rows]
    elif draft.chance(0.02) and delimiter.strip(" "):
        draft.note("leading delimiters", clear=False)
        rows = [delimiter + row for row in rows]
    return rows, heights, delimiter, decimal_comma, options


def _are_decimals(cells, delimiter):
    """Return True if commas in numbers cannot be taken for thousands separators or delimiters."""
    numbers = [cell for row in cells for cell in row]
    if all(re.fullmatch(r"[+-]?[1-9]\d{0,2},\d{3}", number) for number in numbers):
        return False
    return bool(delimiter.strip(" ")) or all(re.search(r"\d,\d", number) for number in numbers)


def _mark(draft, delimiter, mask):
    """Return the mark of missing points; an empty cell only if a delimiter shows it."""
    rows_missing = mask.all(axis=1)
    at_an_end = rows_missing[0] or rows_missing[-1]
    if delimiter.strip(" ") and draft.chance(0.55) and not (mask[:, 0].all() or mask[:, -1].all()):
        blank = rows_missing.any() and (delimiter.isspace() or at_an_end)  # spreadsheets leave such cells below a table
        draft.note("empty cells", clear=not blank)
        return ""
    if draft.chance(0.08):
        return draft.pick(NUMBER_MARKS)
    mark = draft.pick(MARKS, ODD_MARKS, odd=0.2)
    if rows_missing.any() and mark.lower() != "nan":  # the mark may look like a title or a rule
        draft.note("row of marks", clear=mark.isalpha() and not at_an_end)
    return mark


# ---- headers, remarks, comments

PIXELS = ("px", "pixel", "pixels", "points", "Pixel", "pts", "dots")  # not lengths
HEADERS = {
    kind: {name: lines for name, *lines in (line.split(" | ") for line in table.splitlines())}
    for kind, table in yaml.safe_load(Path(__file__).with_suffix(".yaml").read_text(encoding="utf-8")).items()
}
ODD_FORMS = HEADERS["unclear"] | HEADERS["other forms"]
HEADERS_WITH_SPACING = HEADERS["Gwyddion"] | HEADERS["clear"], ODD_FORMS, HEADERS["bad"]
OTHER_HEADERS = (
    {"no header": []} | HEADERS["without spacing"],
    HEADERS["with pixels"] | HEADERS["other forms of the unit"],
)
REMARKS = (
    *("Measured with a profilometer", "Messung vom Labor, Probe B", "Mesure de la surface, échantillon C"),
    *("Date: 2024-05-01 10:11:12", "Operator: A. Meier", "Temperature: 23 °C", "Objective: 50x", "Filter = none"),
)
ODD_REMARKS = ("Tip radius: 10 nm", "Scan rate: 1.0 Hz", "Scan speed: 2 um/s", "2024-05-01 10:11", "# 1 2 3", "Unit 7")
COMMENTS = {"#": "# ", "#, no space": "#", "%": "% ", "//": "// ", "unmarked header": ""}
ODD_COMMENTS = {"comments ;": "; ", "comments !": "! ", "comments *": "* "}


def header_lines(draft, shape, decimal_comma):
    """Return (lines, unit of the heights in metres or None, spacing as in Case, options) of a header or none.

    decimal_comma : True if numbers of the table, and therefore of the header, have decimal commas
    """
    u, z = (draft.one_of(["um", "um", "nm", "mm", "m", "µm", *UNITS]) for _ in range(2))
    states_spacing, options = draft.chance(0.6), {}
    lines = draft.pick(*(HEADERS_WITH_SPACING if states_spacing else OTHER_HEADERS), odd=0.2)
    dx, dy = distances(draft, square=any("{k" in line for line in lines))
    in_z = states_spacing and not any("{u}" in line for line in lines)
    unit = UNITS[z] if any("{z}" in line for line in lines) else None
    if unit is None and not states_spacing and draft.chance(0.4):
        draft.note("unit given")
        options["unit"] = draft.one_of(["m", "mm", "um", "nm"])
        unit = UNITS[options["unit"]]
    elif unit is not None and draft.chance(0.04):
        options["unit"] = draft.one_of(["m", "mm", "um", "nm"])
        draft.note("unit given, too", bad=UNITS[options["unit"]] != unit)
    scale = UNITS[z if in_z else u] if states_spacing else unit or 1
    spacing = dx * scale, dy * scale
    # A header that states the spacing must be clear: a reader that does not understand it may use the argument.
    if draft.clear and draft.chance(0.1) if states_spacing else draft.chance(0.95):
        factor = draft.one_of([1, 1.1]) if states_spacing else 1
        draft.note("spacing given, too" if states_spacing else "", bad=factor > 1)
        options["spacing"] = tuple(float(f"{factor * distance / (unit or 1):.12g}") for distance in spacing)
    elif not states_spacing:
        draft.note("no spacing at all", bad=True)
    numbers = {"dx": dx, "dy": dy, "dx2": 3 * dx, "k": dx, "kz": dx if in_z else dx * UNITS[u] / UNITS[z]}
    numbers |= {"z_factor": 1e-3, "w": round(dx * shape[1], 9), "h": round(dy * shape[0], 9)}
    texts = {name: f"{value:.15g}" for name, value in numbers.items()}
    if lines and (decimal_comma or draft.chance(0.04)):
        texts = {name: text.replace(".", ",") for name, text in texts.items()}
        listed = any(re.search(r"\}[^{]*[,;].*\{", line) for line in lines)
        draft.note("decimal commas in the header", clear=decimal_comma and not listed)
    if len(lines) > 1 and draft.chance(0.25):
        lines = list(draft.random.permutation(lines))
        draft.note("header in another order")
    texts |= {"u": u, "z": z, "p": draft.one_of(PIXELS), "columns": shape[1], "rows": shape[0]}
    return [line.format(**texts) for line in lines], unit, spacing, options


def with_header(draft, header, rows, delimiter, columns):
    """Return the lines of a file: header, remarks, names of columns, rows, comments."""
    lines = list(header)
    if draft.chance(0.2):
        remark = draft.pick(REMARKS, ODD_REMARKS, odd=0.2)
        lines.insert(int(draft.random.integers(len(lines) + 1)), remark)
    mark = draft.pick(COMMENTS, ODD_COMMENTS, odd=0.05) if lines else "# "
    lines = [mark + line for line in lines]
    if columns > 2 and draft.chance(0.04) and delimiter.strip() and '"' not in rows[0]:
        draft.note("names of columns")
        lines.append(delimiter.join("ABCDEFGHIJKLMNOP"[:columns]))
    if lines and draft.chance(0.15):
        lines.append("")
    return lines + _with_comments(draft, rows, mark if mark.strip() in ("#", "%", "//") else "# ")


def _with_comments(draft, rows, mark):
    """Return rows with comments between, after or behind them, or with blank lines between them."""
    at = int(draft.random.integers(1, len(rows) + 1))
    forms = {
        "comments between": [*rows[:at], f"{mark}line {at}", *rows[at:]],
        "comments after": [*rows, "", f"{mark}end of data"],
        "comment behind": [*rows[: at - 1], f"{rows[at - 1]} # checked", *rows[at:]],
    }
    odd_forms = {
        "text between": [*rows[:at], "second part", *rows[at:]],
        "text after": [*rows, "End of data"],
        "blank lines between": [line for row in rows for line in (row, "")],
    }
    return draft.pick(forms, odd_forms, odd=0.25) if rows[at - 1].strip() and draft.chance(0.25) else rows


# ---- whole files

# The content decides how a file is read. The last suffixes are those of binary files.
SUFFIXES = (
    ".txt",
    ".csv",
    ".dat",
    ".asc",
    ".TXT",
    ".tsv",
    "",
    ".prn",
    ".grd",
    ".001",
    ".out",
    ".map",
    ".sdf",
    ".spm",
    ".mat",
)
ENCODINGS = ("utf-8", "utf-8-sig", "latin-1", "cp1252", "utf-16")
LINE_ENDS = {"LF": "\n", "CR LF": "\r\n", "CR": "\r"}


def encoded(draft, lines):
    """Return the bytes of a text file of these lines."""
    end = draft.pick(LINE_ENDS, {"CR CR LF": "\r\r\n"}, odd=0.03)
    text = end.join(lines) + draft.pick({"": end, "no final line end": "", "blank lines at the end": 3 * end})
    encoding = "utf-8" if draft.chance(0.6) else draft.pick(ENCODINGS, ["utf-16-le", "utf-16-be"], odd=0.02)
    try:
        return text.encode(encoding)
    except UnicodeEncodeError:
        return text.encode()


def matrix(random):
    """Draw a matrix of heights with or without a header."""
    draft = Draft(random)
    rows, columns = shape = map_shape(draft)
    if draft.chance(0.015):
        columns = 1
        draft.note("a single column", clear=False)
        heights = np.round(draft.random.normal(0, 9, (rows, 1)), 3)
        lines, delimiter, decimal_comma, preparation = [f"{value:.3f}" for value in heights[:, 0]], ";", False, {}
    else:
        lines, heights, delimiter, decimal_comma, preparation = matrix_rows(draft, shape)
    header, unit, spacing, options = header_lines(draft, heights.shape, decimal_comma)
    if min(heights.shape) <= 2:  # may be a profile, unless two spacings are given
        draft.note("few rows or columns", bad="spacing" not in options)
    lines = with_header(draft, header, lines, delimiter, columns)
    name = "map" + draft.one_of(SUFFIXES)
    return Case(draft, "matrix", name, encoded(draft, lines), heights, unit, spacing, options | preparation)


# Headings of the columns, with the unit {u} of x and y and the unit {z} of the heights.
HEADINGS = {
    "no heading": "",
    "x,y,z": "x|y|z",
    "x [u]": "x [{u}]|y [{u}]|z [{z}]",
    "X (u)": "X ({u})|Y ({u})|Z ({z})",
    "x/u": "x/{u}|y/{u}|z/{z}",
    "x_u": "x_{u}|y_{u}|z_{z}",
    "Gwyddion": "",
}
ODD_HEADINGS = {
    "x in u": "x in {u}|y in {u}|z in {z}",
    "x u": "x {u}|y {u}|z {z}",
    "Position x": "Position x [{u}]|Position y [{u}]|Höhe [{z}]",
    "height": "x [{u}]|y [{u}]|height [{z}]",
    "units below": "x|y|z",
    "y before x": "y [{u}]|x [{u}]|z [{z}]",
    "z first": "z [{z}]|x [{u}]|y [{u}]",
    "a fourth column": "x [{u}]|y [{u}]|z [{z}]|I [1]",
}
BAD_HEADINGS = {
    "z in volts": "x [{u}]|y [{u}]|z [V]",
    "x in seconds": "x [s]|y [s]|z [{z}]",
    "unit of z only": "x|y|z [{z}]",
    "no unit of z": "x [{u}]|y [{u}]|z",
    "longitude": "longitude|latitude|elevation",
}
ORDERS = {"y before x": (1, 0, 2), "z first": (2, 0, 1), "a fourth column": (0, 1, 2, 2)}


def points(random):
    """Draw columns x, y, z of the points of a grid, in any order; missing points are left out or marked."""
    draft = Draft(random)
    shape = map_shape(draft)
    cells, heights = printed(draft, shape, odd=0)
    delimiter = draft.pick({"space": " ", "tab": "\t", "comma": ",", "semicolon": ";", "comma and space": ", "})
    spacing, (x, y), accuracy = _coordinates(draft, shape)
    if draft.chance(0.2) and "," not in delimiter:
        draft.note("decimal commas", clear=bool(delimiter.strip(" ")) or "integers" not in draft.traits)
        cells, (x, y) = ([[text.replace(".", ",") for text in row] for row in texts] for texts in (cells, (x, y)))
    mask, missing = draft.random.random(shape) < 0.2, draft.one_of(["all", "all", "left out", "nan", "", "No Data"])
    seen = (~mask).any(axis=0).all() and (~mask).any(axis=1).all() and (~mask).sum() > 3
    if missing == "all" or not seen or (missing == "" and not delimiter.strip()):
        mask[:] = False
    elif mask.any():
        draft.note(f"missing: {missing}", clear=missing != "No Data" or bool(delimiter.strip(" ")))
    places = [place for place in np.ndindex(shape) if not (mask[place] and missing == "left out")]
    order = draft.pick({"x fastest": places, "y fastest": sorted(places, key=lambda place: place[::-1]), "mixed": None})
    order = draft.random.permutation(places) if order is None else order[:: draft.one_of([1, -1])]
    table = [[x[j], y[i], missing if mask[i, j] else cells[i][j]] for i, j in order]
    return _points_file(draft, table, np.where(mask, np.nan, heights), spacing, delimiter, accuracy)


def _coordinates(draft, shape):
    """Return ((dx, dy), texts of x and y, relative accuracy of the spacing that they state)."""
    form, start, (dx, dy) = draft.pick(["", "", "", "", "rounded", "UTM"]), (-7.5, 100), distances(draft)
    if form == "rounded":
        dx, dy = dx / 3, dy / 3
    elif form == "UTM":
        start, dx, dy = (500000.5, 5412345.25), *[draft.one_of([1.0, 0.5])] * 2
    elif draft.chance(0.5):
        start = (0, 0)
    axes = [first + step * np.arange(n) for first, step, n in zip(start, (dx, dy), shape[::-1], strict=True)]
    rounding = 1e-5 / min(np.ptp(axis) for axis in axes) if form == "rounded" else 0
    return (dx, dy), [[f"{value:.5f}" for value in axis] for axis in axes], rounding + 1e-9


def _points_file(draft, table, heights, spacing, delimiter, accuracy):
    """Return the file of a table of points, with headings."""
    u, z = draft.one_of(["um", "mm", "nm", "µm", "m"]), draft.one_of(["nm", "um", "m", "µm"])
    titles = draft.pick(HEADINGS, ODD_HEADINGS, BAD_HEADINGS, odd=0.3).format(u=u, z=z)
    name, suffix, mark = (
        draft.traits[-1],
        ".xyz" if draft.chance(0.4) else draft.one_of(SUFFIXES),
        draft.one_of(["", "", "# "]),
    )
    unit, factor, options = UNITS[z], UNITS[u], {}
    if name in ("no heading", "x,y,z"):
        if draft.chance(0.5):
            draft.note("two units given")
            options = {"unit": z, "lateral_unit": u}
        else:
            unit, factor = None, 1.0
    between = delimiter if delimiter.strip(" ") or " " not in titles else "  "
    lines = [mark + titles.replace("|", between)] if titles else []
    if name == "Gwyddion":
        lines = ["# Channel: Topography", f"# Lateral units: {u}", f"# Value units: {z}"]
    elif name == "units below":
        lines.append(mark + delimiter.join([u, u, z]))
    if not titles and suffix != ".xyz":
        draft.note(f"in {suffix}", clear=False)
    lines += [delimiter.join(row[column] for column in ORDERS.get(name, (0, 1, 2))) for row in table]
    metres = tuple(distance * factor for distance in spacing)
    return Case(draft, "points", f"points{suffix}", encoded(draft, lines), heights, unit, metres, options, accuracy)


def esri(random):
    """Draw an ESRI ASCII grid."""
    draft = Draft(random)
    rows, columns = shape = map_shape(draft)
    cells, heights = printed(draft, shape, odd=0)
    marks = {mark: mark for mark in ("-9999", "-9999.0", "nan", "-99")} | {"no mark": "-9999"}
    mark = draft.pick(marks, {"rounded mark": "-3.402823e+38", "1e38": "1e38"})
    mask = missing_points(draft, shape)
    cells = [[mark if mask[i, j] else cell for j, cell in enumerate(row)] for i, row in enumerate(cells)]
    heights = np.where(mask | (heights == float(mark)), np.nan, heights)
    body = [" ".join(row) for row in cells]
    bodies = {"a row per line": body, "leading spaces": [f" {row}" for row in body]}
    odd_bodies = {"one line": [" ".join(body)], "decimal commas": [row.replace(".", ",") for row in body]}
    bad_bodies = {"too few rows": body[:-1], "too many rows": [*body, body[-1]]}
    bad_bodies |= {"a row lacks a number": [" ".join(cells[0][1:]), *body[1:]]}
    body = draft.pick(bodies, odd_bodies, bad_bodies, odd=0.3)
    dx, dy = distances(draft, square=draft.chance(0.7))
    options = draft.one_of([{}, {}, {}, {}, {"unit": "m"}])
    draft.note("unit given" if options else "", clear=not options)  # coordinates lack a unit
    x, y = "500000.5", "5400000"
    if draft.chance(0.15):
        x, y = "9.5", "47.25"
        may_be_degrees = 9.5 + dx * (columns - 0.5) < 180 and 47.25 + dy * (rows - 1) < 90
        draft.note("coordinates like degrees", clear=not may_be_degrees, bad=may_be_degrees and not options)
    head = [("ncols", columns), ("nrows", rows), ("xllcorner", x), ("yllcenter", y)]
    head += [("cellsize", f"{dx:g}")] if dx == dy else [("dx", f"{dx:g}"), ("dy", f"{dy:g}")]
    head += [("NODATA_value", "-3.4028234663852886e+38" if mark == "-3.402823e+38" else mark)]
    head = head[:-1] if "no mark" in draft.traits else head
    letters, gap = draft.one_of([str, str.upper, str.lower]), draft.one_of([" ", "         ", "\t"])
    lines = [*(f"{letters(name)}{gap}{value}" for name, value in head), *body]
    return Case(
        draft,
        "ESRI",
        "grid" + draft.one_of([".asc", ".asc", *SUFFIXES]),
        encoded(draft, lines),
        heights,
        1.0 if options else None,
        (dx, dy),
        options,
    )


# Headings of positions and heights.
PROFILE_HEADINGS = {
    "no heading": "",
    "x,z": "x|z",
    "x [u]": "x [{u}]|z [{z}]",
    "X (u)": "X ({u})|Z ({z})",
    "x/u": "x/{u}|z/{z}",
    "Position": "Position [{u}]|Height [{z}]",
}
ODD_PROFILE_HEADINGS = {"x_u": "x_{u}|z_{z}", "x and y": "x [{u}]|y [{z}]", "Weg": "Weg ({u})|Höhe ({z})"}
BAD_PROFILE_HEADINGS = {"z in volts": "x [{u}]|z [V]", "time": "time|depth", "x in u": "x in {u}|z in {z}"}


def profile(random):
    """Draw heights along a line, alone or below their positions, as a column or a row: a line, and no map."""
    draft = Draft(random)
    points = int(draft.random.integers(3, 30))
    (cells,), (heights,) = printed(draft, (1, points), odd=0)
    heights = np.array(heights)
    spacing, positions, accuracy = _positions(draft, points)
    delimiter = draft.pick({"space": " ", "tab": "\t", "comma": ",", "semicolon": ";", "comma and space": ", "})
    if draft.chance(0.2) and "," not in delimiter:
        draft.note("decimal commas", clear=bool(delimiter.strip(" ")) and positions is not None)
        cells, positions = ([cell.replace(".", ",") for cell in texts or []] for texts in (cells, positions))
    elif "," in delimiter:
        draft.note("", clear=positions is not None or "integers" not in draft.traits)  # the row may be one number
    if draft.chance(0.06):
        draft.note("a height is missing", bad=True)  # a line has no gaps
        cells[draft.random.integers(points)] = "nan"
    columns, titles = ([positions] if positions else []) + [cells], ""
    u, z = draft.one_of(["um", "mm", "nm", "µm", "m"]), draft.one_of(["nm", "um", "m", "µm"])
    options, unit, factor = {}, None, 1.0
    if positions:
        titles = draft.pick(PROFILE_HEADINGS, ODD_PROFILE_HEADINGS, BAD_PROFILE_HEADINGS, odd=0.3)
        if titles and draft.chance(0.2):
            draft.note("a column of numbers")
            titles, columns = f"{titles}|n", [*columns, [str(number) for number in range(points)]]
        elif draft.chance(0.04):
            draft.note("an unnamed column of numbers", bad=True)
            titles, columns = "", [*columns, [str(number) for number in range(points)]]
        if "{" in titles:
            unit, factor = UNITS[z], UNITS[u]
    if unit is None and draft.chance(0.5):
        draft.note("two units given")
        options, unit, factor = {"unit": z, "lateral_unit": u}, UNITS[z], UNITS[u]
    if positions is None:
        options["spacing"] = spacing
    in_rows = len(columns) < 3 and not titles and draft.chance(0.2)
    draft.note("in rows" if in_rows else "")
    rows = columns if in_rows else zip(*columns, strict=True)
    between = delimiter if delimiter.strip(" ") or " " not in titles else "  "
    lines = [draft.one_of(["", "", "# "]) + titles.format(u=u, z=z).replace("|", between)] if titles else []
    lines += [delimiter.join(row) for row in rows]
    name, metres = "profile" + draft.one_of(SUFFIXES), (factor * spacing,) * 2
    heights = heights[::-1] if "falling" in draft.traits else heights  # in increasing order of x
    case = Case(draft, "profile", name, encoded(draft, lines), heights, unit, metres, options, accuracy)
    case.is_line = True
    return case


def _positions(draft, points):
    """Return (spacing, texts of the positions or None, relative accuracy of the spacing that they state)."""
    form, (spacing, _) = (
        draft.pick(["alone", "", "", "rounded", "falling", "far"], bad=["uneven"], odd=0.6),
        distances(draft),
    )
    if form == "alone":
        return spacing, None, 1e-9
    spacing = spacing / 3 if form == "rounded" else spacing
    x = {"far": 500000.5}.get(form, draft.one_of([0, -7.5])) + spacing * np.arange(points)
    if form == "uneven":
        x = draft.pick({"one off": x + 0.4 * spacing * (np.arange(points) == 1), "quadratic": x * abs(x) + 3 * x})
    x = x[::-1] if form == "falling" else x
    digits = 5 if form != "rounded" or draft.chance(0.5) else int(np.ceil(-np.log10(0.04 * spacing)))
    texts = [f"{value:.{digits}f}" for value in x]
    return spacing, texts, 1e-9 + (10.0**-digits / np.ptp(x) if form == "rounded" else 0)
