"""Exponents over the number of elements: whether a deviation from H/(1 + H) is due to the grid or to the window.

The window of region (b) moves with the grid: a finer grid resolves smaller X. In windows of fixed X only the grid
changes. A deviation that becomes smaller in the moving window but not in the fixed ones depends on the X of the window,
not on the grid.
"""

from itertools import product

import numpy as np
import pandas as pd

from viscorough.reference import exponent_beta
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits import fit_table
from viscorough_study.fits.conventions import FITTED, fits, source_values
from viscorough_study.fits.intervals import UNDEFINED, described, equivalence, interval, line_slope, three_columns
from viscorough_study.fits.power_law import fit_power_law, in_window

FINDINGS = (
    "agrees on the finest grid",
    "departs, and less on finer grids",
    "departs on every grid",
    "undetermined",
)
COLUMNS = {
    "source": ("discs by boundary elements, lines by the MDR, controls: discs whose spectrum has a roll-off", ""),
    "window_rule": ("rule of the window, which moves with the grid, or its fixed ends in X", ""),
    "hurst": ("Hurst exponent", "1"),
    "grids": ("grids that have a fit in this window", "1"),
    "elements": ("elements of the finest grid", "1"),
    **described("beta", "exponent in this window on the finest grid"),
    "expected": ("H/(1 + H), Eq. 10; 0 for controls", "1"),
    **described("slope", "change of the exponent per decade of elements"),
    "finding": ("one of: " + "; ".join(FINDINGS), ""),
}
SIZES = fit_table.COLUMNS | {"elements": ("elements of an indenter: of a disc, points of a line", "1")}
ERROR_MIN = 1e-12  # lower limit of the error of an exponent, which keeps weights finite


def sizes_tables(discs, lines, *, seed, fit, windows, conventions, tolerance):
    """{"sizes", "sizes_trends": table} of ensembles on grids from coarse to fine, with `SIZES` and `COLUMNS`.

    Every ensemble is fitted separately, in the windows of region (b) and in those of fixed X.
    discs, lines : pools; seed, fit : further arguments of fit_table.fit_rows; windows : [(X_low, X_high)]
    conventions : those of the figures; tolerance : of the exponents
    """
    fixed = {name: fit[name] for name in ("elements_min", "fraction_min", "resamples")} | {"seed": seed}
    fixed |= {name: conventions[name] for name in ("average", "rms_convention")}
    rows = []
    for source, group, pool in (("discs", "sizes", discs), ("discs", "controls", discs), ("lines", "sizes", lines)):
        labels = {"source": source, "case_group": group}
        for ensemble in ensembles(select(pool, group=group), "hurst", "elements").values():
            fitted = fit_table.fit_rows(ensemble, **labels, seed=seed, **fit)
            fitted += fixed_window_rows(ensemble, windows, labels, **fixed)
            rows += [row | {"elements": ensemble["elements"].item()} for row in fitted]
    table = pd.DataFrame(rows, columns=list(SIZES))
    return {"sizes": table, "sizes_trends": trends(table, conventions, tolerance)}


def trends(table, conventions, tolerance):
    """Trend of β over the logarithm of the number of elements, for every source and Hurst exponent.

    table : sizes, of `sizes_tables`; conventions : {convention: value}, with the window_rule of the windows that move
        with the grid; the fixed windows of the table are added
    tolerance : of β, that of the claims on β in resources/paper/claims.yaml

    The trend is a least-squares line weighted by the number of realizations, whose scatter is pooled over the grids;
    its interval is widened where β scatters more than they explain. On the finest grid β agrees if its whole interval
    lies within the tolerance of the expected exponent, departs if it lies outside, and is undetermined otherwise. A
    departure is less on finer grids if the whole interval of the slope points towards the expected exponent.
    Returns a pandas.DataFrame with the columns of `COLUMNS`.
    """
    rows = []
    for name, rule in product(("discs", "controls", "lines"), [conventions["window_rule"], *fixed_rules(table)]):
        wanted = source_values("lines" if name == "lines" else "discs") | {"window_rule": rule}
        wanted["case_group"] = "controls" if name == "controls" else "sizes"
        for hurst, grids in fits(table, conventions | wanted).groupby("hurst"):
            expected = 0.0 if name == "controls" else exponent_beta(hurst)
            rows.append((name, rule, hurst, *_trend(grids.sort_values("elements"), expected, tolerance)))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def fixed_rules(table):
    """Names of the windows of fixed X in a table of fits, from small X to large."""
    fixed = table[~table["window_rule"].isin(FITTED["window_rule"])]
    return list(dict.fromkeys(fixed.sort_values("x_low", kind="stable")["window_rule"]))


