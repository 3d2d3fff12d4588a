"""Compute the power-law spectrum of self-affine surfaces and lines, and check the arguments that describe it."""

from typing import Any

import numpy as np

from viscorough.basics.arrays import positive, real_number, whole_number
from viscorough.basics.types import Array, Seed


def amplitude(wavenumber: Array, exponent: float, longest: float, density: float) -> Array:
    """Return the amplitude of waves with k periods per period of the surface, without a prefactor.

    The amplitude is k^-exponent for k >= k₀, and √d · k₀^-exponent for k < k₀, where k₀ is the wavenumber of the
    roll-off and d the density. For k = 0 it is finite, so the caller must set it to zero.

    wavenumber : numbers k
    exponent : half the exponent of the power spectral density
    longest : k₀, or 0 without a roll-off
    density : spectral density of waves with k < k₀, relative to the spectral density at k₀
    """
    modulus = np.maximum(wavenumber, max(1, longest))
    np.power(modulus, -exponent, out=modulus)
    if longest > 1:
        modulus[wavenumber < longest] *= np.sqrt(density)
    return modulus


def wave_options(
    *, period: float, roll_off_wavelength: float | None = None, roll_off_level: float = 0.0, amplitudes: str = "random"
) -> tuple[float, float, bool]:
    """Check the arguments of `self_affine.self_affine_disc` that describe the roll-off and the amplitudes of waves.

    period : period of the surface, in the unit of `roll_off_wavelength`

    Returns (longest, density, fixed): two arguments of the function `amplitude`, and True if only the phases of the
    waves are random.

    Raises ValueError for values out of range.
    """
    if amplitudes not in ("random", "fixed"):
        raise ValueError(f"amplitudes: must be 'random' or 'fixed', not {amplitudes!r}")
    return *_roll_off(roll_off_wavelength, roll_off_level, period), amplitudes == "fixed"


def _roll_off(wavelength: float | None, density: float, period: float) -> tuple[float, float]:
    """Return period/wavelength of the roll-off (0 without a roll-off), and the checked density.

    wavelength : wavelength of the roll-off, or None without a roll-off
    density : spectral density of longer waves, relative to the spectral density at the roll-off
    period : period of the surface, in the same unit as the wavelength
    """
    density = real_number("roll_off_level", density)
    if density < 0:
        raise ValueError(f"roll_off_level: must be a finite number >= 0, not {density!r}")
    if wavelength is None:
        return 0.0, density
    # Due to this factor, waves of exactly the roll-off wavelength belong to the power law in spite of rounding.
    rounding = 1 - 1e-12
    return rounding * period / positive("argument roll_off_wavelength", wavelength), density


def scale_factor(rms: float, mean_square: Any) -> float:
    """Return the factor that scales heights of a given mean square to the requested rms height."""
    if mean_square == 0:
        raise ValueError("argument roll_off_wavelength: must leave at least one wave of two spacings or more")
    return rms / np.sqrt(mean_square)


def seed_sequence(seed: Seed) -> np.random.SeedSequence:
    """Return the SeedSequence for a seed: a whole number, several whole numbers, or a SeedSequence itself."""
    if isinstance(seed, np.random.SeedSequence):
        return seed
    parts = seed if isinstance(seed, list | tuple) and seed else [seed]
    return np.random.SeedSequence([whole_number("seed", part, at_least=0, at_most=np.inf) for part in parts])


def hurst_exponent(hurst: float) -> float:
    """Return the Hurst exponent as a float. Raises ValueError unless it is from 0 to 1."""
    hurst = real_number("hurst", hurst)
    if not 0 <= hurst <= 1:
        raise ValueError(f"hurst: must be from 0 to 1, not {hurst!r}")
    return hurst
