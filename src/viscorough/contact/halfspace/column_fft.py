"""Convolution of the columns of a grid with an even kernel, by Fourier transforms of many columns side by side.

The transforms are implemented here because a convolution needs less than a library's transforms provide: rows without
data are neither stored nor copied, and frequencies stay in the order in which the transform leaves them.

Columns are processed in blocks. Within a row of a block the real parts are contiguous and the imaginary parts follow,
so that every operation below acts on as many columns at once as a register of the processor holds.
"""

import numpy as np
from numpy.typing import DTypeLike

from viscorough.compilation import njit
from viscorough.contact.parallel import Buffer, aligned_zeros, run_blocks
from viscorough.types import Array, Complex

# Columns of a block, which is small enough for the cache, and how many more columns the last block may have.
_BLOCK, _REST = 64, 8
# Distances in memory from real to imaginary parts and from row to row: no powers of two, multiples of which compete for
# the same cache lines. They are constants so that the compiler can see which numbers do not overlap.
_PARTS = _BLOCK + _REST
_ROW = 2 * _PARTS + 8


def good_length(least: int) -> int:
    """Smallest length 2^a 3^b ≥ least with a ≥ 2: the lengths for which there are transforms."""
    most = int(np.ceil(np.log2(max(least, 4))))
    lengths = [2**a * 3**b for a in range(2, most + 1) for b in range(most)]
    return min(length for length in lengths if length >= least)


