"""Draw Figure 4 of the paper: the exponent β against the Hurst exponent."""

import numpy as np
from matplotlib.legend_handler import HandlerTuple

from viscorough import reference
from viscorough_study.figures import style
from viscorough_study.fits.conventions import fits

# Look of exponents on fine grids; they are drawn at H plus SHIFT, so that they do not hide other markers.
FINE = {"color": style.VERMILION, "marker": "D", "markerfacecolor": "none", "linestyle": ""}
SHIFT = 0.015


@style.figure
def plot_exponent(scaling, conventions, hurst_range, fine_grids):
    """Draw β of MDR lines and of discs, with 95 % intervals, and β of Eq. 10, all against the Hurst exponent H.

    Open diamonds are the published β of discs at smaller X on finer grids, in the decades by which the limit is judged.
    scaling : table of fitted power laws
    conventions : {column of the table: value}, which select the fits that are drawn (fits.conventions)
    hurst_range : range of H in which the paper finds Eq. 10 accurate (resources/paper/laws.yaml)
    fine_grids : published rows from fits.fine_sentence.judged_rows
    """
    looks = style.hurst_looks(scaling.loc[scaling["source"] == "discs", "hurst"])
    figure, axes = style.new_subplots(82, width=style.NARROW)
    axes.axvspan(*hurst_range, color="0.94", linewidth=0)
    text = {"color": style.GREY, "ha": "right", "transform": axes.transAxes}
    axes.text(0.94, 0.04, "where the paper finds\nEq. 10 accurate", **text)
    lines = fits(scaling, conventions, source="lines", case_group="base", rms_convention="line")
    band = axes.fill_between(lines["hurst"], lines["beta_low"], lines["beta_high"], color=style.PALE, linewidth=0)
    (solid,) = axes.plot(lines["hurst"], lines["beta"], color="black")
    discs = fits(scaling, conventions, source="discs", case_group="base")
    for row in discs.itertuples():
        style.mark_with_interval(axes, row.hurst, row.beta, (row.beta_low, row.beta_high), looks[row.hurst])
    hurst = np.linspace(0, 1, 101)
    (law,) = axes.plot(hurst, reference.exponent_beta(hurst), "--", color=style.GREY)
    legend, apart = {"$H/(1+H)$, Eq. 10": law}, {}
    if len(lines):
        legend[f"MDR, {style.count_text(lines['realizations'])} lines for each $H$"] = (band, solid)
    if len(discs):
        symbols = tuple(style.hurst_handles({row.hurst: looks[row.hurst] for row in discs.itertuples()}, linestyle=""))
        names = ", ".join(f"{row.hurst:g}" for row in discs.itertuples())
        text = f"boundary elements, {style.count_text(discs['realizations'])} discs for each $H$:\n$H$ = {names}"
        legend[text] = symbols
        apart[symbols] = HandlerTuple(ndivide=None)  # the markers side by side, not on top of each other
    for row in fine_grids:
        style.mark_with_interval(axes, row["hurst"] + SHIFT, row["beta"], (row["beta_low"], row["beta_high"]), FINE)
    if fine_grids:
        across = max(row["across"] for row in fine_grids)
        legend[f"{across:g} across, smaller $X$ (published: make fine-grids)"] = style.handle("", **FINE)
    figure.legend(legend.values(), legend.keys(), loc="outside upper center", handler_map=apart, handlelength=4.5)
    axes.set(xlim=(-0.02, 1.04), xlabel="Hurst exponent $H$", ylabel=r"exponent $\beta$")
    axes.set_ylim(bottom=min(0, axes.get_ylim()[0]))
    return figure
