"""Errors of means: what models deviate beyond the scatter of their surfaces, and the scatter of a mean of few."""

import numpy as np
import pytest
import xarray as xr

from viscorough_study.comparisons.mean_of_surfaces import _Mean
from viscorough_study.ensembles.averages import with_averages

NUMBER, SCATTER = 400, 0.2
X = np.geomspace(1e-3, 10, 81)


def mean(factor, seed, number=NUMBER):
    """Mean of surfaces with κ = X^0.7, scattered, over a factor of the velocity."""
    generator = np.random.default_rng(seed)
    stiffness = X**0.7 / factor * np.exp(SCATTER * generator.standard_normal((number, 1)))
    curves = xr.Dataset({"stiffness": (("realization", "abscissa"), stiffness)}, coords={"x": ("abscissa", X)})
    curves["contact_count"] = curves["stiffness"] * 0 + 5
    curves = curves.assign_coords(until_x=("realization", np.full(number, X[-1])), elements=797)
    return _Mean(with_averages(curves))


def test_deviation_is_that_of_the_model():
    truth = mean(1.0, 1)
    assert truth.deviation(mean(1.3, 2)) == pytest.approx(np.log(1.3), abs=0.03)
    assert truth.scatter == pytest.approx(SCATTER, rel=0.1)
    assert truth.across == 33


def test_deviation_does_without_what_the_scatter_explains():
    """The difference of two means of the same surfaces has the standard deviation √2 s/√n."""
    means = [mean(1.0, seed, 50) for seed in range(120)]
    deviations = [one.deviation(other) for one, other in zip(means[::2], means[1::2], strict=True)]
    by_chance = SCATTER * np.sqrt(2 / 50)
    assert np.sqrt(np.mean(np.square(deviations))) < 0.9 * by_chance
    assert np.median(deviations) < 0.5 * by_chance