def _radices(length: int) -> list[int]:
    """Factors 3, 4 and 8 of a length, small ones first: the last stage is one of four or eight."""
    twos = (length & -length).bit_length() - 1
    threes = round(np.log(length >> twos) / np.log(3))
    fours = -twos % 3
    return [3] * threes + [4] * fours + [8] * ((twos - 2 * fours) // 3)


@njit
def _at(x, row, j):
    """The complex number in column j of a row."""
    return complex(x[row, j], x[row, _PARTS + j])


@njit
def _put(y, group, member, j, value):
    """Store a complex number in column j of a member of a group of rows."""
    y[group, member * _ROW + j] = value.real
    y[group, member * _ROW + _PARTS + j] = value.imag


@njit
def _put_exchanged(y, group, member, j, value, factor):
    """Store a complex number times a real factor, with real and imaginary parts exchanged."""
    y[group, member * _ROW + j] = value.imag * factor
    y[group, member * _ROW + _PARTS + j] = value.real * factor


@njit
def _times_minus_i(z):
    """−i z."""
    return complex(z.imag, -z.real)


@njit
def _transform_of_four(a, b, c, d):
    """Transform of four numbers."""
    even, odd, even_rotated, odd_rotated = a + c, b + d, a - c, _times_minus_i(b - d)
    return even + odd, even_rotated + odd_rotated, even - odd, even_rotated - odd_rotated


@njit(fastmath=True)
def _transform_of_eight(z0, z1, z2, z3, z4, z5, z6, z7, root):
    """Transform of eight numbers; root = √½."""
    a, b, c, d = _transform_of_four(z0, z2, z4, z6)
    e, f, g, h = _transform_of_four(z1, z3, z5, z7)
    f, g, h = (f + _times_minus_i(f)) * root, _times_minus_i(g), (_times_minus_i(h) - h) * root
    return a + e, b + f, c + g, d + h, a - e, b - f, c - g, d - h


@njit(fastmath=True)
def _stage_of_three(x, source, y, before, factors, width):
    third = source.size // 3
    out = y.reshape(third, 3 * _ROW)
    half, root = x.dtype.type(0.5), x.dtype.type(np.sqrt(0.75))
    for p in range(third):
        i, k, m = source[p], source[p + third], source[p + 2 * third]
        w = factors[p // before]
        w1, w2 = w[1], w[2]
        for j in range(width):
            a, b, c = _at(x, i, j), _at(x, k, j), _at(x, m, j)
            both, apart = a - (b + c) * half, _times_minus_i(b - c) * root
            _put(out, p, 0, j, a + b + c)
            _put(out, p, 1, j, (both + apart) * w1)
            _put(out, p, 2, j, (both - apart) * w2)


@njit(fastmath=True)
def _stage_of_four(x, source, y, before, factors, width):
    quarter = source.size // 4
    out = y.reshape(quarter, 4 * _ROW)
    for p in range(quarter):
        i, k, m, n = source[p], source[p + quarter], source[p + 2 * quarter], source[p + 3 * quarter]
        w = factors[p // before]
        w1, w2, w3 = w[1], w[2], w[3]
        for j in range(width):
            a, b, c, d = _transform_of_four(_at(x, i, j), _at(x, k, j), _at(x, m, j), _at(x, n, j))
            _put(out, p, 0, j, a)
            _put(out, p, 1, j, b * w1)
            _put(out, p, 2, j, c * w2)
            _put(out, p, 3, j, d * w3)


@njit(fastmath=True)
def _stage_of_eight(x, source, y, before, factors, width):
    eighth = source.size // 8
    out = y.reshape(eighth, 8 * _ROW)
    root = x.dtype.type(np.sqrt(0.5))
    for p in range(eighth):
        i0, i1, i2, i3 = source[p], source[p + eighth], source[p + 2 * eighth], source[p + 3 * eighth]
        i4, i5, i6, i7 = source[p + 4 * eighth], source[p + 5 * eighth], source[p + 6 * eighth], source[p + 7 * eighth]
        w = factors[p // before]
        w1, w2, w3, w4, w5, w6, w7 = w[1], w[2], w[3], w[4], w[5], w[6], w[7]
        for j in range(width):
            z0, z1, z2, z3 = _at(x, i0, j), _at(x, i1, j), _at(x, i2, j), _at(x, i3, j)
            z4, z5, z6, z7 = _at(x, i4, j), _at(x, i5, j), _at(x, i6, j), _at(x, i7, j)
            a, b, c, d, e, f, g, h = _transform_of_eight(z0, z1, z2, z3, z4, z5, z6, z7, root)
            _put(out, p, 0, j, a)
            _put(out, p, 1, j, b * w1)
            _put(out, p, 2, j, c * w2)
            _put(out, p, 3, j, d * w3)
            _put(out, p, 4, j, e * w4)
            _put(out, p, 5, j, f * w5)
            _put(out, p, 6, j, g * w6)
            _put(out, p, 7, j, h * w7)


@njit(fastmath=True)
def _last_stage_of_four(x, source, y, spectrum, frequency, width):
    """The last stage, without twiddle factors, times the rows of the spectrum at these frequencies."""
    quarter = source.size // 4
    out = y.reshape(quarter, 4 * _ROW)
    for p in range(quarter):
        i, k, m, n = source[p], source[p + quarter], source[p + 2 * quarter], source[p + 3 * quarter]
        s0, s1 = spectrum[frequency[4 * p]], spectrum[frequency[4 * p + 1]]
        s2, s3 = spectrum[frequency[4 * p + 2]], spectrum[frequency[4 * p + 3]]
        for j in range(width):
            a, b, c, d = _transform_of_four(_at(x, i, j), _at(x, k, j), _at(x, m, j), _at(x, n, j))
            _put_exchanged(out, p, 0, j, a, s0[j])
            _put_exchanged(out, p, 1, j, b, s1[j])
            _put_exchanged(out, p, 2, j, c, s2[j])
            _put_exchanged(out, p, 3, j, d, s3[j])


@njit(fastmath=True)
def _last_stage_of_eight(x, source, y, spectrum, frequency, width):
    """The same for eight rows."""
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
            _put_exchanged(out, p, 0, j, a, s0[j])
            _put_exchanged(out, p, 1, j, b, s1[j])
            _put_exchanged(out, p, 2, j, c, s2[j])
            _put_exchanged(out, p, 3, j, d, s3[j])
            _put_exchanged(out, p, 4, j, e, s4[j])
            _put_exchanged(out, p, 5, j, f, s5[j])
            _put_exchanged(out, p, 6, j, g, s6[j])
            _put_exchanged(out, p, 7, j, h, s7[j])


@njit
def _stages(x, y, source, same, radices, factors, width):
    """Stages of the transform of the rows source[0], source[1], … of x; returns the array that holds it and the other.

    Every stage reads rows n/r apart and writes r rows side by side, of which the first holds frequencies that are 0
    modulo r, the next those that are 1, and so on (decimation in frequency with constant geometry; Pease 1968).

    x, y : two blocks, which the stages read and write in turn
    source : rows that the first stage reads; same : 0, 1, 2, …, the rows that the other stages read
    radices : r of every stage
    factors : the twiddle factors of the stages, one stage after the other, r for each group
    width : columns of the block
    """
    before, start = 1, 0  # `before`: product of the radices of the stages before
    for radix in radices:
        groups = same.size // (before * radix)
        stop = start + groups * radix
        of_stage = factors[start:stop].reshape(groups, radix)
        if radix == 8:
            _stage_of_eight(x, source, y, before, of_stage, width)
        elif radix == 4:
            _stage_of_four(x, source, y, before, of_stage, width)
        else:
            _stage_of_three(x, source, y, before, of_stage, width)
        before, start, source = before * radix, stop, same
        x, y = y, x
    return x, y


@njit
def _product(x, y, source, same, radices, factors, spectrum, frequency, width):
    """Product of the transform with the spectrum, real and imaginary parts exchanged; returns the same as `_stages`.

    With the parts exchanged, the next transform is an inverse one.
    """
    x, y = _stages(x, y, source, same, radices[:-1], factors, width)
    last_source = same if radices.size > 1 else source
    if radices[-1] == 8:
        _last_stage_of_eight(x, last_source, y, spectrum, frequency, width)
    else:
        _last_stage_of_four(x, last_source, y, spectrum, frequency, width)
    return y, x


@njit
def _load(data, first, x, width):
    """Copy columns from the first one on into the block x, and set the row after the last one to zero."""
    for i in range(data.shape[0]):
        row = data[i][first:]
        for j in range(width):
            x[i, j], x[i, _PARTS + j] = row[j].real, row[j].imag
    x[data.shape[0]] = 0


@njit
def _store(x, place, data, first, width):
    """Copy the block x, with real and imaginary parts exchanged back, to the columns from the first one on."""
    for i in range(data.shape[0]):
        row, at = data[i][first:], place[i]
        for j in range(width):
            row[j] = complex(x[at, _PARTS + j], x[at, j])


@njit(nogil=True)
def _convolve(start, stop, data, edges, spectra, frequency, radices, factors, padded, place, same, x, y):
    """Convolve blocks of columns in place; takes the plan of ColumnConvolution as plain arrays, being compiled."""
    for block in range(start, stop):
        first, width = edges[block], edges[block + 1] - edges[block]
        _load(data, first, x, width)
        product, other = _product(x, y, padded, same, radices, factors, spectra[block], frequency, width)
        convolved, _ = _stages(product, other, place, same, radices, factors, width)
        _store(convolved, place, data, first, width)


class ColumnConvolution:
    """Convolution of every column of a grid with its own even kernel.

    rows : number of rows with data
    spectrum : real transforms of the kernels along the columns, divided by the length of the transform: the frequencies
        up to half of it, shape (length/2 + 1, columns), where length is a good_length above `rows`
    precision : floating-point type of the computation
    threads : on which blocks of columns are convolved
    """

    def __init__(self, rows: int, spectrum: Array, precision: DTypeLike, threads: int = 1) -> None:
        length, columns = 2 * (spectrum.shape[0] - 1), spectrum.shape[1]
        radices = _radices(length)
        frequency, factors, rest = np.zeros(1, dtype=int), [], length
        for radix in radices:
            factors.append(np.exp(-2j * np.pi / rest * np.outer(np.arange(rest // radix), np.arange(radix))).ravel())
            frequency = np.add.outer(frequency, length // rest * np.arange(radix)).ravel()
            rest //= radix
        edges = np.array([*range(0, max(columns - _REST, 1), _BLOCK), columns])
        spectra = aligned_zeros((edges.size - 1, length // 2 + 1, _PARTS), precision)
        for block, of_block in enumerate(np.split(spectrum, edges[1:-1], axis=1)):
            spectra[block, :, : of_block.shape[1]] = of_block
        spectral = np.result_type(precision, np.complex64)
        same = np.arange(length)
        self._plan = (
            edges, spectra, np.minimum(frequency, length - frequency),
            np.array(radices), np.concatenate(factors).astype(spectral),
            np.minimum(same, rows), np.argsort(frequency), same,
        )  # fmt: skip
        self._blocks, self._threads = edges.size - 1, threads
        self._work = Buffer((2, length, _ROW), precision)

    def apply(self, data: Complex) -> None:
        """Convolve the columns of `data`, complex numbers of shape (rows, columns), in place."""

        def convolve(start: int, stop: int) -> None:
            _convolve(start, stop, data, *self._plan, *self._work.array)

        run_blocks(convolve, self._blocks, self._threads, 1 if self._threads > 1 else self._blocks)
