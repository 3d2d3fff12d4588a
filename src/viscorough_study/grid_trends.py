"""Exponents over the number of elements: is a departure from H/(1 + H) that of the surface, or of the grid?"""

import numpy as np
import pandas as pd

from viscorough.reference import exponent_beta
from viscorough_study.tables import fits

AGREES = 0.03  # as the verdicts on β allow
FINDINGS = ("agrees on the finest grid", "departs, and less on finer grids", "departs on every grid", "untold")
COLUMNS = {
    "source": ("discs by boundary elements, lines by the MDR, controls: discs whose spectrum has a roll-off", ""),
    "hurst": ("Hurst exponent", "1"),
    "grids": ("grids that have a region (b)", "1"),
    "elements": ("elements of the finest grid", "1"),
    "beta": ("exponent of region (b) on the finest grid", "1"),
    "beta_low": ("lower end of its 95 % interval", "1"),
    "beta_high": ("upper end of its 95 % interval", "1"),
    "expected": ("H/(1 + H), Eq. 10; 0 for controls", "1"),
    "slope": ("change of the exponent per decade of elements", "1"),
    "slope_low": ("lower end of its 95 % interval", "1"),
    "slope_high": ("upper end of its 95 % interval", "1"),
    "finding": ("one of: " + "; ".join(FINDINGS), ""),
}


def trends(table, shown):
    """Trend of β over the logarithm of the number of elements, for every source and Hurst exponent.

    table : that of fit_sizes; shown : conventions, {column: value}. Least squares, weighted by the intervals, which are
    taken wider where β scatters more than they say.

    Returns a pandas.DataFrame with the columns of `COLUMNS`. What departs by more than `AGREES` on the finest grid does
    so for the grid's sake if the slope leads towards the expected exponent with its whole interval.
    """
    rows = []
    for source in ("discs", "controls", "lines"):
        convention = {"rms_convention": "line"} if source == "lines" else {}
        about = {"source": "lines" if source == "lines" else "discs"}
        about["case_group"] = "controls" if source == "controls" else "sizes"
        for hurst, each in fits(table, shown | convention, **about).groupby("hurst"):
            each = each.sort_values("elements")
            expected = 0.0 if source == "controls" else exponent_beta(hurst)
            slope = _slope(*(each[name].to_numpy() for name in ("elements", "beta", "beta_low", "beta_high")))
            finest = each.iloc[-1]
            interval = finest[["beta", "beta_low", "beta_high"]].tolist()
            finding = _finding(*np.subtract(interval, expected), *slope)
            rows.append((source, hurst, len(each), finest["elements"], *interval, expected, *slope, finding))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _slope(elements, beta, low, high):
    """dβ/d log₁₀ n and its 95 % interval; nan for fewer than three grids."""
    if beta.size < 3:
        return (np.nan,) * 3
    error = np.maximum(high - low, 1e-12) / (2 * 1.96)
    x = np.log10(elements)
    (slope, _), covariance = np.polyfit(x, beta, 1, w=1 / error, cov="unscaled")
    scatter = np.sum(((beta - np.polyval(np.polyfit(x, beta, 1, w=1 / error), x)) / error) ** 2) / (beta.size - 2)
    half = 1.96 * np.sqrt(covariance[0, 0] * max(scatter, 1.0))
    return slope, slope - half, slope + half


def _finding(departure, low, high, slope, slope_low, slope_high):
    if low <= AGREES and high >= -AGREES:
        return FINDINGS[0]
    if not np.isfinite(slope):
        return FINDINGS[3]
    towards = slope_high < 0 if departure > 0 else slope_low > 0
    return FINDINGS[1] if towards else FINDINGS[2]
