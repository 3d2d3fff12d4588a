"""Approximate inverse of the influence matrix of a contact set, for steps of conjugate gradients.

For the neighbourhood it is sparse: with G lower triangular, G K Gᵀ ≈ 1. Row i of G holds element i and those of the
twelve nearest ones before it (in rows and columns) that are in contact, and is exact for these few elements alone
(Kolotilina and Yeremin 1993). It depends on nothing but which of the twelve are in contact, so that all 4096 rows that
can occur stand in a table.

What G K Gᵀ has besides 1 is smooth: the deflection by loads far away. It is taken over to blocks of elements. In a
block the smooth part acts along one unit vector w, the row sums of G, so that with W these vectors of all blocks

    G K Gᵀ ≈ 1 + W (a K a) Wᵀ,     M = Gᵀ (1 − W (1 − (1 + a K a)⁻¹) Wᵀ) G ≈ K⁻¹

with a the length of the row sums in each block and K between blocks as between elements. The inverse on the blocks is
found in the same way, from blocks of blocks, down to few enough for a dense one. Eigenvalues of M K lie between about
0.4 and 1.2 for contact sets of any size (tests/test_preconditioner.py); without blocks they reach 20 on 257 × 257.
"""

from functools import cache, lru_cache

import numpy as np
import scipy.linalg

from viscorough.compilation import njit
from viscorough.contact.halfspace import influence_coefficient

# Rows and columns by which neighbours reach out: the width of the border that grids need.
REACH = 2
_ACROSS = 2 * REACH + 1
_BEFORE = [(r, c) for r in range(-REACH, 1) for c in range(-REACH, REACH + 1) if (r, c) < (0, 0)]
_NEIGHBOURS = len(_BEFORE)
# Those of a block of elements: the nearest ones.
_BEFORE_BLOCK = [(-1, -1), (-1, 0), (-1, 1), (0, -1)]
# Elements across a block, blocks across the next block, and blocks across a grid of them that is inverted densely
# (measured on rough discs of 257: 6 to 12 elements and 3 to 5 blocks cost at most 5 % more operators).
_SIDE, _RATIO, _DENSE = 8, 4, 9
# K of a block on itself times its side. The mean over a square is 2.97; what G accounts for is left out (measured:
# 0.75 to 1.25 are alike).
_OWN = 1.0


@cache
def table():
    """Rows of G by pattern, bit s of which tells that neighbour s is in contact; the last entry is the element's own.

    With A the influence matrix of the neighbours in contact and the element, the row is A⁻¹ e / (eᵀ A⁻¹ e)^½, e the
    unit vector of the element. Shape (4096, 13), zero where there is no contact.
    """
    places = np.array([*_BEFORE, (0, 0)], dtype=float)
    row, column = np.moveaxis(places[:, None] - places, -1, 0)
    patterns = np.arange(1 << _NEIGHBOURS)
    present = np.ones((patterns.size, _NEIGHBOURS + 1), dtype=bool)
    present[:, :-1] = patterns[:, None] >> np.arange(_NEIGHBOURS) & 1
    # Neighbours that are not there get an equation of their own.
    both = present[:, :, None] & present[:, None, :]
    matrices = np.where(both, influence_coefficient(row, column), np.eye(_NEIGHBOURS + 1))
    own = np.zeros((patterns.size, _NEIGHBOURS + 1, 1))
    own[:, -1] = 1
    rows = np.linalg.solve(matrices, own)[..., 0]
    return rows / np.sqrt(rows[:, -1:])


@cache
def _sums():
    """Row sums of the table."""
    return table().sum(axis=1)


@cache
def relief():
    """Load that the eight neighbours of an element take over when it leaves the contact, per load; shape (3, 3).

    Its elimination from the influence matrix of the 5 × 5 elements around it; the centre is −1.
    """
    row, column = np.divmod(np.arange(25.0), 5)
    inverse = np.linalg.inv(influence_coefficient(row[:, None] - row, column[:, None] - column))
    return -inverse[12].reshape(5, 5)[1:-1, 1:-1] / inverse[12, 12]


