"""Draw the model of a rough interface and a flat punch in series: g against X, and u₀/h against H.

In this model vt/h = X/κ_c + g(X), where κ_c is the stiffness of the punch, and g is the part of the interface. u₀/h is
the value of g on its plateau (fits.interface).
"""

import numpy as np

from viscorough.law.calibrated_law import ACROSS, LARGEST_DEVIATION, interface_calibration, penetration_law
from viscorough_study.comparisons.literature import cited
from viscorough_study.figures import style

SHIFT = 0.012  # distance in H between the markers of different grids or methods at the same Hurst exponent
X_SHOWN = (1e-4, 30.0)
# Panel (c) omits g below this share of X, the punch's part of vt/h. Such a small g has a large error, because vt/h is
# known only to 0.1 %.
LEAST_SHARE = 0.01
LABELS = ["source", "hurst", "across"]  # columns that identify an ensemble


@style.figure
def plot_interface(table, curves, literature, periodic):
    """Draw g of discs and periodic surfaces (a), g of lines (b), g of the law divided by g of discs (c), and u₀/h (d).

    g is the contribution of the rough interface to vt/h (fits.interface). u₀/h is the value of g on its plateau. All
    means are arithmetic, because compliances add. The law of the library is drawn in (a) and (c), but only for the grid
    and the Hurst exponents of its calibration.

    table : table "interface" of fits.interface; curves : table "interface_curves" of the same module
    literature : table of comparisons.literature, with published u₀/h for (d)
    periodic : table of comparisons.periodic_control
    """
    shown = curves.merge(table[[*LABELS, "plateau_low", "plateau_high"]], on=LABELS)
    shown = shown[shown["x"].between(X_SHOWN[0], 1.01 * X_SHOWN[1])]
    looks = style.hurst_looks([*table["hurst"], *periodic["hurst"]])
    figure, ((discs, lines), (ratio, plateaus)) = style.new_subplots(130, 2, 2)
    for (source, hurst, across), curve in shown.groupby(["source", "hurst", "across"]):
        axes, look = discs if source == "discs" else lines, looks[hurst] | {"marker": ""}
        style.draw_band(axes, curve, "interface", look["color"], alpha=0.25)
        axes.plot("x", "interface", data=curve, **look)
        plateau = curve[curve["x"].between(curve["plateau_low"], curve["plateau_high"])]
        thick = {"color": look["color"], "linewidth": 3, "alpha": 0.6, "solid_capstyle": "butt"}
        axes.plot("x", "interface", data=plateau, **thick)
        if source == "discs" and across == ACROSS and hurst in interface_calibration()["hurst"]:
            _draw_law(discs, ratio, curve, penetration_law(hurst), look)
    for (hurst, roll_off), rows in periodic.groupby(["hurst", periodic["roll_off_wavelength"].notna()]):
        look = {"color": looks[hurst]["color"], "marker": "s" if roll_off else "o", "linestyle": ""}
        discs.plot(rows["x"], rows["g"], **look, markersize=3, markerfacecolor="white" if roll_off else None)
    for axes in (discs, lines, ratio):
        axes.set(xscale="log", xlabel=r"$X = Ft/(4\eta hL)$", xlim=X_SHOWN)
    for axes, title in ((discs, "(a) boundary elements"), (lines, "(b) MDR")):
        axes.set(title=title, ylabel=r"$g = vt/h − X/\kappa_c$", ylim=(0, 0.6))
    ratio.axhspan(1 - LARGEST_DEVIATION, 1 + LARGEST_DEVIATION, color="0.92", linewidth=0, zorder=0)
    ratio.axhline(1, color=style.BLACK, linewidth=0.6)
    ratio.set(title="(c) the law over boundary elements", ylabel="$g$ of the law over the mean", ylim=(0.7, 1.3))
    _name_discs(ratio, table[table["source"] == "discs"])
    _draw_literature(plateaus, literature)
    _draw_plateaus(plateaus, table, looks)
    plateaus.set(title="(d) plateau of $g$", xlabel="Hurst exponent $H$", ylabel="$u$₀$/h$", ylim=(0.2, 0.7))
    handles = [
        *style.hurst_handles(style.hurst_looks(shown["hurst"]), marker=""),
        style.handle("plateau", color=style.GREY, linewidth=3, alpha=0.4),
        style.handle("law", color=style.BLACK, linewidth=0.6),
        style.handle("periodic", color=style.GREY, marker="o", linestyle=""),
        style.handle("with roll-off", color=style.GREY, marker="s", markerfacecolor="white", linestyle=""),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), columnspacing=1)
    return figure


def _draw_law(axes, ratios, curve, law, look):
    """Draw g of the library's law within its range of X, and the ratio of this g to the g of computed discs.

    g is the part of the interface in vt/h. The band around the ratio follows from the interval of the computed g.
    axes : axes for g; ratios : axes for the ratio; curve : computed g
    """
    curve = curve[curve["x"].between(law.x_low, law.x_high)]
    law_part = law.velocity(curve["x"].to_numpy()) - curve["x"]
    axes.plot(curve["x"], law_part, color=style.BLACK, linewidth=0.6)
    is_large = curve["interface"] >= LEAST_SHARE * curve["x"]
    ratios.plot(curve["x"], (law_part / curve["interface"]).where(is_large), **look)
    ends = [(law_part / curve[f"interface_{end}"]).where(is_large) for end in ("high", "low")]
    ratios.fill_between(curve["x"], *ends, color=look["color"], alpha=0.15, linewidth=0)


def _name_discs(axes, table):
    """List in a legend how many discs were averaged for each Hurst exponent that is compared with the law."""
    shown = table[(table["across"] == ACROSS) & table["hurst"].isin(interface_calibration()["hurst"])]
    hurst_by_number = shown.sort_values("hurst").groupby("realizations", sort=False)["hurst"]
    labels = [f"{number:g} discs: $H$ = {', '.join(f'{h:g}' for h in hurst)}" for number, hurst in hurst_by_number]
    handles = [style.handle(label, linestyle="") for label in labels]
    axes.legend(handles=handles, loc="lower left", handlelength=0, handletextpad=0)


def _draw_literature(axes, literature):
    """Draw and label u₀/h of published sources: as a line if u₀/h is independent of H, otherwise as a band."""
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
    """Draw u₀/h of discs and of lines against H.

    u₀/h is the value of g on its plateau, where g is the part of the interface in vt/h.
    """
    names = np.where(table["source"] == "discs", table["across"].astype(str) + " across", "lines (MDR)")
    table = table.assign(name=names).sort_values("across")
    markers = dict(zip(table["name"].unique(), style.SERIES_MARKERS, strict=False))
    for rank, (name, rows) in enumerate(table.groupby("name", sort=False)):
        for row in rows.itertuples():
            place = row.hurst + SHIFT * (rank - len(markers) / 2)
            look = {"color": looks[row.hurst]["color"], "marker": markers[name], "markerfacecolor": "none"}
            style.mark_with_interval(axes, place, row.u0, (row.u0_low, row.u0_high), look)
    handles = [style.handle(name, color=style.GREY, marker=mark, linestyle="") for name, mark in markers.items()]
    axes.legend(handles=handles, ncols=3, loc="lower center", columnspacing=1)
