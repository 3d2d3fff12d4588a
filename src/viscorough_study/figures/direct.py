"""Draw depths by direct integration of the viscous problem, and by the law with and without the factor 1/Γ(2 − α)."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.run.readable import readable


@style.figure
def plot_direct(table):
    """Draw the ratio of viscous to elastic depth, by direct integration and by Eq. 8, against the elements in contact.

    Each indenter has a panel. A text in the panel states the largest deviation of the ratio by direct integration
    from 1.
    table : table of comparisons.direct_integration
    """
    cases = list(table["case"].unique())
    layout = {"columns": min(3, len(cases)), "height": 42, "rest": 16, "xlabel": "elements in contact"}
    figure, panels = style.new_panels(len(cases), **layout, sharex=True, sharey=True)
    for axes, case in zip(panels, cases, strict=True):
        rows = table[table["case"] == case]
        factor, deviation = rows["with_gamma"].iloc[0], np.abs(rows["depth_ratio"] - 1).max()
        axes.axhline(1, color=style.GREY, linewidth=0.8, zorder=1)
        axes.axhline(factor, color=style.GREY, linestyle="--", zorder=1)
        axes.plot(rows["contact_count"], rows["depth_ratio"], "o", color=style.BLACK, markersize=3.5)
        axes.set(title=case, xscale="log")
        axes.margins(y=0.15)
        text = {"transform": axes.get_yaxis_transform(), "color": style.GREY, "ha": "right"}
        axes.text(0.97, factor - 0.004, f"{factor:.3f}", va="top", **text)
        axes.text(0.97, 1.004, f"largest deviation {readable(deviation)}", va="bottom", **text)
    figure.supylabel("viscous depth over elastic depth")
    handles = [
        style.handle("direct integration in time", color=style.BLACK, marker="o", linestyle=""),
        style.handle("exact correspondence", color=style.GREY, linestyle="-"),
        style.handle(r"with the factor $1/\Gamma(2-\alpha)$, Eq. 8", color=style.GREY, linestyle="--"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure
