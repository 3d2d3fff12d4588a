"""The method of reduction of dimensionality (MDR) against boundary elements, surface by surface."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from viscorough_study.figures.style import GREY, MM, STYLE, WIDE, hurst_looks, plain_ticks, require_rows


@rc_context(STYLE)
def plot_mdr_comparison(table):
    """Lines compared with the discs whose spectra they have, over X: κ (a), contact fraction (b), correlation (c).

    table : of viscorough_study.mdr_comparison. Raises ValueError for a table without rows.
    """
    require_rows("plot_mdr_comparison", table)
    figure = Figure(figsize=(WIDE, 75 * MM))
    stiffness, area, correlation = figure.subplots(1, 3, sharex=True)
    looks = hurst_looks(table["hurst"])
    for hurst, rows in table.groupby("hurst"):
        look = {"color": looks[hurst]["color"], "linestyle": looks[hurst]["linestyle"]}
        scatter = np.exp(rows["stiffness_scatter"])
        band = rows["stiffness_ratio"] / scatter, rows["stiffness_ratio"] * scatter
        stiffness.fill_between(rows["x"], *band, color=look["color"], alpha=0.12, linewidth=0)
        stiffness.plot(rows["x"], rows["stiffness_ratio"], **look, label=f"$H={hurst:g}$")
        area.plot(rows["x"], rows["area_ratio"], **look)
        correlation.plot(rows["x"], rows["correlation"], **look)
    for axes, title, label in (
        (stiffness, "(a) stiffness", r"$\kappa$ of line over disc [1]"),
        (area, "(b) contact fraction", "contact fraction of line over disc [1]"),
        (correlation, "(c) realization by realization", r"correlation of $\ln\kappa$ [1]"),
    ):
        axes.set(title=title, xlabel="$X=F/(4GhL)$ [1]", ylabel=label, xscale="log")
        axes.axhline(0 if axes is correlation else 1, color=GREY, linewidth=0.6)
    for axes in (stiffness, area):
        axes.set_yscale("log")
        plain_ticks(axes.yaxis, [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500])
    correlation.set_ylim(-1, 1)
    figure.legend(loc="outside lower center", ncols=len(looks))
    return figure
