"""Check the model of two springs in series on a periodic half-space, which has no flat punch.

The surfaces have the same spectra as the discs. Under the mean pressure p the mean separation is ū, and g_per = −dū/(h
d ln p) is the compliance of the interface; there is no punch to subtract. If the interface's part g of vt/h of a disc
is a property of the interface alone, the two agree at equal mean pressure, p/E* = (4/π) X h/L. If g_per is constant,
the pressure is exponential in the separation as in Persson's theory, with u₀/h = g_per; 0.4 is quoted from Pastewka et
al. (Phys. Rev. E 87, 062809 (2013)) for extended surfaces. With a roll-off the largest g_per lies at larger X, so the
largest values are compared, not values at one X.

The half-space is solved by conjugate gradients projected on pressures that are nowhere negative and have the mean p
(Polonsky & Keer, Wear 231, 206 (1999)), with the kernel 2/(E*|q|) in Fourier space and none at q = 0. It is independent
of the solver of the library.
"""

from itertools import product

import numpy as np
import pandas as pd
from scipy import fft

from viscorough.basics.errors import ConvergenceError
from viscorough.surfaces.self_affine import self_affine_square
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.intervals import described, mean_with_interval, three_columns
from viscorough_study.run.seeds import periodic_key, realization_seed

TOLERANCE = 1e-3  # tolerance of the gap over the rms height; a tenth of it changes g by less than 1e-4
ITERATIONS_MAX = 5000
COLUMNS = {
    "hurst": ("Hurst exponent", "1"),
    "roll_off_wavelength": ("longest wave of the power law over the period, missing without a roll-off", "1"),
    "x": ("X at which a disc has this mean pressure, p/E* = (4/π) X h/L", "1"),
    "surfaces": ("surfaces", "1"),
    **described("g", "−dū/(h d ln p), mean over the surfaces"),
}


def periodic_control(*, hursts, points, surfaces, roll_off, seed, **levels):
    """Return g_per over X, with and without a roll-off, as a pandas.DataFrame with the columns of `COLUMNS`.

    points : points along a side of the square; surfaces : number for each Hurst exponent and spectrum
    roll_off : wavelength over the period, and level, as in self_affine_square
    seed : root of the surfaces' seeds
    levels : x_low, x_high and per_decade, the range and density of the levels X; g_per is taken between them
    """
    x, tables = abscissa(levels["x_low"], levels["x_high"], levels["per_decade"]), []
    rolled_off = {"roll_off_wavelength": points * roll_off["wavelength"], "roll_off_level": roll_off["level"]}
    for hurst, (wavelength, waves) in product(hursts, ((np.nan, {}), (roll_off["wavelength"], rolled_off))):
        seeds = [realization_seed(seed, *periodic_key(hurst, number)) for number in range(surfaces)]
        squares = [self_affine_square(hurst, points, seed=own_seed, **waves) for own_seed in seeds]
        separations = [mean_separations(heights, 4 / np.pi * x) for heights in squares]
        g = -np.diff(separations) / np.diff(np.log(x))
        rows = pd.DataFrame({"x": np.sqrt(x[1:] * x[:-1])} | three_columns("g", mean_with_interval(g)))
        tables.append(rows.assign(hurst=hurst, roll_off_wavelength=wavelength, surfaces=surfaces))
    return pd.concat(tables, ignore_index=True)[list(COLUMNS)]


def mean_separations(heights, pressures):
    """Return ū/h at increasing mean pressures p L/(E* h), shape (pressures,).

    heights : heights of a periodic square, shape (n, n), mean 0; any unit
    """
    shape = np.array(heights / heights.std(), dtype=float)
    pressure, separations = np.full(shape.shape, pressures[0]), []
    for mean in pressures:
        separation, pressure = periodic_contact(shape, pressure * (mean / pressure.mean()))
        separations.append(separation)
    return np.array(separations)


def periodic_contact(heights, start, tolerance=TOLERANCE):
    """Return mean separation and pressures of a contact with the same mean pressure as the start.

    heights : shape (n, n), mean 0, over the unit of height; start : pressures p L/E* over it, shape (n, n)
    Raises ConvergenceError if the gap in contact, or an overlap, is above the tolerance after ITERATIONS_MAX.
    """
    n, mean, pressure = len(heights), start.mean(), start
    waves = 2 * np.pi * np.hypot(fft.fftfreq(n, 1 / n)[:, None], fft.rfftfreq(n, 1 / n))
    waves[0, 0] = np.inf
    kernel = 2 / waves

    def deflection(load):
        return fft.irfft2(kernel * fft.rfft2(load), s=load.shape)

    direction, last, keep = np.zeros_like(heights), 1.0, 0.0
    for _ in range(ITERATIONS_MAX):
        touching = pressure > 0
        gap = deflection(pressure) - heights
        separation = -gap[touching].mean()
        gap += separation
        if np.abs(gap[touching]).max() <= tolerance and gap.min() >= -tolerance:
            return separation, pressure
        square = np.sum(gap[touching] ** 2)
        direction = np.where(touching, gap + keep * square / last * direction, 0.0)
        last = square
        response = deflection(direction)
        response -= response[touching].mean()
        step = np.sum(gap[touching] * direction[touching]) / np.sum(response[touching] * direction[touching])
        pressure = np.maximum(pressure - step * direction, 0.0)
        overlapping = (pressure == 0) & (gap < 0)
        pressure[overlapping] -= step * gap[overlapping]
        keep = 0.0 if overlapping.any() else 1.0
        pressure *= mean / pressure.mean()
    raise ConvergenceError(f"periodic contact: tolerance {tolerance:g} not reached in {ITERATIONS_MAX} iterations")
