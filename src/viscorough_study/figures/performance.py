"""Figures of speed and accuracy: every method by cost and error, growth of the cost, other solvers, scenes."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter

from viscorough_study.figures.style import GREY, MM, PALE, STYLE, WIDE, logarithmic_ticks, plain_ticks
from viscorough_study.performance.methods import pareto_front

# Colours that are told apart with any colour vision (Okabe and Ito); one for a group of methods.
GROUPS = {
    "path": ("#0072b2", "elastic path"),
    "path without a part": ("#56b4e9", "elastic path without a part"),
    "marching": ("#d55e00", "direct integration in time"),
    "model": ("#009e73", "model (error of the model)"),
    "peer": ("#cc79a7", "other solver"),
}
MARKERS = "osD^v<>ph*X"
FLOOR = 1e-13  # errors below are drawn here
SHOWN = 257  # elements across the rough discs of the figure of speed, or the most that there are below
# Methods and values of their knob whose cost is followed over the number of elements.
GROWTH = {
    ("path, automatic levels", 1e-3): "automatic levels, 1e-3",
    ("path, at the depths", 1e-6): "given depths, 1e-6",
    ("path, each depth alone", 1e-6): "each depth alone, 1e-6",
    ("path, uniform levels", 32): "32 uniform levels",
    ("explicit, logarithmic steps", 256): "256 explicit steps",
    ("SlipPY", 1e-6): "SlipPY, 1e-6",
    ("ASPHER", 1e-6): "ASPHER, 1e-6",
}
CHOICES = {"automatic": ("#0072b2", "o"), "best by hand": ("#009e73", "s"), "naive": ("#d55e00", "D")}


@rc_context(STYLE)
def plot_speed(table):
    """Wall time against error of v for every method: a panel per indenter, and for rough discs one of region (b).

    The values of a method's knob are joined, the first and the last annotated; the staircase is the Pareto front.
    Raises ValueError for a table without rows.
    """
    _needs_rows("plot_speed", table)
    panels = _panels(table)
    rows = -(-len(panels) // 2)
    figure = Figure(figsize=(WIDE, (78 * rows + 62) * MM))
    grid = figure.subplots(rows, 2, squeeze=False)
    looks = _looks(table)
    for axes in grid.flat[len(panels) :]:
        axes.remove()
    for axes, (title, each, error) in zip(grid.flat, panels, strict=False):
        _speed_panel(axes, each.assign(error=np.maximum(each[error], FLOOR)), looks)
        axes.set(title=title, xlabel="wall time [s]", ylabel=r"error of $v$, root mean square [1]")
    handles = [Line2D([], [], color=GREY, drawstyle="steps-post", label="Pareto front")]
    for group, (color, label) in GROUPS.items():
        members = [name for name, look in looks.items() if look["group"] == group]
        if members:
            handles.append(Line2D([], [], color=color, linewidth=3, label=f"{label}:"))
            handles += [Line2D([], [], **_marked(looks[name]), label=f"   {name}") for name in members]
    if not (table["group"] == "peer").any():
        handles.append(Line2D([], [], linestyle="", label="other solvers are not installed"))
    figure.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=7)
    return figure


def _panels(table):
    """(title, rows, name of the column of errors) of every panel."""
    panels = []
    bodies_first = sorted(table["problem"].unique(), key=lambda name: (name != "sphere", name))
    for problem in sorted(bodies_first, key=lambda name: name.startswith("rough")):
        rows = table[table["problem"] == problem]
        sizes = rows["elements"].unique()
        size = max(sizes[sizes <= SHOWN], default=sizes.min())
        rows = rows[rows["elements"] == size]
        panels.append((f"{problem}, {size} elements across", rows, "error"))
        if problem.startswith("rough") and rows["error_b"].notna().any():
            panels.append((f"{problem}, region (b) alone", rows.dropna(subset="error_b"), "error_b"))
    return panels


def _looks(table):
    """{method: group, color, marker} in the order of groups."""
    looks = {}
    for group, (color, _) in GROUPS.items():
        names = table[table["group"] == group]["method"].unique()
        looks |= {
            name: {"group": group, "color": color, "marker": MARKERS[i % len(MARKERS)]} for i, name in enumerate(names)
        }
    return looks


def _marked(look):
    """Keywords of a line in a method's looks; peers and models are hollow."""
    hollow = {"markerfacecolor": "none"} if look["group"] in ("peer", "model") else {}
    dashed = {"linestyle": "--"} if look["group"] == "peer" else {"linewidth": 0.7}
    return {"color": look["color"], "marker": look["marker"], **hollow, **dashed}


