"""Levels placed automatically for a scene, compared with levels placed by hand and naively."""

from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from viscorough_study.figures import style

CHOICES = {"automatic": style.BLUE, "best by hand": style.GREEN, "naive": style.VERMILION}
HEIGHT = 0.8 / len(CHOICES)  # of a bar
MISSED = "////"  # hatching of bars that miss the accuracy


@style.figure
def plot_level_placement(table):
    """Wall time of every choice of levels over that of the automatic choice, as bars with number of levels and error.

    table : of viscorough_study.performance.level_placement
    A choice that does not reach the accuracy is hatched.
    """
    scenes = list(table["scene"].unique())
    figure = style.new_figure(17 * len(scenes) + 24)
    axes = figure.subplots()
    for row in table.itertuples():
        rank = list(CHOICES).index(row.choice)
        y = scenes.index(row.scene) + HEIGHT * (rank - (len(CHOICES) - 1) / 2)
        look = {"color": CHOICES[row.choice]} if row.reached else {"facecolor": "white", "hatch": MISSED}
        axes.barh(y, row.ratio, 0.9 * HEIGHT, edgecolor=CHOICES[row.choice], linewidth=0.6, **look)
        time, error = style.number_text(1e3 * row.wall_s, 2), style.number_text(row.error, 2)
        note = f"{time} ms, {row.levels} levels, error {error}"
        axes.annotate(note, (max(row.ratio, 1), y), (3, 0), textcoords="offset points", va="center")
    axes.axvline(1, color=style.GREY, linewidth=0.8)
    accuracy = table.groupby("scene")["accuracy"].first()
    labels = [f"{scene}\nerror up to {style.number_text(accuracy[scene])}" for scene in scenes]
    axes.set_yticks(range(len(scenes)), labels)
    longest = table["ratio"].max()
    ticks = MaxNLocator(6, steps=[1, 2, 5, 10]).tick_values(0, longest)
    axes.set_xticks(ticks[ticks <= longest])
    # Leaves space for the note beside the longest bar.
    axes.set(xlabel="wall time over that of the automatic choice", xlim=(0, 1.75 * longest))
    axes.set_ylim(len(scenes) - 0.45, -0.55)
    axes.tick_params(axis="y", which="both", length=0)
    axes.tick_params(axis="x", top=False)
    axes.minorticks_off()
    for place in range(1, len(scenes)):
        axes.axhline(place - 0.5, color=style.PALE, linewidth=0.6)
    handles = [Patch(color=color, label=choice) for choice, color in CHOICES.items()]
    handles.append(Patch(facecolor="white", edgecolor=style.GREY, hatch=MISSED, label="accuracy not reached"))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure
