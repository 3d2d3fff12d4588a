"""Kinetics of the discs in other media."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscorough.reference import exponent_beta
from viscorough_study.figures.style import (
    GREY,
    MM,
    SERIES_MARKERS,
    SMALL,
    STYLE,
    WIDE,
    count_text,
    hurst_handles,
    hurst_looks,
    logarithmic_ticks,
    require_rows,
)
from viscorough_study.medium_names import medium_label

_DECADES = 1e-6  # of the largest velocity, down to which it is drawn: that of a solid falls exponentially


@rc_context(STYLE)
def plot_media(table):
    """vt/h over time, a panel for each medium, and the depth u/h over X = F J(t)/(4hL) in all of them.

    table : of viscorough_study.media_kinetics
    Dotted lines have slope 1, dashed ones the slope H/(1 + H) of Eq. 10 through X = 0.01 of the medium.
    Raises ValueError for a table without rows.
    """
    require_rows("plot_media", table)
    names, looks = list(dict.fromkeys(table["medium"])), hurst_looks(table["hurst"])
    rows = -(-(len(names) + 1) // 2)
    figure = Figure(figsize=(WIDE, (15 + 55 * rows) * MM))
    panels = figure.subplots(rows, 2, squeeze=False).ravel()
    for axes, name in zip(panels, names, strict=False):
        _plot_velocity(axes, table[table["medium"] == name], looks)
        axes.set_title(medium_label(name))
    collapsed, markers = panels[len(names)], dict(zip(names, SERIES_MARKERS, strict=False))
    for (name, hurst), part in table.groupby(["medium", "hurst"], sort=False):
        look = {"color": looks[hurst]["color"], "linestyle": "", "marker": markers[name], "markersize": 3}
        thinned = part.iloc[:: max(1, len(part) // 20)]
        collapsed.plot(thinned["x"], thinned["depth"], markerfacecolor="none", **look)
    collapsed.set(xscale="log", yscale="log", xlabel="$FJ/(4hL)$", ylabel="depth $u/h$", title="all media")
    handles = [
        Line2D([], [], color=GREY, linestyle="", marker=marker, markersize=3, markerfacecolor="none", label=label)
        for label, marker in ((medium_label(name), marker) for name, marker in markers.items())
    ]
    collapsed.legend(handles=handles, loc="upper left")
    for axes in panels[len(names) + 1 :]:
        axes.remove()
    figure.align_ylabels()
    logarithmic_ticks(*panels[: len(names) + 1])
    guides = (("slope 1", ":"), ("slope $H/(1+H)$, Eq. 10", "--"))
    handles = [Line2D([], [], color=GREY, linestyle=style, linewidth=0.8, label=label) for label, style in guides]
    title = f"each a mean over {count_text(table['realizations'])} discs"
    handles = [*hurst_handles(looks, marker=""), *handles]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), title=title, title_fontsize=SMALL)
    return figure


def _plot_velocity(axes, table, looks):
    """vt/h over t in one medium, with guides."""
    for hurst, part in table.groupby("hurst"):
        look = {"color": looks[hurst]["color"], "linestyle": looks[hurst]["linestyle"]}
        axes.plot(part["time"], part["velocity"], **look)
    axes.set(xscale="log", yscale="log", xlabel="time $t$ (s)", ylabel="velocity $vt/h$")
    limits = axes.get_xlim(), axes.get_ylim()
    for hurst, part in table.groupby("hurst"):
        time, velocity, x = (part[name].to_numpy() for name in ("time", "velocity", "x"))
        color = looks[hurst]["color"]
        axes.plot(time, velocity[0] * time / time[0], color=color, linestyle=":", linewidth=0.6)
        if x[0] < 0.01 < x[-1]:
            middle = np.abs(np.log(x / 0.01)).argmin()
            span = time[middle] * 10.0 ** np.array([-1.5, 1.5])
            guide = velocity[middle] * (span / time[middle]) ** exponent_beta(hurst)
            axes.plot(span, guide, color=color, linestyle="--", linewidth=0.6)
    highest = table["velocity"].max()
    axes.set(xlim=limits[0], ylim=(max(limits[1][0], _DECADES * highest), limits[1][1]))
