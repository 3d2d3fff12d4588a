"""Effect on exponent and prefactor of the conventions that the paper leaves open."""

import numpy as np
from matplotlib.ticker import MaxNLocator, NullLocator

from viscorough import reference
from viscorough_study.figures import style
from viscorough_study.fits.conventions import fits

# Labels of the conventions that the paper leaves open, {column of the scaling table: {value: label}}.
CONVENTION_LABELS = {
    "average": {"arithmetic": "arithmetic mean", "geometric": "geometric mean"},
    "rms_convention": {
        "disc": "$h$ of the disc",
        "square": "$h$ of the square",
        "peak": "$h$ of the highest peak",
        "ensemble": "$h$ of the ensemble",
    },
    "window_rule": {
        "default": "whole window",
        "lower_half": "lower half of window",
        "upper_half": "upper half of window",
        "kappa": "window of given κ",
    },
    "gamma": {"without": "law without Γ", "with": "law with Γ (Eq. 9)"},
}
VARIANTS = {
    "longer_period": "longer period",
    "corners": "corners of spectrum",
    "fixed_amplitudes": "fixed amplitudes",
    "longer_period_corners": "longer period, corners",
    "longer_period_fixed": "longer period, fixed amplitudes",
    "corners_fixed": "corners, fixed amplitudes",
    "longer_period_corners_fixed": "all three of these",
    "roll_off": "roll-off (control)",
}


@style.figure
def plot_conventions(scaling, conventions):
    """β and ζ of the discs, with 95 % intervals, as one convention or the surfaces change; four values of H per row.

    scaling : scaling table; conventions : {column of it: value}, of which one is changed at a time
    All β axes span the same length, all ζ axes the same ratio.
    """
    discs = scaling[scaling["source"] == "discs"]
    exponents = sorted(discs["hurst"].unique())
    changes = _changes(discs, conventions)
    betas, zetas, figure = _panels(len(exponents), len(changes))
    looks = style.hurst_looks(exponents)
    dashed, dotted = ({"color": style.GREY, "linestyle": line} for line in ("--", ":"))
    for hurst, beta, zeta in zip(exponents, betas, zetas, strict=True):
        _draw_changes(beta, "beta", discs[discs["hurst"] == hurst], changes, looks[hurst])
        _draw_changes(zeta, "zeta", discs[discs["hurst"] == hurst], changes, looks[hurst])
        beta.axvline(reference.exponent_beta(hurst), **dashed, zorder=1)
        zeta.axvline(reference.zeta_viscous(hurst), **dashed, zorder=1)
        zeta.axvline(reference.zeta_elastic(hurst), **dotted, zorder=1)
        beta.set(title=f"$H={hurst:g}$", xlabel=r"exponent $\beta$")
        zeta.set(xlabel=r"prefactor $\zeta$", xscale="log")
    beta.set(yticks=range(len(changes)), yticklabels=[label for label, _ in changes], ylim=(len(changes) - 0.4, -0.6))
    beta.yaxis.set_minor_locator(NullLocator())
    _same_length(betas)
    _same_length(zetas)
    changed = discs["case_group"] != "base"
    numbers = [f"{style.count_text(discs.loc[~changed, 'realizations'])} discs for each $H$"]
    numbers += [f"{style.count_text(discs.loc[changed, 'realizations'])} of changed surfaces"] if changed.any() else []
    handles = [
        style.handle("$H/(1+H)$, Eq. 10; $2-H$, Eq. 11 (with Γ)", **dashed),
        style.handle(r"$\pi(3-H)/10$, Eq. 4", **dotted),
        style.handle(", ".join(numbers), linestyle=""),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure


def _panels(exponents, changes):
    """Panels of β and of ζ, one for each Hurst exponent, four per row, and the figure."""
    columns = min(4, exponents)
    blocks = -(-exponents // columns)
    figure = style.new_figure(2 * blocks * (13 + 4.2 * changes) + 10)
    grid = figure.subplots(2 * blocks, columns, squeeze=False, sharey=True)
    for axes in grid[-2:, exponents - columns * (blocks - 1) :].flat:
        axes.remove()
    betas, zetas = (list(grid[first::2].flat)[:exponents] for first in (0, 1))
    return betas, zetas, figure


def _changes(discs, conventions):
    """Rows of the figure, (label, {column: value}): the conventions of the other figures, then one change per row."""
    base = conventions | {"case_group": "base"}
    rows = [("as in other figures", base)]
    for column, labels in CONVENTION_LABELS.items():
        available = set(discs[column]) if column in discs else set(labels)  # readings of the law follow from a fit
        others = [value for value in labels if value != conventions[column] and value in available]
        rows += [(labels[value], base | {column: value}) for value in others]
    groups = [name for name in discs["case_group"].unique() if name != "base"]
    return rows + [(VARIANTS.get(name, name.replace("_", " ")), conventions | {"case_group": name}) for name in groups]


def _draw_changes(axes, quantity, discs, changes, look):
    """Draw one quantity under every change, one per row, over a band that is the interval of the first row."""
    for y, (_, wanted) in enumerate(changes):
        face = look["color"] if y == 0 else "white"
        rows = fits(discs, wanted)
        for value, low, high in rows[[quantity, f"{quantity}_low", f"{quantity}_high"]].itertuples(index=False):
            style.mark_with_interval(axes, value, y, (low, high), look | {"markerfacecolor": face}, along="x")
            if y == 0 and low < high:
                axes.axvspan(low, high, color="0.93", linewidth=0, zorder=0)
        if rows.empty:
            words = {"fontsize": 8, "color": style.GREY, "backgroundcolor": "white", "ha": "center", "va": "center"}
            axes.text(0.5, y, "no region (b)", transform=axes.get_yaxis_transform(), **words)


def _same_length(panels):
    """Give the x axes of all panels the same length around their centres, and ticks for that length."""
    logarithmic = panels[0].get_xscale() == "log"
    limits = np.array([axes.get_xlim() for axes in panels])
    limits = np.log10(limits) if logarithmic else limits
    half = np.ptp(limits, axis=1).max() / 2
    for axes, middle in zip(panels, limits.mean(axis=1), strict=True):
        ends = np.array([middle - half, middle + half])
        axes.set_xlim(10**ends if logarithmic else ends)
        if logarithmic:
            style.plain_ticks(axes.xaxis, [0.1, 0.2, 0.5, 1, 2, 5, 10])
        else:
            axes.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
