"""Generate self-affine discs, squares and lines with random heights.

The power spectral density is the paper's (Sec. III): C2D(q) ∝ q^(-2(H+1)) for a surface, and from C1D = π q C2D,
which keeps the rms height, C1D(q) ∝ q^(-(2H+1)) for a line (Eq. 13). Spectra are isotropic, have no zero mode and reach
from the period of the surface down to the Nyquist wavelength of two spacings. They need no prefactor, because every
realization is scaled to the requested rms height.
"""

from typing import Any

import numpy as np
from ducc0 import fft

from viscorough.basics import memory
from viscorough.basics.arrays import positive, real_numbers, whole_number
from viscorough.basics.types import Array, FloatType, Seed
from viscorough.surfaces import spectrum
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.lines import SelfAffineLines

# Memory that must be available for a square, three times the size of its arrays.
_BYTES_PER_POINT = 100


def self_affine_disc(
    hurst: float,
    elements_across: int = 257,
    *,
    rms: float = 1.0,
    diameter: float = 1.0,
    period: float = 1.0,
    corners: bool = False,
    roll_off_wavelength: float | None = None,
    roll_off_level: float = 0.0,
    amplitudes: str = "random",
    rms_over: str = "disc",
    length_unit: str = "1",
    seed: Seed,
) -> Indenter:
    """Generate a disc with n = `elements_across` elements across its diameter, cut from a periodic self-affine square.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from 0 to 1 [1].
    elements_across : int, optional
        Number n of elements across the diameter, at least 3; 257 gives 51433 elements.
    rms : float, optional
        Standard deviation h of the heights, exact in every realization [length].
    diameter : float, optional
        Diameter L [length]; the spacing is L/n.
    period : float, optional
        Period of the square in diameters, at least 1, rounded to whole spacings. With 1 the disc spans the period, with
        2 it is cut from a surface that repeats after two diameters.
    corners : bool, optional
        True to include waves in the corners of the Fourier square, beyond the Nyquist circle q = π/spacing.
    roll_off_wavelength : float, optional
        Longest wavelength of the power law, in diameters; by default all waves follow the power law.
    roll_off_level : float, optional
        Spectral density of longer waves, relative to the density at this wavelength (0: no longer waves, 1: plateau).
    amplitudes : str, optional
        "random" for complex Gaussian amplitudes, so that the heights are a Gaussian process; "fixed" for the square
        root of the spectrum, so that only the phases are random.
    rms_over : str, optional
        "disc" or "square": set of points whose standard deviation is h.
    length_unit : str, optional
        Unit of rms and diameter, such as "um"; by default it is not known.
    seed : int or SeedSequence
        Seed of the random numbers. The same seed gives the same realization.

    Returns
    -------
    Indenter
        Map of shape (n, n), nan outside the disc (see `viscorough.surfaces.self_affine.cut_disc`).

    Raises
    ------
    ValueError
        For values outside these ranges.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 33, rms=0.1, diameter=2.0, seed=1)
    >>> disc.heights.shape, round(disc.spacing, 4)
    ((33, 33), 0.0606)
    """
    n = whole_number("elements_across", elements_across, at_least=3)
    rms, diameter, period = positive("rms", rms), positive("diameter", diameter), positive("period", period)
    if period < 1:
        raise ValueError(f"period: must be at least 1 diameter, not {period}")
    if rms_over not in ("disc", "square"):
        raise ValueError(f"rms_over: must be 'disc' or 'square', not {rms_over!r}")
    roll_off: dict[str, Any] = {"roll_off_wavelength": roll_off_wavelength, "roll_off_level": roll_off_level}
    square = square_of_disc(hurst, n, period=period, corners=corners, amplitudes=amplitudes, seed=seed, **roll_off)
    heights = cut_disc(square, n)
    heights *= rms / np.nanstd(heights) if rms_over == "disc" else rms
    return Indenter(heights, diameter / n, length_unit=length_unit)


def square_of_disc(
    hurst: float, elements_across: int, *, period: float = 1.0, roll_off_wavelength: float | None = None, **options: Any
) -> Array:
    """Return the heights of the periodic square that contains a disc, shape (points, points).

    hurst, elements_across, period, roll_off_wavelength : arguments of `self_affine_disc`
    options : further arguments of `self_affine_square`
    """
    if roll_off_wavelength is not None:
        roll_off_wavelength = positive("roll_off_wavelength", roll_off_wavelength) * elements_across
    return self_affine_square(
        hurst, round(period * elements_across), roll_off_wavelength=roll_off_wavelength, **options
    )


