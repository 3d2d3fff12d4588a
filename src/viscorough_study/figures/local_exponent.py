"""Draw the local exponent β over X on fine grids, and on the grid of the paper."""

import numpy as np

from viscorough.reference import exponent_beta
from viscorough_study.figures import style
from viscorough_study.run.names import PAPER_GRID

TITLES = {"whole": "(a) $vt/h$", "interface": r"(b) interface alone, $vt/h - X/\kappa_c$"}
COARSE = {"linestyle": ":", "linewidth": 1.0}  # look of the exponents on the grid of the paper
LARGEST_STEP = 1.5  # ratio of the X of successive decades from which on a line is broken
JUDGED = {"linestyle": "", "markersize": 6, "markeredgecolor": style.BLACK, "markeredgewidth": 0.8}


@style.figure
def plot_local_exponent(exponents):
    """Draw β over X for vt/h (a) and for its part of the interface (b), on the finest grids and on 257.

    exponents : table of fits.fine_grids with the columns `EXPONENTS`

    β is the slope in a decade of X, drawn at the geometric mean of the ends of the decade. Bands are 95 % intervals.
    Horizontal lines are H/(1 + H). Markers are the decades of the smallest X, by which the limit is judged.
    """
    looks = style.hurst_looks(exponents["hurst"])
    figure, panels = style.new_subplots(92, 1, 2, sharex=True, sharey=True)
    for axes, (quantity, title) in zip(panels, TITLES.items(), strict=True):
        for hurst, look in looks.items():
            rows = exponents[(exponents["quantity"] == quantity) & (exponents["hurst"] == hurst)]
            _draw(axes, rows, look)
            axes.axhline(exponent_beta(hurst), color=look["color"], linewidth=0.7, linestyle="--", zorder=1)
        axes.set(xscale="log", xlabel="$X$ at the middle of the decade", title=title)
    panels[0].set_ylabel(r"exponent $\beta$ in a decade of $X$")
    finest = exponents["across"].max()
    handles = style.hurst_handles(looks, linestyle="-")
    handles += [
        style.handle("finest grid, 95 % band", color=style.GREY),
        style.handle(f"grid of {PAPER_GRID}", color=style.GREY, **COARSE),
        style.handle("$H/(1+H)$", color=style.GREY, linewidth=0.7, linestyle="--"),
        style.handle("decade that is judged", color=style.GREY, marker="o", **JUDGED),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=5)
    figure.suptitle(f"Discs on grids of up to {finest:g} elements across", fontsize=8)
    return figure


def _draw(axes, rows, look):
    """Draw the exponents of a Hurst exponent on the finest grid of each decade, and on the grid of the paper."""
    finest = rows[rows["finest"] == 1].sort_values("x_low")
    # Break the line where no grid supports the decades between.
    for _, part in finest.groupby((finest["x_low"].pct_change() > LARGEST_STEP - 1).cumsum()):
        middle = part["x_low"] * np.sqrt(10)
        axes.fill_between(middle, part["beta_low"], part["beta_high"], color=look["color"], alpha=0.2, linewidth=0)
        axes.plot(middle, part["beta"], color=look["color"])
    coarse = rows[rows["across"] == PAPER_GRID].sort_values("x_low")
    axes.plot(coarse["x_low"] * np.sqrt(10), coarse["beta"], color=look["color"], **COARSE)
    for row in rows[rows["judged"] == 1].itertuples():
        marker = JUDGED | {"color": look["color"], "marker": look["marker"]}
        style.mark_with_interval(axes, row.x_low * np.sqrt(10), row.beta, (row.beta_low, row.beta_high), marker)
