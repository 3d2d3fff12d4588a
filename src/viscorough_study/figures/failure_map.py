"""Draw the failure map: error and verdict of every method in every stress-test case that can affect the method."""

from itertools import pairwise

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LogNorm
from matplotlib.patches import Rectangle

from viscorough_study.figures import style

MEANINGS = {
    "holds": "within the limit of the method",
    "model": "model, within a factor of two",
    "stated": "model outside its stated range",
    "warned": "wrong, with a warning",
    "refused": "refused, with a reason",
    "unnoticed": "wrong without notice",
}
LETTERS = {verdict: verdict[0].upper() for verdict in MEANINGS}
# Groups of stress-test cases whose difficulty affects only some methods, as {group: beginnings of the names of these
# methods}.
CONCERNED = {
    "step size": ("explicit steps",),
    "force in time": ("explicit steps",),
    "tolerance": ("path",),
    "medium": ("media",),
}
FLOOR = 1e-16  # smaller errors are drawn at this value
NORM = LogNorm(FLOOR, 10)


@style.figure
def plot_failure_map(table):
    """Draw a table of the error (colour, number) and verdict (letter) of each method (columns) in each test (rows).

    The tests are the stress-test cases of robustness.stress_cases. A cell is blank if the difficulty of the case does
    not affect the method, unless the method refuses the case or fails unnoticed.
    table : table of viscorough_study.robustness.failure_map
    """
    methods, rows = list(table["method"].unique()), list(dict.fromkeys(zip(table["group"], table["case"], strict=True)))
    figure, axes = style.new_subplots(3.7 * len(rows) + 58)
    errors = np.full((len(rows), len(methods)), np.nan)
    for cell in table.itertuples():
        i, j = rows.index((cell.group, cell.case)), methods.index(cell.method)
        if not _concerns(cell):
            continue
        if cell.verdict == "refused":
            axes.add_patch(Rectangle((j - 0.5, i - 0.5), 1, 1, color=style.PALE, linewidth=0))
        else:
            errors[i, j] = max(cell.error, FLOOR)
        color = "white" if NORM(errors[i, j]) < 0.55 else "black"
        axes.text(j, i, _cell_text(cell), ha="center", va="center", color=color)
    image = axes.imshow(errors, cmap=colormaps["cividis"], norm=NORM, aspect="auto")
    axes.set_xticks(range(len(methods)), methods, rotation=90)
    axes.set_yticks(range(len(rows)), [f"{group}: {case}" for group, case in rows])
    axes.tick_params(which="both", length=0, top=False, labeltop=True, labelbottom=False, right=False)
    for column in range(1, len(methods)):
        axes.axvline(column - 0.5, color="white", linewidth=0.6)
    for row, ((last, _), (group, _)) in enumerate(pairwise(rows), 1):
        if group != last:
            axes.axhline(row - 0.5, color="white", linewidth=1.5)
    bar = figure.colorbar(image, ax=axes, location="bottom", aspect=60, shrink=0.8, pad=0.01, fraction=0.02)
    bar.set_label("largest relative error")
    meanings = [f"{letter}: {MEANINGS[verdict]}" for verdict, letter in LETTERS.items()]
    handles = [style.handle(text, linestyle="") for text in (*meanings, "blank: cannot matter")]
    figure.legend(handles=handles, loc="outside lower center", ncols=3, handlelength=0, handletextpad=0)
    return figure


def _concerns(cell):
    """Return True if a cell of the failure map is filled, False if it stays blank.

    A cell is filled if the difficulty of the stress-test case affects the method. It is also filled if the method
    refuses the case or fails unnoticed.
    cell : row of the table of the failure map
    """
    names = CONCERNED.get(cell.group)
    return names is None or cell.method.startswith(names) or cell.verdict in ("refused", "unnoticed")


def _cell_text(cell):
    """Return the text in a cell of the failure map: the error (one digit) and the letter of the verdict.

    If the method refuses the stress-test case, the text is only the letter.
    """
    if cell.verdict == "refused":
        return LETTERS["refused"]
    number = f"{cell.error:.0e}".replace("e-0", "e-").replace("e+00", "").replace("e+0", "e")
    return f"{number if cell.error else 0} {LETTERS[cell.verdict]}"
