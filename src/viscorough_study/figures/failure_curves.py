"""Where methods begin to fail: errors against explicit steps and against the contact fraction."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from viscorough_study.figures.style import (
    GREY,
    MM,
    PALE,
    STYLE,
    WIDE,
    logarithmic_ticks,
    require_rows,
    series_looks,
)

FLOOR = 1e-16  # smaller errors are drawn here
WARNED = 0.01  # overlap over depth above which explicit marching warns


@rc_context(STYLE)
def plot_failure_curves(table):
    """Error against the number of explicit steps (a) and against the contact fraction (b).

    table : of viscorough_study.robustness.failure_curves. Raises ValueError for a table without rows.
    """
    require_rows("plot_failure_curves", table)
    figure = Figure(figsize=(WIDE, 95 * MM))
    steps, contact = figure.subplots(1, 2)

    _draw_curves(steps, table, "steps")
    numbers = table.loc[table["curve"] == "steps", "x"]
    steps.axhline(WARNED, color=GREY, linestyle=":", label="users are warned above")
    guide = np.array([numbers.max() / 64, numbers.max()])
    steps.plot(guide, 0.1 / guide * guide[0] * 0.05, color=PALE, label="first order")
    steps.set(title="(a) explicit marching", xlabel="steps", ylabel="error, or overlap over depth")

    _draw_curves(contact, table, "contact")
    contact.set(title="(b) one rough disc", xlabel="contact fraction", ylabel="relative error")
    for axes in (steps, contact):
        axes.set(xscale="log", yscale="log")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
    logarithmic_ticks(steps, contact)
    return figure


def _draw_curves(axes, table, curve):
    """Every method of a curve, with errors down to `FLOOR`."""
    rows = table[table["curve"] == curve]
    for name, look in series_looks(rows["method"]).items():
        one = rows[rows["method"] == name]
        axes.plot(one["x"], np.maximum(one["y"], FLOOR), **look, markersize=3.5, label=name)