@njit
def _rows(field, place, width):
    """Views of a flat field that begin at the neighbours two rows before a place, one row before, and in its own."""
    return field[place - 2 * width - REACH :], field[place - width - REACH :], field[place - REACH :]


@njit
def _survey(inside, places, width, sums, patterns, weights):
    """Pattern of neighbours in contact, and row sum of G, of every element of the set."""
    for t in range(places.size):
        far, near, own = _rows(inside, places[t], width)
        pattern = own[0] << 2 * _ACROSS | own[1] << 2 * _ACROSS + 1
        for s in range(_ACROSS):
            pattern |= far[s] << s | near[s] << _ACROSS + s
        patterns[t], weights[t] = pattern, sums[pattern]


@njit
def _factorise(amplitude, places, before, slots, kernel, rows, weights):
    """Rows of G for 1 + a K a between blocks, and G a. `kernel` is K between those of a row, the block itself last.

    before, slots : their places relative to the block, and in the row; the other entries of which stay
    """
    count = before.size + 1
    matrix, near = np.empty((count, count)), np.empty(count, np.int64)
    for t in range(places.size):
        near[:-1], near[-1] = places[t] + before, places[t]
        for i in range(count):  # Cholesky factor L of the matrix of these few
            for j in range(i + 1):
                value = kernel[i, j] * amplitude[near[i]] * amplitude[near[j]] + (i == j)
                for k in range(j):
                    value -= matrix[i, k] * matrix[j, k]
                matrix[i, j] = np.sqrt(value) if i == j else value / matrix[j, j]
        row, weights[t] = rows[t], 0.0
        for i in range(count - 1, -1, -1):  # the last row of L⁻¹ is A⁻¹ e / (eᵀ A⁻¹ e)^½
            value = 1.0 * (i == count - 1)
            for k in range(i + 1, count):
                value -= matrix[k, i] * row[slots[k]]
            row[slots[i]] = value / matrix[i, i]
            weights[t] += row[slots[i]] * amplitude[near[i]]


@njit
def _normalise(weights, blocks, squares):
    """Weights to unit length in every block, and the squares of their lengths before."""
    squares[:] = 0
    for t in range(weights.size):
        squares[blocks[t]] += weights[t] * weights[t]
    for t in range(weights.size):
        weights[t] /= np.sqrt(squares[blocks[t]])


@njit(fastmath=True)
def _gather(residual, places, index, rows, width, weights, blocks, values, loads):
    """values = G r on the set, and loads = Wᵀ G r of the blocks."""
    loads[:] = 0
    for t in range(places.size):
        row = rows[index[t]]
        far, near, own = _rows(residual, places[t], width)
        value = row[-3] * own[0] + row[-2] * own[1] + row[-1] * own[2]
        for s in range(_ACROSS):
            value += row[s] * far[s] + row[_ACROSS + s] * near[s]
        values[t] = value
        loads[blocks[t]] += weights[t] * value


@njit(fastmath=True)
def _spread(places, index, rows, width, weights, blocks, values, loads, work):
    """values = Gᵀ (values − W loads); `work` is a grid of zeros and left so."""
    for t in range(places.size):
        row = rows[index[t]]
        value = values[t] - weights[t] * loads[blocks[t]]
        far, near, own = _rows(work, places[t], width)
        for s in range(_ACROSS):
            far[s] += row[s] * value
        for s in range(_ACROSS):
            near[s] += row[_ACROSS + s] * value
        for s in range(REACH + 1):
            own[s] += row[2 * _ACROSS + s] * value
    for t in range(places.size):
        values[t] = work[places[t]]
        work[places[t]] = 0.0


