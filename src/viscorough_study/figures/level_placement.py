"""Levels placed automatically for a scene, compared with levels placed by hand and naively."""

from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator

from viscorough_study.figures import style
from viscorough_study.run.readable import readable

CHOICES = {"automatic": style.BLUE, "best by hand": style.GREEN, "naive": style.VERMILION}
HEIGHT = 0.8 / len(CHOICES)  # of a bar
MISSED = "////"  # hatching of bars that miss the accuracy


@style.figure
def plot_level_placement(table):
    """Wall time of every choice of levels over that of the automatic choice, as bars.

    table : of viscorough_study.performance.level_placement
    A choice that does not reach the accuracy is hatched.
    """
    scenes, accuracy = list(table["scene"].unique()), table.groupby("scene")["accuracy"].first()
    figure, axes = style.new_subplots(12 * len(scenes) + 28)
    for row in table.itertuples():
        y = scenes.index(row.scene) + HEIGHT * (list(CHOICES).index(row.choice) - (len(CHOICES) - 1) / 2)
        look = {"color": CHOICES[row.choice]} if row.reached else {"facecolor": "white", "hatch": MISSED}
        axes.barh(y, row.ratio, 0.9 * HEIGHT, edgecolor=CHOICES[row.choice], linewidth=0.6, **look)
    axes.axvline(1, color=style.GREY, linewidth=0.8)
    labels = [f"{scene}\nerror up to {readable(accuracy[scene])}" for scene in scenes]
    axes.set_yticks(range(len(scenes)), labels)
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set(xlabel="wall time over that of the automatic choice", ylim=(len(scenes) - 0.45, -0.55))
    handles = [Patch(color=color, label=choice) for choice, color in CHOICES.items()]
    handles.append(Patch(facecolor="white", edgecolor=style.GREY, hatch=MISSED, label="accuracy not reached"))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure
