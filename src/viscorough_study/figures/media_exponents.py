"""Local exponents of the velocity in time, in other media than the paper's."""

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from viscorough_study.figures.style import (
    GREY,
    MM,
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

_RANGE = (-0.6, 1.2)  # of the exponents drawn: that of a solid falls without limit


@rc_context(STYLE)
def plot_media_exponents(table):
    """d ln(vt/h)/d ln t over time, one panel for each medium, with that by Eq. 10 and the creep compliance.

    table : of viscorough_study.media_kinetics
    Raises ValueError for a table without rows.
    """
    require_rows("plot_media_exponents", table)
    names, looks = list(dict.fromkeys(table["medium"])), hurst_looks(table["hurst"])
    rows = -(-len(names) // 3)
    figure = Figure(figsize=(WIDE, (18 + 48 * rows) * MM))
    panels = figure.subplots(rows, 3, squeeze=False, sharey=True).ravel()
    for axes, name in zip(panels, names, strict=False):
        for hurst, part in table[table["medium"] == name].groupby("hurst"):
            color = looks[hurst]["color"]
            axes.plot(part["time"], part["exponent"], color=color)
            axes.plot(part["time"], part["expected"], color=color, linestyle="--", linewidth=0.7)
        axes.plot(part["time"], part["creep_exponent"], color=GREY, linestyle=":")
        axes.set(title=medium_label(name), xscale="log", xlabel="time $t$ (s)", ylim=_RANGE)
        if axes.get_subplotspec().is_first_col():
            axes.set_ylabel(r"exponent of $vt/h$ in $t$")
    for axes in panels[len(names) :]:
        axes.remove()
    logarithmic_ticks(*panels[: len(names)])
    for axes in panels[: len(names)]:
        axes.xaxis.set_major_locator(LogLocator(numticks=5))
    guides = (("by Eq. 10 and $J$", "--"), ("exponent of $J$", ":"))
    handles = [Line2D([], [], color=GREY, linestyle=style, linewidth=0.8, label=label) for label, style in guides]
    handles = [*hurst_handles(looks, marker="", linestyle="-"), *handles]
    title = f"each a mean over {count_text(table['realizations'])} discs"
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), title=title, title_fontsize=SMALL)
    return figure
