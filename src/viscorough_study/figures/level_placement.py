"""Levels that the package chooses for a scene, against levels chosen by hand and naive ones."""

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter

from viscorough_study.figures.style import BLUE, GREEN, GREY, MM, STYLE, VERMILION, WIDE, require_rows

CHOICES = {"automatic": (BLUE, "o"), "best by hand": (GREEN, "s"), "naive": (VERMILION, "D")}


@rc_context(STYLE)
def plot_level_placement(table):
    """Time of each choice of levels over that of the automatic choice, with the errors reached.

    table : of viscorough_study.performance.level_placement. Raises ValueError for a table without rows.
    """
    require_rows("plot_level_placement", table)
    scenes = list(table["scene"].unique())
    figure = Figure(figsize=(WIDE, (13 * len(scenes) + 30) * MM))
    axes = figure.subplots()
    for row in table.itertuples():
        color, marker = CHOICES[row.choice]
        y = -scenes.index(row.scene)
        hollow = {} if row.reached else {"markerfacecolor": "none"}
        axes.plot(row.ratio, y, color=color, marker=marker, markersize=6, linestyle="", **hollow)
        above = {"xytext": (0, 6), "textcoords": "offset points", "ha": "center", "fontsize": 6}
        axes.annotate(f"{row.error / row.accuracy:.2g}", (row.ratio, y), color=color, **above)
    for ratio in (1 / 1.3, 3.0):
        axes.axvline(ratio, color=GREY, linestyle="--", zorder=1)
    accuracy = table.groupby("scene")["accuracy"].first()
    labels = [f"{scene}\n(to {accuracy[scene]:g})" for scene in scenes]
    axes.set_yticks([-place for place in range(len(scenes))], labels)
    axes.set(xscale="log", xlabel="wall time over that of the automatic choice [1]", ylim=(0.6 - len(scenes), 0.6))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.tick_params(axis="y", which="both", length=0)
    handles = [
        Line2D([], [], color=color, marker=marker, linestyle="", label=choice)
        for choice, (color, marker) in CHOICES.items()
    ]
    handles.append(Line2D([], [], color=GREY, linestyle="--", label="1/1.3 and 3"))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure
