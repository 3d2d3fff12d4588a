"""The curves of all grids as one scaling law, and the exponents with which they are one."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscorough.reference import exponent_beta
from viscorough_study.figures.style import (
    BLUE,
    GREY,
    MM,
    STYLE,
    VERMILION,
    WIDE,
    hurst_handles,
    hurst_looks,
    logarithmic_ticks,
    mark_with_interval,
    require_rows,
)

LIGHTEST = 0.35  # opacity of the coarsest grid
SHIFT = 3.0  # factor between curves of different H


@rc_context(STYLE)
def plot_collapse(curves, collapse, infinite):
    """vt/h (a) and that of the interface (b) of all grids over the law, (c) the exponents allowed.

    curves, collapse, infinite : tables of the rule fit_collapse. Raises ValueError for a table without rows.
    """
    require_rows("plot_collapse", collapse)
    figure = Figure(figsize=(WIDE, 130 * MM))
    places = figure.subplot_mosaic([["whole", "interface"], ["exponents", "exponents"]])
    whole, interface, exponents = places.values()
    looks = hurst_looks(curves["hurst"])
    titles = {"whole": "(a) $vt/h$", "interface": r"(b) interface, $vt/h - X/\kappa_c$"}
    for axes, (quantity, title) in zip((whole, interface), titles.items(), strict=True):
        _curves(axes, curves[curves["quantity"] == quantity], looks)
        axes.set_title(title)
    _exponents(exponents, collapse, infinite)
    logarithmic_ticks(whole, interface)
    handles = hurst_handles(looks, marker="", linestyle="-")
    figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
    return figure


def _curves(axes, curves, looks):
    """Every grid's curve over the law through it, (vt/h)/X^(H/(1+H)) up to a factor for each H, which are shifted."""
    for rank, (hurst, look) in enumerate(looks.items()):
        of_hurst = curves[curves["hurst"] == hurst]
        numbers = sorted(of_hurst["number"].unique())
        for opacity, number in zip(np.linspace(LIGHTEST, 1, len(numbers)), numbers, strict=True):
            curve = of_hurst[of_hurst["number"] == number]
            over_law = curve["velocity"] / curve["x"] ** exponent_beta(hurst) * SHIFT**-rank
            axes.plot(curve["x"] * number ** (1 + hurst), over_law, color=look["color"], alpha=opacity)
    axes.set(xscale="log", yscale="log", xlabel="scaled force", ylabel="velocity over the law, shifted")


def _exponents(axes, collapse, infinite):
    """β − H/(1 + H) over H: intervals with which the curves collapse, and limits of infinitely fine grids."""
    axes.axhline(0, color=GREY, linestyle=":", linewidth=0.8)
    looks = {"whole": {"color": BLUE, "marker": "o"}, "interface": {"color": VERMILION, "marker": "s"}}
    discs = collapse[(collapse["source"] == "discs") & (collapse["x_high"] == collapse["x_high"].iloc[0])]
    for offset, (quantity, look) in zip((-0.012, 0.012), looks.items(), strict=True):
        for row in _of_spectrum(discs[discs["quantity"] == quantity]).dropna(subset="beta_low").itertuples():
            ends = np.array([row.beta_low, row.beta_high]) - row.expected
            axes.plot([row.hurst + offset] * 2, ends, color=look["color"], linewidth=4, alpha=0.3)
        limits = infinite[(infinite["source"] == "discs") & (infinite["quantity"] == quantity)]
        for law, shift in (("power", 0.0), ("corrected", np.sign(offset) * 0.01)):
            shown = look | ({"markerfacecolor": "none"} if law == "corrected" else {})
            for row in _of_spectrum(limits[limits["law"] == law]).itertuples():
                ends = np.array([row.beta_low, row.beta_high]) - row.expected
                mark_with_interval(axes, row.hurst + offset + shift, row.beta - row.expected, ends, shown)
    axes.set(xlabel="Hurst exponent $H$", ylabel=r"$\beta$ less $H/(1+H)$", ylim=(-0.2, 0.5))
    axes.set_title("(c) exponents of all grids together")
    handles = []
    for quantity, look in looks.items():
        name = "vt/h" if quantity == "whole" else "interface"
        handles += [Line2D([], [], color=look["color"], linewidth=4, alpha=0.3, label=f"{name}: curves collapse")]
        handles += [Line2D([], [], **look, linestyle="", label=f"{name}: power law")]
        handles += [Line2D([], [], **look, markerfacecolor="none", linestyle="", label=f"{name}: with correction")]
    axes.legend(handles=handles, ncols=2, loc="upper right")


def _of_spectrum(table):
    """Rows with h over all waves of the spectrum, or, for H = 0, of the grid."""
    return table[(table["height"] == "spectrum") | (table["hurst"] == 0)]
