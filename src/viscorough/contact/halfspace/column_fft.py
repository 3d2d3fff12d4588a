"""Convolve the columns of a grid with an even kernel, by Fourier transforms of many columns side by side.

The transforms are implemented here, because a library does more than a convolution needs: rows of zeros need not be
stored or copied, and frequencies need not be sorted.

Columns are processed in blocks. A row of a block contains first the real parts of all its columns, and then the
imaginary parts. So every operation acts on as many columns at once as a register of the processor holds.
"""

import ducc0
import numpy as np
from numpy.typing import DTypeLike

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Complex
from viscorough.contact.parallel import BLOCK, Buffer, aligned_zeros, run_blocks

# Number of columns in a block, which must fit into the cache of the processor.
_BLOCK = 64
# The last block may have up to this number of columns more than the other blocks. This avoids a very small last block.
_REST = 8
# Distance in memory from the real part to the imaginary part of a number, in array entries. It must not be a power of
# two: numbers whose distance in memory is a multiple of a large power of two compete for the same cache lines. The
# distance is a constant so that the compiler can see which numbers do not overlap in memory.
_PARTS = _BLOCK + _REST
# Distance in memory from a row of a block to the next row, in array entries; not a power of two, as for _PARTS.
_ROW = 2 * _PARTS + 8
# Largest radix of a stage. The length of a transform is the product of the radices of its stages: 3, 4 or 8.
_LARGEST_RADIX = 8


def good_length(least: int) -> int:
    """Return the smallest length of a transform that is at least `least`: a number 2^a 3^b with a ≥ 2."""
    most = int(np.ceil(np.log2(max(least, 4))))
    lengths = [2**a * 3**b for a in range(2, most + 1) for b in range(most)]
    return min(length for length in lengths if length >= least)


