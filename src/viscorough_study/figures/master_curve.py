"""Draw Figure 3 of the paper: the master curve, Eq. 12."""

import numpy as np

from viscorough import reference
from viscorough_study.ensembles.mean_curve import mean_curve
from viscorough_study.figures import style
from viscorough_study.fits.conventions import fits

CONSTANT = {"color": style.GREY, "linestyle": "-", "linewidth": 0.6, "zorder": 1}


@style.figure
def plot_master_curve(discs, lines, scaling, conventions, *, fraction_min):
    """Draw vt/h (upper panel), and vt/h divided by Eq. 12 (lower panel), against the right side of Eq. 12.

    The right side contains the factor Γ.

    discs, lines : ensemble datasets, one for each Hurst exponent. Lines have the rms height of the discs (Eq. 13); only
        lines with a Hurst exponent of discs are drawn
    scaling : table of fitted power laws, with the ends of region (b); conventions : {column of this table: value}
    fraction_min : a mean is drawn if at least this fraction of the realizations has a value

    Discs are drawn as about eight symbols per decade of X, filled in region (b) and hollow elsewhere. Their bars extend
    two standard errors to either side. Region (a) is omitted. A thin line shows Eq. 12 times the constant that fits
    best where its prefactor is defined. The lower panel is cut to the range of the ratios in region (b), but extends at
    least from 0.5 to 2.
    """
    looks = style.hurst_looks(ds["hurst"].item() for ds in discs)
    figure, panels = style.new_subplots(120, 2, width=style.NARROW, sharex=True, height_ratios=(1.7, 1))
    law, ratio = panels
    for axes in panels:
        axes.set(xscale="log", yscale="log")
    lines = [ds for ds in lines if ds["hurst"].item() in looks]
    ratios = [0.5, 2]
    for ds in discs:
        hurst = ds["hurst"].item()
        windows = fits(scaling, conventions, source="discs", case_group="base", hurst=hurst)
        ratios += _draw_discs(panels, mean_curve(ds, conventions, fraction_min), hurst, windows, looks[hurst])
    for ds in lines:
        hurst, curve = ds["hurst"].item(), mean_curve(ds, conventions, fraction_min)
        right_side = reference.rate_law(curve.x, hurst, gamma=True)
        for axes, y in ((law, curve.velocity), (ratio, curve.velocity / right_side)):
            axes.plot(right_side[curve.several], y[curve.several], color=looks[hurst]["color"], zorder=3)
    ends = law.get_xlim()
    law.plot(ends, ends, "--", color="black")
    ratio.axhline(1, linestyle="--", color="black")
    constant = _constant(scaling, conventions)
    law.plot(ends, np.multiply(ends, constant), **CONSTANT)
    ratio.axhline(constant, **CONSTANT)
    law.set(xlim=ends, ylabel="$vt/h$")
    ratio.set(xlabel="right side of Eq. 12", ylabel="$vt/h$ over Eq. 12", ylim=(min(ratios) / 1.3, max(ratios) * 1.3))
    symbol, in_region = {"color": style.GREY, "linestyle": "", "marker": "o"}, [ds.sizes["realization"] for ds in discs]
    handles = [
        *style.hurst_handles(looks, linestyle="-"),
        style.handle(f"{style.count_text(in_region)} discs, region (b)", **symbol),
        style.handle(f"{style.realizations_text(discs)} discs, elsewhere", **symbol, markerfacecolor="white"),
        style.handle(f"{style.realizations_text(lines)} lines (MDR)", color=style.GREY),
        style.handle("Eq. 12", color="black", linestyle="--"),
        style.handle(f"Eq. 12 times {constant:.2f}", **CONSTANT),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=2, columnspacing=1)
    return figure


def _constant(scaling, conventions):
    """Return the constant by which Eq. 12 describes the discs best in region (b); nan if there is none.

    Hurst exponents count if a law with the exponent H/(1 + H) describes their curves, so that its prefactor is defined.
    """
    discs = fits(scaling, conventions | {"gamma": "with"}, source="discs", case_group="base")
    discs = discs[discs["residual_fixed"] <= style.DEFINED]
    return np.exp(np.log(reference.zeta_viscous(discs["hurst"]) / discs["zeta_fixed"]).mean())


def _draw_discs(panels, curve, hurst, windows, look):
    """Draw the discs of one Hurst exponent in both panels; return the ratios in region (b) that were drawn.

    Symbols are filled in region (b) and hollow elsewhere.
    curve : mean curve of the discs; windows : table of the fits, with the ends x_low and x_high of region (b)
    """
    look = look | {"linestyle": "", "markersize": 3, "capsize": 0, "elinewidth": 0.8}
    right_side = reference.rate_law(curve.x, hurst, gamma=True)
    step = max(1, np.searchsorted(curve.x, 10 * curve.x[0]) // 8)
    thinned = curve.several & (np.arange(curve.x.size) % step == 0)
    inside = np.zeros(curve.x.size, dtype=bool)
    for window in windows.itertuples():
        inside = (curve.x >= window.x_low * (1 - 1e-6)) & (curve.x <= window.x_high * (1 + 1e-6))
    for axes, y in zip(panels, (curve.velocity, curve.velocity / right_side), strict=True):
        error = y * (1 - np.exp(-curve.error)), y * (np.exp(curve.error) - 1)
        for part, face in ((thinned & inside, look["color"]), (thinned & ~inside, "white")):
            bars = [side[part] for side in error]
            axes.errorbar(right_side[part], y[part], bars, markerfacecolor=face, markeredgewidth=0.7, **look)
    return (curve.velocity / right_side)[thinned & inside].tolist()
