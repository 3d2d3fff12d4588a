"""Approximate the inverse of the influence matrix K of a contact set, as the preconditioner of conjugate gradients.

The preconditioner M is a factorized sparse approximate inverse (FSAI) with a multilevel coarse correction.

The sparse factor G (in this module not the shear modulus) is lower triangular with G K Gᵀ ≈ 1. The neighbours of an
element are the twelve nearest elements before the element, in the order of rows and columns. Row i of G has an entry
for element i, and an entry for each neighbour that is in contact. The row is exact if no other earlier elements are in
contact (Kolotilina and Yeremin 1993). The module sparse_factor describes how G is stored.

The remainder G K Gᵀ − 1 is smooth, since it is the deflection by distant loads. The coarse correction represents the
remainder on the next grid level, whose elements are blocks of elements. Within a block the remainder acts along a
single vector: the row sums of G. Let W be the matrix whose columns are these vectors, one for each block, normalised to
unit length. Let a be the diagonal matrix of the lengths before normalisation. Then

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
# Bytes of the arrays of the preconditioner per place of the grid; the sparse factor has fourteen entries per place.
BYTES_PER_PLACE = 25
# Number of elements along each side of the square that contains the neighbours of an element.
_ACROSS = 2 * BORDER + 1
# Relative positions (row, column) of the neighbours of a block, which are the four nearest blocks before the block.
_BEFORE_BLOCK = [(-1, -1), (-1, 0), (-1, 1), (0, -1)]
# The number of iterations depends only weakly on _SIDE, _RATIO and _DENSE.
# Number of elements along each side of a block of the coarse correction, if the elements are square.
_SIDE = 8
# Number of blocks along each side of a block of the next grid level.
_RATIO = 4
# A grid level with at most this number of blocks along each side is inverted as a dense matrix.
_DENSE = 9
# The coarse levels are prepared again when the number of elements that have joined or left exceeds this share of the
# number of elements in contact.
_OUTDATED = 0.02
# Number of blocks for which a thread computes rows of G at a time.
_FACTORISED_AT_ONCE = 1 << 13
# Smallest divisor, to avoid a division by zero for blocks without contact.
_TINY = np.finfo(float).tiny
# Influence coefficient of a block on itself, times the side of the block. The mean deflection of a uniformly loaded
# square would give 2.97, but G already accounts for near neighbours.
_OWN = 1.0


@njit(inner=True)
def _rows(field, place, width):
    """Return three views of a flat field, which begin at the leftmost neighbours of a place.

    The first view begins two rows before the place, the second view one row before, and the third in the same row.
    """
    return field[place - 2 * width - BORDER :], field[place - width - BORDER :], field[place - BORDER :]


@njit
def _factorise(amplitude, places, before, slots, kernel, rows, weights):
    """Compute the sparse factor G of the matrix 1 + a K a of some blocks; store the rows of G, and the product G a.

    amplitude : a, flat field of blocks
    places : indices of the blocks in flat fields
    before : indices of the neighbours in flat fields, relative to the index of the block
    slots : indices of the neighbours, and last of the block itself, in a row of G
    kernel : K between the neighbours and the block, which comes last
    rows : the rows of G are stored here; zero on entry
    weights : G a is stored here
    """
    own = before.size
    matrix, present, near = np.empty((own + 1, own + 1)), np.empty(own + 1, np.int64), np.empty(own + 1)
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

    blocks : block of the next grid level that each weight belongs to
    squares : squares of the former lengths, by block
    """
    squares[:] = 0
    for t in range(weights.size):
        squares[blocks[t]] += weights[t] * weights[t]
    for t in range(weights.size):
        weights[t] /= np.sqrt(squares[blocks[t]])


@njit(fastmath=True)
def _restrict(residual, places, rows, width, weights, blocks, values, loads):
    """Store G r in `values`, and Wᵀ G r in `loads`, for a residual r.

    residual : r, flat field
    places : indices in flat fields of the blocks that the rows of G belong to
    rows : rows of G
    width : length of a row of flat fields
    weights, blocks : entries of W, and for each entry its column, which is a block of the next grid level
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
    """Replace `values` by Gᵀ (values − W loads); see `_restrict` for the arguments.

    work : flat field, zero on entry and on return
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
    """The preconditioner M ≈ K⁻¹, which is prepared for one contact set after another on the same grid.

    height, width : rows and columns of flat fields, border included
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
        self._coarser = _coarse_level(sides, aspect, blocks[0], blocks[1], threads)
        self._changed, self._scale = 0, np.zeros(blocks)
        self._squares, self._loads = np.zeros((2, *blocks))

    def apply(self, residual: Array) -> Array:
        """Return M r for a residual r.

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
    """Approximate inverse of 1 + a K a (see the module's docstring) on a grid level with many blocks.

    Before a call of `prepare`, store the squares of a in the flat field `squares`.

    sides : rows and columns of elements in a block
    aspect : dy/dx of the elements
    height, width : rows and columns of blocks, border included
    threads : number of threads

    places : indices in flat fields of the blocks with elements in contact
    """

    def __init__(self, sides: tuple[int, int], aspect: float, height: int, width: int, threads: int) -> None:
        self._width, self._threads = width, threads
        self.squares, self._work = np.zeros((2, height * width))
        self._before = np.array(_BEFORE_BLOCK) @ [self._width, 1]
        self._slots = np.array([*map(BEFORE.index, _BEFORE_BLOCK), NEIGHBOURS])
        self._kernel = _coupling(sides, aspect, *np.transpose([*_BEFORE_BLOCK, (0, 0)]))
        # For every block, the index of the block of the next grid level that contains it, in flat fields with borders.
        blocks = [-(-(n - 2 * BORDER) // _RATIO) + 2 * BORDER for n in (height, width)]
        row, column = ((np.arange(n) - BORDER) // _RATIO + BORDER for n in (height, width))
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
        """Return the product of the approximate inverse and a residual, at the blocks `places`.

        The next call overwrites the returned array.

        residual : flat field of blocks
        """
        _restrict(residual, *self._factor, self._values, self._loads)
        self._loads[self._coarser.places] -= self._coarser.apply(self._loads)
        _prolong(*self._factor, self._values, self._loads, self._work)
        return self._values


class _FewBlocks:
    """Inverse of 1 + a K a on a grid level with few blocks, by a dense Cholesky factor; used like _ManyBlocks."""

    def __init__(self, sides: tuple[int, int], aspect: float, height: int, width: int) -> None:
        self.squares, self.places = np.zeros(height * width), np.empty(0, dtype=int)
        self._kernel = _dense_coupling(sides, aspect, height, width)
        self._coupling: Array = np.empty((0, 0))  # K between the blocks `places`

    def prepare(self) -> None:
        places = np.flatnonzero(self.squares)
        if not np.array_equal(places, self.places):  # this is rare, since usually all blocks have contact already
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
    """Return a _FewBlocks or a _ManyBlocks, depending on the number of blocks.

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
    """Return the influence coefficients K between all blocks of a grid level; see `_coupling`.

    height, width : rows and columns of blocks, border included
    """
    return _coupling(sides, aspect, *np.divmod(np.arange(height * width), width))


def _coupling(sides: tuple[int, int], aspect: float, row: Integers, column: Integers) -> Array:
    """Return the influence coefficients K between all pairs of blocks.

    K approximates the mean deflection of a block by a unit load that is spread over another block. The influence of a
    block on itself is set by _OWN.

    sides : rows and columns of elements in a block
    aspect : dy/dx of the elements
    row, column : positions of the blocks
    """
    row, column = (abs(position[:, None] - position).astype(float) for position in (row, column))
    distant = influence_coefficient(row, column, aspect * sides[0] / sides[1])
    return np.where((row == 0) & (column == 0), _OWN, distant) / np.sqrt(sides[0] * sides[1])
