"""The sparse approximate inverse against exact ones."""

import numpy as np
import pytest

from viscorough.halfspace import influence_coefficient
from viscorough.preconditioner import REACH, offsets, patterns, precondition, relief, table

WIDTH = 20


def influence(places):
    row, column = np.divmod(places.astype(float), WIDTH)
    return influence_coefficient(row[:, None] - row, column[:, None] - column)


def approximate_inverse(inside):
    """M as a matrix, column by column, on the set."""
    places = np.flatnonzero(inside)
    before = offsets(WIDTH)
    work, result, columns = np.zeros(inside.size), np.empty(places.size), []
    for place in places:
        residual = np.full(inside.size, 1e300)  # what lies outside the set must not count
        residual[places] = 0
        residual[place] = 1
        pattern = patterns(inside, places, before)
        precondition(residual, places, pattern, table(), before, work, result)
        columns.append(result.copy())
    assert not work.any()
    return places, np.array(columns).T


@pytest.mark.parametrize("present", [0b111111111, 0b101101011, 0b100000000, 0b010111010])
def test_exact_for_sets_within_reach(present):
    inside = np.zeros((WIDTH, WIDTH), dtype=bool)
    inside[7:10, 11:14] = (present >> np.arange(9) & 1).reshape(3, 3)
    places, inverse = approximate_inverse(inside.ravel())
    np.testing.assert_allclose(inverse, np.linalg.inv(influence(places)), atol=1e-13)


def test_symmetric_positive_and_close_to_the_inverse_for_any_set():
    inside = np.zeros((WIDTH, WIDTH), dtype=bool)
    inside[REACH:-REACH, REACH:-REACH] = np.random.default_rng(1).random((16, 16)) < 0.6
    places, inverse = approximate_inverse(inside.ravel())
    np.testing.assert_allclose(inverse, inverse.T, atol=1e-14)
    alone = np.linalg.eigvalsh(influence(places))
    together = np.linalg.eigvals(inverse @ influence(places)).real
    assert together.min() > 0
    assert together.max() / together.min() < 0.3 * alone.max() / alone.min()


def test_relief_is_elimination_among_the_neighbours():
    row, column = np.divmod(np.arange(25), 5)
    inverse = np.linalg.inv(influence(row * WIDTH + column))
    others = np.arange(25) != 12
    # Without the element the others solve their own system; the change is what it had from them.
    matrix = influence(row * WIDTH + column)
    deflection = np.random.default_rng(2).random(25)
    load = inverse @ deflection
    change = np.linalg.solve(matrix[np.ix_(others, others)], deflection[others]) - load[others]
    near = np.isin(np.flatnonzero(others), [6, 7, 8, 11, 13, 16, 17, 18])
    np.testing.assert_allclose(change[near], load[12] * relief().ravel()[[0, 1, 2, 3, 5, 6, 7, 8]], rtol=1e-9)
