"""Draw error against processor time: for one surface, the mean of many surfaces, and the solver on a given grid."""

import numpy as np

from viscorough_study.comparisons.mean_of_surfaces import X
from viscorough_study.figures import style
from viscorough_study.run.names import GRID, LAW, MDR, MDR_FITTED, MDR_PI
from viscorough_study.run.readable import readable

ERRORS = (0.5, 0.2, 0.1, 0.05, 0.02, 0.01)  # ticks of the axes of errors in (a) to (c)
SMALL_ERRORS = (1e-1, 1e-3, 1e-5, 1e-7, 1e-9)  # ticks of the axis of errors in (d)
TIME, ERROR = "processor time (s)", "error of the velocity $v$"
LEFT = 0.02  # horizontal position of a model that costs no time, as a share of the width of the axes
LEAST_DISTANCE = 0.055  # smallest vertical distance of labels, as a share of the height of the axes
# Colors of the grids, from coarse to fine.
GRIDS = (style.SKY_BLUE, style.BLUE, style.GREEN, style.PURPLE, style.ORANGE)
GRID_MARKERS = "osPhX"  # markers of the grids in (c)
ALLOWED = (0.2, 0.1, 0.05, 0.01)  # errors for which (c) names the cheapest model
FINE = {"color": style.BLACK, "markerfacecolor": "white"}  # look of the finest grid in (c)
PATH = "path, at the depths"
# Curves in (d), {method: (label, color, offset of the label from the first point of the curve [points])}.
SOLVERS = {
    PATH: ("viscorough", style.BLUE, (-4, 5)),
    "explicit, logarithmic steps": ("explicit steps", style.PURPLE, (5, 2)),
}
# Task for which the times of several solvers are published, and the residual that every solver reached in this task.
RACE, RACE_TOLERANCE = "eight levels", 1e-6
ACROSS = 257  # panel (d) shows the finest grid with at most this number of elements across
FLOOR = 1e-10  # smaller errors are drawn at this value


@style.figure
def plot_speed(one_surface, means, methods, fine_velocities, other_solvers):
    """Draw error against processor time: one surface (a, b), the mean of many (c), the solver on a given grid (d).

    one_surface, means, methods : tables of performance.one_surface, comparisons.mean_of_surfaces and
        performance.measurement
    fine_velocities : table of fits.fine_grids with the columns `VELOCITIES`
    other_solvers : rows of resources/published/other_solvers.csv; each has the ratio of a solver's time to the time of
        viscorough
    """
    figure = style.new_figure(190)
    panels = figure.subplot_mosaic("ab;cc;dd", height_ratios=(1, 1.35, 0.9))
    left, right, many, solver = (panels[letter] for letter in "abcd")
    velocity = one_surface[one_surface["quantity"] == "velocity"]
    exponents = sorted(velocity["hurst"].unique())
    for axes, letter, hurst in zip((left, right), "ab", (exponents[0], exponents[-1]), strict=True):
        rows = velocity[velocity["hurst"] == hurst]
        number = style.count_text(rows["surfaces"])
        axes.set_title(f"({letter}) Error for one surface, $H$ = {hurst:g}:\nmean over {number} surfaces")
        _draw_one_surface(axes, rows)
    rows = means[means["quantity"] == "velocity"]
    hurst = min(rows["hurst"], key=lambda value: (abs(value - exponents[0]), value))
    law = rows[rows["model"] == LAW]
    rows = rows[rows["hurst"] == hurst]
    has_law = rows[rows["model"] == LAW]["error"].notna().any()
    finding = (
        f"law at every $H$: {100 * law['error'].min():.1f} to {100 * law['error'].max():.1f} %"
        if has_law
        else "the law is not calibrated for it"
    )
    many.set_title(f"(c) Mean of many surfaces, $H$ = {hurst:g}; {finding}")
    fine = fine_velocities[(fine_velocities["hurst"] == hurst) & (fine_velocities["quantity"] == "whole")]
    _draw_mean(many, rows, law, _last_decade(fine))
    solver.set_title("(d) Solver alone, on a given grid: finer tolerances go far below the grid error")
    _draw_solvers(solver, methods, velocity, other_solvers)
    return figure


def _lines_of_equal_error(axes, errors, limits):
    axes.set(xscale="log", yscale="log", xlabel=TIME, ylabel=ERROR, ylim=limits)
    axes.set_yticks(errors, [f"{100 * error:g} %" if error > 1e-4 else _power(100 * error) for error in errors])
    axes.grid(axis="y", color=style.PALE, linewidth=0.6, zorder=0)


def _limits(rows):
    """Return the limits of an axis that shows the errors of all rows."""
    return 0.5 * rows["error"].min(), max(2 * rows["error"].max(), 0.6)


def _power(number):
    return f"$10^{{{np.log10(number):.0f}}}$ %"


def _draw_law(axes, rows, above=False):
    """Draw the law, which needs no new simulation, as markers at the left edge, with a label at the largest error.

    Nothing is drawn if the table has no error of the law, which is calibrated for some Hurst exponents only.
    rows : rows of the law, one for each Hurst exponent; above : True to write the label above the marker
    """
    errors = rows["error"].dropna()
    if errors.empty:
        return
    look = {"color": style.VERMILION, "clip_on": False}
    edge = axes.get_yaxis_transform()
    axes.plot(np.full(errors.size, LEFT), errors, "D", linestyle="", transform=edge, markersize=5, **look)
    where = {"xycoords": edge, "textcoords": "offset points"}
    axes.annotate("law", (LEFT, errors.max()), (6, 6 if above else -10), **where, **look)


def _label_ends(axes, ends):
    """Label curves at their left ends, below their points, so that the labels do not overlap.

    ends : list of (label, smallest x of the curve, y of the label, color)
    """
    bottom, top = np.log(axes.get_ylim())
    lowest = -np.inf
    for text, x, y, color in sorted(ends, key=lambda end: end[2]):
        lowest = max(np.log(y), lowest + LEAST_DISTANCE * (top - bottom))
        where = {"textcoords": "offset points", "ha": "right", "va": "top", "color": color}
        axes.annotate(text, (x, np.exp(lowest)), (-5, 0), **where)


def _say(axes, text):
    """Write a note about the points of the curves in the upper right corner of the axes."""
    axes.text(0.97, 0.96, text, transform=axes.transAxes, ha="right", va="top", color=style.GREY)


def _draw_curve(axes, curve, look, color, label):
    """Draw the curve of one model; return its entry for the list `ends`, the argument of `_label_ends`."""
    axes.plot("processor_s", "error", look, data=curve, color=color, markersize=3)
    return label, curve["processor_s"].min(), curve["error"].iloc[-1], color


def _draw_one_surface(axes, rows):
    full = rows[rows["model"] == GRID]["across"].max()  # points across the full map, the reference
    grids = rows[(rows["model"] == GRID) & (rows["across"] < full)]
    ends = [
        _draw_curve(axes, curve, "o-", color, f"{across:g} × {across:g}")
        for (across, curve), color in zip(grids.groupby("across"), GRIDS, strict=False)
    ]
    ends.append(_draw_curve(axes, rows[rows["model"] == MDR], "v-", style.GREY, "MDR"))
    shown = rows[rows["across"] != full]
    _lines_of_equal_error(axes, ERRORS, _limits(shown))
    low, high = shown[shown["processor_s"] > 0]["processor_s"].agg(["min", "max"])
    axes.set_xlim(low / 12, high * 20)
    _label_ends(axes, ends)
    _draw_law(axes, rows[rows["model"] == LAW], above=True)  # below, the label could meet the label of a coarse grid
    _say(axes, "along a curve: finer tolerances")


def _last_decade(fine):
    """Return the rows of the finest grid in the last decade of X that its curves reach."""
    fine = fine[fine["across"] == fine["across"].max()]
    return fine[fine["x"] >= fine["x"].max() / 10 * 0.999]


def _draw_mean(axes, rows, law, fine):
    rows = rows.dropna(subset="error")
    timed = rows[rows["processor_s"] > 0]
    if timed.empty:
        _say(axes, "no mean in this range of X")
        return
    grids = timed[timed["model"] == GRID]
    curves = [
        (f"{across:g} × {across:g}", curve, {"color": color, "marker": marker})
        for (across, curve), color, marker in zip(grids.groupby("across"), GRIDS, GRID_MARKERS, strict=False)
    ]
    looks = {MDR_PI: "v", MDR_FITTED: "^"}
    curves += [
        (model, curve, {"color": style.GREY, "marker": marker})
        for model, marker in looks.items()
        if len(curve := timed[timed["model"] == model])
    ]
    for label, curve, look in curves:
        axes.plot("processor_s", "error", data=curve, label=label, markersize=3, **look)
    front = _pareto_front(timed)
    look = {"color": style.PALE, "linewidth": 4, "drawstyle": "steps-post", "zorder": 1}
    axes.plot(*front.T, label=f"Pareto front, $X$ = {X[0]:g} to {X[1]:g}", **look)
    shown = np.concatenate([rows["error"], law["error"].dropna()])
    latest = timed["processor_s"].max()
    if len(fine):
        plain, pairs = _fine_points(fine, sorted(timed["surfaces"].unique()))
        across = fine["across"].iloc[0]
        text = f"$X$ = {readable(fine['x'].min())} to {readable(fine['x'].max())}, {across:g} × {across:g}: "
        axes.plot(*plain.T, "s--", label=text + "one grid", markersize=3, **FINE)
        axes.plot(*pairs, "*", linestyle="", label=text + "sum over pairs of grids", markersize=9, **FINE)
        shown, latest = np.append(shown, [plain[-1, 1], pairs[1]]), max(latest, plain[-1, 0], pairs[0])
    _lines_of_equal_error(axes, ERRORS, (0.5 * shown.min(), max(2 * shown.max(), 1.0)))
    axes.set_xlim(timed["processor_s"].min() / 12, 120 * latest)  # names of models are at the right
    _draw_law(axes, law)
    numbers = style.count_text(timed["surfaces"])
    note = f"along a curve: {numbers} surfaces; law at every $H$: no new simulation"
    _say(axes, note + "\ndashed: cheapest models within this error")
    _name_cheapest(axes, timed, law)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=3)


def _pareto_front(timed):
    """Return the points (processor time, error) that no point with a shorter time undercuts, in order of time."""
    points = timed.sort_values(["processor_s", "error"])[["processor_s", "error"]].to_numpy()
    before = np.minimum.accumulate(np.append(np.inf, points[:-1, 1]))
    return points[points[:, 1] < before]


def _fine_points(fine, numbers):
    """Return points (processor time, standard error): plain averages of these numbers of discs, and the sum over pairs.

    Errors are root mean squares over the rows of the table, all of the same grid.
    """
    numbers = np.array(numbers)
    deviation, error = (np.sqrt(np.mean(fine[name] ** 2)) for name in ("deviation", "error"))
    plain = np.transpose([numbers * fine["processor_s"].iloc[0], deviation / np.sqrt(numbers)])
    return plain, (fine["sum_s"].max(), error)


def _name_cheapest(axes, timed, law):
    """Draw a line at each error of `ALLOWED`, and name the cheapest models within it on the line.

    timed : rows of the models that simulate, at one Hurst exponent; law : rows of the law at every Hurst exponent
    """
    for allowed in ALLOWED:
        axes.axhline(allowed, color=style.GREY, linestyle=style.DASHED, zorder=1.6)
        within = timed[timed["error"] <= allowed]
        names = ["law"] if law["error"].max() <= allowed else []
        if len(within):
            row = within.loc[within["processor_s"].idxmin()]
            name = f"{row['across']:g} × {row['across']:g}" if row["model"] == GRID else row["model"]
            unit = "discs" if row["model"] == GRID else "lines"
            names.append(f"{row['surfaces']:g} {unit} of {name}: {row['processor_s']:.2g} s")
        where = {"xycoords": axes.get_yaxis_transform(), "textcoords": "offset points", "ha": "right"}
        axes.annotate(", else ".join(names) or "no model", (0.985, allowed), (0, 2), **where)


def _draw_solvers(axes, methods, velocity, other_solvers):
    rough = methods[methods["hurst"].notna() & (methods["elements"] <= ACROSS)]
    if rough.empty:
        _say(axes, f"no grid of at most {ACROSS} elements across")
        return
    rough = rough[rough["elements"] == rough["elements"].max()]
    rough = rough[rough["hurst"] == rough["hurst"].min()]
    rough = rough.assign(error=np.maximum(rough["error"], FLOOR))
    _lines_of_equal_error(axes, SMALL_ERRORS, (FLOOR, 5))
    for method, (label, color, offset) in SOLVERS.items():
        curve = rough[rough["method"] == method]
        axes.plot("processor_s", "error", "o-", data=curve, color=color, markersize=3)
        if len(curve):
            place = tuple(curve.iloc[0][["processor_s", "error"]])
            axes.annotate(label, place, offset, textcoords="offset points", color=color)
    grid_error = velocity.query("model == @GRID and across == @rough.elements.iloc[0]")["error"]
    if len(grid_error):
        axes.axhspan(grid_error.min(), grid_error.max(), color=style.ORANGE, alpha=0.4, linewidth=0, zorder=0)
        edge = axes.get_yaxis_transform()
        axes.annotate(
            "error of the grid",
            (0.98, np.sqrt(grid_error.min() * grid_error.max())),
            xycoords=edge,
            ha="right",
            va="center",
        )
    drawn = rough[rough["method"].isin(list(SOLVERS))]
    axes.set_xlim(drawn["processor_s"].min() / 2.5, 2.5 * rough["processor_s"].max())
    _draw_others(axes, rough, other_solvers)


def _draw_others(axes, rough, other_solvers):
    """Draw other solvers as points in the axes of error against processor time.

    All solvers stop at the residual `RACE_TOLERANCE`, so their errors are equal to the error of viscorough at this
    tolerance. The time of another solver is the time of viscorough, multiplied by the published ratio of their times.
    """
    own = rough[(rough["method"] == PATH) & (rough["value"] <= RACE_TOLERANCE)]
    races = [race for race in other_solvers if race["task"] == RACE]
    if not len(own) or not races:
        return
    own, hurst = own.iloc[0], rough["hurst"].iloc[0]
    nearest = min((race["hurst"] for race in races), key=lambda value: abs(value - hurst))
    ratios = {}
    for race in races:
        if race["hurst"] == nearest:  # if a solver has several modes, only the fastest is drawn
            name = race["solver"].split()[0]
            ratios[name] = min(race["ratio"], ratios.get(name, np.inf))
    for rank, (name, ratio) in enumerate(sorted(ratios.items(), key=lambda item: item[1])):
        place = ratio * own["processor_s"], own["error"]
        axes.plot(*place, "s", color=style.BLACK, markersize=4)
        line = {"arrowstyle": "-", "color": style.GREY, "linewidth": 0.5}
        offset = (0, 8 * (len(ratios) - rank) - 3)
        axes.annotate(name, place, offset, textcoords="offset points", arrowprops=line)
    axes.set_xlim(right=6 * max(ratios.values()) * own["processor_s"])
    axes.text(0.97, 0.03, "■ other solvers, published times", transform=axes.transAxes, ha="right", color=style.GREY)
