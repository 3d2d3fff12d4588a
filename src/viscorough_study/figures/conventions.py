"""Draw how the exponent β and the prefactor ζ depend on the conventions that the paper leaves open."""

import numpy as np

from viscorough import reference
from viscorough_study.figures import style
from viscorough_study.fits.conventions import fits

# Labels of choices that the paper leaves open (conventions), as {column of the table of fits: {value: label}}.
CONVENTION_LABELS = {
    "average": {"arithmetic": "arithmetic mean", "geometric": "geometric mean"},
    "rms_convention": {
        "disc": "$h$ of the disc",
        "square": "$h$ of the square",
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


@style.figure
def plot_conventions(scaling, conventions):
    """Draw β − H/(1 + H) and ζ/(2 − H) of the discs for several conventions, each with its 95 % interval.

    β is fitted freely. ζ is fitted with the exponent H/(1 + H), to which Eqs. 4 and 11 belong, and is drawn where this
    law describes the curve (`style.DEFINED`).

    The conventions are choices that the paper leaves open, such as the kind of mean. The first row of the figure has
    the conventions of all other figures. Each further row changes one convention, or shows another group of discs.
    scaling : table of fitted power laws
    conventions : conventions of all other figures, {column of this table: value}
    """
    discs = scaling[scaling["source"] == "discs"]
    looks, changes = style.hurst_looks(discs["hurst"]), _changes(discs, conventions)
    figure, (betas, zetas) = style.new_subplots(7 * len(changes) + 28, 1, 2, sharey=True)
    heights = np.linspace(-0.27, 0.27, len(looks))  # offset of each Hurst exponent from the middle of a row
    for (hurst, look), height in zip(looks.items(), heights, strict=True):
        beta, zeta = reference.exponent_beta(hurst), reference.zeta_viscous(hurst)
        zetas.axvline(reference.zeta_elastic(hurst) / zeta, color=look["color"], linestyle=":", zorder=1)
        for y, (_, changed) in enumerate(changes):
            for row in fits(discs, changed, hurst=hurst).itertuples():
                interval = row.beta_low - beta, row.beta_high - beta
                style.mark_with_interval(betas, row.beta - beta, y + height, interval, look, along="x")
                if row.residual_fixed <= style.DEFINED:
                    interval = row.zeta_fixed_low / zeta, row.zeta_fixed_high / zeta
                    style.mark_with_interval(zetas, row.zeta_fixed / zeta, y + height, interval, look, along="x")
    for axes, law in ((betas, 0), (zetas, 1)):
        axes.axvline(law, color=style.GREY, linestyle="--", zorder=1)
        for y in range(0, len(changes), 2):
            axes.axhspan(y - 0.5, y + 0.5, color="0.95", linewidth=0, zorder=0)
    betas.set(yticks=range(len(changes)), yticklabels=[label for label, _ in changes], ylim=(len(changes) - 0.5, -0.5))
    betas.set_xlabel(r"exponent $\beta$ less $H/(1+H)$")
    zetas.set(xlabel=r"prefactor $\zeta$ over $2−H$", xscale="log")
    counts = discs.groupby(discs["case_group"] != "base")["realizations"]
    numbers = [f"{style.count_text(group)} discs" for _, group in counts]
    handles = [
        *style.hurst_handles(looks, linestyle=""),
        style.handle("Eq. 10; Eq. 11 (with Γ)", color=style.GREY, linestyle="--"),
        style.handle("Eq. 4", color=style.GREY, linestyle=":"),
    ]
    title = " for each $H$, and ".join(numbers[:2]) + " of changed surfaces" * (len(numbers) > 1)
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), title=title)
    return figure


def _changes(discs, conventions):
    """Return a label and the values {column of the table: value} that select the fits, for each row of the figure.

    The first row has the conventions of all other figures. Each further row changes one convention, such as the kind of
    mean, or the group of discs.
    """
    base = conventions | {"case_group": "base"}
    rows = [("as in other figures", base)]
    for column, labels in CONVENTION_LABELS.items():
        # The table has no column for the convention "gamma", since every fit can be converted to both its values.
        available = set(discs[column]) if column in discs else set(labels)
        others = [value for value in labels if value != conventions[column] and value in available]
        rows += [(labels[value], base | {column: value}) for value in others]
    groups = [name for name in discs["case_group"].unique() if name != "base"]
    return rows + [(name.replace("_", " "), conventions | {"case_group": name}) for name in groups]
