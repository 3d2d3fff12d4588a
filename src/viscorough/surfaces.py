"""Rigid indenters: height maps in general, self-affine discs and lines in particular.

The spectral density is the paper's (Sec. III), C2D(q) ∝ q^(-2(H+1)) for a surface, and by C1D = π q C2D ∝
q^(-(2H+1)) for a line (Eq. 13), which keeps the rms height. Spectra are isotropic, have no zero mode and
reach from the period of the generated piece down to the Nyquist wavelength of two spacings. They need no
prefactor, because every realization is scaled to its rms height.
"""

from numbers import Integral

import numpy as np
from ducc0 import fft

from viscorough import memory
from viscorough.compilation import njit
from viscorough.indenter import Indenter, positive

_BLOCK = 16384  # points of a line worked on at a time: arrays of this length stay in the cache
_BYTES, _COPIES = 100, 2.1  # taken at most per point of a square, and times the heights of a line (measured)


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
    seed,
):
    """Disc of n = `elements_across` elements in diameter, cut from a periodic self-affine square.

    hurst : Hurst exponent H, 0 to 1
    elements_across : n, at least 3; 257 gives 51433 elements
    rms : standard deviation h of the heights, met by every realization [length]
    diameter : L; the spacing is L/n [length]
    period : of the square [L], at least 1, rounded to whole spacings; 1: the disc spans the period, 2: it is
        a piece of a surface of twice that period
    corners : whether to fill the corners of the Fourier square beyond the Nyquist circle q = π/spacing
    roll_off_wavelength : longest wave of the power law [L]; longer ones have its spectral density times
        `roll_off_level` (0: they are absent, 1: a plateau)
    amplitudes : "random": complex Gaussian, so that the heights are a Gaussian process; "fixed": exactly the
        root of the spectrum, only the phases are random
    rms_over : "disc" or "square": the points over which h is taken
    seed : int or numpy SeedSequence; the same seed gives the same realization

    Returns an Indenter with (n, n) heights, nan outside the disc (see `cut_disc`).
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
    if roll_off_wavelength is not None:
        roll_off_wavelength = positive("roll_off_wavelength", roll_off_wavelength) * n
    square = self_affine_square(
        hurst,
        round(period * n),
        corners=corners,
        roll_off_wavelength=roll_off_wavelength,
        roll_off_level=roll_off_level,
        amplitudes=amplitudes,
        seed=seed,
    )
    heights = cut_disc(square, n)
    heights *= rms / np.nanstd(heights) if rms_over == "disc" else rms
    return Indenter(heights, diameter / n)


def self_affine_square(
    hurst, points, *, corners=False, roll_off_wavelength=None, roll_off_level=0.0, amplitudes="random", seed
):
    """Heights of a periodic self-affine square, shape (points, points), of mean 0 and rms 1.

    hurst, corners, roll_off_level, amplitudes, seed : as in `self_affine_disc`
    points : per period, at least 2
    roll_off_wavelength : as in `self_affine_disc`, but in points

    White noise is filtered: its spectrum has the symmetry of real heights also where a wave is its own mirror
    image. Raises ValueError for values outside the allowed ranges.
    """
    points = _whole("points", points, at_least=2)
    memory.require(_BYTES * points**2, f"a surface of {points} x {points} points")
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
    heights *= _factor(1.0, np.mean(heights**2))
    return heights


def cut_disc(square, elements_across):
    """Disc of n = `elements_across` from the corner [:n, :n] of a map of heights; (n, n), nan outside it.

    An element belongs to it if x² + y² <= ((n-1)/2)², x and y from the centre of the piece in spacings.
    Raises ValueError if the map is smaller than that.
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
    seed,
    dtype=np.float32,
):
    """Periodic self-affine line, C1D ∝ q^(-(2H+1)): an indenter for the method of dimensionality reduction.

    hurst, rms, amplitudes, seed : as in `self_affine_disc`
    points : per period, at least 2
    length : L, also the period; the spacing is L/points [length]
    roll_off_wavelength, roll_off_level : as in `self_affine_disc`, in lengths of the line
    dtype : float32 or float64; the realization is the same, its gaps are resolved to 2e-7 h in float32

    Returns an Indenter with (points,) heights of mean 0. Raises ValueError for values outside these ranges.
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
    memory.require(_COPIES * real.itemsize * points, f"a line of {points} points")

    # the spectrum stands where the heights will: the mean, then cosine and sine of wave after wave
    packed = np.empty(1 + 2 * (points // 2), real)
    packed[0] = 0
    waves = packed[1:].reshape(-1, 2)
    words = _generator(seed).bit_generator
    buffers = np.empty((3, min(_BLOCK, len(waves))), real)
    pairs, square = (points - 1) // 2, 0.0  # waves that are not their own mirror image, and the heights' mean square
    for start in range(0, len(waves), _BLOCK):
        piece = waves[start : start + _BLOCK]
        phase, deviate, cosine = buffers[:, : len(piece)]
        _split(words.random_raw(len(piece)), phase, deviate)
        amplitude = _amplitude(np.arange(start + 1, start + 1 + len(piece), dtype=real), exponent, longest, level)
        np.cos(phase, out=cosine)
        sine = np.sin(phase, out=phase)
        if fixed:
            deviate[:] = np.exp(-0.5)  # of which the root below is 1
        square += 2 * _compose(amplitude, np.log(deviate, out=deviate), cosine, sine, piece, pairs - start)
    if points % 2 == 0:  # the shortest wave is its own mirror image: only a cosine, of the same mean power
        cosine, sine = waves[-1]
        waves[-1, 0] = np.copysign(np.hypot(cosine, sine), cosine) if fixed else np.sqrt(2.0) * cosine
        square += float(waves[-1, 0]) ** 2
    packed *= _factor(rms, square)
    heights = packed[:points]
    fft.r2r_fftpack(heights, axes=[0], real2hermitian=False, forward=False, out=heights)
    return Indenter(heights, length / points)


@njit
def _split(words, phase, deviate):
    """Phases in [0, 2π) from the lower, and numbers in (0, 1) from the upper halves of random words."""
    for i in range(words.size):
        phase[i] = (words[i] & 0xFFFFFFFF) * (2 * np.pi / 2**32)
        deviate[i] = ((words[i] >> np.uint64(32)) + 0.5) * 2.0**-32


@njit(fastmath=True)
def _compose(amplitude, logarithm, cosine, sine, waves, pairs):
    """Cosine and sine of every wave, of modulus amplitude·√(-2 ln(0...1)): with a random phase, a complex Gaussian (Box
    and Muller). Returns the sum of the squares of the first `pairs` moduli.
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
    """Modulus k^-exponent of the waves of k per period; √level times that of k = longest for longer ones.

    The zero mode gets a number, too, for the caller to remove.
    """
    amplitude = np.maximum(wavenumber, max(1, longest))
    np.power(amplitude, -exponent, out=amplitude)
    if longest > 1:
        amplitude[wavenumber < longest] *= np.sqrt(level)
    return amplitude


