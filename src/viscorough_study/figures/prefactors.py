"""The prefactor ζ over the paper's two laws for it, under every combination of conventions."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from viscorough_study import prefactors
from viscorough_study.figures.labels import CONVENTION_LABELS
from viscorough_study.figures.style import BLUE, MM, PALE, STYLE, VERMILION, WIDE, plain_ticks, require_rows


@rc_context(STYLE)
def plot_prefactors(table, conventions):
    """ζ over each of the paper's two laws for it, over H, under every combination of conventions.

    table : of viscorough_study.prefactors; conventions : those of the other figures, {column: value}
    Raises ValueError for a table without rows.
    """
    require_rows("plot_prefactors", table)
    figure = Figure(figsize=(WIDE, 115 * MM))
    panels = figure.subplots(1, 2, sharey=True)
    laws = {"eq4": r"$\zeta\;/\;[\pi(3-H)/10]$, Eq. 4", "eq11": r"$\zeta\;/\;(2-H)$, Eq. 11"}
    for axes, (law, label) in zip(panels, laws.items(), strict=True):
        for combination in prefactors.combinations(table):
            rows = prefactors.rows_of(table, combination)
            axes.plot(rows["hurst"], rows[law], color=PALE, linewidth=0.5, zorder=1)
        axes.axhline(1, color="black", linewidth=0.8, linestyle="--", zorder=2)
        marked = {"as in other figures": (conventions | {"factor": 1}, BLUE, "o")}
        if (nearest := prefactors.nearest(table, law)) is not None:
            marked[_in_words(nearest)] = (nearest, VERMILION, "s")
        for name, (combination, color, marker) in marked.items():
            rows = prefactors.rows_of(table, combination)
            scale = rows[law] / rows["zeta"]
            ends = np.abs([rows["zeta_low"] * scale - rows[law], rows["zeta_high"] * scale - rows[law]])
            axes.errorbar(rows["hurst"], rows[law], ends, color=color, marker=marker, label=name, zorder=3)
        axes.plot([], [], color=PALE, label="every other combination")
        axes.set(title=label, xlabel="Hurst exponent $H$ [1]", yscale="log", xlim=(0, 1))
        plain_ticks(axes.yaxis, [0.2, 0.5, 1, 2, 5])
        axes.legend(loc="upper left", bbox_to_anchor=(-0.05, -0.14), fontsize=7)
    panels[0].set_ylabel(r"$\zeta$ over the law [1]")
    return figure


def _in_words(combination):
    """Legend entry of the nearest combination of conventions, two of them in a line."""
    words = [CONVENTION_LABELS[name][value] for name, value in combination.items() if name != "factor"]
    words += [] if combination["factor"] == 1 else [f"factor {combination['factor']:g} in $F$ or $1/G$"]
    lines = [", ".join(words[start : start + 2]) for start in range(0, len(words), 2)]
    return "nearest: " + ",\n".join(lines)
