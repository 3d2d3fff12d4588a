"""Random text files with the points x, y, z of a grid, and ESRI ASCII grids; for file_campaign.py."""

import numpy as np
from file_cases import UNITS, Draft, distances, map_shape, missing_points
from text_files import SWAPPED, are_plain, encoded, printed

# Headings of the columns, with the unit {u} of x and y, {z} of the heights
HEADINGS = {
    "no heading": "",
    "x,y,z": "x|y|z",
    "x [u]": "x [{u}]|y [{u}]|z [{z}]",
    "X (u)": "X ({u})|Y ({u})|Z ({z})",
    "x[u]": "x[{u}]|y[{u}]|z[{z}]",
    "x/u": "x/{u}|y/{u}|z/{z}",
    "x_u": "x_{u}|y_{u}|z_{z}",
    "Gwyddion": "",
}
ODD_HEADINGS = {
    "x in u": "x in {u}|y in {u}|z in {z}",
    "x / u": "x / {u}|y / {u}|z / {z}",
    "x u": "x {u}|y {u}|z {z}",
    "Position x": "Position x [{u}]|Position y [{u}]|Höhe [{z}]",
    "height": "x [{u}]|y [{u}]|height [{z}]",
    "units below": "x|y|z",
    "y before x": "y [{u}]|x [{u}]|z [{z}]",
    "z first": "z [{z}]|x [{u}]|y [{u}]",
    "a fourth column": "x [{u}]|y [{u}]|z [{z}]|I [1]",
    "numbers first": "No.|x [{u}]|y [{u}]|z [{z}]",
}
BAD_HEADINGS = {
    "z in volts": "x [{u}]|y [{u}]|z [V]",
    "x in seconds": "x [s]|y [s]|z [{z}]",
    "unit of z only": "x|y|z [{z}]",
    "no unit of z": "x [{u}]|y [{u}]|z",
    "degrees": "lon [deg]|lat [deg]|z [{z}]",
    "longitude": "longitude|latitude|elevation",
}
ORDERS = {"y before x": (1, 0, 2), "z first": (2, 0, 1)}


def points(random):
    """Columns x, y, z of the points of a grid, in any order."""
    draft = Draft("points", random)
    shape = rows, columns = map_shape(draft)
    cells, heights = printed(draft, shape)
    delimiters = {"space": " ", "tab": "\t", "comma": ",", "semicolon": ";", "comma and space": ", "}
    delimiter = draft.pick(delimiters if are_plain(cells) else {"semicolon": ";"})
    dx, dy, texts, accuracy = _coordinates(draft, columns, rows)
    if draft.chance(0.2) and "," not in delimiter:
        draft.note("decimal commas", clear=bool(delimiter.strip(" ")) or "integers" not in draft.traits)
        texts = [[text.replace(".", ",") for text in axis] for axis in texts]
        cells = [[cell.translate(SWAPPED) for cell in row] for row in cells]
    down, left, order = draft.chance(0.3), draft.chance(0.3), draft.pick({"x fastest": 1, "y fastest": -1, "mixed": 0})
    places = sorted(np.ndindex(shape), key=lambda p: ((-1) ** down * p[0], (-1) ** left * p[1])[:: order or 1])
    if order == 0:
        draft.random.shuffle(places)
    table = {(i, j): [texts[0][j], texts[1][i], cells[i][j]] for i, j in places}
    heights = _with_gaps(draft, table, heights, delimiter)
    return _points_file(draft, list(table.values()), heights, (dx, dy), delimiter, accuracy)


def _coordinates(draft, columns, rows):
    """(dx, dy, texts of x and y, relative accuracy of the spacing that they state)."""
    dx, dy = distances(draft)
    form = draft.pick(["", "", "", "", "rounded", "UTM"], [], ["irregular, far"] * (columns > 5), odd=0.3)
    (x0, y0), decimals = draft.one_of([(0, 0), (0, 0), (-7.5, 100), (0.25, -3)]), 4
    if form == "rounded":
        dx, dy, decimals = dx / 3, dy / 3, 5
    elif form == "UTM":
        (x0, y0), dx, dy, decimals = (500000.5, 5412345.25), *[draft.one_of([1.0, 0.5])] * 2, 2
    elif form == "irregular, far":
        (x0, y0), dx, dy, decimals = (2e6, 5412345.25), 2.0, 2.0, 2
    x, y = x0 + dx * np.arange(columns), y0 + dy * np.arange(rows)
    if form == "irregular, far":
        x += draft.random.uniform(-0.95, 0.95, columns)
    texts = [[f"{value:.{decimals}f}" for value in axis] for axis in (x, y)]
    rounding = 10.0**-decimals / min((columns - 1) * dx, (rows - 1) * dy) if form == "rounded" else 0
    return dx, dy, texts, rounding + 1e-9


