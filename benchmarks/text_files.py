"""Random text files of known maps of heights, as instruments and programs write them; for file_campaign.py.

The tables say what each variation means for a reader: CLEAR ones are unambiguous, of UNCLEAR ones the truth is known
but a reader may refuse them, and BAD ones must be refused.
"""

import math
import re
from dataclasses import dataclass, field

import numpy as np

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "µm": 1e-6, "\u03bcm": 1e-6, "micron": 1e-6, "microns": 1e-6}
UNITS |= {"micrometer": 1e-6, "cm": 1e-2, "Å": 1e-10, "pm": 1e-12}
PIXELS = ("px", "pixel", "pixels", "points", "Pixel", "pts", "dots")


@dataclass
class Case:
    """A file, the arguments of read_heights, and the truth about both.

    kind : of file; traits : the variations that were drawn
    heights : the numbers, nan where missing, in `unit`; None if the file must be refused
    unit : of the heights, in metres; None if neither file nor arguments state it
    spacing : (dx, dy) in metres, or plain numbers where the unit is not known
    accuracy : relative, of the spacing that the file states
    unambiguous : whether every competent reader must read the file
    faulty_line : whether the fault is in a line of text, which a refusal must name
    """

    kind: str
    name: str
    content: bytes
    heights: np.ndarray | None
    unit: float | None
    spacing: tuple
    options: dict = field(default_factory=dict)
    unambiguous: bool = True
    traits: tuple = ()
    accuracy: float = 1e-12
    faulty_line: bool = False
    index: int = -1


class Draft:
    """The random choices of a file: their names, and whether they leave it unambiguous, or impossible to read."""

    def __init__(self, kind, random):
        self.kind, self.random, self.traits = kind, random, []
        self.clear, self.bad, self.faulty_line, self.oddities = True, False, False, 0

    def chance(self, share):
        return self.random.random() < share

    def one_of(self, choices):
        """One of the choices, without a trace."""
        return choices[self.random.integers(len(choices))]

    def pick(self, clear, unclear=(), bad=(), odd=0.12):
        """An entry of tables {name: value}, mostly of `clear`; the name becomes a trait."""
        roll = self.random.random()
        table = bad if bad and roll < odd / 3 else unclear if unclear and roll < odd else clear
        name = self.one_of(list(table))
        self.note(name, clear=table is clear, bad=bool(bad) and table is bad)
        return table[name]

    def note(self, trait, *, clear=True, bad=False, faulty_line=False):
        """Record a variation."""
        self.traits += [trait] if trait else []
        self.clear &= clear and not bad
        self.bad |= bad
        self.faulty_line |= faulty_line
        self.oddities += bad or not clear

    def case(self, name, content, heights, unit, spacing, options=None, **more):
        return Case(
            self.kind,
            name,
            content,
            None if self.bad else heights,
            unit,
            spacing,
            options or {},
            self.clear,
            tuple(self.traits),
            faulty_line=self.faulty_line and self.oddities == 1,  # else the refusal may be about something else
            **more,
        )


def distances(draft, square=False):
    """(dx, dy), short decimal numbers of moderate aspect."""
    dx = float(draft.one_of(["0.5", "0.25", "1.5", "2", "0.37", "12.5", "0.125", "3.7e-1", "0.08"]))
    return dx, dx if square or draft.chance(0.3) else round(dx * draft.one_of([0.8, 1.6, 2.0, 0.5, 3.0]), 6)


def map_shape(draft, least=2):
    return tuple(int(n) for n in draft.random.integers(least, 13 if draft.chance(0.7) else 5, 2))


# ---- numbers and tables of them

FORMATS = {
    "fixed": lambda draft, value: f"{value:.{draft.decimals}f}",
    "integers": lambda draft, value: f"{value:.0f}",
    "%g": lambda draft, value: f"{value * 1e-7:.6g}",
    "exponents": lambda draft, value: f"{value * 1e-7:.5e}",
    "capital exponents": lambda draft, value: f"{value:.3E}",
    "plus signs": lambda draft, value: f"{value:+.{draft.decimals}f}",
    "short": lambda draft, value: re.sub(r"^(-?)0\.", r"\1.", f"{value:.2f}"),
}
ODD_FORMATS = {
    "D exponents": lambda draft, value: f"{value:.4e}".replace("e", "D"),
    "U+2212": lambda draft, value: f"{value:.3f}".replace("-", "\u2212"),
    "thousands": lambda draft, value: f"{1000 * value:,.2f}",
    "thousands with apostrophes": lambda draft, value: f"{1000 * value:,.2f}".replace(",", "'"),
    "thousands with no-break spaces": lambda draft, value: f"{1000 * value:,.2f}".replace(",", "\u00a0"),
    "thousands with thin spaces": lambda draft, value: f"{1000 * value:,.2f}".replace(",", "\u202f"),
}
DELIMITERS = {"space": " ", "spaces": "   ", "aligned": " ", "tab": "\t", "comma": ",", "semicolon": ";"}
DELIMITERS |= {"comma and space": ", ", "semicolon and space": "; "}
ODD_DELIMITERS = {"pipe": "|", "spaced pipe": " | ", "tab and space": "\t ", "spaced semicolon": " ; "}
MARKS = {mark: mark for mark in ("nan", "NaN", "NAN", "NA", "N/A", "null", "BAD", "***", "--", "---", "void")}
ODD_MARKS = {mark: mark for mark in ("None", "-", "?", "#N/A", "#NV", "n.a.", "masked", "<0.1", "NULL", "n/a", "*")}
ODD_MARKS |= {mark: mark for mark in ("missing", ".", "x", "#DIV/0!", "1.#QNAN", "-nan(ind)", "----", "fehlt", "±")}
NUMBER_MARKS = ("-9999", "-99999", "-32768", "1e38")


