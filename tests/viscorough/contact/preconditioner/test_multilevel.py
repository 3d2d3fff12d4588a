"""The preconditioner, an approximate inverse, against exact inverses of influence matrices."""

import numpy as np
import pytest
import scipy.linalg

from support.influence import influence_matrix
from viscorough.contact.border import BORDER
from viscorough.contact.preconditioner import LEAST_EIGENVALUE, Preconditioner
from viscorough.contact.preconditioner.sparse_factor import SparseFactor

WIDTH = 20


def influence(places, width=WIDTH, aspect=1.0):
    return influence_matrix(*np.divmod(places.astype(float), width), aspect)


def approximate_inverse(inside, aspect=1.0, precision=np.float64, before=()):
    """Return the places of a set and the matrix of M on it, column by column, after preparation for other sets."""
    preconditioner = Preconditioner(*inside.shape, aspect=aspect, precision=precision)
    for contact_set in (*before, inside):
        preconditioner.prepare(contact_set.ravel(), np.count_nonzero(contact_set))
    places, columns = np.flatnonzero(inside), []
    for place in places:
        # Values outside the set must not matter.
        residual = np.full(inside.size, np.finfo(precision).max / 1e8, precision)
        residual[places] = 0
        residual[place] = 1
        columns.append(preconditioner.apply(residual)[places])
    return places, np.array(columns, dtype=float).T


def assert_close_to_the_inverse(inside, largest=1.4, aspect=1.0, precision=np.float64, before=()):
    """Steps of length one and the error estimate of the tangent rely on these bounds of the eigenvalues of M K."""
    places, inverse = approximate_inverse(inside, aspect=aspect, precision=precision, before=before)
    np.testing.assert_allclose(inverse, inverse.T, atol=1e-13 if precision == np.float64 else 1e-6)
    # With K = R Rᵀ, M K has the same eigenvalues as Rᵀ M R.
    root = scipy.linalg.cholesky(influence(places, inside.shape[1], aspect), lower=True)
    values = scipy.linalg.eigvalsh(root.T @ (inverse + inverse.T) @ root / 2)
    assert values[0] > LEAST_EIGENVALUE
    assert values[-1] < largest


@pytest.mark.parametrize("aspect", [1.0, 0.3])
@pytest.mark.parametrize("present", [0b111111111, 0b101101011, 0b010111010])
def test_sparse_part_is_exact_for_sets_within_reach(present, aspect):
    inside = np.zeros((WIDTH, WIDTH), dtype=bool)
    inside[7:10, 11:14] = (present >> np.arange(9) & 1).reshape(3, 3)
    factor, places, columns = SparseFactor(*inside.shape, (8, 8), aspect, np.float64), np.flatnonzero(inside), []
    factor.update(inside.ravel())
    for place in places:
        no_correction = 0 * factor.restrict((np.arange(inside.size) == place) * 1.0)
        columns.append(factor.prolong(no_correction)[places])
    np.testing.assert_allclose(columns, np.linalg.inv(influence(places, aspect=aspect)), atol=1e-13)


def sets():
    """Yield contact sets on 96 × 96 elements and on strips: large enough for three levels of the preconditioner."""
    row, column = np.mgrid[:96, :96]
    random = np.random.default_rng(1).random(row.shape)
    hills = sum(np.hypot(row - a, column - b) < 6 for a, b in np.random.default_rng(2).integers(8, 88, (14, 2))) > 0
    yield "scattered", random < 0.12
    yield "hills", hills
    yield "hills with holes", hills & (random < 0.7)
    yield "square", (abs(row - 47.5) < 18) & (abs(column - 47.5) < 18)
    yield "ring", abs(np.hypot(row - 47.5, column - 47.5) - 40) < 2.5
    yield "lines", (row % 8 == 3) & (column > 2)
    yield "cross", (abs(row - 48) < 2) | (abs(column - 48) < 2)
    yield "lattice", (row % 4 == 1) & (column % 4 == 1)
    yield "corner and corner", (row + column < 20) | (row + column > 170)
    yield "one", (row == 50) & (column == 7)
    yield "strip", random.reshape(1, -1)[:, :900] < 0.7
    yield "strip of two rows", random.reshape(2, -1)[:, :450] < 0.7
    yield "full strip", np.ones((400, 1), bool)


