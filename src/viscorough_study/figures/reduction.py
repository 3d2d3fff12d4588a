"""Draw the comparison of the method of dimensionality reduction (MDR) with boundary elements, surface by surface."""

import numpy as np

from viscorough_study.figures import style


@style.figure
def plot_reduction(table):
    """Draw ratios of MDR lines to discs with the same spectrum (a to d, f), and the correlation of their κ (e).

    Panel (a) shows the mean ratio of κ, and panel (b) the typical factor between κ of a line and of its disc. Further
    panels show the mean ratios of the contact fraction (c), of the mean gap (d), and of the force at equal depths (f).
    Bands are 95 % intervals of the means. The band in (e) contains 95 % of the correlations of unrelated pairs.
    table : table of viscorough_study.comparisons.mdr_comparison
    """
    figure, panels = style.new_subplots(125, 2, 3, sharex=True)
    stiffness, scatter, area, gap, correlation, force = panels.flat
    looks = style.hurst_looks(table["hurst"])
    for hurst, rows in table.groupby("hurst"):
        look = {"color": looks[hurst]["color"], "linestyle": looks[hurst]["linestyle"]}
        for axes, name in ((stiffness, "stiffness_ratio"), (area, "area_ratio"), (gap, "gap_ratio")):
            finite = rows.dropna(subset=name)
            style.draw_band(axes, finite, name, look["color"])
            axes.plot(finite["x"], finite[name], **look | {"marker": looks[hurst]["marker"] if axes is gap else ""})
        scatter.plot(rows["x"], np.exp(rows["stiffness_scatter"]), **look)
        correlation.plot(rows["x"], rows["correlation"], **look)
        force.plot(rows["x"], rows["force_ratio"], **look)
    chance = table.groupby("x")["chance"].max()
    correlation.fill_between(chance.index, -chance, chance, color="0.9", linewidth=0, zorder=0)
    for axes, title, label in (
        (stiffness, "(a) mean stiffness", r"$\kappa$ of line over disc"),
        (scatter, "(b) a single surface", r"factor between $\kappa$ of line and disc"),
        (area, "(c) mean contact fraction", "contact fraction of line over disc"),
        (gap, "(d) mean separation", "mean gap of line over disc"),
        (correlation, "(e) realization by realization", r"correlation of $\ln\kappa$"),
        (force, "(f) at the depth of the disc", "force of line over disc"),
    ):
        axes.set(title=title, ylabel=label, xscale="log", yscale="linear" if axes is correlation else "log")
        axes.axhline(0 if axes is correlation else 1, color=style.GREY, linewidth=0.6)
    correlation.set_ylim(-1, 1)
    for axes in panels[-1]:
        axes.set_xlabel("$X=F/(4GhL)$")
    title = f"{style.count_text(table['realizations'])} discs and lines for each $H$"
    handles = style.hurst_handles(looks, marker="")
    figure.legend(handles=handles, loc="outside lower center", title=title, ncols=len(looks))
    return figure
