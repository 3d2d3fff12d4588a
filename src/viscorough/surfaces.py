"""Self-affine discs, squares and lines with random heights.

The power spectral density is the paper's (Sec. III): C2D(q) ∝ q^(-2(H+1)) for a surface, and from C1D = π q C2D,
which keeps the rms height, C1D(q) ∝ q^(-(2H+1)) for a line (Eq. 13). Spectra are isotropic, have no zero mode and reach
from the period of the surface down to the Nyquist wavelength of two spacings. They need no prefactor, because every
realization is scaled to the requested rms height.
"""

from functools import partial
from numbers import Integral

import numpy as np
from ducc0 import fft

from viscorough import memory
from viscorough.compilation import njit
from viscorough.indenter import Indenter, positive

_BLOCK = 16384  # waves of a line computed at a time: arrays of this length stay in the processor's cache
# Memory that must be available: for a square, bytes per point, three times what its arrays take; for a line, multiples
# of its heights, since the Fourier transform copies them. If the number n of points has prime factors above 11, more is
# needed, and still more in proportion to p/n for the largest factor p (tests/viscorough/test_memory.py).
_BYTES_PER_POINT, _COPIES_OF_LINE = 100, 2.6
_COPIES_OF_OTHER_LINE, _MORE_PER_SHARE, _MOST_COPIES = 3.3, 28, 17


def self_affine_disc(
    hurst,
    elements_across=257,
    *,
    rms=1.0,
    diameter=1.0,
    period=1.0,
    corners=False,
    roll_off_wavelength=None,
    roll_off_level=0.0,
    amplitudes="random",
    rms_over="disc",
    length_unit="1",
    seed,
):
    """Disc with n = `elements_across` elements across its diameter, cut from a periodic self-affine square.

    hurst : Hurst exponent H, 0 to 1
    elements_across : n, at least 3; 257 gives 51433 elements
    rms : standard deviation h of the heights, exact in every realization [length]
    diameter : L; the spacing is L/n [length]
    period : of the square in diameters, at least 1, rounded to whole spacings; with 1 the disc spans the period, with
        2 it is cut from a surface that repeats after two diameters
    corners : whether waves in the corners of the Fourier square, beyond the Nyquist circle q = π/spacing, are present
    roll_off_wavelength : longest wavelength of the power law, in diameters; longer waves have the spectral density at
        this wavelength times `roll_off_level` (0: they are absent, 1: a plateau)
    amplitudes : "random": complex Gaussian, so that the heights are a Gaussian process; "fixed": exactly the
        square root of the spectrum, so that only the phases are random
    rms_over : "disc" or "square": the points over which h is taken
    length_unit : of rms and diameter, as in Indenter
    seed : int or numpy SeedSequence; the same seed gives the same realization

    Returns an Indenter with heights of shape (n, n), nan outside the disc (see `cut_disc`).
    Raises ValueError for values outside these ranges.
    """
    n = _whole("elements_across", elements_across, at_least=3)
    rms, diameter, period = (
        positive("rms", rms),
        positive("diameter", diameter),
        positive("period", period),
    )
    if period < 1:
        raise ValueError(f"period: must be at least 1 diameter, not {period}")
    if rms_over not in ("disc", "square"):
        raise ValueError(f"rms_over: must be 'disc' or 'square', not {rms_over!r}")
    square = square_of_disc(
        hurst,
        n,
        period=period,
        corners=corners,
        roll_off_wavelength=roll_off_wavelength,
        roll_off_level=roll_off_level,
        amplitudes=amplitudes,
        seed=seed,
    )
    heights = cut_disc(square, n)
    heights *= rms / np.nanstd(heights) if rms_over == "disc" else rms
    return Indenter(heights, diameter / n, length_unit=length_unit)


def square_of_disc(hurst, elements_across, *, period=1.0, roll_off_wavelength=None, **options):
    """Heights of the periodic square that a disc is cut from, shape (points, points); see `self_affine_square`.

    hurst, elements_across, period, roll_off_wavelength : as in `self_affine_disc`; options : of `self_affine_square`
    """
    if roll_off_wavelength is not None:
        roll_off_wavelength = positive("roll_off_wavelength", roll_off_wavelength) * elements_across
    return self_affine_square(
        hurst, round(period * elements_across), roll_off_wavelength=roll_off_wavelength, **options
    )


def self_affine_square(
    hurst,
    points,
    *,
    corners=False,
    roll_off_wavelength=None,
    roll_off_level=0.0,
    amplitudes="random",
    normalised=True,
    seed,
):
    """Heights of a periodic self-affine square, shape (points, points), of mean 0.

    hurst, corners, roll_off_level, amplitudes, seed : as in `self_affine_disc`
    points : number of points per period, at least 2
    roll_off_wavelength : as in `self_affine_disc`, but in points
    normalised : whether the rms height is 1 in every realization; otherwise the spectrum is the same in every
        realization, and the mean over all of them of the mean square height is 1

    White noise is filtered: its spectrum has the symmetry of real heights, also where a wave is its own mirror
    image. Raises ValueError for values outside the allowed ranges.
    """
    points = _whole("points", points, at_least=2)
    memory.require(_BYTES_PER_POINT * points**2, f"a surface of {points} x {points} points")
    exponent = _hurst(hurst) + 1
    longest, level = _roll_off(roll_off_wavelength, roll_off_level, points)
    fixed = _fixed(amplitudes)

    wavenumber = np.hypot(np.fft.fftfreq(points, 1 / points)[:, None], np.arange(points // 2 + 1))
    amplitude = _amplitude(wavenumber, exponent, longest, level)
    amplitude[0, 0] = 0
    if not corners:
        amplitude[wavenumber > points / 2] = 0
    spectrum = fft.r2c(_generator(seed).standard_normal((points, points)))
    if fixed:
        spectrum /= np.abs(spectrum)
    spectrum *= amplitude
    heights = fft.c2r(spectrum, lastsize=points, forward=False, allow_overwriting_input=True)
    mean_square = np.mean(heights**2) if normalised else _expected_mean_square(amplitude, points, fixed=fixed)
    heights *= _scale_factor(1.0, mean_square)
    return heights


def _expected_mean_square(amplitude, points, *, fixed):
    """Mean square height that filtered white noise has on average over all realizations (Parseval's theorem).

    amplitude : modulus of the filter at the waves of a real Fourier transform; all but those of the first and, of an
        even number of points, the last column stand for their mirror images, too
    """
    square = amplitude**2
    once = square[:, 0].sum() + (square[:, -1].sum() if points % 2 == 0 else 0.0)
    return (2 * square.sum() - once) * (1 if fixed else points**2)


def cut_disc(square, elements_across):
    """Disc cut from the corner [:n, :n] of a map of heights, n = `elements_across`; shape (n, n), nan outside.

    An element belongs to the disc if x² + y² <= ((n-1)/2)², with x and y from the centre of the disc in spacings.
    Raises ValueError if the map has fewer than n x n points.
    """
    n = _whole("elements_across", elements_across, at_least=1)
    if square.ndim != 2 or min(square.shape) < n:
        raise ValueError(f"cut_disc: the map must have at least {n} x {n} points, its shape is {square.shape}")
    twice = 2 * np.arange(n) - (n - 1)  # twice the distance from the centre: whole numbers for odd and even n
    return np.where(twice[:, None] ** 2 + twice**2 <= (n - 1) ** 2, square[:n, :n], np.nan)


def self_affine_line(
    hurst,
    points,
    *,
    rms=1.0,
    length=1.0,
    roll_off_wavelength=None,
    roll_off_level=0.0,
    amplitudes="random",
    length_unit="1",
    seed,
    dtype=np.float32,
):
    """Periodic self-affine line, C1D ∝ q^(-(2H+1)): an indenter for the method of reduction of dimensionality (MDR).

    hurst, rms, amplitudes, seed : as in `self_affine_disc`
    points : number of points per period, at least 2
    length : L, which is also the period; the spacing is L/points [length]
    roll_off_wavelength, roll_off_level : as in `self_affine_disc`, but the wavelength in units of the length
    length_unit : of rms and length, as in Indenter
    dtype : float32 or float64; the realization is the same up to rounding

    Returns an Indenter with heights of shape (points,) and mean 0. Raises ValueError for values outside these ranges.
    """
    points = _whole("points", points, at_least=2)
    exponent = _hurst(hurst) + 0.5
    rms, length = positive("rms", rms), positive("length", length)
    if roll_off_wavelength is not None:
        roll_off_wavelength = positive("roll_off_wavelength", roll_off_wavelength) * points
    longest, level = _roll_off(roll_off_wavelength, roll_off_level, points)
    fixed = _fixed(amplitudes)
    if (real := np.dtype(dtype)) not in (np.float32, np.float64):
        raise ValueError(f"dtype: must be float32 or float64, not {real}")
    memory.require(_copies_of_line(points) * real.itemsize * points, f"a line of {points} points")

    # The heights overwrite their spectrum: the mean, then cosine and sine coefficients of wave after wave.
    packed = np.empty(1 + 2 * (points // 2), real)
    packed[0] = 0
    amplitude = partial(_amplitude, exponent=exponent, longest=longest, level=level)
    mean_square = _draw_waves(packed[1:].reshape(-1, 2), points, amplitude, _generator(seed), fixed=fixed)
    packed *= _scale_factor(rms, mean_square)
    heights = packed[:points]
    fft.r2r_fftpack(heights, axes=[0], real2hermitian=False, forward=False, out=heights)
    packed.flags.writeable = heights.flags.writeable = False  # so that the indenter need not copy them
    return Indenter(heights, length / points, length_unit=length_unit)


def _draw_waves(waves, points, amplitude, generator, *, fixed, block=_BLOCK):
    """Fill `waves` with random cosine and sine coefficients; returns the mean square of the heights they make.

    waves : shape (points // 2, 2), of 1, 2, ... waves per period
    amplitude : function of an array of wavenumbers that gives the moduli
    fixed : whether moduli are exactly those of `amplitude`, not random
    block : number of waves computed at a time
    """
    random = generator.bit_generator
    buffers = np.empty((3, min(block, len(waves))), waves.dtype)
    pairs, mean_square = (points - 1) // 2, 0.0  # waves that are not their own mirror image
    for start in range(0, len(waves), block):
        piece = waves[start : start + block]
        phase, uniform, cosine = buffers[:, : len(piece)]
        _phases_and_uniforms(random.random_raw(len(piece)), phase, uniform)
        modulus = amplitude(np.arange(start + 1, start + 1 + len(piece), dtype=waves.dtype))
        np.cos(phase, out=cosine)
        sine = np.sin(phase, out=phase)
        if fixed:
            uniform[:] = np.exp(-0.5)  # for which √(-2 ln) is 1
        logarithm = np.log(uniform, out=uniform)
        mean_square += 2 * _coefficients(modulus, logarithm, cosine, sine, piece, pairs - start)
    if points % 2 == 0:  # the shortest wave is its own mirror image: only a cosine, of the same mean power
        cosine, sine = waves[-1]
        waves[-1, 0] = np.copysign(np.hypot(cosine, sine), cosine) if fixed else np.sqrt(2.0) * cosine
        mean_square += float(waves[-1, 0]) ** 2
    return mean_square


@njit
def _phases_and_uniforms(integers, phase, uniform):
    """Store phases in [0, 2π) from the lower and numbers in (0, 1) from the upper halves of random 64-bit integers."""
    for i in range(integers.size):
        phase[i] = (integers[i] & 0xFFFFFFFF) * (2 * np.pi / 2**32)
        uniform[i] = ((integers[i] >> np.uint64(32)) + 0.5) * 2.0**-32


@njit(fastmath=True)
def _coefficients(amplitude, logarithm, cosine, sine, waves, pairs):
    """Fill `waves` with the cosine and sine coefficients of waves with the modulus amplitude·√(-2 ln(uniform)).

    With a random phase they are complex Gaussian (Box and Muller). Returns the sum of the squares of the first `pairs`
    moduli; `amplitude` is overwritten by the moduli.
    """
    square = 0.0
    for i in range(amplitude.size):
        amplitude[i] *= np.sqrt(-(logarithm[i] + logarithm[i]))  # a factor 2 would make it double precision
        waves[i, 0] = amplitude[i] * cosine[i]
        waves[i, 1] = amplitude[i] * sine[i]
    for i in range(min(pairs, amplitude.size)):
        square += amplitude[i] * amplitude[i]
    return square


def _amplitude(wavenumber, exponent, longest, level):
    """Modulus k^-exponent of waves with wavenumber k per period; for k < longest √level times that of k = longest.

    longest : wavenumber per period of the roll-off, 0 if there is none
    level : spectral density of longer waves relative to that at the roll-off

    The zero mode gets a finite value, which the caller must remove.
    """
    amplitude = np.maximum(wavenumber, max(1, longest))
    np.power(amplitude, -exponent, out=amplitude)
    if longest > 1:
        amplitude[wavenumber < longest] *= np.sqrt(level)
    return amplitude


def _roll_off(wavelength, level, points):
    """Wavenumber per period (0 if there is no roll-off) and level of the roll-off at a wavelength in points."""
    if not 0 <= level < np.inf:
        raise ValueError(f"roll_off_level: must be a finite number >= 0, not {level!r}")
    if wavelength is None:
        return 0.0, level
    rounding = 1 - 1e-12  # so that waves of exactly this length belong to the power law
    return rounding * points / positive("roll_off_wavelength", wavelength), level


def _scale_factor(rms, mean_square):
    """Scale factor to the requested rms height."""
    if mean_square == 0:
        raise ValueError("roll_off_wavelength: must leave at least one wave of two spacings or more")
    return rms / np.sqrt(mean_square)


def _generator(seed):
    """Random numbers from SFC64, the fastest of numpy's generators."""
    is_sequence = isinstance(seed, np.random.SeedSequence)
    return np.random.Generator(np.random.SFC64(seed if is_sequence else _whole("seed", seed, at_least=0)))


def _hurst(hurst):
    if not 0 <= hurst <= 1:
        raise ValueError(f"hurst: must be from 0 to 1, not {hurst!r}")
    return float(hurst)


def _fixed(amplitudes):
    if amplitudes not in ("random", "fixed"):
        raise ValueError(f"amplitudes: must be 'random' or 'fixed', not {amplitudes!r}")
    return amplitudes == "fixed"


def _copies_of_line(points):
    """Memory for the generation of a line of that many points, over that of its heights."""
    if fft.good_size(points, True) == points:
        return _COPIES_OF_LINE
    left, factor = points, 2
    while factor * factor <= left:
        if left % factor:
            factor += 1
        else:
            left //= factor
    return min(_COPIES_OF_OTHER_LINE + _MORE_PER_SHARE * left / points, _MOST_COPIES)


def _whole(name, value, at_least):
    if not isinstance(value, Integral) or value < at_least:
        raise ValueError(f"{name}: must be a whole number of at least {at_least}, not {value!r}")
    return int(value)
