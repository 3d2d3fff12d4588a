"""Random text files with a matrix of heights, as instruments and programs write them; for file_campaign.py."""

import re

import numpy as np
from file_cases import Draft, map_shape, missing_points
from text_headers import GWYDDION, header_lines

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
    "thousands with no-break spaces": lambda value, _: f"{1000 * value:,.2f}".replace(",", "\u00a0"),
    "thousands with thin spaces": lambda value, _: f"{1000 * value:,.2f}".replace(",", "\u202f"),
}
PLAIN = str.maketrans({"\u2212": "-", "D": "e", **dict.fromkeys(",'\u00a0\u202f")})
SWAPPED = str.maketrans(".,", ",.")
DELIMITERS = {"space": " ", "spaces": "   ", "aligned": " ", "tab": "\t", "comma": ",", "semicolon": ";"}
DELIMITERS |= {"comma and space": ", ", "semicolon and space": "; "}
ODD_DELIMITERS = {"pipe": "|", "spaced pipe": " | ", "tab and space": "\t ", "spaced semicolon": " ; "}
MARKS = ("nan", "NaN", "NAN", "NA", "N/A", "null", "BAD", "***", "--", "---", "void")
ODD_MARKS = ("None", "-", "?", "#N/A", "#NV", "n.a.", "masked", "<0.1", "NULL", "n/a", "*", "missing", ".", "x", "±")
ODD_MARKS += ("#DIV/0!", "1.#QNAN", "-nan(ind)", "----", "fehlt")
NUMBER_MARKS = ("-9999", "-99999", "-32768", "1e38")


def printed(draft, shape):
    """Numbers as they are printed, with a decimal point, and their values."""
    form, decimals = draft.pick(FORMATS, ODD_FORMATS, odd=0.1), int(draft.random.integers(1, 7))
    cells = [[form(value, decimals) for value in row] for row in draft.random.normal(0, 30, shape)]
    return cells, np.array([[float(cell.translate(PLAIN)) for cell in row] for row in cells])


def are_plain(cells):
    """Whether numbers are printed with digits, points, signs and exponents e only."""
    return all(re.fullmatch(r"[\d.eE+-]+", cell) for row in cells for cell in row)


def table_text(draft, shape):
    """(rows of text, heights, delimiter, whether decimals have commas, options) of a matrix with points missing."""
    cells, heights = printed(draft, shape)
    delimiter = draft.pick(DELIMITERS, ODD_DELIMITERS, odd=0.06)
    quoted = draft.chance(0.08)
    grouped = any(set(cell) & set(",\u00a0\u202f") for row in cells for cell in row)
    if grouped and not quoted and (delimiter.strip() == "," or not delimiter.strip(" ")):
        delimiter = ";"
        draft.note("semicolon")
    has_comma = delimiter.strip() == ","
    # Decimal commas between mere commas say nothing to anyone, unless in quotes.
    decimal_comma = draft.chance(0.3) and not {"integers", "D exponents"} & set(draft.traits)
    decimal_comma &= delimiter != "," or quoted
    if decimal_comma:
        cells = [[cell.translate(SWAPPED) for cell in row] for row in cells]
        draft.note("decimal commas", clear=not has_comma and _are_decimals(cells, delimiter))
    elif has_comma and "integers" in draft.traits:
        digits = {len(cell) for row in cells for cell in row[1:]}
        draft.note("", clear=shape[1] > 2 and digits != {3})  # else they may be decimals or thousands
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
    rows = [delimiter.join(row) for row in cells]
    if "aligned" in draft.traits and delimiter == " ":
        width = max(len(cell) for row in cells for cell in row) + 1
        rows = ["".join(cell.rjust(width) for cell in row) for row in cells]
    if draft.chance(0.06):
        draft.note("trailing delimiters")
        rows = [row + delimiter for row in rows]
    elif draft.chance(0.02) and delimiter.strip(" "):
        draft.note("leading delimiters", clear=False)
        rows = [delimiter + row for row in rows]
    return rows, heights, delimiter, decimal_comma, options


def _are_decimals(cells, delimiter):
    """Whether commas in numbers cannot be taken for thousands separators or delimiters."""
    numbers = [cell for row in cells for cell in row]
    if all(re.fullmatch(r"[+-]?[1-9]\d{0,2},\d{3}", number) for number in numbers):
        return False
    return bool(delimiter.strip(" ")) or all(re.search(r"\d,\d", number) for number in numbers)


def _mark(draft, delimiter, mask):
    """The mark of missing points; an empty cell only where a delimiter shows it."""
    rows_missing = mask.all(axis=1)
    at_an_end = rows_missing[0] or rows_missing[-1]
    if delimiter.strip(" ") and draft.chance(0.55) and not (mask[:, 0].all() or mask[:, -1].all()):
        blank = rows_missing.any() and (delimiter.isspace() or at_an_end)  # as spreadsheets leave below a table
        draft.note("empty cells", clear=not blank)
        return ""
    if draft.chance(0.08):
        return draft.pick(NUMBER_MARKS)
    mark = draft.pick(MARKS, ODD_MARKS, odd=0.2)
    if rows_missing.any() and mark.lower() != "nan":  # may be a title, or a rule
        draft.note("row of marks", clear=mark.isalpha() and not at_an_end)
    draft.faulty_line |= mark in ODD_MARKS and not mask.any(axis=1).all()  # else there is no other row to compare with
    return mark


