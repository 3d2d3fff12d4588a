"""Draw the exponent β against the number of elements, on grids from coarse to fine."""

from viscorough.reference import exponent_beta
from viscorough_study.figures import style
from viscorough_study.fits.conventions import FITTED, fits

CONTROL = {"color": style.GREY, "marker": "x", "linestyle": ""}


@style.figure
def plot_sizes(table, conventions):
    """Draw the exponent β against the number of elements, for discs (a, c) and for MDR lines (b, d).

    In (a) and (b), β is fitted in region (b); in (c) and (d), in a fixed window of X. If the table contains several
    fixed windows, the figure shows the window with the largest X. Colours distinguish Hurst exponents. Dotted lines are
    H/(1 + H), Eq. 10. Crosses are controls: discs whose spectrum has a roll-off.
    table : table of fits.fit_table.sizes_table; conventions : {column of this table: value}
    """
    fixed = table[~table["window_rule"].isin(FITTED["window_rule"])].sort_values("x_low", kind="stable")
    rules = [conventions["window_rule"], *fixed["window_rule"].tail(1)]
    figure, panels = style.new_subplots(25 + 60 * len(rules), len(rules), 2, sharex="col", sharey=True, squeeze=False)
    looks = style.hurst_looks(table.loc[table["case_group"] == "sizes", "hurst"])
    letters = iter("abcd")
    for row, rule in zip(panels, rules, strict=True):
        window = "region (b)" if rule == conventions["window_rule"] else rule.replace("X =", "$X$ =")
        for axes, source, name in zip(row, ("discs", "lines"), ("boundary elements", "MDR"), strict=True):
            _panel(axes, table, conventions | {"window_rule": rule}, source, looks)
            numbers = table.loc[(table["source"] == source) & (table["case_group"] == "sizes"), "realizations"]
            realizations = f"{style.count_text(numbers)} {source}" if len(numbers) else source
            axes.set_title(f"({next(letters)}) {name}, {realizations}, {window}")
        row[0].set_ylabel(r"exponent $\beta$")
    handles = [*style.hurst_handles(looks, linestyle=""), style.handle("control, roll-off", **CONTROL)]
    handles.append(style.handle("$H/(1+H)$, Eq. 10", color=style.GREY, linestyle=":", linewidth=0.8))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def _panel(axes, table, conventions, source, looks):
    """Draw β of the discs or of the lines, as fitted in the range of X `conventions["window_rule"]`.

    source : "discs" or "lines"; looks : {H: line properties}
    """
    own_rms = {"rms_convention": "line"} if source == "lines" else {}
    for rank, (hurst, look) in enumerate(looks.items()):
        rows = fits(table, conventions | own_rms, source=source, case_group="sizes", hurst=hurst)
        axes.axhline(exponent_beta(hurst), color=look["color"], linestyle=":", linewidth=0.8)
        for row in rows.sort_values("elements").itertuples():
            # Shift the markers of different H, so that their intervals do not overlap.
            shifted = row.elements * 1.06 ** (rank - len(looks) / 2)
            style.mark_with_interval(axes, shifted, row.beta, (row.beta_low, row.beta_high), look)
    if source == "discs":
        for row in fits(table, conventions, source="discs", case_group="controls").itertuples():
            style.mark_with_interval(axes, row.elements, row.beta, (row.beta_low, row.beta_high), CONTROL)
    label = "elements of a disc" if source == "discs" else "points of a line"
    axes.set(xscale="log", xlabel=label, ylim=(-0.05, 0.7))
