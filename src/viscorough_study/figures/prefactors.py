"""Ratio of the prefactor ζ to the paper's two laws, for combinations of conventions ranked by their deviation."""

from matplotlib.patches import Patch

from viscorough_study.figures import style
from viscorough_study.fits import prefactors
from viscorough_study.fits.conventions import left_open

LAWS = {"eq4": r"(a) $\zeta$ over $\pi(3-H)/10$, Eq. 4", "eq11": r"(b) $\zeta$ over $2-H$, Eq. 11"}
NEAREST = 6  # combinations drawn one by one
AGREEMENT = 1.1  # factor within which ζ agrees with a law, the grey band
SHORT = {
    "rms_convention": {"disc": "$h$ disc", "square": "$h$ square", "peak": "$h$ peak", "ensemble": "$h$ ensemble"},
    "average": {"arithmetic": "arithmetic", "geometric": "geometric"},
    "window_rule": {
        "default": "whole window",
        "lower_half": "lower half",
        "upper_half": "upper half",
        "kappa": "window of κ",
    },
    "gamma": {"without": "no Γ", "with": "Γ"},
}


@style.in_style
def plot_prefactors(table, conventions):
    """ζ over each of the paper's two laws: the nearest combinations of conventions, that of the other figures, and all.

    table : of viscorough_study.fits.prefactors; conventions : those of the other figures, {column: value}
    Rows are ranked by the largest deviation over all Hurst exponents, among the combinations that the paper leaves
    open; below them is the nearest of those that contradict it. Raises ValueError for a table without rows.
    """
    style.require_rows("plot_prefactors", table)
    looks = style.hurst_looks(table["hurst"])
    figure = style.new_figure(165)
    panels = figure.subplots(2, 1, sharex=True)
    for axes, (law, title) in zip(panels, LAWS.items(), strict=True):
        _draw_law(axes, table, law, {"case_group": "base"} | conventions, looks)
        axes.set(title=title, xscale="log")
        style.plain_ticks(axes.xaxis, [0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5])
    panels[1].set_xlabel(r"$\zeta$ over the law")
    handles = [
        *style.hurst_handles(looks, linestyle=""),
        style.handle("agreement with the law", color=style.BLACK, linestyle="--"),
        Patch(color="0.92", label="to within a factor of 1.1"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=6, columnspacing=1)
    return figure


def _draw_law(axes, table, law, figure_combination, looks):
    """Panel of one law: rows of the nearest combinations, of that of the other figures, and of all combinations."""
    open_rows = left_open(table)
    ranking = prefactors.ranked(open_rows, law)
    rows = [(f"{_words(table, nearest)}   {rank}", nearest) for rank, nearest in enumerate(ranking[:NEAREST], 1)]
    own = f", rank {ranking.index(figure_combination) + 1}" if figure_combination in ranking else ""
    rows.append((f"as in the other figures{own}:\n{_words(table, figure_combination)}", figure_combination))
    if contradicting := prefactors.ranked(table.drop(open_rows.index), law):
        words = _words(table, contradicting[0])
        rows.append((f"$L$ the radius (contradicts the paper), nearest:\n{words}", contradicting[0]))
    axes.axvspan(1 / AGREEMENT, AGREEMENT, color="0.92", linewidth=0, zorder=0)
    axes.axvline(1, color=style.BLACK, linestyle="--", linewidth=0.8, zorder=1)
    for y, (_, combination) in enumerate(rows):
        _draw_combination(axes, y, prefactors.combination_rows(table, combination), law, looks)
    for rank, (hurst, look) in enumerate(looks.items()):
        values = open_rows.loc[open_rows["hurst"] == hurst, law]
        height = [len(rows) + _shift(rank, looks)] * len(values)
        axes.plot(values, height, **look | {"linestyle": "", "marker": "|", "markersize": 4.5, "alpha": 0.6})
    for y in range(min(NEAREST, len(ranking)), len(rows) + 1):
        axes.axhline(y - 0.5, color=style.GREY, linewidth=0.5)
    labels = [label for label, _ in rows] + [f"all {len(prefactors.combinations(open_rows))} combinations left open"]
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(len(labels) - 0.5, -0.6)
    axes.tick_params(axis="y", which="both", length=0)


def _draw_combination(axes, y, rows, law, looks):
    """ζ over the law under one combination, with its interval, for each Hurst exponent."""
    for row in rows.dropna(subset="zeta").itertuples():
        scale = getattr(row, law) / row.zeta
        interval = row.zeta_low * scale, row.zeta_high * scale
        place = y + _shift(list(looks).index(row.hurst), looks)
        look = looks[row.hurst] | {"markersize": 3.5}
        style.mark_with_interval(axes, row.zeta * scale, place, interval, look, along="x")


def _shift(rank, looks):
    """Vertical offset of a Hurst exponent within a row, which keeps intervals apart."""
    return 0.8 * ((rank + 0.5) / len(looks) - 0.5)


def _words(table, combination):
    """Label of a combination; it names the surfaces only where they differ from the base case."""
    words = [labels[combination[name]] for name, labels in SHORT.items()]
    surfaces = table.loc[table["case_group"] == combination["case_group"], ["period", "corners", "amplitudes"]].iloc[0]
    base = table.loc[table["case_group"] == "base", ["period", "corners", "amplitudes"]].iloc[0]
    labels = {
        "period": f"period {surfaces['period']:g}",
        "corners": "corners" if surfaces["corners"] == "yes" else "no corners",
        "amplitudes": f"{surfaces['amplitudes']} amplitudes",
    }
    return ", ".join(words + [label for name, label in labels.items() if surfaces[name] != base[name]])