def printed(draft, shape):
    """Numbers as they are printed, with a decimal point, and their values."""
    draft.decimals = int(draft.random.integers(1, 7))
    form = draft.pick(FORMATS, ODD_FORMATS, odd=0.1)
    cells = [[form(draft, v) for v in row] for row in draft.random.normal(0, 30, shape)]
    plain = str.maketrans({"\u2212": "-", "D": "e", ",": "", "'": "", "\u00a0": "", "\u202f": ""})
    return cells, np.array([[float(cell.translate(plain)) for cell in row] for row in cells])


def missing_points(draft, shape):
    """Where points are missing: nowhere, at single places, in a corner, in entire rows or columns; not everywhere."""
    mask = np.zeros(shape, bool)
    form = draft.one_of(["none", "none", "none", "random", "first", "last", "round", "row", "column", "first row"])
    row, column = (int(draft.random.integers(n)) for n in shape)
    if form == "random":
        mask = draft.random.random(shape) < 0.25
    elif form == "round":
        y, x = np.mgrid[: shape[0], : shape[1]]
        mask = np.hypot(y / (shape[0] - 1 or 1) - 0.5, x / (shape[1] - 1 or 1) - 0.5) > 0.6
    elif form in ("row", "first row"):
        mask[row if form == "row" else 0] = True
    elif form == "column":
        mask[:, column] = True
    elif form in ("first", "last"):
        mask[(0, 0) if form == "first" else (-1, -1)] = True
    if mask.all() or (~mask).sum() < 2:
        mask[:] = False
    if mask.any():
        draft.note(f"missing: {form}")
    return mask


def table_text(draft, shape, *, delimiter=None):
    """(rows of text, heights, delimiter, whether the decimal mark is a comma) of a matrix with points missing."""
    cells, heights = printed(draft, shape)
    if delimiter is None:
        delimiter = draft.pick(DELIMITERS, ODD_DELIMITERS, odd=0.06)
    thousands = any("," in cell for row in cells for cell in row)
    has_comma = delimiter.strip() == "," if delimiter else False
    decimal_comma = draft.chance(0.3) and "integers" not in draft.traits and "D exponents" not in draft.traits
    quoted = draft.chance(0.08)
    if delimiter == ",":  # decimal commas between commas say nothing to anyone, unless in quotes
        decimal_comma = decimal_comma and quoted
    if thousands and has_comma and not quoted:
        delimiter, has_comma = ";", False
        draft.note("semicolon")
    if decimal_comma:
        cells = [[cell.translate({ord("."): ",", ord(","): "."}) for cell in row] for row in cells]
        draft.note("decimal commas", clear=not has_comma)
        _check_decimal_commas(draft, cells, delimiter)
    elif has_comma and not quoted and all(re.fullmatch(r"[+-]?\d+", cell) for row in cells for cell in row):
        digits = {len(cell) for row in cells for cell in row[1:]}
        if shape[1] <= 2 or digits == {3}:
            draft.note("may be decimal commas", clear=False)
    if not delimiter.strip(" ") and any("\u00a0" in cell or "\u202f" in cell for row in cells for cell in row):
        delimiter = ";"
        draft.note("semicolon")
    mask = missing_points(draft, shape)
    heights = heights.copy()
    if mask.any():
        mark = _mark(draft, delimiter, mask)
        cells = [[mark if mask[i, j] else cell for j, cell in enumerate(row)] for i, row in enumerate(cells)]
        heights[mask] = float(mark) if mark in NUMBER_MARKS else np.nan
    if quoted:
        draft.note("quotes", clear=bool(delimiter.strip(" ")))
        cells = [[f'"{cell}"' for cell in row] for row in cells]
    if "aligned" in draft.traits and delimiter == " ":
        width = max(len(cell) for row in cells for cell in row) + 1
        rows = ["".join(cell.rjust(width) for cell in row) for row in cells]
    else:
        rows = [delimiter.join(row) for row in cells]
    if draft.chance(0.06):
        draft.note("trailing delimiters")
        rows = [row + delimiter for row in rows]
    elif draft.chance(0.02) and delimiter.strip(" "):
        draft.note("leading delimiters", clear=False)
        rows = [delimiter + row for row in rows]
    return rows, heights, delimiter, decimal_comma


def _check_decimal_commas(draft, cells, delimiter):
    """Decimal commas are unambiguous if they cannot be thousands separators, nor delimiters."""
    numbers = [cell for row in cells for cell in row]
    if all(re.fullmatch(r"[+-]?[1-9]\d{0,2},\d{3}", number) for number in numbers):
        draft.note("may be thousands", clear=False)
    if not delimiter.strip(" ") and any("," not in number for number in numbers):
        draft.note("some without decimals", clear=False)
    if "short" in draft.traits:
        draft.note("decimal commas first", clear=False)


def _mark(draft, delimiter, mask):
    """The mark of missing points; an empty cell only where a delimiter shows it."""
    border = mask[:, 0].all() or mask[:, -1].all()
    if delimiter.strip(" ") and draft.chance(0.55) and not border and mask.shape[1] > 1:
        blank_row = mask.all(axis=1).any()
        draft.note("empty cells", clear=not (blank_row and delimiter.isspace()))
        return ""
    if draft.chance(0.08):
        draft.note("number as a mark")
        return draft.one_of(NUMBER_MARKS)
    mark = draft.pick(MARKS, ODD_MARKS, odd=0.2)
    if mask.all(axis=1).any() and mark.lower() != "nan":
        draft.note("row of marks", clear=mark.isalpha() and not mask[0].all())  # not a title, nor a rule
    if mark in ODD_MARKS:
        draft.faulty_line = True
    return mark


# ---- headers. In them: {dx} and {dy} with the unit {u}, {w} and {h} the width and height of the map, {z} the unit of
# the heights, {k} the spacing of squares; {dx2} contradicts {dx}

GWYDDION = {
    "Gwyddion, English": ["Channel: Topography", "Width: {w} {u}", "Height: {h} {u}", "Value units: {z}"],
    "Gwyddion, German": ["Kanal: Topographie", "Breite: {w} {u}", "Höhe: {h} {u}", "Werteinheiten: {z}"],
    "Gwyddion, partly German": ["Kanal: Höhe", "Breite: {w} {u}", "Höhe: {h} {u}", "Value units: {z}"],
    "Gwyddion, French": ["Canal : Topographie", "Largeur : {w} {u}", "Hauteur : {h} {u}", "Unités : {z}"],
    "French": ["Canal: Relief", "Largeur: {w} {u}", "Hauteur: {h} {u}", "Unités de valeur: {z}"],
}
HEADERS = GWYDDION | {
    "X and Y pixel size": ["X pixel size: {dx} {u}", "Y pixel size: {dy} {u}", "Z unit: {z}"],
    "pixel size a x b": ["pixel size: {dx} {u} x {dy} {u}", "Z unit: {z}"],
    "pixel size": ["pixel size: {k} {u}", "Height unit: {z}"],
    "Pixel size =": ["Pixel size = {k} {u}", "Z units = {z}"],
    "Pixel_size": ["Pixel_size = {k} {u}", "Z_unit = {z}"],
    "X pixel size (u)": ["X pixel size ({u}): {dx}", "Y pixel size ({u}): {dy}", "Z unit: {z}"],
    "dx, dy": ["dx = {dx} {u}", "dy = {dy} {u}", "z unit: {z}"],
    "dx=, dy=": ["dx={dx} {u}", "dy={dy} {u}", "z_unit={z}"],
    "x and y spacing": ["x spacing = {dx} {u}", "y spacing = {dy} {u}", "z units: {z}"],
    "all in one unit": ["dx: {dx} {z}", "dy: {dy} {z}", "unit: {z}"],
    "spacing": ["spacing: {k} {u}", "z unit: {z}"],
}
ODD_HEADERS = {
    "X, Y, Z units": ["X units: {u}", "Y units: {u}", "Z units: {z}", "dx = {dx}", "dy = {dy}"],
    "XY units": ["XY units: {u}", "Z units: {z}", "X pixel size: {dx}", "Y pixel size: {dy}"],
    "lateral and height unit": ["Lateral unit: {u}", "Height unit: {z}", "pixel size: {k}"],
    "lateral and value units": ["Lateral units: {u}", "Value units: {z}", "x spacing: {dx}", "y spacing: {dy}"],
    "X and Z units beside": ["X units: {u}", "Z units: {z}", "pixel size: {k} {u}"],
    "X units beside": ["X units: {u}", "Units: {z}", "pixel size: {k} {u}"],
    "pixel size a x b, one unit": ["pixel size: {dx} x {dy} {u}", "unit: {z}"],
    "pixel size a u, b u": ["pixel size: {dx} {u}, {dy} {u}", "z unit: {z}"],
    "spacing: a, b u": ["spacing: {dx}; {dy} {u}", "z unit: {z}"],
    "pixel size of one unit": ["pixel size: {k2z}", "unit: {z}"],
    "dx [u]": ["dx [{u}] = {dx}", "dy [{u}] = {dy}", "z [{z}]"],
    "pixel size, unit only of y": ["X pixel size: {dxz} {z}", "Y pixel size: {dy} {u}", "z unit: {z}"],
    "x and y size": ["x size: {w} {u}", "y size: {h} {u}", "z unit: {z}"],
    "scan size a x b": ["Scan size: {w} {u} x {h} {u}", "z unit: {z}"],
    "no space": ["dx={dx}{u}", "dy={dy}{u}", "z unit={z}"],
    "German pixel size": ["Pixelgröße: {k} {u}", "Einheit: {z}"],
    "German pixel sizes": ["Pixelgröße X: {dx} {u}", "Pixelgröße Y: {dy} {u}", "Einheit Z: {z}"],
    "German spacing": ["Punktabstand: {k} {u}", "Höheneinheit: {z}"],
    "French pixel size": ["Taille de pixel : {k} {u}", "Unité : {z}"],
    "French spacing": ["Pas en x : {dx} {u}", "Pas en y : {dy} {u}", "Unité de z : {z}"],
    "dx repeated": ["dx = {dx} {u}", "dx = {dx} {u}", "dy = {dy} {u}", "z unit: {z}"],
    "size and pixel size": ["Width: {w} {u}", "Height: {h} {u}", "dx = {dx} {u}", "dy = {dy} {u}", "Value units: {z}"],
    "sample height": ["Sample height: 12 mm", "dx = {dx} {u}", "dy = {dy} {u}", "z unit: {z}"],
    "tip": ["Tip width: 10 nm", "Tip height: 3 um", "pixel size: {k} {u}", "z unit: {z}"],
}
BAD_HEADERS = {
    "two pixel sizes": ["pixel size: {dx} {u}", "pixel size: {dx2} {u}", "z unit: {z}"],
    "two dx": ["dx = {dx} {u}", "dx = {dx2} {u}", "dy = {dy} {u}", "z unit: {z}"],
    "two units": ["pixel size: {k} {u}", "Z units: um", "Z units: nm"],
    "two kinds of unit": ["pixel size: {k} {u}", "Value units: um", "Z unit: nm"],
    "size contradicts dx": ["Width: {w} {u}", "Height: {h} {u}", "dx = {dx2} {u}", "Value units: {z}"],
    "unit of one direction": ["Width: {w} {u}", "Height: {h}", "Value units: {z}"],
    "heights in volts": ["pixel size: {k} {u}", "Value units: V"],
    "spacing in seconds": ["pixel size: {k} s", "Value units: {z}"],
    "no unit of heights": ["pixel size: {k} {u}"],
    "size in pixels": ["Width: {columns} px", "Height: {rows} px", "Value units: {z}"],
    "pixels of 1 px": ["Pixel size: 1 pixel", "Value units: {z}"],
}
NO_SPACING = {
    "no header": [],
    "value units": ["Value units: {z}"],
    "unit": ["unit: {z}"],
    "z unit": ["Z unit: {z}"],
}
PIXEL_HEADERS = {
    "width in pixels": ["Width: {columns} {p}", "Height: {rows} {p}", "Value units: {z}"],
    "pixel size 1 px": ["Pixel size: 1 {p}", "Value units: {z}"],
    "x units pixels": ["X units: {p}", "Y units: {p}", "Z units: {z}"],
    "scan size in pixels": ["Scan size: {columns} x {rows} {p}", "Z units: {z}"],
    "heights in pixels": ["Z units: {p}"],
}
REMARKS = (
    *("Measured with a profilometer", "Messung vom Labor, Probe B", "Mesure de la surface, échantillon C"),
    *("Date: 2024-05-01 10:11:12", "Operator: A. Meier", "Temperature: 23 °C", "Objective: 50x", "Filter = none"),
)
ODD_REMARKS = ("Tip radius: 10 nm", "Scan rate: 1.0 Hz", "Scan speed: 2 um/s", "2024-05-01 10:11", "# 1 2 3", "Unit 7")


def header_lines(draft, shape, decimal_comma):
    """(lines, unit of the heights in metres or None, spacing as Case has it, options) of a header or none."""
    rows, columns = shape
    u, z = (draft.one_of(["um", "um", "nm", "mm", "m", "µm", *UNITS]) for _ in range(2))
    options = {}
    if draft.chance(0.6):
        lines = draft.pick(HEADERS, ODD_HEADERS, BAD_HEADERS, odd=0.25)
        dx, dy = distances(draft, square=any("{k" in line for line in lines))
        metres = dx * UNITS[u], dy * UNITS[u]
        if any("{z}" in line and "{d" in line for line in lines) and "all in one unit" in draft.traits:
            metres = dx * UNITS[z], dy * UNITS[z]
        if "pixel size of one unit" in draft.traits:
            metres = dx * UNITS[z], dx * UNITS[z]
        if "two units" in draft.traits or "two kinds of unit" in draft.traits:
            z = "um"
        unit, spacing = UNITS[z], metres
        if not draft.bad and draft.chance(0.06):
            given = tuple(float(f"{distance / unit:.12g}") for distance in spacing)
            agrees = draft.chance(0.5)
            draft.note("spacing given, too" if agrees else "another spacing given", bad=not agrees)
            options = {"spacing": given if agrees else (given[0] * 1.1, given[1])}
    else:
        in_pixels = draft.chance(0.15)
        lines = draft.pick({}, PIXEL_HEADERS, odd=1) if in_pixels else draft.pick(NO_SPACING)
        dx, dy = distances(draft)
        in_file = any("{z}" in line for line in lines)
        given = not in_file and draft.chance(0.4)
        if given:
            draft.note("unit given")
            options["unit"] = z if z in ("m", "mm", "um", "nm") else "um"
            z = options["unit"]
        unit = UNITS[z] if in_file or given else None
        spacing = tuple(distance * (unit or 1) for distance in (dx, dy))
        if draft.chance(0.05):
            draft.note("no spacing at all", bad=True)
        else:
            options["spacing"] = (dx, dy) if dx != dy or draft.chance(0.5) else dx
    numbers = {"dx": dx, "dy": dy, "w": round(dx * columns, 9), "h": round(dy * rows, 9), "k": dx, "k2z": dx}
    numbers |= {"dx2": 2 * dx, "dxz": float(f"{dx * UNITS[u] / UNITS[z]:.15g}")}
    texts = {name: f"{value:.15g}" for name, value in numbers.items()}
    if decimal_comma or (lines and draft.chance(0.04)):
        texts = {name: text.replace(".", ",") for name, text in texts.items()}
        if any("," in text for text in texts.values()):
            listed = any(re.search(r"\}[^{]*[,;].*\{", line) for line in lines)
            draft.note("decimal commas in the header", clear=decimal_comma and not listed)
    if lines and draft.chance(0.25) and not set(GWYDDION) & set(draft.traits):
        lines = list(draft.random.permutation(lines))
        draft.note("header in another order")
    texts |= {"u": u, "z": z, "p": draft.one_of(PIXELS), "columns": columns, "rows": rows}
    return [line.format(**texts) for line in lines], unit, spacing, options


