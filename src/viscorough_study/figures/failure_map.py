"""Figures of stability: the chart of methods and difficulties, and the curves that tell most."""

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from viscorough_study.figures.style import GREY, MM, PALE, STYLE, WIDE, logarithmic_ticks

LETTERS = {
    "holds": "H",
    "model": "M",
    "stated": "S",
    "warned": "W",
    "refused": "R",
    "not offered": "N",
    "unnoticed": "U",
}
FLOOR = 1e-16  # errors below are drawn here
WARNED = 0.01  # penetration over depth from which on explicit marching warns


@rc_context(STYLE)
def plot_atlas(table):
    """Error, as colour and number, and verdict, as letter, of every method (columns) in every difficulty (rows).

    Raises ValueError for a table without rows.
    """
    if table.empty:
        raise ValueError("plot_atlas: the table has no rows; at least one is needed")
    methods = list(dict.fromkeys(table["method"]))
    rows = list(dict.fromkeys(zip(table["group"], table["difficulty"], strict=True)))
    place = {row: i for i, row in enumerate(rows)}
    figure = Figure(figsize=(WIDE, (4.1 * len(rows) + 32) * MM))
    axes = figure.subplots()
    norm, colours = LogNorm(FLOOR, 10), colormaps["cividis"]
    errors = np.full((len(rows), len(methods)), np.nan)
    for cell in table.itertuples():
        i, j = place[cell.group, cell.difficulty], methods.index(cell.method)
        refused = cell.verdict == "refused"
        errors[i, j] = np.nan if refused else max(cell.error, FLOOR)
        dark = not refused and norm(errors[i, j]) < 0.55
        text = f"{cell.error:.0e}".replace("e-0", "e-").replace("e+0", "e") if cell.error else "0"
        text = "" if refused else text
        style = {"ha": "center", "va": "center", "fontsize": 7, "color": "white" if dark else "black"}
        axes.text(j, i, f"{text} {LETTERS[cell.verdict]}".strip(), **style)
    axes.set_facecolor(PALE)  # where there is no answer
    image = axes.imshow(errors, cmap=colours, norm=norm, aspect="auto")
    axes.set_xticks(
        range(len(methods)),
        [name.replace(", ", ",\n").replace("w with", "w\nwith").replace("t s", "t\ns") for name in methods],
    )
    axes.set_yticks(range(len(rows)), [name for _, name in rows])
    axes.tick_params(which="both", length=0, top=False, labeltop=True, labelbottom=False, right=False, labelsize=7)
    axes.minorticks_off()
    groups = [group for group, _ in rows]
    for group in dict.fromkeys(groups):
        first = groups.index(group)
        if first:
            axes.axhline(first - 0.5, color="white", linewidth=2)
        middle = first + (groups.count(group) - 1) / 2
        long = groups.count(group) > 1
        axes.text(len(methods) - 0.4, middle, group, rotation=-90 if long else 0, va="center", fontsize=7, color=GREY)
    bar = figure.colorbar(image, ax=axes, location="bottom", aspect=50, pad=0.01, fraction=0.02)
    bar.set_label("largest relative error [1]")
    figure.supxlabel(", ".join(f"{letter}: {verdict}" for verdict, letter in LETTERS.items()), fontsize=8)
    return figure


@rc_context(STYLE)
def plot_curves(table):
    """Error against explicit steps and against contact fraction.

    Raises ValueError for a table without rows.
    """
    if table.empty:
        raise ValueError("plot_curves: the table has no rows; at least one is needed")
    figure = Figure(figsize=(WIDE, 80 * MM))
    steps, contact = figure.subplots(1, 2)

    for (name, part), marker, colour in zip(_parts(table, "steps"), "os", ("#0072b2", "#d55e00"), strict=True):
        steps.loglog(part["x"], part["y"], marker=marker, color=colour, label=name)
    numbers = table.loc[table["curve"] == "steps", "x"]
    steps.axhline(WARNED, color=GREY, linestyle=":", label="users are warned above")
    guide = np.array([numbers.max() / 64, numbers.max()])
    steps.loglog(guide, 0.1 / guide * guide[0] * 0.05, color=PALE, label="first order")
    steps.set(title="(a) explicit marching", xlabel="steps [1]", ylabel="error, or penetration over depth [1]")
    steps.legend(fontsize=6, loc="lower left")

    colours = ("#000000", "#0072b2", "#56b4e9", "#cc79a7", "#009e73", "#d55e00", "#e69f00", "#999999", "#f0e442")
    for (name, part), marker, colour in zip(_parts(table, "contact"), "os^*Dvhp<", colours, strict=True):
        contact.loglog(part["x"], np.maximum(part["y"], FLOOR), marker=marker, color=colour, label=name)
    contact.set(
        title="(b) one rough disc", xlabel="contact fraction [1]", ylabel="relative error [1]", ylim=(1e-17, 1e4)
    )
    logarithmic_ticks(steps, contact)
    contact.legend(fontsize=6, ncols=2, loc="center", bbox_to_anchor=(0.5, 0.55))
    return figure


def _parts(table, curve):
    """Name and rows of every method of a curve."""
    return table[table["curve"] == curve].groupby("method", sort=False)