def fixed_window_rows(ensemble, windows, labels, *, average, rms_convention, elements_min, fraction_min, **bootstrap):
    """Fits (dicts) of an ensemble in windows of fixed X, named by their ends.

    windows : [(X_low, X_high)]; labels : source and case_group; bootstrap : resamples and seed
    A window is skipped unless the median number of elements in contact at its lower end is at least elements_min, as in
    region (b), and at least the fraction fraction_min of the realizations is defined throughout.
    """
    convention = source_values(labels["source"]).get("rms_convention", rms_convention)
    selected, x, rows = ensemble.sel(rms_convention=convention), ensemble["x"].values, []
    for low, high in windows:
        inside = in_window(x, (low, high))
        enough = selected["contact_count_median"].values[inside][:1] >= elements_min
        if not (enough.all() and (selected["fraction_defined"].values[inside] >= fraction_min).all()):
            continue
        fit = fit_power_law(x, selected["velocity"].values, (low, high), average=average, **bootstrap)
        row = labels | {"hurst": ensemble["hurst"].item(), "rms_convention": convention, "average": average}
        row |= {"window_rule": f"X = {low:g} to {high:g}", "x_low": low, "x_high": high}
        row |= {"decades": np.log10(high / low), "realizations": selected.sizes["realization"]}
        row |= three_columns("beta", (fit.beta, *fit.beta_interval))
        rows.append(row | {"zeta": fit.zeta()[0], "residual": fit.residual})
    return rows


def _trend(grids, expected, tolerance):
    """Columns of one source and Hurst exponent, from the number of grids on; grids : fits from coarse to fine."""
    slope = _slope(*(grids[name].to_numpy() for name in ("elements", "beta", "beta_low", "beta_high", "realizations")))
    finest = grids.iloc[-1]
    beta = interval(finest, "beta")
    finding = _finding(np.subtract(beta, expected), slope, tolerance)
    return len(grids), finest["elements"], *beta, expected, *slope, finding


def _slope(elements, beta, low, high, realizations):
    """dβ/d log₁₀ n and its 95 % interval; nan for fewer than three grids.

    The scatter of a realization is pooled over the grids: a bootstrap of a few discs is often far too narrow.
    """
    if beta.size < 3:
        return UNDEFINED
    variance = realizations * ((high - low) / (2 * 1.96)) ** 2
    pooled = np.sum((realizations - 1) * variance) / max(np.sum(realizations - 1), 1)
    error = np.maximum(np.sqrt(pooled / realizations), ERROR_MIN)
    slope, slope_error = line_slope(np.log10(elements), beta, error)
    return slope, slope - 1.96 * slope_error, slope + 1.96 * slope_error


def _finding(departure, slope, tolerance):
    """One of `FINDINGS`; departure, slope : value, low, high."""
    agrees = equivalence(departure[1:], -tolerance, tolerance)
    if agrees:
        return FINDINGS[0]
    if agrees is None or not np.isfinite(slope[0]):
        return FINDINGS[3]
    towards_expected = slope[2] < 0 if departure[0] > 0 else slope[1] > 0
    return FINDINGS[1] if towards_expected else FINDINGS[2]
