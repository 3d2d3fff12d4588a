"""Headers of text files as instruments and programs write them; for text_files.py.

In the tables, {dx} and {dy} are spacings with the unit {u}, {w} and {h} width and height of the map, {k} the spacing of
squares, {z} the unit of heights; {kz} is in that unit, and {dx2} contradicts {dx}. CLEAR headers are unambiguous,
UNCLEAR ones may be refused, BAD ones must be.
"""

import re

from file_cases import PIXELS, UNITS, distances


def _table(text):
    """{name: lines} of a text with a header per line, its name and lines separated by bars."""
    return {name: lines for name, *lines in (line.split(" | ") for line in text.strip().splitlines())}


GWYDDION = _table("""
Gwyddion, English | Channel: Topography | Width: {w} {u} | Height: {h} {u} | Value units: {z}
Gwyddion, partly German | Kanal: Höhe | Breite: {w} {u} | Höhe: {h} {u} | Value units: {z}
Gwyddion, German | Kanal: Topographie | Breite: {w} {u} | Höhe: {h} {u} | Werteinheiten: {z}
Gwyddion, French | Canal : Topographie | Largeur : {w} {u} | Hauteur : {h} {u} | Unités : {z}
French | Canal: Relief | Largeur: {w} {u} | Hauteur: {h} {u} | Unités de valeur: {z}
""")
CLEAR = GWYDDION | _table("""
X and Y pixel size | X pixel size: {dx} {u} | Y pixel size: {dy} {u} | Z unit: {z}
pixel size a x b | pixel size: {dx} {u} x {dy} {u} | Z unit: {z}
pixel size | pixel size: {k} {u} | Height unit: {z}
Pixel size = | Pixel size = {k} {u} | Z units = {z}
Pixel_size | Pixel_size = {k} {u} | Z_unit = {z}
X pixel size (u) | X pixel size ({u}): {dx} | Y pixel size ({u}): {dy} | Z unit: {z}
dx, dy | dx = {dx} {u} | dy = {dy} {u} | z unit: {z}
dx=, dy= | dx={dx} {u} | dy={dy} {u} | z_unit={z}
x and y spacing | x spacing = {dx} {u} | y spacing = {dy} {u} | z units: {z}
one unit for all | pixel size: {kz} {z} | unit: {z}
spacing | spacing: {k} {u} | z unit: {z}
""")
UNCLEAR = _table("""
X, Y, Z units | X units: {u} | Y units: {u} | Z units: {z} | dx = {dx} | dy = {dy}
XY units | XY units: {u} | Z units: {z} | X pixel size: {dx} | Y pixel size: {dy}
lateral and height unit | Lateral unit: {u} | Height unit: {z} | pixel size: {k}
lateral and value units | Lateral units: {u} | Value units: {z} | x spacing: {dx} | y spacing: {dy}
X and Z units beside | X units: {u} | Z units: {z} | pixel size: {k} {u}
X units beside | X units: {u} | Units: {z} | pixel size: {k} {u}
pixel size a x b, one unit | pixel size: {dx} x {dy} {u} | unit: {z}
pixel size a u, b u | pixel size: {dx} {u}, {dy} {u} | z unit: {z}
spacing: a, b u | spacing: {dx}; {dy} {u} | z unit: {z}
pixel size without unit | pixel size: {kz} | unit: {z}
dx [u] | dx [{u}] = {dx} | dy [{u}] = {dy} | z [{z}]
units differ | X pixel size: {kz} {z} | Y pixel size: {k} {u} | z unit: {z}
x and y size | x size: {w} {u} | y size: {h} {u} | z unit: {z}
scan size a x b | Scan size: {w} {u} x {h} {u} | z unit: {z}
no space | dx={dx}{u} | dy={dy}{u} | z unit={z}
German pixel size | Pixelgröße: {k} {u} | Einheit: {z}
German pixel sizes | Pixelgröße X: {dx} {u} | Pixelgröße Y: {dy} {u} | Einheit Z: {z}
German spacing | Punktabstand: {k} {u} | Höheneinheit: {z}
French pixel size | Taille de pixel : {k} {u} | Unité : {z}
French spacing | Pas en x : {dx} {u} | Pas en y : {dy} {u} | Unité de z : {z}
dx repeated | dx = {dx} {u} | dx = {dx} {u} | dy = {dy} {u} | z unit: {z}
size and dx | Width: {w} {u} | Height: {h} {u} | dx = {dx} {u} | dy = {dy} {u} | Value units: {z}
sample height | Sample height: 12 mm | dx = {dx} {u} | dy = {dy} {u} | z unit: {z}
tip | Tip width: 10 nm | Tip height: 3 um | pixel size: {k} {u} | z unit: {z}
""")
BAD = _table("""
two pixel sizes | pixel size: {dx} {u} | pixel size: {dx2} {u} | z unit: {z}
two dx | dx = {dx} {u} | dx = {dx2} {u} | dy = {dy} {u} | z unit: {z}
two units | pixel size: {k} {u} | Z units: um | Z units: nm
two kinds of unit | pixel size: {k} {u} | Value units: um | Z unit: nm
size contradicts dx | Width: {w} {u} | Height: {h} {u} | dx = {dx2} {u} | Value units: {z}
unit of one direction | Width: {w} {u} | Height: {h} | Value units: {z}
heights in volts | pixel size: {k} {u} | Value units: V
spacing in seconds | pixel size: {k} s | Value units: {z}
no unit of heights | pixel size: {k} {u}
size in pixels | Width: {columns} px | Height: {rows} px | Value units: {z}
pixels of 1 px | Pixel size: 1 pixel | Value units: {z}
""")
WITHOUT_SPACING = {"no header": []} | _table("""
value units | Value units: {z}
unit | unit: {z}
z unit | Z unit: {z}
""")
WITH_PIXELS = _table("""
width in pixels | Width: {columns} {p} | Height: {rows} {p} | Value units: {z}
pixel size 1 px | Pixel size: 1 {p} | Value units: {z}
x units pixels | X units: {p} | Y units: {p} | Z units: {z}
scan size in pixels | Scan size: {columns} x {rows} {p} | Z units: {z}
heights in pixels | Z units: {p}
""")