def _speed_panel(axes, table, looks):
    for name, look in looks.items():
        rows = table[table["method"] == name]
        if rows.empty:
            continue
        axes.plot(rows["wall_s"], rows["error"], **_marked(look))
        if look["group"] in ("path", "marching", "peer") and len(rows) > 1:
            for end in (rows.iloc[0], rows.iloc[-1]):
                text = f"{end['value']:g}".replace("e-0", "e-")
                at = (end["wall_s"], end["error"])
                axes.annotate(text, at, xytext=(3, 3), textcoords="offset points", fontsize=5, color=look["color"])
    front = pareto_front(table)
    axes.step(front["wall_s"], front["error"], where="post", color=GREY, linewidth=3, alpha=0.35, zorder=1)
    axes.set(xscale="log", yscale="log")
    logarithmic_ticks(axes)


@rc_context(STYLE)
def plot_growth(table):
    """Wall time and operators against the number of elements, rough discs, with exponents fitted to the time.

    Medians over the discs of one size; where a method gave no answer in time, its error is 1, and its cost not known.
    Raises ValueError for a table without rough discs.
    """
    rough = table[table["hurst"].notna() & (table["error"] < 1)]
    _needs_rows("plot_growth", rough)
    figure = Figure(figsize=(WIDE, 85 * MM))
    time, operators = figure.subplots(1, 2)
    for i, ((method, value), label) in enumerate(GROWTH.items()):
        rows = rough[(rough["method"] == method) & np.isclose(rough["value"], value, rtol=1e-9, atol=0)]
        rows = rows.groupby("elements")[["wall_s", "operator_applications"]].median()
        rows = rows[rows.index >= rows.index.max() / 8] if len(rows) else rows
        if rows.empty:
            continue
        number = np.pi / 4 * rows.index.to_numpy() ** 2
        color = list(GROUPS.values())[i % len(GROUPS)][0]
        look = {"color": color, "marker": MARKERS[i], "markerfacecolor": "none" if i >= len(GROUPS) else color}
        slope = growth_exponent(number, rows["wall_s"])
        note = "" if np.isnan(slope) else f": $N^{{{slope:.2f}}}$"
        time.plot(number, rows["wall_s"], **look, label=label + note)
        if rows["operator_applications"].any():
            operators.plot(number, rows["operator_applications"], **look)
    time.set(ylabel="wall time [s]")
    operators.set(ylabel="operators on the grid [1]")
    for axes in (time, operators):
        axes.set(xscale="log", yscale="log", xlabel="elements of the disc $N$ [1]")
        logarithmic_ticks(axes)
    plain_ticks(operators.yaxis, [10, 20, 50, 100, 200, 500, 1000, 2000])
    figure.legend(loc="outside lower center", ncols=3)
    return figure


def growth_exponent(number, seconds):
    """Slope of ln(time) over ln(number of elements); nan for fewer than two sizes."""
    return np.polyfit(np.log(number), np.log(seconds), 1)[0] if len(number) > 1 else np.nan


