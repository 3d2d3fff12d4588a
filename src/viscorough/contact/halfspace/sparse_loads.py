"""Deflection everywhere by a load on few elements, in time and memory that hardly exceed those of the result.

The kernel is split as in Ewald's sum for point charges: K = (K − S) + S with S(r) ≈ erf(r/σ)/r, the smooth deflection
by a load that is spread over a Gaussian. K − S has a short range and is summed directly for every loaded element. S is
so smooth that its convolution is done on a coarse grid: loads are distributed to its points, and deflections are
interpolated between them, with the same windowed sinc functions.
"""

import itertools

import ducc0
import numpy as np

from viscorough.compilation import njit
from viscorough.contact.halfspace.influence import influence_table
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.types import Array, Integers

# Elements per point of the coarse grid, along rows and columns; points that an element is distributed to; parameter of
# the Kaiser window of the sinc functions; σ over the distance of the coarse points; range of K − S over σ.
_STRIDE, _POINTS, _WINDOW, _SMOOTHING, _RANGE = 4, 14, 16.5, 4.5, 3.8
# Distance over σ from which on erf is 1 to rounding.
_FLAT = 7.0
# Bound on the error, over the largest deflection (tests/viscorough/contact/halfspace/test_sparse_loads.py).
ACCURACY = 2e-7
# Number of elements and largest share of them that are loaded for which this takes less time, and largest ratio of the
# sides of elements.
_LEAST, _LARGEST_SHARE, _LARGEST_ASPECT = BLOCK, 0.02, 2.0


def is_suitable(shape: tuple[int, int], loaded: int, aspect: float) -> bool:
    """Whether a map is so large, and the elements loaded so few, that the deflection is best computed here."""
    elements = shape[0] * shape[1]
    return elements > _LEAST and loaded <= _LARGEST_SHARE * elements and max(aspect, 1 / aspect) <= _LARGEST_ASPECT


def add_deflection(
    field: Array,
    row: Integers,
    column: Integers,
    load: Array,
    *,
    outside: tuple[int, ...] = (0, 0, 0, 0),
    aspect: float = 1.0,
    threads: int = 1,
) -> None:
    """Add the deflection K P by pressures P of few elements to a field of shape (rows, columns), in place.

    row, column, load : of the loaded elements
    outside : (first row, first column, rows, columns) of a box outside which it is wanted; in the box it is undefined
    aspect : dy/dx
    """
    sides = np.sqrt(aspect), np.sqrt(1 / aspect)
    sigma = _SMOOTHING * _STRIDE * max(sides)
    weights = _interpolation_weights()
    coarse = np.zeros([(n - 1) // _STRIDE + _POINTS for n in field.shape])
    _distribute(row, column, load, weights, coarse)
    coarse = _convolve(coarse, sides, sigma)
    across = np.empty((coarse.shape[0], field.shape[1]))
    _interpolate_rows(coarse, weights, across)
    near, widths = _near_field(sides, sigma)
    reach = near.shape[0] - 1, near.shape[1] // 2
    close = np.zeros(load.size, bool) if outside[2] else np.ones(load.size, bool)  # to what is outside the box
    for place, first, size, distance, end in zip(
        (row, column), outside[:2], outside[2:], reach, field.shape, strict=True
    ):
        close |= (place < first + distance) & (first > 0) | (place >= first + size - distance) & (first + size < end)
    row, column, load = row[close], column[close], load[close]

    def add(start: int, stop: int) -> None:
        _interpolate_columns(across, weights, start, stop, field)
        _add_near_field(row, column, load, near, widths, start, stop, field)

    run_blocks(add, field.shape[0], threads, -(-BLOCK // field.shape[1]))


def _interpolation_weights() -> Array:
    """Weights of the coarse points around an element, by its place between them, shape (_STRIDE, _POINTS)."""
    from scipy.special import i0  # takes long to import

    place = np.arange(_STRIDE)[:, None] / _STRIDE - np.arange(1 - _POINTS // 2, _POINTS // 2 + 1)
    window = i0(_WINDOW * np.sqrt(np.maximum(1 - (2 * place / _POINTS) ** 2, 0.0))) / i0(_WINDOW)
    return np.sinc(place) * window


def _smooth_kernel(row: Array, column: Array, sides: tuple[float, float], sigma: float) -> Array:
    """S at all pairs of distances: the mean of erf(r/σ)/r over an element, by two points of Gauss along each side."""
    from scipy.special import erf  # takes long to import

    total = np.zeros((row.size, column.size))
    shifts = np.array([-1, 1]) / np.sqrt(12)
    near = (
        slice(np.searchsorted(row * sides[0], _FLAT * sigma)),
        slice(np.searchsorted(column * sides[1], _FLAT * sigma)),
    )
    for shift_y, shift_x in itertools.product(shifts, shifts):
        squares = ((column + shift_x) * sides[1]) ** 2 + ((row[:, None] + shift_y) * sides[0]) ** 2
        inverse = 1 / np.sqrt(squares)
        inverse[near] *= erf(np.sqrt(squares[near]) / sigma)
        total += inverse
    return total / 4


def _convolve(coarse: Array, sides: tuple[float, float], sigma: float) -> Array:
    """Convolution with S of loads on the coarse grid."""
    lengths = [2 * ducc0.fft.good_size(n, True) for n in coarse.shape]
    row, column = (_STRIDE * np.arange(length // 2 + 1.0) for length in lengths)
    spectrum = _smooth_kernel(row, column, sides, sigma)
    ducc0.fft.dct(spectrum, axes=[0, 1], type=1, out=spectrum)
    spectrum /= np.prod(lengths)
    rows, columns = coarse.shape
    padded = np.zeros(lengths)
    padded[:rows, :columns] = coarse
    transformed = ducc0.fft.r2c(padded, axes=[0, 1])
    half = lengths[0] // 2
    transformed[: half + 1] *= spectrum
    transformed[half + 1 :] *= spectrum[half - 1 : 0 : -1]
    ducc0.fft.c2r(transformed, axes=[0, 1], forward=False, lastsize=lengths[1], out=padded)
    return padded[:rows, :columns]


def _near_field(sides: tuple[float, float], sigma: float) -> tuple[Array, Integers]:
    """K − S by distance in rows and by column from −range to range; and the range in columns at every distance."""
    rows, columns = (int(np.ceil(_RANGE * sigma / side)) for side in sides)
    row, column = np.arange(rows + 1.0), np.arange(columns + 1.0)
    half = influence_table(row, column, sides[0] / sides[1]) - _smooth_kernel(row, column, sides, sigma)
    width = np.sqrt(np.maximum((_RANGE * sigma) ** 2 - (row * sides[0]) ** 2, 0.0)) / sides[1]
    return np.concatenate([half[:, :0:-1], half], axis=1), width.astype(int)


@njit
def _distribute(row, column, load, weights, coarse):
    """Distribute loads to the points of the coarse grid, in place."""
    stride, points = weights.shape
    for t in range(row.size):
        first, of_columns = column[t] // stride, weights[column[t] % stride]
        for k in range(points):
            target = coarse[row[t] // stride + k]
            value = load[t] * weights[row[t] % stride, k]
            for m in range(points):
                target[first + m] += value * of_columns[m]


@njit(fastmath=True)
def _interpolate_rows(coarse, weights, across):
    """Interpolate along every row of the coarse grid to the columns of the elements."""
    stride, points = weights.shape
    for i in range(coarse.shape[0]):
        source, target = coarse[i], across[i]
        for j in range(target.size):
            value, first, of_column = 0.0, j // stride, weights[j % stride]
            for m in range(points):
                value += of_column[m] * source[first + m]
            target[j] = value


@njit(nogil=True, fastmath=True)
def _interpolate_columns(across, weights, start, stop, field):
    """Add to rows of the field what is interpolated between the rows of the coarse grid, in place."""
    stride, points = weights.shape
    for i in range(start, stop):
        target, first = field[i], i // stride
        for k in range(0, points, 2):
            weight, next_weight = weights[i % stride, k], weights[i % stride, k + 1]
            source, next_source = across[first + k], across[first + k + 1]
            for j in range(target.size):
                target[j] += weight * source[j] + next_weight * next_source[j]


@njit(nogil=True, fastmath=True)
def _add_near_field(row, column, load, near, widths, start, stop, field):
    """Add K − S times the loads to rows of the field, in place."""
    reach, centre = near.shape[0] - 1, near.shape[1] // 2
    for t in range(row.size):
        value = load[t]
        for i in range(max(row[t] - reach, start), min(row[t] + reach + 1, stop)):
            distance = abs(i - row[t])
            width = widths[distance]
            first, last = max(column[t] - width, 0), min(column[t] + width + 1, field.shape[1])
            target, source = field[i, first:last], near[distance, first - column[t] + centre :]
            for j in range(target.size):
                target[j] += value * source[j]