# ---- remarks, comments

REMARKS = (
    *("Measured with a profilometer", "Messung vom Labor, Probe B", "Mesure de la surface, échantillon C"),
    *("Date: 2024-05-01 10:11:12", "Operator: A. Meier", "Temperature: 23 °C", "Objective: 50x", "Filter = none"),
)
ODD_REMARKS = ("Tip radius: 10 nm", "Scan rate: 1.0 Hz", "Scan speed: 2 um/s", "2024-05-01 10:11", "# 1 2 3", "Unit 7")
COMMENTS = {"#": "# ", "#, no space": "#", "%": "% ", "//": "// ", "unmarked header": ""}
ODD_COMMENTS = {"comments ;": "; ", "comments !": "! ", "comments *": "* "}


def with_header(draft, header, rows, delimiter, columns):
    """The lines of a file: header, remarks, names of columns, rows, comments."""
    lines = list(header)
    if draft.chance(0.2):
        odd = draft.chance(0.2)
        draft.note("odd remark" if odd else "remark", clear=not odd)
        lines.insert(int(draft.random.integers(len(lines) + 1)), draft.one_of(ODD_REMARKS if odd else REMARKS))
    mark = draft.pick(COMMENTS, ODD_COMMENTS, odd=0.05) if lines else "# "
    lines = [mark + line for line in lines]
    if columns > 2 and draft.chance(0.04) and delimiter.strip() and '"' not in rows[0]:
        draft.note("names of columns")
        lines.append(delimiter.join("ABCDEFGHIJKLMNOP"[:columns]))
    if lines and draft.chance(0.15):
        lines.append("")
    return lines + _with_comments(draft, rows, mark if mark.strip() in ("#", "%", "//") else "# ")


def _with_comments(draft, rows, mark):
    """Rows with comments between or after them, or behind one; or with blank lines between."""
    forms = [*["none"] * 40, *["between", "after", "behind"] * 3, "text between", "text after", "blank lines between"]
    form, at = draft.one_of(forms), int(draft.random.integers(1, len(rows) + 1))
    if form == "none" or (form == "behind" and not rows[at - 1].strip()):
        return rows
    draft.note(f"comments: {form}", clear=form in ("between", "after", "behind"))
    if form == "behind":
        return [*rows[: at - 1], f"{rows[at - 1]} # checked", *rows[at:]]
    if form == "blank lines between":
        return [line for row in rows for line in (row, "")]
    comment = {"between": [f"{mark}line {at}"], "text between": ["second part"], "text after": ["End of data"]}
    at = at if form.endswith("between") else len(rows)
    return [*rows[:at], *comment.get(form, ["", f"{mark}end of data"]), *rows[at:]]


# ---- whole files

ENCODINGS = ("utf-8", "utf-8-sig", "latin-1", "cp1252", "utf-16 LE", "utf-16 BE")
LINE_ENDS = {"LF": "\n", "CR LF": "\r\n", "CR": "\r"}


def encoded(draft, lines):
    """The bytes of a text file of these lines."""
    end = draft.pick(LINE_ENDS, {"CR CR LF": "\r\r\n"}, odd=0.03)
    text = end.join(lines) + draft.pick({"": end, "no final line end": "", "blank lines at the end": 3 * end})
    encoding = "utf-8" if draft.chance(0.6) else draft.pick(ENCODINGS, ["utf-16 without mark"], odd=0.02)
    try:
        content = text.encode("utf-16-le" if "without" in encoding else encoding.lower().replace(" ", "-"))
    except UnicodeEncodeError:
        return text.encode()
    return {"utf-16 LE": b"\xff\xfe", "utf-16 BE": b"\xfe\xff"}.get(encoding, b"") + content


def matrix(random):
    """A matrix of heights with a header or none."""
    draft = Draft("matrix", random)
    rows, columns = shape = map_shape(draft)
    if draft.chance(0.03):
        rows, columns = shape = draft.one_of([(1, columns), (rows, 1)])
        draft.note("a single line", clear=False)
    if columns > 1:
        lines, heights, delimiter, decimal_comma, preparation = table_text(draft, shape)
    else:
        heights = np.round(draft.random.normal(0, 9, shape), 3)
        lines, delimiter, decimal_comma, preparation = [f"{value:.3f}" for value in heights[:, 0]], ";", False, {}
    header, unit, spacing, options = header_lines(draft, shape, decimal_comma)
    if GWYDDION.keys() & set(draft.traits):
        draft.kind = "matrix, Gwyddion"
    lines = with_header(draft, header, lines, delimiter, columns)
    name = "map" + draft.one_of([".txt", ".txt", ".csv", ".dat", ".asc", ".TXT", ".tsv"])
    return draft.case(name, encoded(draft, lines), heights, unit, spacing, options | preparation)
