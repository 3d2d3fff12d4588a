"""Apply the half-space operator in some square tiles of a large grid, with no loads and deflections elsewhere.

The kernel is split as in Ewald's sum for point charges: K = (K − S) + S with S(r) ≈ erf(r/σ)/r, the smooth deflection
by a load that is spread over a Gaussian. K − S has a short range: its convolution takes one small Fourier transform for
every tile, which stays in the cache. S is so smooth that its convolution is done on a coarse grid: loads are
distributed to its points, and deflections are interpolated between them, with the same windowed sinc functions.
"""

from math import erf

import ducc0
import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import DTypeLike

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.halfspace.influence import influence_table
from viscorough.contact.halfspace.operator import Convolution, convolution_lengths, spectrum_of_kernel
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.parallel import Buffer, run_blocks

# Elements along the side of a tile, a multiple of _STRIDE.
SIDE = 120
# Elements per point of the coarse grid, along rows and columns.
_STRIDE = 4
# Points along rows and columns that the load of an element is distributed to.
_POINTS = 14
# Parameter of the Kaiser window of the sinc functions.
_WINDOW = 16.5
# σ over the distance of the coarse points.
_SMOOTHING = 4.5
# Range of K − S over σ.
_RANGE = 3.8
# Distance over σ beyond which erf is 1 to rounding.
_FLAT = 7.0
# Bound on the error, over the largest deflection (tests/viscorough/contact/halfspace/test_tiles.py).
ACCURACY = 1e-7
# Least ratio of a tolerance to this error: the rest is for the iterations.
_MARGIN = 4
# Largest ratio of the sides of elements; beyond it the error of the coarse grid exceeds ACCURACY.
_LARGEST_ASPECT = 2.0


def is_suitable(shape: tuple[int, int], aspect: float, tolerance: float, options: SolverOptions = DEFAULT) -> bool:
    """Return True if a grid is so large that tiles save time, and the deflections in them are exact enough.

    tolerance : error of deflections that is allowed, over the largest deflection
    """
    is_large = shape[0] * shape[1] > options.tiles_from
    return is_large and max(aspect, 1 / aspect) <= _LARGEST_ASPECT and tolerance >= _MARGIN * ACCURACY


def tiles_with(row: Integers, column: Integers, shape: tuple[int, int]) -> Mask:
    """Return True for the tiles of a grid that contain elements, shape (rows of tiles, columns of tiles)."""
    tiles: Mask = np.zeros([-(-n // SIDE) for n in shape], bool)
    tiles[row // SIDE, column // SIDE] = True
    return tiles


def are_few(tiles: Mask, options: SolverOptions = DEFAULT) -> bool:
    """Return True if the tiles with elements are so few that their transforms take less time than the whole grid."""
    return bool(np.count_nonzero(tiles) <= options.tiles_share * tiles.size)


def tiles_beyond(box: tuple[int, ...], shape: tuple[int, int]) -> Mask:
    """Return True for the tiles of a grid that do not lie wholly in a box (first row, first column, rows, columns)."""
    tiles: Mask = np.ones([-(-n // SIDE) for n in shape], bool)
    inner = []
    for first, size, n in zip(box, box[2:], shape, strict=False):
        end = -(-n // SIDE) if first + size == n else (first + size) // SIDE
        inner.append(slice(-(-first // SIDE), end))
    tiles[*inner] = False
    return tiles


class TiledHalfspace:
    """Half-space operator w = K P on tiles of a grid of rows × columns elements; see operator.Halfspace.

    rows, columns, precision, aspect, threads : see operator.Halfspace
    tiles : True for tiles that may have loads; see `tiles_with`

    load : the array to write P into, of shape (rows, columns); it must be zero where there is no pressure
    count : number of applications so far
    accuracy : bound on the error in addition to rounding, over the largest deflection
    """

    accuracy = ACCURACY

    def __init__(
        self,
        rows: int,
        columns: int,
        tiles: Mask,
        precision: DTypeLike = np.float64,
        *,
        aspect: float = 1.0,
        threads: int = 1,
    ) -> None:
        self.shape, self.count, self._threads, self._tiles = (rows, columns), 0, threads, tiles
        sides = np.sqrt(aspect), np.sqrt(1 / aspect)
        sigma = _SMOOTHING * _STRIDE * max(sides)
        self._weights = _interpolation_weights().astype(precision)
        points = tuple(n * SIDE // _STRIDE + _POINTS - 1 for n in tiles.shape)

        def smooth(row: Array, column: Array) -> Array:
            return _smooth_kernel(_STRIDE * row, _STRIDE * column, *sides, sigma)

        spectrum = spectrum_of_kernel(convolution_lengths(points[0], points[1]), smooth, threads)
        self._coarse = Convolution((points[0], points[1]), spectrum, precision, threads=threads)
        self._reach, lengths, self._spectrum = _short_range(sides, sigma, precision)
        self.load, self._deflection = np.zeros((2, rows, columns), precision)
        self._patch = Buffer(lengths, precision)
        self._transform = Buffer(self._spectrum.shape, np.result_type(precision, np.complex64))

    def apply(self) -> Array:
        """Compute w = K P in the tiles from the pressure in `load`, zero in other tiles; valid until the next call."""
        for part in map(_part, np.argwhere(self._tiles)):
            self._deflection[part] = 0
        self.add_to(self._deflection, self._tiles)
        return self._deflection

    def add_to(self, field: Array, targets: Mask) -> None:
        """Add the deflection to a field of shape (rows, columns), in place, in the target tiles."""
        self._coarse.load[:] = 0
        loaded: Mask = np.zeros(self._tiles.shape, bool)
        tiles = np.argwhere(targets)
        for tile in np.argwhere(self._tiles):
            load = self.load[_part(tile)]
            if load.any():
                loaded[*tile], distributed = True, _distribute(load, self._weights)
                rows, columns = distributed.shape
                self._coarse.load[_coarse_part(tile)][:rows, :columns] += distributed
        coarse, around = self._coarse.apply(), [-(-reach // SIDE) for reach in self._reach]
        near = sliding_window_view(np.pad(loaded, [(n, n) for n in around]), [2 * n + 1 for n in around])
        has_near: Mask = np.any(near, axis=(2, 3))

        def add(start: int, stop: int) -> None:
            for tile in tiles[start:stop]:
                if has_near[*tile]:
                    self._add_near_field(tile, field)
                part = field[_part(tile)]
                rows, columns = part.shape
                smooth = _interpolate(np.ascontiguousarray(coarse[_coarse_part(tile)]), self._weights)
                part += smooth[:rows, :columns]

        run_blocks(add, len(tiles), self._threads, 1)
        self.count += 1

    def _add_near_field(self, tile: Integers, field: Array) -> None:
        """Add the convolution with K − S to a field in a tile."""
        target = field[_part(tile)]
        # The patch holds the loads within the range; those beyond its edges, where it repeats, do not reach the tile.
        first = SIDE * tile - self._reach
        taken = [slice(max(i, 0), i + SIDE + 2 * n) for i, n in zip(first, self._reach, strict=True)]
        load = self.load[*taken]
        patch, transform = self._patch.array, self._transform.array
        patch[:] = 0
        rows, columns = np.maximum(-first, 0)
        patch[rows : rows + load.shape[0], columns : columns + load.shape[1]] = load
        ducc0.fft.r2c(patch, axes=[0, 1], out=transform)
        transform *= self._spectrum
        ducc0.fft.c2r(transform, axes=[0, 1], forward=False, lastsize=patch.shape[1], out=patch)
        rows, columns = self._reach
        target += patch[rows : rows + target.shape[0], columns : columns + target.shape[1]]


def _interpolation_weights() -> Array:
    """Return the weights of the coarse points around an element, by its place between them: (_STRIDE, _POINTS)."""
    from scipy.special import i0  # takes long to import

    place = np.arange(_STRIDE)[:, None] / _STRIDE - np.arange(1 - _POINTS // 2, _POINTS // 2 + 1)
    window = i0(_WINDOW * np.sqrt(np.maximum(1 - (2 * place / _POINTS) ** 2, 0.0))) / i0(_WINDOW)
    return np.sinc(place) * window


def _short_range(
    sides: tuple[float, float], sigma: float, precision: DTypeLike
) -> tuple[tuple[int, ...], tuple[int, ...], Array]:
    """Return the range of K − S in rows and columns, the lengths of the transforms for a tile, and its spectrum."""
    reach = tuple(int(np.ceil(_RANGE * sigma / side)) for side in sides)
    lengths = tuple(2 * ducc0.fft.good_size(-(-(SIDE + 2 * n) // 2), True) for n in reach)

    def kernel(row: Array, column: Array) -> Array:
        table = influence_table(row, column, sides[0] / sides[1]) - _smooth_kernel(row, column, *sides, sigma)
        return np.where((row[:, None] * sides[0]) ** 2 + (column * sides[1]) ** 2 <= (_RANGE * sigma) ** 2, table, 0.0)

    half = spectrum_of_kernel(lengths, kernel)
    return reach, lengths, np.concatenate([half, half[-2:0:-1]]).astype(precision)


def _part(tile: Integers) -> tuple[slice, ...]:
    """Return the rows and columns of a tile."""
    return tuple(slice(first, first + SIDE) for first in (SIDE * tile).tolist())


def _coarse_part(tile: Integers) -> tuple[slice, ...]:
    """Return rows and columns of the points of the coarse grid to which a tile distributes its loads."""
    return tuple(slice(part.start // _STRIDE, part.stop // _STRIDE + _POINTS - 1) for part in _part(tile))


@njit(fastmath=True)
def _smooth_kernel(row, column, side_y, side_x, sigma):
    """Return S at all pairs of distances: the mean of erf(r/σ)/r over an element, by two Gauss points per side."""
    table, shift = np.zeros((row.size, column.size)), 1 / np.sqrt(12.0)
    for i in range(row.size):
        target = table[i]
        for sign_y in (-1, 1):
            y = (row[i] + sign_y * shift) * side_y
            for sign_x in (-1, 1):
                for j in range(column.size):
                    x = (column[j] + sign_x * shift) * side_x
                    target[j] += 0.25 / np.sqrt(x * x + y * y)
                for j in range(column.size if abs(y) < _FLAT * sigma else 0):
                    x = (column[j] + sign_x * shift) * side_x
                    if abs(x) < _FLAT * sigma:
                        r = np.sqrt(x * x + y * y)
                        target[j] += 0.25 * (erf(r / sigma) - 1) / r
    return table


@njit(fastmath=True)
def _distribute(load, weights):
    """Distribute the loads of a tile to the points of the coarse grid, first along the rows."""
    rows, columns = load.shape
    coarse = np.zeros(((rows - 1) // _STRIDE + _POINTS, (columns - 1) // _STRIDE + _POINTS), load.dtype)
    row_sums = np.empty(coarse.shape[1], load.dtype)
    for i in range(rows):
        row_sums[:], is_loaded = 0, False
        for j in range(columns):
            value = load[i, j]
            if value != 0:
                is_loaded, first = True, j // _STRIDE
                for m in range(_POINTS):
                    row_sums[first + m] += value * weights[j % _STRIDE, m]
        if is_loaded:
            for k in range(_POINTS):
                target, weight = coarse[i // _STRIDE + k], weights[i % _STRIDE, k]
                for m in range(row_sums.size):
                    target[m] += weight * row_sums[m]
    return coarse


@njit(fastmath=True)
def _interpolate(coarse, weights):
    """Interpolate the field of a tile between the points of the coarse grid."""
    side = (coarse.shape[0] - _POINTS + 1) * _STRIDE
    across, field = np.empty((coarse.shape[0], side), coarse.dtype), np.empty((side, side), coarse.dtype)
    for k in range(coarse.shape[0]):
        source, target = coarse[k], across[k]
        for phase in range(_STRIDE):
            for p in range(side // _STRIDE):
                value = coarse.dtype.type(0)
                for m in range(_POINTS):
                    value += weights[phase, m] * source[p + m]
                target[p * _STRIDE + phase] = value
    for i in range(side):
        target, first, phase = field[i], i // _STRIDE, i % _STRIDE
        for j in range(side):
            value = coarse.dtype.type(0)
            for k in range(_POINTS):
                value += weights[phase, k] * across[first + k, j]
            target[j] = value
    return field
