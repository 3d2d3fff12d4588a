"""The interface and the punch in series: g over X, the law over all X, and u₀/h over the Hurst exponent."""

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscorough.calibrated_law import LARGEST_DEVIATION
from viscorough_study.figures.style import (
    BLACK,
    BLUE,
    GREY,
    MM,
    SERIES_MARKERS,
    SKY_BLUE,
    SMALL,
    STYLE,
    WIDE,
    hurst_handles,
    hurst_looks,
    logarithmic_ticks,
    mark_with_interval,
    require_rows,
)
from viscorough_study.literature import cited

SHIFT = 0.008  # in H, between grids and methods
X_SHOWN = (1e-4, 30.0)
LABEL = {"textcoords": "offset points", "fontsize": SMALL}


@rc_context(STYLE)
def plot_interface(table, curves, literature, conventions):
    """g of discs (a) and lines (b), the law's vt/h over that of discs (c), and u₀/h of every grid and method (d).

    table, curves : of viscorough_study.interface; literature : of viscorough_study.literature, for u₀/h in (d)
    conventions : those of the figures, {column: value}
    Where ensembles on grids from coarse to fine are in the tables, (a) to (c) show those of one more Hurst exponent
    only on the grid of the base. Raises ValueError for a table without rows.
    """
    require_rows("plot_interface", table)
    table, curves = (part[part["average"] == conventions["average"]] for part in (table, curves))
    figure = Figure(figsize=(WIDE, 130 * MM))
    panels = figure.subplots(2, 2)
    discs, lines = _of_base(table, "discs"), _of_base(table, "lines")
    looks = hurst_looks([*table["hurst"]])
    for axes, rows in ((panels[0, 0], discs), (panels[0, 1], lines)):
        for row in rows.itertuples():
            _draw_interface(axes, row, _curve(curves, row), looks[row.hurst])
    for row in discs.itertuples():
        curve = _curve(curves, row)
        look = looks[row.hurst] | {"marker": ""}
        panels[1, 0].plot(curve["x"], curve["law"] / curve["velocity"], **look)
    _draw_literature(panels[1, 1], literature)
    _draw_plateaus(panels[1, 1], table, looks)
    _label(panels)
    marks = [*hurst_handles({h: looks[h] for h in sorted({*discs["hurst"], *lines["hurst"]})}, marker="")]
    marks += [
        Line2D([], [], color=GREY, linewidth=3, alpha=0.4, label="plateau"),
        Line2D([], [], color=BLACK, linewidth=0.6, label="law"),
    ]
    figure.legend(handles=marks, loc="outside lower center", ncols=len(marks), columnspacing=1)
    return figure


def _of_base(table, source):
    """Rows of the base ensembles of discs, or of lines, and of further Hurst exponents on the same grid."""
    rows = table[table["source"] == source]
    base = rows[rows["case_group"] != "sizes"]
    further = rows[rows["across"].isin(base["across"]) & ~rows["hurst"].isin(base["hurst"])]
    return rows.loc[sorted([*base.index, *further.index])].sort_values("hurst")


def _curve(curves, row):
    """The curve of one row of the table."""
    for name in ("source", "case_group", "hurst", "across"):
        curves = curves[curves[name] == getattr(row, name)]
    return curves[(curves["x"] >= X_SHOWN[0]) & (curves["x"] <= X_SHOWN[1] * 1.01)]


def _draw_interface(axes, row, curve, look):
    """g with its interval, its law, and its plateau."""
    axes.fill_between(
        curve["x"], curve["interface_low"], curve["interface_high"], color=look["color"], alpha=0.25, lw=0
    )
    axes.plot(curve["x"], curve["interface"], **look | {"marker": ""})
    if row.source == "discs":
        inside = curve[(curve["x"] >= row.law_low) & (curve["x"] <= row.law_high)]
        axes.plot(inside["x"], inside["law"] - inside["x"] / row.kappa_c, color=BLACK, linewidth=0.6)
    plateau = curve[(curve["x"] >= row.plateau_low) & (curve["x"] <= row.plateau_high)]
    axes.plot(plateau["x"], plateau["interface"], color=look["color"], linewidth=3, alpha=0.6, solid_capstyle="butt")


def _draw_literature(axes, literature):
    """u₀/h of others with direct labels: a line for one that is the same for every H, a band for one that is not."""
    stated = literature[literature["quantity"] == "u0"].dropna(subset=["hurst", "theirs_low"])
    for (source, year), rows in stated.groupby(["source", "year"], sort=False):
        same = rows["theirs_low"].nunique() == 1
        name = f"{cited(source, year)}{'' if same else ', γ of later fits'}"
        low, high = rows["theirs_low"], rows["theirs_high"]
        if same:
            axes.axhline(low.iloc[0], color=BLUE, linestyle="--")
            axes.annotate(name, (rows["hurst"].iloc[0], low.iloc[0]), (0, -3), **LABEL, color=BLUE, va="top")
        else:
            axes.fill_between(rows["hurst"], low, high, color=SKY_BLUE, alpha=0.35, linewidth=0)
            axes.annotate(name, (rows["hurst"].iloc[0], high.iloc[0]), (0, 3), **LABEL, color=BLUE)


def _draw_plateaus(axes, table, looks):
    """u₀/h over H: discs by their grid, hollow except for the base, and lines as crosses."""
    grids = sorted(table.loc[table["source"] == "discs", "across"].unique())
    for row in table.itertuples():
        discs = row.source == "discs"
        if not discs and row.case_group == "sizes":
            continue  # lines depend on their number of points far less than on H
        face = looks[row.hurst]["color"] if row.case_group != "sizes" else "white"
        marker = SERIES_MARKERS[grids.index(row.across) % len(SERIES_MARKERS)] if discs else "x"
        look = {"color": looks[row.hurst]["color"], "marker": marker, "markerfacecolor": face}
        place = row.hurst + SHIFT * (grids.index(row.across) - len(grids) / 2 if discs else 1 + len(grids) / 2)
        mark_with_interval(axes, place, row.u0, (row.u0_low, row.u0_high), look)
    marks = [
        Line2D([], [], color=GREY, marker=SERIES_MARKERS[i % len(SERIES_MARKERS)], linestyle="", label=f"{n} across")
        for i, n in enumerate(grids)
    ]
    marks.append(Line2D([], [], color=GREY, marker="x", linestyle="", label="lines (MDR)"))
    axes.legend(handles=marks, ncols=3, loc="lower center", columnspacing=1)


def _label(panels):
    for axes, title in zip(panels[0], ("(a) boundary elements", "(b) MDR"), strict=True):
        axes.set(xscale="log", title=title, ylim=(0, 0.6), xlim=X_SHOWN)
        axes.set(xlabel=r"$X = Ft/(4\eta hL)$", ylabel=r"$g = vt/h − X/\kappa_c$")
    ratio = panels[1, 0]
    ratio.axhspan(1 - LARGEST_DEVIATION, 1 + LARGEST_DEVIATION, color="0.92", linewidth=0, zorder=0)
    ratio.axhline(1, color=BLACK, linewidth=0.6)
    ratio.set(xscale="log", title="(c) the law over boundary elements", ylim=(0.8, 1.2), xlim=X_SHOWN)
    ratio.set(xlabel=r"$X = Ft/(4\eta hL)$", ylabel="$vt/h$ of the law over the mean")
    logarithmic_ticks(*panels[0], ratio)
    panels[1, 1].set(title="(d) plateau of $g$", xlabel="Hurst exponent $H$", ylabel="$u$₀$/h$", ylim=(0.2, 0.7))
