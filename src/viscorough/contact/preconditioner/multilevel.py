"""Preconditioner of conjugate gradients: an approximate inverse of the influence matrix of a contact set.

It is a factorized sparse approximate inverse (FSAI) with a multilevel coarse correction.

The sparse factor G (in this module not the shear modulus) is lower triangular with G K Gᵀ ≈ 1. Row i of G has entries
for element i, and for each of the twelve nearest elements before it (in rows and columns) that is in contact. It is
exact if no other elements are in contact (Kolotilina and Yeremin 1993). Its storage is described in sparse_factor.

The remainder G K Gᵀ − 1 is smooth: it is the deflection by distant loads. The coarse correction represents it on blocks
of elements, the next grid level. In a block the smooth part acts along one vector, the row sums of G. With W the matrix
of these vectors, normalised to unit length,

    G K Gᵀ ≈ 1 + W (a K a) Wᵀ,     M = Gᵀ (1 − W (1 − (1 + a K a)⁻¹) Wᵀ) G ≈ K⁻¹

with a the length of the vector of row sums in a block. K couples blocks as it couples elements. The inverse on
the blocks is approximated in the same way with blocks of blocks, until there are few enough for a dense inverse. The
eigenvalues of M K lie between 0.35 and 1.4 for contact sets of any shape, with elements five times as long as wide
between 0.35 and 1.6 (tests/viscorough/contact/preconditioner/test_multilevel.py); without the coarse correction the
largest grows with the size of the contact.

Compiled functions take plain arrays, hence their many arguments.
"""

from functools import lru_cache
from typing import Any

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.halfspace.growing_cholesky import solve_factored
from viscorough.contact.halfspace.influence import influence_coefficient
from viscorough.contact.parallel import run_blocks
from viscorough.contact.preconditioner.factor_entries import BEFORE, NEIGHBOURS, REACH
from viscorough.contact.preconditioner.sparse_factor import SparseFactor

# Lower bound of the eigenvalues of M K (tests/viscorough/contact/preconditioner/test_multilevel.py).
LEAST_EIGENVALUE = 0.35
# Elements across the neighbourhood of an element.
_ACROSS = 2 * REACH + 1
# The neighbours of a block of elements: the nearest ones only.
_BEFORE_BLOCK = [(-1, -1), (-1, 0), (-1, 1), (0, -1)]
# The number of iterations depends weakly on the next three numbers.
# Elements across a block of square elements.
_SIDE = 8
# Blocks across a block of the next grid level.
_RATIO = 4
# Largest number of blocks across a grid level that is inverted densely.
_DENSE = 9
# Share of the elements that may join or leave the set before the coarse levels are prepared again.
_OUTDATED = 0.02
# Blocks that are factorised at a time by one thread.
_FACTORISED_AT_ONCE = 1 << 13
# Avoids a division by zero for blocks without contact.
_TINY = np.finfo(float).tiny
# Self-influence of a block, times its side: less than 2.97, the mean over a uniformly loaded square, because G already
# accounts for near neighbours.
_OWN = 1.0


@lru_cache(maxsize=4)
def load_redistribution_stencil(aspect: float) -> Array:
    """Return the share of an element's load that each of its eight neighbours takes over when it leaves the contact.

    It is obtained by eliminating the element from the influence matrix of the 5 × 5 elements around it; the centre is
    −1. Shape (3, 3).
    """
    row, column = np.divmod(np.arange(25.0), 5)
    inverse = np.linalg.inv(influence_coefficient(row[:, None] - row, column[:, None] - column, aspect))
    return -inverse[12].reshape(5, 5)[1:-1, 1:-1] / inverse[12, 12]


@njit(inner=True)
def _rows(field, place, width):
    """Return views of a flat field from the first neighbour on, in three rows: two before, one before, its own."""
    return field[place - 2 * width - REACH :], field[place - width - REACH :], field[place - REACH :]


