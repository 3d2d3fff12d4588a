"""Find region (b) of an ensemble, and fit the power law in it (β, ζ).

In region (b) the reduced stiffness is κ = ζ X^α (paper, Eq. 3), where X = F/(4GhL) is the reduced force. Hence
vt/h = X/κ = X^β/ζ with β = 1 − α. Fits use this form of the law, without the factor 1/Γ(2 − α);
viscorough_study.fits.conventions converts ζ to the form with this factor.

Intervals are 95 % bootstrap intervals over realizations: whole curves are drawn with replacement, and fitted in a fixed
window. The intervals include the scatter between surfaces, but not the choice of the window. Fits in other windows show
the effect of this choice.
"""

import numpy as np
from scipy.ndimage import find_objects, label

from viscorough_study.ensembles.averages import ROUNDING
from viscorough_study.fits.conventions import FITTED

FEWEST = 3  # abscissae in the window of a fit: a line through two points says nothing about a power law


# ---- windows of the fits


def local_slopes(log_x, log_y, half_width):
    """Return d ln y/d ln X at every abscissa, the slope of a least-squares line through the points within ± half_width.

    log_x : ln X, shape (abscissae,)
    log_y : ln y, shape (abscissae,) or (curves, abscissae)
    half_width : largest distance of the points from the abscissa, in ln X
    Returns an array of the shape of log_y. A point is omitted for all curves if any curve is undefined (nan) there. The
    slope is nan if fewer than two points remain.
    """
    defined = np.atleast_2d(np.isfinite(log_y)).all(axis=0)
    near = (np.abs(log_x[:, None] - log_x) <= half_width * (1 + ROUNDING)) & defined
    number = near.sum(axis=1)
    centre = near @ log_x / np.maximum(number, 1)
    offset = np.where(near, log_x - centre[:, None], 0)
    slopes = np.full(log_y.shape, np.nan)
    return np.divide(np.where(defined, log_y, 0) @ offset.T, (offset**2).sum(axis=1), out=slopes, where=number > 1)


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


def find_region(mean, *, elements_min, stiffness_max, slope_max, slope_half_width, fraction_min, decades_min):
    """Return the range (X_low, X_high) of region (b), or None if there is no region (b).

    The range is the longest run of neighbouring abscissae, measured in ln X, that all meet these conditions:

    - The median number of elements in contact is at least elements_min. With fewer elements the curve depends on the
      grid.
    - The geometric mean of κ is at most stiffness_max. Above this value, in the transition to region (c), the finite
      size of the indenter affects the curve.
    - The local slope of the geometric mean of vt/h is at most slope_max. It is fitted over slope_half_width decades to
      either side. The slope is 1 in regions (a) and (c). Self-affine surfaces that meet the other conditions also meet
      this condition.
    - At least the fraction fraction_min of the realizations reaches the abscissa. A mean over fewer curves is biased.

    There is no region (b) if no run spans decades_min decades. The Hurst exponent does not enter this rule.

    mean : ensemble dataset (ensembles.averages) with a single definition of the rms height
    config/config.yaml, section `scaling`, describes the limits and recommends values.
    """
    log_x, log_velocity = np.log(mean["x"].values), np.log(mean["velocity_geometric"].values)
    allowed = local_slopes(log_x, log_velocity, slope_half_width * np.log(10)) <= slope_max
    allowed &= mean["contact_count_median"].values >= elements_min
    return _longest_run(mean, allowed, (0, stiffness_max), fraction_min, decades_min)


def named_windows(mean, *, stiffness_range=None, fraction_min, decades_min, **limits):
    """Return the windows (ranges of X) in which power laws are fitted and compared: {name: (X_low, X_high), or None}.

    - default: region (b), from `find_region` with the given limits.
    - lower_half, upper_half: the two halves of the default window in ln X. A difference between their β reveals
      curvature, which a single fit hides.
    - kappa: the window with stiffness_range[0] <= κ <= stiffness_range[1]. This is the same state of contact on any
      grid, whereas the default window begins at much smaller X for lines than for discs. Without a range there is none.

    A window with fewer than three abscissae is too short for a fit. It is None.

    All windows are determined from the geometric mean, also for fits to the arithmetic mean.
    """
    run_limits = {"fraction_min": fraction_min, "decades_min": decades_min}
    windows = dict.fromkeys(FITTED["window_rule"])
    # If the ensemble has no region (b), the three windows made from it stay None. Tables then state nan and 0 decades.
    if region := find_region(mean, **run_limits, **limits):
        middle = np.sqrt(np.prod(region))
        windows |= {"default": region, "lower_half": (region[0], middle), "upper_half": (middle, region[1])}
    if stiffness_range:
        windows["kappa"] = _longest_run(mean, True, stiffness_range, **run_limits)
    for name, window in windows.items():
        if window and in_window(mean["x"].values, window).sum() < FEWEST:
            windows[name] = None
    return windows


