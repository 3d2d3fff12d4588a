"""Time and memory of the loading curve of one disc on ever finer grids."""

from matplotlib import rc_context
from matplotlib.figure import Figure

from viscorough_study.figures.style import BLUE, GREY, MM, SMALL, STYLE, WIDE, logarithmic_ticks
from viscorough_study.performance.cost_growth import fit_cost


@rc_context(STYLE)
def plot_large(table):
    """Time (a) and memory (b) of one curve over the elements, with exponents fitted to the larger half.

    table : costs of the discs, by ascending number of elements. Raises ValueError for fewer than two sizes.
    """
    if len(table) < 2:
        raise ValueError(f"plot_large: at least two sizes are needed, the table has {len(table)}")
    figure = Figure(figsize=(WIDE, 80 * MM))
    panels = zip(figure.subplots(1, 2), ("processor", "memory"), ("(a) time", "(b) memory"), strict=True)
    for axes, name, title in panels:
        values = table[name] / (1e9 if name == "memory" else 1)
        axes.loglog(table["elements"], values, "o", color=BLUE, label="measured (elements across)")
        if name == "processor":
            label = f"wall time on {table['threads'].max():.0f} threads"
            axes.loglog(table["elements"], table["wall_threads"], "s", markerfacecolor="none", color=GREY, label=label)
        fitted = table["elements"] >= table["elements"].iloc[min(len(table) // 2, len(table) - 2)]
        exponent, factor = fit_cost(table.loc[fitted, "elements"], values[fitted])
        line = factor * table.loc[fitted, "elements"] ** exponent
        axes.loglog(table.loc[fitted, "elements"], line, color=GREY, label=f"exponent {exponent:.2f}")
        label = "memory of the process (GB)" if name == "memory" else "time (s)"
        axes.set(title=title, xlabel="elements of the disc", ylabel=label)
        for across, *at in zip(table["across"], table["elements"], values, strict=True):
            axes.annotate(f"{across}", at, (-5, 3), textcoords="offset points", fontsize=SMALL, ha="right")
        axes.margins(x=0.2, y=0.12)  # room for the number at the first marker
        logarithmic_ticks(axes)
        axes.legend(loc="upper left", bbox_to_anchor=(0, 0.95))
    return figure
