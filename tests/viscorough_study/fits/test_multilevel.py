"""Check the means on several grids by generalised least squares: exactness, scatter, intervals and limits."""

import numpy as np
import pytest

from viscorough_study.fits.multilevel import GridMeans, Nest, grid_means, measured_covariance, simulated, slope_weights

GRIDS = (65, 33, 17)  # from fine to coarse
MEANS = np.array([0.30, 0.32, 0.38])
FACTOR = 0.1 * np.array([[1.0, 0.2, 0.1], [0.95, 0.3, 0.0], [0.8, 0.0, 0.0]])
DESIGN = (((65, 33), 25), ((65, 33, 17), 30), ((33, 17), 60), ((17,), 400))


def drawn(random, design=DESIGN):
    """Return nests of normal values with the means `MEANS` and the covariance of `FACTOR` on `GRIDS`."""
    nests = []
    for grids, surfaces in design:
        values = MEANS + random.standard_normal((surfaces, 3)) @ FACTOR.T
        nests.append(Nest(grids, values[:, [GRIDS.index(across) for across in grids]]))
    return nests


def test_slope_of_a_line_is_exact():
    log_x = np.log([0.1, 0.2, 0.5, 1.0])
    assert (3.0 - 0.4 * log_x) @ slope_weights(log_x) == pytest.approx(-0.4, rel=1e-12)


def test_means_of_the_same_surfaces_on_all_grids_are_their_plain_means():
    (nest,) = drawn(np.random.default_rng(1), [(GRIDS, 40)])
    parts = [Nest(nest.grids, nest.values[:15]), Nest(nest.grids, nest.values[15:])]
    assert grid_means([nest]).means == pytest.approx(nest.values.mean(axis=0)[::-1], rel=1e-12)
    assert grid_means(parts).means == pytest.approx(nest.values.mean(axis=0)[::-1], rel=1e-12)


def test_means_minimise_the_weighted_squares():
    nests = drawn(np.random.default_rng(2))
    rows, values = [], []
    for nest in nests:
        covariance = measured_covariance(nests, nest.grids)[0] / len(nest.values)
        root = np.linalg.inv(np.linalg.cholesky(covariance))
        rows.append(root @ np.array([[float(across == grid) for grid in GRIDS] for across in nest.grids]))
        values.append(root @ nest.values.mean(axis=0))
    expected = np.linalg.lstsq(np.concatenate(rows), np.concatenate(values), rcond=None)[0]
    assert grid_means(nests).means[::-1] == pytest.approx(expected, rel=1e-10)


def test_covariance_comes_from_all_nests_with_these_grids():
    nests = drawn(np.random.default_rng(3))
    covariance, freedom = measured_covariance(nests, (65, 33))
    offsets = np.concatenate([nest.values[:, :2] - nest.values[:, :2].mean(axis=0) for nest in nests[:2]])
    assert freedom == 25 + 30 - 2
    assert covariance == pytest.approx(offsets.T @ offsets / freedom, rel=1e-12)


def test_estimate_is_unbiased_and_scatters_by_its_stated_covariance():
    random = np.random.default_rng(4)
    found = [grid_means(drawn(random)) for _ in range(1500)]
    values = np.array([each.means for each in found])
    stated = np.mean([sum(each.covariances) for each in found], axis=0)
    assert np.abs(values.mean(axis=0) - MEANS[::-1]).max() < 4 * np.sqrt(stated.max() / len(found))
    assert np.diag(np.cov(values.T)) == pytest.approx(np.diag(stated), rel=0.12)
    plain = (FACTOR @ FACTOR.T)[0, 0] / (25 + 30)  # variance of the mean on the finest grid alone
    assert stated[-1, -1] < 0.6 * plain


@pytest.mark.parametrize("finest", [12, 60])
def test_interval_contains_the_mean_with_covariances_estimated_anew(finest):
    random = np.random.default_rng(5)
    design = [(GRIDS, finest), ((33, 17), 2 * finest), ((17,), 20 * finest)]
    ends = np.array([grid_means(drawn(random, design)).on(65)[1:] for _ in range(1000)])
    assert 0.93 < np.mean((ends[:, 0] <= MEANS[0]) & (ends[:, 1] >= MEANS[0])) < 0.97


def test_simulated_sets_have_the_measured_covariance_and_the_given_mean():
    nests = drawn(np.random.default_rng(6))
    values = np.array([each.means for each in simulated(nests, 0.25, 600, seed=1)])
    stated = sum(grid_means(nests).covariances)
    assert values.mean(axis=0) == pytest.approx(0.25, abs=4 * np.sqrt(stated.max() / 600))
    assert np.cov(values.T)[-1, -1] == pytest.approx(stated[-1, -1], rel=0.25)


def test_limit_is_the_union_over_all_ratios_of_successive_differences():
    means = GridMeans([17, 33, 65], np.array([0.5, 0.4, 0.37]), [np.diag([4e-4, 2e-4, 1e-4])], [40])
    bound = (33 / 65) ** 0.4
    intervals = [means.combination([0, -r / (1 - r), 1 + r / (1 - r)]) for r in np.linspace(0, bound, 50)]
    middle, low, high = means.limit(0.4)
    assert low == pytest.approx(min(low for _, low, _ in intervals))
    assert high == pytest.approx(max(high for _, _, high in intervals))
    assert middle == pytest.approx((low + high) / 2)
    assert low < 0.37 - 0.03 * bound / (1 - bound) < means.on(65)[1] < high


def test_too_few_surfaces_for_the_covariance_raise():
    with pytest.raises(ValueError, match=r"the nest on the grids 65, 33, 17 has 4 surfaces; allowed: at least 5"):
        grid_means(drawn(np.random.default_rng(7), [(GRIDS, 4)]))
