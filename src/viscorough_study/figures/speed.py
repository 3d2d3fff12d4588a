"""Speed against accuracy of the main methods, labelled directly."""

import re

import numpy as np

from viscorough_study.figures import style
from viscorough_study.figures.placement import place_labels
from viscorough_study.performance.costs import fastest, pareto_front

METHODS = {
    "path, automatic levels": "elastic path,\nautomatic levels",
    "path, at the depths": "elastic path,\ngiven levels",
    "implicit": "implicit\ntime steps",
    "explicit, logarithmic steps": "explicit\ntime steps",
    "MDR": "MDR (model)",
}
ELEMENTS_ACROSS = 257  # largest grid drawn
FLOOR = 1e-13  # smaller errors are drawn at this value
HEADLINE = 0.01  # error at which the fastest methods are compared
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
    time steps with an error of at most 1 %; a box compares their times.
    """
    rough = sorted(name for name in table["problem"].unique() if name.startswith("rough"))
    problems = [*rough[:1], *({"sphere"} & set(table["problem"]))] or [table["problem"].iloc[0]]
    looks = style.series_looks(METHODS)
    figure = style.new_figure(95)
    panels = figure.subplots(1, len(problems), squeeze=False)[0]
    labels = []
    for axes, problem, letter in zip(panels, problems, "ab", strict=False):
        title, rows = _finest_grid(table, problem)
        costs = rows.assign(error=np.maximum(rows["error"], FLOOR))
        axes.plot("wall_s", "error", data=pareto_front(costs), **PARETO, zorder=1)
        labels.append(_draw_methods(axes, costs, looks))
        _draw_headline(axes, costs)
        axes.set(title=f"({letter}) {title}", xlabel="wall time (s)", xscale="log", yscale="log")
        axes.set_ylabel("relative error of $v$, root mean square")
        style.logarithmic_ticks(axes)
        axes.margins(x=0.08, y=0.1)
    figure.legend(handles=[style.handle(**PARETO), style.handle(**RING)], loc="outside lower center", ncols=2)
    for axes, texts in zip(panels, labels, strict=True):
        place_labels(axes, texts)
    return figure


def _finest_grid(table, problem):
    """Title and rows of a problem on its finest grid of at most `ELEMENTS_ACROSS`, otherwise on its coarsest."""
    rows = table[table["problem"] == problem]
    sizes = rows["elements"].unique()
    size = max(sizes[sizes <= ELEMENTS_ACROSS], default=sizes.min())
    name = re.sub(r"H = ([\d.]+)", r"$H=\1$", problem)
    return f"{name}, {size} elements across", rows[rows["elements"] == size]


def _draw_methods(axes, costs, looks):
    """Draw the lines of the methods; returns their labels, placed at the most accurate points."""
    labels = []
    for name, label in METHODS.items():
        rows = costs[costs["method"] == name]
        if len(rows):
            axes.plot(rows["wall_s"], rows["error"], **looks[name], markersize=3.5)
            end = rows.loc[rows["error"].idxmin()]
            labels.append((label, end["wall_s"], end["error"], looks[name]["color"]))
    return labels


def _draw_headline(axes, costs):
    """Draw rings around the fastest path and time steps within the error `HEADLINE`, and a box with their times."""
    best = fastest(costs, HEADLINE)
    if "path" not in best:
        return
    axes.axhline(HEADLINE, color=style.PALE, linewidth=0.6, zorder=0)
    wall = best["path"]["wall_s"]
    lines = [f"elastic path {style.number_text(1e3 * wall, 2)} ms"]
    axes.plot(wall, best["path"]["error"], **RING)
    if "marching" in best:
        axes.plot(best["marching"]["wall_s"], best["marching"]["error"], **RING)
        lines.append(f"time steps ×{style.number_text(best['marching']['wall_s'] / wall, 2)}")
    handles = [style.handle(line, linestyle="") for line in lines]
    look = {"handlelength": 0, "handletextpad": 0, "alignment": "left", "frameon": True}
    axes.legend(handles=handles, title=f"to an error of {100 * HEADLINE:g} %:", **look)
