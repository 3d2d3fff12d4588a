"""Interface and flat punch in series: g over X, the law of the library over it, and u₀/h over the Hurst exponent."""

import numpy as np

from viscorough.calibrated_law import ACROSS, LARGEST_DEVIATION, interface_calibration, penetration_law
from viscorough_study.comparisons.literature import cited
from viscorough_study.figures import style

SHIFT = 0.008  # distance in H between markers of grids and methods
X_SHOWN = (1e-4, 30.0)
LEAST_SHARE = 0.01  # of g in vt/h for the ratio of the law to it: vt/h is known to the tolerance of the curves, 0.1 %


@style.figure
def plot_interface(table, curves, literature, periodic):
    """g of discs and of periodic surfaces (a) and of lines (b), g of the law over that of discs (c), u₀/h (d).

    table, curves : of fits.interface; literature : of comparisons.literature, for u₀/h in (d)
    periodic : of comparisons.periodic_control
    All means are arithmetic ones, as springs add. (a) to (c) show each Hurst exponent on the base grid only; the
    law of the library, in (a) and (c), only on its own grid and at its own Hurst exponents.
    """
    figure = style.new_figure(130)
    panels = figure.subplots(2, 2)
    discs, lines = _on_base_grid(table, "discs"), _on_base_grid(table, "lines")
    looks = style.hurst_looks([*table["hurst"], *periodic["hurst"]])
    for axes, rows in zip(panels[0], (discs, lines), strict=True):
        for row in rows.itertuples():
            _draw_interface(axes, row, _curve(curves, row), looks[row.hurst])
    for (hurst, roll_off), rows in periodic.groupby(["hurst", periodic["roll_off_wavelength"].notna()]):
        look = {"color": looks[hurst]["color"], "marker": "s" if roll_off else "o", "linestyle": ""}
        panels[0, 0].plot(rows["x"], rows["g"], **look, markersize=3, markerfacecolor="white" if roll_off else None)
    calibrated = discs["hurst"].isin(interface_calibration()["hurst"]) & (discs["across"] == ACROSS)
    for row in discs[calibrated].itertuples():
        x, law = _law_of(_curve(curves, row), row.hurst)
        panels[0, 0].plot(x, law, color=style.BLACK, linewidth=0.6)
        interface = _curve(curves, row).set_index("x").loc[x, "interface"].to_numpy()
        ratio = np.where(interface >= LEAST_SHARE * x, law / interface, np.nan)
        panels[1, 0].plot(x, ratio, **looks[row.hurst] | {"marker": ""})
    _draw_literature(panels[1, 1], literature)
    _draw_plateaus(panels[1, 1], table, looks)
    _label(panels)
    handles = [
        *style.hurst_handles(style.hurst_looks([*discs["hurst"], *lines["hurst"]]), marker=""),
        style.handle("plateau", color=style.GREY, linewidth=3, alpha=0.4),
        style.handle("law", color=style.BLACK, linewidth=0.6),
        style.handle("periodic", color=style.GREY, marker="o", linestyle=""),
        style.handle("with roll-off", color=style.GREY, marker="s", markerfacecolor="white", linestyle=""),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), columnspacing=1)
    return figure


def _on_base_grid(table, source):
    """Rows of a source on the base grid: the base ensembles, and Hurst exponents that only the grid study has."""
    rows = table[table["source"] == source]
    base = rows[rows["case_group"] != "sizes"]
    further = rows[rows["across"].isin(base["across"]) & ~rows["hurst"].isin(base["hurst"])]
    return rows.loc[sorted([*base.index, *further.index])].sort_values("hurst")


def _curve(curves, row):
    """Curve of one row of the table, within `X_SHOWN`."""
    for name in ("source", "case_group", "hurst", "across"):
        curves = curves[curves[name] == getattr(row, name)]
    return curves[(curves["x"] >= X_SHOWN[0]) & (curves["x"] <= X_SHOWN[1] * 1.01)]


