"""Compute 95 % intervals of bootstrap samples and of independent samples, and their columns in tables.

A quantity has three columns in a table: its value, under its name, and the ends of its interval, under its name with
the suffixes _low and _high.
"""

import numpy as np
from scipy.special import gammaincinv, ndtr, stdtrit

UNDEFINED = (np.nan, np.nan, np.nan)  # value and interval of a quantity that cannot be computed
NO_INTERVAL = (np.nan, np.nan)  # ends of the interval of a quantity without statistical scatter


def described(name, text, ends="of its 95 % interval"):
    """Describe the columns of a quantity without unit and of its interval, {column: (long_name, units)}."""
    return {name: (text, "1")} | described_ends(name, ends)


def described_ends(name, ends):
    """Describe the columns of both ends of a range; ends : words after "lower end" and "upper end"."""
    return {f"{name}_{end}": (f"{side} end {ends}", "1") for end, side in (("low", "lower"), ("high", "upper"))}


def three_columns(name, values):
    """Return {column: value} of a quantity and its interval; values : value, low, high"""
    return dict(zip((name, f"{name}_low", f"{name}_high"), values, strict=True))


def interval(row, name):
    """Return (value, low, high) of a quantity in a row of a table."""
    return tuple(row[column] for column in (name, f"{name}_low", f"{name}_high"))


def resampled_means(values, resamples, random):
    """Return the mean over the realizations in the first row, and means of bootstrap resamples in the others.

    values : shape (realizations, abscissae), without nan; random : numpy.random.Generator
    Returns an array of shape (resamples + 1, abscissae).
    """
    number = len(values)
    weights = random.multinomial(number, np.full(number, 1 / number), size=resamples) / number
    return np.vstack([values.mean(axis=0), weights @ values])


def with_interval(samples, realizations):
    """Return (value, low, high) with the 95 % interval of bootstrap samples, widened for few realizations.

    samples : value of the ensemble, then of its resamples, shape (resamples + 1,), or (resamples + 1, quantities) for
        one interval per quantity; resamples with undefined (nan) values are omitted

    Plain percentiles are too narrow for small n. The levels Φ(∓√(n/(n−1)) t), t the 97.5 % point of Student's
    t with n − 1 degrees of freedom, give the t interval for a mean (Hesterberg, The American
    Statistician 69, 371 (2015): expanded percentile interval). Nan for a single realization.
    """
    value, samples = samples[0], samples[1:]
    samples = samples[np.isfinite(samples).reshape(len(samples), -1).all(axis=1)]
    if realizations < 2 or samples.size == 0:
        return value, *NO_INTERVAL
    tail = ndtr(-np.sqrt(realizations / (realizations - 1)) * stdtrit(realizations - 1, 0.975))
    return value, *np.quantile(samples, [tail, 1 - tail], axis=0)


def mean_with_interval(samples):
    """Return the mean of independent samples and its interval by Student's t, nan for a single sample.

    samples : shape (samples,), or (samples, quantities) for the mean of each
    """
    mean, number = samples.mean(axis=0), len(samples)
    error = stdtrit(number - 1, 0.975) * samples.std(axis=0, ddof=1) / np.sqrt(number) if number > 1 else np.nan
    return mean, mean - error, mean + error


def deviation_interval(deviation, freedom):
    """Return the standard deviation of normal samples and its interval by the χ² distribution: (value, low, high)."""
    ends = deviation * np.sqrt(freedom / (2 * gammaincinv(freedom / 2, [0.975, 0.025]))) if freedom else NO_INTERVAL
    return deviation, *ends


def equivalence(interval, low, high):
    """Decide if a quantity with this 95 % interval lies in the range from low to high.

    Returns True if the whole interval lies in the range, False if it lies wholly outside, None if it contains an end of
    the range or is undefined: then the data do not decide. This is a test of equivalence by two one-sided tests at 2.5
    % each (Schuirmann, J. Pharmacokinet. Biopharm. 15, 657 (1987)).
    """
    if not np.all(np.isfinite(interval)):
        return None
    if low <= interval[0] and interval[1] <= high:
        return True
    return False if interval[1] < low or interval[0] > high else None


def difference(first, second):
    """Return the difference second − first of independent quantities, (value, low, high), from their intervals."""
    value = second[0] - first[0]
    below = np.hypot(second[0] - second[1], first[2] - first[0])
    above = np.hypot(second[2] - second[0], first[0] - first[1])
    return value, value - below, value + above
