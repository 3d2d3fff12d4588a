"""Store the sparse factor G of the preconditioner on the grid of the elements, and compute products with G.

The neighbours of an element are the twelve nearest elements before the element, in the order of rows and columns. Row i
of G (in this module not the shear modulus) has an entry for element i, and an entry for each neighbour that is in
contact. The entries are taken from a table of all possible rows of G (module factor_entries).

Entries are stored for the whole grid, and are zero for elements without contact. For each row of the grid, the entries
of all elements for their first neighbour come first, then the entries for the second neighbour, and so on. Loops over a
row of the grid then read consecutive numbers, and process as many elements at once as a register of the processor
holds.

In single precision an entry is rounded to a whole number of one byte, so that the entries fit into the cache. Rounding
changes G and the preconditioner by a few percent, but the preconditioner Gᵀ … G remains symmetric.

The grid is divided into blocks of elements, and loops skip blocks without contact. The compiled functions have many
arguments because they take plain arrays only.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.border import BORDER
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.preconditioner.factor_entries import BEFORE, NEIGHBOURS, factor_entries

# Loops process this number of adjacent blocks at a time, and skip them only if no block has elements in contact. A row
# of elements in these blocks is long enough to fill the registers of the processor.
_TOGETHER = 4
# An element that joins or leaves the contact set changes the rows of G for its neighbourhood. Renewing these rows takes
# as much time as renewing this number of rows in a loop over all rows of G.
_COST_OF_CHANGE = 20
# Additional bit of a contact pattern (see `factor_entries`). The bit is set while the row of G waits for renewal.
_RENEWED = 1 << NEIGHBOURS


@njit
def _renew(start, stop, inside, changed, offsets, patterns, rows_of_pattern, factor, rows):
    """Renew the rows of the sparse factor G that depend on elements which joined or left the contact set.

    Only rows of G for elements with indices from `start` to before `stop` in flat fields are renewed.

    inside : True for elements in the new contact set, flat field
    changed : indices in flat fields of the elements that joined or left
    offsets : index of each neighbour minus the index of the element, in flat fields; the last offset is 0
    patterns : contact pattern of every element, which encodes the neighbours in contact (see `factor_entries`); flat
        field, renewed in place
    rows_of_pattern : all possible rows of G, by pattern and neighbour
    factor : entries of G (see the module's docstring), renewed in place
    rows : scratch array of indices, shape (changed.size · offsets.size,)
    """
    count = 0
    for t in range(changed.size):
        k = changed[t]
        for s in range(offsets.size):
            i = k - offsets[s]
            if start <= i < stop:
                patterns[i] ^= (1 << s) & ~_RENEWED
                if (i == k or inside[i]) and not patterns[i] & _RENEWED:
                    patterns[i] |= _RENEWED
                    rows[count] = i
                    count += 1
    for t in range(count):
        i = rows[t]
        patterns[i] &= ~_RENEWED
        row = i // factor.shape[2]
        column = i - row * factor.shape[2]
        if inside[i]:
            entries = rows_of_pattern[patterns[i]]
            for s in range(factor.shape[1]):
                factor[row, s, column] = entries[s]
        else:
            for s in range(factor.shape[1]):
                factor[row, s, column] = 0


@njit
def _renew_all(first_row, last_row, side, inside, patterns, entries, factor):
    """Renew all contact patterns, and all rows of the sparse factor G, in some rows of blocks.

    first_row, last_row : first row of blocks, and the row of blocks after the last
    side : number of rows of the grid in a row of blocks
    inside, patterns, factor : see `_renew`
    entries : entries of all possible rows of G by neighbour and pattern, from `factor_entries`
    """
    width, columns = factor.shape[2], factor.shape[2] - 2 * BORDER
    for row in range(first_row * side + BORDER, min(last_row * side, factor.shape[0] - 2 * BORDER) + BORDER):
        at = row * width + BORDER
        row_patterns, members = patterns[at : at + columns], inside[at : at + columns]
        far, near, same = inside[at - 2 * width - BORDER :], inside[at - width - BORDER :], inside[at - BORDER :]
        for j in range(columns):
            pattern = far[j] | far[j + 1] << 1 | far[j + 2] << 2 | far[j + 3] << 3 | far[j + 4] << 4
            pattern |= near[j] << 5 | near[j + 1] << 6 | near[j + 2] << 7 | near[j + 3] << 8 | near[j + 4] << 9
            row_patterns[j] = pattern | same[j] << 10 | same[j + 1] << 11
        for s in range(factor.shape[1]):
            neighbour_entries, out = entries[s], factor[row, s, BORDER : BORDER + columns]
            for j in range(columns):
                out[j] = neighbour_entries[row_patterns[j]] * members[j]


@njit(inner=True)
def _next_run(active, first):
    """Find the next run of consecutive blocks to process in a row of blocks, from block `first` on.

    The blocks are taken in groups of _TOGETHER. A group is processed if any of its blocks has elements in contact.

    active : an entry for each block of the row, positive if the block has elements in contact

    Returns the index of the first block of the run, and the index after its last block. If no block is left to
    process, both indices equal the number of blocks.
    """
    last = first
    while last < active.size:
        total = 0.0
        for block in range(last, min(last + _TOGETHER, active.size)):
            total += active[block]
        last += _TOGETHER
        if total == 0:
            if last > first + _TOGETHER:  # the run ends before this group
                return first, last - _TOGETHER
            first = last
    return min(first, active.size), min(last, active.size)


@njit(fastmath=True)
def _sum_squares(first_row, last_row, factor, unit, height, sides, squares, total):
    """Compute Σ s² for every block in some rows of blocks, where s are the row sums of the sparse factor G.

    The sum for a block contains the rows of G that belong to the elements of the block.

    first_row, last_row : first row of blocks, and the row of blocks after the last
    factor, unit : stored numbers (in single precision, whole numbers), and the factor that converts them to the entries
        of G
    height : rows of the grid without border
    sides : rows and columns of elements in a block
    squares : the results are stored here, by rows and columns of blocks
    total : scratch array for a row of the grid without border
    """
    for block_row in range(first_row, last_row):
        total[:] = 0
        for row in range(block_row * sides[0], min((block_row + 1) * sides[0], height)):
            sums = factor[row + BORDER, -1][BORDER:]
            for j in range(total.size):
                value = unit * sums[j]
                total[j] += value * value
        _add_up(total, sides[1], squares[block_row], 0, squares.shape[1])


@njit(inner=True, fastmath=True)
def _add_up(values, side, sums, first, last):
    """Sum the values in each of the blocks from `first` to before `last`.

    values : values of all elements in a row of the grid
    side : number of values in a block
    sums : the sums are stored here, with an entry for every block of the row
    """
    for block in range(first, last):
        total = 0.0
        for j in range(block * side, min((block + 1) * side, values.size)):
            total += values[j]
        sums[block] = total


@njit(fastmath=True)
def _restrict(first_row, last_row, factor, unit, residual, height, sides, active, values, loads, total):
    """Compute values = G r and loads = Wᵀ G r for some rows of blocks; see `SparseFactor.restrict` for G and W.

    The other arguments are explained at `_sum_squares`.

    residual : r, flat field
    active : positive for blocks with elements in contact, by rows and columns of blocks
    values : G r is stored here, flat field
    loads : Wᵀ G r is stored here, by rows and columns of blocks
    total : scratch array for a row of the grid without border
    """
    width, columns = factor.shape[2], factor.shape[2] - 2 * BORDER
    for block_row in range(first_row, last_row):
        first, last = _next_run(active[block_row], 0)
        while first < last:
            start, stop = first * sides[1], min(last * sides[1], columns)
            part, left = total[start:stop], BORDER + start
            part[:] = 0
            for row in range(BORDER + block_row * sides[0], BORDER + min((block_row + 1) * sides[0], height)):
                at, rows = row * width + left, factor[row]
                a, b, c, d, e = rows[0][left:], rows[1][left:], rows[2][left:], rows[3][left:], rows[4][left:]
                f, g, h, k, m = rows[5][left:], rows[6][left:], rows[7][left:], rows[8][left:], rows[9][left:]
                n, p, own, sums = rows[10][left:], rows[11][left:], rows[12][left:], rows[13][left:]
                x, y, z = residual[at - 2 * width - BORDER :], residual[at - width - BORDER :], residual[at - BORDER :]
                out = values[at:]
                for j in range(part.size):
                    value = a[j] * x[j] + b[j] * x[j + 1] + c[j] * x[j + 2] + d[j] * x[j + 3] + e[j] * x[j + 4]
                    value += f[j] * y[j] + g[j] * y[j + 1] + h[j] * y[j + 2] + k[j] * y[j + 3] + m[j] * y[j + 4]
                    value += n[j] * z[j] + p[j] * z[j + 1] + own[j] * z[j + 2]
                    out[j] = unit * value
                for j in range(part.size):
                    part[j] += unit * sums[j] * out[j]
            _add_up(total, sides[1], loads[block_row], first, last)
            first, last = _next_run(active[block_row], last)


@njit(fastmath=True)
def _correct(first_row, last_row, factor, unit, loads, height, sides, active, values, spread):
    """Subtract the product W loads from `values` for some rows of blocks; see `_restrict` for W and the arguments.

    spread : scratch array for a row of the grid without border
    """
    width, columns = factor.shape[2], factor.shape[2] - 2 * BORDER
    for block_row in range(first_row, last_row):
        first, last = _next_run(active[block_row], 0)
        while first < last:
            start, stop = first * sides[1], min(last * sides[1], columns)
            for block in range(first, last):
                for j in range(block * sides[1], min((block + 1) * sides[1], columns)):
                    spread[j] = loads[block_row, block]
            part, left = spread[start:stop], BORDER + start
            for row in range(BORDER + block_row * sides[0], BORDER + min((block_row + 1) * sides[0], height)):
                out, sums = values[row * width + left :], factor[row, -1][left:]
                for j in range(part.size):
                    out[j] -= unit * sums[j] * part[j]
            first, last = _next_run(active[block_row], last)


@njit(fastmath=True)
def _prolong(first_row, last_row, factor, unit, values, height, sides, active, result):
    """Compute result = Gᵀ values for some rows of blocks; see `_restrict` for G and the arguments."""
    width, columns = factor.shape[2], factor.shape[2] - 2 * BORDER
    for block_row in range(first_row, last_row):
        first, last = _next_run(active[block_row], 0)
        while first < last:
            start, stop = first * sides[1], min(last * sides[1], columns)
            for row in range(BORDER + block_row * sides[0], BORDER + min((block_row + 1) * sides[0], height)):
                at = row * width + BORDER + start
                two, one, rows = factor[row + 2], factor[row + 1], factor[row]
                a, b, c = two[4][start:], two[3][start + 1 :], two[2][start + 2 :]
                d, e, f = two[1][start + 3 :], two[0][start + 4 :], one[9][start:]
                g, h, k = one[8][start + 1 :], one[7][start + 2 :], one[6][start + 3 :]
                m, own, n = one[5][start + 4 :], rows[12][start + 2 :], rows[11][start + 3 :]
                p, out = rows[10][start + 4 :], result[at:]
                x, y, z = values[at + 2 * width - BORDER :], values[at + width - BORDER :], values[at:]
                for j in range(stop - start):
                    value = a[j] * x[j] + b[j] * x[j + 1] + c[j] * x[j + 2] + d[j] * x[j + 3] + e[j] * x[j + 4]
                    value += f[j] * y[j] + g[j] * y[j + 1] + h[j] * y[j + 2] + k[j] * y[j + 3] + m[j] * y[j + 4]
                    value += own[j] * z[j] + n[j] * z[j + 1] + p[j] * z[j + 2]
                    out[j] = unit * value
            first, last = _next_run(active[block_row], last)


class SparseFactor:
    """Sparse factor G of the preconditioner Gᵀ … G; `update` adapts G to another contact set on the same grid.

    height, width : rows and columns of the grid, border included
    sides : rows and columns of elements in a block
    aspect : dy/dx of the elements
    precision : floating-point type of products with G; in single precision, entries of G are rounded to one byte
    threads : number of threads

    squares : Σ s² for every block, with the row sums s of G for its elements; shape (rows, columns) of blocks
    """

    def __init__(
        self,
        height: int,
        width: int,
        sides: tuple[int, int],
        aspect: float,
        precision: Any,
        threads: int = 1,
    ) -> None:
        self._height, self._sides = height - 2 * BORDER, sides
        self._threads, self._rows_at_once = threads, -(-BLOCK // (sides[0] * width))
        self._entries, self._unit = factor_entries(aspect, precision)
        self._rows_of_pattern = np.ascontiguousarray(self._entries.T)
        self._offsets = np.array([*BEFORE, (0, 0)]) @ [width, 1]
        self._inside = np.zeros(height * width, dtype=bool)
        self._patterns = np.zeros(height * width, dtype=np.uint16)
        self._factor = np.zeros((height, NEIGHBOURS + 2, width), dtype=self._entries.dtype)
        self._values, self._result = np.zeros((2, height * width), dtype=precision)
        blocks = [-(-(n - 2 * BORDER) // side) for n, side in zip((height, width), sides, strict=True)]
        self.squares, self._loads = np.zeros((2, *blocks))

    def update(self, inside: Mask) -> int:
        """Update G for another contact set; return the number of elements that joined or left the set.

        inside : True for elements in the contact set, flat field
        """

        def changes(i: int, j: int) -> Integers:
            changed = i + np.flatnonzero(inside[i:j] != self._inside[i:j])
            self._inside[i:j] = inside[i:j]
            return changed

        changed = np.concatenate(run_blocks(changes, inside.size, self._threads))
        if changed.size:
            self._over_rows(self._renew_rows, changed)
        return changed.size

    def _renew_rows(self, first_row: int, last_row: int, changed: Integers) -> None:
        """Renew contact patterns, rows of G and `squares` in some rows of blocks, after the contact set has changed.

        first_row, last_row : first row of blocks, and the row of blocks after the last
        changed : indices in flat fields of the elements that joined or left the contact set
        """
        width, side = self._factor.shape[2], self._sides[0]
        start, stop = ((row * side + BORDER) * width for row in (first_row, last_row))
        # The row of G for an element depends on neighbours up to two rows of the grid before the element.
        first, last = np.searchsorted(changed, (start - BORDER * (width + 1), stop))
        if first == last:
            return
        if (last - first) * _COST_OF_CHANGE > stop - start:
            members = self._inside.view(np.uint8)  # whole numbers, because their bits are shifted
            _renew_all(first_row, last_row, side, members, self._patterns, self._entries, self._factor)
        else:
            stored = self._patterns, self._rows_of_pattern, self._factor
            rows = np.empty((last - first) * self._offsets.size, changed.dtype)
            _renew(start, stop, self._inside, changed[first:last], self._offsets, *stored, rows)
        blocks = self._height, self._sides, self.squares
        _sum_squares(first_row, last_row, self._factor, self._unit, *blocks, self._grid_row())

    def restrict(self, residual: Array) -> Array:
        """Return Wᵀ G r by rows and columns of blocks, and keep G r for `prolong`.

        G is the sparse factor. W is a matrix with a column for each block of elements. A column contains the row sums
        of G for the elements of the block, and zeros for all other elements. Unlike the columns of W in the
        formula for M, these columns are not normalised.

        residual : r, flat field
        """
        blocks = self._height, self._sides, self.squares

        def restrict(i: int, j: int) -> None:
            stored = self._values, self._loads, self._grid_row()
            _restrict(i, j, self._factor, self._unit, residual, *blocks, *stored)

        self._over_rows(restrict)
        return self._loads

    def prolong(self, loads: Array) -> Array:
        """Return Gᵀ (G r − W loads), with G r from the last call of `restrict`; see `restrict` for G and W.

        The result is a flat field whose values outside the contact set have no meaning. The next call overwrites the
        returned array.

        loads : loads of the blocks, by rows and columns of blocks
        """
        blocks = self._height, self._sides, self.squares

        def correct(i: int, j: int) -> None:
            _correct(i, j, self._factor, self._unit, loads, *blocks, self._values, self._grid_row())

        self._over_rows(correct)
        self._over_rows(_prolong, self._factor, self._unit, self._values, *blocks, self._result)
        return self._result

    def _grid_row(self) -> Array:
        """Return a scratch array for a row of the grid without border, in the precision of products with G."""
        return np.empty(self._factor.shape[2] - 2 * BORDER, self._values.dtype)

    def _over_rows(self, function: Callable[..., Any], *arguments: Any) -> None:
        """Call function(first, last, *arguments) on several threads, until all rows of blocks have been processed.

        A call processes the rows of blocks from `first` to before `last`.
        """
        size = len(self.squares), self._threads, self._rows_at_once
        run_blocks(lambda first, last: function(first, last, *arguments), *size)
