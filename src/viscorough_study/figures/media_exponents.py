"""Local exponents of the velocity in time, in media other than the paper's."""

from matplotlib.ticker import LogLocator

from viscorough_study.figures import style
from viscorough_study.run.cases import medium_label

_RANGE = (-0.6, 1.2)  # limits of the axis: the exponent of a solid falls without bound


@style.figure
def plot_media_exponents(table):
    """d ln(vt/h)/d ln t over time, one panel for each medium, with its value by Eq. 10 and the creep compliance.

    table : of viscorough_study.comparisons.media_kinetics
    """
    names, looks = list(dict.fromkeys(table["medium"])), style.hurst_looks(table["hurst"])
    label = r"exponent of $vt/h$ in $t$"
    figure, panels = style.new_panels(len(names), 3, height=48, rest=18, ylabel=label, sharey=True)
    for axes, name in zip(panels, names, strict=True):
        for hurst, part in table[table["medium"] == name].groupby("hurst"):
            color = looks[hurst]["color"]
            axes.plot(part["time"], part["exponent"], color=color)
            axes.plot(part["time"], part["expected"], color=color, linestyle="--", linewidth=0.7)
        axes.plot(part["time"], part["creep_exponent"], color=style.GREY, linestyle=":")
        axes.set(title=medium_label(name), xscale="log", xlabel="time $t$ (s)", ylim=_RANGE)
        style.logarithmic_ticks(axes)
        axes.xaxis.set_major_locator(LogLocator(numticks=5))
    guides = {"by Eq. 10 and $J$": "--", "exponent of $J$": ":"}
    style.add_legend_of_means(figure, style.hurst_handles(looks, marker="", linestyle="-"), guides, table)
    return figure
