"""Fit λ in C1D = λ q C2D of the line that represents a surface (paper, Eq. 13), and its residual error.

A line of the same L and s times the rms height, h1D = s h2D, has X1 = X/s and vt/h2D = s vt/h1D. The mean curves y3 of
discs and y1 of lines match at X if y3(X) = s y1(X/s), that is y3(X)/X = y1(X1)/X1, the mean of 1/κ. C1D = π q C2D gives
equal rms heights, C1D = λ q C2D gives (h1D/h2D)² = λ/π, so λ = π s². In general s depends on X; a λ that depends on the
Hurst exponent alone is exact only if s is the same for all X.
"""

from dataclasses import dataclass

import numpy as np

from viscorough_study.fits.intervals import with_interval
from viscorough_study.fits.power_law import in_window, log_means

_BISECTIONS = 40  # bisections of ln s; their error is far below the rounding of λ in the tables


@dataclass(frozen=True)
class LineMatch:
    """Mean curves of discs and lines: of the ensembles in the first row, of their resamples in the others.

    x : X, shape (abscissae,), logarithmically uniform
    discs, lines : ln of the mean of vt/h over X, shape (1 + resamples, abscissae), nan if a line is undefined
    """

    x: np.ndarray
    discs: np.ndarray
    lines: np.ndarray

    def stretch_at(self, x):
        """Return ln s that matches discs and lines at X, shape (1 + resamples, X); nan where the lines do not reach."""
        log_chosen, log_x = np.log(np.atleast_1d(x)), np.log(self.x)
        complete = np.isfinite(self.lines[0])
        stretch = np.full((len(self.discs), log_chosen.size), np.nan)
        if not complete.any():
            return stretch
        for row, discs, lines in zip(stretch, self.discs, self.lines, strict=True):
            target = np.interp(log_chosen, log_x, discs)
            # 1/κ falls with X. It is constant only if every line has one point in contact, which lies below every
            # window.
            falling = lines[complete][::-1]
            row[:] = log_chosen - np.interp(target, falling, log_x[complete][::-1], left=np.nan, right=np.nan)
        return stretch

    def lambda_at(self, x):
        """Return λ that matches discs and lines at X, shape (1 + resamples, X)."""
        return np.pi * np.exp(2 * self.stretch_at(x))

    def deviation(self, stretch, chosen):
        """Return ln of vt/h of the stretched lines over vt/h of the discs, shape (1 + resamples, chosen abscissae).

        stretch : ln s, shape (1 + resamples,); chosen : mask of abscissae; nan beyond the range of the lines
        """
        log_x, shifted = np.log(self.x), np.log(self.x[chosen]) - stretch[:, None]
        rows = zip(shifted, self.lines, strict=True)
        return [np.interp(x, log_x, lines, left=np.nan, right=np.nan) for x, lines in rows] - self.discs[:, chosen]

    def best_stretch(self, window):
        """Return ln s that minimizes the largest deviation over a window of X, shape (1 + resamples,); nan if none
        does.

        At every X the deviation grows with s, so at the minimum the largest deviation occurs with both signs.
        """
        chosen = in_window(self.x, window)
        ends = self.stretch_at(self.x[chosen])
        low, high = ends.min(axis=1), ends.max(axis=1)
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            deviation = self.deviation(middle, chosen)
            too_large = deviation.max(axis=1) + deviation.min(axis=1) > 0
            low, high = np.where(too_large, low, middle), np.where(too_large, middle, high)
        return (low + high) / 2


def match_lines(x, discs, lines, *, average, resamples, seed):
    """Return the LineMatch of an ensemble of discs and an ensemble of lines; both are resampled.

    x : common X, shape (abscissae,); discs, lines : vt/h, (realizations, abscissae), nan where undefined
    average, resamples, seed : as in viscorough_study.fits.power_law.fit_power_law
    """
    generator, log_x = np.random.default_rng(seed), np.log(x)
    disc_curves = log_means(discs, average, resamples, generator) - log_x
    line_curves = log_means(lines, average, resamples, generator) - log_x
    line_curves = np.where(np.isfinite(lines).all(axis=0), line_curves, np.nan)
    return LineMatch(x, disc_curves, line_curves)


def match_lambda(x, discs, lines, window, **options):
    """Return λ at the geometric centre of a window of X, and its 95 % interval: (value, low, high).

    x, discs, lines, options : as in `match_lines`
    Values are nan if the lines do not reach the stiffness of the discs at abscissae with all lines defined.
    """
    match = match_lines(x, discs, lines, **options)
    return with_interval(match.lambda_at(np.sqrt(window[0] * window[1]))[:, 0], min(len(discs), len(lines)))