# ---- whole files

ENCODINGS = {"utf-8": "utf-8", "utf-8-sig": "utf-8-sig", "latin-1": "latin-1", "cp1252": "cp1252"}
ENCODINGS |= {"utf-16 LE": "utf-16-le", "utf-16 BE": "utf-16-be"}
LINE_ENDS = {"\\n": "\n", "\\r\\n": "\r\n", "\\r": "\r"}


def encoded(draft, lines):
    """The bytes of a text file of these lines."""
    end = draft.pick(LINE_ENDS, {"\\r\\r\\n": "\r\r\n"}, odd=0.03)
    text = end.join(lines) + draft.pick({"": end, "no final line end": "", "blank lines at the end": 3 * end})
    encoding = draft.pick({"utf-8": "utf-8"} if draft.chance(0.6) else ENCODINGS)
    try:
        content = text.encode(encoding)
    except UnicodeEncodeError:
        return text.encode("utf-8")
    return {"utf-16-le": b"\xff\xfe", "utf-16-be": b"\xfe\xff"}.get(encoding, b"") + content


def commented(draft, lines, delimiter):
    """Header lines with the mark of comments; unmarked ones stay as they are."""
    marks = {"# ": "# ", "#": "#", "% ": "% ", "// ": "// ", "unmarked header": ""}
    mark = draft.pick(marks, {"; ": "; ", "! ": "! ", "* ": "* "}, odd=0.05) if lines else "# "
    return [mark + line for line in lines], mark or "# "


def with_comments(draft, rows, mark):
    """Rows of a table with comments between and after them, behind a row, and blank lines."""
    rows = list(rows)
    at = int(draft.random.integers(1, len(rows) + 1)) if len(rows) > 1 else 1
    mark = mark if mark.strip() in ("#", "%", "//") else "# "
    form = draft.one_of([*["none"] * 40, *["between", "after", "behind"] * 3, "text between", "text after", "spaced"])
    if form == "none":
        return rows
    draft.note(f"comments: {form}", clear=not form.startswith(("text", "spaced")))
    if form == "between":
        rows.insert(at, f"{mark}line {at}")
    elif form == "after":
        rows += ["", f"{mark}end of data"]
    elif form == "behind":
        rows[at - 1] += " # checked"
    elif form == "text between":
        rows.insert(at, "second part")
    elif form == "text after":
        rows.append("End of data")
    else:
        rows = [line for row in rows for line in (row, "")]
    return rows


def matrix(random):
    """A matrix of heights with a header or none."""
    draft = Draft("matrix", random)
    shape = map_shape(draft)
    if draft.chance(0.03):
        shape = (1, shape[1]) if draft.chance(0.5) else (shape[0], 1)
        draft.note("a single line", clear=False)
    if shape[1] == 1:
        heights = np.round(draft.random.normal(0, 9, shape), 3)
        rows, delimiter, decimal_comma = [f"{value:.3f}" for value in heights[:, 0]], ";", False
    else:
        rows, heights, delimiter, decimal_comma = table_text(draft, shape)
    header, unit, spacing, options = header_lines(draft, shape, decimal_comma)
    if set(GWYDDION) & set(draft.traits):
        draft.kind = "matrix, Gwyddion"
    remark = draft.chance(0.2)
    if remark:
        odd = draft.chance(0.2)
        draft.note("remark", clear=not odd)
        header.insert(int(draft.random.integers(len(header) + 1)), draft.one_of(ODD_REMARKS if odd else REMARKS))
    header, mark = commented(draft, header, delimiter)
    if mark == "; " and remark and ";" in delimiter:
        draft.note("comments like rows", clear=False)
    if shape[1] > 2 and draft.chance(0.04) and delimiter.strip() and '"' not in rows[0]:
        draft.note("names of columns")
        header.append(delimiter.join("ABCDEFGHIJKLMNOP"[: shape[1]]))
    rows = with_comments(draft, rows, mark)
    if draft.chance(0.05) and min(shape) > 1:
        rows = spoiled(draft, rows, heights, delimiter, np.array(spacing) / (unit or 1))
    blank = [""] if header and draft.chance(0.15) else []
    name = "map" + draft.one_of([".txt", ".txt", ".csv", ".dat", ".asc", ".TXT", ".tsv"])
    return draft.case(name, encoded(draft, [*header, *blank, *rows]), heights, unit, spacing, options)


def spoiled(draft, rows, heights, delimiter, spacing):
    """Rows of a file that holds no single map, a row that is none, or a first row and column with positions."""
    form = draft.one_of(["two blocks", "two blocks with comments", "ragged", "too long", "misprint", "axes"])
    cells = delimiter.join(["7"] * heights.shape[1])
    if form == "axes":  # positions of columns and rows, labelled
        draft.note("labelled axes", clear=False)
        x, y = ([f"{index * step:.6g}" for index in range(99)] for step in spacing)
        first = delimiter.join(["y\\x", *x[: heights.shape[1]]])
        return [first, *(f"{position}{delimiter}{row}" for position, row in zip(y, rows, strict=False))]
    draft.note(form, bad=True, faulty_line=form in ("ragged", "too long", "misprint"))
    if form == "two blocks":
        return [*rows, "", cells, cells]
    if form == "two blocks with comments":
        return [*rows, "", "# Channel: Phase", "# Value units: deg", cells, cells]
    at = int(draft.random.integers(len(rows)))
    wrong = {"ragged": delimiter.join(["7"] * (heights.shape[1] - 1)) or "7 7", "too long": cells + 3 * f"{delimiter}7"}
    return [*rows[:at], wrong.get(form, cells[:-1] + "7_x"), *rows[at + 1 :]]


# ---- columns x, y, z

HEADINGS = {
    "none": None,
    "x,y,z": ("x", "y", "z"),
    "x [u]": ("x [{u}]", "y [{u}]", "z [{z}]"),
    "X (u)": ("X ({u})", "Y ({u})", "Z ({z})"),
    "x[u]": ("x[{u}]", "y[{u}]", "z[{z}]"),
    "x/u": ("x/{u}", "y/{u}", "z/{z}"),
    "x_u": ("x_{u}", "y_{u}", "z_{z}"),
}
ODD_HEADINGS = {
    "x in u": ("x in {u}", "y in {u}", "z in {z}"),
    "x / u": ("x / {u}", "y / {u}", "z / {z}"),
    "Position x": ("Position x [{u}]", "Position y [{u}]", "Höhe [{z}]"),
    "z is height": ("x [{u}]", "y [{u}]", "height [{z}]"),
    "units below": ("x", "y", "z"),
    "x u": ("x {u}", "y {u}", "z {z}"),
    "y before x": ("y [{u}]", "x [{u}]", "z [{z}]"),
    "z first": ("z [{z}]", "x [{u}]", "y [{u}]"),
    "a fourth column": ("x [{u}]", "y [{u}]", "z [{z}]", "Intensity [1]"),
    "index first": ("No.", "x [{u}]", "y [{u}]", "z [{z}]"),
}
BAD_HEADINGS = {
    "z in volts": ("x [{u}]", "y [{u}]", "z [V]"),
    "x in seconds": ("x [s]", "y [s]", "z [{z}]"),
    "unit of z only": ("x", "y", "z [{z}]"),
    "no unit of z": ("x [{u}]", "y [{u}]", "z"),
    "degrees": ("lon [deg]", "lat [deg]", "z [{z}]"),
    "longitude": ("longitude", "latitude", "elevation"),
}


def points(random):
    """Columns x, y, z of the points of a grid, in any order."""
    draft = Draft("points", random)
    rows, columns = map_shape(draft)
    cells, heights = printed(draft, (rows, columns))
    if any(re.search(r"[^\d.eE+-]", cell) for row in cells for cell in row):  # no delimiter is left for thousands
        draft.note("semicolon")
        delimiter = ";"
    else:
        delimiter = draft.pick({"space": " ", "tab": "\t", "comma": ",", "semicolon": ";", "comma and space": ", "})
    dx, dy = distances(draft)
    decimals = 4
    if draft.chance(0.2):
        dx, dy, decimals = dx / 3, dy / 3, 5
        draft.note("rounded coordinates")
    x0, y0 = draft.one_of([(0, 0), (0, 0), (-7.5, 100), (0.25, -3)])
    if draft.chance(0.15):
        (x0, y0), dx, decimals = (500000.5, 5412345.25), draft.one_of([1.0, 0.5]), 2
        dy = dx
        draft.note("UTM")
    x, y = x0 + dx * np.arange(columns), y0 + dy * np.arange(rows)
    if draft.chance(0.04):
        draft.note("irregular", bad=True)
        x0, dx, decimals = 2e6, 2.0, 2
        x = np.sort(2e6 + 2 * np.arange(max(columns, 5)) + draft.random.uniform(-0.95, 0.95, max(columns, 5)))
        x[1] = x[0] + 1.13
        columns, cells = x.size, [[draft.one_of(row) for _ in x] for row in cells]
    xs, ys = ([f"{value:.{decimals}f}" for value in axis] for axis in (x, y))
    if draft.chance(0.2) and delimiter.strip() != ",":
        draft.note("decimal commas")
        xs, ys = ([text.replace(".", ",") for text in axis] for axis in (xs, ys))
        cells = [[cell.translate({ord("."): ",", ord(","): "."}) for cell in row] for row in cells]
    order = draft.pick({"x fastest": 0, "y fastest": 1, "shuffled": 2})
    places = [(i, j) for i in range(rows) for j in range(columns)]
    down, left = (draft.chance(0.3) for _ in range(2))
    places.sort(key=lambda p: ((-p[0] if down else p[0]), (-p[1] if left else p[1]))[:: -1 if order == 1 else 1])
    if order == 2:
        draft.random.shuffle(places)
    table = {place: [xs[place[1]], ys[place[0]], cells[place[0]][place[1]]] for place in places}
    heights = _with_gaps(draft, table, heights, delimiter)
    rounded = "rounded coordinates" in draft.traits and "UTM" not in draft.traits
    accuracy = 1e-9 + rounded * 10.0**-decimals / min((columns - 1) * dx, (rows - 1) * dy)
    u, z = draft.one_of(["um", "mm", "nm", "µm", "m"]), draft.one_of(["nm", "um", "m", "µm"])
    return _points_file(draft, table.values(), heights, (dx, dy), (u, z), delimiter, accuracy)


def _with_gaps(draft, table, heights, delimiter):
    """The heights with points missing; these are left out of the table, or marked in it."""
    form = draft.one_of(["all", "all", "left out", "nan", "empty", "No Data"])
    if form == "all" or draft.bad or (form == "empty" and not delimiter.strip()):
        return heights
    mask = draft.random.random(heights.shape) < 0.2
    kept = ~mask
    if not (kept.any(axis=0).all() and kept.any(axis=1).all() and kept.sum() > 3):
        return heights
    draft.note(f"missing: {form}", clear=form != "No Data" or bool(delimiter.strip(" ")))
    for place in [place for place in table if mask[place]]:
        if form == "left out":
            del table[place]
        else:
            table[place][2] = {"nan": "nan", "empty": "", "No Data": "No Data"}[form]
    return np.where(mask, np.nan, heights)


def _points_file(draft, table, heights, spacing, length_units, delimiter, accuracy):
    """The file of a table of points, with headings."""
    u, z = length_units
    titles = draft.pick(HEADINGS, ODD_HEADINGS, BAD_HEADINGS, odd=0.3)
    table, heading, suffix = [list(row) for row in table], [], draft.one_of([".txt", ".csv", ".xyz", ".dat"])
    unit, factor, options = UNITS[z], UNITS[u], {}
    if titles is None or titles == ("x", "y", "z"):
        unit, factor = None, 1.0
    if titles is None:
        if draft.chance(0.3):
            draft.note("Gwyddion XYZ")
            unit, factor = UNITS[z], UNITS[u]
            heading = ["# Channel: Topography", f"# Lateral units: {u}", f"# Value units: {z}"]
            draft.note(suffix, clear=suffix == ".xyz")
        elif draft.chance(0.7):
            suffix = ".xyz"
        else:
            draft.note(f"no heading, {suffix}", clear=suffix == ".xyz")
    else:
        for name, change in (("y before x", [1, 0, 2]), ("z first", [2, 0, 1])):
            if name in draft.traits:
                table = [[row[column] for column in change] for row in table]
        if "a fourth column" in draft.traits:
            table = [[*row, str(i % 7)] for i, row in enumerate(table)]
        if "index first" in draft.traits:
            table = [[str(i + 1), *row] for i, row in enumerate(table)]
        if len(titles) == 4 and draft.chance(0.5):
            options["spacing"] = tuple(float(f"{distance * factor / unit:.12g}") for distance in spacing)
        marked = "# " if draft.chance(0.4) else ""
        title_delimiter = delimiter if delimiter.strip(" ") or "_" in titles[0] or "/" in titles[0] else "  "
        heading = [marked + title_delimiter.join(titles).format(u=u, z=z)]
        if "units below" in draft.traits:
            heading.append(marked + delimiter.join([u, u, z]))
            unit, factor = UNITS[z], UNITS[u]
    if draft.bad:
        options = {}
    lines = [*heading, *(delimiter.join(row) for row in table)]
    metres = tuple(distance * factor for distance in spacing)
    return draft.case(f"points{suffix}", encoded(draft, lines), heights, unit, metres, options, accuracy=accuracy)


