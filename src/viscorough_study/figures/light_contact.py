"""One light load on square maps from small to large, and by other solvers."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.performance.costs import fit_cost

OWN = "viscorough"


@style.figure
def plot_light_contact(table):
    """Wall time against the elements of the map, with the time of ranking them; and that of other solvers over ours.

    table : of viscorough_study.performance.light_contact
    Times are on one thread, medians over the maps of one size; exponents are fitted to the larger half of the sizes.
    """
    table = table[table["met"] == 1].assign(number=table["elements"] ** 2.0)
    own, others = table[table["solver"] == OWN], table[table["solver"] != OWN]
    figure = style.new_figure(95)
    growth, ratios = figure.subplots(1, 2)
    _draw_growth(growth, own[own["threads"] == 1])
    _draw_ratios(ratios, others)
    growth.set(title="(a) viscorough", xlabel="elements of the map", ylabel="wall time (s)")
    ratios.set(title="(b) other solvers", xlabel="contact fraction", ylabel="wall time over that of viscorough")
    for axes in (growth, ratios):
        axes.set(xscale="log", yscale="log")
    if len(others):
        ratios.set_ylim(0.7, 4 * others["ratio"].max())  # room for the legend
        ratios.legend(loc="upper left")
    growth.legend(loc="upper left")
    return figure


def _draw_growth(axes, own):
    medians = own.groupby(["fraction", "number"], as_index=False)[["wall_s", "ranking_s"]].median()
    sizes = medians.groupby("fraction")["number"].transform("size")
    grown = medians[sizes == sizes.max()]  # other loads are on few maps only
    looks = style.series_looks(grown["fraction"].unique())
    for fraction, costs in grown.groupby("fraction"):
        larger = costs[min(len(costs) // 2, len(costs) - 2) :]
        exponent, _ = fit_cost(larger["number"], larger["wall_s"])
        note = "" if np.isnan(exponent) else f", $N^{{{exponent:.2f}}}$"
        label = f"contact of {100 * fraction:g} %{note}"
        axes.plot(costs["number"], costs["wall_s"], **looks[fraction], label=label)
    ranking = grown.groupby("number")["ranking_s"].min()
    axes.plot(ranking.index, ranking, "--", color=style.GREY, label="reading and ranking the map")


def _draw_ratios(axes, others):
    looks = style.series_looks([*zip(others["solver"], others["elements"], strict=True)])
    for (solver, across, threads), rows in others.groupby(["solver", "elements", "threads"]):
        look = looks[solver, across] | ({"markerfacecolor": "none"} if threads > 1 else {})
        label = f"{solver}, ${across}^2$" if threads == 1 else None
        axes.plot(rows["fraction"], rows["ratio"], linestyle="", **look, label=label)
    axes.axhline(1, color=style.GREY, linewidth=0.8)
