"""The elastic path and other solvers on the same levels."""

from viscorough_study.figures import style

TICKS = (1, 2, 4, 8, 16, 32, 64, 128)
HOLLOW = {"markerfacecolor": "none"}


@style.figure
def plot_other_solvers(table):
    """Wall time of every solver on every task over that of the elastic path; hollow markers are of two threads.

    Lines extend from the smallest to the largest ratio of a pair. Solutions that miss the residual are omitted.
    table : of viscorough_study.performance.solver_comparison.
    """
    table = table[table["met"] == 1]
    tasks, solvers = list(table["task"].unique()), list(table["solver"].unique())
    exponents = sorted(table["hurst"].unique())
    looks = style.series_looks(solvers)
    step = 0.8 / len(exponents)
    heights = {
        (task, hurst): -place + step * (0.5 * (len(exponents) - 1) - rank)
        for place, task in enumerate(tasks)
        for rank, hurst in enumerate(exponents)
    }
    figure = style.new_figure(18 * len(tasks) + 32)
    axes = figure.subplots()
    for row in table.itertuples():
        look, height = looks[row.solver], heights[row.task, row.hurst]
        axes.plot([row.ratio_low, row.ratio_high], [height, height], color=look["color"], linewidth=1)
        axes.plot(row.ratio, height, linestyle="", markersize=6, **look | (HOLLOW if row.threads > 1 else {}))
    for place in range(len(tasks)):
        axes.axhspan(-place - 0.48, -place + 0.48, color=style.PALE, alpha=0.35, zorder=0)
    for (_, hurst), y in heights.items():
        axes.text(0.995, y, f"$H={hurst:g}$", transform=axes.get_yaxis_transform(), ha="right", va="center")
    axes.set(xscale="log", xlabel="wall time over that of the elastic path")
    axes.set_yticks([-place for place in range(len(tasks))], tasks)
    axes.tick_params(axis="y", which="both", length=0)
    axes.minorticks_off()
    axes.set_xlim(0.7, max(20.0, 4 * table["ratio"].max()))
    axes.set_xticks(TICKS, map(str, TICKS))
    axes.grid(axis="x", color=style.PALE)
    handles = [style.handle(name, linestyle="", **look) for name, look in looks.items()]
    handles.append(style.handle("hollow: two threads", marker="o", color=style.GREY, linestyle="", **HOLLOW))
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure
