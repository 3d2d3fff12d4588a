"""Draw the kinetics of the discs in media other than the paper's."""

import numpy as np

from viscorough.reference import exponent_beta
from viscorough_study.figures import style

# The axis of velocities begins at this share of the largest velocity. Otherwise it would show many useless decades,
# because velocities in a solid decay exponentially.
_LOWEST = 1e-6
HOLLOW = {"linestyle": "", "markersize": 3, "markerfacecolor": "none"}


@style.figure
def plot_media(table):
    """Draw vt/h against time, with a panel for each medium, and u/h of all media against X = F J(t)/(4hL).

    J is the creep compliance of the medium. Dotted lines have slope 1. Dashed lines have the slope H/(1 + H) of Eq. 10,
    and meet the curve at X = 0.01.
    table : table of viscorough_study.comparisons.media_kinetics
    """
    names, looks = list(dict.fromkeys(table["medium"])), style.hurst_looks(table["hurst"])
    figure, panels = style.new_panels(len(names) + 1, 2, height=55, rest=15)
    for axes, name in zip(panels[:-1], names, strict=True):
        _plot_velocity(axes, table[table["medium"] == name], looks)
        axes.set_title(_label(name))
    collapsed, markers = panels[-1], dict(zip(names, style.SERIES_MARKERS, strict=False))
    for (name, hurst), part in table.groupby(["medium", "hurst"], sort=False):
        thinned = part.iloc[:: max(1, len(part) // 20)]
        collapsed.plot(thinned["x"], thinned["depth"], color=looks[hurst]["color"], marker=markers[name], **HOLLOW)
    collapsed.set(xscale="log", yscale="log", xlabel="$FJ/(4hL)$", ylabel="depth $u/h$", title="all media")
    grey = {"color": style.GREY, **HOLLOW}
    handles = [style.handle(_label(name), marker=marker, **grey) for name, marker in markers.items()]
    collapsed.legend(handles=handles, loc="upper left")
    figure.align_ylabels()
    guides = {"slope 1": ":", "slope $H/(1+H)$, Eq. 10": "--"}
    handles = [style.handle(label, color=style.GREY, linestyle=line) for label, line in guides.items()]
    handles = [*style.hurst_handles(looks, marker=""), *handles]
    title = f"each a mean over {style.count_text(table['realizations'])} discs"
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), title=title)
    return figure


def _plot_velocity(axes, table, looks):
    """Draw vt/h against time in one medium, with guide lines of the slopes 1 and H/(1 + H).

    table : table rows of this medium; looks : {H: line properties}
    """
    for hurst, part in table.groupby("hurst"):
        axes.plot(part["time"], part["velocity"], **looks[hurst] | {"marker": ""})
    axes.set(xscale="log", yscale="log", xlabel="time $t$ (s)", ylabel="velocity $vt/h$")
    bottom, top = axes.get_ylim()
    axes.autoscale(False)
    for hurst, part in table.groupby("hurst"):
        time, velocity, x = (part[name].to_numpy() for name in ("time", "velocity", "x"))
        color = looks[hurst]["color"]
        axes.plot(time, velocity[0] * time / time[0], color=color, linestyle=":", linewidth=0.6)
        if x[0] < 0.01 < x[-1]:
            middle = np.abs(np.log(x / 0.01)).argmin()
            span = time[middle] * 10.0 ** np.array([-1.5, 1.5])
            guide = velocity[middle] * (span / time[middle]) ** exponent_beta(hurst)
            axes.plot(span, guide, color=color, linestyle="--", linewidth=0.6)
    axes.set_ylim(max(bottom, _LOWEST * table["velocity"].max()), top)


def _label(name):
    """Return the name of a medium in the settings as text for readers, such as "Standard linear solid"."""
    return name.replace("_", " ").capitalize().replace("Kelvin voigt", "Kelvin-Voigt")
