"""Errors of the solvers against exact solutions."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, NullFormatter, NullLocator

from viscorough_study.figures.style import BLUE, GREEN, MM, ORANGE, PURPLE, STYLE, VERMILION, WIDE

COLORS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE)
MARKERS = "osxD+"
LIMIT = {"color": "black", "linewidth": 2, "label": "_limit"}


@rc_context(STYLE)
def plot_validation(table):
    """Relative errors against exact solutions over the elements across the body, one panel for each quantity.

    table : of viscorough_study.validate_solvers
    The legend of a panel gives the observed orders; the black bar is the limit on the finest grid.
    """
    quantities, cases = table["quantity"].unique(), table["case"].unique()
    looks, grids = _case_looks(cases), sorted(table["elements"].unique())
    columns = min(4, len(quantities))
    rows = -(-len(quantities) // columns)
    figure = Figure(figsize=(WIDE, (52 * rows + 22) * MM))
    grid = figure.subplots(rows, columns, squeeze=False)
    for axes in grid.flat[len(quantities) :]:
        axes.remove()
    for axes, quantity in zip(grid.flat, quantities, strict=False):
        _draw_errors(axes, quantity, table[table["quantity"] == quantity], looks, grids)
    for axes in grid[:, 0]:
        axes.set_ylabel("relative error")
    for axes in grid[-1]:
        axes.set_xlabel("elements across, $n$")
    handles = [Line2D([], [], **looks[case], label=case.replace("_", " ")) for case in cases]
    handles.append(Line2D([], [], **LIMIT | {"label": "limit on the finest grid"}))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure


def _draw_errors(axes, quantity, errors, looks, grids):
    """One quantity: errors of all cases, and their observed orders as a legend."""
    for case, rows in errors.groupby("case", sort=False):
        order, passed = rows[["order", "passed"]].iloc[-1]
        notes = ([] if np.isnan(order) else [f"{order:.1f}"]) + ([] if passed else ["failed"])
        axes.plot(rows["elements"], rows["error"], **looks[case], label=", ".join(notes) or f"_{case}")
    limit = errors["limit"].iloc[0]
    axes.plot([grids[-1] / 1.2, grids[-1] * 1.2], [limit, limit], **LIMIT)
    drawn = np.log10([*errors["error"], limit])
    ends = 10.0 ** np.array([np.floor(drawn.min() - 0.1), np.ceil(drawn.max() + 0.1)])
    order = errors["expected_order"].iloc[0]
    expected = rf"expected $\propto n^{{-{order:g}}}$" if order else "exact"
    axes.set(xscale="log", yscale="log", ylim=ends, title=f"{quantity.replace('_', ' ')}\n{expected}")
    axes.xaxis.set(major_locator=FixedLocator(grids), minor_locator=NullLocator(), major_formatter="{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    if noted := axes.get_legend_handles_labels()[0]:
        if len(noted) > 2:  # room above the curves, so that the legend does not hide them
            axes.set_ylim(top=ends[1] * (10 if len(noted) < 5 else 30))
        axes.legend(title="order", ncols=1 + (len(noted) > 2), columnspacing=1)


def _case_looks(cases):
    """Looks of cases named by body and method: the body has a colour and line style, the method a marker."""
    named = [case.partition("_")[::2] for case in cases]
    bodies, methods = (list(dict.fromkeys(names)) for names in zip(*named, strict=True))
    return {
        case: {
            "color": COLORS[bodies.index(body) % len(COLORS)],
            "linestyle": ("-", "--")[bodies.index(body) % 2],
            "marker": MARKERS[methods.index(method) % len(MARKERS)],
            "markerfacecolor": "none",
        }
        for case, (body, method) in zip(cases, named, strict=True)
    }
