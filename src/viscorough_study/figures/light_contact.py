"""One light load on square maps from small to large."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.performance.costs import fit_cost


@style.figure
def plot_light_contact(table):
    """Wall time against the elements of the map, with the time of ranking them.

    table : of viscorough_study.performance.light_contact
    Times are on one thread, medians over the maps of one size; exponents are fitted to the larger half of the sizes.
    """
    own = table[(table["solver"] == "viscorough") & (table["threads"] == 1) & (table["met"] == 1)]
    own = own.assign(number=own["elements"] ** 2.0)
    medians = own.groupby(["fraction", "number"], as_index=False)[["wall_s", "ranking_s"]].median()
    sizes = medians.groupby("fraction")["number"].transform("size")
    grown = medians[sizes == sizes.max()]  # other loads are on few maps only
    looks = style.series_looks(grown["fraction"].unique())
    figure = style.new_figure(85, style.NARROW)
    axes = figure.subplots()
    for fraction, costs in grown.groupby("fraction"):
        larger = costs[min(len(costs) // 2, len(costs) - 2) :]
        exponent, _ = fit_cost(larger["number"], larger["wall_s"])
        note = "" if np.isnan(exponent) else f", $N^{{{exponent:.2f}}}$"
        label = f"contact of {100 * fraction:g} %{note}"
        axes.plot(costs["number"], costs["wall_s"], **looks[fraction], label=label)
    ranking = grown.groupby("number")["ranking_s"].min()
    axes.plot(ranking.index, ranking, "--", color=style.GREY, label="reading and ranking the map")
    axes.set(xscale="log", yscale="log", xlabel="elements of the map", ylabel="wall time (s)")
    figure.legend(loc="outside lower center")
    return figure
