"""Exponents over the number of elements: is a departure from H/(1 + H) a property of the surface or of the grid?"""

import numpy as np
import pandas as pd

from viscorough.reference import exponent_beta
from viscorough_study.conventions import fits, of_source

FINDINGS = (
    "agrees on the finest grid",
    "departs, and less on finer grids",
    "departs on every grid",
    "undetermined",
)
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
ERROR_MIN = 1e-12  # of an exponent, so that equal curves have a finite weight


def trends(table, conventions, tolerance):
    """Trend of β over the logarithm of the number of elements, for every source and Hurst exponent.

    table : of workflow/scripts/fit_sizes.py; conventions : {convention: value}
    tolerance : of β, that of the claims on β in resources/paper/claims.yaml

    The trend is a line by least squares, weighted by the intervals of β, and its own interval is widened where β
    scatters more than its intervals allow. Where β departs by more than the tolerance on the finest grid, the grid is
    the cause if the whole interval of the slope leads towards the expected exponent.
    Returns a pandas.DataFrame with the columns of `COLUMNS`.
    """
    rows = []
    for name in ("discs", "controls", "lines"):
        wanted = of_source("lines" if name == "lines" else "discs")
        wanted["case_group"] = "controls" if name == "controls" else "sizes"
        for hurst, grids in fits(table, conventions | wanted).groupby("hurst"):
            expected = 0.0 if name == "controls" else exponent_beta(hurst)
            rows.append((name, hurst, *_trend(grids.sort_values("elements"), expected, tolerance)))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _trend(grids, expected, tolerance):
    """Columns of one source and Hurst exponent, from the number of grids on; grids : fits from coarse to fine."""
    slope = _slope(*(grids[name].to_numpy() for name in ("elements", "beta", "beta_low", "beta_high")))
    finest = grids.iloc[-1]
    interval = finest[["beta", "beta_low", "beta_high"]].tolist()
    finding = _finding(np.subtract(interval, expected), slope, tolerance)
    return len(grids), finest["elements"], *interval, expected, *slope, finding


def _slope(elements, beta, low, high):
    """dβ/d log₁₀ n and its 95 % interval; nan for fewer than three grids."""
    if beta.size < 3:
        return (np.nan,) * 3
    error = np.maximum(high - low, ERROR_MIN) / (2 * 1.96)
    x = np.log10(elements)
    (slope, intercept), covariance = np.polyfit(x, beta, 1, w=1 / error, cov="unscaled")
    scatter = np.sum(((beta - np.polyval([slope, intercept], x)) / error) ** 2) / (beta.size - 2)
    half = 1.96 * np.sqrt(covariance[0, 0] * max(scatter, 1.0))
    return slope, slope - half, slope + half


def _finding(departure, slope, tolerance):
    """One of `FINDINGS`; departure, slope : value, low, high."""
    if departure[1] <= tolerance and departure[2] >= -tolerance:
        return FINDINGS[0]
    if not np.isfinite(slope[0]):
        return FINDINGS[3]
    towards_expected = slope[2] < 0 if departure[0] > 0 else slope[1] > 0
    return FINDINGS[1] if towards_expected else FINDINGS[2]
