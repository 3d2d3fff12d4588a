"""Draw the deviations of the solvers from exact solutions."""

import numpy as np
from matplotlib.ticker import FixedLocator, NullLocator

from viscorough_study.figures import style

LIMIT = {"color": "black", "linewidth": 2}


@style.figure
def plot_validation(table):
    """Draw deviations from exact solutions against the number of elements across, with a panel for each quantity.

    A black bar marks the largest error allowed on the finest grid. The dotted line that leads to this bar falls with
    the expected order of convergence.
    table : table of viscorough_study.comparisons.validation
    """
    quantities, cases = table["quantity"].unique(), table["case"].unique()
    looks, grids = _case_looks(cases), np.sort(table["elements"].unique())
    layout = {"columns": min(4, len(quantities)), "height": 54, "rest": 22}
    labels = {"xlabel": "elements across, $n$", "ylabel": "relative error"}
    figure, panels = style.new_panels(len(quantities), **layout, **labels)
    for axes, quantity in zip(panels, quantities, strict=True):
        errors = table[table["quantity"] == quantity]
        for case, rows in errors.groupby("case", sort=False):
            axes.plot(rows["elements"], rows["error"], **looks[case])
        limit, order = errors[["limit", "expected_order"]].iloc[0]
        axes.plot(grids[-1] * np.array([1 / 1.2, 1.2]), [limit, limit], **LIMIT)
        axes.plot(grids, limit * (grids / grids[-1]) ** -order, color="black", linestyle=":", linewidth=0.8)
        expected = rf"expected $\propto n^{{-{order:g}}}$" if order else "exact"
        axes.set(xscale="log", yscale="log", title=f"{quantity.replace('_', ' ')}\n{expected}")
        axes.xaxis.set(major_locator=FixedLocator(grids), minor_locator=NullLocator(), major_formatter="{x:g}")
    handles = [style.handle(case.replace("_", " "), **looks[case]) for case in cases]
    handles.append(style.handle("limit on the finest grid", **LIMIT))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure


def _case_looks(cases):
    """Return {name of a case: line properties}. The body of the case determines the colour, the method the marker.

    cases : names of cases, <body>_<method>
    """
    bodies, methods = (style.series_looks(case.partition("_")[part] for case in cases) for part in (0, 2))
    looks = {}
    for case in cases:
        body, _, method = case.partition("_")
        looks[case] = methods[method] | {"color": bodies[body]["color"], "markerfacecolor": "none"}
    return looks
