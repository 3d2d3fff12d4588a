"""Draw λ of the lines that represent discs, and the agreement of lines and discs with the best λ."""

import numpy as np

from viscorough_study.comparisons.mdr_equivalence import WINDOWS
from viscorough_study.figures import style

_MARKERS = dict(zip(WINDOWS, "oDs", strict=True))
_SHIFT = 0.02  # distance in H between the markers of one Hurst exponent
# The axes end this factor beyond the values of region (b), in which the paper claims a constant λ. Below region (b) λ
# falls, because lines have finer grids. Above it λ grows without bound as contact becomes complete.
_MARGIN = 1.3


@style.figure
def plot_mdr_lambda(lambdas, exponents):
    """Draw λ over X (a), vt/h of lines with the best single λ over vt/h of discs (b), and exponents in equal windows
    (c).

    lambdas, exponents : tables of viscorough_study.comparisons.mdr_equivalence
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
    """Return limits of a logarithmic axis around a column and its intervals; None without rows."""
    return (rows[f"{name}_low"].min() / _MARGIN, rows[f"{name}_high"].max() * _MARGIN) if len(rows) else None
