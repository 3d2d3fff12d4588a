"""Time and memory of the loading curve of one disc on grids from coarse to fine."""

from viscorough_study.figures import style
from viscorough_study.performance.costs import fit_cost


@style.figure
def plot_large(table):
    """Time (a) and memory (b) of one curve over the elements, with exponents fitted to the larger half.

    table : costs of the discs of at least two sizes, by ascending number of elements
    """
    figure, (time, memory) = style.new_subplots(80, 1, 2)
    elements, threads = table["elements"], f"wall time on {table['threads'].max():.0f} threads"
    larger = slice(min(len(table) // 2, len(table) - 2), None)
    time.plot(elements, table["wall_threads"], "s", markerfacecolor="none", color=style.GREY, label=threads)
    for axes, values in ((time, table["processor"]), (memory, table["memory"] / 1e9)):
        axes.plot(elements, values, "o", color=style.BLUE, label="measured (elements across)")
        exponent, factor = fit_cost(elements[larger], values[larger])
        line = factor * elements[larger] ** exponent
        axes.plot(elements[larger], line, color=style.GREY, label=f"exponent {exponent:.2f}")
        for across, *at in zip(table["across"], elements, values, strict=True):
            axes.annotate(f"{across}", at, (-5, 3), textcoords="offset points", ha="right")
        axes.set(xscale="log", yscale="log", xlabel="elements of the disc")
        axes.margins(x=0.2, y=0.12)  # room for the number at the first marker
        axes.legend(loc="upper left", bbox_to_anchor=(0, 0.95))
    time.set(title="(a) time", ylabel="time (s)")
    memory.set(title="(b) memory", ylabel="memory of the process (GB)")
    return figure
