"""Apply the influence coefficients of the elastic half-space to the pressures on a grid, by Fourier transforms."""

from collections.abc import Callable
from functools import lru_cache

import ducc0
import numpy as np
from numpy.typing import DTypeLike

from viscorough.basics.types import Array
from viscorough.contact.halfspace.column_fft import ColumnConvolution, LibraryConvolution, good_length
from viscorough.contact.halfspace.influence import influence_table
from viscorough.contact.parallel import BLOCK, Buffer, run_blocks

# Number of unused entries at the end of every row. Without them, the distance between rows in memory could be a power
# of two. Such rows would compete for the same cache lines.
_ROW_PADDING = 16
# If a grid has at most this number of elements, the spectrum of its influence coefficients is kept in memory. Other
# grids whose transforms have the same lengths use it again. The indenters of an ensemble need few different lengths.
_KEPT = 1 << 20
# The number of rows in a block is a multiple of this number, since ducc0 transforms this number of rows at a time.
_ROWS_AT_ONCE = 16
# Grids with fewer elements use LibraryConvolution for their columns. ColumnConvolution would save a millisecond per
# loading curve, 2 % of the time of the curve, but would take seconds to compile.
_COMPILED_FROM = 5000


def convolution_lengths(rows: int, columns: int) -> tuple[int, int]:
    """Return the lengths of the periodic convolution along the columns and along the rows of a grid.

    The lengths include the padding with zeros. For a grid of a single row, the length along the columns is 1.
    """
    return good_length(2 * (rows - 1)) if rows > 1 else 1, 2 * ducc0.fft.good_size(max(columns - 1, 1), True)


def spectrum_of_grid(rows: int, columns: int, *, aspect: float, padding: bool, threads: int) -> Array:
    """Return the real spectrum of the influence coefficients of a grid, in double precision.

    The arguments are explained at `Halfspace`.
    """
    lengths, period = convolution_lengths(rows, columns), None if padding else (rows, columns)
    if rows * columns <= _KEPT:
        return _kept_spectrum(lengths, period, aspect, 1)
    return _spectrum(lengths, period, aspect, threads)


def _spectrum(lengths: tuple[int, int], period: tuple[float, float] | None, aspect: float, threads: int) -> Array:
    """Return the real spectrum of the influence coefficients K on a periodic grid, divided by the product of `lengths`.

    lengths : rows and columns of the periodic grid
    period : None if the grid is padded. Otherwise the loads repeat after period[0] rows and period[1] columns, and
        distances are measured to the nearest repetition of a load
    """

    def kernel(row: Array, column: Array) -> Array:
        if period:
            row, column = (np.minimum(d, abs(n - d)) for d, n in zip((row, column), period, strict=True))
        return influence_table(row, column, aspect)

    return spectrum_of_kernel(lengths, kernel, threads)


_kept_spectrum = lru_cache(maxsize=6)(_spectrum)  # cached by lengths, period and aspect


def spectrum_of_kernel(lengths: tuple[int, ...], kernel: Callable[[Array, Array], Array], threads: int = 1) -> Array:
    """Return the real spectrum of an even kernel on a periodic grid, divided by the product of `lengths`.

    The spectrum of an even kernel is even. So a cosine transform of the kernel at distances from 0 to half the lengths
    gives all frequencies.

    lengths : rows and columns of the periodic grid, even numbers; 1 for a single row
    kernel : function kernel(row, column) of two arrays of distances, which returns the kernel at all pairs of them

    Returns an array by frequency along the columns and along the rows, from 0 to half the lengths.
    """
    row, column = (np.arange(m // 2 + 1.0) for m in lengths)
    spectrum = np.empty((row.size, column.size))

    def transform_columns(start: int, stop: int) -> None:
        part = spectrum[:, start:stop]
        part[:] = kernel(row, column[start:stop])
        if row.size > 1:
            ducc0.fft.dct(part, axes=[0], type=1, out=part)

    def transform_rows(start: int, stop: int) -> None:
        part = spectrum[start:stop]
        ducc0.fft.dct(part, axes=[1], type=1, out=part)
        part /= np.prod(lengths)

    for transform, size, other in ((transform_columns, column.size, row.size), (transform_rows, row.size, column.size)):
        block = max(BLOCK // other // _ROWS_AT_ONCE, 1) * _ROWS_AT_ONCE
        run_blocks(transform, size, threads, block, _ROWS_AT_ONCE)
    return spectrum


class Convolution:
    """Convolution w_i = Σ_j K(i − j) P_j on a grid, with an even kernel K given by its spectrum.

    The convolution is periodic on a padded grid, which has at least 2(n − 1) points along an axis of n elements. This
    suffices because K is even: the padded grid contains all distances up to n − 1, and no load acts across the period.
    The spectrum of K is real.

    The rows that the padding adds have no loads, and their deflections are not needed. Transforms along these rows are
    skipped, which saves a quarter of the work. These rows are stored only while the columns are convolved.

    shape : rows and columns of the grid
    spectrum : spectrum of K from `spectrum_of_grid` or `spectrum_of_kernel`, for the lengths of `convolution_lengths`
    precision : floating-point type of the computation
    threads : number of threads
    once : True if the convolution is applied only once; LibraryConvolution is then used, since it needs no compilation

    load : the array to write P into, of shape (rows, stride ≥ columns); it must be zero on elements without pressure
        and in the columns beyond the grid
    count : number of calls of `apply` so far
    accuracy : bound on the error that is not due to rounding, relative to the largest deflection

    `apply()` returns w in an array with the layout of `load`, which the next call overwrites. Columns of this array
    beyond the grid are undefined.
    """

    accuracy = 0.0

    def __init__(
        self,
        shape: tuple[int, int],
        spectrum: Array,
        precision: DTypeLike = np.float64,
        *,
        threads: int = 1,
        once: bool = False,
    ) -> None:
        rows, columns = self.shape = shape
        self._threads = threads
        self._length = length = convolution_lengths(rows, columns)[1]
        # The rows of a large grid are transformed block by block, and only the rows of one block at a time are padded.
        self._block = rows if rows * columns <= BLOCK else -(-BLOCK // (columns * _ROWS_AT_ONCE)) * _ROWS_AT_ONCE
        self._is_one = self._block >= rows
        # The buffer holds two blocks of rows: padded rows before the transform, and rows after the inverse transform.
        self._buffer = Buffer((2, 0 if self._is_one else self._block, length + _ROW_PADDING), precision)
        convolution = LibraryConvolution if once or rows * columns < _COMPILED_FROM else ColumnConvolution
        self._convolution = convolution(rows, spectrum, precision, threads) if rows > 1 else None
        self._spectrum = spectrum.astype(precision) if rows == 1 else None
        self.load = np.zeros((rows, (length if self._is_one else columns) + _ROW_PADDING), dtype=precision)
        self._transformed = np.empty((rows, length // 2 + 1), dtype=np.result_type(precision, np.complex64))
        self._deflection = np.empty_like(self.load)
        self.count = 0

    def apply(self) -> Array:
        """Return the deflection w = K P by the pressure P in `load`, in the layout of `load`.

        The next call overwrites the returned array.
        """
        blocks = len(self.load), self._threads, self._block, _ROWS_AT_ONCE
        run_blocks(self._transform, *blocks)
        if self._convolution:
            self._convolution.apply(self._transformed)
        else:  # a grid of a single row needs no convolution along its columns
            self._transformed *= self._spectrum
        run_blocks(self._transform_back, *blocks)
        self.count += 1
        return self._deflection

    def _transform(self, start: int, stop: int) -> None:
        """Pad the rows of `load` from `start` to before `stop` with zeros, and compute their Fourier transforms."""
        rows, columns = self.load[start:stop], self.shape[1]
        if not self._is_one:
            padded = self._buffer.array[0, : stop - start]
            padded[:, :columns] = rows[:, :columns]
            rows = padded
        ducc0.fft.r2c(rows[:, : self._length], axes=[1], out=self._transformed[start:stop])

    def _transform_back(self, start: int, stop: int) -> None:
        """Compute the deflection in the rows from `start` to before `stop` by inverse Fourier transforms.

        The results are not divided by the length, because the spectrum contains this factor. The input of the inverse
        transforms is overwritten.
        """
        rows, columns = self._deflection[start:stop], self.shape[1]
        out = rows if self._is_one else self._buffer.array[1, : stop - start]
        data = self._transformed[start:stop]
        ducc0.fft.c2r(data, axes=[1], forward=False, lastsize=self._length, out=out[:, : self._length])
        if not self._is_one:
            rows[:, :columns] = out[:, :columns]


class Halfspace(Convolution):
    """Half-space operator w = K P on a grid of rows × columns elements.

    K contains the influence coefficients. With P = p d/(4πG), for a pressure p on elements with sides dx and dy, a
    shear modulus G and d = √(dx dy), the result w is the deflection of the surface.

    rows, columns : size of the grid
    precision : floating-point type of the computation
    aspect : dy/dx of the elements
    padding : True if the grid is padded with zeros; False if loads repeat periodically with the size of the grid
    threads : number of threads
    """

    def __init__(
        self,
        rows: int,
        columns: int,
        precision: DTypeLike = np.float64,
        *,
        aspect: float = 1.0,
        padding: bool = True,
        threads: int = 1,
    ) -> None:
        spectrum = spectrum_of_grid(rows, columns, aspect=aspect, padding=padding, threads=threads)
        super().__init__((rows, columns), spectrum, precision, threads=threads)