@njit
def _factorise(amplitude, places, before, slots, kernel, rows, weights):
    """Store the rows of G for the matrix 1 + a K a between blocks in `rows`, zero on entry, and G a in `weights`.

    amplitude : a, flat field; places : places of the blocks in it
    before, slots : places of the neighbours relative to the block, and their indices in a row of G
    kernel : K between the neighbours and the block, which comes last
    """
    own = before.size
    matrix, present, near = np.empty((own + 1, own + 1)), np.empty(own + 1, np.int64), np.empty(own + 1)
    for t in range(places.size):
        count = 0  # number of neighbours with elements in contact, and the block itself
        for s in range(own + 1):
            value = amplitude[places[t] + before[s]] if s < own else amplitude[places[t]]
            if value > 0:
                present[count], near[count] = s, value
                count += 1
        for i in range(count):  # Cholesky factor L of the matrix of block and neighbours
            for j in range(i + 1):
                value = kernel[present[i], present[j]] * near[i] * near[j] + (i == j)
                for k in range(j):
                    value -= matrix[i, k] * matrix[j, k]
                matrix[i, j] = np.sqrt(value) if i == j else value / matrix[j, j]
        row, weights[t] = rows[t], 0.0
        for i in range(count - 1, -1, -1):  # the last row of L⁻¹ is A⁻¹ b / (bᵀ A⁻¹ b)^½
            value = 1.0 * (i == count - 1)
            for k in range(i + 1, count):
                value -= matrix[k, i] * row[slots[present[k]]]
            row[slots[present[i]]] = value / matrix[i, i]
            weights[t] += row[slots[present[i]]] * near[i]


@njit
def _normalise(weights, blocks, squares):
    """Scale the weights to unit length in every block, in place, and store the squares of their former lengths."""
    squares[:] = 0
    for t in range(weights.size):
        squares[blocks[t]] += weights[t] * weights[t]
    for t in range(weights.size):
        weights[t] /= np.sqrt(squares[blocks[t]])


@njit(fastmath=True)
def _restrict(residual, places, rows, width, weights, blocks, values, loads):
    """Compute values = G r on the set, and loads = Wᵀ G r of the blocks."""
    loads[:] = 0
    for t in range(places.size):
        row = rows[t]
        far, near, own = _rows(residual, places[t], width)
        value = row[-3] * own[0] + row[-2] * own[1] + row[-1] * own[2]
        for s in range(_ACROSS):
            value += row[s] * far[s] + row[_ACROSS + s] * near[s]
        values[t] = value
        loads[blocks[t]] += weights[t] * value


@njit(fastmath=True)
def _prolong(places, rows, width, weights, blocks, values, loads, work):
    """Compute values = Gᵀ (values − W loads); `work` is a flat field of zeros on entry and on return."""
    for t in range(places.size):
        row = rows[t]
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


class Preconditioner:
    """M ≈ K⁻¹ for successive contact sets on a flat grid of the given height and width, border included.

    aspect : dy/dx of the elements
    precision : floating-point type of M; see SparseFactor
    threads : number of threads
    stencil : load_redistribution_stencil of the elements
    """

    def __init__(
        self,
        height: int,
        width: int,
        *,
        aspect: float = 1.0,
        precision: type[np.floating[Any]] = np.float32,
        threads: int = 1,
    ) -> None:
        self.stencil = load_redistribution_stencil(aspect)
        sides = round(_SIDE / aspect**0.5), round(_SIDE * aspect**0.5)  # blocks about as long as wide
        self._factor = SparseFactor(height, width, sides, aspect, precision, threads)
        blocks = [n + 2 * REACH for n in self._factor.squares.shape]
        self._coarser = _coarse_level(sides, aspect, blocks[0], blocks[1], threads)
        self._changed, self._scale = 0, np.zeros(blocks)
        self._squares, self._loads = np.zeros((2, *blocks))

    def apply(self, residual: Array) -> Array:
        """Return M r of a residual r, both flat fields in the precision that are defined on the set only.

        Valid until the next call.
        """
        loads, interior = self._loads, self._loads[REACH:-REACH, REACH:-REACH]
        interior[:] = self._factor.restrict(residual)
        loads *= self._scale
        places, corrected = self._coarser.places, np.zeros(loads.size)
        corrected[places] = loads.ravel()[places] - self._coarser.apply(loads.ravel())
        corrected = corrected.reshape(loads.shape) * self._scale
        return self._factor.prolong(corrected[REACH:-REACH, REACH:-REACH])

    def prepare(self, inside: Mask, count: int) -> None:
        """Prepare for a contact set.

        inside : True for elements in the set, flat field; count : number of elements in it
        """
        changed = self._factor.update(inside)
        if not changed:
            return
        squares = self._squares
        squares[REACH:-REACH, REACH:-REACH] = self._factor.squares
        self._scale = (squares > 0) / np.sqrt(np.maximum(squares, _TINY))  # zero for blocks without contact
        self._changed += changed
        if self._changed > _OUTDATED * count:
            self._coarser.squares[:] = squares.ravel()
            self._coarser.prepare()
            self._changed = 0


