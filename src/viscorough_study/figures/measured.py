"""Measured surfaces compared with generated discs."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.figures.mean_curve import mean_curve
from viscorough_study.fits.conventions import fits


@style.figure
def plot_measured(groups, discs, scaling, conventions, *, fraction_min):
    """vt/h over X of measured surfaces and of generated discs.

    groups : {name: ensemble dataset of its scans}; discs : ensemble datasets of discs, one for each Hurst exponent
    scaling : fits of the groups; conventions : {column of a scaling table: value}
    fraction_min : smallest fraction of defined discs for which a mean is drawn
    """
    figure = style.new_figure(100, style.NARROW)
    axes = figure.subplots()
    looks, hursts = style.series_looks(groups), style.hurst_looks(ds["hurst"].item() for ds in discs)
    for ds in discs:
        curve, look = mean_curve(ds, conventions, fraction_min), hursts[ds["hurst"].item()]
        look = look | {"marker": "", "linewidth": 0.7, "alpha": 0.6}
        axes.plot(curve.x[curve.several], curve.velocity[curve.several], **look)
    for name, group in groups.items():
        color, x = looks[name]["color"], group["x"].values
        for velocity, count in zip(group["velocity"].values[0], group["contact_count"].values[0], strict=True):
            axes.plot(x[count > 1], velocity[count > 1], color=color, linewidth=0.9)
        own_rms = {"rms_convention": "disc", "source": "measured", "case_group": name}
        for row in fits(scaling, conventions, **own_rms).itertuples():
            window = np.array([row.x_low, row.x_high])
            axes.plot(window, window**row.beta / row.zeta, color=color, linewidth=3, alpha=0.4)
    axes.set(xscale="log", yscale="log", xlabel=r"$X = Ft/(4\eta hL)$", ylabel="velocity $vt/h$")
    handles = [
        *(style.handle(name.replace("_", " "), color=looks[name]["color"]) for name in groups),
        *style.hurst_handles(hursts, marker="", linewidth=0.7, alpha=0.6),
        style.handle("power law, region (b)", color=style.GREY, linewidth=3, alpha=0.4),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure
