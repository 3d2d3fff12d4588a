"""Draw the force against the depth in loading, unloading and reloading, and the depth after a force is removed."""

from viscorough_study.figures import style

FORCE_CURVE, RECOVERY = "force curve", "recovery"  # names of the motions in the table
SYMBOLS = 25  # approximate number of symbols on the curve of a motion


@style.figure
def plot_histories(table):
    """Draw motions of one disc, computed by independent springs (lines) and by direct integration (symbols).

    The figure shows the disc with the median Hurst exponent.
    table : table of viscorough_study.comparisons.histories, which explains the springs
    """
    exponents = sorted(table["hurst"].unique())
    hurst = exponents[len(exponents) // 2]
    shown = table[(table["hurst"] == hurst) & ((table["motion"] == FORCE_CURVE) | (table["time"] >= 0))]
    looks = style.series_looks(shown["duration"])
    figure, (curves, recoveries) = style.new_subplots(75, 1, 2)
    for axes, motion, x, y in ((curves, FORCE_CURVE, "depth", "force"), (recoveries, RECOVERY, "time", "depth")):
        for duration, rows in shown[shown["motion"] == motion].groupby("duration"):
            color, marker = looks[duration]["color"], looks[duration]["marker"]
            axes.plot(rows[x], rows[y], color=color)
            marked = rows.iloc[:: max(1, len(rows) // SYMBOLS)]
            axes.plot(marked[x], marked["direct"], marker, color=color, markersize=3.5, markerfacecolor="none")
    curves.set(title="(a) loading, unloading, reloading", xlabel="depth $u/h$", ylabel="force $F/(GhL)$")
    recoveries.set(title="(b) after the force is removed", xlabel="time $t/τ$", ylabel="depth $u/h$")
    hollow = {"markersize": 3.5, "markerfacecolor": "none"}
    handles = [style.handle(f"$T/τ = {duration:g}$", **look, **hollow) for duration, look in looks.items()]
    handles += [style.handle("row of springs", color=style.GREY)]
    handles += [style.handle("direct integration", color=style.GREY, marker="o", linestyle="", **hollow)]
    title = f"one disc, $H = {hurst:g}$"
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), title=title)
    return figure