class _ManyBlocks:
    """The approximate inverse of 1 + a K a on blocks; set `squares`, the squares of a, before `prepare`."""

    def __init__(self, sides: tuple[int, int], aspect: float, height: int, width: int, threads: int) -> None:
        self._width, self._threads = width, threads
        self.squares, self._work = np.zeros((2, height * width))
        self._before = np.array(_BEFORE_BLOCK) @ [self._width, 1]
        self._slots = np.array([*map(BEFORE.index, _BEFORE_BLOCK), NEIGHBOURS])
        self._kernel = _coupling(sides, aspect, *np.transpose([*_BEFORE_BLOCK, (0, 0)]))
        # The place of the block of the next level for every place, on flat grids with borders.
        blocks = [-(-(n - 2 * REACH) // _RATIO) + 2 * REACH for n in (height, width)]
        row, column = ((np.arange(n) - REACH) // _RATIO + REACH for n in (height, width))
        self._blocks = (row[:, None] * blocks[1] + column).ravel().astype(np.int32)
        self._coarser = _coarse_level((_RATIO * sides[0], _RATIO * sides[1]), aspect, blocks[0], blocks[1], threads)

    def prepare(self) -> None:
        places = self.places = np.flatnonzero(self.squares)
        rows, weights, blocks = np.zeros((places.size, NEIGHBOURS + 1)), np.empty(places.size), self._blocks[places]
        amplitude = np.sqrt(self.squares)

        def factorise(i: int, j: int) -> None:
            _factorise(amplitude, places[i:j], self._before, self._slots, self._kernel, rows[i:j], weights[i:j])

        run_blocks(factorise, places.size, self._threads, _FACTORISED_AT_ONCE)
        _normalise(weights, blocks, self._coarser.squares)
        self._coarser.prepare()
        self._factor = places, rows, self._width, weights, blocks
        self._values, self._loads = np.empty(places.size), np.empty_like(self._coarser.squares)

    def apply(self, residual: Array) -> Array:
        """Return M r at the places, valid until the next call, for a residual r on the flat grid of blocks."""
        _restrict(residual, *self._factor, self._values, self._loads)
        self._loads[self._coarser.places] -= self._coarser.apply(self._loads)
        _prolong(*self._factor, self._values, self._loads, self._work)
        return self._values


class _FewBlocks:
    """The inverse of 1 + a K a on blocks, dense; set `squares`, the squares of a, before `prepare`."""

    def __init__(self, sides: tuple[int, int], aspect: float, height: int, width: int) -> None:
        self.squares, self.places = np.zeros(height * width), np.empty(0, dtype=int)
        self._kernel = _dense_coupling(sides, aspect, height, width)
        self._coupling: Array = np.empty((0, 0))  # between the places

    def prepare(self) -> None:
        places = np.flatnonzero(self.squares)
        if not np.array_equal(places, self.places):  # mostly all blocks have contact already
            self.places, self._coupling = places, self._kernel[np.ix_(places, places)]
        amplitude = np.sqrt(self.squares[places])
        matrix = self._coupling * amplitude * amplitude[:, None]
        matrix.flat[:: places.size + 1] += 1
        self._factor = np.linalg.cholesky(matrix)

    def apply(self, residual: Array) -> Array:
        solution: Array = residual[None, self.places]
        solve_factored(self._factor, solution)
        return solution[0]


def _coarse_level(
    sides: tuple[int, int], aspect: float, height: int, width: int, threads: int
) -> _ManyBlocks | _FewBlocks:
    """Return the grid level of blocks of sides[0] rows and sides[1] columns, on a grid of given height and width."""
    few = max(height, width) - 2 * REACH <= _DENSE
    grid = sides, aspect, height, width
    return _FewBlocks(*grid) if few else _ManyBlocks(*grid, threads)


@lru_cache(maxsize=2)
def _dense_coupling(sides: tuple[int, int], aspect: float, height: int, width: int) -> Array:
    """Return K between all blocks of a grid with its border."""
    return _coupling(sides, aspect, *np.divmod(np.arange(height * width), width))


def _coupling(sides: tuple[int, int], aspect: float, row: Integers, column: Integers) -> Array:
    """Return K between blocks at (row, column): the mean deflection of one by a unit load spread over the other."""
    row, column = (abs(position[:, None] - position).astype(float) for position in (row, column))
    distant = influence_coefficient(row, column, aspect * sides[0] / sides[1])
    return np.where((row == 0) & (column == 0), _OWN, distant) / np.sqrt(sides[0] * sides[1])
