"""Extreme values of functions of non-negative unknowns, against a nested search with a prescribed value."""

import numpy as np
import pytest
from scipy.optimize import brentq, nnls

from viscorough.media.free_form import creep_columns
from viscorough.viscous.fit.linear import extremes, non_negative

PRESCRIBED = 1e5  # weight of the equation that prescribes a value


def farthest(matrix, target, row, distance, sign):
    """Return row·x on one side of the best fit, such that the best x ≥ 0 with this value is worse by distance²."""
    best, least = nnls(matrix, target)

    def excess(value):
        x = nnls(np.vstack([matrix, PRESCRIBED * row]), np.append(target, PRESCRIBED * value))[0]
        return np.sum((matrix @ x - target) ** 2) - least**2 - distance**2

    return brentq(excess, row @ best, row @ best + sign * 50, xtol=1e-9)


@pytest.mark.parametrize("shape", [(12, 6), (6, 6), (9, 14)])
def test_extremes_agree_with_a_nested_search(shape):
    """Coefficients have both signs, so both extremes exist; bounds are active at most of them."""
    random = np.random.default_rng(shape)
    matrix = random.normal(size=shape) + 0.5
    target = matrix @ np.maximum(random.normal(size=shape[1]), 0) + 0.3 * random.normal(size=shape[0])
    functions = matrix[:3] * 0.7  # the rows determine these functions
    low, high = extremes(matrix, target, functions, nnls(matrix, target)[1] ** 2 + 0.4**2)
    for ends, sign in ((low, -1), (high, 1)):
        expected = [farthest(matrix, target, row, 0.4, sign) for row in functions]
        np.testing.assert_allclose(ends, expected, rtol=0, atol=0.01 * 0.4 * 3)


def test_extreme_ends_at_an_active_bound():
    """x ≥ 0 keeps the smallest x at 0, although the residual would allow less."""
    low, high = extremes(np.eye(2), np.array([0.1, 1.0]), np.eye(2), 0.5**2)
    np.testing.assert_allclose(low, [0.0, 0.5], atol=0.01)
    np.testing.assert_allclose(high, [0.6, 1.5], atol=0.01)


def test_best_fit_is_non_negative():
    matrix, target = np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]), np.array([1.0, -1.0, 0.5])
    np.testing.assert_allclose(non_negative(matrix, target)[0], [0.75, 0.0], atol=1e-12)


def test_unknowns_of_any_sign_are_differences_of_non_negative_ones():
    """The same fit and the same extremes as with two columns of opposite signs, found by the nested search."""
    random = np.random.default_rng(3)
    matrix, signed = random.normal(size=(14, 5)) + 0.5, random.normal(size=(14, 2))
    target = matrix @ [0.0, 1.0, 0.0, 2.0, 0.5] + signed @ [-1.5, 0.7] + 0.1 * random.normal(size=14)
    both = np.hstack([matrix, signed, -signed])
    x, z = non_negative(matrix, target, signed)
    best, least = nnls(both, target)
    np.testing.assert_allclose(np.append(x, z), np.append(best[:5], best[5:7] - best[7:]), atol=1e-9)
    low, high = extremes(matrix, target, np.eye(5)[:1], least**2 + 0.4**2, signed)
    rows = np.zeros((3, 9))
    rows[0, 0], rows[1, [5, 7]], rows[2, [6, 8]] = 1.0, (1.0, -1.0), (1.0, -1.0)
    for k, row in enumerate(rows):
        assert high[k] == pytest.approx(farthest(both, target, row, 0.4, 1), abs=0.01)
        if k:
            assert low[k] == pytest.approx(farthest(both, target, row, 0.4, -1), abs=0.01)


def test_extremes_of_nearly_dependent_columns_reach_the_distance():
    """The drift t and many delayed elements nearly replace each other, so the first guess of λ is far too small."""
    times = np.geomspace(0.02, 60, 50)
    matrix, signed = creep_columns(times, np.geomspace(0.007, 180, 46)), times[:, None]
    noise = 1e-3 * np.random.default_rng(7).standard_normal(50)
    target = -np.expm1(-times / 2.5) + 2e-4 * times + noise

    def squares(drift):
        x, _ = non_negative(matrix, target - drift * times)
        return np.sum((matrix @ x + drift * times - target) ** 2)

    _, (best,) = non_negative(matrix, target, signed)
    _, high = extremes(matrix, target, matrix[:0], squares(best) + 5e-3**2, signed)
    assert squares(high[0]) - squares(best) == pytest.approx(5e-3**2, rel=0.03)


def test_function_of_unknowns_without_effect_is_not_determined():
    matrix, signed = np.array([[1.0, 0.0], [2.0, 0.0]]), np.zeros((2, 1))
    low, high = extremes(matrix, np.array([1.0, 2.0]), np.eye(2), 0.1, signed)
    np.testing.assert_array_equal(np.isnan(low), [False, True, True])
    np.testing.assert_array_equal(np.isnan(high), [False, True, True])
    np.testing.assert_array_equal(non_negative(matrix, np.array([1.0, 2.0]), signed)[1], [0.0])
