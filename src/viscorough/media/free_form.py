"""Fit of springs and dashpots to samples of a creep compliance J(t) or a relaxation modulus ψ(t).

Every linear medium that relaxes consists of springs and dashpots (docs/theory.md). So samples of J are fitted by a
spring, a dashpot and many Kelvin-Voigt elements in series,

    J(t) = J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)),

and samples of ψ by a spring and many Maxwell branches in parallel. The times θ_j are given, and the strengths J₀, φ and
J_j are the non-negative numbers with the least sum of squared relative errors (Lawson and Hanson 1974). Most of them
are zero. The fit needs no parameters of smoothness, because a non-negative sum cannot follow noise: between two rows it
is better than a straight line.

The times begin with a grid of equal ratios. It is then refined next to the times of positive strengths, because a
single relaxation time may lie between two times of the grid.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.optimize import nnls

from viscorough.basics.types import Array
from viscorough.media.spectra import RelaxationSpectrum, RetardationSpectrum

# Number of times of the grid per decade. With 8, the misfit of power laws and of logarithmic creep is 1e-11.
_PER_DECADE = 8
# The grid extends beyond the first and the last time of the samples by this factor.
_MARGIN = 10.0
# Around each time of positive strength, this number of times replaces the interval between its two neighbours.
_FINER = 7
# Largest number of refinements. A refinement must reduce the misfit to this share of the misfit before, and they end
# below the last misfit, which no record needs.
_REFINEMENTS, _LEAST_GAIN, _SMALLEST_MISFIT = 8, 0.98, 1e-11
# Elements faster than the first row must reduce the root mean square of the errors to this share.
_CLEARLY = 0.5
# Elements that contribute less than this share of J or ψ to every sample are left out.
_NEGLIGIBLE = 1e-13
# Elements whose times differ by less than this share count as a single element. This changes J and ψ by 1e-9 of
# their share.
_NEARLY_EQUAL = 1e-4


class Fit(NamedTuple):
    """Strengths of springs and dashpots that are fitted to samples, and the relative errors of the fit.

    first, second : J₀ and φ of a fit of J; ψ has only the relaxed modulus G∞, and `second` is 0
    strengths, times : compliances J_j and retardation times θ_j, or moduli G_i and relaxation times τ_i, of the
        elements; shape (elements,)
    errors : fitted divided by given value, minus 1, at each sample; shape (samples,). The size of samples that
        are zero or negative by noise is taken from their neighbours
    """

    first: float
    second: float
    strengths: Array
    times: Array
    errors: Array

    @property
    def retardation(self) -> RetardationSpectrum:
        """Return the spectrum of a fit of J."""
        return RetardationSpectrum(self.first, self.second, self.strengths, self.times)

    @property
    def relaxation(self) -> RelaxationSpectrum:
        """Return the spectrum of a fit of ψ."""
        return RelaxationSpectrum(0.0, self.first, self.strengths, self.times)


def grid_of_times(first: float, last: float) -> Array:
    """Return retardation or relaxation times of equal ratios, from a tenth of `first` to ten times `last`."""
    decades = np.log10(last / first) + 2 * np.log10(_MARGIN)
    return np.geomspace(first / _MARGIN, last * _MARGIN, int(np.ceil(_PER_DECADE * decades)) + 1)


def creep_columns(times: Array, retardation_times: Array) -> Array:
    """Return J of a spring, a dashpot and each Kelvin-Voigt element of unit strength, shape (times, 2 + elements).

    times : times t ≥ 0, shape (times,)
    retardation_times : θ_j of the elements, shape (elements,)
    """
    delayed = -np.expm1(-times[:, None] / retardation_times)
    return np.column_stack([np.ones(times.size), times, delayed])


def relaxation_columns(times: Array, relaxation_times: Array) -> Array:
    """Return ψ of a spring and of each Maxwell branch of unit strength, shape (times, 1 + branches).

    times : times t ≥ 0, shape (times,)
    relaxation_times : τ_i of the branches, shape (branches,)
    """
    return np.column_stack([np.ones(times.size), np.exp(-times[:, None] / relaxation_times)])


def fit_creep(times: Array, compliances: Array) -> Fit:
    """Fit a spring, a dashpot and Kelvin-Voigt elements to samples of J.

    times : times t ≥ 0, which increase, shape (samples,)
    compliances : J at these times, at least one of them above 0, shape (samples,)
    """
    size = np.maximum.accumulate(np.maximum(compliances, 0.0))  # J does not decrease, except for noise
    size = np.where(size > 0, size, size[size > 0].min())
    return _refined(creep_columns, 2, times, compliances, size)


def fit_relaxation(times: Array, moduli: Array) -> Fit:
    """Fit a spring and Maxwell branches to samples of ψ.

    times : times t ≥ 0, which increase, shape (samples,)
    moduli : ψ at these times, at least one of them above 0, shape (samples,)
    """
    size = np.maximum.accumulate(np.maximum(moduli[::-1], 0.0))[::-1]  # ψ does not increase, except for noise
    size = np.where(size > 0, size, size[size > 0].min())
    return _refined(relaxation_columns, 1, times, moduli, size)


def _refined(columns: Callable[[Array, Array], Array], singles: int, times: Array, values: Array, size: Array) -> Fit:
    """Return the Fit of samples, on a grid of times that is refined where strengths are positive.

    columns : creep_columns or relaxation_columns
    singles : number of the first columns, which belong to the spring and the dashpot
    times, values, size : times of the samples, their values, and the sizes to which the errors are relative
    """
    positive = times[times > 0]
    whole = grid_of_times(positive[0], positive[-1])
    # An element that is faster than the first row could fit the noise of this row with any strength. It is used only if
    # it reduces the errors clearly.
    known = _on_grid(columns, singles, times, values, size, whole[whole > 0.99 * positive[0]])
    fit = _on_grid(columns, singles, times, values, size, whole)
    return fit if _rms(fit.errors) < _CLEARLY * _rms(known.errors) else known


def _on_grid(
    columns: Callable[[Array, Array], Array], singles: int, times: Array, values: Array, size: Array, grid: Array
) -> Fit:
    """Return the Fit of samples with the times of a grid and of its refinements; see `_refined`."""
    best: Fit | None = None
    before = np.inf
    for _ in range(_REFINEMENTS + 1):
        matrix = columns(times, grid) / size[:, None]
        strengths = _non_negative(matrix, values / size)
        errors = matrix @ strengths - values / size
        misfit = _rms(errors)
        if best is not None and misfit > _LEAST_GAIN * before:
            break
        kept = (strengths * matrix.max(axis=0) > _NEGLIGIBLE)[singles:]
        elements = _merged(strengths[singles:][kept], grid[kept])
        best = Fit(float(strengths[0]), float(strengths[1]) if singles == 2 else 0.0, *elements, errors)
        if misfit < _SMALLEST_MISFIT or not kept.any():
            break
        before, grid = misfit, _finer(grid, kept)
    assert best is not None
    return best


def _rms(errors: Array) -> float:
    return float(np.sqrt(np.mean(errors**2)))


def _merged(strengths: Array, times: Array) -> tuple[Array, Array]:
    """Merge elements whose times are nearly equal; return strengths and times of the remaining elements."""
    if not times.size:
        return strengths, times
    starts = np.flatnonzero(np.append(True, np.diff(np.log(times)) > _NEARLY_EQUAL))
    total = np.add.reduceat(strengths, starts)
    return total, np.exp(np.add.reduceat(strengths * np.log(times), starts) / total)


def _finer(grid: Array, active: Array) -> Array:
    """Return the times of a refined grid, in increasing order.

    grid : times of the grid, which increase
    active : whether the strength of each time is positive
    """
    logs = np.log(grid)
    ends = np.concatenate([[2 * logs[0] - logs[1]], logs, [2 * logs[-1] - logs[-2]]])
    place = np.flatnonzero(active)
    finer = np.linspace(ends[place], ends[place + 2], _FINER + 2)[1:-1]
    merged = np.unique(np.concatenate([logs[place], finer.ravel()]))
    return np.exp(merged[np.append(True, np.diff(merged) > 1e-9)])


def _non_negative(matrix: Array, values: Array) -> Array:
    """Return the x ≥ 0 with the least |matrix x − values|; columns of any size are allowed."""
    scale = np.sqrt((matrix**2).sum(axis=0))
    return nnls(matrix / scale, values, maxiter=30 * matrix.shape[1])[0] / scale
