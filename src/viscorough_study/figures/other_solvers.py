"""The elastic path and other solvers on the same levels."""

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscorough_study.figures.style import GREY, MM, PALE, SMALL, STYLE, WIDE, require_rows, series_looks

TICKS = (1, 2, 4, 8, 16, 32, 64, 128)


@rc_context(STYLE)
def plot_other_solvers(table):
    """Wall time over that of the elastic path, of every solver on every task; hollow markers are of two threads.

    Lines are from the least to the largest ratio of a pair. What does not meet the residual is left out.
    table : of viscorough_study.performance.solver_comparison. Raises ValueError for a table without rows.
    """
    require_rows("plot_other_solvers", table)
    table = table[table["met"] == 1]
    tasks, solvers = list(table["task"].unique()), list(table["solver"].unique())
    exponents = sorted(table["hurst"].unique())
    looks = {name: {"linestyle": "", **look} for name, look in series_looks(solvers).items()}
    step = 0.8 / len(exponents)
    heights = {
        (task, hurst): -place + step * (0.5 * (len(exponents) - 1) - rank)
        for place, task in enumerate(tasks)
        for rank, hurst in enumerate(exponents)
    }
    figure = Figure(figsize=(WIDE, (18 * len(tasks) + 32) * MM))
    axes = figure.subplots()
    for row in table.itertuples():
        hollow = {"markerfacecolor": "none"} if row.threads > 1 else {}
        height = heights[row.task, row.hurst]
        axes.plot([row.ratio_low, row.ratio_high], [height, height], color=looks[row.solver]["color"], linewidth=1)
        axes.plot(row.ratio, height, markersize=6, **looks[row.solver] | hollow)
    for place in range(len(tasks)):
        axes.axhspan(-place - 0.48, -place + 0.48, color=PALE, alpha=0.35, zorder=0)
    right = {"transform": axes.get_yaxis_transform(), "ha": "right", "va": "center"}
    for (_, hurst), y in heights.items():
        axes.text(0.995, y, f"$H={hurst:g}$", fontsize=SMALL, **right)
    axes.set(xscale="log", xlabel="wall time over that of the elastic path")
    axes.set_yticks([-place for place in range(len(tasks))], tasks)
    axes.tick_params(axis="y", which="both", length=0)
    axes.minorticks_off()
    axes.set_xlim(0.7, max(20.0, 4 * table["ratio"].max()))
    axes.set_xticks(TICKS, map(str, TICKS))
    axes.grid(axis="x", color=PALE)
    handles = [Line2D([], [], **look, label=name) for name, look in looks.items()]
    two_threads = {"marker": "o", "color": GREY, "markerfacecolor": "none", "linestyle": ""}
    handles.append(Line2D([], [], **two_threads, label="hollow: two threads"))
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure
