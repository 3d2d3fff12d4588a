"""Test curves for a power law, by two tests of the local slope d ln y/d ln X, which must be constant.

1. Within region (b): half the spread of the local slopes, from the smallest to the largest. The paper calls the curves
   nearly linear there.
2. Without a region: the decades of X over which all local slopes lie within ± the tolerance of their mid-range. Every
   curve with slopes that increase at both ends has a flat piece in between, so this test is about its length.

Local slopes are slopes of straight lines over fixed widths, so the tested property does not choose the window.

The control has a spectrum without long waves, hence no power law. A test that the control passes cannot distinguish a
power law from a bend. The error rates of the second test, the fractions of power laws that fail it and of curves like
the control that pass it, are estimated from synthetic ensembles with the scatter of the real realizations.
"""

import logging
from dataclasses import dataclass

import numpy as np
import pandas as pd

from viscorough_study.ensembles.pool import ensembles
from viscorough_study.fits.intervals import described, resampled_means, three_columns, with_interval
from viscorough_study.fits.power_law import ROUNDING, find_region, in_window, local_slopes
from viscorough_study.run.seeds import plateau_key, realization_seed

COLUMNS = {
    "case_group": ("base or name of the control, which has no power law", None),
    "hurst": ("Hurst exponent H", "1"),
    "realizations": ("realizations in the ensemble", "1"),
    **described("decades", "decades of X over which the local slope is constant within the tolerance"),
    "power_law_passes": ("share of synthetic power laws with the scatter of this ensemble that pass the test", "1"),
    "power_law_fails": ("share of them that fail it", "1"),
    "control_passes": ("share that pass of ensembles with the mean curve of the control", "1"),
    **described("half_spread", "half the spread of the local slopes within region (b)"),
    "region_decades": ("decades of X in region (b), 0 where there is none", "1"),
}
RESAMPLES_OF_DRAWS = 100  # bootstrap samples of each synthetic ensemble


def inner_slopes(log_x, log_y, half_width):
    """Return abscissae with points over the whole width of `local_slopes`, and the slopes there.

    log_x : ln X, equally spaced, shape (abscissae,); log_y : ln y, shape (curves, abscissae), without nan
    Returns arrays of shapes (inner,) and (curves, inner). Raises ValueError if there is no such abscissa.
    """
    reach = int(half_width / (log_x[1] - log_x[0]) + ROUNDING)
    if reach < 1 or log_x.size <= 2 * reach:
        raise ValueError(f"inner_slopes: {log_x.size} abscissae are too few for lines of {2 * reach + 1} points")
    return log_x[reach:-reach], local_slopes(log_x, log_y, half_width)[:, reach:-reach]


def longest_plateau(slopes, tolerance):
    """Return the number of steps of the longest run of slopes within ± tolerance of their mid-range, by curve.

    slopes : shape (curves, abscissae); returns an array of shape (curves,); a run of n + 1 slopes has n steps
    """
    steps = np.zeros(len(slopes), dtype=int)
    least, largest = slopes, slopes
    for length in range(1, slopes.shape[1]):
        least = np.minimum(least[:, :-1], slopes[:, length:])
        largest = np.maximum(largest[:, :-1], slopes[:, length:])
        reached = (largest - least <= 2 * tolerance).any(axis=1)
        if not reached.any():
            break
        steps[reached] = length
    return steps


def plateau(log_x, log_y, *, half_width, tolerance, resamples, random):
    """Measure the plateau of the mean over realizations, with 95 % bootstrap intervals.

    log_x, log_y, half_width : as in `inner_slopes`, log_y for the realizations; random : numpy.random.Generator
    Returns a dict: decades, decades_low, decades_high.

    A resample has twice the variance of the mean, and scatter shortens plateaus, so the interval is biased to low
    values. Few curves without a power law pass, but some power laws with large scatter fail; `shares` gives the rates.
    """
    inner, slopes = inner_slopes(log_x, resampled_means(log_y, resamples, random), half_width)
    step = (inner[1] - inner[0]) / np.log(10)
    return three_columns("decades", with_interval(longest_plateau(slopes, tolerance) * step, len(log_y)))


def shares(log_x, mean, residuals, *, draws, decades_min, random, **options):
    """Return the fractions of synthetic ensembles that pass and that fail: (passed, failed).

    An ensemble passes if the whole interval of the decades is at least decades_min, and fails if it is below.
    mean : ln y of the curve common to all ensembles, shape (abscissae,)
    residuals : ln y of realizations less their mean, shape (realizations, abscissae); every ensemble draws the same
        number with replacement, so it has the real scatter and the real correlation along X
    draws : number of ensembles;
    options : further arguments of `plateau`
    """
    drawn = (residuals[random.integers(len(residuals), size=len(residuals))] for _ in range(draws))
    found = pd.DataFrame([plateau(log_x, mean + scatter, random=random, **options) for scatter in drawn])
    needed = decades_min * (1 - ROUNDING)
    return (found["decades_low"] >= needed).mean(), (found["decades_high"] < needed).mean()


def half_spread(ensemble, region, *, half_width, resamples, random):
    """Return half the spread of local slopes of the geometric mean within region (b), with its 95 % interval.

    ensemble : ensemble dataset of one rms convention; region : (X_low, X_high), or None
    half_width : half width of local slopes, in ln X
    Returns a dict: half_spread, half_spread_low, half_spread_high, region_decades; without a region only the last.
    """
    if region is None:
        return {"region_decades": 0.0}
    x, log_y = ensemble["x"].values, np.log(ensemble["velocity"].values)
    log_y = log_y[np.isfinite(log_y[:, in_window(x, region)]).all(axis=1)]
    means = resampled_means(np.where(np.isfinite(log_y), log_y, 0.0), resamples, random)
    means[:, ~np.isfinite(log_y).all(axis=0)] = np.nan  # local slopes leave out abscissae beyond the end of a curve
    slopes = local_slopes(np.log(x), means, half_width)[:, in_window(x, region)]
    columns = three_columns("half_spread", with_interval(np.ptp(slopes, axis=1) / 2, len(log_y)))
    return columns | {"region_decades": np.log10(region[1] / region[0])}


def plateau_table(discs, *, control, rms_convention, region, seed, **options):
    """Apply both tests to base discs and a control at every Hurst exponent; a pandas.DataFrame with `COLUMNS`.

    discs : pool (viscorough_study.ensembles.pool); control : group without a power law, or None
    region : limits of region (b), arguments of viscorough_study.fits.power_law.find_region
    options : fields of `PlateauTest`
    """
    test = PlateauTest(**options)
    pool = ensembles(discs, "group", "hurst", rms_convention=rms_convention)
    rows = []
    for group in ("base", control) if control else ("base",):
        for hurst, ensemble in sorted((h, ensemble) for (name, h), ensemble in pool.items() if name == group):
            logging.info("%s, H = %g", group, hurst)
            random = np.random.default_rng(realization_seed(seed, *plateau_key(hurst, group)))
            row = plateau_row(ensemble, pool.get((control, hurst)), test, random)
            slopes = {"half_width": test.half_width * np.log(10), "resamples": test.resamples}
            row |= half_spread(ensemble, find_region(ensemble, **region), random=random, **slopes)
            rows.append({"case_group": group, **row})
    return pd.DataFrame(rows, columns=list(COLUMNS))


@dataclass(frozen=True)
class PlateauTest:
    """The test for a plateau of the local slope.

    x_range : range of X of the plateau
    half_width : half width of local slopes, in decades; they extend beyond x_range
    tolerance : tolerance of the local slope; decades_min : length with which an ensemble passes
    resamples : number of bootstrap resamples; draws : number of synthetic ensembles of each kind
    """

    x_range: tuple[float, float]
    half_width: float
    tolerance: float
    decades_min: float
    resamples: int
    draws: int


def plateau_row(ensemble, control, test, random):
    """Return the row of one ensemble, with the keys of `COLUMNS` except case_group, without undefined results.

    ensemble : ensemble dataset (viscorough_study.ensembles.averages) of one rms convention
    control : dataset of the control of the same Hurst exponent, or None
    test : PlateauTest; random : numpy.random.Generator
    The results are undefined if a realization does not reach all abscissae.
    """
    x, margin = ensemble["x"].values, 10 ** (test.half_width * (1 + ROUNDING))
    chosen = (x >= test.x_range[0] / margin) & (x <= test.x_range[1] * margin)
    log_x, log_y = np.log(x[chosen]), np.log(ensemble["velocity"].values[:, chosen])
    row = {"hurst": ensemble["hurst"].item(), "realizations": len(log_y)}
    if not np.isfinite(log_y).all():
        return row
    options = {"half_width": test.half_width * np.log(10), "tolerance": test.tolerance, "random": random}
    row |= plateau(log_x, log_y, resamples=test.resamples, **options)
    residuals = log_y - log_y.mean(axis=0)
    options |= {"draws": test.draws, "decades_min": test.decades_min, "resamples": RESAMPLES_OF_DRAWS}
    passed, failed = shares(log_x, 0 * log_x, residuals, **options)  # of power laws: the slope has no effect
    row |= {"power_law_passes": passed, "power_law_fails": failed}
    if control is not None:
        mean = np.log(control["velocity"].values[:, chosen]).mean(axis=0)
        row["control_passes"], _ = shares(log_x, mean, residuals, **options)
    return row
