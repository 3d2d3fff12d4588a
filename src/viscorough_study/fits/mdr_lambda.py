"""Find the factor λ in C1D = λ q C2D (paper, Eq. 13) that makes a line equivalent to a rough surface, and its error.

C1D is the power spectrum of the line, C2D is the power spectrum of the surface, and q is the wave number. X = F/(4GhL)
is the reduced force.

A line of the same L whose rms height is s times the rms height of the surface, h1D = s h2D, has X1 = X/s and vt/h2D = s
vt/h1D. Let y3(X) be the mean vt/h of discs, and y1(X) of lines. They match at X if y3(X) = s y1(X/s), that
is, if y3(X)/X = y1(X1)/X1; both sides are means of 1/κ. The rms heights are equal for C1D = π q C2D, and C1D = λ q C2D
gives (h1D/h2D)² = λ/π, so λ = π s².

In general s depends on X. A factor λ that depends on the Hurst exponent alone is exact only if s is the same for all X.
"""

from dataclasses import dataclass

import numpy as np

from viscorough_study.fits.intervals import with_interval
from viscorough_study.fits.power_law import in_window, log_means

_BISECTIONS = 40  # number of bisections for ln s; the remaining error is far below the rounding of λ in the tables


@dataclass(frozen=True)
class LineMatch:
    """Mean curves of discs and of lines at the same X, and the factor s that matches the lines to the discs.

    The lines have s times the rms height of the discs (see the module).

    x : X, shape (abscissae,), logarithmically uniform
    discs, lines : ln(y/X), where y is the mean of vt/h over discs or lines; shape (1 + resamples, abscissae). The first
        row belongs to the ensemble, the other rows to bootstrap resamples. `lines` is nan at X that not all lines reach
    realizations : number of discs or number of lines, whichever is smaller; it determines the width of intervals
    """

    x: np.ndarray
    discs: np.ndarray
    lines: np.ndarray
    realizations: int

    def stretch_at(self, x):
        """Return ln s of the factor s that matches the lines to the discs at each X.

        x : number or array of X
        Returns an array of shape (1 + resamples, number of X), with nan if the lines do not reach the value of the
        discs.
        """
        log_chosen, log_x = np.log(np.atleast_1d(x)), np.log(self.x)
        complete = np.isfinite(self.lines[0])
        stretch = np.full((len(self.discs), log_chosen.size), np.nan)
        if not complete.any():
            return stretch
        for row, discs, lines in zip(stretch, self.discs, self.lines, strict=True):
            target = np.interp(log_chosen, log_x, discs)
            # 1/κ decreases with X. It is constant only where every line has a single point in contact; such X are
            # smaller than the X of any window.
            falling = lines[complete][::-1]
            row[:] = log_chosen - np.interp(target, falling, log_x[complete][::-1], left=np.nan, right=np.nan)
        return stretch

    def lambda_at(self, x):
        """Return λ = π s² at each X, with the factor s that matches lines to discs, in the shape of `stretch_at`."""
        return np.pi * np.exp(2 * self.stretch_at(x))

    def lambda_in(self, window):
        """Return λ at the geometric centre of a window of X, (X_low, X_high), with its 95 % interval.

        The result is (value, low, high). λ is nan if the mean curve of the lines does not reach the stiffness of the
        discs.
        """
        return with_interval(self.lambda_at(np.sqrt(window[0] * window[1]))[:, 0], self.realizations)

    def deviation(self, stretch, chosen):
        """Return ln(vt/h of the lines with the factor s) − ln(vt/h of the discs) at chosen abscissae.

        stretch : ln s, shape (1 + resamples,)
        chosen : mask of the abscissae
        Returns an array of shape (1 + resamples, chosen abscissae); nan beyond the range of the lines.
        """
        log_x, shifted = np.log(self.x), np.log(self.x[chosen]) - stretch[:, None]
        rows = zip(shifted, self.lines, strict=True)
        return [np.interp(x, log_x, lines, left=np.nan, right=np.nan) for x, lines in rows] - self.discs[:, chosen]

    def best_stretch(self, window):
        """Return the ln s that minimizes the largest absolute `deviation` in a window of X, shape (1 + resamples,).

        The deviation increases with s at every X. So for the best s, the largest and the smallest deviation have the
        same size and opposite signs. Values are nan if the lines do not reach the values of the discs in the window.
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
    """Average and resample an ensemble of discs and an ensemble of lines; return their LineMatch.

    x : X of the discs and of the lines, shape (abscissae,)
    discs, lines : vt/h, shape (realizations, abscissae), nan where undefined
    average, resamples, seed : arguments of viscorough_study.fits.power_law.fit_power_law
    """
    generator, log_x = np.random.default_rng(seed), np.log(x)
    disc_curves = log_means(discs, average, resamples, generator) - log_x
    line_curves = log_means(lines, average, resamples, generator) - log_x
    line_curves = np.where(np.isfinite(lines).all(axis=0), line_curves, np.nan)
    return LineMatch(x, disc_curves, line_curves, min(len(discs), len(lines)))
