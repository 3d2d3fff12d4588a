"""Failure map: error and verdict of every method in every stress-test case."""

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from viscorough_study.figures.style import GREY, MM, PALE, STYLE, WIDE, require_rows

LETTERS = {
    "holds": "H",
    "model": "M",
    "stated": "S",
    "warned": "W",
    "refused": "R",
    "not offered": "N",
    "unnoticed": "U",
}
FLOOR = 1e-16  # smaller errors are drawn here
NORM = LogNorm(FLOOR, 10)


@rc_context(STYLE)
def plot_failure_map(table):
    """Error, as colour and number, and verdict, as letter, of every method (columns) in every case (rows).

    table : of viscorough_study.robustness.failure_map. Raises ValueError for a table without rows.
    """
    require_rows("plot_failure_map", table)
    methods = list(dict.fromkeys(table["method"]))
    rows = list(dict.fromkeys(zip(table["group"], table["case"], strict=True)))
    figure = Figure(figsize=(WIDE, (4.1 * len(rows) + 32) * MM))
    axes = figure.subplots()
    errors = np.full((len(rows), len(methods)), np.nan)
    for cell in table.itertuples():
        i, j = rows.index((cell.group, cell.case)), methods.index(cell.method)
        if cell.verdict != "refused":
            errors[i, j] = max(cell.error, FLOOR)
        color = "white" if NORM(errors[i, j]) < 0.55 else "black"
        axes.text(j, i, _cell_text(cell), ha="center", va="center", fontsize=7, color=color)
    axes.set_facecolor(PALE)  # where there is no answer
    image = axes.imshow(errors, cmap=colormaps["cividis"], norm=NORM, aspect="auto")
    axes.set_xticks(
        range(len(methods)),
        [name.replace(", ", ",\n").replace("w with", "w\nwith").replace("t s", "t\ns") for name in methods],
    )
    axes.set_yticks(range(len(rows)), [name for _, name in rows])
    axes.tick_params(which="both", length=0, top=False, labeltop=True, labelbottom=False, right=False, labelsize=7)
    axes.minorticks_off()
    _name_groups(axes, [group for group, _ in rows], len(methods) - 0.4)
    bar = figure.colorbar(image, ax=axes, location="bottom", aspect=50, pad=0.01, fraction=0.02)
    bar.set_label("largest relative error [1]")
    figure.supxlabel(", ".join(f"{letter}: {verdict}" for verdict, letter in LETTERS.items()), fontsize=8)
    return figure


def _cell_text(cell):
    """Error in one digit and letter of the verdict; of a refusal just the letter."""
    if cell.verdict == "refused":
        return LETTERS["refused"]
    number = f"{cell.error:.0e}".replace("e-0", "e-").replace("e+0", "e") if cell.error else "0"
    return f"{number} {LETTERS[cell.verdict]}"


def _name_groups(axes, groups, x):
    """Names of the groups of rows at x, and white lines between the groups."""
    for group in dict.fromkeys(groups):
        first = groups.index(group)
        if first:
            axes.axhline(first - 0.5, color="white", linewidth=2)
        middle = first + (groups.count(group) - 1) / 2
        rotation = -90 if groups.count(group) > 1 else 0
        axes.text(x, middle, group, rotation=rotation, va="center", fontsize=7, color=GREY)
