"""Draw depths by direct integration of the viscous problem, and by the law with and without the factor 1/Γ(2 − α)."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.run.readable import readable

HALF = 0.36  # half the width of the strip of an indenter, of which each has the width 1


@style.figure
def plot_direct(table):
    """Draw the ratio of viscous to elastic depth, by direct integration and by Eq. 8, for each indenter.

    In the strip of an indenter, the number of elements in contact grows from left to right. A text below it states the
    largest deviation of the ratio by direct integration from 1.
    table : table of comparisons.direct_integration
    """
    figure, axes = style.new_subplots(68)
    axes.axhline(1, color=style.GREY, linewidth=0.8, zorder=1)
    names = []
    for place, (indenter, rows) in enumerate(table.groupby("indenter", sort=False)):
        counts, ratios, factor = np.log(rows["contact_count"]), rows["depth_ratio"], rows["with_gamma"].iloc[0]
        inside = place + HALF * (2 * (counts - counts.min()) / max(np.ptp(counts), 1e-9) - 1)
        axes.plot(inside, ratios, "o", color=style.BLUE, markersize=3.5)
        axes.plot([place - HALF, place + HALF], [factor, factor], color=style.VERMILION, linewidth=2)
        text = {"xytext": (0, 4), "textcoords": "offset points", "ha": "center"}
        axes.annotate(f"{factor:.3f}", (place, factor), color=style.VERMILION, **text)
        elements, deviation = style.count_text(rows["contact_count"]), readable(np.abs(ratios - 1).max())
        names.append(f"{indenter}\n{elements}\n{deviation}")
    axes.set_xticks(range(len(names)), names)
    axes.set(ylabel="viscous depth over elastic depth")
    axes.set_xlabel("indenter; elements in contact, from left to right; largest deviation of direct integration from 1")
    axes.margins(y=0.12)
    axes.tick_params(axis="x", length=0)
    figure.legend(
        handles=[
            style.handle("direct integration in time", color=style.BLUE, marker="o", linestyle=""),
            style.handle("correspondence: 1", color=style.GREY, linewidth=0.8),
            style.handle(r"with the factor $1/\Gamma(2-\alpha)$, Eq. 8", color=style.VERMILION, linewidth=2),
        ],
        loc="outside upper center",
        ncols=3,
    )
    return figure
