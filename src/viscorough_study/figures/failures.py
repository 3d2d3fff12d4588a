"""Draw the shares of right and wrong results in the stress tests, and the errors from three causes of failure."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.run.names import BOX, RANGE, STEPS

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
ERRORS = (1.0, 0.1, 0.01, 1e-3)  # ticks of the axes of errors
ERROR, SHARE = "relative error", "share of the cases"
FLOOR = 3e-4  # lower end of the axes of errors
HURST = 0.4  # panel (e) shows discs with the Hurst exponent nearest to this value


@style.figure
def plot_failures(table, knobs):
    """Draw shares of outcomes by method (a) and by kind of stress test (b), and errors against settings (c, d, e).

    table : table of robustness.failure_map; knobs : table of robustness.knobs
    """
    figure = style.new_figure(110)
    upper, lower = figure.subfigures(2, 1, height_ratios=[3, 2])
    by_method, by_group = upper.subplots(1, 2)
    steps, box, power_law = lower.subplots(1, 3)
    silent = int((table["verdict"] == "unnoticed").sum())
    by_method.set_title(f"(a) {silent} of {len(table)} results are silently wrong")
    by_group.set_title("(b) The same by kind of case")
    _draw_bars(by_method, table.assign(name=table["method"].replace(METHODS)))
    _draw_bars(by_group, table.assign(name=table["group"]))
    _draw_steps(steps, knobs[knobs["knob"] == STEPS])
    _draw_box(box, knobs[knobs["knob"] == BOX])
    _draw_range(power_law, knobs[knobs["knob"] == RANGE])
    for axes in (steps, box, power_law):
        axes.set(ylim=(FLOOR, 2), yscale="log")
        axes.set_yticks(ERRORS, [f"{100 * error:g} %" for error in ERRORS])
        axes.grid(axis="y", color=style.PALE, linewidth=0.6, zorder=0)
    steps.set_ylabel(ERROR)
    handles = [style.handle(label.format(silent), color=color, linewidth=7) for label, _, color in OUTCOMES.values()]
    upper.legend(handles=handles, loc="outside upper center", ncols=3, handlelength=1.2)
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
    axes.minorticks_off()


def _draw_steps(axes, rows):
    axes.set(title="(c) Too few time steps", xlabel="number of steps", xscale="log", xlim=(5, 2e4))
    axes.plot("value", "error", "-", data=rows, color=style.VERMILION)
    for warned, face, label in ((1, style.VERMILION, "warned"), (0, "white", "right")):
        points = rows[rows["warned"] == warned]
        look = {"color": style.VERMILION, "markerfacecolor": face, "linestyle": ""}
        axes.plot("value", "error", "o", data=points, **look)
        if len(points):
            where = tuple(points.iloc[0][["value", "error"]])
            axes.annotate(label, where, (4, 4), textcoords="offset points", color=style.VERMILION)


def _draw_box(axes, rows):
    axes.set(title="(d) Too small a box", xlabel="width of the box over the map")
    axes.plot("value", "error", "-", data=rows[rows["error"] > 0], color=style.VERMILION)
    axes.axvline(2, color=style.BLUE)
    axes.annotate("used here", (2, 0.7), (-3, 0), textcoords="offset points", color=style.BLUE, ha="right")
    axes.set_xlim(0.95, 2.1)


def _draw_range(axes, rows):
    hurst = min(rows["hurst"], key=lambda value: abs(value - HURST), default=np.nan)
    rows = rows[rows["hurst"] == hurst]
    axes.set(title="(e) Power law out of range", xlabel=r"$X = Ft/(4\eta hL)$", xscale="log")
    axes.plot("value", "error", "-", data=rows, color=style.VERMILION)