# The rectangular elements with the smallest and the largest eigenvalues among all sets above.
RECTANGLES = [("scattered", 2.0), ("lattice", 0.2), ("lattice", 5.0), ("square", 5.0), ("hills with holes", 5.0)]
PROBLEMS = [(*problem, np.float64) for problem in [(name, 1.0) for name, _ in sets()] + RECTANGLES]
ROUNDED_TO_BYTES = [("scattered", 1.0), ("square", 5.0), ("lattice", 5.0), ("strip", 1.0)]
PROBLEMS += [(*problem, np.float32) for problem in ROUNDED_TO_BYTES]


@pytest.mark.parametrize(("name", "aspect", "precision"), PROBLEMS)
def test_preconditioner_is_symmetric_and_close_to_the_inverse(name, aspect, precision):
    inside = np.pad(dict(sets())[name], BORDER)
    assert_close_to_the_inverse(inside, 1.4 if aspect in (1, 2) else 1.6, aspect, precision)


@pytest.mark.parametrize("precision", [np.float64, np.float32])
def test_preconditioner_follows_the_set_on_any_number_of_threads(precision):
    """After few changes only the affected rows of G are renewed, after many changes all rows.

    Between bands of the grid, elements that join change rows of G of the next band. All rows of the first band are
    renewed.
    """
    row, random = np.arange(600)[:, None], np.random.default_rng(9).random((600, 600))
    former = np.pad(random < 0.6, BORDER)
    inside = former ^ np.pad((random < 0.001) | (row < 250) & (random > 0.8), BORDER)
    on_set, residual = inside.ravel(), np.random.default_rng(4).random(inside.size).astype(precision)
    followed, renewed = (SparseFactor(*inside.shape, (8, 8), 1.0, precision, threads) for threads in (3, 1))
    followed.update(former.ravel())
    assert followed.update(on_set) == np.count_nonzero(inside != former)
    renewed.update(on_set)
    np.testing.assert_array_equal(followed.restrict(residual), renewed.restrict(residual))
    np.testing.assert_array_equal(followed.squares, renewed.squares)
    loads = np.random.default_rng(5).random(followed.squares.shape)
    np.testing.assert_array_equal(followed.prolong(loads)[on_set], renewed.prolong(loads)[on_set])

    results = []
    for threads in (1, 3):
        preconditioner = Preconditioner(*inside.shape, precision=precision, threads=threads)
        preconditioner.prepare(on_set, np.count_nonzero(inside))
        results.append(preconditioner.apply(residual)[on_set])
    np.testing.assert_array_equal(*results)


def test_coarse_levels_follow_a_set_that_moves_to_other_blocks():
    left = np.zeros((68, 68), dtype=bool)
    left[BORDER:-BORDER, BORDER : BORDER + 30] = True
    right = left[:, ::-1]
    followed, new = (approximate_inverse(right, before=before)[1] for before in ([left], []))
    np.testing.assert_array_equal(followed, new)


@pytest.mark.parametrize("name", ["square", "scattered"])
def test_coarse_levels_of_a_similar_set_are_kept(name):
    """A small share of the elements may join or leave before the coarse levels are prepared again."""
    inside = np.pad(dict(sets())[name], BORDER)
    members, former = np.flatnonzero(inside), inside.copy()
    left = np.random.default_rng(6).choice(members, int(0.019 * members.size), replace=False)
    former.ravel()[left] = False
    assert_close_to_the_inverse(inside, precision=np.float32, before=[former])
