"""Draw the collapse of the curves of all grids in scaled variables, and the exponents β for which they collapse."""

import numpy as np

from viscorough.reference import exponent_beta
from viscorough_study.figures import style

LIGHTEST = 0.35  # opacity of the curves of the coarsest grid; the finest grid has opacity 1
SHIFT = 3.0  # curves of successive Hurst exponents are shifted apart by this factor


@style.figure
def plot_collapse(curves, collapse, infinite):
    """Draw scaled curves of vt/h (a) and of its interface part (b) on all grids, and the exponents of all grids (c).

    The interface part is vt/h − X/κ_c, where κ_c is the stiffness of a flat punch.
    curves, collapse, infinite : tables collapse_curves, collapse and infinite_grid of fits.infinite_grid
    """
    figure = style.new_figure(130)
    places = figure.subplot_mosaic([["whole", "interface"], ["exponents", "exponents"]])
    whole, interface, exponents = places.values()
    looks = style.hurst_looks(curves["hurst"])
    for quantity in ("whole", "interface"):
        _curves(places[quantity], curves[curves["quantity"] == quantity], looks)
    whole.set_title("(a) $vt/h$")
    interface.set_title(r"(b) interface, $vt/h - X/\kappa_c$")
    _exponents(exponents, collapse, infinite)
    handles = style.hurst_handles(looks, marker="", linestyle="-")
    figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
    return figure


def _curves(axes, curves, looks):
    """Draw the ratio of vt/h to X^(H/(1+H)) on every grid against the scaled force X N^(1+H).

    N is the number of elements across. The curves of each H are shifted by a constant factor.
    curves : table rows with the curves of vt/h, or of its interface part; looks : {H: line properties}
    """
    for rank, (hurst, look) in enumerate(looks.items()):
        grid_curves = curves[curves["hurst"] == hurst].groupby("number")
        for opacity, (number, curve) in zip(np.linspace(LIGHTEST, 1, len(grid_curves)), grid_curves, strict=True):
            over_law = curve["velocity"] / curve["x"] ** exponent_beta(hurst) * SHIFT**-rank
            axes.plot(curve["x"] * number ** (1 + hurst), over_law, color=look["color"], alpha=opacity)
    axes.set(xscale="log", yscale="log", xlabel="scaled force", ylabel="velocity over the law, shifted")


def _exponents(axes, collapse, infinite):
    """Draw β − H/(1 + H) against H: the range for which the curves collapse, and the value of an infinitely fine grid.

    collapse, infinite : arguments of `plot_collapse`
    """
    axes.axhline(0, color=style.GREY, linestyle=":", linewidth=0.8)
    looks = {"whole": {"color": style.BLUE, "marker": "o"}, "interface": {"color": style.VERMILION, "marker": "s"}}
    discs = collapse[(collapse["source"] == "discs") & (collapse["x_high"] == collapse["x_high"].iloc[0])]
    for offset, (quantity, look) in zip((-0.012, 0.012), looks.items(), strict=True):
        for row in discs[discs["quantity"] == quantity].dropna(subset="beta_low").itertuples():
            ends = np.array([row.beta_low, row.beta_high]) - row.expected
            axes.plot([row.hurst + offset] * 2, ends, color=look["color"], linewidth=4, alpha=0.3)
        limits = infinite[(infinite["source"] == "discs") & (infinite["quantity"] == quantity)]
        for law, shift in (("power", 0.0), ("corrected", np.sign(offset) * 0.01)):
            marker_look = look | ({"markerfacecolor": "none"} if law == "corrected" else {})
            for row in limits[limits["law"] == law].itertuples():
                ends = np.array([row.beta_low, row.beta_high]) - row.expected
                style.mark_with_interval(axes, row.hurst + offset + shift, row.beta - row.expected, ends, marker_look)
    axes.set(xlabel="Hurst exponent $H$", ylabel=r"$\beta$ less $H/(1+H)$", ylim=(-0.2, 0.5))
    axes.set_title("(c) exponents of all grids together")
    handles = []
    for quantity, look in looks.items():
        name = "vt/h" if quantity == "whole" else "interface"
        handles += [style.handle(f"{name}: curves collapse", color=look["color"], linewidth=4, alpha=0.3)]
        handles += [style.handle(f"{name}: power law", **look, linestyle="")]
        handles += [style.handle(f"{name}: with correction", **look, markerfacecolor="none", linestyle="")]
    axes.legend(handles=handles, ncols=2, loc="upper right")
