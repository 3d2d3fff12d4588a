"""Generate self-affine lines with random heights; quantities that do not depend on the realization are computed once.

A line has the power spectral density C1D = π q C2D of a surface (`self_affine`) at the wavenumber q, so that its rms
height is the same. Hence C1D(q) ∝ q^(-(2H+1)) (paper, Eq. 13), with the Hurst exponent H.

Heights are the Fourier transform of random waves (see `line_waves`). For an even number n of points in single
precision, neighbouring points are combined into m = n/2 complex numbers z_j, j = 0, 1, ..., m - 1. Their spectrum is
Z_k. The transform from Z to z consists of short transforms, which fit in the cache (four-step method; D. H. Bailey,
FFTs in external or hierarchical memory, 1990). With m = N₁N₂, k = N₂k₁ + k₂ and j = j₁ + N₁j₂ it is
    z_j = Σ_k₂ exp(2πi j₂k₂/N₂) exp(2πi j₁k₂/m) Σ_k₁ exp(2πi j₁k₁/N₁) Z_k.
The result is an array [j₁, j₂], so the points are not stored in their order along the line. This order is irrelevant to
the method of dimensionality reduction. All other lines are computed by an ordinary real transform.
"""

import math
from typing import Any

import numpy as np
from ducc0 import fft
from numpy.typing import DTypeLike

from viscorough.basics import memory
from viscorough.basics.arrays import positive, whole_number
from viscorough.basics.types import Array, Integers, Seed
from viscorough.surfaces import line_waves, spectrum
from viscorough.surfaces.indenter import Indenter

# The rms height must be at least this factor above the smallest number of the floating-point type, and at least this
# factor below the largest number.
_ROOM = 1000
# Number of waves computed at a time in double precision.
_BLOCK = 16384
# The Fourier transform copies the heights of a line. The memory that must be available is therefore this multiple of
# the memory for the heights. The second value is for numbers of points with large prime factors.
_COPIES, _MOST_COPIES = 2.6, 17


def self_affine_line(
    hurst: float,
    points: int,
    *,
    rms: float = 1.0,
    length: float = 1.0,
    roll_off_wavelength: float | None = None,
    roll_off_level: float = 0.0,
    amplitudes: str = "random",
    length_unit: str = "1",
    seed: Seed,
    dtype: DTypeLike = np.float32,
) -> Indenter:
    """Generate a periodic self-affine line for the method of dimensionality reduction (MDR).

    The power spectral density at the wavenumber q is C1D ∝ q^(-(2H+1)).

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from 0 to 1 [1].
    points : int
        Number of points per period, at least 2.
    rms : float, optional
        Standard deviation h of the heights, exact in every realization [length].
    length : float, optional
        Length L of the line, which is also its period [length]; the spacing is L/points.
    roll_off_wavelength : float, optional
        Longest wavelength of the power law, as a multiple of L; by default all waves follow the power law.
    roll_off_level : float, optional
        Spectral density of waves longer than the roll-off wavelength, relative to the density at the roll-off
        wavelength. 0: there are no longer waves; 1: all longer waves have this density.
    amplitudes : str, optional
        "random" for complex Gaussian amplitudes, "fixed" for amplitudes equal to the square root of the spectrum.
    length_unit : str, optional
        "m" if numbers are in SI units, "1" if they are in consistent units that are not known, the default.
    seed : int or SeedSequence
        Seed of the random numbers. The same seed gives the same realization.
    dtype : numpy dtype or name, optional
        Floating-point type of the heights, float32 or float64. For the same seed, both have the same heights except for
        rounding.

    Returns
    -------
    Indenter
        Line of shape (points,) with mean 0.

    Raises
    ------
    ValueError
        For values out of range.

    Examples
    --------
    >>> import viscorough
    >>> viscorough.self_affine_line(0.7, 1000, rms=0.1, seed=1).heights.shape
    (1000,)
    """
    roll_off: dict[str, Any] = {"roll_off_wavelength": roll_off_wavelength, "roll_off_level": roll_off_level}
    lines = SelfAffineLines(hurst, points, rms=rms, length=length, amplitudes=amplitudes, dtype=dtype, **roll_off)
    return Indenter(lines.heights(seed), lines.spacing, length_unit=length_unit)