def _with_gaps(draft, table, heights, delimiter):
    """The heights with points missing; these are left out of the table, or marked in it."""
    form = draft.one_of(["all", "all", "left out", "nan", "empty", "No Data"])
    mask = draft.random.random(heights.shape) < 0.2
    seen = (~mask).any(axis=0).all() and (~mask).any(axis=1).all() and (~mask).sum() > 3
    if form == "all" or not mask.any() or not seen or (form == "empty" and not delimiter.strip()):
        return heights
    draft.note(f"missing: {form}", clear=form != "No Data" or bool(delimiter.strip(" ")))
    for place in zip(*np.nonzero(mask), strict=True):
        if form == "left out":
            del table[place]
        else:
            table[place][2] = "" if form == "empty" else form
    return np.where(mask, np.nan, heights)


def _points_file(draft, table, heights, spacing, delimiter, accuracy):
    """The file of a table of points, with headings."""
    u, z = draft.one_of(["um", "mm", "nm", "µm", "m"]), draft.one_of(["nm", "um", "m", "µm"])
    titles = draft.pick(HEADINGS, ODD_HEADINGS, BAD_HEADINGS, odd=0.3).format(u=u, z=z)
    name, suffix, options = draft.traits[-1], draft.one_of([".txt", ".csv", ".xyz", ".dat"]), {}
    unit, factor = (None, 1.0) if name in ("no heading", "x,y,z") else (UNITS[z], UNITS[u])
    mark, lines = draft.one_of(["", "", "# "]), []
    if name == "Gwyddion":
        lines = ["# Channel: Topography", f"# Lateral units: {u}", f"# Value units: {z}"]
    elif titles:
        between = delimiter if delimiter.strip(" ") or " " not in titles else "  "
        lines = [mark + titles.replace("|", between)]
    if not titles and suffix != ".xyz":
        draft.note(f"in {suffix}", clear=False)
    if name == "units below":
        lines.append(mark + delimiter.join([u, u, z]))
    table = [[row[column] for column in ORDERS.get(name, range(3))] for row in table]
    if name == "a fourth column":
        table = [[*row, str(index % 7)] for index, row in enumerate(table)]
    elif name == "numbers first":
        table = [[str(index), *row] for index, row in enumerate(table, 1)]
    metres = tuple(distance * factor for distance in spacing)
    if "|" in titles and titles.count("|") == 3 and draft.chance(0.5):
        options["spacing"] = tuple(float(f"{distance / unit:.12g}") for distance in metres)
    lines += [delimiter.join(row) for row in table]
    return draft.case(f"points{suffix}", encoded(draft, lines), heights, unit, metres, options, accuracy)


def zygo(random):
    """A Zygo XYZ Data File: x and y count pixels, heights are in micrometres, line 8 states the pixel in metres."""
    draft = Draft("Zygo XYZ", random)
    rows, columns = map_shape(draft)
    heights = np.round(draft.random.normal(0, 2, (rows, columns)), 4)
    heights[draft.random.random((rows, columns)) < draft.one_of([0, 0.2])] = np.nan
    heights[0, 0] = heights[-1, -1] = 0.5
    x0, y0 = draft.one_of([(0, 0), (10, 20)])
    pixel = draft.one_of([3.9535e-4, 5.067e-5, 1.09e-6])
    gap = draft.pick(["No Data"], {"left out": None}, odd=0.15)
    options = draft.pick({"unit given": {"unit": "um"}}, {"unit not given": {}}, odd=0.4)  # the file does not name it
    if draft.chance(0.1):
        draft.note("not calibrated", bad=True)
    lines = ["Zygo XYZ Data File - Format 1", '0 3 0 0 "Tue Aug 25 16:59:23 2015"', f"0 0 {columns} {rows} 1 255"]
    lines += [f"{x0} {y0} {columns} {rows}", '"Sample B"', '"0815"', '"Wafer"']
    lines += [f"0 0.5 6.328e-07 0 1 0 {0 if draft.bad else pixel:g} 1440514763", '3 2 0 0 0 666666 0 ""']
    lines += ["0 0 1 33 0 0 0.1 60.4318 2 50", "0 1 100 0 0 0 0 0 0 0", '0 ""', "1 5 0", "#"]
    for (i, j), value in np.ndenumerate(heights):
        if gap or value == value:
            lines.append(f"{x0 + j} {y0 + i} {gap if np.isnan(value) else f'{value:.4f}'}")
    return draft.case("map.xyz", encoded(draft, [*lines, "#"]), heights, 1e-6, (pixel, pixel), options)