class _Level:
    """What elements and blocks have in common; `_coarser` is the level of the blocks above."""

    def _finish(self, places, index, rows, weights, blocks):
        """Take G, the row sums of which are `weights`, in row index[t] of `rows` for every place, and go up."""
        self.places = places
        _normalise(weights, blocks, self._coarser.squares)
        self._coarser.prepare()
        self._factor = places, index, rows, self._width, weights, blocks
        self._values, self._loads = np.empty(places.size), np.empty_like(self._coarser.squares)

    def apply(self, residual):
        """M r on the set, valid until the next call, for a residual r on the grid."""
        _gather(residual, *self._factor, self._values, self._loads)
        self._loads[self._coarser.places] -= self._coarser.apply(self._loads)
        _spread(*self._factor, self._values, self._loads, self._work)
        return self._values


class Preconditioner(_Level):
    """M ≈ K⁻¹ for one contact set after the other, on a flat grid with border of the given height and width."""

    def __init__(self, height, width):
        self.places = np.empty(0, dtype=int)
        self._width, self._work = width, np.zeros(height * width)
        across = -(-max(height, width) // _SIDE)
        self._blocks = _block(height, width, _SIDE, across)
        self._coarser = _blocks(_SIDE, across)

    def prepare(self, inside, places):
        """For a set: flags on the grid, and its places."""
        patterns, weights = np.empty(places.size, np.int16), np.empty(places.size)
        _survey(inside, places, self._width, _sums(), patterns, weights)
        self._finish(places, patterns, table(), weights, self._blocks[places])


class _ManyBlocks(_Level):
    """The approximate inverse of 1 + a K a; `squares`, of a, is to be filled in before `prepare`."""

    def __init__(self, side, across):
        self._width, fewer = across + 2 * REACH, -(-across // _RATIO)
        self.squares, self._work = np.zeros((2, self._width**2))
        self._before = np.array(_BEFORE_BLOCK) @ [self._width, 1]
        self._slots = np.array([*map(_BEFORE.index, _BEFORE_BLOCK), _NEIGHBOURS])
        self._kernel = _coupling(side, *np.transpose([*_BEFORE_BLOCK, (0, 0)]))
        self._blocks = _block(self._width, self._width, _RATIO, fewer)
        self._coarser = _blocks(side * _RATIO, fewer)

    def prepare(self):
        places = np.flatnonzero(self.squares)
        rows, weights = np.zeros((places.size, _NEIGHBOURS + 1)), np.empty(places.size)
        _factorise(np.sqrt(self.squares), places, self._before, self._slots, self._kernel, rows, weights)
        self._finish(places, np.arange(places.size), rows, weights, self._blocks[places])


class _FewBlocks:
    """The inverse of 1 + a K a, dense."""

    def __init__(self, side, across):
        self.squares = np.zeros((across + 2 * REACH) ** 2)
        self._kernel = _dense_coupling(side, across)

    def prepare(self):
        self.places = np.flatnonzero(self.squares)
        amplitude = np.sqrt(self.squares[self.places])
        matrix = self._kernel[np.ix_(self.places, self.places)] * amplitude * amplitude[:, None]
        matrix.flat[:: self.places.size + 1] += 1
        self._factor = scipy.linalg.cho_factor(matrix, overwrite_a=True, check_finite=False)

    def apply(self, residual):
        return scipy.linalg.cho_solve(self._factor, residual[self.places], check_finite=False)


def _blocks(side, across):
    """The level of blocks of so many elements a side, and so many of them a row."""
    return _FewBlocks(side, across) if across <= _DENSE else _ManyBlocks(side, across)


def _block(height, width, side, across):
    """Place of the block of every place of a flat grid with border, on one of blocks with such a border."""
    row, column = ((np.arange(n) - REACH) // side + REACH for n in (height, width))
    return (row[:, None] * (across + 2 * REACH) + column).ravel().astype(np.int32)


@lru_cache(maxsize=2)
def _dense_coupling(side, across):
    """K between all blocks of a grid with its border."""
    width = across + 2 * REACH
    return _coupling(side, *np.divmod(np.arange(width**2), width))


def _coupling(side, row, column):
    """K between blocks at (row, column): mean deflection of the one by a unit load, spread evenly, on the other."""
    row, column = (abs(each[:, None] - each).astype(float) for each in (row, column))
    return np.where((row == 0) & (column == 0), _OWN, influence_coefficient(row, column)) / side
