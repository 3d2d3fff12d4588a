"""Speed against accuracy of every method on every indenter, a supplement to the figure of a few."""

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscorough_study.figures.speed import PARETO, draw_front, finest_grid, on_floor, set_axes
from viscorough_study.figures.style import (
    BLUE,
    GREEN,
    MM,
    PURPLE,
    SERIES_MARKERS,
    SKY_BLUE,
    STYLE,
    VERMILION,
    WIDE,
    require_rows,
)

GROUPS = {
    "path": (BLUE, "elastic path"),
    "path without a part": (SKY_BLUE, "elastic path without a part"),
    "marching": (VERMILION, "direct integration in time"),
    "model": (GREEN, "model (error of the model)"),
    "other solver": (PURPLE, "other solver"),
}


@rc_context(STYLE)
def plot_all_methods(table):
    """Wall time against the error of v for every method: a panel for each indenter, and for rough discs of region (b).

    table : of viscorough_study.performance.measurement
    The values of a method's parameter are joined; the staircase is the Pareto front.
    Raises ValueError for a table without rows.
    """
    require_rows("plot_all_methods", table)
    panels = _panels(table)
    looks = _looks(table)
    rows = -(-len(panels) // 2)
    figure = Figure(figsize=(WIDE, (66 * rows + 9 + 4 * (len(looks) + len(GROUPS)) // 3 + 8) * MM))
    grid = figure.subplots(rows, 2, squeeze=False)
    for axes, (title, costs) in zip(grid.flat, panels, strict=False):
        for name, look in looks.items():
            one = costs[costs["method"] == name]
            axes.plot(one["wall_s"], one["error"], **_line(look))
        draw_front(axes, costs)
        set_axes(axes, title)
    for axes in grid.flat[len(panels) :]:
        axes.remove()
    handles = []
    for group, (color, label) in GROUPS.items():
        members = [name for name, look in looks.items() if look["group"] == group]
        if members:
            handles.append(Line2D([], [], color=color, linewidth=3, label=f"{label}:"))
            handles += [Line2D([], [], **_line(looks[name]), label=f"   {name}") for name in members]
    if not (table["group"] == "other solver").any():
        handles.append(Line2D([], [], linestyle="", label="other solvers: not measured"))
    figure.legend(handles=[*handles, Line2D([], [], **PARETO)], loc="outside lower center", ncols=3)
    return figure


def _panels(table):
    """(title, rows) of every panel: the sphere, other bodies, then rough discs, on the finest grid of each."""
    panels = []
    for problem in sorted(
        table["problem"].unique(), key=lambda name: (name.startswith("rough"), name != "sphere", name)
    ):
        title, rows = finest_grid(table, problem)
        panels.append((title, on_floor(rows, "error")))
        if problem.startswith("rough") and rows["error_b"].notna().any():
            title = title.partition(", 2")[0] if ", 2" in title else title
            panels.append((f"{title}, region (b) alone", on_floor(rows.dropna(subset="error_b"), "error_b")))
    return panels


def _looks(table):
    """{method: group, color, marker}, group by group."""
    looks = {}
    for group, (color, _) in GROUPS.items():
        names = table[table["group"] == group]["method"].unique()
        markers = {name: SERIES_MARKERS[rank % len(SERIES_MARKERS)] for rank, name in enumerate(names)}
        looks |= {name: {"group": group, "color": color, "marker": marker} for name, marker in markers.items()}
    return looks


def _line(look):
    """Line properties of a method; other solvers and models are hollow."""
    hollow = {"markerfacecolor": "none"} if look["group"] in ("other solver", "model") else {}
    dashed = {"linestyle": "--"} if look["group"] == "other solver" else {"linewidth": 0.7}
    return {"color": look["color"], "marker": look["marker"], "markersize": 3.5, **hollow, **dashed}
