"""Draw the model of a rough interface and a flat punch in series: g against X, and u₀/h against H.

In this model vt/h = X/κ_c + g(X), where κ_c is the stiffness of the punch, and g is the part of the interface. u₀/h is
the value of g on its plateau (fits.interface).
"""

import numpy as np

from viscorough.law.calibrated_law import interface_calibration, penetration_law
from viscorough_study.comparisons.literature import cited
from viscorough_study.figures import style

SHIFT = 0.012  # distance in H between the markers of discs and of lines at the same Hurst exponent
X_SHOWN = (1e-4, 30.0)
COLORS = {"discs": style.BLUE, "lines": style.VERMILION}
LAW = {"color": style.PALE, "linewidth": 5, "solid_capstyle": "butt", "zorder": 0}
PERIODIC = {"linestyle": "", "markersize": 3, "color": style.BLACK}


@style.figure
def plot_interface(table, curves, literature, periodic):
    """Draw g against X, with a panel for each Hurst exponent, and u₀/h against the Hurst exponent.

    g is the contribution of the rough interface to vt/h (fits.interface). u₀/h is the value of g on its plateau. All
    means are arithmetic, because compliances add. The law of the library is drawn below the curves, only for the
    Hurst exponents of its calibration.

    table : table "interface" of fits.interface; curves : table "interface_curves" of the same module
    literature : table of comparisons.literature, with published u₀/h
    periodic : table of comparisons.periodic_control
    """
    exponents = sorted(table["hurst"].unique())
    labels = {"xlabel": r"$X = Ft/(4\eta hL)$", "ylabel": r"$g = vt/h − X/\kappa_c$"}
    figure, panels = style.new_panels(len(exponents) + 1, 3, height=52, rest=16, **labels)
    for axes, hurst in zip(panels, exponents, strict=False):
        if hurst in interface_calibration()["hurst"]:
            _draw_law(axes, penetration_law(hurst))
        for (source, _), curve in curves[curves["hurst"] == hurst].groupby(["source", "across"]):
            style.draw_band(axes, curve, "interface", COLORS[source], alpha=0.25)
            axes.plot("x", "interface", data=curve, color=COLORS[source])
        rows = periodic[periodic["hurst"] == hurst]
        rolled = rows["roll_off_wavelength"].notna()
        axes.plot("x", "g", "o", data=rows[~rolled], **PERIODIC)
        axes.plot("x", "g", "s", data=rows[rolled], markerfacecolor="white", **PERIODIC)
        discs = table[(table["hurst"] == hurst) & (table["source"] == "discs")]
        number = style.count_text([*discs["realizations"]] or [0])
        axes.set(title=f"$H={hurst:g}$, {number} discs", xscale="log", xlim=X_SHOWN, ylim=(0, 0.6))
    _draw_literature(panels[-1], literature)
    _draw_plateaus(panels[-1], table)
    panels[-1].set(title="plateau of $g$", xlabel="Hurst exponent $H$", ylabel="$u$₀$/h$", ylim=(0.2, 0.7))
    handles = [
        style.handle("discs by boundary elements", color=COLORS["discs"]),
        style.handle("lines (MDR)", color=COLORS["lines"]),
        style.handle("calibrated law", **LAW),
        style.handle("periodic surfaces", marker="o", **PERIODIC),
        style.handle("with roll-off", marker="s", markerfacecolor="white", **PERIODIC),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), columnspacing=1)
    return figure


def _draw_law(axes, law):
    """Draw g of the library's law within its range of X; g is the part of the interface in vt/h."""
    x = np.geomspace(max(law.x_low, X_SHOWN[0]), min(law.x_high, X_SHOWN[1]), 100)
    axes.plot(x, law.velocity(x) - x, **LAW)


def _draw_literature(axes, literature):
    """Draw and label u₀/h of published sources: as a line if u₀/h is independent of H, otherwise as a band."""
    stated = literature[literature["quantity"] == "u0"].dropna(subset=["hurst", "theirs_low"])
    for (source, year), rows in stated.groupby(["source", "year"], sort=False):
        name, hurst, low, high = cited(source, year), rows["hurst"], rows["theirs_low"], rows["theirs_high"]
        look = {"textcoords": "offset points", "color": style.GREY}
        if low.nunique() == 1:
            axes.axhline(low.iloc[0], color=style.GREY, linestyle="--")
            axes.annotate(name, (hurst.iloc[0], low.iloc[0]), (0, -3), **look, va="top")
        else:
            axes.fill_between(hurst, low, high, color=style.PALE, alpha=0.6, linewidth=0)
            axes.annotate(f"{name}, γ of later fits", (hurst.iloc[0], high.iloc[0]), (0, 3), **look)


def _draw_plateaus(axes, table):
    """Draw u₀/h of discs and of lines against H."""
    for row in table.itertuples():
        place = row.hurst + (SHIFT if row.source == "lines" else -SHIFT)
        look = {"color": COLORS[row.source], "marker": "o" if row.source == "discs" else "v", "markerfacecolor": "none"}
        style.mark_with_interval(axes, place, row.u0, (row.u0_low, row.u0_high), look)