def header_lines(draft, shape, decimal_comma):
    """(lines, unit of the heights in metres or None, spacing as Case has it, options) of a header or none.

    decimal_comma : whether numbers of the table have decimal commas, which those of the header then have, too
    """
    rows, columns = shape
    u, z = (draft.one_of(["um", "um", "nm", "mm", "m", "µm", *UNITS]) for _ in range(2))
    if states_spacing := draft.chance(0.6):
        lines = draft.pick(CLEAR, UNCLEAR, BAD, odd=0.25)
    else:
        lines = draft.pick([], WITH_PIXELS, odd=1) if draft.chance(0.15) else draft.pick(WITHOUT_SPACING)
    dx, dy = distances(draft, square=any("{k" in line for line in lines))
    if states_spacing:
        in_z = not any("{u}" in line for line in lines)
        unit, spacing = UNITS[z], tuple(distance * UNITS[z if in_z else u] for distance in (dx, dy))
        options = _redundant_options(draft, unit, spacing)
    else:
        unit, spacing, options, z = _options_needed(draft, lines, (dx, dy), z)
    in_z = states_spacing and in_z
    numbers = {"dx": dx, "dy": dy, "dx2": 3 * dx, "k": dx, "kz": dx if in_z else dx * UNITS[u] / UNITS[z]}
    numbers |= {"w": round(dx * columns, 9), "h": round(dy * rows, 9)}
    texts = {name: f"{value:.15g}" for name, value in numbers.items()}
    if lines and (decimal_comma or draft.chance(0.04)):
        texts = {name: text.replace(".", ",") for name, text in texts.items()}
        listed = any(re.search(r"\}[^{]*[,;].*\{", line) for line in lines)
        draft.note("decimal commas in the header", clear=decimal_comma and not listed)
    if len(lines) > 1 and draft.chance(0.25) and not GWYDDION.keys() & set(draft.traits):
        lines = list(draft.random.permutation(lines))
        draft.note("header in another order")
    texts |= {"u": u, "z": z, "p": draft.one_of(PIXELS), "columns": columns, "rows": rows}
    return [line.format(**texts) for line in lines], unit, spacing, options


def _redundant_options(draft, unit, spacing):
    """Now and then a spacing that the file states, too, or that contradicts it."""
    if not draft.clear or not draft.chance(0.1):  # who does not understand a header may believe the argument
        return {}
    dx, dy = (float(f"{distance / unit:.12g}") for distance in spacing)
    agrees = draft.chance(0.5)
    draft.note("spacing given, too" if agrees else "another spacing given", bad=not agrees)
    return {"spacing": (dx if agrees else 1.1 * dx, dy)}


def _options_needed(draft, lines, spacing, z):
    """(unit, spacing, options, name of the unit) where the file states no spacing, and a unit of heights or none."""
    in_file, options = any("{z}" in line for line in lines), {}
    if not in_file and draft.chance(0.4):
        draft.note("unit given")
        z = options["unit"] = draft.one_of(["m", "mm", "um", "nm"])
    unit = UNITS[z] if in_file or options else None
    if draft.chance(0.05):
        draft.note("no spacing at all", bad=True)
    else:
        options["spacing"] = spacing[0] if spacing[0] == spacing[1] and draft.chance(0.5) else spacing
    return unit, tuple(distance * (unit or 1) for distance in spacing), options, z
