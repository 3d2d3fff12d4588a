"""Scaling: region (b) of an ensemble, the power law in it (β, ζ) and the line that stands for a surface (λ).

In region (b) κ = ζ X^α (paper, Eq. 3), hence vt/h = X/κ = ζ⁻¹ X^β with β = 1 − α; with the factor that the
paper's Laplace transform adds, vt/h = ζ⁻¹/Γ(1 + β) X^β (Eq. 9, where 2 − α = 1 + β). The paper states neither
its window nor its average nor what its L is: every fit is made under several conventions, named in its row.

Intervals are 95 % bootstrap intervals over realizations: whole curves are drawn with replacement, the window
stays. They hold the scatter between surfaces, not the choice of the window, which the table shows by itself.
"""

from contextlib import suppress
from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.special import gamma as gamma_function
from scipy.special import ndtr, stdtrit

AVERAGES = ("arithmetic", "geometric")
DIAMETER_CONVENTIONS = ("diameter", "radius")
SLOPE_HALF_WIDTH = 0.25  # decades; narrower, the local slope of some tens of realizations is noise
DECADES_MIN = 0.5  # of a region; over less than a factor of three in X any smooth curve is a power law

# column of the scaling table: (long_name, units), in their order; units None for text
COLUMNS = {
    "source": ("discs (boundary elements) or lines (reduction of dimensionality)", None),
    "case_group": ("base or name of the variant of the surfaces", None),
    "hurst": ("Hurst exponent H", "1"),
    "rms_convention": ("where the rms height h is measured", None),
    "average": ("mean over the realizations at fixed X", None),
    "window_rule": ("rule of the window of the fit", None),
    "gamma": ("law with (Eq. 9) or without (Eqs. 1 and 3) the factor 1/Γ(2−α)", None),
    "diameter_convention": ("L in X and κ is the diameter or the radius", None),
    "x_low": ("lower end of the window in X = F/(4GhL) = Ft/(4ηhL)", "1"),
    "x_high": ("upper end of the window in X = F/(4GhL) = Ft/(4ηhL)", "1"),
    "decades": ("decades of X in the window, 0 where there is none", "1"),
    "realizations": ("realizations in the ensemble", "1"),
    "beta": ("exponent β of vt/h in X (Eqs. 9 and 10)", "1"),
    "beta_low": ("lower end of the 95 % interval of β", "1"),
    "beta_high": ("upper end of the 95 % interval of β", "1"),
    "zeta": ("prefactor ζ (Eq. 3; with the factor: Eq. 9)", "1"),
    "zeta_low": ("lower end of the 95 % interval of ζ", "1"),
    "zeta_high": ("upper end of the 95 % interval of ζ", "1"),
    "residual": ("rms deviation of ln(vt/h) from the power law in the window", "1"),
    "lambda": ("λ in C1D = λ q C2D that matches the line to the surface (Eq. 13)", "1"),
    "lambda_low": ("lower end of the 95 % interval of λ", "1"),
    "lambda_high": ("upper end of the 95 % interval of λ", "1"),
}


def local_slope(x, y):
    """d ln y / d ln X, shape (abscissae,): straight line fitted within a quarter of a decade to either side.

    Undefined (nan) values of y are left out; nan where fewer than two remain.
    """
    log_x, defined = np.log(x), np.isfinite(y)
    log_y = np.log(np.where(defined, y, 1))
    half_width = SLOPE_HALF_WIDTH * np.log(10) * (1 + 1e-9)
    near = (np.abs(log_x[:, None] - log_x) <= half_width) & defined
    number = near.sum(axis=1)
    centre = near @ log_x / np.maximum(number, 1)
    offset = np.where(near, log_x - centre[:, None], 0)
    slope = np.full(len(log_x), np.nan)
    np.divide(offset @ log_y, (offset**2).sum(axis=1), out=slope, where=number > 1)
    return slope


def find_region(mean, *, elements_min, stiffness_max, slope_max, fraction_min=0.95):
    """Window (X_low, X_high) of region (b): the longest run of abscissae, in ln X, at which

    - the median of the elements in contact >= elements_min: below, the grid is seen. With 10 the mean
      ln(vt/h) lies within 0.04 of that of the same surfaces on a grid twice (discs) or 16 times (lines) as
      fine, for H >= 0.1; with 3 it is off by up to 0.3, and ever more in region (a);
    - the geometric mean κ <= stiffness_max: above, the contact feels its finite size on the way to region
      (c). For discs and lines alike local slopes leave their plateau at κ between 0.15 and 0.2, and 0.2 is
      advised; at 0.3 they are higher by up to 0.1;
    - the local slope of the geometric mean vt/h <= slope_max: it is 1 in regions (a) and (c). A guard that
      does not bind for self-affine surfaces; 0.8 lies well above the 2/3 of a sphere and below 1;
    - the share of the realizations defined >= fraction_min: a mean over the few that get there is biased.

    mean : ensemble dataset (viscorough_study.ensembles) of one rms convention. No Hurst exponent enters the rule.
    Raises ValueError if no such run spans half a decade: there is no region (b).
    """
    x = mean["x"].values
    allowed = local_slope(x, mean["velocity_geometric"].values) <= slope_max
    allowed &= mean["contact_count_median"].values >= elements_min
    window = _longest_run(mean, allowed, (0, stiffness_max), fraction_min)
    if window is None:
        raise ValueError(f"find_region: no run of abscissae in the limits, {DECADES_MIN} decades are needed")
    return window


def named_windows(mean, *, stiffness_range, fraction_min=0.95, **limits):
    """The windows under comparison, {name: (X_low, X_high), or None where there is none}.

    - default: find_region(mean, **limits);
    - lower_half, upper_half: its halves in ln X. Their β differ by the curvature that one fit hides;
    - kappa: stiffness_range[0] <= κ <= stiffness_range[1], the same state of contact on any grid, where
      default begins much earlier for lines than for discs. (0.03, 0.3) is advised: there a disc of 257
      elements across has 10 in contact at any H, and both ends lie above those of default.

    All are found on the geometric mean, whatever is fitted: the choice of average does not move the window.
    """
    windows = dict.fromkeys(("default", "lower_half", "upper_half", "kappa"))
    with suppress(ValueError):  # no region (b) is a result: the table then has nan and no decades
        low, high = find_region(mean, fraction_min=fraction_min, **limits)
        middle = np.sqrt(low * high)
        windows |= {"default": (low, high), "lower_half": (low, middle), "upper_half": (middle, high)}
    windows["kappa"] = _longest_run(mean, True, stiffness_range, fraction_min)
    return windows


def _longest_run(mean, allowed, stiffness_range, fraction_min):
    """First and last X of the longest run of allowed abscissae in ln X; None if it is below DECADES_MIN."""
    x, stiffness = mean["x"].values, mean["stiffness_geometric"].values
    allowed = allowed & (stiffness >= stiffness_range[0]) & (stiffness <= stiffness_range[1])
    allowed &= mean["fraction_defined"].values >= fraction_min
    edges = np.flatnonzero(np.diff(np.concatenate([[False], allowed, [False]])))
    first, last = edges[::2], edges[1::2] - 1
    decades = np.log10(x[last] / x[first])
    if decades.size == 0 or decades.max() < DECADES_MIN * (1 - 1e-9):
        return None
    longest = np.argmax(decades)
    return x[first[longest]], x[last[longest]]


@dataclass(frozen=True)
class PowerLaw:
    """vt/h = prefactor · X^beta, fitted over a window of an ensemble.

    beta, prefactor : of the ensemble; beta_samples, prefactor_samples : of its resamples, shape (resamples,)
    realizations : in the ensemble
    residual : rms deviation of ln(vt/h) of the mean curve from the line
    """

    beta: float
    prefactor: float
    beta_samples: np.ndarray
    prefactor_samples: np.ndarray
    realizations: int
    residual: float

    @property
    def beta_interval(self):
        """95 % interval (low, high) of β."""
        return _interval(self.beta_samples, self.realizations)

    def zeta(self, *, gamma=False, diameter_convention="diameter"):
        """ζ and its 95 % interval, (value, low, high).

        vt/h = ζ⁻¹ X^β, or with gamma ζ⁻¹/Γ(1 + β) X^β (Eq. 9). With the radius for L both X and κ double
        while vt/h stays, so that ζ grows by 2^β and β does not change.
        """
        if diameter_convention not in DIAMETER_CONVENTIONS:
            raise ValueError(f"zeta: L is one of {DIAMETER_CONVENTIONS}, not {diameter_convention!r}")

        def of(beta, prefactor):
            scale = 2**beta if diameter_convention == "radius" else 1
            return scale / prefactor / (gamma_function(1 + beta) if gamma else 1)

        samples = of(self.beta_samples, self.prefactor_samples)
        return of(self.beta, self.prefactor), *_interval(samples, self.realizations)


def fit_power_law(x, velocity, window, *, average, resamples, seed):
    """PowerLaw of the mean curve: least squares of ln(vt/h) on ln X, equal weight for each abscissa.

    x : X, shape (abscissae,), logarithmically uniform (viscorough_study.ensembles.abscissa)
    velocity : vt/h, shape (realizations, abscissae), nan where undefined
    window : (X_low, X_high), ends included; average : "arithmetic" or "geometric" mean over the realizations
    resamples : of the bootstrap; seed : int or SeedSequence. The same seed draws the same realizations for
        every window and average, so that the bootstrap does not blur differences between conventions.

    Raises ValueError if fewer than three abscissae lie in the window, or one of them has no realization.
    """
    inside = (x >= window[0] * (1 - 1e-9)) & (x <= window[1] * (1 + 1e-9))
    if inside.sum() < 3:
        raise ValueError(f"fit_power_law: {inside.sum()} abscissae in the window, at least 3 are needed")
    log_x, velocity = np.log(x[inside]), velocity[:, inside]
    if not np.isfinite(velocity).any(axis=0).all():
        raise ValueError("fit_power_law: an abscissa of the window has no realization, 1 at least is needed")
    mean = _log_means(velocity, average, resamples, np.random.default_rng(seed))

    offset = log_x - log_x.mean()
    beta = mean @ offset / (offset @ offset)
    height = mean.mean(axis=1) - beta * log_x.mean()
    residual = np.sqrt(np.mean((mean[0] - height[0] - beta[0] * log_x) ** 2))
    return PowerLaw(beta[0], np.exp(height[0]), beta[1:], np.exp(height[1:]), len(velocity), residual)


def match_lambda(x, discs, lines, window, *, average, resamples, seed):
    """λ of the line that penetrates like the surface, and its 95 % interval: (value, low, high).

    A line of the same L and s times the rms height, h1D = s h2D, has X1 = X/s and vt/h2D = s vt/h1D: the mean
    curves y3 of discs and y1 of lines match at X where y3(X) = s y1(X/s), that is y3(X)/X = y1(X1)/X1, the
    mean of 1/κ. Solved at the geometric centre of the window, between abscissae by interpolation of the
    logarithms. C1D = π q C2D has equal rms heights, C1D = λ q C2D has (h1D/h2D)² = λ/π (Eq. 13 and below), so
    λ = π s².

    x : X of both, shape (abscissae,); discs, lines : vt/h, (realizations, abscissae), nan where undefined
    window : of the discs; average, resamples, seed : as in fit_power_law. Both ensembles are resampled.
    Raises ValueError if the lines, where all of them are defined, do not reach the stiffness of the discs.
    """
    generator, log_x, centre = np.random.default_rng(seed), np.log(x), np.log(window[0] * window[1]) / 2
    complete = np.isfinite(lines).all(axis=0)
    softness = _log_means(discs, average, resamples, generator) - log_x
    of_lines = _log_means(lines, average, resamples, generator) - log_x
    values = np.full(resamples + 1, np.nan)
    for i in range(len(values) if complete.any() else 0):
        target = np.interp(centre, log_x, softness[i])
        # falls as X grows, and stays only where each line has one element in contact, left of every window
        falling = of_lines[i, complete][::-1]
        log_x1 = np.interp(target, falling, log_x[complete][::-1], left=np.nan, right=np.nan)
        values[i] = np.pi * np.exp(2 * (centre - log_x1))
    if np.isnan(values[0]):
        raise ValueError("match_lambda: the lines do not reach the stiffness of the discs, all of them must")
    return values[0], *_interval(values[1:], min(len(discs), len(lines)))


def _log_means(velocity, average, resamples, generator):
    """ln of the mean of vt/h over the realizations defined: of the ensemble, then of each resample."""
    if average not in AVERAGES:
        raise ValueError(f"average: must be one of {AVERAGES}, not {average!r}")
    n = len(velocity)
    weights = np.vstack([np.ones(n), generator.multinomial(n, np.full(n, 1 / n), size=resamples)])
    defined = np.isfinite(velocity)
    known = np.where(defined, velocity, 1)
    values = np.where(defined, np.log(known) if average == "geometric" else known, 0)
    with np.errstate(invalid="ignore", divide="ignore"):  # nan where a resample has no realization
        mean = (weights @ values) / (weights @ defined)
    return mean if average == "geometric" else np.log(mean)


def _interval(samples, realizations):
    """95 % interval (low, high) of bootstrap samples: percentiles, widened for few realizations.

    Plain percentiles are too narrow for small n. The levels Φ(∓√(n/(n−1)) t), t the 97.5 % point of Student's
    t with n − 1 degrees of freedom, make them the t interval for a mean (Hesterberg, The American
    Statistician 69, 371 (2015): expanded percentile interval). Nan for a single realization.
    """
    samples = samples[np.isfinite(samples)]
    if realizations < 2 or samples.size == 0:
        return np.nan, np.nan
    tail = ndtr(-np.sqrt(realizations / (realizations - 1)) * stdtrit(realizations - 1, 0.975))
    low, high = np.quantile(samples, [tail, 1 - tail])
    return low, high


def scaling_rows(ensemble, *, source, case_group, lines=None, resamples, seed, **limits):
    """Rows of the scaling table (dicts with the keys of COLUMNS) of one ensemble under every convention.

    One row per rms convention, average, window, reading of the law (gamma) and meaning of L. The last two
    only rescale ζ and, for L, the window: they follow from the same fit. Where there is no window the row has
    nan and no decades.

    ensemble, lines : ensemble datasets (viscorough_study.ensembles); lines of the same Hurst exponent and abscissae,
        for λ. λ is nan without them, or where they do not reach the stiffness of the discs
    limits : elements_min, stiffness_max, slope_max, stiffness_range of named_windows
    Raises ValueError for unlike abscissae, or so coarse ones that a window has fewer than three.
    """
    x = ensemble["x"].values
    if lines is not None and not np.array_equal(x, lines["x"].values):
        raise ValueError("scaling_rows: discs and lines must have the same abscissae")
    common = {"source": source, "case_group": case_group, "hurst": ensemble["hurst"].item()}
    rows = []
    for rms_convention in ensemble["rms_convention"].values.tolist():
        one = ensemble.sel(rms_convention=rms_convention)
        velocity, windows = one["velocity"].values, named_windows(one, **limits)
        common |= {"rms_convention": rms_convention, "realizations": len(velocity)}
        for average, (rule, window) in product(AVERAGES, windows.items()):
            how = {"average": average, "resamples": resamples, "seed": seed}
            fit = None if window is None else fit_power_law(x, velocity, window, **how)
            matched = (np.nan,) * 3
            if fit is not None and lines is not None:
                with suppress(ValueError):
                    matched = match_lambda(x, velocity, lines["velocity"].values[0], window, **how)
            about = common | {"average": average, "window_rule": rule}
            about |= dict(zip(("lambda", "lambda_low", "lambda_high"), matched, strict=True))
            readings = product((False, True), DIAMETER_CONVENTIONS)
            rows += [_row(about, window, fit, gamma, diameter) for gamma, diameter in readings]
    return rows


def _row(about, window, fit, gamma, diameter):
    """One row, its keys in the order of COLUMNS."""
    row = dict.fromkeys(COLUMNS, np.nan) | about
    row |= {"gamma": "with" if gamma else "without", "diameter_convention": diameter, "decades": 0.0}
    if fit is not None:
        low, high = np.array(window) * (2 if diameter == "radius" else 1)
        row |= {"x_low": low, "x_high": high, "decades": np.log10(high / low)}
        row |= {"beta": fit.beta, "residual": fit.residual}
        row["beta_low"], row["beta_high"] = fit.beta_interval
        row["zeta"], row["zeta_low"], row["zeta_high"] = fit.zeta(gamma=gamma, diameter_convention=diameter)
    return row
