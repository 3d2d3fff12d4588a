"""Headers of text files as instruments and programs write them; for text_files.py.

The headers of text_headers.yaml that are CLEAR are unambiguous, UNCLEAR ones may be refused, BAD ones must be.
"""

import re
from pathlib import Path

import yaml
from file_cases import PIXELS, UNITS, distances

TABLES = yaml.safe_load(Path(__file__).with_suffix(".yaml").read_text(encoding="utf-8"))


def _table(kind):
    """{name: lines} of the headers of a kind."""
    return {name: lines for name, *lines in (line.split(" | ") for line in TABLES[kind].splitlines())}


GWYDDION = _table("Gwyddion")
CLEAR = GWYDDION | _table("clear")
UNCLEAR, BAD, WITH_PIXELS = _table("unclear"), _table("bad"), _table("with pixels")
WITHOUT_SPACING = {"no header": []} | _table("without spacing")


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
