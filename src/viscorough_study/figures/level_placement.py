"""Draw error and cost of loading curves whose levels are placed automatically, by hand, and naively."""

from viscorough_study.figures import style
from viscorough_study.run.names import AUTOMATIC, BY_HAND, NAIVE

# Curves of each panel, {placement of the levels: (label, color, marker)}.
CHOICES = {
    AUTOMATIC: ("automatic", style.BLUE, "o"),
    BY_HAND: ("by hand, after trials", style.GREEN, "s"),
    NAIVE: ("naive: equal steps, after trials", style.VERMILION, "^"),
}
TITLES = {
    "one asperity": "One smooth asperity",
    "region (b)": "Rough disc, light contact",
    "full curve": "Rough disc, to 90 % contact",
}
ERRORS = (0.1, 1e-2, 1e-3, 1e-4)  # ticks of the axis of errors
FLOOR = 3e-5  # smaller errors are drawn at this value, at a tick labelled with ≤


@style.figure
def plot_level_placement(table):
    """Draw the error of the depth against processor time, with a curve for each placement of the levels.

    Each scene (an indenter and a range of force) has a panel.
    table : table of viscorough_study.performance.level_placement, which explains the placements
    """
    names = list(table["scene"].unique())
    figure, panels = style.new_panels(
        len(names), 3, 58, 18, xlabel="processor time (s)", ylabel="error of the depth", sharey=True
    )
    figure.suptitle("Levels that viscorough places itself reach small errors without trials")
    for axes, name, letter in zip(panels, names, "abcdef", strict=False):
        rows = table[table["scene"] == name]
        for choice, (label, color, marker) in CHOICES.items():
            curve = rows[rows["choice"] == choice].assign(error=lambda rows: rows["error"].clip(lower=FLOOR))
            axes.plot("processor_s", "error", data=curve, color=color, marker=marker, markersize=3.5, label=label)
        axes.set(title=f"({letter}) {TITLES.get(name, name)}", xscale="log", yscale="log")
        axes.set(ylim=(FLOOR * 0.6, 0.1), xlim=(table["processor_s"].min() / 2, table["processor_s"].max() * 3))
        axes.set_yticks((*ERRORS, FLOOR), [*(f"{100 * error:g} %" for error in ERRORS), f"≤ {100 * FLOOR:g} %"])
        axes.grid(axis="y", color=style.PALE, linewidth=0.6, zorder=0)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(CHOICES), frameon=False)
    return figure
