"""Speed against accuracy of every method."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscorough_study.figures.style import (
    BLUE,
    GREEN,
    GREY,
    MM,
    PURPLE,
    SKY_BLUE,
    STYLE,
    VERMILION,
    WIDE,
    logarithmic_ticks,
    require_rows,
)
from viscorough_study.performance.pareto import pareto_front

GROUPS = {
    "path": (BLUE, "elastic path"),
    "path without a part": (SKY_BLUE, "elastic path without a part"),
    "marching": (VERMILION, "direct integration in time"),
    "model": (GREEN, "model (error of the model)"),
    "other solver": (PURPLE, "other solver"),
}
MARKERS = "osD^v<>ph*X"
FLOOR = 1e-13  # smaller errors are drawn here
ELEMENTS_ACROSS = 257  # of the rough discs drawn, or the most below that


@rc_context(STYLE)
def plot_speed(table):
    """Wall time against the error of v for every method: a panel for each indenter, and for rough discs of region (b).

    table : of viscorough_study.performance.measurement
    The values of a method's parameter are joined, the first and the last annotated; the staircase is the Pareto front.
    Raises ValueError for a table without rows.
    """
    require_rows("plot_speed", table)
    panels = _panels(table)
    rows = -(-len(panels) // 2)
    figure = Figure(figsize=(WIDE, (78 * rows + 62) * MM))
    grid = figure.subplots(rows, 2, squeeze=False)
    looks = _looks(table)
    for axes in grid.flat[len(panels) :]:
        axes.remove()
    for axes, (title, costs, error) in zip(grid.flat, panels, strict=False):
        _draw_methods(axes, costs.assign(error=np.maximum(costs[error], FLOOR)), looks)
        axes.set(title=title, xlabel="wall time [s]", ylabel=r"error of $v$, root mean square [1]")
    handles = [Line2D([], [], color=GREY, drawstyle="steps-post", label="Pareto front")]
    for group, (color, label) in GROUPS.items():
        members = [name for name, look in looks.items() if look["group"] == group]
        if members:
            handles.append(Line2D([], [], color=color, linewidth=3, label=f"{label}:"))
            handles += [Line2D([], [], **_line(looks[name]), label=f"   {name}") for name in members]
    if not (table["group"] == "other solver").any():
        handles.append(Line2D([], [], linestyle="", label="other solvers are not installed"))
    figure.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=7)
    return figure


def _panels(table):
    """(title, rows, column of the errors) of every panel."""
    panels = []
    bodies_first = sorted(
        table["problem"].unique(), key=lambda name: (name.startswith("rough"), name != "sphere", name)
    )
    for problem in bodies_first:
        rows = table[table["problem"] == problem]
        sizes = rows["elements"].unique()
        size = max(sizes[sizes <= ELEMENTS_ACROSS], default=sizes.min())
        rows = rows[rows["elements"] == size]
        panels.append((f"{problem}, {size} elements across", rows, "error"))
        if problem.startswith("rough") and rows["error_b"].notna().any():
            panels.append((f"{problem}, region (b) alone", rows.dropna(subset="error_b"), "error_b"))
    return panels


def _looks(table):
    """{method: group, color, marker}, group by group."""
    looks = {}
    for group, (color, _) in GROUPS.items():
        names = table[table["group"] == group]["method"].unique()
        looks |= {
            name: {"group": group, "color": color, "marker": MARKERS[i % len(MARKERS)]} for i, name in enumerate(names)
        }
    return looks


def _line(look):
    """Line properties of a method; other solvers and models are hollow."""
    hollow = {"markerfacecolor": "none"} if look["group"] in ("other solver", "model") else {}
    dashed = {"linestyle": "--"} if look["group"] == "other solver" else {"linewidth": 0.7}
    return {"color": look["color"], "marker": look["marker"], **hollow, **dashed}


def _draw_methods(axes, costs, looks):
    for name, look in looks.items():
        rows = costs[costs["method"] == name]
        if rows.empty:
            continue
        axes.plot(rows["wall_s"], rows["error"], **_line(look))
        if look["group"] in ("path", "marching", "other solver") and len(rows) > 1:
            for end in (rows.iloc[0], rows.iloc[-1]):
                text = f"{end['value']:g}".replace("e-0", "e-")
                at = (end["wall_s"], end["error"])
                axes.annotate(text, at, xytext=(3, 3), textcoords="offset points", fontsize=5, color=look["color"])
    front = pareto_front(costs)
    axes.step(front["wall_s"], front["error"], where="post", color=GREY, linewidth=3, alpha=0.35, zorder=1)
    axes.set(xscale="log", yscale="log")
    logarithmic_ticks(axes)
