"""The Cholesky factor that grows with the contact set, against a full factorisation."""

import numpy as np

from viscorough.contact.growing_cholesky import append_element, solve_flat_punch
from viscorough.contact.influence import influence_coefficient


def test_factor_and_flat_punch_are_those_of_the_full_matrix():
    row, column = np.divmod(np.random.default_rng(1).permutation(36), 6)
    influence = influence_coefficient(np.arange(6.0)[:, None], np.arange(6.0)[None, :])
    matrix = influence_coefficient(np.subtract.outer(row, row) * 1.0, np.subtract.outer(column, column) * 1.0)
    order = np.random.default_rng(2).permutation(36)[:20]
    factor, members = np.zeros((20, 20)), np.empty(20, np.int64)
    forward, tangent = np.zeros(20), np.zeros(20)
    for count, element in enumerate(order):
        append_element(factor, influence, row, column, members, count, element, forward)
        part = matrix[np.ix_(order[: count + 1], order[: count + 1])]
        total = solve_flat_punch(factor, count + 1, forward, tangent)
        exact = np.linalg.solve(part, np.ones(count + 1))
        np.testing.assert_allclose(tangent[: count + 1], exact, rtol=1e-11)
        np.testing.assert_allclose(total, exact.sum(), rtol=1e-12)
    np.testing.assert_array_equal(members, order)
    np.testing.assert_allclose(factor @ factor.T, part, atol=1e-13)
