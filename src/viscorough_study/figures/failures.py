"""Draw the shares of right and wrong results in the stress tests."""

from viscorough_study.figures import style

# Outcomes in a bar from left to right, as {outcome: (label, verdicts of the failure map that it contains, color)}.
OUTCOMES = {
    "right": ("right", ("holds", "model"), style.BLUE),
    "refused": ("refused, with a reason", ("refused",), style.PALE),
    "warned": ("wrong, with a warning", ("warned",), style.ORANGE),
    "stated": ("wrong, a model beyond its documented range", ("stated",), "#f7dc9c"),
    "silent": ("silently wrong: {}", ("unnoticed",), style.BLACK),
}
# Names of methods, {name in the failure map: name in this figure}.
METHODS = {
    "path, dense": "boundary elements, dense",
    "path, grid, double": "boundary elements, double",
    "path, grid, single": "boundary elements, single",
    "path, interpolated": "boundary elements, curve",
    "events": "time: event by event",
    "explicit steps": "time: explicit steps",
    "media, correspondence": "media: from the curve",
    "media, steps": "media: time steps",
    "MDR": "MDR, to a factor of two",
    "power law": "power law, to a factor of two",
    "power law with Γ": "with Γ, to a factor of two",
}
BAR = 0.72  # height of a bar, in units of the distance between bars
SHARE = "share of the cases"


@style.figure
def plot_failures(table):
    """Draw shares of outcomes by method (a) and by kind of stress test (b).

    table : table of robustness.failure_map
    """
    figure, (by_method, by_group) = style.new_subplots(66, 1, 2)
    silent = int((table["verdict"] == "unnoticed").sum())
    by_method.set_title(f"(a) {silent} of {len(table)} results are silently wrong")
    by_group.set_title("(b) The same by kind of case")
    _draw_bars(by_method, table.assign(name=table["method"].replace(METHODS)))
    _draw_bars(by_group, table.assign(name=table["group"]))
    handles = [style.handle(label.format(silent), color=color, linewidth=7) for label, _, color in OUTCOMES.values()]
    figure.legend(handles=handles, loc="outside upper center", ncols=3, handlelength=1.2)
    return figure


def _draw_bars(axes, table):
    """Draw a bar with the shares of all outcomes for every name, and write the number of silent failures at the bar.

    table : table of the failure map with a further column `name`, the name of the bar to which a row belongs
    """
    names = list(dict.fromkeys(table["name"]))
    for place, name in enumerate(names):
        verdicts, left = table.loc[table["name"] == name, "verdict"], 0.0
        for _, members, color in OUTCOMES.values():
            share = float(verdicts.isin(members).mean())
            axes.barh(place, share, BAR, left, color=color, linewidth=0)
            left += share
        silent = int(verdicts.isin(OUTCOMES["silent"][1]).sum())
        axes.text(1.1, place, str(silent), va="center", ha="center")
    axes.set_yticks(range(len(names)), names)
    axes.text(1.1, -0.8, "silent", va="center", ha="center")
    axes.set(xlim=(0, 1.2), ylim=(len(names) - 0.4, -1.2), xlabel=SHARE)
    axes.set_xticks([0, 0.5, 1], ["0", "50 %", "100 %"])
    axes.tick_params(which="both", length=0)
