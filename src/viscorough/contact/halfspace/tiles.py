"""Apply the half-space operator in selected square tiles of a large grid, and skip all other tiles.

The influence coefficients K are split like the potential in Ewald's sum for point charges: K = (K − S) + S. Here
S(r) ≈ erf(r/σ)/r is the smooth deflection at a distance r from a load that is spread over a Gaussian of width σ.

K − S has a short range. For every tile, the convolution with K − S takes one small Fourier transform, which stays in
the cache of the processor. S is so smooth that a coarse grid suffices for the convolution with S. Windowed sinc
functions distribute the loads to the points of the coarse grid, and interpolate the deflections between the points.
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

# Number of elements along the side of a tile; a multiple of _STRIDE.
SIDE = 120
# Distance between two points of the coarse grid, in elements, along rows and along columns.
_STRIDE = 4
# The load of an element is distributed to this number of points of the coarse grid, along rows and along columns.
_POINTS = 14
# Shape parameter β of the Kaiser window. For the interpolation, sinc functions are multiplied by this window.
_WINDOW = 16.5
# Width σ of the Gaussian in the smooth kernel S ≈ erf(r/σ)/r, divided by the distance between two coarse points.
_SMOOTHING = 4.5
# The short-range part K − S of the influence coefficients is taken as zero where r/σ, with the distance r, exceeds this
# number.
_RANGE = 3.8
# For r/σ above this number, erf(r/σ) equals 1 within rounding.
_FLAT = 7.0
# Bound on the error of a deflection, relative to the largest deflection
# (tests/viscorough/contact/halfspace/test_tiles.py).
ACCURACY = 1e-7
# Tiles are used only if the tolerance of the contact is at least this multiple of ACCURACY, so that most of the
# tolerance is left for the errors of the iterations.
_MARGIN = 4
# Largest ratio of the two sides of an element. For larger ratios the error of the coarse grid exceeds ACCURACY.
_LARGEST_ASPECT = 2.0


def is_suitable(shape: tuple[int, int], aspect: float, tolerance: float, options: SolverOptions) -> bool:
    """Return True if a grid is so large that tiles save time, and if deflections by tiles are accurate enough.

    shape : rows and columns of the grid
    aspect : dy/dx of the elements
    tolerance : allowed error of deflections, relative to the largest deflection
    """
    is_large = shape[0] * shape[1] > options.tiles_from
    return is_large and max(aspect, 1 / aspect) <= _LARGEST_ASPECT and tolerance >= _MARGIN * ACCURACY


def tiles_with(row: Integers, column: Integers, shape: tuple[int, int]) -> Mask:
    """Return an array that is True for the tiles of a grid that contain any of the given elements.

    row, column : positions of the elements on the grid
    shape : rows and columns of the grid

    Returns an array of shape (rows of tiles, columns of tiles).
    """
    tiles: Mask = np.zeros([-(-n // SIDE) for n in shape], bool)
    tiles[row // SIDE, column // SIDE] = True
    return tiles


def are_few(tiles: Mask, options: SolverOptions = DEFAULT) -> bool:
    """Return True if so few tiles contain elements that tiles take less time than a transform of the whole grid.

    tiles : True for tiles that contain elements
    """
    return bool(np.count_nonzero(tiles) <= options.tiles_share * tiles.size)


def tiles_beyond(box: tuple[int, ...], shape: tuple[int, int]) -> Mask:
    """Return an array that is True for all tiles of a grid, except for tiles that lie wholly inside a box.

    box : (first row, first column, rows, columns)
    shape : rows and columns of the grid

    Returns an array of shape (rows of tiles, columns of tiles).
    """
    tiles: Mask = np.ones([-(-n // SIDE) for n in shape], bool)
    inner = []
    for first, size, n in zip(box, box[2:], shape, strict=False):
        end = -(-n // SIDE) if first + size == n else (first + size) // SIDE
        inner.append(slice(-(-first // SIDE), end))
    tiles[*inner] = False
    return tiles


class TiledHalfspace:
    """Half-space operator w = K P in selected tiles of a grid of rows × columns elements; see operator.Halfspace.

    rows, columns, precision, aspect, threads : see operator.Halfspace
    tiles : True for tiles that may have loads; see `tiles_with`

    load : the array to write P into, of shape (rows, columns); it must be zero on elements without pressure
    count : number of applications so far
    accuracy : bound on the error that is not due to rounding, relative to the largest deflection
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
        """Return the deflection w = K P by the pressure in `load`, in the tiles that may have loads.

        The array has shape (rows, columns) and is zero in all other tiles. The next call overwrites the array.
        """
        for part in map(_part, np.argwhere(self._tiles)):
            self._deflection[part] = 0
        self.add_to(self._deflection, self._tiles)
        return self._deflection

    def add_to(self, field: Array, targets: Mask) -> None:
        """Add the deflection by the pressure in `load` to a field, in place, in the target tiles only.

        field : array of shape (rows, columns)
        targets : True for target tiles, shape (rows of tiles, columns of tiles)
        """
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
        """Add the near field (the convolution of the load with the short-range part K − S) to a field in one tile."""
        target = field[_part(tile)]
        # The patch holds the tile and all loads that act on it through K − S. The Fourier transform repeats the patch
        # periodically, but the repeated loads are too far away to act on the tile.
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
    """Return the weights of the nearest coarse points in the interpolation to an element.

    Returns an array of shape (_STRIDE, _POINTS). Along an axis, an element can have _STRIDE positions between two
    coarse points. Row i contains the weights for position i.
    """
    from scipy.special import i0  # this import takes long

    place = np.arange(_STRIDE)[:, None] / _STRIDE - np.arange(1 - _POINTS // 2, _POINTS // 2 + 1)
    window = i0(_WINDOW * np.sqrt(np.maximum(1 - (2 * place / _POINTS) ** 2, 0.0))) / i0(_WINDOW)
    return np.sinc(place) * window


def _short_range(
    sides: tuple[float, float], sigma: float, precision: DTypeLike
) -> tuple[tuple[int, ...], tuple[int, ...], Array]:
    """Prepare the convolution of the loads around a tile with the short-range part K − S (see the module).

    sides : dy/d and dx/d of the elements, with d = √(dx dy)
    sigma : σ/d, with the width σ of the Gaussian in S

    Returns three results: the range of K − S, as a number of rows and a number of columns; the numbers of rows and
    columns of the array that is Fourier transformed for a tile; and the Fourier transform of K − S.
    """
    reach = tuple(int(np.ceil(_RANGE * sigma / side)) for side in sides)
    lengths = tuple(2 * ducc0.fft.good_size(-(-(SIDE + 2 * n) // 2), True) for n in reach)

    def kernel(row: Array, column: Array) -> Array:
        table = influence_table(row, column, sides[0] / sides[1]) - _smooth_kernel(row, column, *sides, sigma)
        return np.where((row[:, None] * sides[0]) ** 2 + (column * sides[1]) ** 2 <= (_RANGE * sigma) ** 2, table, 0.0)

    half = spectrum_of_kernel(lengths, kernel)
    return reach, lengths, np.concatenate([half, half[-2:0:-1]]).astype(precision)


def _part(tile: Integers) -> tuple[slice, ...]:
    """Return the slices that select the rows and the columns of a tile.

    tile : row and column of the tile among the tiles
    """
    return tuple(slice(first, first + SIDE) for first in (SIDE * tile).tolist())


def _coarse_part(tile: Integers) -> tuple[slice, ...]:
    """Return the slices that select the rows and the columns of the coarse points for the loads of a tile.

    The loads of the tile are distributed to these points, and its deflections are interpolated between them.

    tile : row and column of the tile among the tiles
    """
    return tuple(slice(part.start // _STRIDE, part.stop // _STRIDE + _POINTS - 1) for part in _part(tile))


@njit(fastmath=True)
def _smooth_kernel(row, column, side_y, side_x, sigma):
    """Return the smooth kernel S at all pairs of a distance in rows and a distance in columns.

    S is the mean of erf(r/σ)/r over an element, computed with two Gauss points along each side.

    row, column : distances in rows and in columns
    side_y, side_x : dy/d and dx/d of the elements, with d = √(dx dy)
    sigma : σ/d
    """
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
    """Distribute the loads of a tile to the points of the coarse grid, first along rows, then along columns.

    load : loads of the elements of the tile, in rows and columns
    weights : array from `_interpolation_weights`

    Returns the loads of the coarse points.
    """
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
    """Interpolate from the points of the coarse grid to the elements of a tile.

    coarse : values at the coarse points
    weights : array from `_interpolation_weights`

    Returns the values at the elements.
    """
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