def _radices(length: int) -> list[int]:
    """Return radices 3, 4 and 8 in increasing order, whose product is the length; the last radix is 4 or 8."""
    twos = (length & -length).bit_length() - 1
    threes = round(np.log(length >> twos) / np.log(3))
    fours = -twos % 3
    return [3] * threes + [4] * fours + [8] * ((twos - 2 * fours) // 3)


@njit(inner=True)
def _at(x, row, j):
    """Return the complex number in a row and in column j of the block x of columns."""
    return complex(x[row, j], x[row, _PARTS + j])


@njit(inner=True)
def _put(y, group, j, value):
    """Store a complex number in the block y of columns, whose adjacent rows are joined to groups.

    y : block of columns, reshaped so that y[group] contains the rows of a group one after the other
    group : index of the group
    j : position of the real part in the group: the column in the first row, _ROW + column in the second row, and so on
    value : complex number
    """
    y[group, j] = value.real
    y[group, _PARTS + j] = value.imag


@njit(inner=True)
def _put_exchanged(y, group, j, value, factor):
    """Store a complex number times a real factor, like `_put`, but with real and imaginary parts exchanged."""
    y[group, j] = value.imag * factor
    y[group, _PARTS + j] = value.real * factor


@njit(inner=True)
def _times_minus_i(z):
    """Return −i z."""
    return complex(z.imag, -z.real)


@njit(inner=True)
def _transform_of_four(a, b, c, d):
    """Return the four numbers of the discrete Fourier transform of four complex numbers."""
    even, odd, even_rotated, odd_rotated = a + c, b + d, a - c, _times_minus_i(b - d)
    return even + odd, even_rotated + odd_rotated, even - odd, even_rotated - odd_rotated


@njit(inner=True, fastmath=True)
def _transform_of_eight(z0, z1, z2, z3, z4, z5, z6, z7, root):
    """Return the eight numbers of the discrete Fourier transform of eight complex numbers.

    root : √½ in the precision of the numbers
    """
    a, b, c, d = _transform_of_four(z0, z2, z4, z6)
    e, f, g, h = _transform_of_four(z1, z3, z5, z7)
    f, g, h = (f + _times_minus_i(f)) * root, _times_minus_i(g), (_times_minus_i(h) - h) * root
    return a + e, b + f, c + g, d + h, a - e, b - f, c - g, d - h


@njit(inner=True, fastmath=True)
def _stage_of_three(x, source, y, before, factors, width):
    third = source.size // 3
    out = y.reshape(third, 3 * _ROW)
    half, root = x.dtype.type(0.5), x.dtype.type(np.sqrt(0.75))
    for group in range(third // before):
        w = factors[group]
        w1, w2 = w[1], w[2]
        for p in range(group * before, (group + 1) * before):
            i, k, m = source[p], source[p + third], source[p + 2 * third]
            for j in range(width):
                a, b, c = _at(x, i, j), _at(x, k, j), _at(x, m, j)
                both, apart = a - (b + c) * half, _times_minus_i(b - c) * root
                _put(out, p, j, a + b + c)
                _put(out, p, _ROW + j, (both + apart) * w1)
                _put(out, p, 2 * _ROW + j, (both - apart) * w2)


@njit(inner=True, fastmath=True)
def _stage_of_four(x, source, y, before, factors, width):
    quarter = source.size // 4
    out = y.reshape(quarter, 4 * _ROW)
    for group in range(quarter // before):
        w = factors[group]
        w1, w2, w3 = w[1], w[2], w[3]
        for p in range(group * before, (group + 1) * before):
            i, k, m, n = source[p], source[p + quarter], source[p + 2 * quarter], source[p + 3 * quarter]
            for j in range(width):
                a, b, c, d = _transform_of_four(_at(x, i, j), _at(x, k, j), _at(x, m, j), _at(x, n, j))
                _put(out, p, j, a)
                _put(out, p, _ROW + j, b * w1)
                _put(out, p, 2 * _ROW + j, c * w2)
                _put(out, p, 3 * _ROW + j, d * w3)


@njit(inner=True, fastmath=True)
def _stage_of_eight(x, source, y, before, factors, width):
    eighth = source.size // 8
    out = y.reshape(eighth, 8 * _ROW)
    root = x.dtype.type(np.sqrt(0.5))
    for group in range(eighth // before):
        w = factors[group]
        w1, w2, w3, w4, w5, w6, w7 = w[1], w[2], w[3], w[4], w[5], w[6], w[7]
        for p in range(group * before, (group + 1) * before):
            i0, i1, i2, i3 = source[p], source[p + eighth], source[p + 2 * eighth], source[p + 3 * eighth]
            q = p + 4 * eighth
            i4, i5, i6, i7 = source[q], source[q + eighth], source[q + 2 * eighth], source[q + 3 * eighth]
            for j in range(width):
                z0, z1, z2, z3 = _at(x, i0, j), _at(x, i1, j), _at(x, i2, j), _at(x, i3, j)
                z4, z5, z6, z7 = _at(x, i4, j), _at(x, i5, j), _at(x, i6, j), _at(x, i7, j)
                a, b, c, d, e, f, g, h = _transform_of_eight(z0, z1, z2, z3, z4, z5, z6, z7, root)
                _put(out, p, j, a)
                _put(out, p, _ROW + j, b * w1)
                _put(out, p, 2 * _ROW + j, c * w2)
                _put(out, p, 3 * _ROW + j, d * w3)
                _put(out, p, 4 * _ROW + j, e * w4)
                _put(out, p, 5 * _ROW + j, f * w5)
                _put(out, p, 6 * _ROW + j, g * w6)
                _put(out, p, 7 * _ROW + j, h * w7)


@njit(inner=True, fastmath=True)
def _last_stage_of_four(x, source, y, spectrum, frequency, width):
    """Run the last stage of a transform, of radix four; multiply the result by the spectrum.

    The last stage needs no twiddle factors. It also exchanges real and imaginary parts, so that a second transform
    is an inverse transform.

    x, y : blocks of columns; the stage reads from x and writes to y
    source : row of x for every row that the stage reads
    spectrum : spectrum of the kernel by frequency and column
    frequency : frequency of every row of y
    width : number of columns
    """
    quarter = source.size // 4
    out = y.reshape(quarter, 4 * _ROW)
    for p in range(quarter):
        i, k, m, n = source[p], source[p + quarter], source[p + 2 * quarter], source[p + 3 * quarter]
        s0, s1 = spectrum[frequency[4 * p]], spectrum[frequency[4 * p + 1]]
        s2, s3 = spectrum[frequency[4 * p + 2]], spectrum[frequency[4 * p + 3]]
        for j in range(width):
            a, b, c, d = _transform_of_four(_at(x, i, j), _at(x, k, j), _at(x, m, j), _at(x, n, j))
            _put_exchanged(out, p, j, a, s0[j])
            _put_exchanged(out, p, _ROW + j, b, s1[j])
            _put_exchanged(out, p, 2 * _ROW + j, c, s2[j])
            _put_exchanged(out, p, 3 * _ROW + j, d, s3[j])


@njit(inner=True, fastmath=True)
def _last_stage_of_eight(x, source, y, spectrum, frequency, width):
    """Run the last stage of a transform, of radix eight, and multiply by the spectrum like `_last_stage_of_four`."""
    eighth = source.size // 8
    out = y.reshape(eighth, 8 * _ROW)
    root = x.dtype.type(np.sqrt(0.5))
    for p in range(eighth):
        i0, i1, i2, i3 = source[p], source[p + eighth], source[p + 2 * eighth], source[p + 3 * eighth]
        i4, i5, i6, i7 = source[p + 4 * eighth], source[p + 5 * eighth], source[p + 6 * eighth], source[p + 7 * eighth]
        n = frequency[8 * p : 8 * p + 8]
        s0, s1, s2, s3 = spectrum[n[0]], spectrum[n[1]], spectrum[n[2]], spectrum[n[3]]
        s4, s5, s6, s7 = spectrum[n[4]], spectrum[n[5]], spectrum[n[6]], spectrum[n[7]]
        for j in range(width):
            z0, z1, z2, z3 = _at(x, i0, j), _at(x, i1, j), _at(x, i2, j), _at(x, i3, j)
            z4, z5, z6, z7 = _at(x, i4, j), _at(x, i5, j), _at(x, i6, j), _at(x, i7, j)
            a, b, c, d, e, f, g, h = _transform_of_eight(z0, z1, z2, z3, z4, z5, z6, z7, root)
            _put_exchanged(out, p, j, a, s0[j])
            _put_exchanged(out, p, _ROW + j, b, s1[j])
            _put_exchanged(out, p, 2 * _ROW + j, c, s2[j])
            _put_exchanged(out, p, 3 * _ROW + j, d, s3[j])
            _put_exchanged(out, p, 4 * _ROW + j, e, s4[j])
            _put_exchanged(out, p, 5 * _ROW + j, f, s5[j])
            _put_exchanged(out, p, 6 * _ROW + j, g, s6[j])
            _put_exchanged(out, p, 7 * _ROW + j, h, s7[j])


@njit(inner=True)
def _load(data, first, x, width):
    """Copy `width` columns of the data, from column `first` on, to the block x, and append a row of zeros."""
    for i in range(data.shape[0]):
        row = data[i][first:]
        for j in range(width):
            x[i, j], x[i, _PARTS + j] = row[j].real, row[j].imag
    for j in range(width):
        x[data.shape[0], j] = x[data.shape[0], _PARTS + j] = 0


@njit(inner=True)
def _store(x, place, data, first, width):
    """Copy the block x to `width` columns of the data, from column `first` on, and exchange real and imaginary parts.

    place : for every row of the data, the row of the block that is copied to it
    """
    for i in range(data.shape[0]):
        row, at = data[i][first:], place[i]
        for j in range(width):
            row[j] = complex(x[at, _PARTS + j], x[at, j])


@njit
def _convolve(start, stop, data, edges, spectra, frequency, stages, factors, padded, place, same, x, y):
    """Convolve blocks of columns with the kernels of the columns, in place.

    A block is transformed twice. The last stage of the first transform multiplies the block by the spectrum. It also
    exchanges real and imaginary parts, so that the second transform is an inverse transform.

    A transform of length n has a stage for each of its radices r. The stage reads r rows at a distance of n/r rows, and
    writes r adjacent rows. The first of these rows holds the frequencies that are 0 modulo r, the second row the
    frequencies that are 1 modulo r, and so on (decimation in frequency with constant geometry; Pease 1968).

    start, stop : index of the first block, and index after the last block
    data : complex numbers, shape (rows, columns)
    edges : first column of every block, followed by the total number of columns
    spectra : spectra of the kernels, by block, frequency and column
    frequency : frequency that each row of a block holds after the last stage of the first transform, as an index into
        `spectra`, shape (rows of a block,)
    stages : three numbers for every stage: its radix, the product of the radices of all earlier stages, and the index
        in `factors` of the first row for the stage
    factors : twiddle factors, a row for every group of rows with the same factors. A stage has m groups, where m is n
        divided by the product of all radices up to the radix of the stage
    padded, place, same : numbers of the rows of a block, in the order in which a stage reads them. The first stage of
        the first transform reads the rows `padded`: 0, 1, 2, … for the rows with data, and then again and again the
        number of the row of zeros that follows the data. The first stage of the second transform reads the rows
        `place`: the row that holds the frequency 0, the row that holds the frequency 1, and so on. All other stages
        read the rows `same`: 0, 1, 2, …
    x, y : two blocks; a stage reads from one block and writes to the other
    """
    last = stages.shape[0] - 1
    for block in range(start, stop):
        first, width = edges[block], edges[block + 1] - edges[block]
        _load(data, first, x, width)
        source = padded
        for inverse in range(2):
            for stage in range(last + 1):
                radix, before, stage_factors = stages[stage, 0], stages[stage, 1], factors[stages[stage, 2] :]
                if stage == last and not inverse and radix == 8:
                    _last_stage_of_eight(x, source, y, spectra[block], frequency, width)
                elif stage == last and not inverse:
                    _last_stage_of_four(x, source, y, spectra[block], frequency, width)
                elif radix == 8:
                    _stage_of_eight(x, source, y, before, stage_factors, width)
                elif radix == 4:
                    _stage_of_four(x, source, y, before, stage_factors, width)
                else:
                    _stage_of_three(x, source, y, before, stage_factors, width)
                x, y, source = y, x, same
            source = place
        _store(x, place, data, first, width)


class ColumnConvolution:
    """Convolution of every column of a grid with an even kernel, which may differ from column to column.

    rows : number of rows of the grid, without padding
    spectrum : real Fourier transform of the kernel of each column, divided by the length of the transform. The length
        is a `good_length` larger than `rows`; the frequencies are 0 to length/2, shape (length/2 + 1, columns)
    precision : floating-point type of the computation
    threads : number of threads, each of which convolves blocks of columns
    """

    def __init__(self, rows: int, spectrum: Array, precision: DTypeLike, threads: int = 1) -> None:
        length, columns = 2 * (spectrum.shape[0] - 1), spectrum.shape[1]
        frequency, before, first, rest = np.zeros(1, dtype=int), 1, 0, length
        stages, factors = [], []
        for radix in _radices(length):
            groups = rest // radix
            stages.append((radix, before, first))
            # The twiddle factors of all stages are stored in one array. A row is long enough for the largest radix.
            factors.append(np.exp(-2j * np.pi / rest * np.outer(np.arange(groups), np.arange(_LARGEST_RADIX))))
            frequency = np.add.outer(frequency, length // rest * np.arange(radix)).ravel()
            before, first, rest = before * radix, first + groups, groups
        edges = np.array([*range(0, max(columns - _REST, 1), _BLOCK), columns])
        spectra = aligned_zeros((edges.size - 1, length // 2 + 1, _PARTS), precision)
        for block, values in enumerate(np.split(spectrum, edges[1:-1], axis=1)):
            spectra[block, :, : values.shape[1]] = values
        spectral = np.result_type(precision, np.complex64)
        same = np.arange(length)
        self._plan = (
            edges, spectra, np.minimum(frequency, length - frequency),
            np.array(stages), np.concatenate(factors).astype(spectral),
            np.minimum(same, rows), np.argsort(frequency), same,
        )  # fmt: skip
        self._blocks, self._threads = edges.size - 1, threads
        self._work = Buffer((2, length, _ROW), precision)

    def apply(self, data: Complex) -> None:
        """Convolve the columns of `data`, complex numbers of shape (rows, columns), in place."""

        def convolve(start: int, stop: int) -> None:
            _convolve(start, stop, data, *self._plan, *self._work.array)

        run_blocks(convolve, self._blocks, self._threads, 1 if self._threads > 1 else self._blocks)


class LibraryConvolution:
    """Convolution like ColumnConvolution, by the Fourier transforms of the library ducc0, which need no compilation.

    With this class, the half-space operator takes 1.3 to 2.3 times as long as with ColumnConvolution (measured by
    `columns` in `make bench`).
    """

    def __init__(self, rows: int, spectrum: Array, precision: DTypeLike, threads: int = 1) -> None:
        self._rows, self._spectrum, self._threads = rows, spectrum.astype(precision), threads

    def apply(self, data: Complex) -> None:
        """Convolve the columns of `data`, complex numbers of shape (rows, columns), in place."""
        half = len(self._spectrum)

        def convolve(start: int, stop: int) -> None:
            block, spectrum = np.zeros((2 * half - 2, stop - start), data.dtype), self._spectrum[:, start:stop]
            block[: self._rows] = data[:, start:stop]
            ducc0.fft.c2c(block, axes=[0], out=block)
            block[:half] *= spectrum
            block[half:] *= spectrum[-2:0:-1]  # the spectrum is even: negative frequencies have the same values
            ducc0.fft.c2c(block, axes=[0], forward=False, out=block)
            data[:, start:stop] = block[: self._rows]

        run_blocks(convolve, data.shape[1], self._threads, max(BLOCK // (2 * half), _BLOCK))
