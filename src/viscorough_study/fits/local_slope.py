"""Measure how straight the curves are in region (b), where the paper calls them nearly linear in logarithmic axes.

The local slope d ln(vt/h)/d ln X, with X = F/(4GhL), is constant on a straight line. It is the slope of a line that is
fitted over a fixed width in X, and all data of the fit lie in region (b). The measure is half the spread of the local
slopes in this region. Region (b) spans one to two decades, which is too short to tell a power law from a bend: curves
without a power law, such as the curves of discs without long waves, may be nearly linear there as well.
"""

import logging

import numpy as np
import pandas as pd

from viscorough_study.ensembles.averages import ROUNDING
from viscorough_study.ensembles.pool import ensembles
from viscorough_study.fits.intervals import (
    UNDEFINED,
    described,
    described_ends,
    resampled_means,
    three_columns,
    with_interval,
)
from viscorough_study.fits.power_law import find_region, in_window, inner_slopes
from viscorough_study.run.seeds import local_slope_key, realization_seed

COLUMNS = {
    "group": ("base, longer_period, or name of the control, which has no power law", None),
    "hurst": ("Hurst exponent H", "1"),
    "realizations": ("realizations in the ensemble", "1"),
    **described_ends("x", "of region (b) in X = F/(4GhL), missing where there is none"),
    **described("half_spread", "half the spread of the local slopes d ln(vt/h)/d ln X within region (b)"),
    "line_residual": ("root mean square of ln(vt/h) less a straight line over ln X in region (b)", "1"),
}
# Smallest number of windows of the local slope, side by side, in region (b). In a shorter region, nearly all slopes are
# fitted to the same data, and their spread is small for any curve.
FEWEST_WINDOWS = 2


def local_slope_table(discs, *, groups, region, resamples, seed):
    """Measure the spread of the local slope within region (b); return a pandas.DataFrame with the columns `COLUMNS`.

    discs : pool of loading curves (viscorough_study.ensembles.pool)
    groups : {group of discs: definition of the rms height h}; groups that the pool does not have are omitted
    region : limits of region (b), arguments of viscorough_study.fits.power_law.find_region. Its `slope_half_width`, in
        decades of X, is also half the width over which local slopes are fitted
    resamples, seed : number of bootstrap samples, and root of their seeds
    """
    rows, half_width = [], region["slope_half_width"] * np.log(10)
    for group, rms_convention in groups.items():
        pooled = ensembles(discs, "group", "hurst", rms_convention=rms_convention)
        for hurst, ensemble in sorted((h, ensemble) for (name, h), ensemble in pooled.items() if name == group):
            logging.info("%s, H = %g", group, hurst)
            random = np.random.default_rng(realization_seed(seed, *local_slope_key(hurst, group)))
            options = {"half_width": half_width, "resamples": resamples, "random": random}
            measured = straightness(ensemble, find_region(ensemble, **region), **options)
            rows.append({"group": group, "hurst": hurst, **measured})
    return pd.DataFrame(rows, columns=list(COLUMNS))


def straightness(ensemble, region, *, half_width, resamples, random):
    """Return half the spread of the local slopes within region (b), and the misfit of a line, as {column: value}.

    The spread is the largest slope minus the smallest slope of the geometric mean over the realizations. It is nan if
    region (b) is shorter than `FEWEST_WINDOWS` windows. Realizations that end within the region are omitted.

    ensemble : ensemble dataset (ensembles.averages) with a single definition of the rms height
    region : ends (X_low, X_high) of region (b), or None if there is no region (b)
    half_width : a local slope is fitted to the points within ± half_width in ln X
    resamples, random : number of bootstrap samples, and numpy.random.Generator
    """
    row = {"realizations": ensemble.sizes["realization"], **three_columns("half_spread", UNDEFINED)}
    if region is None:
        return row
    row |= {"x_low": region[0], "x_high": region[1]}
    inside = in_window(ensemble["x"].values, region)
    log_x, log_y = np.log(ensemble["x"].values[inside]), np.log(ensemble["velocity"].values[:, inside])
    means = resampled_means(log_y[np.isfinite(log_y).all(axis=1)], resamples, random)
    line = np.polynomial.Polynomial.fit(log_x, means[0], 1)
    row["line_residual"] = np.sqrt(np.mean((means[0] - line(log_x)) ** 2))
    if np.log(region[1] / region[0]) < FEWEST_WINDOWS * 2 * half_width * (1 - ROUNDING):
        return row
    _, slopes = inner_slopes(log_x, means, half_width)
    return row | three_columns("half_spread", with_interval(np.ptp(slopes, axis=1) / 2, len(log_y)))
