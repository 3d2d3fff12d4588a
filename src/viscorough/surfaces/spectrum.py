"""Compute the power-law spectrum of self-affine surfaces and lines, and check the arguments that describe it."""

from typing import Any

import numpy as np

from viscorough.basics.argument_names import spelled
from viscorough.basics.arrays import positive, real_number, whole_number
from viscorough.basics.types import Array, Seed


def amplitude(wavenumber: Array, exponent: float, longest: float, level: float) -> Array:
    """Return the moduli of waves: k^-exponent, and √level longest^-exponent for k < longest.

    wavenumber : wavenumbers k per period
    longest : wavenumber per period of the roll-off, 0 without a roll-off
    level : spectral density of longer waves, relative to the spectral density at the roll-off

    The zero mode gets a finite value, which the caller must remove.
    """
    modulus = np.maximum(wavenumber, max(1, longest))
    np.power(modulus, -exponent, out=modulus)
    if longest > 1:
        modulus[wavenumber < longest] *= np.sqrt(level)
    return modulus


def wave_options(
    *, period: float, roll_off_wavelength: float | None = None, roll_off_level: float = 0.0, amplitudes: str = "random"
) -> tuple[float, float, bool]:
    """Check the options of `surfaces.self_affine_disc` for its waves.

    period : period in the unit of the wavelength

    Returns (wavenumber of the roll-off per period, 0 without a roll-off; its level; True if only phases are random).
    Raises ValueError for values out of range.
    """
    if amplitudes not in ("random", "fixed"):
        raise ValueError(f"amplitudes: must be 'random' or 'fixed', not {amplitudes!r}")
    return *_roll_off(roll_off_wavelength, roll_off_level, period), amplitudes == "fixed"


def _roll_off(wavelength: float | None, level: float, period: float) -> tuple[float, float]:
    """Return wavenumber per period and level of the roll-off; the wavenumber is 0 without a roll-off.

    wavelength, period : wavelength of the roll-off (None without one) and period, in one unit of length
    level : spectral density of longer waves, relative to the spectral density at the roll-off
    """
    level = real_number("roll_off_level", level)
    if level < 0:
        raise ValueError(f"roll_off_level: must be a finite number >= 0, not {level!r}")
    if wavelength is None:
        return 0.0, level
    rounding = 1 - 1e-12  # so that waves of exactly this length belong to the power law
    return rounding * period / positive(_name_of_wavelength(), wavelength), level


def _name_of_wavelength() -> str:
    return spelled("--roll-off", "roll_off_wavelength")


def scale_factor(rms: float, mean_square: Any) -> float:
    """Return the scale factor to the requested rms height."""
    if mean_square == 0:
        raise ValueError(f"{_name_of_wavelength()}: must leave at least one wave of two spacings or more")
    return rms / np.sqrt(mean_square)


def seed_sequence(seed: Seed) -> np.random.SeedSequence:
    """Return the SeedSequence of one or several whole numbers; a SeedSequence is returned unchanged."""
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