def _roll_off(wavelength, level, points):
    """Wavenumber per period and level of the roll-off at a wavelength in points; 0 if there is none."""
    if not 0 <= level < np.inf:
        raise ValueError(f"roll_off_level: must be a finite number >= 0, not {level!r}")
    if wavelength is None:
        return 0.0, level
    rounding = 1 - 1e-12  # must not take away the waves of just that length
    return rounding * points / positive("roll_off_wavelength", wavelength), level


def _factor(rms, square):
    """What heights of mean 0 and the mean square `square` are to be multiplied with."""
    if square == 0:
        raise ValueError("roll_off_wavelength: must leave at least one wave of two spacings or more")
    return rms / np.sqrt(square)


def _generator(seed):
    """Random numbers by SFC64, the fastest of numpy's generators."""
    known = isinstance(seed, np.random.SeedSequence)
    return np.random.Generator(np.random.SFC64(seed if known else _whole("seed", seed, at_least=0)))


def _hurst(hurst):
    if not 0 <= hurst <= 1:
        raise ValueError(f"hurst: must be from 0 to 1, not {hurst!r}")
    return float(hurst)


def _fixed(amplitudes):
    if amplitudes not in ("random", "fixed"):
        raise ValueError(f"amplitudes: must be 'random' or 'fixed', not {amplitudes!r}")
    return amplitudes == "fixed"


def _whole(name, value, at_least):
    if not isinstance(value, Integral) or value < at_least:
        raise ValueError(f"{name}: must be a whole number of at least {at_least}, not {value!r}")
    return int(value)