def _law_of(curve, hurst):
    """X of a curve within the range of the law of the library, and its g there."""
    law = penetration_law(hurst)
    x = curve.loc[curve["x"].between(law.x_low, law.x_high), "x"].to_numpy()
    return x, law.velocity(x) - x


def _draw_interface(axes, row, curve, look):
    """Draw g with its interval and plateau."""
    style.draw_band(axes, curve, "interface", look["color"], alpha=0.25)
    axes.plot(curve["x"], curve["interface"], **look | {"marker": ""})
    plateau = curve[(curve["x"] >= row.plateau_low) & (curve["x"] <= row.plateau_high)]
    axes.plot(plateau["x"], plateau["interface"], color=look["color"], linewidth=3, alpha=0.6, solid_capstyle="butt")


def _draw_literature(axes, literature):
    """Draw u₀/h from the literature, labelled directly: as a line where it is independent of H, otherwise as a band."""
    stated = literature[literature["quantity"] == "u0"].dropna(subset=["hurst", "theirs_low"])
    for (source, year), rows in stated.groupby(["source", "year"], sort=False):
        name, hurst, low, high = cited(source, year), rows["hurst"], rows["theirs_low"], rows["theirs_high"]
        look = {"textcoords": "offset points", "color": style.BLUE}
        if low.nunique() == 1:
            axes.axhline(low.iloc[0], color=style.BLUE, linestyle="--")
            axes.annotate(name, (hurst.iloc[0], low.iloc[0]), (0, -3), **look, va="top")
        else:
            axes.fill_between(hurst, low, high, color=style.SKY_BLUE, alpha=0.35, linewidth=0)
            axes.annotate(f"{name}, γ of later fits", (hurst.iloc[0], high.iloc[0]), (0, 3), **look)


def _draw_plateaus(axes, table, looks):
    """Draw u₀/h over H: discs with a marker for each grid, filled on the base grid, and lines as crosses."""
    grids = sorted(table.loc[table["source"] == "discs", "across"].unique())
    markers = dict(zip(grids, style.SERIES_MARKERS, strict=False))
    for row in table.itertuples():
        discs = row.source == "discs"
        if not discs and row.case_group == "sizes":
            continue  # u₀ of lines varies far less with their number of points than with H
        face = looks[row.hurst]["color"] if row.case_group != "sizes" else "white"
        marker = markers[row.across] if discs else "x"
        look = {"color": looks[row.hurst]["color"], "marker": marker, "markerfacecolor": face}
        place = row.hurst + SHIFT * (grids.index(row.across) - len(grids) / 2 if discs else 1 + len(grids) / 2)
        style.mark_with_interval(axes, place, row.u0, (row.u0_low, row.u0_high), look)
    labels = {f"{across} across": marker for across, marker in markers.items()} | {"lines (MDR)": "x"}
    handles = [style.handle(label, color=style.GREY, marker=mark, linestyle="") for label, mark in labels.items()]
    axes.legend(handles=handles, ncols=3, loc="lower center", columnspacing=1)


def _label(panels):
    discs, lines, ratio, plateaus = panels.flat
    for axes in (discs, lines, ratio):
        axes.set(xscale="log", xlabel=r"$X = Ft/(4\eta hL)$", xlim=X_SHOWN)
    for axes, title in ((discs, "(a) boundary elements"), (lines, "(b) MDR")):
        axes.set(title=title, ylabel=r"$g = vt/h − X/\kappa_c$", ylim=(0, 0.6))
    ratio.axhspan(1 - LARGEST_DEVIATION, 1 + LARGEST_DEVIATION, color="0.92", linewidth=0, zorder=0)
    ratio.axhline(1, color=style.BLACK, linewidth=0.6)
    ratio.set(title="(c) the law over boundary elements", ylabel="$g$ of the law over the mean", ylim=(0.8, 1.2))
    style.logarithmic_ticks(discs, lines, ratio)
    plateaus.set(title="(d) plateau of $g$", xlabel="Hurst exponent $H$", ylabel="$u$₀$/h$", ylim=(0.2, 0.7))
