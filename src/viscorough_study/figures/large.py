"""Time and memory of the loading curve of one disc on grids from coarse to fine."""

from viscorough_study.figures import style
from viscorough_study.performance.costs import fit_cost


@style.figure
def plot_large(table):
    """Time (a) and memory (b) of one curve over the elements, with exponents fitted to the larger half.

    table : costs of the discs, by ascending number of elements. Raises ValueError for fewer than two sizes.
    """
    if len(table) < 2:
        raise ValueError(f"plot_large: at least two sizes are needed, the table has {len(table)}")
    figure = style.new_figure(80)
    time, memory = figure.subplots(1, 2)
    elements, threads = table["elements"], f"wall time on {table['threads'].max():.0f} threads"
    time.set(title="(a) time", ylabel="time (s)")
    memory.set(title="(b) memory", ylabel="memory of the process (GB)")
    for axes, values in ((time, table["processor"]), (memory, table["memory"] / 1e9)):
        axes.loglog(elements, values, "o", color=style.BLUE, label="measured (elements across)")
        if axes is time:
            axes.loglog(elements, table["wall_threads"], "s", markerfacecolor="none", color=style.GREY, label=threads)
        larger = slice(min(len(table) // 2, len(table) - 2), None)
        exponent, factor = fit_cost(elements[larger], values[larger])
        line = factor * elements[larger] ** exponent
        axes.loglog(elements[larger], line, color=style.GREY, label=f"exponent {exponent:.2f}")
        axes.set_xlabel("elements of the disc")
        for across, *at in zip(table["across"], elements, values, strict=True):
            axes.annotate(f"{across}", at, (-5, 3), textcoords="offset points", ha="right")
        axes.margins(x=0.2, y=0.12)  # room for the number at the first marker
        style.logarithmic_ticks(axes)
        axes.legend(loc="upper left", bbox_to_anchor=(0, 0.95))
    return figure
