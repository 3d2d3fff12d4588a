"""Figures over the number of elements: exponents of ensembles, time and memory of one curve."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscorough.reference import exponent_beta
from viscorough_study.figures.style import GREY, MM, STYLE, WIDE, hurst_handles, hurst_looks, logarithmic_ticks, mark
from viscorough_study.tables import fits

LARGE = {
    "across": ("elements across the disc", "1"),
    "elements": ("elements of the disc", "1"),
    "levels": ("levels of its loading curve", "1"),
    "operator_applications": ("applications of the half-space operator", "1"),
    "wall": ("wall time", "s"),
    "processor": ("processor time", "s"),
    "memory": ("largest memory of the process", "B"),
    "machine": ("machine on which times and memory were measured", None),
}


@rc_context(STYLE)
def plot_sizes(table, shown):
    """β of region (b) over the number of elements, discs (a) and lines (b), one colour for each Hurst exponent.

    table : that of fit_sizes; shown : conventions, {column: value}. Lines mark H/(1 + H), Eq. (10); crosses are
    controls, discs with a roll-off in their spectrum.
    Raises ValueError for a table without rows.
    """
    if table.empty:
        raise ValueError("plot_sizes: the table has no rows; at least one is needed")
    figure = Figure(figsize=(WIDE, 85 * MM))
    panels = dict(zip(("discs", "lines"), figure.subplots(1, 2, sharey=True), strict=True))
    looks = hurst_looks(table.loc[table["case_group"] == "sizes", "hurst"])
    lines_have = {"rms_convention": "line"}
    for rank, (hurst, look) in enumerate(looks.items()):
        for source, axes in panels.items():
            wanted = {"source": source, "case_group": "sizes", "hurst": hurst}
            rows = fits(table, shown | (lines_have if source == "lines" else {}), **wanted)
            axes.axhline(exponent_beta(hurst), color=look["color"], linestyle=":", linewidth=0.8)
            for row in rows.sort_values("elements").itertuples():
                shifted = row.elements * 1.06 ** (rank - len(looks) / 2)  # so that intervals do not hide each other
                mark(axes, shifted, row.beta, (row.beta_low, row.beta_high), look)
    control = {"color": GREY, "marker": "x", "linestyle": ""}
    for row in fits(table, shown, source="discs", case_group="controls").itertuples():
        mark(panels["discs"], row.elements, row.beta, (row.beta_low, row.beta_high), control)
    for (source, axes), title in zip(panels.items(), ("(a) boundary elements", "(b) MDR"), strict=True):
        unit = "elements of a disc [1]" if source == "discs" else "points of a line [1]"
        axes.set(xscale="log", title=title, xlabel=unit, ylim=(-0.05, 0.7))
    panels["discs"].set_ylabel(r"exponent $\beta$ of region (b) [1]")
    logarithmic_ticks(*panels.values())
    handles = [*hurst_handles(looks, linestyle=":"), Line2D([], [], label="control, roll-off", **control)]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


@rc_context(STYLE)
def plot_large(table):
    """Processor time (a) and memory (b) of one curve over the elements, with exponents fitted to the larger half.

    Raises ValueError for fewer than two sizes.
    """
    if len(table) < 2:
        raise ValueError(f"plot_large: at least two sizes are needed, the table has {len(table)}")
    figure = Figure(figsize=(WIDE, 80 * MM))
    panels = zip(figure.subplots(1, 2), ("processor", "memory"), ("(a) time", "(b) memory"), strict=True)
    for axes, name, title in panels:
        values = table[name] / (1e9 if name == "memory" else 1)
        axes.loglog(table["elements"], values, "o", color="#0072b2", label="measured")
        fitted = table["elements"] >= table["elements"].iloc[min(len(table) // 2, len(table) - 2)]
        x = np.log(table.loc[fitted, "elements"])
        slope, constant = np.polyfit(x, np.log(values[fitted]), 1)
        line = np.exp(constant) * table.loc[fitted, "elements"] ** slope
        axes.loglog(table.loc[fitted, "elements"], line, color=GREY, label=f"exponent {slope:.2f}")
        unit = "memory of the process [GB]" if name == "memory" else "processor time [s]"
        axes.set(title=title, xlabel="elements of the disc [1]", ylabel=unit)
        for across, *at in zip(table["across"], table["elements"], values, strict=True):
            axes.annotate(f"{across}", at, (-5, 3), textcoords="offset points", fontsize=6, ha="right")
        axes.margins(0.12)
        logarithmic_ticks(axes)
        axes.legend(loc="upper left", bbox_to_anchor=(0, 0.95))
    return figure
