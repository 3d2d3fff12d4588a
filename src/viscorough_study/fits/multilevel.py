"""Estimate the mean of a quantity on several grids from the same surfaces, and bound its limit on finer grids.

A nest is a set of surfaces that are indented on the same grids (viscorough_study.ensembles.nested_grids). Many surfaces
on coarse grids and few on the finest give the means β on all grids. Nest g with n_g surfaces gives the mean vector y_g
on its grids, with the covariance C_g = Σ_g/n_g. The matrix R_g selects these grids from all grids. Generalised least
squares over all nests is the unbiased linear estimate with the smallest variance,

    β = (Σ R_g' C_g⁻¹ R_g)⁻¹ Σ R_g' C_g⁻¹ y_g        (Schaden and Ullmann, SIAM/ASA JUQ 8, 601 (2020))

Coarse grids with many surfaces are control variates of the finer grids. Σ_g is measured, from all nests whose surfaces
are indented on all grids of g. A matrix from other surfaces for each of its elements need not be positive definite: the
grids are so similar that the variance of a difference is small beside the variances.

Waves beyond the finest grid change the mean less and less. Their contribution to the rms height falls like q^−H with
the wave number q, so the ratio r of successive differences is at most (coarse/fine)^H, with the numbers of elements
across the last two grids. With the last difference D, the remainder is D r/(1 − r). The interval of the limit is the
union of the intervals for all r from 0 to the bound; the remainder is monotonic in r, so the two ends suffice.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit


@dataclass(frozen=True)
class Nest:
    """Values of the same surfaces on several grids.

    grids : elements across the discs on the grids; values : shape (surfaces, grids)
    """

    grids: tuple[int, ...]
    values: np.ndarray


@dataclass(frozen=True)
class GridMeans:
    """Means on all grids, by generalised least squares.

    grids : elements across the discs, from coarse to fine
    means : shape (grids,)
    covariances : for each nest, the covariance of the means as far as it comes from this nest, shape (grids, grids)
    freedoms : degrees of freedom of these covariances
    """

    grids: list[int]
    means: np.ndarray
    covariances: list[np.ndarray]
    freedoms: list[int]

    def combination(self, coefficients):
        """Return the sum of coefficients times means with its 95 % interval: (value, low, high).

        The interval uses Student's t with the degrees of freedom of a sum of variances (Welch and Satterthwaite).
        """
        coefficients = np.asarray(coefficients, float)
        variances = np.array([coefficients @ covariance @ coefficients for covariance in self.covariances])
        freedom = variances.sum() ** 2 / np.sum(variances**2 / self.freedoms)
        value, half = coefficients @ self.means, stdtrit(freedom, 0.975) * np.sqrt(variances.sum())
        return value, value - half, value + half

    def on(self, across):
        """Return (value, low, high) of the mean on a grid."""
        return self.combination([float(grid == across) for grid in self.grids])

    def limit(self, hurst):
        """Return (middle, low, high) of the interval of the limit on finer grids; hurst : Hurst exponent H."""
        finest, difference = np.zeros((2, len(self.grids)))
        finest[-1], difference[-2:] = 1.0, (-1.0, 1.0)
        largest = (self.grids[-2] / self.grids[-1]) ** hurst
        ends = [self.combination(finest + r / (1 - r) * difference)[1:] for r in (0.0, largest)]
        low, high = min(low for low, _ in ends), max(high for _, high in ends)
        return (low + high) / 2, low, high


def slope_weights(log_x):
    """Return weights whose sum of products with a curve is the slope of a least-squares line; log_x : ln X."""
    offset = log_x - log_x.mean()
    return offset / (offset @ offset)


def measured_covariance(nests, grids):
    """Return the covariance of values on some grids between surfaces, shape (grids, grids), and its degrees of freedom.

    It is pooled over all nests that contain all these grids; each nest has its own mean.
    """
    products, freedom = np.zeros((len(grids), len(grids))), 0
    for nest in nests:
        if set(grids) <= set(nest.grids):
            values = nest.values[:, [nest.grids.index(grid) for grid in grids]]
            offsets = values - values.mean(axis=0)
            products += offsets.T @ offsets
            freedom += len(values) - 1
    return products / freedom, freedom


def grid_means(nests):
    """Estimate the mean on every grid; return `GridMeans`.

    The covariance of a nest of k grids is estimated with m degrees of freedom, and p = k − 1 grids serve as control
    variates of another one. As for a regression with p coefficients, the variance grows by the factor
    m(m − 1)/((m − p)(m − p − 1)), and m − p degrees of freedom remain (Lavenberg and Welch, Manage. Sci. 27, 322
    (1981)). Raises ValueError if a nest has fewer than k + 2 surfaces.
    """
    grids = sorted({grid for nest in nests for grid in nest.grids})
    information, parts = np.zeros((len(grids), len(grids))), []
    for nest in nests:
        controls = len(nest.grids) - 1
        covariance, freedom = measured_covariance(nests, nest.grids)
        if freedom < controls + 2:
            raise ValueError(
                f"grid_means: the nest on the grids {', '.join(map(str, nest.grids))} has {len(nest.values)} surfaces; "
                f"allowed: at least {controls + 3}"
            )
        selection = np.eye(len(grids))[[grids.index(grid) for grid in nest.grids]]
        weights = selection.T @ np.linalg.inv(covariance / len(nest.values))
        information += weights @ selection
        growth = freedom * (freedom - 1) / ((freedom - controls) * (freedom - controls - 1))
        parts.append((weights @ nest.values.mean(axis=0), growth * weights @ selection, freedom - controls))
    inverse = np.linalg.inv(information)
    return GridMeans(
        grids=grids,
        means=inverse @ sum(mean for mean, _, _ in parts),
        covariances=[inverse @ part @ inverse for _, part, _ in parts],
        freedoms=[freedom for _, _, freedom in parts],
    )


def simulated(nests, mean, sets, seed):
    """Yield the `GridMeans` of simulated sets of surfaces with the measured covariances.

    Each set has the numbers of surfaces and the grids of the nests, normal values, and the same mean on all grids. The
    covariances are estimated anew from each set.

    mean : mean on all grids; sets : number of sets; seed : int or SeedSequence
    """
    random = np.random.default_rng(seed)
    factors = [np.linalg.cholesky(measured_covariance(nests, nest.grids)[0]) for nest in nests]
    for _ in range(sets):
        yield grid_means(
            [
                Nest(nest.grids, mean + random.standard_normal(nest.values.shape) @ factor.T)
                for nest, factor in zip(nests, factors, strict=True)
            ]
        )
