"""Errors of the solvers against exact solutions."""

import numpy as np
import pandas as pd
from matplotlib.ticker import FixedLocator, NullFormatter, NullLocator

from viscorough_study.figures import style

COLORS = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE, style.ORANGE)
MARKERS = "osxD+"
LIMIT = {"color": "black", "linewidth": 2}
LABEL_HEIGHT = 0.085  # of the label of an order, as a fraction of the height of its panel


@style.figure
def plot_validation(table):
    """Relative errors against exact solutions over the elements across the body, one panel for each quantity.

    table : of viscorough_study.comparisons.validation
    Labels at the ends of the lines give the observed orders; the black bar is the limit on the finest grid.
    """
    quantities, cases = table["quantity"].unique(), table["case"].unique()
    looks, grids = _case_looks(cases), sorted(table["elements"].unique())
    columns = min(4, len(quantities))
    figure, panels = style.new_panels(len(quantities), columns, height=54, rest=22, ylabel="relative error")
    for axes, quantity in zip(panels, quantities, strict=True):
        _draw_errors(axes, quantity, table[table["quantity"] == quantity], looks, grids)
    for axes in panels[-columns:]:  # the bottom row
        axes.set_xlabel("elements across, $n$")
    handles = [style.handle(case.replace("_", " "), **looks[case]) for case in cases]
    handles.append(style.handle("limit on the finest grid", **LIMIT))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure


def _draw_errors(axes, quantity, errors, looks, grids):
    """Draw the errors of one quantity for all cases, with their observed orders."""
    for case, rows in errors.groupby("case", sort=False):
        axes.plot(rows["elements"], rows["error"], **looks[case])
    limit = errors["limit"].iloc[0]
    axes.plot([grids[-1] / 1.2, grids[-1] * 1.2], [limit, limit], **LIMIT)
    drawn = np.log10([*errors["error"], limit])
    ends = np.floor(drawn.min() - 0.1), np.ceil(drawn.max() + 0.1)
    order = errors["expected_order"].iloc[0]
    expected = rf"expected $\propto n^{{-{order:g}}}$" if order else "exact"
    axes.set(xscale="log", yscale="log", title=f"{quantity.replace('_', ' ')}\n{expected}")
    axes.set(xlim=(grids[0] / 1.25, grids[-1] * 2.1), ylim=10.0 ** np.array(ends))
    axes.xaxis.set(major_locator=FixedLocator(grids), minor_locator=NullLocator(), major_formatter="{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    heights, texts = _order_labels(errors[errors["elements"] == grids[-1]])
    for height, text in zip(_spread(heights, LABEL_HEIGHT * np.ptp(ends)), texts, strict=True):
        axes.text(grids[-1] * 1.25, 10**height, text, va="center")


def _order_labels(finest):
    """Decimal logarithms of the errors on the finest grid, ascending, and their labels.

    Equal labels of errors that differ by less than 10 % are written once.
    """
    heights, texts = [], []
    for row in finest.sort_values("error").itertuples():
        notes = ([] if np.isnan(row.order) else [f"{row.order:.1f}"]) + ([] if row.passed else ["failed"])
        text, height = " ".join(notes), np.log10(row.error)
        if text and not (text in texts and height - heights[texts.index(text)] < np.log10(1.1)):
            heights.append(height)
            texts.append(text)
    return heights, texts


def _spread(heights, least):
    """Ascending heights moved as little as needed to be at least `least` apart."""
    heights = np.array(heights)
    for _ in range(20 * len(heights)):
        overlap = np.maximum(least - np.diff(heights), 0)
        heights[:-1] -= overlap / 2
        heights[1:] += overlap / 2
    return heights


def _case_looks(cases):
    """Looks of cases named <body>_<method>: colour and line style of the body, marker of the method."""
    bodies, methods = (pd.factorize(np.array([case.partition("_")[part] for case in cases]))[0] for part in (0, 2))
    return {
        case: {
            "color": COLORS[body % len(COLORS)],
            "linestyle": ("-", "--")[body % 2],
            "marker": MARKERS[method % len(MARKERS)],
            "markerfacecolor": "none",
        }
        for case, body, method in zip(cases, bodies, methods, strict=True)
    }