def self_affine_square(
    hurst: float,
    points: int,
    *,
    corners: bool = False,
    normalised: bool = True,
    seed: Seed,
    **waves: Any,
) -> Array:
    """Generate the heights of a periodic self-affine square, shape (points, points), with mean 0.

    White noise is filtered, since its spectrum has the symmetry of real heights, also for waves that equal their mirror
    images.

    points : number of points per period, at least 2
    normalised : True for an rms height of 1 in every realization. False for the same spectrum in every realization; the
        mean square height is then 1 on average over all realizations
    hurst, corners, seed : arguments of `self_affine_disc`
    waves : its arguments roll_off_wavelength (here in points), roll_off_level and amplitudes

    Raises ValueError for values outside the allowed ranges.
    """
    points = whole_number("points", points, at_least=2)
    memory.require(_BYTES_PER_POINT * points**2, f"a surface of {points} x {points} points")
    exponent = spectrum.hurst_exponent(hurst) + 1
    longest, level, fixed = spectrum.wave_options(period=points, **waves)

    wavenumber = np.hypot(np.fft.fftfreq(points, 1 / points)[:, None], np.arange(points // 2 + 1))
    amplitude = spectrum.amplitude(wavenumber, exponent, longest, level)
    amplitude[0, 0] = 0
    if not corners:
        amplitude[wavenumber > points / 2] = 0
    random = np.random.Generator(np.random.SFC64(spectrum.seed_sequence(seed)))  # the fastest of numpy's generators
    noise = fft.r2c(random.standard_normal((points, points)))
    if fixed:
        noise /= np.abs(noise)
    noise *= amplitude
    heights = fft.c2r(noise, lastsize=points, forward=False, allow_overwriting_input=True)
    mean_square = np.mean(heights**2) if normalised else _expected_mean_square(amplitude, points, fixed=fixed)
    heights *= spectrum.scale_factor(1.0, mean_square)
    return heights


def _expected_mean_square(amplitude: Array, points: int, *, fixed: bool) -> float:
    """Return the mean square height of filtered white noise on average over all realizations (Parseval's theorem).

    amplitude : modulus of the filter at the waves of a real Fourier transform. Each wave represents its mirror image,
        too, except in the first column and, for an even number of points, in the last column
    """
    square = amplitude**2
    once = square[:, 0].sum() + (square[:, -1].sum() if points % 2 == 0 else 0.0)
    return (2 * square.sum() - once) * (1 if fixed else points**2)


def cut_disc(square: Array, elements_across: int) -> Array:
    """Cut a disc from the corner [:n, :n] of a map of heights, with n = `elements_across`.

    An element belongs to the disc if x² + y² <= ((n-1)/2)², with x and y from the centre of the disc in spacings.

    Parameters
    ----------
    square : array
        Heights of the map, shape (m, m) [length].
    elements_across : int
        Number n of elements across the disc, at most m.

    Returns
    -------
    array
        Copy of the heights, nan outside the disc, shape (n, n) [length].

    Raises
    ------
    ValueError
        If the map has fewer than n x n points.

    Examples
    --------
    >>> import numpy as np
    >>> from viscorough.surfaces.self_affine import cut_disc
    >>> int(np.isfinite(cut_disc(np.zeros((5, 5)), 5)).sum())
    13
    """
    n, square = whole_number("elements_across", elements_across, at_least=1), real_numbers("cut_disc: square", square)
    if square.ndim != 2 or min(square.shape) < n:
        raise ValueError(f"square: the map must have at least {n} x {n} points, its shape is {square.shape}")
    twice = 2 * np.arange(n) - (n - 1)  # twice the distance from the centre: whole numbers for odd and even n
    return np.where(twice[:, None] ** 2 + twice**2 <= (n - 1) ** 2, square[:n, :n], np.nan)


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
    dtype: FloatType = np.float32,
) -> Indenter:
    """Generate a periodic self-affine line, C1D ∝ q^(-(2H+1)), for the method of dimensionality reduction (MDR).

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
        Longest wavelength of the power law, in units of L; by default all waves follow the power law.
    roll_off_level : float, optional
        Spectral density of longer waves, relative to the density at this wavelength (0: no longer waves, 1: plateau).
    amplitudes : str, optional
        "random" for complex Gaussian amplitudes, "fixed" for the square root of the spectrum.
    length_unit : str, optional
        Unit of rms and length, such as "um"; by default it is not known.
    seed : int or SeedSequence
        Seed of the random numbers. The same seed gives the same realization.
    dtype : numpy dtype or name, optional
        Floating-point type, float32 or float64; the realization is the same up to rounding.

    Returns
    -------
    Indenter
        Line of shape (points,) with mean 0.

    Raises
    ------
    ValueError
        For values outside these ranges.

    Examples
    --------
    >>> import viscorough
    >>> viscorough.self_affine_line(0.7, 1000, rms=0.1, seed=1).heights.shape
    (1000,)
    """
    roll_off: dict[str, Any] = {"roll_off_wavelength": roll_off_wavelength, "roll_off_level": roll_off_level}
    lines = SelfAffineLines(hurst, points, rms=rms, length=length, amplitudes=amplitudes, dtype=dtype, **roll_off)
    return Indenter(lines.heights(seed), lines.spacing, length_unit=length_unit)
