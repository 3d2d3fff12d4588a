"""Generate self-affine discs and squares with random heights.

The power spectral density follows the paper (Sec. III). For a surface with the Hurst exponent H, the density at the
wavenumber q is C2D(q) ∝ q^(-2(H+1)). Spectra are isotropic and have no zero mode. Wavelengths range from the period of
the surface down to two spacings, the Nyquist wavelength. The spectra need no prefactor, because every realization is
scaled to the requested rms height.
"""

from typing import Any

import numpy as np
from ducc0 import fft

from viscorough.basics import memory
from viscorough.basics.arrays import positive, real_numbers, whole_number
from viscorough.basics.types import Array, Seed
from viscorough.surfaces import spectrum
from viscorough.surfaces.indenter import Indenter

# Memory in bytes that must be available for each point of a square. It is three times the memory of all arrays.
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
    """Generate a disc with random heights, cut from a periodic self-affine square.

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
        Period of the square as a multiple of the diameter, at least 1, rounded to whole spacings. For 1, the square is
        as wide as the disc. For 2, the disc is cut from a surface that repeats after two diameters.
    corners : bool, optional
        True to include waves in the corners of the square of wave vectors, whose wavenumber exceeds the Nyquist
        wavenumber q = π/spacing.
    roll_off_wavelength : float, optional
        Longest wavelength of the power law, as a multiple of the diameter; by default all waves follow the power law.
    roll_off_level : float, optional
        Spectral density of waves longer than the roll-off wavelength, relative to the density at the roll-off
        wavelength. 0: there are no longer waves; 1: all longer waves have this density.
    amplitudes : str, optional
        "random" for complex Gaussian amplitudes, so that the heights are a Gaussian process. "fixed" for amplitudes
        equal to the square root of the spectrum, so that only the phases are random.
    rms_over : str, optional
        Set of points whose heights have the standard deviation h: the "disc" or the whole "square".
    length_unit : str, optional
        "m" if numbers are in SI units, "1" if they are in consistent units that are not known, the default.
    seed : int or SeedSequence
        Seed of the random numbers. The same seed gives the same realization.

    Returns
    -------
    Indenter
        Map of shape (n, n), nan outside the disc (see `viscorough.surfaces.self_affine.cut_disc`).

    Raises
    ------
    ValueError
        For values out of range.

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
    """Return the heights of the periodic square that a disc is cut from, shape (points, points).

    hurst, elements_across, period, roll_off_wavelength : arguments of `self_affine_disc`
    options : further arguments of `self_affine_square`, by name
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

    The heights are white noise whose waves are multiplied by the amplitudes of the spectrum. Since white noise is real,
    its waves have the symmetry that real heights require.

    points : number of points per period, at least 2
    normalised : True to scale every realization to an rms height of 1. False to scale all realizations by the same
        factor, so that the mean square height is 1 on average over all realizations
    hurst, corners, seed : arguments of `self_affine_disc`
    waves : further arguments of `self_affine_disc`, by name: roll_off_wavelength (here as a number of spacings),
        roll_off_level and amplitudes

    Raises ValueError for values out of range.
    """
    points = whole_number("points", points, at_least=2)
    memory.require(_BYTES_PER_POINT * points**2, f"a surface of {points} x {points} points")
    exponent = spectrum.hurst_exponent(hurst) + 1
    longest, density, fixed = spectrum.wave_options(period=points, **waves)

    wavenumber = np.hypot(np.fft.fftfreq(points, 1 / points)[:, None], np.arange(points // 2 + 1))
    amplitude = spectrum.amplitude(wavenumber, exponent, longest, density)
    amplitude[0, 0] = 0
    if not corners:
        amplitude[wavenumber > points / 2] = 0
    random = np.random.Generator(np.random.SFC64(spectrum.seed_sequence(seed)))  # SFC64 is numpy's fastest generator
    noise = fft.r2c(random.standard_normal((points, points)))
    if fixed:
        noise /= np.abs(noise)
    noise *= amplitude
    heights = fft.c2r(noise, lastsize=points, forward=False, allow_overwriting_input=True)
    mean_square = np.mean(heights**2) if normalised else _expected_mean_square(amplitude, points, fixed=fixed)
    heights *= spectrum.scale_factor(1.0, mean_square)
    return heights


def _expected_mean_square(amplitude: Array, points: int, *, fixed: bool) -> float:
    """Return the mean square height of a square, averaged over all realizations, from Parseval's theorem.

    amplitude : factors by which waves of white noise are multiplied, in the layout of a real Fourier transform. Two
        waves with opposite wave vectors have the same factor. The array contains both factors in the first column and,
        for an even number of points, in the last column; in all other columns it contains only one of them
    points : number of points per period
    fixed : True if the waves of the noise have the modulus 1, False if the noise at each point has the variance 1
    """
    square = amplitude**2
    once = square[:, 0].sum() + (square[:, -1].sum() if points % 2 == 0 else 0.0)
    return (2 * square.sum() - once) * (1 if fixed else points**2)


def cut_disc(square: Array, elements_across: int) -> Array:
    """Cut a disc with n = `elements_across` elements across from the corner [:n, :n] of a map of heights.

    An element belongs to the disc if x² + y² <= ((n-1)/2)², where x and y are its coordinates from the centre of the
    disc, in units of the spacing.

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
    twice = 2 * np.arange(n) - (n - 1)  # twice the coordinate from the centre, a whole number for any n
    return np.where(twice[:, None] ** 2 + twice**2 <= (n - 1) ** 2, square[:n, :n], np.nan)
