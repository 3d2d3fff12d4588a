"""Direct integration of the viscous problem in time, against the law with and without the factor 1/Γ(2 − α)."""

from matplotlib import rc_context
from matplotlib.figure import Figure

from viscorough_study.figures.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    MM,
    ORANGE,
    PURPLE,
    SKY_BLUE,
    STYLE,
    VERMILION,
    WIDE,
    require_rows,
)

COLORS = (BLACK, BLUE, SKY_BLUE, GREEN, ORANGE, VERMILION, PURPLE)
MARKERS = "osxD+"


@rc_context(STYLE)
def plot_direct_integration(table):
    """Depth by direct integration over the elastic depth, and what Eq. 8 gives, against the elements in contact.

    table : of viscorough_study.gamma_factor. Raises ValueError for a table without rows.
    """
    require_rows("plot_direct_integration", table)
    figure = Figure(figsize=(WIDE, 80 * MM))
    axes = figure.subplots()
    for rank, (case, rows) in enumerate(table.groupby("case", sort=False)):
        color = COLORS[rank % len(COLORS)]
        axes.semilogx(rows["contact_count"], rows["depth_ratio"], MARKERS[rank % len(MARKERS)], color=color, label=case)
        axes.axhline(rows["with_gamma"].iloc[0], color=color, linestyle="--", linewidth=0.8)
    axes.axhline(1, color=GREY, linewidth=0.8)
    axes.plot([], [], color=GREY, linestyle="--", label=r"with the factor $1/\Gamma(2-\alpha)$, Eq. 8")
    axes.set(xlabel="elements in contact [1]", ylabel="viscous depth over elastic depth [1]")
    figure.legend(loc="outside right upper")
    return figure
