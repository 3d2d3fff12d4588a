"""Estimate the local exponent β and vt/h on the finest of several grids, and for an infinitely fine grid.

The same surfaces are indented on neighbouring grids (viscorough_study.ensembles.nested_grids), and the differences of
ln(vt/h) at fixed X between the two grids are averaged. From a grid b, the mean on the finest grid N is the sum

    E[Y_N] = E[Y_b] + Σ E[Y_l − Y_(l−1)]        over the grids l that are finer than b

(multilevel Monte Carlo: Giles, Oper. Res. 56, 607 (2008)). The surfaces of different grids are independent. With b = N
this is plain averaging on the finest grid. For every quantity the sum starts at the grid b with a short interval,
so plain averaging is used where pairs of grids scatter too much. `optimal_surfaces` allocates surfaces to grids.

Beyond the finest grid, the last differences D_l are continued as a geometric sequence, D_l = A r^l. The remainder is
the sum of all further differences, A r^(N+1)/(1 − r). If the 95 % interval of r reaches 1, the sequence need not
converge, and the limit is undecided.

Two quantities Y are evaluated: ln(vt/h), and the logarithm of the part of the interface, g = vt/h − X/κ_c, where κ_c is
the stiffness of the flat punch on the grid. X = F/(4GhL) is the reduced force. β(X) is the slope of a straight line
through Y over a decade of ln X. Y and β are linear in the curves, so a mean over surfaces is the geometric mean.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import chdtri, stdtrit

from viscorough_study.fits.intervals import NO_INTERVAL

DIFFERENCES = 3  # number of the last differences to which the geometric sequence is fitted
RATIOS = np.linspace(0.0, 2.0, 401)[1:]  # trial values of the ratio r of successive differences
LONGER = 1.15  # largest ratio of the interval of a sum to the shortest interval of all sums (`starting_grid`)
DRAWS = 4000  # samples of the normal distribution from which intervals of the limit are computed


@dataclass(frozen=True)
class Level:
    """Values of several statistics of the same surfaces on a grid and on the next coarser grid.

    across : elements across the discs
    fine : values on the grid, shape (surfaces, statistics)
    coarse : values on the next coarser grid, shape (surfaces, statistics); None on the coarsest grid
    seconds : processor time of a surface on the grid, and on the next coarser grid
    """

    across: int
    fine: np.ndarray
    coarse: np.ndarray | None
    seconds: tuple[float, float] = (np.nan, 0.0)

    def one(self, position):
        """Return the values of one statistic, and their differences from the next coarser grid or None."""
        fine = self.fine[:, position]
        return fine, None if self.coarse is None else fine - self.coarse[:, position]


@dataclass(frozen=True)
class Estimate:
    """Estimate of a mean on the finest grid and of its limit.

    value, low, high : mean on the finest grid and its 95 % interval
    error : standard error of the value
    base : position of the grid b in the list of levels at which the sum starts
    differences : means of the differences between neighbouring grids, and their standard errors, shape (2, levels − 1)
    ratio : ratio r of successive differences and its 95 % interval
    remainder : sum of all differences beyond the finest grid and its 95 % interval; nan if r reaches 1
    limit : value plus remainder and its 95 % interval; nan if r reaches 1
    """

    value: float
    low: float
    high: float
    error: float
    base: int
    differences: np.ndarray
    ratio: tuple[float, float, float]
    remainder: tuple[float, float, float]
    limit: tuple[float, float, float]


def slopes_of(log_x, windows):
    """Return a matrix whose product with curves gives the slope of a least-squares line in every window.

    log_x : ln X, shape (abscissae,); windows : list of (first, last) positions of abscissae, both included
    Returns an array of shape (abscissae, windows).
    """
    matrix = np.zeros((log_x.size, len(windows)))
    for column, (first, last) in enumerate(windows):
        part = slice(first, last + 1)
        offset = log_x[part] - log_x[part].mean()
        matrix[part, column] = offset / (offset @ offset)
    return matrix


def estimates(levels, seed):
    """Estimate the mean of every statistic on the finest grid and in the limit; return a list of `Estimate`.

    levels : list of `Level`, from coarse to fine
    seed : int or SeedSequence of the draws from which the intervals of remainders are computed
    """
    statistics = levels[0].fine.shape[1]
    return [_estimate([level.one(i) for level in levels], seed) for i in range(statistics)]


def _estimate(samples, seed):
    """Return the `Estimate` of one statistic; samples : (values, differences) from `Level.one` for each grid."""
    base = starting_grid(samples)
    value, half, error = mean_error(samples, base)
    differences = np.array([(d.mean(), d.std(ddof=1) / np.sqrt(d.size)) for _, d in samples[1:]]).reshape(-1, 2).T
    ratio, remainder, limit = _beyond(samples, base, value, differences, seed)
    return Estimate(value, value - half, value + half, error, base, differences, ratio, remainder, limit)


def starting_grid(samples):
    """Return the position of the grid from which the sum over pairs of grids starts.

    It is the coarsest grid whose interval is at most `LONGER` times as long as the shortest interval of all grids. The
    shortest interval itself would on average be too short, since it is the smallest of several estimates.

    samples : (values, differences) from `Level.one` for each grid, from coarse to fine
    """
    halves = np.array([mean_error(samples, base)[1] for base in range(len(samples))])
    return int(np.argmax(halves <= LONGER * halves.min()))


def mean_error(samples, base):
    """Return the mean on the finest grid, half the width of its 95 % interval, and its standard error.

    samples : (values, differences) from `Level.one` for each grid, from coarse to fine
    base : position of the grid at which the sum starts

    The interval uses Student's t with the degrees of freedom of a sum of independent means (Welch and Satterthwaite).
    """
    terms = [samples[base][0]] + [difference for _, difference in samples[base + 1 :]]
    squares = np.array([term.var(ddof=1) / term.size for term in terms])
    error = np.sqrt(squares.sum())
    degrees = np.sum(squares**2 / [term.size - 1 for term in terms])
    freedom = squares.sum() ** 2 / degrees if degrees > 0 else np.inf
    return sum(term.mean() for term in terms), stdtrit(freedom, 0.975) * error, error


def _beyond(samples, base, value, differences, seed):
    """Continue the differences beyond the finest grid; return ratio, remainder and limit with their intervals."""
    undefined = (np.nan, *NO_INTERVAL)
    if differences.shape[1] < DIFFERENCES or not (differences[1] > 0).all():
        return undefined, undefined, undefined
    means, errors = differences[:, -DIFFERENCES:]
    explained = _explained(means[None], errors)[0]
    # Profile likelihood: the ratios that explain the differences almost as well as the best ratio
    accepted = RATIOS[explained >= explained.max() - chdtri(1, 0.05)]
    ratio = (RATIOS[explained.argmax()], accepted[0], accepted[-1])
    if ratio[2] >= 1:
        return ratio, undefined, undefined
    random = np.random.default_rng(seed)
    # Differences are drawn with Student's t, since their standard errors are estimated from few surfaces.
    sizes = np.array([d.size for _, d in samples[1:]])
    drawn = differences[0] + differences[1] * random.standard_t(sizes - 1, size=(DRAWS, sizes.size))
    fine, difference = samples[base]
    base_error = fine.std(ddof=1) / np.sqrt(fine.size)
    scatter = base_error * random.standard_t(fine.size - 1, size=DRAWS)
    if difference is not None:
        # The values on the base grid and the differences from the next coarser grid belong to the same surfaces.
        correlation = np.corrcoef(fine, difference)[0, 1]
        shared = (drawn[:, base - 1] - differences[0, base - 1]) / differences[1, base - 1] * base_error
        scatter = correlation * shared + np.sqrt(max(1 - correlation**2, 0.0)) * scatter
    values = value + scatter + (drawn[:, base:] - differences[0, base:]).sum(axis=1)
    remainders = _remainders(drawn[:, -DIFFERENCES:], errors)
    remainder = _remainders(means[None], errors)[0]
    ends = np.quantile([remainders, values + remainders], [0.025, 0.975], axis=1, method="nearest")
    return ratio, (remainder, *ends[:, 0]), (value + remainder, *ends[:, 1])


def _explained(means, errors):
    """Return the part of χ² that the best geometric sequence of each ratio explains, shape (rows, ratios).

    means : differences, shape (rows, differences); errors : their standard errors
    """
    powers = RATIOS[:, None] ** np.arange(means.shape[1])
    return ((means / errors**2) @ powers.T) ** 2 / np.sum(powers**2 / errors**2, axis=1)


def _remainders(means, errors):
    """Return the remainder Σ D_l beyond the last difference of each row, infinite for a ratio of 1 or more."""
    ratios = RATIOS[_explained(means, errors).argmax(axis=1)]
    powers = ratios[:, None] ** np.arange(means.shape[1])
    amplitudes = np.sum(means * powers / errors**2, axis=1) / np.sum(powers**2 / errors**2, axis=1)
    last = amplitudes * powers[:, -1]
    with np.errstate(divide="ignore"):
        return np.where(ratios < 1, last * ratios / np.abs(1 - ratios), np.copysign(np.inf, last))


def optimal_surfaces(variances, seconds, half_width):
    """Allocate surfaces to grids for a 95 % interval of the given half-width at the least processor time.

    variances : variance of a value on the first grid, then variances of the differences on the finer grids
    seconds : processor times of a surface on the first grid, then of a pair of grids
    Returns the numbers of surfaces n_l ∝ √(variance/seconds), at least 2, as integers.
    """
    variances, seconds = np.asarray(variances, float), np.asarray(seconds, float)
    total = np.sum(np.sqrt(variances * seconds)) / (half_width / 1.96) ** 2
    return np.maximum(np.ceil(total * np.sqrt(variances / seconds)), 2).astype(int)
