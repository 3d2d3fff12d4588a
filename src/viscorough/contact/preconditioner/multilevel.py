"""Approximate the inverse of the influence matrix K of a contact set, as the preconditioner of conjugate gradients.

The preconditioner M is a factorized sparse approximate inverse (FSAI) with a multilevel coarse correction.

The sparse factor G (in this module not the shear modulus) is lower triangular with G K Gᵀ ≈ 1. The neighbours of an
element are the twelve nearest elements before the element, in the order of rows and columns. Row i of G has an entry
for element i, and an entry for each neighbour that is in contact. If no other elements before element i are in contact,
the row is exact (Kolotilina and Yeremin 1993). The module sparse_factor describes how G is stored.

The remainder G K Gᵀ − 1 is smooth, since it comes from the deflection by distant loads. The coarse correction
approximates the remainder on a coarser grid, whose elements are blocks of elements. In each block
the approximation uses a single vector, which contains the row sums of G for the elements of the block. Let W be the
matrix whose columns are these vectors, normalised to unit length. Let a be the diagonal matrix of the lengths of the
vectors before normalisation. Then

    G K Gᵀ ≈ 1 + W (a K a) Wᵀ,     M = Gᵀ (1 − W (1 − (1 + a K a)⁻¹) Wᵀ) G ≈ K⁻¹

where K in the product a K a contains the influence coefficients between blocks. The inverse of 1 + a K a is
approximated in the same way with blocks of blocks, and so on, until the blocks are few enough for a dense inverse.

The eigenvalues of M K lie between 0.35 and 1.4 for contact sets of any shape, and between 0.35 and 1.6 if elements are
five times as long as wide (tests/viscorough/contact/preconditioner/test_multilevel.py). Without the coarse correction
the largest eigenvalue grows with the size of the contact.

The compiled functions have many arguments because they take plain arrays only.
"""

from functools import lru_cache
from typing import Any

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.border import BORDER
from viscorough.contact.halfspace.growing_cholesky import solve_factored
from viscorough.contact.halfspace.influence import influence_coefficient
from viscorough.contact.parallel import run_blocks
from viscorough.contact.preconditioner.factor_entries import BEFORE, NEIGHBOURS
from viscorough.contact.preconditioner.sparse_factor import SparseFactor

# Lower bound of the eigenvalues of M K, with the preconditioner M and the influence matrix K
# (tests/viscorough/contact/preconditioner/test_multilevel.py).
LEAST_EIGENVALUE = 0.35
# Number of elements along each side of the square around an element that contains all its neighbours.
_ACROSS = 2 * BORDER + 1
# Positions (row, column), relative to a block, of its neighbours: the four nearest blocks that come before the block.
_BEFORE_BLOCK = [(-1, -1), (-1, 0), (-1, 1), (0, -1)]
# Number of elements along each side of a block of the coarse correction, if the elements are square. The number of
# iterations depends only weakly on _SIDE, and on the next two constants _RATIO and _DENSE.
_SIDE = 8
# A block of the next coarser grid contains this number of blocks along each side.
_RATIO = 4
# If a grid has at most this number of blocks along each side, its matrix is inverted exactly (see `_FewBlocks`).
_DENSE = 9
# When elements join or leave the contact set, the coarse grids of the preconditioner are not updated at once, but
# when the number of these elements exceeds this share of the number of elements in contact.
_OUTDATED = 0.02
# Largest number of blocks in one call of `_factorise` on a thread.
_FACTORISED_AT_ONCE = 1 << 13
# Smallest divisor, to avoid a division by zero for blocks without contact.
_TINY = np.finfo(float).tiny
# Influence coefficient of a block on itself, times the side of the block. The mean deflection of a uniformly loaded
# square would give 2.97. The value is smaller because the sparse factor already accounts for near neighbours.
_OWN = 1.0


@njit(inner=True)
def _rows(field, place, width):
    """Return three views of a flat field, for access to an element and its neighbours, which come before the element.

    The neighbours lie in the row of the element and in the two rows before this row. The first view begins two rows
    before the element, the second one row before, and the third in the row of the element. In its row, each view
    begins at the leftmost neighbour.

    place : index of the element in the flat field
    width : length of a row of the flat field
    """
    return field[place - 2 * width - BORDER :], field[place - width - BORDER :], field[place - BORDER :]


@njit
def _factorise(amplitude, places, before, slots, kernel, rows, weights, matrix, present, near):
    """Compute the sparse factor G of the matrix 1 + a K a on a coarse grid, for some of its blocks.

    K contains the influence coefficients between blocks, and a is a diagonal matrix (see the module's docstring).

    amplitude : diagonal of a, flat field of blocks
    places : indices in flat fields of the blocks for which rows of G are computed
    before : indices in flat fields of the neighbours of a block, relative to the index of the block
    slots : positions of the neighbours in a row of G, and last the position of the block itself
    kernel : matrix K of the neighbours and of the block itself, which comes last
    rows : the rows of G are stored here; zero on entry
    weights : the row sums of G a are stored here
    matrix, present, near : scratch arrays for the block and its neighbours: an array in the shape of `kernel`, an array
        of indices and an array of numbers
    """
    own = before.size
    for t in range(places.size):
        count = 0  # number of neighbours with elements in contact, plus one for the block itself
        for s in range(own + 1):
            value = amplitude[places[t] + before[s]] if s < own else amplitude[places[t]]
            if value > 0:
                present[count], near[count] = s, value
                count += 1
        for i in range(count):  # compute the Cholesky factor L of the matrix A of the block and its neighbours
            for j in range(i + 1):
                value = kernel[present[i], present[j]] * near[i] * near[j] + (i == j)
                for k in range(j):
                    value -= matrix[i, k] * matrix[j, k]
                matrix[i, j] = np.sqrt(value) if i == j else value / matrix[j, j]
        row, weights[t] = rows[t], 0.0
        # With the unit vector b of the block, the row of G is A⁻¹ b / (bᵀ A⁻¹ b)^½, which is the last row of L⁻¹.
        for i in range(count - 1, -1, -1):
            value = 1.0 * (i == count - 1)
            for k in range(i + 1, count):
                value -= matrix[k, i] * row[slots[present[k]]]
            row[slots[present[i]]] = value / matrix[i, i]
            weights[t] += row[slots[present[i]]] * near[i]


@njit
def _normalise(weights, blocks, squares):
    """Scale the vector of weights in every block to unit length, in place; store the squares of the former lengths.

    weights : weights of all blocks, in one array
    blocks : for each weight, the index of its block on the next coarser grid
    squares : the squares of the former lengths are stored here, by block
    """
    squares[:] = 0
    for t in range(weights.size):
        squares[blocks[t]] += weights[t] * weights[t]
    for t in range(weights.size):
        weights[t] /= np.sqrt(squares[blocks[t]])


@njit(fastmath=True)
def _restrict(residual, places, rows, width, weights, blocks, values, loads):
    """Store G r in `values`, and Wᵀ G r in `loads`, for a residual r on a coarse grid.

    G is the sparse factor of this grid. W has a column for each block of the next coarser grid.

    residual : r, flat field
    places : indices in flat fields of the blocks that the rows of G belong to
    rows : rows of G
    width : length of a row of flat fields
    weights, blocks : the nonzero entry in each row of W, and its column: the index of a block of the coarser grid
    """
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
    """Replace `values` by Gᵀ (values − W loads); see `_restrict` for G, W and the arguments.

    work : scratch array, flat field, zero on entry and on return
    """
    for t in range(places.size):
        row = rows[t]
        value = values[t] - weights[t] * loads[blocks[t]]
        far, near, own = _rows(work, places[t], width)
        for s in range(_ACROSS):
            far[s] += row[s] * value
        for s in range(_ACROSS):
            near[s] += row[_ACROSS + s] * value
        for s in range(BORDER + 1):
            own[s] += row[2 * _ACROSS + s] * value
    for t in range(places.size):
        values[t] = work[places[t]]
        work[places[t]] = 0.0


class Preconditioner:
    """Preconditioner M ≈ K⁻¹ of the influence matrix K; `prepare` adapts M to another contact set on the same grid.

    height, width : rows and columns of the grid, border included
    aspect : dy/dx of the elements
    precision : floating-point type of M; see SparseFactor
    threads : number of threads
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
        sides = round(_SIDE / aspect**0.5), round(_SIDE * aspect**0.5)  # blocks are about as long as wide
        self._factor = SparseFactor(height, width, sides, aspect, precision, threads)
        blocks = [n + 2 * BORDER for n in self._factor.squares.shape]
        self._coarser = _coarse_grid(sides, aspect, blocks[0], blocks[1], threads)
        self._changed, self._scale = 0, np.zeros(blocks)
        self._squares, self._loads = np.zeros((2, *blocks))

    def apply(self, residual: Array) -> Array:
        """Return the product M r of the preconditioner M with a residual r.

        r and M r are flat fields in the precision of the preconditioner. Their values outside the contact set have no
        meaning. The next call overwrites the returned array.
        """
        loads, interior = self._loads, self._loads[BORDER:-BORDER, BORDER:-BORDER]
        interior[:] = self._factor.restrict(residual)
        loads *= self._scale
        places, corrected = self._coarser.places, np.zeros(loads.size)
        corrected[places] = loads.ravel()[places] - self._coarser.apply(loads.ravel())
        corrected = corrected.reshape(loads.shape) * self._scale
        return self._factor.prolong(corrected[BORDER:-BORDER, BORDER:-BORDER])

    def prepare(self, inside: Mask, count: int) -> None:
        """Prepare the preconditioner for a contact set.

        inside : True for elements in the contact set, flat field
        count : number of elements in the contact set
        """
        changed = self._factor.update(inside)
        if not changed:
            return
        squares = self._squares
        squares[BORDER:-BORDER, BORDER:-BORDER] = self._factor.squares
        self._scale = (squares > 0) / np.sqrt(np.maximum(squares, _TINY))  # zero for blocks without contact
        self._changed += changed
        if self._changed > _OUTDATED * count:
            self._coarser.squares[:] = squares.ravel()
            self._coarser.prepare()
            self._changed = 0


class _ManyBlocks:
    """Approximate inverse of the matrix 1 + a K a (see the module's docstring) on a grid with many blocks.

    sides : rows and columns of elements in a block
    aspect : dy/dx of the elements
    height, width : rows and columns of blocks, border included
    threads : number of threads

    squares : squares of the diagonal entries of a, flat field of blocks; write them here before a call of `prepare`
    places : indices in flat fields of the blocks with elements in contact
    """

    def __init__(self, sides: tuple[int, int], aspect: float, height: int, width: int, threads: int) -> None:
        self._width, self._threads = width, threads
        self.squares, self._work = np.zeros((2, height * width))
        self._before = np.array(_BEFORE_BLOCK) @ [self._width, 1]
        self._slots = np.array([*map(BEFORE.index, _BEFORE_BLOCK), NEIGHBOURS])
        self._kernel = _coupling(sides, aspect, *np.transpose([*_BEFORE_BLOCK, (0, 0)]))
        # Map each block to the block of the next coarser grid that contains it: `_blocks` holds the indices of
        # the coarser blocks in flat fields.
        blocks = [-(-(n - 2 * BORDER) // _RATIO) + 2 * BORDER for n in (height, width)]
        row, column = ((np.arange(n) - BORDER) // _RATIO + BORDER for n in (height, width))
        self._blocks = (row[:, None] * blocks[1] + column).ravel().astype(np.int32)
        self._coarser = _coarse_grid((_RATIO * sides[0], _RATIO * sides[1]), aspect, blocks[0], blocks[1], threads)

    def prepare(self) -> None:
        places = self.places = np.flatnonzero(self.squares)
        rows, weights, blocks = np.zeros((places.size, NEIGHBOURS + 1)), np.empty(places.size), self._blocks[places]
        amplitude = np.sqrt(self.squares)

        def factorise(i: int, j: int) -> None:
            kernel, results, size = self._kernel, (rows[i:j], weights[i:j]), len(self._kernel)
            scratch = np.empty_like(kernel), np.empty(size, np.int64), np.empty(size)
            _factorise(amplitude, places[i:j], self._before, self._slots, kernel, *results, *scratch)

        run_blocks(factorise, places.size, self._threads, _FACTORISED_AT_ONCE)
        _normalise(weights, blocks, self._coarser.squares)
        self._coarser.prepare()
        self._factor = places, rows, self._width, weights, blocks
        self._values, self._loads = np.empty(places.size), np.empty_like(self._coarser.squares)

    def apply(self, residual: Array) -> Array:
        """Multiply a residual by the approximate inverse; return the product at the blocks `places`.

        The next call overwrites the returned array.

        residual : flat field of blocks
        """
        _restrict(residual, *self._factor, self._values, self._loads)
        self._loads[self._coarser.places] -= self._coarser.apply(self._loads)
        _prolong(*self._factor, self._values, self._loads, self._work)
        return self._values


class _FewBlocks:
    """Exact inverse of the matrix 1 + a K a (see the module's docstring) on a grid with few blocks.

    The class is used like _ManyBlocks. It computes a dense Cholesky factor.
    """

    def __init__(self, sides: tuple[int, int], aspect: float, height: int, width: int) -> None:
        self.squares, self.places = np.zeros(height * width), np.empty(0, dtype=int)
        self._kernel = _dense_coupling(sides, aspect, height, width)
        self._coupling: Array = np.empty((0, 0))  # influence coefficients between the blocks `places`

    def prepare(self) -> None:
        places = np.flatnonzero(self.squares)
        if not np.array_equal(places, self.places):  # rarely the case, since usually all blocks have contact already
            self.places, self._coupling = places, self._kernel[np.ix_(places, places)]
        amplitude = np.sqrt(self.squares[places])
        matrix = self._coupling * amplitude * amplitude[:, None]
        matrix.flat[:: places.size + 1] += 1
        self._factor = np.linalg.cholesky(matrix)

    def apply(self, residual: Array) -> Array:
        solution: Array = residual[None, self.places]
        solve_factored(self._factor, solution)
        return solution[0]


def _coarse_grid(
    sides: tuple[int, int], aspect: float, height: int, width: int, threads: int
) -> _ManyBlocks | _FewBlocks:
    """Return the solver for a coarse grid: a _FewBlocks or a _ManyBlocks, depending on the number of blocks.

    sides : rows and columns of elements in a block
    aspect : dy/dx of the elements
    height, width : rows and columns of blocks, border included
    threads : number of threads
    """
    few = max(height, width) - 2 * BORDER <= _DENSE
    grid = sides, aspect, height, width
    return _FewBlocks(*grid) if few else _ManyBlocks(*grid, threads)


@lru_cache(maxsize=2)
def _dense_coupling(sides: tuple[int, int], aspect: float, height: int, width: int) -> Array:
    """Return the influence coefficients K between all blocks of a grid; see `_coupling`.

    height, width : rows and columns of blocks, border included
    """
    return _coupling(sides, aspect, *np.divmod(np.arange(height * width), width))


def _coupling(sides: tuple[int, int], aspect: float, row: Integers, column: Integers) -> Array:
    """Return the matrix of the influence coefficients K between all pairs of blocks.

    K is approximately the mean deflection of a block by a unit load that is spread over another block. The constant
    _OWN sets the influence of a block on itself.

    sides : rows and columns of elements in a block
    aspect : dy/dx of the elements
    row, column : positions of the blocks
    """
    row, column = (abs(position[:, None] - position).astype(float) for position in (row, column))
    distant = influence_coefficient(row, column, aspect * sides[0] / sides[1])
    return np.where((row == 0) & (column == 0), _OWN, distant) / np.sqrt(sides[0] * sides[1])
