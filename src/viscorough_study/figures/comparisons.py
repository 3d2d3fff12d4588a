"""Figures beyond the paper: what its open conventions do, and errors against exact solutions."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, LogLocator, MaxNLocator, NullFormatter, NullLocator

from viscorough import reference
from viscorough_study import prefactors
from viscorough_study.figures.style import GREY, MM, PALE, STYLE, WIDE, hurst_looks, mark, plain_ticks
from viscorough_study.tables import fits

CONVENTIONS = {
    "average": {"arithmetic": "arithmetic mean", "geometric": "geometric mean"},
    "rms_convention": {"disc": "$h$ of the disc", "square": "$h$ of the square", "peak": "$h$ of the highest peak"},
    "window_rule": {
        "default": "whole window",
        "lower_half": "lower half of window",
        "upper_half": "upper half of window",
        "kappa": "window of given κ",
    },
    "gamma": {"without": "law without Γ", "with": "law with Γ (Eq. 9)"},
    "diameter_convention": {"diameter": "$L$ the diameter", "radius": "$L$ the radius"},
}

VARIANTS = {
    "longer_period": "longer period",
    "corners": "corners of spectrum",
    "fixed_amplitudes": "fixed amplitudes",
    "roll_off": "roll-off (control)",
}
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")  # told apart with any colour vision (Okabe and Ito)
MARKERS = "osxD+"
LIMIT = {"color": "black", "linewidth": 2, "label": "_limit"}


@rc_context(STYLE)
def plot_conventions(table, shown):
    """β and ζ of the discs, with 95 % intervals, as one convention or the surfaces change; four exponents in a row.

    All axes of a quantity have the same length, in ζ the same ratio of their ends. Raises ValueError without discs.
    """
    table = table[table["source"] == "discs"]
    exponents = sorted(table["hurst"].unique())
    if not exponents:
        raise ValueError("plot_conventions: the table has no discs, it needs some")
    looks, changes = hurst_looks(exponents), _changes(table, shown)
    columns = min(4, len(exponents))
    blocks = -(-len(exponents) // columns)
    figure = Figure(figsize=(WIDE, (2 * blocks * (13 + 4.2 * len(changes)) + 8) * MM))
    grid = figure.subplots(2 * blocks, columns, squeeze=False, sharey=True)
    for axes in grid[-2:, len(exponents) - columns * (blocks - 1) :].flat:
        axes.remove()
    betas, zetas = (list(grid[first::2].flat)[: len(exponents)] for first in (0, 1))
    for hurst, beta, zeta in zip(exponents, betas, zetas, strict=True):
        _changed(beta, "beta", table[table["hurst"] == hurst], changes, looks[hurst])
        _changed(zeta, "zeta", table[table["hurst"] == hurst], changes, looks[hurst])
        beta.axvline(reference.exponent_beta(hurst), color=GREY, linestyle="--", zorder=1)
        zeta.axvline(reference.zeta_viscous(hurst), color=GREY, linestyle="--", zorder=1)
        zeta.axvline(reference.zeta_elastic(hurst), color=GREY, linestyle=":", zorder=1)
        beta.set(title=f"$H={hurst:g}$", xlabel=r"exponent $\beta$")
        zeta.set(xlabel=r"prefactor $\zeta$", xscale="log")
    beta.set(yticks=range(len(changes)), yticklabels=[label for label, _ in changes], ylim=(len(changes) - 0.4, -0.6))
    beta.yaxis.set_minor_locator(NullLocator())
    _same_length(betas)
    _same_length(zetas)
    handles = [
        Line2D([], [], color=GREY, linestyle="--", label="$H/(1+H)$, Eq. 10; $2-H$, Eq. 11 (with Γ)"),
        Line2D([], [], color=GREY, linestyle=":", label=r"$\pi(3-H)/10$, Eq. 4"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    return figure


def _changes(table, shown):
    """Rows of the figure of conventions: (label, {column: value}), first what is shown, then one change each."""
    base = shown | {"case_group": "base"}
    rows = [("as in other figures", base)]
    for column, labels in CONVENTIONS.items():
        others = [value for value in labels if value != shown[column] and value in set(table[column])]
        rows += [(labels[value], base | {column: value}) for value in others]
    groups = [name for name in table["case_group"].unique() if name != "base"]
    return rows + [(VARIANTS.get(name, name.replace("_", " ")), shown | {"case_group": name}) for name in groups]


def _changed(axes, quantity, table, changes, look):
    """One quantity under each change, one row each, on a band that is the interval of the first."""
    for y, (_, wanted) in enumerate(changes):
        face = look["color"] if y == 0 else "white"
        found = fits(table, wanted)
        for value, low, high in found[[quantity, f"{quantity}_low", f"{quantity}_high"]].itertuples(index=False):
            mark(axes, value, y, (low, high), look | {"markerfacecolor": face}, along="x")
            if y == 0 and low < high:
                axes.axvspan(low, high, color="0.93", linewidth=0, zorder=0)
        if found.empty:
            words = {"color": GREY, "backgroundcolor": "white", "ha": "center", "va": "center"}
            axes.text(0.5, y, "no region (b)", transform=axes.get_yaxis_transform(), **words)


def _same_length(panels):
    """Limits of all panels of one length around their middles, with ticks for it."""
    logarithmic = panels[0].get_xscale() == "log"
    limits = np.array([axes.get_xlim() for axes in panels])
    limits = np.log10(limits) if logarithmic else limits
    half = np.ptp(limits, axis=1).max() / 2
    for axes, middle in zip(panels, limits.mean(axis=1), strict=True):
        ends = np.array([middle - half, middle + half])
        axes.set_xlim(10**ends if logarithmic else ends)
        if logarithmic:
            axes.xaxis.set(major_locator=FixedLocator([0.1, 0.2, 0.5, 1, 2, 5, 10]), major_formatter="{x:g}")
            axes.xaxis.set(minor_locator=LogLocator(subs=range(1, 10)), minor_formatter=NullFormatter())
        else:
            axes.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))


@rc_context(STYLE)
def plot_validation(table):
    """Relative errors against exact solutions over the elements across the body, one panel for each quantity.

    table : of validate_solvers. Observed orders stand in the panels; the black bar is the limit on the finest grid
    """
    quantities, cases = table["quantity"].unique(), table["case"].unique()
    looks, grids = _case_looks(cases), sorted(table["elements"].unique())
    columns = min(4, len(quantities))
    rows = -(-len(quantities) // columns)
    figure = Figure(figsize=(WIDE, (52 * rows + 22) * MM))
    grid = figure.subplots(rows, columns, squeeze=False)
    for axes in grid.flat[len(quantities) :]:
        axes.remove()
    for axes, quantity in zip(grid.flat, quantities, strict=False):
        errors = table[table["quantity"] == quantity]
        for case, one in errors.groupby("case", sort=False):
            order, passed = one[["order", "passed"]].iloc[-1]
            notes = ([] if np.isnan(order) else [f"{order:.1f}"]) + ([] if passed else ["failed"])
            axes.plot(one["elements"], one["error"], **looks[case], label=", ".join(notes) or f"_{case}")
        limit = errors["limit"].iloc[0]
        axes.plot([grids[-1] / 1.2, grids[-1] * 1.2], [limit, limit], **LIMIT)
        drawn = np.log10([*errors["error"], limit])
        ends = 10.0 ** np.array([np.floor(drawn.min() - 0.1), np.ceil(drawn.max() + 0.1)])
        order = errors["expected_order"].iloc[0]
        expected = rf"expected $\propto n^{{-{order:g}}}$" if order else "exact"
        axes.set(xscale="log", yscale="log", ylim=ends, title=f"{quantity.replace('_', ' ')}\n{expected}")
        axes.xaxis.set(major_locator=FixedLocator(grids), minor_locator=NullLocator(), major_formatter="{x:g}")
        axes.yaxis.set_minor_formatter(NullFormatter())
        if noted := axes.get_legend_handles_labels()[0]:
            if len(noted) > 2:  # room above the curves, that the orders do not lie on them
                axes.set_ylim(top=ends[1] * (10 if len(noted) < 5 else 30))
            axes.legend(title="order", ncols=1 + (len(noted) > 2), columnspacing=1)
    for axes in grid[:, 0]:
        axes.set_ylabel("relative error")
    for axes in grid[-1]:
        axes.set_xlabel("elements across, $n$")
    handles = [Line2D([], [], **looks[case], label=case.replace("_", " ")) for case in cases]
    handles.append(Line2D([], [], **LIMIT | {"label": "limit on the finest grid"}))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure


def _case_looks(cases):
    """Looks of cases named by body and method: the body has colour and line style, the method the marker."""
    named = [case.partition("_")[::2] for case in cases]
    bodies, methods = (list(dict.fromkeys(names)) for names in zip(*named, strict=True))
    return {
        case: {
            "color": COLORS[bodies.index(body) % len(COLORS)],
            "linestyle": ("-", "--")[bodies.index(body) % 2],
            "marker": MARKERS[methods.index(method) % len(MARKERS)],
            "markerfacecolor": "none",
        }
        for case, (body, method) in zip(cases, named, strict=True)
    }


@rc_context(STYLE)
def plot_prefactors(table, shown):
    """ζ over each of the paper's two laws for it, over H, under every combination of conventions.

    table : of prefactors; shown : conventions of the figures. Raises ValueError for a table without rows.
    """
    if table.empty:
        raise ValueError("plot_prefactors: the table has no rows; at least one is needed")
    figure = Figure(figsize=(WIDE, 115 * MM))
    panels = figure.subplots(1, 2, sharey=True)
    laws = {"eq4": r"$\zeta\;/\;[\pi(3-H)/10]$, Eq. 4", "eq11": r"$\zeta\;/\;(2-H)$, Eq. 11"}
    for axes, (law, label) in zip(panels, laws.items(), strict=True):
        for conventions in prefactors.combinations(table):
            rows = prefactors.rows_of(table, conventions)
            axes.plot(rows["hurst"], rows[law], color=PALE, linewidth=0.5, zorder=1)
        axes.axhline(1, color="black", linewidth=0.8, linestyle="--", zorder=2)
        marked = {"as in other figures": (shown | {"factor": 1}, COLORS[0], "o")}
        if (best := prefactors.nearest(table, law)) is not None:
            marked[_in_words(best)] = (best, COLORS[1], "s")
        for name, (conventions, color, marker) in marked.items():
            rows = prefactors.rows_of(table, conventions)
            scale = rows[law] / rows["zeta"]
            ends = np.abs([rows["zeta_low"] * scale - rows[law], rows["zeta_high"] * scale - rows[law]])
            axes.errorbar(rows["hurst"], rows[law], ends, color=color, marker=marker, label=name, zorder=3)
        axes.plot([], [], color=PALE, label="every other combination")
        axes.set(title=label, xlabel="Hurst exponent $H$ [1]", yscale="log", xlim=(0, 1))
        plain_ticks(axes.yaxis, [0.2, 0.5, 1, 2, 5])
        axes.legend(loc="upper left", bbox_to_anchor=(-0.05, -0.14), fontsize=7)
    panels[0].set_ylabel(r"$\zeta$ over the law [1]")
    return figure


def _in_words(conventions):
    """Conventions in the words of the figures."""
    words = [CONVENTIONS[name][value] for name, value in conventions.items() if name != "factor"]
    words += [] if conventions["factor"] == 1 else [f"factor {conventions['factor']:g} in $F$ or $1/G$"]
    lines = [", ".join(words[start : start + 2]) for start in range(0, len(words), 2)]
    return "nearest: " + ",\n".join(lines)


@rc_context(STYLE)
def plot_reduction(table):
    """Lines over the discs whose spectra they have, over X: κ (a), contact fraction (b), correlation (c).

    table : of viscorough_study.mdr_comparison. Raises ValueError for a table without rows.
    """
    if table.empty:
        raise ValueError("plot_reduction: the table has no rows; at least one is needed")
    figure = Figure(figsize=(WIDE, 75 * MM))
    stiffness, area, correlation = figure.subplots(1, 3, sharex=True)
    looks = hurst_looks(table["hurst"])
    for hurst, rows in table.groupby("hurst"):
        look = {"color": looks[hurst]["color"], "linestyle": looks[hurst]["linestyle"]}
        scatter = np.exp(rows["stiffness_scatter"])
        band = rows["stiffness_ratio"] / scatter, rows["stiffness_ratio"] * scatter
        stiffness.fill_between(rows["x"], *band, color=look["color"], alpha=0.12, linewidth=0)
        stiffness.plot(rows["x"], rows["stiffness_ratio"], **look, label=f"$H={hurst:g}$")
        area.plot(rows["x"], rows["area_ratio"], **look)
        correlation.plot(rows["x"], rows["correlation"], **look)
    for axes, title, label in (
        (stiffness, "(a) stiffness", r"$\kappa$ of line over disc [1]"),
        (area, "(b) contact fraction", "contact fraction of line over disc [1]"),
        (correlation, "(c) realization by realization", r"correlation of $\ln\kappa$ [1]"),
    ):
        axes.set(title=title, xlabel="$X=F/(4GhL)$ [1]", ylabel=label, xscale="log")
        axes.axhline(0 if axes is correlation else 1, color=GREY, linewidth=0.6)
    for axes in (stiffness, area):
        axes.set_yscale("log")
        plain_ticks(axes.yaxis, [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500])
    correlation.set_ylim(-1, 1)
    figure.legend(loc="outside lower center", ncols=len(looks))
    return figure


@rc_context(STYLE)
def plot_direct(table):
    """Depth of direct integrations over the elastic depth, and over it by Eq. 8, against the elements in contact.

    table : of viscorough_study.gamma_factor. Raises ValueError for a table without rows.
    """
    if table.empty:
        raise ValueError("plot_direct: the table has no rows; at least one is needed")
    figure = Figure(figsize=(WIDE, 80 * MM))
    axes = figure.subplots()
    colors = ("#000000", "#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00", "#cc79a7")
    for rank, (case, part) in enumerate(table.groupby("case", sort=False)):
        color = colors[rank % len(colors)]
        axes.semilogx(part["contact_count"], part["depth_ratio"], MARKERS[rank % len(MARKERS)], color=color, label=case)
        axes.axhline(part["with_gamma"].iloc[0], color=color, linestyle="--", linewidth=0.8)
    axes.axhline(1, color=GREY, linewidth=0.8)
    axes.plot([], [], color=GREY, linestyle="--", label=r"with the factor $1/\Gamma(2-\alpha)$, Eq. 8")
    axes.set(xlabel="elements in contact [1]", ylabel="viscous depth over elastic depth [1]")
    figure.legend(loc="outside right upper")
    return figure
