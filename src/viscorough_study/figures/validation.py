"""Draw the deviations of the solvers from exact solutions."""

import numpy as np
from matplotlib.ticker import FixedLocator

from viscorough_study.figures import style

# Short names of the methods, {method: name}; a comparison is named BODY_METHOD, or BODY for boundary elements.
METHODS = {
    "": "",
    "disc": " disc",  # the rough disc
    "on_rectangles": ", rectangles",
    "reduction": ", MDR",
    "constant_force": ", constant $F$",
    "rising_force": ", rising $F$",
}
LIMIT = {"color": "black", "linewidth": 2}


@style.figure
def plot_validation(table):
    """Draw deviations from exact solutions against the number of elements across, with a panel for each quantity.

    A black bar marks the largest error allowed on the finest grid. The dotted line that leads to this bar falls with
    the expected order of convergence. The body of a comparison determines its colour.
    table : table of viscorough_study.comparisons.validation
    """
    quantities, grids = table["quantity"].unique(), np.sort(table["elements"].unique())
    looks = style.series_looks(comparison.partition("_")[0] for comparison in table["comparison"])
    labels = {"xlabel": "elements across, $n$", "ylabel": "relative error"}
    figure, panels = style.new_panels(len(quantities), min(3, len(quantities)), height=46, rest=6, **labels)
    for axes, quantity in zip(panels, quantities, strict=True):
        errors, ends = table[table["quantity"] == quantity], []
        for comparison, rows in errors.groupby("comparison", sort=False):
            body, _, method = comparison.partition("_")
            color, name = looks[body]["color"], body + METHODS[method]
            axes.plot(rows["elements"], rows["error"], "o-", color=color, markerfacecolor="none")
            ends.append((name, *rows[["elements", "error"]].iloc[-1], color))
        limit, order = errors[["limit", "expected_order"]].iloc[0]
        axes.plot(grids[-1] * np.array([1 / 1.2, 1.2]), [limit, limit], **LIMIT)
        axes.plot(grids, limit * (grids / grids[-1]) ** -order, color="black", linestyle=":", linewidth=0.8)
        expected = rf"expected $\propto n^{{-{order:g}}}$" if order else "exact"
        axes.set(xscale="log", yscale="log", title=f"{quantity.replace('_', ' ')}, {expected}")
        axes.xaxis.set(major_locator=FixedLocator(grids), major_formatter="{x:g}")
        style.label_ends(axes, [*ends, ("limit", grids[-1], limit, "black")], gap=0.1)
    return figure