@rc_context(STYLE)
def plot_peers(table):
    """Wall time over that of the path, of every solver on every task; raises ValueError for a table without rows."""
    _needs_rows("plot_peers", table)
    tasks = list(table["task"].unique())
    figure = Figure(figsize=(WIDE, (20 * len(tasks) + 42) * MM))
    axes = figure.subplots()
    solvers = list(table["solver"].unique())
    exponents = sorted(table["hurst"].unique())
    for row in table.itertuples():
        step = 0.8 / max(len(exponents), 1)
        y = -tasks.index(row.task) + step * (0.5 * (len(exponents) - 1) - exponents.index(row.hurst))
        i = solvers.index(row.solver)
        color = "black" if i == 0 else list(GROUPS.values())[(i - 1) % len(GROUPS)][0]
        hollow = {"markerfacecolor": "none"} if row.threads > 1 else {}
        axes.plot(row.ratio, y, color=color, marker=MARKERS[i], linestyle="", markersize=6, **hollow)
    for task in tasks:
        axes.axhspan(-tasks.index(task) - 0.48, -tasks.index(task) + 0.48, color=PALE, alpha=0.35, zorder=0)
        for hurst in exponents:
            step = 0.8 / len(exponents)
            y = -tasks.index(task) + step * (0.5 * (len(exponents) - 1) - exponents.index(hurst))
            axes.text(0.995, y, f"$H={hurst:g}$", transform=axes.get_yaxis_transform(), ha="right", va="center")
    axes.set(xscale="log", xlabel="wall time over that of the elastic path [1]")
    axes.set_yticks([-i for i in range(len(tasks))], tasks)
    axes.tick_params(axis="y", which="both", length=0)
    axes.minorticks_off()
    axes.set_xlim(0.7, max(20.0, 4 * table["ratio"].max()))
    axes.set_xticks([1, 2, 4, 8, 16, 32, 64, 128], ["1", "2", "4", "8", "16", "32", "64", "128"])
    axes.grid(axis="x", color=PALE)
    handles = [
        Line2D(
            [], [], linestyle="", marker=MARKERS[i], label=name,
            color="black" if i == 0 else list(GROUPS.values())[(i - 1) % len(GROUPS)][0],
        )
        for i, name in enumerate(solvers)
    ]  # fmt: skip
    handles.append(
        Line2D([], [], linestyle="", marker="o", color=GREY, markerfacecolor="none", label="hollow: two threads")
    )
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure


@rc_context(STYLE)
def plot_scenes(table):
    """Time of the levels that are chosen for a scene, over that of the automatic choice, with the errors reached.

    Raises ValueError for a table without rows.
    """
    _needs_rows("plot_scenes", table)
    scenes = list(table["scene"].unique())
    figure = Figure(figsize=(WIDE, (13 * len(scenes) + 30) * MM))
    axes = figure.subplots()
    for row in table.itertuples():
        color, marker = CHOICES[row.choice]
        y = -scenes.index(row.scene)
        look = {} if row.reached else {"markerfacecolor": "none"}
        axes.plot(row.ratio, y, color=color, marker=marker, markersize=6, linestyle="", **look)
        axes.annotate(
            f"{row.error / row.accuracy:.2g}", (row.ratio, y), xytext=(0, 6), textcoords="offset points", ha="center",
            fontsize=6, color=color,
        )  # fmt: skip
    for ratio in (1 / 1.3, 3.0):
        axes.axvline(ratio, color=GREY, linestyle="--", zorder=1)
    accuracy = table.groupby("scene")["accuracy"].first()
    axes.set_yticks([-i for i in range(len(scenes))], [f"{scene}\n(to {accuracy[scene]:g})" for scene in scenes])
    axes.set(xscale="log", xlabel="wall time over that of the automatic choice [1]", ylim=(0.6 - len(scenes), 0.6))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.tick_params(axis="y", which="both", length=0)
    handles = [
        Line2D([], [], color=color, marker=marker, linestyle="", label=choice)
        for choice, (color, marker) in CHOICES.items()
    ]
    handles.append(Line2D([], [], color=GREY, linestyle="--", label="1/1.3 and 3"))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure


def _needs_rows(name, table):
    if table.empty:
        raise ValueError(f"{name}: the table has no rows to plot, it needs some")
