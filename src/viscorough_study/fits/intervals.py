"""Compute 95 % intervals from bootstrap samples or from independent samples, and name their columns in tables.

A quantity has three columns in a table: its value under the name of the quantity, and the lower and upper end of its
interval under the same name with the suffixes _low and _high.
"""

import numpy as np
from scipy.special import ndtr, stdtrit

UNDEFINED = (np.nan, np.nan, np.nan)  # (value, low, high) of a quantity that cannot be computed
NO_INTERVAL = (np.nan, np.nan)  # (low, high) of a quantity without statistical scatter


def described(name, text, ends="of its 95 % interval"):
    """Describe the value, lower end and upper end of a quantity without unit: {column: (long_name, units)}.

    text : long_name of the column with the value
    ends : words that follow "lower end" and "upper end" in the long_names of the other two columns
    """
    return {name: (text, "1")} | described_ends(name, ends)


def described_ends(name, ends):
    """Describe the two ends of a range of a quantity without unit: {column: (long_name, units)}.

    name : name of the quantity, to which _low and _high are appended for the columns
    ends : words that follow "lower end" and "upper end" in the long_names
    """
    return {f"{name}_{end}": (f"{side} end {ends}", "1") for end, side in (("low", "lower"), ("high", "upper"))}


def three_columns(name, values):
    """Return {column: value} for the value of the quantity `name` and the two ends of its interval.

    values : (value, low, high)
    """
    return dict(zip((name, f"{name}_low", f"{name}_high"), values, strict=True))


def interval(row, name):
    """Return (value, low, high) of the quantity `name` in a row of a table."""
    return tuple(row[column] for column in (name, f"{name}_low", f"{name}_high"))


def resampled_means(values, resamples, random):
    """Return the mean over the realizations (first row), and the means of bootstrap resamples (other rows).

    values : shape (realizations, abscissae), without nan; random : numpy.random.Generator
    Returns an array of shape (resamples + 1, abscissae).
    """
    number = len(values)
    weights = random.multinomial(number, np.full(number, 1 / number), size=resamples) / number
    return np.vstack([values.mean(axis=0), weights @ values])


def with_interval(samples, realizations):
    """Return (value, low, high) with the 95 % interval of bootstrap samples, widened for few realizations.

    samples : value of the ensemble, then values of its resamples, shape (resamples + 1,); or for several quantities,
        each with an interval, shape (resamples + 1, quantities). Resamples with an undefined value (nan) are omitted.
    realizations : n, the number of realizations in the ensemble

    For small n the 2.5 % and 97.5 % percentiles of the samples give too narrow an interval. The ends are therefore the
    percentiles Φ(∓√(n/(n−1)) t), where Φ is the standard normal distribution and t is the 97.5 % point of
    Student's t with n − 1 degrees of freedom. For a mean this gives the t interval (Hesterberg, The American
    Statistician 69, 371 (2015): expanded percentile interval). Both ends are nan for a single realization.
    """
    value, samples = samples[0], samples[1:]
    samples = samples[np.isfinite(samples).reshape(len(samples), -1).all(axis=1)]
    if realizations < 2 or samples.size == 0:
        return value, *NO_INTERVAL
    tail = ndtr(-np.sqrt(realizations / (realizations - 1)) * stdtrit(realizations - 1, 0.975))
    return value, *np.quantile(samples, [tail, 1 - tail], axis=0)


def mean_with_interval(samples):
    """Return (mean, low, high): the mean of independent samples and its 95 % interval by Student's t.

    samples : shape (samples,), or (samples, quantities) for the mean of each quantity
    Both ends are nan for a single sample.
    """
    mean, number = samples.mean(axis=0), len(samples)
    error = stdtrit(number - 1, 0.975) * samples.std(axis=0, ddof=1) / np.sqrt(number) if number > 1 else np.nan
    return mean, mean - error, mean + error


def equivalence(interval, low, high):
    """Return True if a quantity lies in the range from low to high, False if it lies outside, None if undecided.

    interval : (lower end, upper end), the 95 % interval of the quantity
    The result is True if the whole interval lies in the range, and False if the whole interval lies outside. It is None
    if the interval contains an end of the range or is undefined. This is a test of equivalence by two one-sided tests
    at 2.5 % each (Schuirmann, J. Pharmacokinet. Biopharm. 15, 657 (1987)).
    """
    if not np.all(np.isfinite(interval)):
        return None
    if low <= interval[0] and interval[1] <= high:
        return True
    return False if interval[1] < low or interval[0] > high else None


def difference(first, second):
    """Return second − first with its 95 % interval, for two independent quantities, each given as (value, low, high).

    For the ends of the interval, the half-widths of the two intervals are added in quadrature.
    """
    value = second[0] - first[0]
    below = np.hypot(second[0] - second[1], first[2] - first[0])
    above = np.hypot(second[2] - second[0], first[0] - first[1])
    return value, value - below, value + above
