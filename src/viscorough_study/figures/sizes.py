"""The exponent β of ensembles on grids from coarse to fine."""

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscorough.reference import exponent_beta
from viscorough_study.conventions import fits
from viscorough_study.figures.style import (
    GREY,
    MM,
    STYLE,
    WIDE,
    count_text,
    hurst_handles,
    hurst_looks,
    logarithmic_ticks,
    mark_with_interval,
    require_rows,
)


@rc_context(STYLE)
def plot_sizes(table, conventions):
    """β of region (b) over the number of elements, discs (a) and lines (b), one colour for each Hurst exponent.

    table : that of fit_sizes; conventions : {column of it: value}
    Dotted lines are H/(1 + H), Eq. 10; crosses are controls, discs whose spectrum rolls off.
    Raises ValueError for a table without rows.
    """
    require_rows("plot_sizes", table)
    figure = Figure(figsize=(WIDE, 85 * MM))
    panels = dict(zip(("discs", "lines"), figure.subplots(1, 2, sharey=True), strict=True))
    looks = hurst_looks(table.loc[table["case_group"] == "sizes", "hurst"])
    for rank, (hurst, look) in enumerate(looks.items()):
        for source, axes in panels.items():
            own_rms = {"rms_convention": "line"} if source == "lines" else {}
            rows = fits(table, conventions | own_rms, source=source, case_group="sizes", hurst=hurst)
            axes.axhline(exponent_beta(hurst), color=look["color"], linestyle=":", linewidth=0.8)
            for row in rows.sort_values("elements").itertuples():
                shifted = row.elements * 1.06 ** (rank - len(looks) / 2)  # so that intervals do not hide each other
                mark_with_interval(axes, shifted, row.beta, (row.beta_low, row.beta_high), look)
    control = {"color": GREY, "marker": "x", "linestyle": ""}
    for row in fits(table, conventions, source="discs", case_group="controls").itertuples():
        mark_with_interval(panels["discs"], row.elements, row.beta, (row.beta_low, row.beta_high), control)
    for (source, axes), title in zip(panels.items(), ("(a) boundary elements", "(b) MDR"), strict=True):
        numbers = table.loc[(table["source"] == source) & (table["case_group"] == "sizes"), "realizations"]
        title += f", {count_text(numbers)} {source} each" if len(numbers) else ""
        label = "elements of a disc" if source == "discs" else "points of a line"
        axes.set(xscale="log", title=title, xlabel=label, ylim=(-0.05, 0.7))
    panels["discs"].set_ylabel(r"exponent $\beta$ of region (b)")
    logarithmic_ticks(*panels.values())
    handles = [*hurst_handles(looks, linestyle=""), Line2D([], [], label="control, roll-off", **control)]
    handles.append(Line2D([], [], color=GREY, linestyle=":", linewidth=0.8, label="$H/(1+H)$, Eq. 10"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure
