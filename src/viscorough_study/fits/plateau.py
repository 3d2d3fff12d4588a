"""Test curves for a power law, by two tests of the local slope d ln y/d ln X, which must be constant.

Here y is vt/h, and X = F/(4GhL) is the reduced force.

1. Within region (b): half the spread of the local slopes, that is, half the difference of the largest and the smallest.
   The paper calls the curves nearly linear in this region.
2. Without a region: the longest range of X, in decades, in which the largest and the smallest local slope differ by at
   most twice the tolerance. Every curve whose slope increases towards both ends has a flat piece in between, so the
   length of this piece is tested.

A local slope is the slope of a straight line fitted over a fixed width in X. So the tested property, a constant slope,
does not influence the choice of the window.

The control consists of discs whose spectrum has no long waves, and hence no power law. A test that the control passes
cannot distinguish a power law from a bend. The second test has two error rates: the fraction of power laws that fail,
and the fraction of curves like the control that pass. Both are estimated from synthetic ensembles with the scatter of
the real realizations.
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
RESAMPLES_OF_DRAWS = 100  # number of bootstrap resamples of each synthetic ensemble


def inner_slopes(log_x, log_y, half_width):
    """Return the inner abscissae, at least half_width from both ends of the curves, and the local slopes there.

    log_x : ln X, equally spaced, shape (abscissae,)
    log_y : ln y, shape (curves, abscissae), without nan
    half_width : a local slope is fitted to the points within ± half_width in ln X
    Returns ln X and the slopes, of shapes (inner abscissae,) and (curves, inner abscissae). Both are empty if there is
    no inner abscissa.
    """
    reach = int(half_width / (log_x[1] - log_x[0]) + ROUNDING) if log_x.size > 1 else 1
    return log_x[reach:-reach], local_slopes(log_x, log_y, half_width)[:, reach:-reach]


def longest_plateau(slopes, tolerance):
    """Return, for every curve, the length of the longest run of neighbouring slopes that agree within the tolerance.

    The largest and the smallest slope of the run differ by at most 2 tolerance. The length of n + 1 slopes is n steps.

    slopes : shape (curves, abscissae)
    Returns an array of shape (curves,).
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
    """Return over how many decades of X the mean curve has a constant local slope, with a 95 % bootstrap interval.

    log_x, log_y, half_width : arguments of `inner_slopes`; each curve of log_y is a realization
    tolerance : tolerance of the local slope
    random : numpy.random.Generator
    Returns a dict with the keys decades, decades_low and decades_high.

    The interval is biased to low values: the mean of a resample has twice the variance of the mean of the realizations,
    and scatter shortens plateaus. Therefore few curves without a power law pass the test, but some power laws with
    large scatter fail. `shares` estimates both fractions.
    """
    inner, slopes = inner_slopes(log_x, resampled_means(log_y, resamples, random), half_width)
    step = (inner[1] - inner[0]) / np.log(10)
    return three_columns("decades", with_interval(longest_plateau(slopes, tolerance) * step, len(log_y)))


def shares(log_x, mean, residuals, *, draws, decades_min, random, **options):
    """Return (passed, failed), the fractions of synthetic ensembles that pass and fail the second test of the module.

    The test compares the 95 % interval of the number of decades (see `plateau`) with decades_min. An ensemble passes if
    the whole interval is at least decades_min, and fails if the whole interval is below decades_min.

    mean : ln y of the true mean curve of all synthetic ensembles, shape (abscissae,)
    residuals : ln y of the realizations minus their mean, shape (realizations, abscissae). Every synthetic ensemble
        draws as many residuals as there are realizations, with replacement, so it has the real scatter and the real
        correlation along X.
    draws : number of synthetic ensembles
    options : further arguments of `plateau`
    """
    drawn = (residuals[random.integers(len(residuals), size=len(residuals))] for _ in range(draws))
    found = pd.DataFrame([plateau(log_x, mean + scatter, random=random, **options) for scatter in drawn])
    needed = decades_min * (1 - ROUNDING)
    return (found["decades_low"] >= needed).mean(), (found["decades_high"] < needed).mean()


def half_spread(ensemble, region, *, half_width, resamples, random):
    """Return half the spread of the local slopes d ln(vt/h)/d ln X within region (b), with its 95 % interval.

    The spread is the largest slope minus the smallest slope of the geometric mean over the realizations. This is the
    first test of the module.

    ensemble : ensemble dataset (ensembles.averages) with a single definition of the rms height
    region : ends (X_low, X_high) of region (b), or None if there is no region (b)
    half_width : a local slope is fitted to the points within ± half_width in ln X
    Returns a dict with the keys half_spread, half_spread_low, half_spread_high and region_decades (decades of X in
    region (b)). If `region` is None, the dict contains only region_decades, which is 0.
    """
    if region is None:
        return {"region_decades": 0.0}
    x, log_y = ensemble["x"].values, np.log(ensemble["velocity"].values)
    log_y = log_y[np.isfinite(log_y[:, in_window(x, region)]).all(axis=1)]
    means = resampled_means(np.where(np.isfinite(log_y), log_y, 0.0), resamples, random)
    # The mean is set to nan at abscissae that a curve does not reach; `local_slopes` omits them.
    means[:, ~np.isfinite(log_y).all(axis=0)] = np.nan
    slopes = local_slopes(np.log(x), means, half_width)[:, in_window(x, region)]
    columns = three_columns("half_spread", with_interval(np.ptp(slopes, axis=1) / 2, len(log_y)))
    return columns | {"region_decades": np.log10(region[1] / region[0])}


def plateau_table(discs, *, control, rms_convention, region, seed, **options):
    """Apply both tests of the module to the base discs (which all figures use) and to the control at every H.

    Returns a pandas.DataFrame with the columns of `COLUMNS`.

    discs : pool of loading curves (viscorough_study.ensembles.pool) that contains the base discs and the control
    control : name of the group of discs without a power law, or None
    rms_convention : name of the definition of the rms height h
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
    """Settings of the second test: whether the local slope is constant over a sufficient number of decades.

    x_range : ends (X_low, X_high) of the range of X that the test uses
    half_width : a local slope is fitted to the points within ± half_width decades of X, also to points outside x_range
    tolerance : slopes count as constant if the largest and the smallest differ by at most 2 tolerance
    decades_min : an ensemble passes if its slope is constant over at least this number of decades
    resamples : number of bootstrap resamples
    draws : number of synthetic ensembles with a power law, and also with the mean curve of the control
    """

    x_range: tuple[float, float]
    half_width: float
    tolerance: float
    decades_min: float
    resamples: int
    draws: int


def plateau_row(ensemble, control, test, random):
    """Apply the second test (see the module) to one ensemble, and return a row of the table, {column: value}.

    ensemble : ensemble dataset (viscorough_study.ensembles.averages) with a single definition of the rms height
    control : ensemble dataset of the control with the same Hurst exponent, or None
    test : PlateauTest
    random : numpy.random.Generator
    If a realization does not reach all abscissae, the row has only the Hurst exponent and the number of realizations.
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
    # The mean curve ln y = 0 serves for every power law, since the exponent does not change the result of the test.
    passed, failed = shares(log_x, 0 * log_x, residuals, **options)
    row |= {"power_law_passes": passed, "power_law_fails": failed}
    if control is not None:
        mean = np.log(control["velocity"].values[:, chosen]).mean(axis=0)
        row["control_passes"], _ = shares(log_x, mean, residuals, **options)
    return row
