"""Where methods begin to fail: errors against explicit steps and against the contact fraction."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from viscorough_study.figures.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    MM,
    ORANGE,
    PALE,
    PURPLE,
    SKY_BLUE,
    STYLE,
    VERMILION,
    WIDE,
    YELLOW,
    logarithmic_ticks,
    require_rows,
)

FLOOR = 1e-16  # smaller errors are drawn here
WARNED = 0.01  # overlap over depth above which explicit marching warns
COLORS = (BLACK, BLUE, SKY_BLUE, PURPLE, GREEN, VERMILION, ORANGE, "#999999", YELLOW)


@rc_context(STYLE)
def plot_failure_curves(table):
    """Error against the number of explicit steps (a) and against the contact fraction (b).

    table : of viscorough_study.robustness.failure_curves. Raises ValueError for a table without rows.
    """
    require_rows("plot_failure_curves", table)
    figure = Figure(figsize=(WIDE, 80 * MM))
    steps, contact = figure.subplots(1, 2)

    for (name, rows), marker, color in zip(_methods(table, "steps"), "os", (BLUE, VERMILION), strict=True):
        steps.loglog(rows["x"], rows["y"], marker=marker, color=color, label=name)
    numbers = table.loc[table["curve"] == "steps", "x"]
    steps.axhline(WARNED, color=GREY, linestyle=":", label="users are warned above")
    guide = np.array([numbers.max() / 64, numbers.max()])
    steps.loglog(guide, 0.1 / guide * guide[0] * 0.05, color=PALE, label="first order")
    steps.set(title="(a) explicit marching", xlabel="steps [1]", ylabel="error, or overlap over depth [1]")
    steps.legend(fontsize=6, loc="lower left")

    for (name, rows), marker, color in zip(_methods(table, "contact"), "os^*Dvhp<", COLORS, strict=True):
        contact.loglog(rows["x"], np.maximum(rows["y"], FLOOR), marker=marker, color=color, label=name)
    contact.set(
        title="(b) one rough disc", xlabel="contact fraction [1]", ylabel="relative error [1]", ylim=(1e-17, 1e4)
    )
    logarithmic_ticks(steps, contact)
    contact.legend(fontsize=6, ncols=2, loc="center", bbox_to_anchor=(0.5, 0.55))
    return figure


def _methods(table, curve):
    """Name and rows of every method of a curve."""
    return table[table["curve"] == curve].groupby("method", sort=False)
