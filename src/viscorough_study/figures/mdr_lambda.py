"""Draw λ (Eq. 13) of the lines that represent discs, and how well lines with the best λ agree with the discs."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.run.names import WINDOWS

_MARKERS = dict(zip(WINDOWS, "oDs", strict=True))
_SHIFT = 0.02  # distance in H between the markers of different windows at the same Hurst exponent
# The vertical axes extend beyond the values in region (b) only by this factor, because the paper claims a constant λ
# only in region (b). At smaller X, λ falls, because lines have finer grids. At larger X, λ grows without bound as
# contact becomes complete.
_MARGIN = 1.3


@style.figure
def plot_mdr_lambda(lambdas, exponents):
    """Draw λ against X (a), the ratio of vt/h of lines to discs (b), and the differences of their exponents β (c).

    In (b), all lines of a Hurst exponent have the same λ, which fits best. In (c), the legend names the windows in X or
    κ in which the exponents are fitted.
    lambdas, exponents : tables mdr_lambda and mdr_exponents of viscorough_study.comparisons.mdr_equivalence
    """
    figure, (values, ratios, differences) = style.new_subplots(75, 1, 3)
    looks = style.hurst_looks(exponents["hurst"])
    for hurst, rows in lambdas.groupby("hurst"):
        color, inside = looks[hurst]["color"], rows["in_region"] == 1
        for axes, name in ((values, "lambda"), (ratios, "velocity_ratio")):
            style.draw_band(axes, rows, name, color)
            axes.plot(rows["x"], rows[name], color=color, linestyle=looks[hurst]["linestyle"], linewidth=0.7)
            axes.plot(rows["x"][inside], rows[name][inside], color=color, linewidth=2)
    values.axhline(np.pi, color=style.GREY, linewidth=0.6)
    ratios.axhline(1, color=style.GREY, linewidth=0.6)
    region = lambdas[lambdas["in_region"] == 1]
    values.set(title="(a) the λ that fits at $X$", ylabel=r"$\lambda$", ylim=_limits(region, "lambda"))
    ylim = _limits(region, "velocity_ratio")
    ratios.set(title="(b) one λ for each $H$", ylabel="$vt/h$ of lines over discs", ylim=ylim)
    for axes in (values, ratios):
        axes.set(xscale="log", yscale="log", xlabel="$X=F/(4GhL)$")
    for row in exponents.dropna(subset="difference").itertuples():
        place = row.hurst + _SHIFT * (WINDOWS.index(row.window) - 1)
        look = {"color": looks[row.hurst]["color"], "marker": _MARKERS[row.window]}
        style.mark_with_interval(differences, place, row.difference, (row.difference_low, row.difference_high), look)
    differences.axhline(0, color=style.GREY, linewidth=0.6)
    differences.set(title="(c) exponents", xlabel="$H$", ylabel=r"$\beta$ of lines minus $\beta$ of discs", xlim=(0, 1))
    marks = [style.handle(name, color=style.GREY, linestyle="", marker=mark) for name, mark in _MARKERS.items()]
    handles = [*style.hurst_handles(looks, marker=""), *marks]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def _limits(rows, name):
    """Return the limits of a logarithmic axis that shows all intervals of the column `name`; None without rows."""
    return (rows[f"{name}_low"].min() / _MARGIN, rows[f"{name}_high"].max() * _MARGIN) if len(rows) else None
