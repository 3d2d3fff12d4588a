"""Draw Figure 3 of the paper: the master curve, Eq. 12, and its ratio to the discs in both readings of the surfaces."""

import numpy as np

from viscorough import reference
from viscorough_study.ensembles.mean_curve import mean_curve
from viscorough_study.figures import style
from viscorough_study.fits.conventions import READINGS, fits

TITLES = {
    "A": "(b) reading A: period $L$,\n$h$ of the disc",
    "B": "(c) reading B: cut from a longer\nperiod, $h$ of the square",
}
X_SHOWN = (1e-4, 1.0)
RATIOS = (0.5, 0.7, 1.0, 1.4, 2.0)  # ticks of the ratio; the axis extends a little beyond them
THIN, BOLD = {"linewidth": 0.6, "alpha": 0.7}, {"linewidth": 2.0, "solid_capstyle": "butt"}


@style.figure
def plot_master_curve(discs, longer_period, lines, scaling, conventions, *, fraction_min):
    """Draw vt/h against the right side of Eq. 12 (a), and vt/h divided by it over X in both readings (b, c).

    The right side contains the factor Γ.

    discs, longer_period : ensemble datasets of the discs of readings A and B (fits.conventions.READINGS), one for each
        Hurst exponent
    lines : ensemble datasets of the MDR lines, which have the rms height of the discs of reading A (Eq. 13); only lines
        with a Hurst exponent of these discs are drawn
    scaling : table of fitted power laws, with the ends of region (b); conventions : {column of this table: value}
    fraction_min : a mean is drawn if at least this fraction of the realizations has a value

    Means over discs are bold in region (b), with a band of two standard errors to either side in (b, c). Region (a) is
    omitted. A dotted line in (b) is the constant that fits best where the prefactor of Eq. 12 is defined.
    """
    looks = style.hurst_looks(ds["hurst"].item() for ds in [*discs, *longer_period])
    figure, (law, *ratios) = style.new_subplots(84, 1, 3, width_ratios=(1.1, 1.4, 1.4))
    for axes in (law, *ratios):
        axes.set(xscale="log", yscale="log")
    for ds in (ds for ds in lines if ds["hurst"].item() in looks):
        curve = mean_curve(ds, conventions, fraction_min)
        right_side = reference.rate_law(curve.x, ds["hurst"].item(), gamma=True)
        law.plot(right_side[curve.several], curve.velocity[curve.several], color="black", linestyle=":", linewidth=0.7)
    for reading, axes, members in zip(READINGS, ratios, (discs, longer_period), strict=True):
        chosen = conventions | READINGS[reading]
        for ds in members:
            hurst = ds["hurst"].item()
            windows = fits(scaling, chosen, source="discs", hurst=hurst)
            curve, look = mean_curve(ds, chosen, fraction_min), {"color": looks[hurst]["color"]}
            _draw_ratio(axes, curve, hurst, windows, look, above=hurst == max(looks))
            if reading == "A":
                _draw_law(law, curve, hurst, windows, look)
        axes.axhline(1, linestyle="--", color="black", linewidth=0.8, zorder=1)
        axes.set(xlim=X_SHOWN, xlabel="$X = F/(4GhL) = Ft/(4\\eta hL)$", ylim=(RATIOS[0] / 1.1, RATIOS[-1] * 1.1))
        axes.set_yticks(RATIOS, [f"{ratio:g}" for ratio in RATIOS])
        axes.set_title(
            f"{TITLES[reading]}; {style.count_text([ds.sizes['realization'] for ds in members] or [0])} discs"
        )
    ratios[0].set_ylabel("$vt/h$ over Eq. 12")
    if np.isfinite(constant := _constant(scaling, conventions)):
        ratios[0].axhline(constant, color=style.GREY, linestyle=":", zorder=1)
        place = (X_SHOWN[1], constant)
        ratios[0].annotate(f"{constant:.2f}", place, (2, 0), textcoords="offset points", va="center", color=style.GREY)
    ends = np.array(law.get_xlim())
    law.plot(ends, ends, "--", color="black", linewidth=0.8)
    law.set(xlim=ends, ylim=ends, xlabel="right side of Eq. 12", ylabel="$vt/h$", title="(a) master curve,\nreading A")
    handles = [
        style.handle("discs, with their $H$: bold in region (b), thin elsewhere", color=style.GREY, linewidth=2),
        style.handle("lines (MDR)", color="black", linestyle=":"),
        style.handle("Eq. 12", color="black", linestyle="--"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def _constant(scaling, conventions):
    """Return the constant by which Eq. 12 describes reading A best in region (b); nan if there is none.

    Hurst exponents count if a law with the exponent H/(1 + H) describes their curves, so that its prefactor is defined.
    """
    discs = fits(scaling, conventions | READINGS["A"] | {"gamma": "with"}, source="discs")
    discs = discs[discs["residual_fixed"] <= style.DEFINED]
    return np.exp(np.log(reference.zeta_viscous(discs["hurst"]) / discs["zeta_fixed"]).mean())


def _parts(curve, windows):
    """Return masks of the abscissae that are drawn: all beyond region (a), and those in region (b).

    windows : table of the fits, with the ends x_low and x_high of region (b), or without a row
    """
    inside = np.zeros(curve.x.size, dtype=bool)
    for window in windows.itertuples():
        inside = (curve.x >= window.x_low * (1 - 1e-6)) & (curve.x <= window.x_high * (1 + 1e-6))
    return curve.several, curve.several & inside


def _draw_law(axes, curve, hurst, windows, look):
    """Draw vt/h against the right side of Eq. 12."""
    right_side = reference.rate_law(curve.x, hurst, gamma=True)
    for part, width in zip(_parts(curve, windows), (THIN, BOLD), strict=True):
        axes.plot(right_side[part], curve.velocity[part], **look, **width)


def _draw_ratio(axes, curve, hurst, windows, look, above):
    """Draw vt/h divided by Eq. 12 over X, and write H above or below the left end of region (b)."""
    ratio = curve.velocity / reference.rate_law(curve.x, hurst, gamma=True)
    for part, width in zip(_parts(curve, windows), (THIN, BOLD), strict=True):
        axes.plot(curve.x[part], ratio[part], **look, **width)
    band = [ratio * np.exp(sign * curve.error) for sign in (-1, 1)]
    axes.fill_between(curve.x, *(np.where(part, end, np.nan) for end in band), **look, alpha=0.25, linewidth=0)
    if part.any():
        first = np.flatnonzero(part)[0]
        where, align = ((0, 4), "bottom") if above else ((1, -4), "top")
        axes.annotate(
            f"{hurst:g}",
            (curve.x[first], ratio[first]),
            where,
            textcoords="offset points",
            va=align,
            **look,
            **style.HALO,
        )
