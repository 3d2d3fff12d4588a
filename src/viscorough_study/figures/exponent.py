"""Draw Figure 4 of the paper: the exponent β against the Hurst exponent, in both readings of the surfaces."""

import numpy as np

from viscorough import reference
from viscorough_study.figures import style
from viscorough_study.fits.conventions import READINGS, fits

# Look of the discs of each reading, and of the published discs on fine grids; the value SHIFT is added to H, so that
# markers do not hide each other.
LOOKS = {
    "A": {"color": style.BLUE, "marker": "o"},
    "B": {"color": style.VERMILION, "marker": "s", "markerfacecolor": "white"},
}
FINE = {"color": style.GREEN, "marker": "D"}
SHIFT = {"A": -0.012, "B": 0.012, "fine": 0.0}


@style.figure
def plot_exponent(scaling, conventions, hurst_min, fine_grids):
    """Draw β of MDR lines and of discs, with 95 % intervals, and β of Eq. 10, all against the Hurst exponent H.

    scaling : table of fitted power laws
    conventions : {column of the table: value}, which select the fits that are drawn (fits.conventions)
    hurst_min : H from which on the paper finds Eq. 10 accurate (resources/paper/numbers.yaml)
    fine_grids : published β of discs at smaller X on fine grids, rows of fits.fine_sentence.judged_rows
    """
    figure, axes = style.new_subplots(84, width=style.NARROW)
    axes.axvspan(hurst_min, 1, color="0.95", linewidth=0, zorder=0)
    axes.text((hurst_min + 1) / 2, 0.01, "where the paper finds\nEq. 10 accurate", color=style.GREY, ha="center")
    lines = fits(scaling, conventions | {"rms_convention": "line"}, source="lines")
    axes.fill_between(lines["hurst"], lines["beta_low"], lines["beta_high"], color=style.PALE, linewidth=0)
    axes.plot(lines["hurst"], lines["beta"], color="black")
    hurst = np.linspace(0, 1, 101)
    axes.plot(hurst, reference.exponent_beta(hurst), "--", color=style.GREY)
    handles = [
        style.handle("$H/(1+H)$, Eq. 10", color=style.GREY, linestyle="--"),
        style.handle(f"lines (MDR), {style.count_text([*lines['realizations']] or [0])} for each $H$", color="black"),
    ]
    for reading, columns in READINGS.items():
        rows = fits(scaling, conventions | columns, source="discs")
        for row in rows.itertuples():
            place, interval = row.hurst + SHIFT[reading], (row.beta_low, row.beta_high)
            style.mark_with_interval(axes, place, row.beta, interval, LOOKS[reading])
        number = style.count_text([*rows["realizations"]] or [0])
        handles.append(style.handle(f"discs, reading {reading}, {number} for each $H$", linestyle="", **LOOKS[reading]))
    for row in fine_grids:
        place, interval = row["hurst"] + SHIFT["fine"], (row["beta_low"], row["beta_high"])
        style.mark_with_interval(axes, place, row["beta"], interval, FINE)
    if fine_grids:
        across = style.count_text([row["across"] for row in fine_grids])
        handles.append(style.handle(f"discs, {across} across, small $X$ (published)", linestyle="", **FINE))
    axes.legend(handles=handles, loc="upper left", handlelength=1.8, borderaxespad=0)
    axes.set(xlim=(-0.02, 1.04), xlabel="Hurst exponent $H$", ylabel=r"exponent $\beta$")
    bottom, top = axes.get_ylim()
    axes.set_ylim(min(0, bottom), max(0.72, top))
    return figure
