"""Speed against accuracy of the main methods."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.performance.costs import fastest, pareto_front

METHODS = {
    "path, automatic levels": "elastic path, automatic levels",
    "path, at the depths": "elastic path, given levels",
    "implicit": "implicit time steps",
    "explicit, logarithmic steps": "explicit time steps",
    "MDR": "MDR (model)",
}
ELEMENTS_ACROSS = 257  # largest grid drawn
FLOOR = 1e-13  # smaller errors are drawn at this value
HEADLINE = 0.01  # error at which the fastest methods are compared
RINGED = {"path", "marching"}  # groups of methods that are compared
RING = {"color": style.BLACK, "marker": "o", "markersize": 9, "markerfacecolor": "none", "linestyle": ""}
RING |= {"label": "fastest of its kind to an error of 1 %"}
PARETO = {"color": style.GREY, "linewidth": 3, "alpha": 0.35, "drawstyle": "steps-post"}
PARETO |= {"label": "Pareto front of all methods"}


@style.figure
def plot_speed(table):
    """Error of v against wall time: the elastic path, time steps and a model.

    table : of viscorough_study.performance.measurement; drawn are its first rough disc (a) and the sphere (b), as far
        as it has them, otherwise its first problem
    The staircase is the Pareto front of all methods of the table. Rings mark the fastest solutions by the path and by
    time steps with an error of at most 1 %.
    """
    rough = sorted(name for name in table["problem"].unique() if name.startswith("rough"))
    problems = [*rough[:1], *({"sphere"} & set(table["problem"]))] or [table["problem"].iloc[0]]
    figure, panels = style.new_subplots(100, 1, len(problems), squeeze=False)
    for axes, problem, letter in zip(panels[0], problems, "ab", strict=False):
        title, rows = _finest_grid(table, problem)
        _draw_costs(axes, rows.assign(error=np.maximum(rows["error"], FLOOR)))
        axes.set(title=f"({letter}) {title}", xlabel="wall time (s)", xscale="log", yscale="log")
        axes.set_ylabel("relative error of $v$, root mean square")
    labelled = {line.get_label(): line for axes in panels[0] for line in axes.lines if line.get_label()[0] != "_"}
    figure.legend(handles=[*labelled.values()], loc="outside lower center", ncols=3)
    return figure


def _finest_grid(table, problem):
    """Title and rows of a problem on its finest grid of at most `ELEMENTS_ACROSS`, otherwise on its coarsest."""
    rows = table[table["problem"] == problem]
    sizes = rows["elements"].unique()
    size = max(sizes[sizes <= ELEMENTS_ACROSS], default=sizes.min())
    return f"{problem}, {size} elements across", rows[rows["elements"] == size]


def _draw_costs(axes, costs):
    """Draw the Pareto front, a line for each method, and a ring around the fastest solution of each kind."""
    axes.plot("wall_s", "error", data=pareto_front(costs), **PARETO, zorder=1)
    axes.axhline(HEADLINE, color=style.PALE, linewidth=0.6, zorder=0)
    for name, look in style.series_looks(METHODS).items():
        axes.plot("wall_s", "error", data=costs[costs["method"] == name], **look, markersize=3.5, label=METHODS[name])
    for group, best in fastest(costs, HEADLINE).items():
        if group in RINGED:
            axes.plot(best["wall_s"], best["error"], **RING)
