"""Draw error against processor time of the mean of many surfaces, and the times of other solvers as bars."""

import numpy as np

from viscorough_study.figures import style
from viscorough_study.run.names import GRID, LAW, MDR_FITTED, MDR_PI, MEAN_X

HURST = 0.4  # the panel of the mean shows the Hurst exponent nearest to this value
ERRORS = (0.5, 0.2, 0.1, 0.05, 0.02, 0.01)  # ticks of the axis of errors
# Colors of the grids, from coarse to fine.
GRIDS = (style.SKY_BLUE, style.BLUE, style.GREEN, style.PURPLE, style.ORANGE)
LINES = {MDR_PI: "v", MDR_FITTED: "^"}  # markers of the means of lines of the MDR
LEFT = 0.02  # horizontal position of the law, which costs no time, as a share of the width of the axes
# Task of the race with other solvers that is shown, and the residual, over the depth, that every solver reached.
RACE, RACE_TOLERANCE = "eight levels", 1e-6


@style.figure
def plot_speed(means, other_solvers):
    """Draw the mean of many surfaces by law, discs and lines of the MDR (a), and the times of other solvers (b).

    means : table of comparisons.mean_of_surfaces
    other_solvers : rows of resources/published/other_solvers.csv; each has the ratio of a solver's time to the time of
        viscorough
    """
    figure = style.new_figure(90)
    mean, race = figure.subplots(1, 2, width_ratios=(1.25, 1))
    velocity = means[means["quantity"] == "velocity"]
    hurst = _nearest(velocity["hurst"], HURST)
    _draw_mean(mean, velocity[velocity["hurst"] == hurst], velocity[velocity["model"] == LAW])
    _draw_race(race, other_solvers)
    return figure


def _nearest(values, value):
    return min(values, key=lambda each: (abs(each - value), each))


def _draw_mean(axes, rows, law):
    """Draw the errors of all models of the mean at one Hurst exponent, and the errors of the law at every exponent."""
    timed = rows.dropna(subset="error").query("processor_s > 0")
    if timed.empty:
        axes.text(0.5, 0.5, "no mean in this range of X", transform=axes.transAxes, ha="center", color=style.GREY)
        return
    grids = timed[timed["model"] == GRID]
    ends = []
    for (across, curve), color in zip(grids.groupby("across"), GRIDS, strict=False):
        axes.plot("processor_s", "error", "o-", data=curve, color=color, markersize=3)
        text = f"{across:g} × {across:g}"
        ends.append((f"discs, {text}" if across == grids["across"].max() else text, curve, color))
    for model, marker in LINES.items():
        if len(curve := timed[timed["model"] == model]):
            axes.plot("processor_s", "error", marker=marker, data=curve, color=style.GREY, markersize=3)
            ends.append((model, curve, style.GREY))
    number, hurst, reference = style.count_text(timed["surfaces"]), *timed[["hurst", "reference_error"]].iloc[0]
    axes.set_title(f"(a) Mean of {number} surfaces, $H$ = {hurst:g}, $X$ = {MEAN_X[0]:g} to {MEAN_X[1]:g}")
    errors = law["error"].dropna()
    bottom = 0.6 * min(timed["error"].min(), reference, errors.min() if len(errors) else np.inf)
    axes.set(xscale="log", yscale="log", xlabel="processor time (s)", ylabel="error of the mean velocity")
    axes.set_ylim(bottom, 1.5 * timed["error"].max())
    axes.set_xlim(timed["processor_s"].min() / 30, timed["processor_s"].max() * 2)
    axes.set_yticks(ERRORS, [f"{100 * error:g} %" for error in ERRORS])
    axes.axhspan(bottom, reference, color=style.PALE, linewidth=0, zorder=0)
    edge = axes.get_yaxis_transform()
    axes.text(0.98, reference, "standard error of the reference", transform=edge, ha="right", va="top")
    if len(errors):
        axes.plot(np.full(errors.size, LEFT), errors, "D", color=style.VERMILION, transform=edge, clip_on=False)
        axes.annotate("law, every $H$", (LEFT, errors.max()), (7, -2), xycoords=edge, textcoords="offset points",
                      color=style.VERMILION)  # fmt: skip
    ends = [(text, *curve[["processor_s", "error"]].iloc[-1], color) for text, curve, color in ends]
    style.label_ends(axes, ends, gap=0.05)


def _draw_race(axes, other_solvers):
    """Draw the time of each other solver over the time of viscorough as a bar. A solver's fastest mode counts."""
    races = [race for race in other_solvers if race["task"] == RACE]
    hurst = _nearest([race["hurst"] for race in races], HURST)
    ratios = {}
    for race in races:
        if race["hurst"] == hurst:
            name = race["solver"].split()[0]
            ratios[name] = min(race["ratio"], ratios.get(name, np.inf))
    names = sorted(ratios, key=ratios.get, reverse=True)
    axes.barh(names, [ratios[name] for name in names], color=style.BLUE, height=0.6)
    for place, name in enumerate(names):
        axes.annotate(f"{ratios[name]:.3g} ×", (ratios[name], place), (3, 0), textcoords="offset points", va="center")
    across, levels = races[0]["elements"], races[0]["levels"]
    task = f"{levels} depths of a disc, {across} × {across},\n$H$ = {hurst:g}, one thread,\n"
    residual = f"residual $10^{{{np.log10(RACE_TOLERANCE):.0f}}}$ of the depth"
    axes.set_title(f"(b) Other solvers (published):\n{task}{residual}")
    axes.set(xscale="log", xlim=(1, 8 * max(ratios.values())), xlabel="time over that of viscorough")