BODIES = ("a row per line", "a leading space")
ODD_BODIES = ("wrapped", "one line", "decimal commas")
BAD_BODIES = ("lines contradict", "too few rows", "too many rows", "a row lacks a number")


def esri(random):
    """An ESRI ASCII grid."""
    draft = Draft("ESRI grid", random)
    shape = map_shape(draft)
    cells, heights = printed(draft, shape)
    if not are_plain(cells):
        cells = [[f"{value:.3f}" for value in row] for row in heights]
        heights = np.array([[float(cell) for cell in row] for row in cells])
        draft = Draft("ESRI grid", random)
    marks = {mark: mark for mark in ("-9999", "-9999.0", "nan", "-99")} | {"no mark": None}
    mark = draft.pick(marks, {"rounded mark": "-3.402823e+38", "1e38": "1e38"})
    mask = missing_points(draft, shape)
    cells = [[mark or "-9999" if mask[i, j] else cell for j, cell in enumerate(row)] for i, row in enumerate(cells)]
    heights = np.where(mask | (heights == float(mark or -9999)), np.nan, heights)
    dx, dy = distances(draft, square=draft.chance(0.7))
    form = draft.pick(BODIES, ODD_BODIES, BAD_BODIES, odd=0.3)
    counts, body = _esri_body(form, cells)
    corner = draft.pick(["corner", "center"])
    head = [("ncols", counts[1]), ("nrows", counts[0]), (f"xll{corner}", "500000.5"), (f"yll{corner}", "5400000")]
    head += [("cellsize", f"{dx:g}")] if dx == dy else [("dx", f"{dx:g}"), ("dy", f"{dy:g}")]
    head += [("NODATA_value", "-3.4028234663852886e+38" if mark == "-3.402823e+38" else mark)] if mark else []
    lettering = draft.pick({"usual letters": str, "upper case": str.upper, "lower case": str.lower})
    gap = draft.one_of([" ", "         ", "\t"])
    unit, options = None, {}
    if draft.chance(0.2):
        draft.note("unit given", clear=False)  # that of the coordinates is not stated
        unit, options = 1.0, {"unit": "m"}
    lines = [*(f"{lettering(name)}{gap}{value}" for name, value in head), *body]
    return draft.case("grid.asc", encoded(draft, lines), heights, unit, (dx, dy), options)


def _esri_body(form, cells):
    """((rows, columns) as the file states them, lines of numbers)."""
    rows, columns = counts = len(cells), len(cells[0])
    if form == "lines contradict" and rows % columns and columns % rows:  # though the number of numbers is right
        counts = columns, rows
    body, half = [" ".join(row) for row in cells], -(-columns // 2)
    bodies = {
        "a leading space": [f" {row}" for row in body],
        "wrapped": [" ".join(part) for row in cells for part in (row[:half], row[half:])],
        "one line": [" ".join(body)],
        "decimal commas": [row.replace(".", ",") for row in body],
        "lines contradict": [*body[:-2], " ".join(cells[-2][:-1]), " ".join([cells[-2][-1], *cells[-1]])],
        "too few rows": body[:-1],
        "too many rows": [*body, body[-1]],
        "a row lacks a number": [" ".join(cells[0][1:]), *body[1:]],
    }
    return counts, body if counts != (rows, columns) else bodies.get(form, body)
