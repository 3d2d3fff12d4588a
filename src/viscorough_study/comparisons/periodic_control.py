"""Check the model of interface and flat punch in series (fits.interface) on a periodic half-space, which has no punch.

The periodic surfaces have the same spectra as the discs. If p is the mean pressure and ū the mean separation, the
compliance of the interface is g_per = −dū/(h d ln p); there is no compliance of a punch to subtract. For a disc, g is
the contribution of the interface to vt/h. If g is a property of the interface alone, g and g_per are equal at the same
mean pressure, p/E* = (4/π) X h/L, where X = F/(4GhL) is the reduced force on the disc.

If g_per is constant, the pressure decreases exponentially with the separation, p ∝ exp(−ū/u₀), as in Persson's theory,
and u₀/h = g_per. For extended surfaces, the value u₀/h = 0.4 is quoted from Pastewka et al. (Phys. Rev. E 87, 062809
(2013)). For surfaces whose spectrum has a roll-off, the maximum of g_per is at a larger X than for surfaces without a
roll-off. Therefore the maxima of g_per are compared, not the values at the same X.

The contact problem is solved by conjugate gradients, projected on pressures that are nowhere negative and have the mean
p (Polonsky & Keer, Wear 231, 206 (1999)). In Fourier space the displacement is the pressure times 2/(E*|q|), and 0 at
q = 0. The solver of the library is not used.
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

# Tolerance of the gap in units of the rms height. A tolerance ten times smaller changes g_per by less than 1e-4.
TOLERANCE = 1e-3
ITERATIONS_MAX = 5000
COLUMNS = {
    "hurst": ("Hurst exponent", "1"),
    "roll_off_wavelength": ("longest wave of the power law over the period, missing without a roll-off", "1"),
    "x": ("X at which a disc has this mean pressure, p/E* = (4/π) X h/L", "1"),
    "surfaces": ("surfaces", "1"),
    **described("g", "−dū/(h d ln p), mean over the surfaces"),
}


def periodic_control(*, hursts, points, surfaces, roll_off, x_low, x_high, per_decade, seed):
    """Compute the compliance g_per of periodic surfaces at several X; return a pandas.DataFrame with `COLUMNS`.

    The surfaces have spectra with and without a roll-off.

    points : points along a side of the square; surfaces : number of surfaces for each Hurst exponent and spectrum
    roll_off : {"wavelength": roll-off wavelength as a share of the period, "level": roll_off_level of
        self_affine_square}
    x_low, x_high, per_decade : range and number per decade of the X at which contacts are solved. g_per is the
        difference quotient between neighbouring X
    seed : root of the surfaces' seeds
    """
    x, tables = abscissa(x_low, x_high, per_decade), []
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
    """Return ū/h, the mean separation divided by the rms height, at every mean pressure; shape (pressures,).

    heights : heights of a periodic square with side L, shape (n, n), mean 0, in any unit
    pressures : mean pressures as p L/(E* h), increasing
    """
    shape = np.array(heights / heights.std(), dtype=float)
    pressure, separations = np.full(shape.shape, pressures[0]), []
    for mean in pressures:
        separation, pressure = periodic_contact(shape, pressure * (mean / pressure.mean()))
        separations.append(separation)
    return np.array(separations)


def periodic_contact(heights, start, tolerance=TOLERANCE):
    """Solve the periodic contact with the mean pressure of `start`; return its mean separation and its pressures.

    heights : shape (n, n), mean 0, in any unit of length; the separation and the tolerance have the same unit
    start : first guess of the pressures, as p L/E* in the same unit, shape (n, n)
    Raises ConvergenceError if ITERATIONS_MAX iterations do not reduce all overlaps, and all gaps at elements under
    pressure, to the tolerance.
    """
    n, mean, pressure = len(heights), start.mean(), start
    waves = 2 * np.pi * np.hypot(fft.fftfreq(n, 1 / n)[:, None], fft.rfftfreq(n, 1 / n))
    waves[0, 0] = np.inf
    kernel = 2 / waves

    def deflection(load):
        return fft.irfft2(kernel * fft.rfft2(load), s=load.shape)

    unit = np.zeros_like(heights)
    unit[0, 0] = 1.0
    single = 1 / deflection(unit)[0, 0]  # change of the load of one element that moves this element by 1
    direction, last, conjugate = np.zeros_like(heights), 1.0, False
    for _ in range(ITERATIONS_MAX):
        touching = pressure > 0
        gap = deflection(pressure) - heights
        separation = -gap[touching].mean()
        gap += separation
        if np.abs(gap[touching]).max() <= tolerance and gap.min() >= -tolerance:
            return separation, pressure
        square = np.sum(gap[touching] ** 2)
        direction = np.where(touching, gap + (square / last if conjugate and last else 0.0) * direction, 0.0)
        last = square
        response = deflection(direction)
        response -= response[touching].mean()
        curvature = np.sum(response[touching] * direction[touching])
        # If a single element touches, its load is given, the curvature is 0, and only overlaps change the pressures.
        step = np.sum(gap[touching] * direction[touching]) / curvature if curvature else single
        pressure = np.maximum(pressure - step * direction, 0.0)
        overlapping = (pressure == 0) & (gap < 0)
        pressure[overlapping] -= step * gap[overlapping]
        conjugate = not overlapping.any()
        pressure *= mean / pressure.mean()
    raise ConvergenceError(f"periodic contact: tolerance {tolerance:g} not reached in {ITERATIONS_MAX} iterations")
