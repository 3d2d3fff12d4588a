"""Figures of the reproduction: one function for each, which returns a matplotlib Figure for save_figure.

`shown` names the conventions to draw, {column of the scaling table: value}; L in a figure is what its
diameter_convention says, and means are over the realizations defined, from viscorough_study.ensembles.
"""

from dataclasses import dataclass

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, MaxNLocator

from viscorough import reference
from viscorough_study.figures.comparisons import plot_conventions, plot_validation
from viscorough_study.figures.style import (
    GREY,
    MM,
    NARROW,
    PALE,
    STYLE,
    WIDE,
    hurst_handles,
    hurst_looks,
    logarithmic_ticks,
    mark,
    save_figure,
    text_along,
)
from viscorough_study.tables import fits

__all__ = [
    "plot_conventions",
    "plot_exponent",
    "plot_kinetics",
    "plot_master_curve",
    "plot_surfaces",
    "plot_validation",
    "save_figure",
]

FRACTION_MIN = 0.95  # of the realizations, for a mean to be drawn; as in viscorough_study.power_law.find_region


@rc_context(STYLE)
def plot_surfaces(examples):
    """Discs side by side, four in a row; darker is higher, and each grey scale spans the heights of its disc.

    examples : (Hurst exponent, heights over rms height of shape (rows, columns), spacing over diameter) of each
    """
    columns = min(4, len(examples))
    rows = -(-len(examples) // columns)
    figure = Figure(figsize=(WIDE * columns / 4, 64 * MM * rows), layout="compressed")
    grid = figure.subplots(rows, columns, squeeze=False, sharey=True)
    for axes in grid.flat[len(examples) :]:
        axes.remove()
    for axes, (hurst, heights, spacing) in zip(grid.flat, examples, strict=False):
        half = np.array(heights.shape) * spacing / 2
        extent = (-half[1], half[1], -half[0], half[0])
        image = axes.imshow(heights, cmap="Greys", extent=extent, origin="lower", interpolation="nearest")
        axes.set(title=f"$H={hurst:g}$", xlabel="$x/L$", xticks=(-0.5, 0, 0.5), yticks=(-0.5, 0, 0.5))
        bar = figure.colorbar(image, ax=axes, location="bottom", shrink=0.9, aspect=14, label="height$/h$")
        bar.ax.xaxis.set_major_locator(MaxNLocator(4, integer=True))
    for axes in grid[:, 0]:
        axes.set_ylabel("$y/L$")
    return figure


@rc_context(STYLE)
def plot_kinetics(ensembles, combinations, table, shown):
    """Velocity over time in real units, and vt/h over Ft/(hηL) computed from them (Eq. 2).

    ensembles : ensemble datasets of the cases
    combinations : {case: force [N], viscosity [Pa s], diameter [m], rms [m]}
    table, shown : scaling table, which has region (b), and conventions

    Grey where one element is in contact, region (a), of which one decade is shown; bars at the bottom are the windows
    of region (b). The rms height is that of the combination, met exactly if h is measured where it was prescribed.
    """
    looks = hurst_looks(ds["hurst"].item() for ds in ensembles)
    figure = Figure(figsize=(WIDE, 95 * MM))
    raw, collapsed = figure.subplots(1, 2, width_ratios=(1, 1.3))
    curves = [_mean_curve(ds, shown) for ds in ensembles]
    start = min((curve.x[curve.several][0] for curve in curves if curve.several.any()), default=0) / 10
    ends = {}
    for ds, curve in zip(ensembles, curves, strict=True):
        case, look = ds["case"].item(), looks[ds["hurst"].item()] | {"marker": "", "linewidth": 0.8}
        force, viscosity, diameter, rms = (combinations[case][of] for of in ("force", "viscosity", "diameter", "rms"))
        length = diameter * _length(shown)
        time = 4 * curve.x * viscosity * rms * length / force
        velocity = curve.velocity * rms / time
        one = (~curve.several | np.append(True, ~curve.several[:-1])) & (curve.x >= start)  # to the first of several
        scaled = force * time / (rms * viscosity * length), velocity * time / rms
        for axes, (x, y) in ((raw, (time, velocity)), (collapsed, scaled)):
            axes.plot(x[one], y[one], color=PALE, zorder=1)
            axes.plot(x[curve.several], y[curve.several], label=case, **look)
        for last in np.flatnonzero(np.isfinite(velocity))[-1:]:
            ends[case.partition("_")[2]] = time[last], velocity[last]
    raw.set(xscale="log", yscale="log", xlabel="time $t$ (s)", ylabel="velocity $v$ (m/s)")
    raw.margins(0.08)
    for name, end in ends.items():
        halo = [withStroke(linewidth=2, foreground="white")]
        raw.annotate(name, end, (0, -3), textcoords="offset points", ha="center", va="top", path_effects=halo)
    collapsed.set(xscale="log", yscale="log", xlabel=r"$Ft/(h\eta L)$", ylabel="$vt/h$")
    _mark_regions(collapsed, _elements_across(ensembles[0]["elements"].item()), looks, table, shown)
    collapsed.legend(handles=hurst_handles(looks, marker=""), loc="upper left")
    logarithmic_ticks(raw, collapsed)
    return figure


def _mark_regions(axes, elements_across, looks, table, shown):
    """Limits (a) and (c), vt/h = X/κ of one element and of all, and windows of region (b), over Ft/(hηL) = 4X."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    for stiffness, low, start, text, side in (
        (reference.one_element_stiffness(elements_across), bottom, 0.6, "(a) one element in contact", "bottom"),
        (reference.COMPLETE_CONTACT_STIFFNESS, 0.02, 0.1, "(c) complete contact", "top"),
    ):
        x_of_y = 4 * stiffness / _length(shown)
        axes.plot([x_of_y * low, x_of_y * top], [low, top], color=GREY, linestyle=":", linewidth=0.8)
        y = low * (top / low) ** start
        text_along(axes, x_of_y * y, y, text, color=GREY, va=side)
    bar = {"linewidth": 2.5, "solid_capstyle": "butt", "transform": axes.get_xaxis_transform()}
    for rank, (hurst, look) in enumerate(reversed(looks.items())):
        for row in fits(table, shown, source="discs", case_group="base", hurst=hurst).itertuples():
            axes.plot([4 * row.x_low, 4 * row.x_high], [0.03 + 0.025 * rank] * 2, color=look["color"], **bar)
    axes.text(0.97, 0.025, "bars: region (b)", color=GREY, transform=axes.transAxes, ha="right")
    axes.set(xlim=(left, right), ylim=(bottom, top))


@rc_context(STYLE)
def plot_master_curve(discs, lines, table, shown):
    """vt/h over the right side of Eq. 12 with its Γ, and below the ratio of the two.

    discs, lines : ensemble datasets, one for each Hurst exponent; lines have the rms height of the discs (Eq. 13)
    table, shown : scaling table, which has region (b), and conventions

    Symbols, about eight a decade of X, are filled in region (b); bars are two standard errors to either side.
    Region (a) is left out. The lower panel is cut to what region (b) needs.
    """
    looks = hurst_looks(ds["hurst"].item() for ds in discs)
    figure = Figure(figsize=(NARROW, 150 * MM))
    both = law, ratio = figure.subplots(2, 1, sharex=True, height_ratios=(1.6, 1))
    for axes in both:
        axes.set(xscale="log", yscale="log")
    ratios = [0.5, 2]
    for ds in discs:
        hurst, curve = ds["hurst"].item(), _mean_curve(ds, shown)
        look = looks[hurst] | {"linestyle": "", "markersize": 3.5, "capsize": 0, "elinewidth": 0.8}
        right = reference.rate_law(curve.x, hurst, gamma=True)
        step = max(1, np.searchsorted(curve.x, 10 * curve.x[0]) // 8)
        thinned = curve.several & (np.arange(curve.x.size) % step == 0)
        inside = np.zeros(curve.x.size, dtype=bool)
        for fit in fits(table, shown, source="discs", case_group="base", hurst=hurst).itertuples():
            inside = (curve.x >= fit.x_low * (1 - 1e-9)) & (curve.x <= fit.x_high * (1 + 1e-9))
        for axes, left in ((law, curve.velocity), (ratio, curve.velocity / right)):
            error = left * (1 - np.exp(-curve.error)), left * (np.exp(curve.error) - 1)
            for part, face in ((thinned & inside, look["color"]), (thinned & ~inside, "white")):
                bars = [side[part] for side in error]
                axes.errorbar(right[part], left[part], bars, markerfacecolor=face, markeredgewidth=0.7, **look)
        ratios += (curve.velocity / right)[thinned & inside].tolist()
    for ds in lines:
        hurst, curve = ds["hurst"].item(), _mean_curve(ds, shown)
        right = reference.rate_law(curve.x, hurst, gamma=True)
        for axes, left in ((law, curve.velocity), (ratio, curve.velocity / right)):
            axes.plot(right[curve.several], left[curve.several], color=looks[hurst]["color"], zorder=3)
    ends = law.get_xlim()
    law.plot(ends, ends, "--", color="black")
    ratio.axhline(1, linestyle="--", color="black")
    law.set(xlim=ends, ylabel="$vt/h$")
    xlabel = r"$(Ft/4\eta hL)^{H/(1+H)} \,/\, [(2-H)\,\Gamma(\frac{1+2H}{1+H})]$"
    ratio.set(xlabel=xlabel, ylabel="$vt/h$ over Eq. 12", ylim=(min(ratios) / 1.3, max(ratios) * 1.3))
    logarithmic_ticks(*both)
    ratio.yaxis.set(major_locator=FixedLocator([0.1, 0.2, 0.5, 1, 2, 5, 10]), major_formatter="{x:g}")
    symbol = {"color": GREY, "linestyle": "", "marker": "o"}
    handles = [
        *hurst_handles(looks, linestyle="-"),
        Line2D([], [], **symbol, label="discs, in region (b)"),
        Line2D([], [], **symbol, label="discs, elsewhere", markerfacecolor="white"),
        Line2D([], [], color=GREY, label=r"lines, $C_{1D}=\pi q C_{2D}$"),
        Line2D([], [], color="black", linestyle="--", label="Eq. 12"),
    ]
    law.legend(handles=handles, loc="upper left")
    return figure


@rc_context(STYLE)
def plot_exponent(table, shown):
    """β over the Hurst exponent, with 95 % intervals: lines, discs and Eq. 10."""
    looks = hurst_looks(table.loc[table["source"] == "discs", "hurst"])
    figure = Figure(figsize=(NARROW, 85 * MM))
    axes = figure.subplots()
    axes.axvspan(0.4, 1, color="0.94", linewidth=0)
    axes.text(0.98, 0.04, "where the paper finds Eq. 10 accurate", color=GREY, ha="right", transform=axes.transAxes)
    lines = fits(table, shown, source="lines", case_group="base", rms_convention="line")
    band = axes.fill_between(lines["hurst"], lines["beta_low"], lines["beta_high"], color=PALE, linewidth=0)
    (solid,) = axes.plot(lines["hurst"], lines["beta"], color="black")
    discs = fits(table, shown, source="discs", case_group="base")[["hurst", "beta", "beta_low", "beta_high"]]
    marks = [mark(axes, h, beta, interval, looks[h]) for h, beta, *interval in discs.itertuples(index=False)]
    hurst = np.linspace(0, 1, 101)
    (law,) = axes.plot(hurst, reference.exponent_beta(hurst), "--", color=GREY)
    legend = {"lines, reduction of dimensionality": (band, solid), "$H/(1+H)$, Eq. 10": law}
    side_by_side = {}
    if marks:
        legend["discs, boundary elements"] = some = tuple(marks[:5])
        side_by_side[some] = HandlerTuple(ndivide=None, pad=0.3)
    above = {"loc": "outside upper center", "ncols": 2, "handlelength": 3.5}
    figure.legend(legend.values(), legend.keys(), handler_map=side_by_side, **above)
    axes.set(xlim=(-0.02, 1.02), xlabel="Hurst exponent $H$", ylabel=r"exponent $\beta$")
    axes.set_ylim(bottom=min(0, axes.get_ylim()[0]))
    return figure


# ---- from the data to what is drawn


@dataclass(frozen=True)
class MeanCurve:
    """Mean over the realizations under the conventions shown, arrays of shape (abscissae,).

    x : X; velocity : vt/h, nan where so few realizations are defined that their mean would be biased
    error : two standard errors of ln(vt/h)
    several : whether there is a mean and more than one element is in contact, beyond region (a)
    """

    x: np.ndarray
    velocity: np.ndarray
    error: np.ndarray
    several: np.ndarray


def _mean_curve(ensemble, shown):
    conventions = ensemble["rms_convention"].values.tolist()
    one = ensemble.sel(rms_convention=shown["rms_convention"] if len(conventions) > 1 else conventions[0])
    defined = one["fraction_defined"].values >= FRACTION_MIN
    return MeanCurve(
        one["x"].values / _length(shown),
        np.where(defined, one[f"velocity_{shown['average']}"].values, np.nan),
        2 * one["velocity_spread"].values / np.sqrt(np.maximum(one["realizations_defined"].values, 1)),
        defined & (one["contact_count_median"].values > 1),
    )


def _length(shown):
    """L over the diameter."""
    return 0.5 if shown["diameter_convention"] == "radius" else 1.0


def _elements_across(elements):
    """Elements across a disc of as many elements, which are those in the circle through the outermost centres."""
    return round(1 + 2 * np.sqrt(elements / np.pi))