def zygo(random):
    """A Zygo XYZ Data File: columns and rows count pixels, heights are in micrometres, CameraRes in metres."""
    draft = Draft("Zygo XYZ", random)
    rows, columns = map_shape(draft)
    draft.decimals = 4
    heights = np.round(draft.random.normal(0, 2, (rows, columns)), 4)
    heights[draft.random.random((rows, columns)) < draft.one_of([0, 0.2])] = np.nan
    heights[0, 0] = heights[-1, -1] = 0.5
    x0, y0 = draft.one_of([(0, 0), (10, 20)])
    pixel = draft.one_of([3.9535e-4, 5.067e-5, 1.09e-6])
    calibrated = not draft.chance(0.1)
    head = [
        "Zygo XYZ Data File - Format 1",
        '0 3 0 0 "Tue Aug 25 16:59:23 2015"',
        f"0 0 {columns} {rows} 1 255",
        f"{x0} {y0} {columns} {rows}",
        *('"Sample B"', '"0815"', '"Wafer"'),
        f"0 0.5 6.328e-07 0 1 0 {pixel if calibrated else 0:g} 1440514763",
        '3 2 0 0 0 666666 0 ""',
        "0 0 1 33 0 0 0.1 60.4318 2 50",
        "0 1 100 0 0 0 0 0 0 0",
        *('0 ""', "1 5 0", "#"),
    ]
    gap = draft.one_of(["No Data", "No Data", None])
    body = [
        f"{x0 + j} {y0 + i} {gap if np.isnan(value) else f'{value:.4f}'}"
        for (i, j), value in np.ndenumerate(heights)
        if gap or not np.isnan(value)
    ]
    options = {}
    if not calibrated:
        draft.note("not calibrated", clear=False, bad=True)
    metres = pixel, pixel
    return draft.case("map.xyz", encoded(draft, [*head, *body, "#"]), heights, 1e-6, metres, options)


def esri(random):
    """An ESRI ASCII grid."""
    draft = Draft("ESRI grid", random)
    rows, columns = map_shape(draft)
    cells, heights = printed(draft, (rows, columns))
    if any(re.search(r"[^\d.eE+-]", cell) for row in cells for cell in row):
        cells = [[f"{value:.3f}" for value in row] for row in heights]
        heights = np.array([[float(cell) for cell in row] for row in cells])
        draft.clear = True
    mark = draft.pick(
        {"-9999": "-9999", "-9999.0": "-9999.0", "none": None, "nan": "nan", "-99": "-99"},
        {"-3.4e38, rounded": "-3.402823e+38", "1e38": "1e38"},
    )
    mask = missing_points(draft, heights.shape)
    stated = "-3.4028234663852886e+38" if mark == "-3.402823e+38" else mark
    cells = [
        [mark or "-9999" if m else c for c, m in zip(*pair, strict=True)] for pair in zip(cells, mask, strict=True)
    ]
    heights = np.where(mask | (heights == float(mark or -9999)), np.nan, heights)
    dx, dy = distances(draft, square=draft.chance(0.7))
    corner = draft.pick({"corner": "corner", "center": "center"})
    sides = [("cellsize", f"{dx:g}")] if dx == dy else [("dx", f"{dx:g}"), ("dy", f"{dy:g}")]
    counts = [columns, rows]
    body = [" ".join(row) for row in cells]
    form = draft.pick(
        {"a row per line": 0, "a leading space": 1},
        {"wrapped": 2, "one line": 3, "decimal commas": 4},
        {"lines contradict": 5, "too few": 6, "too many": 7, "a row lacks a number": 8},
        odd=0.3,
    )
    if form == 1:
        body = [f" {row}" for row in body]
    elif form == 2:
        half = math.ceil(columns / 2)
        body = [" ".join(part) for row in cells for part in (row[:half], row[half:]) if part]
    elif form == 3:
        body = [" ".join(body)]
    elif form == 4:
        body = [row.replace(".", ",") for row in body]
    elif form == 5:
        if rows % columns and columns % rows:
            counts = [rows, columns]
        else:  # lines of other lengths, in all the right number
            body = [*body[:-2], " ".join(cells[-2][:-1]), " ".join([cells[-2][-1], *cells[-1]])]
    elif form == 6:
        body = body[:-1]
    elif form == 7:
        body.append(body[-1])
    elif form == 8:
        body[0] = " ".join(cells[0][:-1])
    head = [("ncols", counts[0]), ("nrows", counts[1]), (f"xll{corner}", "500000.5"), (f"yll{corner}", "5400000")]
    head += sides + ([] if stated is None else [("NODATA_value", stated)])
    lettering = draft.pick({"lower case": str, "upper case": str.upper, "lower only": str.lower})
    gap = draft.one_of([" ", "         ", "\t"])
    lines = [*(f"{lettering(name)}{gap}{value}" for name, value in head), *body]
    unit, options = None, {}
    if draft.chance(0.3):
        draft.note("unit given")
        unit, options = 1.0, {"unit": "m"}
        draft.clear = False  # the unit of the coordinates is not stated
    return draft.case("grid.asc", encoded(draft, lines), heights, unit, (dx, dy), options)