class SelfAffineLines:
    """Generator of periodic self-affine lines with the same spectrum and different random waves.

    hurst, points, rms, length, dtype : arguments of `self_affine_line`
    waves : further arguments of `self_affine_line`, by name: roll_off_wavelength, roll_off_level and amplitudes

    The attribute `spacing` is the distance between neighbouring points, length/points [length].

    Raises the errors of `self_affine_line`.
    """

    def __init__(
        self,
        hurst: float,
        points: int,
        *,
        rms: float = 1.0,
        length: float = 1.0,
        dtype: DTypeLike = np.float32,
        **waves: Any,
    ) -> None:
        self._points = points = whole_number("points", points, at_least=2)
        self._exponent = spectrum.hurst_exponent(hurst) + 0.5
        self._rms, length = positive("rms", rms), positive("length", length)
        *self._roll_off, self._fixed = spectrum.wave_options(period=1, **waves)
        self._dtype = np.dtype(dtype)
        if self._dtype not in (np.float32, np.float64):
            raise ValueError(f"dtype: must be float32 or float64, not {self._dtype}")
        low, high = _ROOM * np.finfo(self._dtype).tiny, np.finfo(self._dtype).max / _ROOM
        if not low <= self._rms <= high:
            raise ValueError(f"argument rms: must be from {low:.2g} to {high:.2g} for {self._dtype}, not {self._rms:g}")
        copies = _COPIES if fft.good_size(points, True) == points else _MOST_COPIES
        memory.require(copies * self._dtype.itemsize * points, f"a line of {points} points")
        if points // 2 > line_waves.MOST_WAVES:
            raise ValueError(f"argument points: must be at most {2 * line_waves.MOST_WAVES + 1}, not {points}")
        self.spacing = length / points
        self._in_pairs = self._dtype == np.float32 and points % 2 == 0
        if self._in_pairs:
            self._amplitude = self._moduli(0, points // 2 + 1)
            pairs = points // 2
            # The number of rows is the largest divisor of `pairs` up to √pairs.
            rows = next(d for d in range(math.isqrt(pairs), 0, -1) if pairs % d == 0)
            self._packed = np.empty((rows, pairs // rows), np.complex64)

    def heights(self, seed: Seed) -> Array:
        """Return the heights along the line for a seed, read-only, shape (points,) [length]."""
        heights = self.heights_in_any_order(seed)
        if self._in_pairs:  # each pair of points is stored at [j₁, j₂], see the docstring of the module
            ordered = heights.view(np.complex64).reshape(self._packed.shape).T.copy()
            ordered.flags.writeable = False  # an Indenter does not copy read-only heights
            heights = ordered.reshape(-1).view(np.float32)
        return heights

    def heights_in_any_order(self, seed: Seed) -> Array:
        """Return the heights for a seed in unspecified order, read-only, shape (points,) [length].

        The next call of this method or of `heights` may overwrite the returned array.
        """
        key = line_waves.key_of(spectrum.seed_sequence(seed))
        if not self._in_pairs:
            return self._by_real_transform(key)
        packed = self._packed
        mean_square = line_waves.fill_packed_spectrum(packed.reshape(-1), key, self._amplitude, fixed=self._fixed)
        fft.c2c(packed, axes=[0], forward=False, out=packed)
        factor = np.float32(spectrum.scale_factor(self._rms, mean_square))
        line_waves.twiddle(packed.view(np.float32), factor, np.empty((2, packed.shape[1]), np.float32))
        fft.c2c(packed, axes=[1], forward=False, out=packed)
        heights = packed.reshape(-1).view(np.float32)
        heights.flags.writeable = False
        return heights

    def _by_real_transform(self, key: Integers) -> Array:
        points = self._points
        memory_ = np.empty(2 * (points // 2 + 1), self._dtype)
        # The complex coefficients of the waves k = 0, 1, ... share the memory of the heights.
        coefficients = memory_.view(np.result_type(self._dtype, np.complex64))
        mean_square = 0.0
        for start in range(1, len(coefficients), _BLOCK):
            block = coefficients[start : start + _BLOCK]
            amplitude = self._moduli(start, len(block), float)
            block[:] = waves = line_waves.waves(start, key, amplitude, fixed=self._fixed)
            mean_square += 2 * np.vdot(waves, waves).real
        if points % 2 == 0:
            shortest = line_waves.shortest_wave(points, key, amplitude[-1], fixed=self._fixed)
            mean_square += shortest**2 - 2 * abs(waves[-1]) ** 2
            coefficients[-1] = shortest
        # The heights overwrite their spectrum. The spectrum begins with the mean height, 0. Then follow the real and
        # the imaginary part of each wave.
        heights = memory_[1 : points + 1]
        heights[0] = 0
        heights *= spectrum.scale_factor(self._rms, mean_square)
        fft.r2r_fftpack(heights, axes=[0], real2hermitian=False, forward=False, out=heights)
        memory_.flags.writeable = heights.flags.writeable = False
        return heights

    def _moduli(self, first: int, count: int, dtype: DTypeLike = np.float32) -> Array:
        """Return the amplitudes of `count` waves with the numbers first, first + 1, ...

        The amplitude of wave 0 has no meaning.
        """
        return spectrum.amplitude(np.arange(first, first + count, dtype=dtype), self._exponent, *self._roll_off)