def _longest_run(mean, allowed, stiffness_range, fraction_min, decades_min):
    """Return the ends (X_low, X_high) of the longest run of neighbouring abscissae that meet all conditions.

    mean : ensemble dataset with a single definition of the rms height
    allowed : mask of the abscissae that meet further conditions, or True for all abscissae
    stiffness_range : lowest and highest allowed κ
    fraction_min : smallest fraction of the realizations that must reach an abscissa
    The length is measured in ln X. Returns None if no run spans decades_min decades.
    """
    x, stiffness = mean["x"].values, mean["stiffness_geometric"].values
    allowed = allowed & (stiffness >= stiffness_range[0]) & (stiffness <= stiffness_range[1])
    allowed &= mean["fraction_defined"].values >= fraction_min
    runs = [(x[run][0], x[run][-1]) for (run,) in find_objects(label(allowed)[0])]
    decades = [np.log10(last / first) for first, last in runs]
    return runs[np.argmax(decades)] if max(decades, default=-1) >= decades_min * (1 - ROUNDING) else None


def in_window(x, window):
    """Return a mask that is True for the abscissae x in a window (X_low, X_high), whose ends are included."""
    return (x >= window[0] * (1 - ROUNDING)) & (x <= window[1] * (1 + ROUNDING))


# ---- fits of the power law


def fit_power_law(x, velocity, window, *, average, resamples, seed):
    """Fit β and ζ of vt/h = X^β/ζ to the mean curve, by least squares of ln(vt/h) on ln X with equal weights.

    x : X, shape (abscissae,), logarithmically uniform (viscorough_study.ensembles.averages.abscissa)
    velocity : vt/h, shape (realizations, abscissae), nan where undefined
    window : (X_low, X_high), ends included
    average : "arithmetic" or "geometric" mean over the realizations
    resamples : number of bootstrap samples
    seed : int or SeedSequence. With equal seeds the same realizations are drawn for every window and average, so the
        bootstrap adds no noise to differences between conventions.

    Returns two arrays of shape (resamples + 1,), β and ζ. The first entries belong to the ensemble, the others to its
    resamples. Raises ValueError if fewer than three abscissae lie in the window, or if all realizations are undefined
    at an abscissa in the window.
    """
    chosen = in_window(x, window)
    if chosen.sum() < FEWEST:
        raise ValueError(f"fit_power_law: {chosen.sum()} abscissae in the window, at least {FEWEST} are needed")
    log_x, velocity = np.log(x[chosen]), velocity[:, chosen]
    if not np.isfinite(velocity).any(axis=0).all():
        raise ValueError("fit_power_law: an abscissa of the window has no realization, at least 1 is needed")
    mean = log_means(velocity, average, resamples, np.random.default_rng(seed))

    offset = log_x - log_x.mean()
    beta = mean @ offset / (offset @ offset)
    intercept = mean.mean(axis=1) - beta * log_x.mean()
    return beta, np.exp(-intercept)


def log_means(velocity, average, resamples, generator):
    """Return ln of the mean of vt/h over the realizations, for the ensemble and for its bootstrap resamples.

    velocity : vt/h, shape (realizations, abscissae); undefined values are nan, and are omitted from the mean
    average : "arithmetic" or "geometric"
    Returns an array of shape (resamples + 1, abscissae), whose first row belongs to the ensemble.
    """
    n = len(velocity)
    # Draw indices of realizations, and count how often each is drawn. Generator.multinomial would return these counts
    # directly, but more slowly.
    drawn = generator.integers(n, size=(resamples, n)) + n * np.arange(resamples)[:, None]
    weights = np.bincount(drawn.ravel(), minlength=resamples * n).reshape(resamples, n)
    weights = np.vstack([np.ones(n), weights])
    defined = np.isfinite(velocity)
    values = np.where(defined, np.log(velocity) if average == "geometric" else velocity, 0)
    # At an abscissa that none of the curves in a resample reaches, the mean of this resample is nan.
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = (weights @ values) / (n if defined.all() else weights @ defined)
    return mean if average == "geometric" else np.log(mean)
