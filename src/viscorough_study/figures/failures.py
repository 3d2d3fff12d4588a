"""Draw the failure map: error and outcome of every method in every stress test."""

from itertools import pairwise

import numpy as np
from matplotlib.colors import ListedColormap

from viscorough_study.figures import style
from viscorough_study.robustness.outcomes import wrong_without_warning

# Outcomes, {verdict of the failure map: (label, color of a cell, color of its text)}.
OUTCOMES = {
    "holds": ("right, within the limit of the method", style.BLUE, "white"),
    "model": ("model, within a factor of two", style.SKY_BLUE, style.BLACK),
    "stated": ("wrong, a model outside its documented range", "#f7dc9c", style.BLACK),
    "warned": ("wrong, with a warning", style.ORANGE, style.BLACK),
    "refused": ("refused, with a reason", style.PALE, style.BLACK),
    "unnoticed": ("silently wrong", style.BLACK, "white"),
}


@style.figure
def plot_failures(table):
    """Draw a table of the error (number) and outcome (colour) of each method (columns) in each stress test (rows).

    table : table of robustness.failure_map
    """
    methods, rows = list(table["method"].unique()), list(dict.fromkeys(zip(table["group"], table["test"], strict=True)))
    figure, axes = style.new_subplots(4.4 * len(rows) + 42)
    outcomes = np.zeros((len(rows), len(methods)))
    names = list(OUTCOMES)
    for cell in table.itertuples():
        i, j = rows.index((cell.group, cell.test)), methods.index(cell.method)
        outcomes[i, j] = names.index(cell.verdict)
        axes.text(j, i, _cell_text(cell), ha="center", va="center", color=OUTCOMES[cell.verdict][2])
    colors = ListedColormap([color for _, color, _ in OUTCOMES.values()])
    axes.imshow(outcomes, cmap=colors, vmin=-0.5, vmax=len(names) - 0.5, aspect="auto")
    axes.set_xticks(range(len(methods)), methods)
    axes.set_yticks(range(len(rows)), [f"{group}: {test}" for group, test in rows])
    axes.tick_params(which="both", length=0, top=False, labeltop=True, labelbottom=False, right=False)
    for column in range(1, len(methods)):
        axes.axvline(column - 0.5, color="white", linewidth=1)
    for row, ((last, _), (group, _)) in enumerate(pairwise(rows), 1):
        axes.axhline(row - 0.5, color="white", linewidth=0.5 if group == last else 2.5)
    stated, silent = wrong_without_warning(table)
    axes.set_title(f"{silent} of {len(table)} results are silently wrong; {stated} are models outside their range")
    handles = [style.handle(label, color=color, linewidth=7) for label, color, _ in OUTCOMES.values()]
    figure.legend(handles=handles, loc="outside lower center", ncols=3, handlelength=1.2)
    return figure


def _cell_text(cell):
    """Return the error with one digit, such as 4e-15, 0.3 or 300; nothing if the method refuses the test."""
    if cell.verdict == "refused":
        return ""
    return f"{cell.error:.1g}" if cell.error < 1 else f"{float(f'{cell.error:.1g}'):.0f}"
